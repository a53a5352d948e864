//! Common formula of the relative luminance of the CIE general skies and of Perez' all-weather sky.

/// Relative luminance (1 + a·e^{b/cosZ}) · (base + c·e^{dχ} + e·cos²χ) with the zenith angle Z and the angle χ from the
/// sun, the common formula of the CIE general skies and of Perez et al. Each factor is 0 where it would be negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gradated {
    pub a: f64,
    pub b: f64,
    /// Constant term of the indicatrix: 1 for Perez, 1 − c·e^{dπ/2} for CIE.
    pub base: f64,
    pub c: f64,
    pub d: f64,
    pub e: f64,
}

impl Gradated {
    /// Returns the gradation factor for the sine `z` of the altitude; 1 on the horizon. Source: ISO 15469.
    #[inline]
    pub fn gradation(&self, z: f64) -> f64 {
        if self.a == 0.0 || z <= 0.0 { 1.0 } else { (1.0 + self.a * (self.b / z).exp()).max(0.0) }
    }

    /// Returns the scattering indicatrix factor at the angle `chi` from the sun. \[rad\]
    #[inline]
    pub fn indicatrix(&self, chi: f64) -> f64 {
        let cos = chi.cos();
        self.indicatrix_with_cosine(chi, cos)
    }

    #[inline]
    pub(super) fn indicatrix_with_cosine(&self, chi: f64, cos: f64) -> f64 {
        (self.base + self.c * (self.d * chi).exp() + self.e * cos * cos).max(0.0)
    }

    /// Whether the luminance does not depend on the position of the sun.
    pub fn symmetric(&self) -> bool {
        self.c == 0.0 && self.e == 0.0
    }
}
