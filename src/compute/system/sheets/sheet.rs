//! Plane sheets without a preferred direction: transmission and reflection depend on the polar angles θ_e (incident)
//! and θ_a (emergent) and the azimuth between the two. Mirrored and undeviated light, diffuse light, and a lobe about
//! the undeviated direction.
//!
//! Diffuse light is separable, q = τ(θ_e) τ(θ_a)/(π τ̄), the one reciprocal form whose total is τ(θ_e). The lobe is a
//! Gaussian in direction cosines k, q = d(θ_e) exp(−|k_e − k_a|²/2σ²) d(θ_a): every plane-parallel layer shifts
//! direction cosines, so that the kernel is symmetric in both directions; d is found such that the total is the given
//! τ(θ_e) (Sinkhorn's iteration in its symmetric form).

use super::lobe::Lobe;
use crate::compute::basis::{Cell, Ring, RingBasis};
use crate::compute::btdf::{AngularTransmittance, Band, Btdf, CellMatrix, Scattered, matrix_on};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::quadrature::{gauss_legendre, midpoints};
use crate::compute::scaling::by_rounds;
use crate::compute::system::measure::{Beam, Measured, OpticalModel, Quality, ScatteredLight, Setting, Side};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Distribution of transmitted (or reflected) light over regular, diffuse and lobe parts, as a function of the polar
/// angle of incidence.
#[derive(Debug, Clone)]
pub struct Spread {
    /// Regular share of the incident light, undeviated or mirrored, by polar angle of incidence.
    pub regular: AngularTransmittance,
    /// Diffuse share of the incident light, by polar angle of incidence; its q is separable, see the module head.
    pub diffuse: AngularTransmittance,
    /// Lobe about the undeviated or mirrored direction, if there is one.
    pub lobe: Option<Lobe>,
}

/// Optical model of a plane sheet. Its transmission is the same from both sides, its reflection may differ.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// Distribution of transmitted light, for light from either side.
    pub transmission: Spread,
    /// Distribution of reflected light, for light from outside and from inside.
    pub reflection: [Spread; 2],
}

impl Spread {
    /// Creates a distribution of Lambertian light only, with the same share of the incident light for every incident
    /// direction.
    pub const fn lambertian(share: f64) -> Self {
        Self {
            regular: AngularTransmittance::Constant(0.0),
            diffuse: AngularTransmittance::Constant(share),
            lobe: None,
        }
    }
}

impl OpticalModel for Sheet {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        let mut measured = Measured::dark(setting);
        let (through, through_error) = self.transmission.on(setting, progress)?;
        for (side, reflection) in Side::BOTH.into_iter().zip(&self.reflection) {
            let (reflected, error) = reflection.on(setting, progress)?;
            let (t, r) = (measured.shares(&through), measured.shares(&reflected));
            let seen = measured.seen_mut(side);
            seen.absorbed = t.iter().zip(&r).map(|(t, r)| (1.0 - t - r).max(0.0)).collect();
            seen.error = error.iter().zip(&through_error).map(|(a, b)| a.max(*b)).collect();
            (seen.transmitted, seen.reflected) = (through.clone(), reflected);
        }
        Ok(measured)
    }

    /// Computes the band with regular light stored separately as tables over the polar angle, and all other light on
    /// the cells.
    fn examine(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Band, Quality), Cancelled> {
        let quality = self.measure(setting, progress)?.quality();
        let separate = |spread: &Spread| -> Result<Btdf, Cancelled> {
            let nothing = AngularTransmittance::Constant(0.0);
            let scattered = Spread { regular: nothing, ..spread.clone() };
            let matrix = if scattered.is_dark() {
                None
            } else {
                let values = scattered.on(setting, progress)?.0;
                let matrix = CellMatrix::new(setting.incident.clone(), setting.emergent.clone(), values);
                Some(Scattered::Cells(Box::new(matrix.expect("values are counted by these cells"))))
            };
            let regular = (!spread.regular.is_dark()).then(|| spread.regular.clone());
            Ok(Btdf { regular, scattered: matrix })
        };
        let through = separate(&self.transmission)?;
        let band = Band {
            transmission_front: Some(through.clone()),
            transmission_back: Some(through),
            reflection_front: Some(separate(&self.reflection[0])?),
            reflection_back: Some(separate(&self.reflection[1])?),
        };
        Ok((band, quality))
    }

    /// Returns `true`: undeviated and mirrored light are stored separately, by the polar angle.
    fn separates_regular(&self) -> bool {
        true
    }

    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        let theta = direction.theta();
        let [straight, mirrored] = [&self.transmission, self.reflection(side)].map(|part| part.regular.at(theta));
        let beams = [Beam::through(direction, straight), Beam::back(direction, mirrored)];
        beams.into_iter().filter(|beam| beam.share > 0.0).collect()
    }

    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        let reflected = self.reflected(direction, side, emergent);
        ScatteredLight { reflected, ..self.scattered_through(direction, side, emergent) }
    }

    fn scattered_through(&self, direction: Dir<Facade>, _: Side, emergent: &RingBasis) -> ScatteredLight {
        self.transmitted_with(direction, emergent, self.transmission.diffuse.at(direction.theta()))
    }
}

