//! Incident direction for which all pictures of a product are drawn, and texts about it.

use super::facing::sun_incident;
use super::scene_file::SceneFile;
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::profile_angle::profile_angle;
use crate::drawing::ticks::degrees;
use crate::texts::words as texts;
use std::path::Path;

/// Source of the incident direction for which pictures are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Position of the sun in the scene.
    Sun,
    /// Choice of the user.
    Chosen,
    /// Normal incidence, because the sun is not in front of the aperture and nothing was chosen.
    Normal,
}

/// Incident direction for which pictures of a product are drawn, with its source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incidence {
    /// Incident direction.
    pub direction: Incident,
    /// Source of the direction.
    pub source: Source,
}

impl Incidence {
    /// Returns the incident direction for which pictures of a scene are drawn: the chosen one, else that of the sun,
    /// else normal incidence. `base`: folder of the scene.
    pub fn shown(chosen: Option<Incident>, scene: &SceneFile, base: &Path) -> Self {
        let of = |direction, source| Self { direction, source };
        match (chosen, sun_incident(scene, base)) {
            (Some(direction), _) => of(direction, Source::Chosen),
            (None, Some(sun)) => of(sun, Source::Sun),
            (None, None) => of(Incident(Dir::from_unit(glam::DVec3::Z)), Source::Normal),
        }
    }

    /// Returns the translated name of the source.
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

/// Formats an incident direction as "θ 49°, φ 98°": θ from the façade's outward normal, φ from the right (seen from
/// outside) towards up.
pub fn direction_text(d: Dir<Facade>) -> String {
    // Rounded first: just below 360° is 0° again.
    let phi = d.phi().to_degrees().round() % 360.0;
    format!("θ {}, φ {}", degrees(d.theta()), degrees(phi.to_radians()))
}
