//! Interface of the families of systems, between a description and the rest of the program.

use super::measure::OpticalModel;

/// Error of a description without optical model: what is wrong and what would be right.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct OpticalModelError(pub String);

impl OpticalModelError {
    /// Creates the error from the cause.
    pub fn because(error: impl std::fmt::Display) -> Self {
        Self(error.to_string())
    }
}

/// Closed polygons (outward, upward), their first points not repeated. \[m\]
pub type Polygons = Vec<Vec<[f64; 2]>>;

/// Family of systems by geometry and material. States are given by keys that [`Family::states`] lists.
pub trait Family {
    /// Returns the key of the family in files and in the catalogue.
    fn word(&self) -> &'static str;

    /// Returns the method by which its data are computed, in words with the source.
    fn method(&self) -> &'static str;

    /// Returns the name of the face of the description that looks into the room.
    fn inside_face(&self) -> &'static str {
        "room side of the description"
    }

    /// Returns the keys of the states: angles in degrees as shortest decimals; one empty key for a system without
    /// states.
    fn states(&self) -> Vec<String> {
        vec![String::new()]
    }

    /// Returns the period of its visible structure \[m\]; `None` for plain sheets and stacks.
    fn structure(&self) -> Option<f64> {
        None
    }

    /// Returns one period of a state in section, for drawings. A slat without thickness goes there and back on the same
    /// line. Empty for geometry that encloses nothing, and for a stack, whose layers only its caller can find.
    fn drawing(&self, state: &str) -> Polygons;

    /// Returns the vertical distance at which the polygons of the drawing repeat. \[m\]
    fn drawing_period(&self) -> Option<f64> {
        self.structure()
    }

    /// Whether the drawing shows the principle rather than the described lengths.
    fn is_schematic(&self) -> bool {
        false
    }

    /// Creates the optical model of a state.
    ///
    /// # Errors
    /// Returns an error if the geometry encloses nothing, if values are impossible, or for a stack.
    fn optical_model(&self, state: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError>;
}

/// Height of the piece of a plain sheet that is drawn. \[m\] Chosen: affects drawings only, no figure.
pub(super) const PIECE: f64 = 0.1;

/// Returns the rectangle between two corners.
pub(super) fn rectangle(low: [f64; 2], high: [f64; 2]) -> Vec<[f64; 2]> {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// Returns the key of the state at an angle \[rad\]: degrees as shortest decimal, free of the last digits that the
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