impl Sheet {
    /// Returns the distribution of reflected light for light from `side`.
    const fn reflection(&self, side: Side) -> &Spread {
        match side {
            Side::Front => &self.reflection[0],
            Side::Back => &self.reflection[1],
        }
    }

    /// Computes the scattered transmitted light on emergent cells for light with the direction of undeviated light
    /// `direction`; `diffuse`: diffuse share of the incident light, instead of that of the tables.
    pub fn transmitted_with(&self, direction: Dir<Facade>, emergent: &RingBasis, diffuse: f64) -> ScatteredLight {
        let transmitted = self.transmission.of(direction, emergent, diffuse);
        ScatteredLight { transmitted, error: TOTALS, ..ScatteredLight::default() }
    }

    /// Computes q of the scattered reflected light, as means over the emergent cells, for light from `side` with the
    /// direction of undeviated light `direction`. \[1/sr\]
    pub fn reflected(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> Vec<f64> {
        let back = self.reflection(side);
        back.of(direction, emergent, back.diffuse.at(direction.theta()))
    }
}

/// Stated error of τ and ρ for single directions: they are scaled to the tables over θ, which reproduce their source to
/// this error. Chosen: above the largest error of the cubics between half degrees, 1.2e-5 for a surface of index 1.49
/// (at 89.8°).
const TOTALS: f64 = 1e-4;

/// Number of angles across a ring over which functions of θ are averaged. Chosen: cost; midpoints in sin²θ give the
/// transmittance of a surface to 6e-5 on the outermost Klems ring, where it is steepest, to 5e-7 on the others.
const RING: usize = 128;
/// Number of angles across a ring over which the shape of the light of single directions is averaged, on narrow rings.
/// Chosen: cost; Gauss' nodes in sin²θ give the transmittance of a surface to 3e-4 on the outermost Klems ring.
const NARROW: usize = 8;

/// Returns the mean of a function of θ over each cell; `rule`: nodes and weights across every ring.
fn ring_means(basis: &RingBasis, share: &AngularTransmittance, rule: &[(f64, f64)]) -> Vec<f64> {
    let mean = |ring: &Ring| std::iter::repeat_n(share.ring_mean(ring.theta_min, ring.theta_max, rule), ring.sectors);
    basis.rings().iter().flat_map(mean).collect()
}

impl Spread {
    /// Whether no light is scattered: no diffuse part and no lobe.
    fn is_dark(&self) -> bool {
        self.diffuse.is_dark() && self.lobe.is_none()
    }

    /// Returns the mean q over the emergent cells of the scattered light of one exact direction, with the diffuse share
    /// `diffuse` of the incident light. \[1/sr\] Empty if nothing is scattered.
    fn of(&self, direction: Dir<Facade>, emergent: &RingBasis, diffuse: f64) -> Vec<f64> {
        if self.is_dark() {
            return vec![];
        }
        let weight = emergent.projected_solid_angles();
        let flux = |q: &[f64]| q.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
        let mut values = vec![0.0; emergent.len()];
        // Each part has its shape from the cells and its total from the direction.
        let mut add = |shape: Vec<f64>, total: f64| {
            let found = flux(&shape);
            if found > 0.0 {
                values.iter_mut().zip(shape).for_each(|(q, shape)| *q += shape * (total / found));
            }
        };
        add(ring_means(emergent, &self.diffuse, &gauss_legendre(NARROW)), diffuse.max(0.0));
        if let Some(lobe) = &self.lobe {
            let shape = emergent.cells().map(|to| lobe.mean_about(direction, &to)).collect();
            add(shape, lobe.share().at(direction.theta()));
        }
        values
    }

