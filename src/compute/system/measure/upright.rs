//! System rotated by 90° about the normal: vertical louvres from a description of horizontal ones.

use super::{Beam, Measured, OpticalModel, ProfileLight, ScatteredLight, Setting, Side, Structure};
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Optical model of a system rotated by 90° about its normal, so that its upward direction points to the right as seen
/// from outside.
pub struct Upright(pub Box<dyn OpticalModel>);

impl OpticalModel for Upright {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        let (incident, emergent) = (turned(setting.incident), turned(setting.emergent));
        let made = self.0.measure(&Setting { incident: &incident, emergent: &emergent, ..*setting }, progress)?;
        Ok(Measured { incident: setting.incident.clone(), emergent: setting.emergent.clone(), ..made })
    }

    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        let back = |beam: Beam| Beam { directions: beam.directions.map(from_described), ..beam };
        self.0.beams(to_described(direction), side).into_iter().map(back).collect()
    }

    fn beams_about(&self, direction: Dir<Facade>, side: Side, within: f64) -> Vec<Beam> {
        let back = |beam: Beam| Beam { directions: beam.directions.map(from_described), ..beam };
        self.0.beams_about(to_described(direction), side, within).into_iter().map(back).collect()
    }

    fn structure(&self) -> Structure {
        self.0.structure().turned()
    }

    fn by_profile_alone(&self) -> Option<bool> {
        self.0.by_profile_alone().map(|upright| !upright)
    }

    fn separates_regular(&self) -> bool {
        self.0.separates_regular()
    }

    fn is_quick(&self) -> bool {
        self.0.is_quick()
    }

    fn straight(&self, direction: Dir<Facade>, side: Side) -> f64 {
        self.0.straight(to_described(direction), side)
    }

    fn profile_light(&self, direction: Dir<Facade>, side: Side) -> Option<ProfileLight> {
        // Turned twice it would stand on its head.
        let light = self.0.profile_light(to_described(direction), side).filter(|light| !light.upright)?;
        Some(ProfileLight { upright: true, ..light })
    }

    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        self.0.scattered(to_described(direction), side, &turned(emergent))
    }

    fn scattered_through(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        self.0.scattered_through(to_described(direction), side, &turned(emergent))
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}

/// Returns the cells of the described system: the rotated system at φ is the described one at φ + 90°, cell by cell.
fn turned(basis: &RingBasis) -> RingBasis {
    let azimuth = basis.azimuth();
    basis.clone().with_azimuth(AzimuthMap { offset: azimuth.offset + FRAC_PI_2, ..azimuth })
}

/// Returns a direction of the rotated system in the axes of the described one: azimuth φ + 90°.
fn to_described(direction: Dir<Facade>) -> Dir<Facade> {
    let v = direction.vector();
    Dir::from_unit(DVec3::new(-v.y, v.x, v.z))
}

/// Returns a direction of the described system in the axes of the rotated one: azimuth φ − 90°.
fn from_described(direction: Dir<Facade>) -> Dir<Facade> {
    let v = direction.vector();
    Dir::from_unit(DVec3::new(v.y, -v.x, v.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Dir;
    use crate::compute::estimate::Silent;
    use crate::compute::system::measure::front_basis;
    use crate::compute::system::slats::{SlatArray, SlatModel, SlatProfile, Surface};
    use crate::compute::system::stack::DataLayer;

    #[test]
    fn a_panel_with_upright_cuts_turns_light_to_the_other_side() {
        use crate::compute::system::laser_cut::{CutPanel, LaserCutPanel};
        use crate::compute::system::measure::beams::SharpBeams;
        let sheet = crate::compute::system::panes::glazing::Pane { index: 1.5, thickness: 0.01, absorption: 0.0 };
        let panel = LaserCutPanel { sheet, spacing: 0.007 };
        let upright = Upright(Box::new(SharpBeams(CutPanel { panel, cut_loss: 0.0 })));
        let direction = Dir::from_theta_phi(0.8, 0.3);
        let shares = panel.shares(Dir::from_theta_phi(0.8, 0.3 + FRAC_PI_2), 0.0);
        for side in Side::BOTH {
            let beams = upright.beams(direction, side);
            let at = |x: f64, transmitted: bool| {
                let v = DVec3::new(x * direction.vector().x, direction.vector().y, direction.vector().z);
                let found =
                    |beam: &&Beam| beam.transmitted == transmitted && (beam.directions[0].vector() - v).length() < 1e-9;
                beams.iter().find(found).map_or(0.0, |beam| beam.share)
            };
            assert!((at(1.0, true) - shares.straight).abs() < 1e-9 && (at(-1.0, true) - shares.deflected).abs() < 1e-9);
            assert!(
                (at(1.0, false) - shares.mirrored).abs() < 1e-9 && (at(-1.0, false) - shares.returned).abs() < 1e-9
            );
        }
    }

    #[test]
    fn scattered_light_is_turned_as_the_measured_one() {
        let cells = front_basis();
        // Light that depends on the cell: a matrix of any values.
        let values = (0..145 * 145).map(|k| 0.001 * ((k * 7919) % 101) as f64).collect();
        let matrix = crate::compute::btdf::CellMatrix::new(cells.clone(), cells.clone(), values).unwrap();
        let mut band = crate::compute::btdf::Band::default();
        band.set(crate::compute::btdf::Component::TransmissionFront, crate::compute::btdf::Btdf::from_cells(matrix));
        let upright = Upright(Box::new(DataLayer(band)));
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
        let made = upright.measure(&setting, &Silent).unwrap();
        // A ring whose sectors are turned into each other by 90°.
        let i = cells.index(Dir::from_theta_phi(0.7, 0.4)).unwrap();
        let row = upright.scattered(cells.cell(i).centre(), Side::Front, &cells).transmitted;
        assert!(row.iter().zip(&made.front.transmitted[i * 145..]).all(|(a, b)| (a - b).abs() < 1e-12));
    }

    #[test]
    fn outer_edges_lowered_become_outer_edges_turned_left() {
        let slats =
            SlatArray::new(SlatProfile::Flat { width: 0.08 }, 0.0, 0.072, 0.6, [Surface::matt(0.5); 2]).unwrap();
        let cells = front_basis();
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
        let flat = DataLayer(SlatModel::new(slats).examine(&setting, &Silent).unwrap().0);
        let lying = flat.measure(&setting, &Silent).unwrap();
        let standing = Upright(Box::new(flat)).measure(&setting, &Silent).unwrap();
        let (a, b) = (lying.shares(&lying.front.transmitted), standing.shares(&standing.front.transmitted));
        let at = |degrees: f64| cells.index(Dir::from_theta_phi(0.7, degrees.to_radians())).unwrap();
        // What comes from above in the description comes from the right.
        assert!((a[at(90.0)] - b[at(0.0)]).abs() < 1e-12 && (a[at(270.0)] - b[at(180.0)]).abs() < 1e-12);
        assert!(b[at(180.0)] > 2.0 * b[at(0.0)]);
    }
}
