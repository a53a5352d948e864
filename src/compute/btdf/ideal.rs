//! Ideal systems (ideal clear, ideal diffuser) as exact references.

use super::{AngularTransmittance, Btdf, Scattered};

impl Btdf {
    /// Creates an ideal clear system: regular transmission alone, with the same transmittance `tau` for every angle of
    /// incidence.
    pub const fn ideal_transparent(tau: f64) -> Self {
        Self { regular: Some(AngularTransmittance::Constant(tau)), scattered: None }
    }

    /// Creates an ideal diffuser: the same luminance in every emergent direction, with the same transmittance `tau` for
    /// every angle of incidence.
    pub const fn ideal_diffuse(tau: f64) -> Self {
        Self { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(tau))) }
    }
}