    /// Returns q for all pairs of incident and emergent cells \[1/sr\], and the error of every incident cell's total.
    fn on(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Vec<f64>, Vec<f64>), Cancelled> {
        let (incident, emergent) = (setting.incident, setting.emergent);
        let straight = Btdf { regular: Some(self.regular.clone()), scattered: None };
        let (rule, coarse) = (midpoints(RING), midpoints(RING / 2));
        // The error of an average over a ring is below its difference from that with half the points.
        let mut error = vec![1e-6; incident.len()];
        let means = |basis: &RingBasis, share: &AngularTransmittance, error: &mut [f64]| {
            let (fine, coarse) = (ring_means(basis, share, &rule), ring_means(basis, share, &coarse));
            for ((error, fine), coarse) in error.iter_mut().zip(&fine).zip(coarse) {
                *error += (fine - coarse).abs();
            }
            fine
        };
        let mut values = matrix_on(&straight, incident, emergent).values().into_owned();
        if !self.diffuse.is_dark() {
            let (from, to) = (means(incident, &self.diffuse, &mut error), ring_means(emergent, &self.diffuse, &rule));
            // The mean over exactly these cells, so that totals come out exactly.
            let mean = emergent.projected_solid_angles().iter().zip(&to).map(|(w, t)| w * t).sum::<f64>() / PI;
            for (row, from) in values.chunks_exact_mut(emergent.len()).zip(&from) {
                for (q, to) in row.iter_mut().zip(&to) {
                    *q += from * to / (PI * mean);
                }
            }
        }
        if let Some(lobe) = &self.lobe {
            let weight = emergent.projected_solid_angles();
            let cells: Vec<Cell> = emergent.cells().collect();
            let totals = means(incident, lobe.share(), &mut error);
            let rows: Vec<Vec<f64>> = incident
                .cells()
                .collect::<Vec<_>>()
                .par_iter()
                .map(|from| {
                    if progress.cancelled() {
                        return Err(Cancelled);
                    }
                    let from = lobe.points(from);
                    Ok(cells.iter().map(|to| lobe.mean(&from, to)).collect())
                })
                .collect::<Result<_, Cancelled>>()?;
            // Totals as asked. On the same cells by factors of both directions, which keep reciprocity.
            let same = incident == emergent;
            let scale = if same {
                let sums = |scale: &[f64]| -> Vec<f64> {
                    let factors: Vec<f64> = scale.iter().zip(&weight).map(|(s, w)| s * w).collect();
                    rows.iter().map(|row| row.iter().zip(&factors).map(|(q, f)| q * f).sum()).collect()
                };
                let wanted: Vec<_> = totals.iter().map(|total| Some(*total)).collect();
                let scale = by_rounds(sums, &wanted, 40, 0.0, f64::INFINITY);
                let found = sums(&scale).into_iter().zip(&scale).map(|(sum, d)| d * sum);
                error.iter_mut().zip(found).zip(&totals).for_each(|((error, f), total)| *error += (f - total).abs());
                scale
            } else {
                let flux = |row: &[f64]| row.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
                let ratio = |(row, total): (&Vec<f64>, &f64)| if flux(row) > 0.0 { total / flux(row) } else { 0.0 };
                rows.iter().zip(&totals).map(ratio).collect()
            };
            for (i, row) in rows.iter().enumerate() {
                for (o, lobe) in row.iter().enumerate() {
                    let factor = if same { scale[i] * scale[o] } else { scale[i] };
                    values[i * emergent.len() + o] += factor * lobe;
                }
            }
        }
        Ok((values, error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::{AzimuthMap, cell_mean, sub_directions};
    use crate::compute::estimate::Silent;
    use crate::compute::system::measure::front_basis;

    fn sheet(spread: f64) -> Sheet {
        let tau =
            |share: f64| AngularTransmittance::sample(90, move |theta| share * (1.0 - (1.0 - theta.cos()).powi(5)));
        let transmission = Spread { regular: tau(0.1), diffuse: tau(0.2), lobe: Some(Lobe::new(tau(0.5), spread)) };
        Sheet { transmission, reflection: [Spread::lambertian(0.1), Spread::lambertian(0.15)] }
    }

    #[test]
    fn totals_and_reciprocity() {
        for (spread, emergent) in [(0.02, front_basis()), (0.15, front_basis()), (0.5, RingBasis::tregenza())] {
            let incident = front_basis();
            let setting = Setting { incident: &incident, emergent: &emergent, error: 0.01, seed: 1 };
            let made = sheet(spread).measure(&setting, &Silent).unwrap();
            let tau = made.shares(&made.front.transmitted);
            for (cell, tau) in incident.cells().zip(tau) {
                // The parts are tables of degrees: a few 1e-4 at grazing incidence.
                let exact = cell_mean(&cell, 60, |d| 0.8 * (1.0 - (1.0 - d.theta().cos()).powi(5)));
                assert!((tau - exact).abs() < 6e-4, "{spread}: {tau} {exact}");
            }
            let quality = made.quality();
            assert!(quality.balance < 1e-3 && quality.error < 2e-2, "{quality:?}");
            if let Some(error) = quality.reciprocity {
                assert!(error < 4e-3, "{spread}: {error}");
            }
        }
    }

    #[test]
    fn a_fine_emergent_lattice_shows_the_gaussian() {
        let incident = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT).refined(4);
        let emergent = incident.clone();
        let spread = 0.1;
        let setting = Setting { incident: &incident, emergent: &emergent, error: 0.01, seed: 1 };
        let made = Spread {
            regular: AngularTransmittance::Constant(0.0),
            diffuse: AngularTransmittance::Constant(0.0),
            lobe: Some(Lobe::new(AngularTransmittance::Constant(1.0), spread)),
        };
        let (values, _) = made.on(&setting, &Silent).unwrap();
        // Near the normal, d² = 1/(2πσ²), and q falls as the Gaussian does.
        let i = 0;
        for (o, cell) in emergent.cells().enumerate().take(200) {
            let apart = (cell.centre().vector().truncate() - incident.cell(i).centre().vector().truncate()).length();
            let exact = (-0.5 * (apart / spread).powi(2)).exp() / (2.0 * PI * spread * spread);
            let found = values[i * emergent.len() + o];
            // Cells beside the normal are sectors: their means are not quite the values at their centres.
            assert!((found - exact).abs() < 0.04 * 16.0, "{o}: {found} {exact}");
        }
    }

    #[test]
    fn single_directions_have_their_shares_and_the_measured_mean() {
        let cells = front_basis();
        let weight = cells.projected_solid_angles();
        let share = |q: &[f64]| q.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
        let sheet = sheet(0.15);
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
        let made = sheet.measure(&setting, &Silent).unwrap();
        for i in [0, 40, 100, 125] {
            let mut mean = vec![0.0; cells.len()];
            for direction in sub_directions(&cells.cell(i), 6) {
                let beams = sheet.beams(direction, Side::Front);
                let found = sheet.scattered(direction, Side::Front, &cells);
                let all = beams.iter().map(|beam| beam.share).sum::<f64>() + share(&found.transmitted);
                let exact = 0.8 * (1.0 - (1.0 - direction.theta().cos()).powi(5));
                assert!((all - exact).abs() < 2e-4, "{i}: {all} {exact}");
                assert!(beams.len() == 1 && (share(&found.reflected) - 0.1).abs() < 1e-12);
                mean.iter_mut().zip(&found.transmitted).for_each(|(mean, q)| *mean += q / 36.0);
                mean[i] += beams[0].share / weight[i] / 36.0;
            }
            let apart: f64 = (0..145).map(|o| (mean[o] - made.front.transmitted[i * 145 + o]).abs() * weight[o]).sum();
            assert!(apart < 0.015, "{i}: {apart}");
        }
    }

    #[test]
    fn a_lobe_of_one_direction_is_cut_by_cells_where_the_gaussian_is() {
        let cells = RingBasis::even(0.05);
        let spread = 0.08;
        let nothing = AngularTransmittance::Constant(0.0);
        let lobe = Some(Lobe::new(AngularTransmittance::Constant(1.0), spread));
        let made = Spread { regular: nothing.clone(), diffuse: nothing, lobe };
        let direction = Dir::from_theta_phi(0.2, 0.7);
        let centre = direction.vector().truncate();
        for (cell, q) in cells.cells().zip(made.of(direction, &cells, 0.0)) {
            let density = |d: Dir<Facade>| {
                let apart = (d.vector().truncate() - centre).length();
                (-0.5 * (apart / spread).powi(2)).exp() / (2.0 * PI * spread * spread)
            };
            let exact = cell_mean(&cell, 12, density);
            assert!((q - exact).abs() * cell.projected_solid_angle() < 2e-4, "{q} {exact}");
        }
    }
}
