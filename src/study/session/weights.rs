//! Weights that a session keeps.

/// Weights of one sensor, by fine patch.
pub(in crate::study) struct Response {
    /// Of all first illuminance. \[lx per lx\]
    pub value: Vec<f64>,
    /// The difference of the two densities, wall by wall.
    pub walls: Vec<Vec<f64>>,
}

/// Sensor by sensor weights of the luminance of cells.
pub(in crate::study) struct ByCells {
    pub value: Vec<Vec<f64>>,
    /// Wall by wall; empty where not asked for.
    pub walls: Vec<Vec<Vec<f64>>>,
}
