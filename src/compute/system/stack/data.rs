//! Layer of a stack given by the BSDF data of a file.

use crate::compute::basis::{Resampling, RingBasis, sub_directions};
use crate::compute::btdf::{AngularTransmittance, Band, Btdf, Component, matrix_on};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::measure::{Beam, Measured, OpticalModel, ScatteredLight, Setting, Side};

/// Optical model from BSDF data, e.g. of a file: means over requested cells; for single directions the values of the
/// data there, without interpolation between their incident cells.
pub struct DataLayer(pub Band);

/// Number of directions along either side of an emergent cell over which reversed transmission is averaged. Chosen:
/// cost; exact where the emergent cells are the incident cells of the data, as in the test
/// `rows_of_cells_and_the_regular_part_come_back`; a sample on others.
const BACKWARDS: usize = 3;

/// Returns the components of BSDF data that describe light from `side`: its transmission, the transmission from the
/// other side (the reverse), its reflection. They use the directions of undeviated light of
/// [`crate::compute::system::measure`].
const fn components(side: Side) -> [Component; 3] {
    match side {
        Side::Front => [Component::TransmissionFront, Component::TransmissionBack, Component::ReflectionFront],
        Side::Back => [Component::TransmissionBack, Component::TransmissionFront, Component::ReflectionBack],
    }
}

impl OpticalModel for DataLayer {
    /// Computes the means of the data over the cells of `setting`. A missing transmission is derived from the other
    /// side by reciprocity; a missing reflection counts as 0, and all light that does not pass as absorbed.
    fn measure(&self, setting: &Setting<'_>, _progress: &dyn Progress) -> Result<Measured, Cancelled> {
        let mut measured = Measured::dark(setting);
        let on = |component| {
            let btdf = self.0.get(component)?;
            Some(matrix_on(btdf, setting.incident, setting.emergent).values().into_owned())
        };
        let other = |component| {
            let matrix = matrix_on(self.0.get(component)?, setting.emergent, setting.incident);
            Some(matrix.reversed().values().into_owned())
        };
        for side in Side::BOTH {
            let [through, opposite, back] = components(side);
            let seen = measured.seen_mut(side);
            if let Some(values) = on(through).or_else(|| other(opposite)) {
                seen.transmitted = values;
            }
            if let Some(values) = on(back) {
                seen.reflected = values;
            }
            let (tau, rho) = (measured.shares(&measured.seen(side).transmitted), {
                let seen = measured.seen(side);
                measured.shares(&seen.reflected)
            });
            measured.seen_mut(side).absorbed = tau.iter().zip(&rho).map(|(t, r)| (1.0 - t - r).max(0.0)).collect();
        }
        Ok(measured)
    }

    /// Returns `false`, since more directions give no more detail than the cells of the data.
    fn is_quick(&self) -> bool {
        false
    }

    /// Returns the regular transmission and reflection of the data as beams; all other light, including narrow measured
    /// peaks, is in the scattered part.
    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        let [through, opposite, back] = components(side);
        let share = |btdf: Option<&Btdf>| {
            let regular: Option<&AngularTransmittance> = btdf.and_then(|btdf| btdf.regular.as_ref());
            regular.map_or(0.0, |tau| tau.at(direction.theta()))
        };
        // The undeviated share is the same from both sides.
        let tau = share(self.0.get(through).or_else(|| self.0.get(opposite)));
        let beams = [Beam::through(direction, tau), Beam::back(direction, share(self.0.get(back)))];
        beams.into_iter().filter(|beam| beam.share > 0.0).collect()
    }

    /// Returns the scattered light of the data for one direction, as means over the emergent cells.
    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        let [through, opposite, back] = components(side);
        let forwards = |btdf: &Btdf| {
            let found = btdf.indicatrix(Incident(direction))?;
            Some(if &found.basis == emergent {
                found.q
            } else {
                Resampling::new(&found.basis, emergent).apply(&found.q)
            })
        };
        let backwards = |btdf: &Btdf| {
            btdf.scattered.as_ref()?;
            let q = |d| btdf.q(Incident(d), Emergent::from_undeviated(direction));
            let mean = |cell| sub_directions(&cell, BACKWARDS).map(q).sum::<f64>() / (BACKWARDS * BACKWARDS) as f64;
            Some(emergent.cells().map(mean).collect())
        };
        let transmitted = match (self.0.get(through), self.0.get(opposite)) {
            (Some(btdf), _) => forwards(btdf),
            (None, other) => other.and_then(backwards),
        };
        ScatteredLight {
            transmitted: transmitted.unwrap_or_default(),
            reflected: self.0.get(back).and_then(forwards).unwrap_or_default(),
            error: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::CellMatrix;
    use crate::compute::estimate::Silent;
    use crate::compute::system::measure::front_basis;

    #[test]
    fn rows_of_cells_and_the_regular_part_come_back() {
        let cells = front_basis();
        let n = cells.len();
        let matrix = |seed: usize| {
            let values = (0..n * n).map(|k| 1e-3 * ((k * 7919 + seed) % 101) as f64).collect();
            CellMatrix::new(cells.clone(), cells.clone(), values).unwrap()
        };
        let mut band = Band::default();
        let regular = Some(AngularTransmittance::sample(180, |theta| 0.3 * theta.cos()));
        band.set(Component::TransmissionBack, Btdf { regular, ..Btdf::from_cells(matrix(1)) });
        band.set(Component::ReflectionFront, Btdf::from_cells(matrix(2)));
        let layer = DataLayer(band);
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
        let made = layer.measure(&setting, &Silent).unwrap();
        let weight = cells.projected_solid_angles();
        for side in Side::BOTH {
            for i in [3, 77, 110] {
                let direction = cells.cell(i).centre();
                let beams = layer.beams(direction, side);
                assert!(beams.len() == 1 && beams[0].directions[0] == direction && beams[0].transmitted);
                assert!((beams[0].share - 0.3 * direction.theta().cos()).abs() < 1e-4);
                let found = layer.scattered(direction, side, &cells);
                for o in (0..n).filter(|&o| o != i) {
                    assert!(
                        (found.transmitted[o] - made.seen(side).transmitted[i * n + o]).abs() < 1e-12,
                        "{side:?} {i} {o}"
                    );
                }
                // Here the mean over the cell is near the value at its centre.
                let all = found.transmitted[i] + beams[0].share / weight[i];
                assert!((all - made.seen(side).transmitted[i * n + i]).abs() * weight[i] < 0.01);
                if side == Side::Front {
                    assert!(found.reflected == made.front.reflected[i * n..(i + 1) * n]);
                } else {
                    assert!(found.reflected.is_empty());
                }
            }
        }
    }
}
