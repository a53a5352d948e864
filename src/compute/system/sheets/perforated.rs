//! Family of perforated sheets: perforated and expanded metal, grids of webs.

use super::hole::Perforated;
use super::holes::Holes;
use crate::compute::system::family::{Family, OpticalModelError, Polygons};
use crate::compute::system::measure::OpticalModel;

impl Family for Perforated {
    fn word(&self) -> &'static str {
        "perforated"
    }

    fn method(&self) -> &'static str {
        "radiosity in the hole, straight share by clipped polygons"
    }

    fn structure(&self) -> Option<f64> {
        Some(self.area.sqrt())
    }

    /// Returns the section of the sheet between two holes, through the middle of both.
    fn drawing(&self, _: &str) -> Polygons {
        let [height, pitch] = self.pattern();
        let (low, high) = (0.5 * height, pitch - 0.5 * height);
        let (inner, rise) = (-self.thickness, self.rise);
        vec![vec![[inner, low + rise], [0.0, low], [0.0, high], [inner, high + rise]]]
    }

    fn drawing_period(&self) -> Option<f64> {
        Some(self.pattern()[1])
    }

    fn is_schematic(&self) -> bool {
        true
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        Ok(Box::new(Holes::new(*self)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::system::sheets::Hole;

    #[test]
    fn what_is_solid_of_a_sheet_with_holes() {
        let hole = Hole::Rectangle { width: 0.02, height: 0.01 };
        let sheet = Perforated { hole, area: 0.0004, thickness: 0.001, rise: 0.003, reflectance: [0.5; 3] };
        assert!((sheet.drawing_period().unwrap() - 0.02).abs() < 1e-15);
        let web = &sheet.drawing("")[0];
        let next = web.iter().cycle().skip(1);
        let area = 0.5 * web.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs();
        assert!((area - 0.01 * 0.001).abs() < 1e-15);
    }
}
