//! Incident direction that all pictures of a product use, and texts about it.

use super::facing::sun_incident;
use super::scene_file::SceneFile;
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::profile_angle::profile_angle;
use crate::drawing::ticks::degrees;
use crate::texts::words as texts;
use std::path::Path;

/// Source of the incident direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Position of the sun.
    Sun,
    /// Choice of the user.
    Chosen,
    /// Perpendicular incidence: the sun is not in front of the aperture and nothing was chosen.
    Normal,
}

/// An incident direction with its source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incidence {
    /// Incident direction.
    pub direction: Incident,
    /// Source of the direction.
    pub source: Source,
}

impl Incidence {
    /// Returns the direction that tiles show in a scene: the chosen one, else that of the sun, else perpendicular
    /// incidence.
    pub fn shown(chosen: Option<Incident>, scene: &SceneFile, base: &Path) -> Self {
        let of = |direction, source| Self { direction, source };
        match (chosen, sun_incident(scene, base)) {
            (Some(direction), _) => of(direction, Source::Chosen),
            (None, Some(sun)) => of(sun, Source::Sun),
            (None, None) => of(Incident(Dir::from_unit(glam::DVec3::Z)), Source::Normal),
        }
    }

    /// Returns the name of the source.
    pub fn name(&self) -> &'static str {
        match self.source {
            Source::Sun => texts::THE_SUN.get(),
            Source::Chosen => texts::CHOSEN_DIRECTION.get(),
            Source::Normal => texts::PERPENDICULAR.get(),
        }
    }

    /// Returns the direction as text in three lengths: "sun at θ 49°, φ 98°, profile angle 49°", and shorter.
    pub fn texts(&self) -> [String; 3] {
        let direction = self.direction.0;
        let angles = direction_text(direction);
        let profile =
            profile_angle(direction).map_or_else(|| angles.clone(), |psi| texts::with_profile(&angles, degrees(psi)));
        let why = if self.source == Source::Normal { texts::SUN_BEHIND.get() } else { "" };
        let name = self.name();
        [format!("{}{why}", texts::incidence(name, profile)), texts::incidence(name, &angles), angles]
    }
}

/// Formats a direction as "θ 49°, φ 98°": θ from the façade's normal, φ from the right as seen from outside towards up.
pub fn direction_text(d: Dir<Facade>) -> String {
    // Rounded first: just below 360° is 0° again.
    let phi = d.phi().to_degrees().round() % 360.0;
    format!("θ {}, φ {}", degrees(d.theta()), degrees(phi.to_radians()))
}
