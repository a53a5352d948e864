//! Interface of the families of systems, between a description and the rest of the program.

use super::measure::OpticalModel;

/// Reason why no optical model can be created from a system description: text that says what is wrong and what would be
/// right.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct OpticalModelError(pub String);

impl OpticalModelError {
    /// Creates the error from the message of its cause.
    pub fn because(error: impl std::fmt::Display) -> Self {
        Self(error.to_string())
    }
}

/// Closed polygons of (outward, upward) points, the first point not repeated at the end. \[m\]
pub type Polygons = Vec<Vec<[f64; 2]>>;

/// Family of described systems (e.g. venetian blinds), each by geometry and material. States are given by the keys that
/// [`Family::states`] lists.
pub trait Family {
    /// Returns the key of the family in files and in the catalogue.
    fn word(&self) -> &'static str;

    /// Returns the method by which the family's data are computed, as text with its source.
    fn method(&self) -> &'static str;

    /// Returns the name of the face of the description that looks into the room.
    fn inside_face(&self) -> &'static str {
        "room side of the description"
    }

    /// Returns the keys of the system's states: tilt angles in degrees as shortest decimals; one empty key for a system
    /// without states.
    fn states(&self) -> Vec<String> {
        vec![String::new()]
    }

    /// Returns the period of the system's visible structure, e.g. the pitch of slats \[m\]; `None` for plain sheets and
    /// stacks.
    fn structure(&self) -> Option<f64> {
        None
    }

    /// Returns the vertical section of one period of the system in the given state, for drawings. The polygon of a slat
    /// without thickness runs forth and back on the same line. Empty for geometry that encloses nothing, and for a
    /// stack, whose layers only its caller can find.
    fn drawing(&self, state: &str) -> Polygons;

    /// Returns the vertical distance at which the polygons of the drawing repeat. \[m\]
    fn drawing_period(&self) -> Option<f64> {
        self.structure()
    }

    /// Whether the drawing shows the principle of the system, not its described dimensions.
    fn is_schematic(&self) -> bool {
        false
    }

    /// Creates the optical model of the system in the given state.
    ///
    /// # Errors
    /// Returns an error if the geometry encloses nothing, if values are impossible, or for a stack.
    fn optical_model(&self, state: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError>;
}

/// Height of the piece of a plain sheet in drawings. \[m\] Chosen: affects drawings only, no figure.
pub(super) const PIECE: f64 = 0.1;

/// Returns the polygon of the rectangle between its lower and its upper corner (outward, upward).
pub(super) fn rectangle(low: [f64; 2], high: [f64; 2]) -> Vec<[f64; 2]> {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// Returns the key of the state at a tilt angle \[rad\]: degrees as shortest decimal, without the last digits that the
/// conversion adds.
pub fn state_key(angle: f64) -> String {
    let degrees = (angle.to_degrees() * 1e9).round() / 1e9;
    // Minus zero is zero.
    format!("{}", degrees + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_shortest_decimals() {
        let keys = [-0.0, 45.0, -30.0, 22.5, 0.1 + 0.2].map(|degrees: f64| state_key(degrees.to_radians()));
        assert_eq!(keys, ["0", "45", "-30", "22.5", "0.3"]);
    }
}
