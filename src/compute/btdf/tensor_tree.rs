//! Tensor trees: scattering on the squares that Shirley and Chiu map to the disk of direction cosines.
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Indicatrix;
use crate::compute::direction::{Emergent, Incident};

/// placeholder
#[derive(Debug, Clone, PartialEq)]
pub struct TensorTree;

impl TensorTree {
    pub fn q(&self, _incident: Incident, _emergent: Emergent) -> f64 {
        0.0
    }
    pub fn tau(&self, _incident: Incident) -> f64 {
        0.0
    }
    pub fn tau_hemispherical(&self) -> f64 {
        0.0
    }
    pub fn incident_listing(&self) -> RingBasis {
        RingBasis::hemisphere()
    }
    pub fn indicatrix(&self, _incident: Incident) -> Indicatrix {
        Indicatrix { basis: RingBasis::hemisphere(), q: vec![0.0] }
    }
    /// Number of cells along one side of the finest incident square.
    pub fn incident_resolution(&self) -> usize {
        1
    }
    /// Emergent luminance from illuminance per incident square cell.
    pub fn luminance(&self, _illuminance: &[f64]) -> (RingBasis, Vec<f64>) {
        (RingBasis::hemisphere(), vec![0.0])
    }
}
