//! Prismatic sheets: horizontal grooves on one face, the other one flat.

use super::outline::Outline;
use super::section::{Body, ClearSection, Material};
use super::{METHOD, OutlineError};
use crate::compute::system::family::{Family, OpticalModelError, Polygons};
use crate::compute::system::measure::OpticalModel;
use std::f64::consts::FRAC_PI_2;

/// Sheet with equal prismatic ridges on one face, each with an upper and a lower flank; the other face is flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prisms {
    /// Material of the sheet.
    pub material: Material,
    /// Angles of the upper and of the lower flank of a ridge against the sheet's plane; the upper one is the one whose
    /// outward normal rises. \[rad\]
    pub angles: [f64; 2],
    /// Vertical distance between ridges. \[m\]
    pub pitch: f64,
    /// Thickness of the sheet under the prisms: flat face to valley. \[m\]
    pub base: f64,
    /// Whether the prisms face the outside and the flat face the room; otherwise the prisms face the room.
    pub flipped: bool,
}

impl Prisms {
    /// Returns the height of a ridge over its valleys. \[m\]
    pub fn height(&self) -> f64 {
        let [upper, lower] = self.angles.map(|angle| if angle >= FRAC_PI_2 { 0.0 } else { 1.0 / angle.tan() });
        self.pitch / (upper + lower)
    }

    /// Creates the vertical section of the sheet, with its flat face at depth 0.
    ///
    /// # Errors
    /// Returns an error if the flanks form no ridge, or lengths or materials are out of range.
    pub fn section(&self) -> Result<ClearSection, OutlineError> {
        let [upper, lower] = self.angles;
        let flank = |angle: f64| angle > 0.0 && angle <= FRAC_PI_2 + 1e-12;
        let height = self.height();
        if !(flank(upper) && flank(lower) && height.is_finite()) {
            return Err(OutlineError::Flanks(upper.to_degrees(), lower.to_degrees()));
        }
        let foot = if lower >= FRAC_PI_2 { 0.0 } else { height / lower.tan() };
        let flat = vec![[0.0, 0.0], [0.0, self.pitch]];
        let ridged = vec![[-self.base, 0.0], [-self.base - height, foot], [-self.base, self.pitch]];
        let outline = Outline::Sheet { outer: flat, inner: ridged };
        let section = ClearSection::new(self.pitch, vec![Body { outline, material: self.material }], [None, None])?;
        Ok(if self.flipped { section.flipped() } else { section })
    }
}

impl Family for Prisms {
    fn word(&self) -> &'static str {
        "prismatic"
    }

    fn method(&self) -> &'static str {
        METHOD
    }

    fn structure(&self) -> Option<f64> {
        Some(self.pitch)
    }

    fn drawing(&self, _: &str) -> Polygons {
        self.section().map(|section| section.outline()).unwrap_or_default()
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        Ok(Box::new(self.section().map_err(OpticalModelError::because)?.optical_model()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flanks_have_their_angles() {
        let material = Material { index: 1.49, absorption: 0.0 };
        let degrees = [42.0, 5.0].map(f64::to_radians);
        let sheet = Prisms { material, angles: degrees, pitch: 0.001, base: 0.001, flipped: false };
        let section = sheet.section().unwrap();
        let polygon = &section.outline()[0];
        assert_eq!(polygon.len(), 5);
        // Flat face up, then the ridged face downwards: valley, ridge, valley.
        let (valley, ridge) = (polygon[2], polygon[3]);
        // The upper flank lies above the ridge, so that its normal rises.
        assert!(ridge[0] < valley[0] && ridge[1] < valley[1]);
        let angle = ((valley[0] - ridge[0]) / (valley[1] - ridge[1])).atan();
        assert!((angle.to_degrees() - 42.0).abs() < 1e-9);
        for angles in [[0.0, 45.0], [90.0, 90.0], [-10.0, 45.0], [f64::NAN, 45.0]] {
            let angles = angles.map(f64::to_radians);
            assert!(Prisms { angles, ..sheet }.section().is_err(), "{angles:?}");
        }
        assert!(Prisms { angles: [90.0, 30.0].map(f64::to_radians), ..sheet }.section().is_ok());
    }
}
