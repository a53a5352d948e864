//! The one direction of incidence that everything drawn of a product speaks of, and the words for it.

use super::facing::sun_incident;
use super::scene_file::SceneFile;
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::profile_angle::profile_angle;
use crate::drawing::ticks::degrees;
use crate::texts::words as texts;
use std::path::Path;

/// Why it is this direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The sun stands there.
    Sun,
    /// The user chose it.
    Chosen,
    /// The sun is not before the aperture and nothing was chosen: perpendicular.
    Normal,
}

/// A direction of incidence and why it is that one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incidence {
    /// Where the light comes from.
    pub direction: Incident,
    /// Why.
    pub source: Source,
}

impl Incidence {
    /// What tiles show in a scene: the chosen direction, else the sun's, else the perpendicular one.
    pub fn shown(chosen: Option<Incident>, scene: &SceneFile, base: &Path) -> Self {
        let of = |direction, source| Self { direction, source };
        match (chosen, sun_incident(scene, base)) {
            (Some(direction), _) => of(direction, Source::Chosen),
            (None, Some(sun)) => of(sun, Source::Sun),
            (None, None) => of(Incident(Dir::from_unit(glam::DVec3::Z)), Source::Normal),
        }
    }

    /// Whose direction it is.
    pub fn name(&self) -> &'static str {
        match self.source {
            Source::Sun => texts::THE_SUN.get(),
            Source::Chosen => texts::CHOSEN_DIRECTION.get(),
            Source::Normal => texts::PERPENDICULAR.get(),
        }
    }

    /// "sun at θ 49°, φ 98°, profile angle 49°", and shorter: the same direction in all of them.
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

/// "θ 49°, φ 98°": from the façade's normal, and from the right seen from outside towards up.
pub fn direction_text(d: Dir<Facade>) -> String {
    // Rounded first: just under a whole turn is 0° again.
    let phi = d.phi().to_degrees().round() % 360.0;
    format!("θ {}, φ {}", degrees(d.theta()), degrees(phi.to_radians()))
}
