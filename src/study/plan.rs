//! Plan of a computation: the stages that a scene needs, and why the others are skipped. It is made before any work,
//! and printed with every result.

use super::scene::{Scene, surface};
use crate::compute::btdf::{Btdf, Scattered};
use std::time::Duration;

/// One stage of a computation, such as "interreflection".
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Stable name of the stage, which does not change with the language.
    pub name: &'static str,
    /// Whether the stage runs.
    pub runs: bool,
    /// Reason why it runs or is skipped.
    pub reason: String,
    /// Computing time of the stage.
    pub time: Duration,
}

impl Stage {
    /// Whether the stage is only a note on a stored result, so that it says nothing about this computation.
    pub fn is_kept(&self) -> bool {
        self.reason.starts_with("reused") || self.reason == "not there yet"
    }
}

/// Plan of a computation: its stages with reasons and times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plan {
    /// Stages in the order of execution.
    pub stages: Vec<Stage>,
}

impl Plan {
    /// Creates the plan for a scene.
    pub fn new(scene: &Scene) -> Self {
        let mut plan = Self::default();
        let scattered = |test: fn(&Scattered) -> bool| {
            scene.apertures.iter().filter_map(|a| a.transmission()?.scattered.as_ref()).any(test)
        };
        let regular = scene.apertures.iter().any(|a| a.transmission().is_some_and(|btdf| btdf.regular.is_some()));
        let cells = scattered(|part| !matches!(part, Scattered::Lambert(_)));
        // The data of such systems may be missing, which the next stages use.
        let described = scene.beams && scene.apertures.iter().any(|a| a.system.model.is_some());
        let sun_on = (0..scene.apertures.len()).any(|index| scene.facing(index).sun_illuminance() > 0.0);
        plan.add(
            "sun",
            sun_on,
            match (&scene.sun, sun_on) {
                (None, _) => "no direct normal illuminance, or the sun is below the horizon",
                (_, false) => "the sun does not reach any aperture",
                _ => "the sun shines on an aperture",
            },
        );
        let ground = scene.outside.ground_luminance() > 0.0;
        plan.add("ground", ground, if ground { "the ground reflects" } else { "the ground is black or dark" });
        plan.add(
            "cells",
            cells,
            match (cells, described) {
                (true, false) => "a system scatters by its dataset's cells",
                (true, true) => "a system scatters by its dataset's cells, where it has no description",
                (false, true) => "scattering is computed from the description",
                (false, false) => "no system has scattering data",
            },
        );
        if described {
            plan.add("description", true, "the description gives the light direction by direction");
        }
        plan.add(
            "seen through",
            regular,
            match (regular, described) {
                (true, _) => "a system has regular transmission",
                (false, true) => "regular transmission is computed from the description",
                (false, false) => "no system has regular transmission",
            },
        );
        // A transmittance that varies with the angle needs the integral under any sky.
        let constant = |btdf: &Btdf| btdf.regular.as_ref().is_none_or(|tau| tau.constant().is_some());
        let even = scene.outside.is_uniform_above_horizon()
            && scene.apertures.iter().all(|a| a.transmission().is_none_or(constant));
        plan.add(
            "sky at sensors",
            regular && !even,
            match (regular, even) {
                (false, _) => "no dataset has regular transmission",
                (true, true) => "above the horizon the luminance is the same everywhere: closed form",
                (true, false) => "the luminance of the sky seen through the aperture varies",
            },
        );
        let controlled: Vec<String> = scene.apertures.iter().filter_map(|a| a.controlled.clone()).collect();
        if !controlled.is_empty() {
            let reason = format!("the control picks {}: no other state is loaded or computed", controlled.join(", "));
            plan.add("other states", false, &reason);
        }
        plan.add("near field", true, &format!("{}: {}", scene.near_field.word(), scene.near_field.effort()));
        let reflects = scene.room.floor > 0.0
            || scene.room.walls > 0.0
            || scene.room.ceiling > 0.0
            || scene.apertures.iter().any(|a| a.reflectance > 0.0);
        plan.add(
            "interreflection",
            scene.interreflection && reflects,
            match (scene.interreflection, reflects) {
                (false, _) => "the scene asks for the direct component alone",
                (true, false) => "nothing in the room reflects",
                (true, true) => "surfaces reflect",
            },
        );
        let directional = scene.apertures.iter().filter(|a| a.directional).count();
        let weight =
            scene.apertures.iter().map(|a| a.reflectance * a.aperture.area()).sum::<f64>() / surface(&scene.room);
        let share = format!("{:.2} % of the room's surface times reflectance are apertures", 100.0 * weight);
        let by_cells = directional > 0 && scene.interreflection;
        let reason = if by_cells {
            format!(
                "{share}; {directional} of {} by direction, from the dataset's own cells; the room without them is kept \
                 for other states",
                scene.apertures.len()
            )
        } else if scene.interreflection {
            format!("{share}; no cells of it in the data, another aperture before it, or asked for: taken as diffuse")
        } else {
            String::from("the scene asks for the direct component alone")
        };
        plan.add("back reflection", by_cells, &reason);
        plan
    }

    /// Adds a stage, or a note on one, that becomes known only during the computation.
    pub(super) fn note(&mut self, name: &'static str, runs: bool, reason: &str) {
        self.add(name, runs, reason);
    }

    fn add(&mut self, name: &'static str, runs: bool, reason: &str) {
        self.stages.push(Stage { name, runs, reason: reason.to_owned(), time: Duration::ZERO });
    }

    /// Whether the stage with this name runs.
    pub fn runs(&self, name: &str) -> bool {
        self.stages.iter().any(|stage| stage.name == name && stage.runs)
    }

    /// Adds computing time to a stage; a stage that is not in the plan is added.
    pub fn spend(&mut self, name: &'static str, time: Duration) {
        match self.stages.iter_mut().find(|stage| stage.name == name) {
            Some(stage) => stage.time += time,
            None => self.stages.push(Stage { name, runs: true, reason: String::from("always"), time }),
        }
    }
}
