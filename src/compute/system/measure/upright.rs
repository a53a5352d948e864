//! A system turned by 90° about the normal: vertical louvres from a description of horizontal ones.

use super::{Measured, Setting, Specimen};
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::estimate::{Cancelled, Progress};
use std::f64::consts::FRAC_PI_2;

/// What was up points to the right as seen from outside.
pub struct Upright(pub Box<dyn Specimen>);

impl Specimen for Upright {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        // The turned system at φ is the described one at φ + 90°, cell by cell.
        let turned = |basis: &RingBasis| {
            let azimuth = basis.azimuth();
            basis.clone().with_azimuth(AzimuthMap { offset: azimuth.offset + FRAC_PI_2, ..azimuth })
        };
        let (incident, emergent) = (turned(setting.incident), turned(setting.emergent));
        let made = self.0.measure(&Setting { incident: &incident, emergent: &emergent, ..*setting }, progress)?;
        Ok(Measured { incident: setting.incident.clone(), emergent: setting.emergent.clone(), ..made })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Dir;
    use crate::compute::estimate::Silent;
    use crate::compute::system::measure::front_basis;
    use crate::compute::system::slats::{SlatArray, SlatProfile, Surface};
    use crate::compute::system::stack::DataLayer;

    #[test]
    fn outer_edges_lowered_become_outer_edges_turned_left() {
        let slats =
            SlatArray::new(SlatProfile::Flat { width: 0.08 }, 0.0, 0.072, 0.6, [Surface::matt(0.5); 2]).unwrap();
        let cells = front_basis();
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
        let flat = DataLayer(slats.examine(&setting, &Silent).unwrap().0);
        let lying = flat.measure(&setting, &Silent).unwrap();
        let standing = Upright(Box::new(flat)).measure(&setting, &Silent).unwrap();
        let (a, b) = (lying.shares(&lying.front.transmitted), standing.shares(&standing.front.transmitted));
        let at = |degrees: f64| cells.index(Dir::from_theta_phi(0.7, degrees.to_radians())).unwrap();
        // What comes from above in the description comes from the right.
        assert!((a[at(90.0)] - b[at(0.0)]).abs() < 1e-12 && (a[at(270.0)] - b[at(180.0)]).abs() < 1e-12);
        assert!(b[at(180.0)] > 2.0 * b[at(0.0)]);
    }
}
