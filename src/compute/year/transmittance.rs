//! Directional-hemispherical transmittance of a system for any direction: reduced data for where only the total
//! transmitted flux is needed.
//!
//! | data | values |
//! | --- | --- |
//! | closed forms, trees | their own |
//! | cells | row sums; between the middles of cells linear in θ and φ, or constant on every cell |
//! | single directions | as cells where these are the middles of a lattice, else linear on triangles between them |
//! | described systems of the profile angle alone | direct, redirected and scattered light, each 1°, linear between |

use crate::compute::basis::{AzimuthMap, RingBasis, cell_mean};
use crate::compute::btdf::{AngularTransmittance, Btdf, Indicatrices, Scattered, TensorTree};
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::incidence::grid::Grid;
use crate::compute::incidence::lattice::Lattice;
use crate::compute::quadrature::gauss_legendre;
use crate::compute::system::measure::{OpticalModel, Side};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// Number of steps of the table over profile angle from −90° to 90°: 1° each. Chosen: cost; the interpolation between
/// them is part of the stated error. Held by the test `matt_slats_by_profile_are_those_of_the_goniophotometer` (error
/// below 0.01).
const STEPS: usize = 180;
/// Number of intervals of the table over profile angle whose middle is computed too, to estimate the error of the
/// interpolation: every tenth one. Chosen: cost; affects stated errors only.
const ASKED: usize = 18;
/// Number of directions along each side of a cell over which τ is averaged. Chosen: cost; results change within their
/// stated error, which cells of half the width show.
const POINTS: usize = 3;
/// Number of Gauss points across a ring for functions of the polar angle alone: exact for polynomials of degree 7.
const ACROSS: usize = 4;
/// Maximum number of cells of a division of the hemisphere over which transmitted light is summed up; light of finer
/// data is summed up over the Klems basis. Chosen: cost; held by the test
/// `cells_keep_their_sums_and_are_linear_between` (1 % for finer data).
const MOST_CELLS: usize = 400;
/// Step of the emergent cells over which scattered light is summed. \[rad\] Chosen: cost; only the sum over all cells
/// is used.
const EMERGENT: f64 = 10.0 * PI / 180.0;

/// Directional-hemispherical transmittance τ of a system, visible or solar, as a function of the incident direction.
#[derive(Debug, Clone)]
pub struct DirectionalTransmittance {
    regular: Option<AngularTransmittance>,
    scattered: Rest,
    error: f64,
}

/// Transmittance of the scattered light, by the kind of the data that it is computed from.
#[derive(Debug, Clone)]
enum Rest {
    None,
    Even(AngularTransmittance),
    /// Incident cells, and τ of each cell.
    Cells(Box<Grid>, Vec<f64>),
    Directions(Arc<Indicatrices>, Box<Lattice>),
    Tree(Box<TensorTree>),
    Profile {
        upright: bool,
        tau: Vec<f64>,
    },
}

/// Interpolation of τ between the incident directions of the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Between {
    /// Linear interpolation between the directions or cell centres of the data.
    Linear,
    /// Piecewise constant: one value per cell; for data at single directions, the value of the nearest one.
    Constant,
}

impl DirectionalTransmittance {
    /// Creates the transmittance from BSDF data; `error`: absolute uncertainty of the data's directional-hemispherical
    /// transmittances.
    pub fn of_data(btdf: &Btdf, error: f64) -> Self {
        let scattered = match &btdf.scattered {
            None => Rest::None,
            Some(Scattered::Lambert(tau)) => Rest::Even(tau.clone()),
            Some(Scattered::Cells(matrix)) => {
                Rest::Cells(Box::new(Grid::new(matrix.incident())), matrix.tau_by_cell().to_vec())
            }
            Some(Scattered::Directions(data)) => match data.lattice() {
                Some(basis) => Rest::Cells(Box::new(Grid::new(basis)), data.tau_by_direction().to_vec()),
                None => Rest::Directions(Arc::clone(data), Box::new(Lattice::new(data.incident()))),
            },
            Some(Scattered::Tree(tree)) => Rest::Tree(tree.clone()),
        };
        Self { regular: btdf.regular.clone(), scattered, error }
    }

    /// Creates the transmittance from the optical model of a described system, as a table over profile angle; `None` if
    /// the model's scattering depends on more than the profile angle.
    pub fn by_profile(model: &dyn OpticalModel) -> Option<Self> {
        let upright = model.by_profile_alone()?;
        let emergent = RingBasis::even(EMERGENT);
        let weights = emergent.projected_solid_angles();
        let at = |psi: f64| {
            let (sin, cos) = psi.sin_cos();
            let direction = Dir::from_unit(if upright { DVec3::new(sin, 0.0, cos) } else { DVec3::new(0.0, sin, cos) });
            let beams = model.beams(direction, Side::Front);
            let beams: f64 = beams.iter().filter(|beam| beam.transmitted).map(|beam| beam.share).sum();
            match model.profile_light(direction, Side::Front) {
                Some(light) => (beams + light.share(), light.error),
                None => {
                    let light = model.scattered(direction, Side::Front, &emergent).transmitted;
                    (beams + light.iter().zip(&weights).map(|(q, w)| q * w).sum::<f64>(), 0.0)
                }
            }
        };
        let step = PI / STEPS as f64;
        // At ±90° nothing comes; the outermost values are taken just inside.
        let angle = |k: f64| (k * step - FRAC_PI_2).clamp(0.1 * step - FRAC_PI_2, FRAC_PI_2 - 0.1 * step);
        let nodes: Vec<(f64, f64)> = (0..=STEPS).into_par_iter().map(|k| at(angle(k as f64))).collect();
        let tau: Vec<f64> = nodes.iter().map(|(tau, _)| *tau).collect();
        let uncertainty = nodes.iter().map(|(_, error)| *error).fold(0.0, f64::max);
        let gap = |k: usize| {
            let k = (2 * k + 1) * STEPS / (2 * ASKED);
            let (middle, _) = at(angle(k as f64 + 0.5));
            (middle - 0.5 * (tau[k] + tau[k + 1])).powi(2)
        };
        let between =
            ((0..ASKED).into_par_iter().map(gap).collect::<Vec<_>>().iter().sum::<f64>() / ASKED as f64).sqrt();
        Some(Self { regular: None, scattered: Rest::Profile { upright, tau }, error: uncertainty + between })
    }

    /// Returns the absolute uncertainty of τ, without that of the interpolation between directions of BSDF data.
    pub const fn error(&self) -> f64 {
        self.error
    }

    /// Returns τ for light from the incident direction `d` (towards the source, in the aperture's frame), 0 … 1 for
    /// data that transmit no more than they receive.
    pub fn at(&self, d: Dir<Facade>, between: Between) -> f64 {
        let theta = d.theta().min(FRAC_PI_2);
        let scattered = match (&self.scattered, between) {
            (Rest::None, _) => 0.0,
            (Rest::Even(tau), _) => tau.at(theta),
            (Rest::Cells(grid, tau), Between::Constant) => grid.basis().index(d).map_or(0.0, |cell| tau[cell]),
            (Rest::Cells(grid, tau), Between::Linear) => {
                let of = |(ring, sector, _, weight)| weight * tau[grid.basis().first_cell(ring) + sector];
                grid.around_rings(d.vector()).into_iter().map(of).sum()
            }
            (Rest::Directions(data, _), Between::Constant) => data.tau(Incident(d)),
            (Rest::Directions(data, lattice), Between::Linear) => {
                let (place, tau) = (lattice.locate(d), data.tau_by_direction());
                place.vertices.iter().zip(place.weights).map(|(vertex, weight)| weight * tau[*vertex]).sum()
            }
            (Rest::Tree(tree), _) => tree.tau(Incident(d)),
            (Rest::Profile { upright, tau }, _) => {
                let v = d.vector();
                let psi = if *upright { v.x } else { v.y }.atan2(v.z);
                let place = ((psi + FRAC_PI_2) / PI * STEPS as f64).clamp(0.0, STEPS as f64);
                let k = (place as usize).min(STEPS - 1);
                let t = place - k as f64;
                (1.0 - t) * tau[k] + t * tau[k + 1]
            }
        };
        scattered + self.regular.as_ref().map_or(0.0, |tau| tau.at(theta))
    }

    /// Returns the cells of the incident hemisphere over which transmitted light is summed up: those of the data, else
    /// the full Klems basis.
    pub fn cells(&self) -> RingBasis {
        match &self.scattered {
            Rest::Cells(grid, _) if self.knows_cells() => grid.basis().clone(),
            _ => RingBasis::klems_full(AzimuthMap::KLEMS_FRONT),
        }
    }

    /// Whether the data have one value of τ for each of the cells that [`Self::cells`] returns.
    pub fn knows_cells(&self) -> bool {
        matches!(&self.scattered, Rest::Cells(grid, _) if grid.basis().len() <= MOST_CELLS)
    }

    /// Returns the mean of τ over each of `cells`, weighted by projected solid angle.
    pub fn on(&self, cells: &RingBasis, between: Between) -> Vec<f64> {
        // What the data say of their own cells are such means already.
        if let (Rest::Cells(grid, tau), Between::Constant) = (&self.scattered, between)
            && grid.basis() == cells
        {
            let across = gauss_legendre(ACROSS);
            let regular = self.regular.as_ref();
            let of = |(cell, tau): (crate::compute::basis::Cell, &f64)| {
                tau + regular.map_or(0.0, |regular| regular.ring_mean(cell.theta_min, cell.theta_max, &across))
            };
            return cells.cells().zip(tau).map(of).collect();
        }
        let list: Vec<_> = cells.cells().collect();
        list.par_iter().map(|cell| cell_mean(cell, POINTS, |d| self.at(d, between))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::CellMatrix;
    use crate::compute::system::Family;
    use crate::compute::system::measure::Setting;
    use crate::compute::system::slats::{SlatProfile, Surface, Venetian};

    fn hemispherical(tau: &DirectionalTransmittance, between: Between) -> f64 {
        let cells = tau.cells();
        let weights = cells.projected_solid_angles();
        tau.on(&cells, between).iter().zip(weights).map(|(tau, w)| tau * w).sum::<f64>() / PI
    }

    /// Data that scatter uniformly, with a separate share for every cell.
    fn on_cells(incident: RingBasis, tau: impl Fn(Dir<Facade>) -> f64) -> Btdf {
        let emergent = RingBasis::hemisphere();
        let values = incident.cells().map(|cell| tau(cell.centre()) / PI).collect();
        Btdf::from_cells(CellMatrix::new(incident, emergent, values).unwrap())
    }

    #[test]
    fn cells_keep_their_sums_and_are_linear_between() {
        let smooth = |d: Dir<Facade>| 0.4 + 0.2 * d.vector().x + 0.3 * d.vector().y;
        for basis in [RingBasis::klems_full(AzimuthMap::KLEMS_FRONT), RingBasis::tregenza(), RingBasis::even(0.1)] {
            let btdf = on_cells(basis.clone(), smooth);
            let tau = DirectionalTransmittance::of_data(&btdf, 0.0);
            let whole = hemispherical(&tau, Between::Constant);
            // Very fine cells are gathered by coarser ones.
            let close = if tau.knows_cells() { 1e-12 } else { 1e-2 };
            assert!((whole - btdf.tau_hemispherical()).abs() < close * whole, "{}", basis.name());
            assert!((hemispherical(&tau, Between::Linear) / whole - 1.0).abs() < 0.01, "{}", basis.name());
            let d = Dir::from_theta_phi(0.8, 2.1);
            assert!((tau.at(d, Between::Linear) - smooth(d)).abs() < 0.02, "{}", basis.name());
            let cell = basis.cell(basis.len() / 3);
            assert!((tau.at(cell.centre(), Between::Linear) - smooth(cell.centre())).abs() < 1e-9);
        }
    }

    #[test]
    fn single_directions_are_linear_on_triangles() {
        let directions: Vec<Incident> = [0.0_f64, 0.5, 1.0]
            .iter()
            .flat_map(|theta| {
                let count = if *theta == 0.0 { 1 } else { 7 };
                (0..count)
                    .map(move |k| Incident(Dir::from_theta_phi(*theta, 2.0 * PI * f64::from(k) / f64::from(count))))
            })
            .collect();
        let values = directions.iter().map(|d| (0.5 + 0.3 * d.0.vector().y) / PI).collect();
        let data = Indicatrices::new(directions.clone(), RingBasis::hemisphere(), values).unwrap();
        let btdf = Btdf { regular: None, scattered: Some(Scattered::Directions(Arc::new(data))) };
        let tau = DirectionalTransmittance::of_data(&btdf, 0.0);
        let known = directions[4].0;
        assert!((tau.at(known, Between::Linear) - (0.5 + 0.3 * known.vector().y)).abs() < 1e-9);
        assert_eq!(tau.at(known, Between::Constant), btdf.tau(directions[4]));
        let d = Dir::from_theta_phi(0.3, 1.2);
        assert!((tau.at(d, Between::Linear) - (0.5 + 0.3 * d.vector().y)).abs() < 0.03);
    }

    #[test]
    fn matt_slats_by_profile_are_those_of_the_goniophotometer() {
        let matt = Surface::matt(0.5);
        let blind = Venetian {
            profile: SlatProfile::Flat { width: 0.08 },
            spacing: 0.072,
            thickness: 0.0,
            angles: vec![0.6],
            upper: matt,
            lower: matt,
        };
        let specimen = blind.optical_model(&blind.states()[0]).unwrap();
        let tau = DirectionalTransmittance::by_profile(specimen.as_ref()).unwrap();
        let cells = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.005, seed: 1 };
        let measured = specimen.measure(&setting, &crate::compute::estimate::Silent).unwrap();
        let shares = measured.shares(&measured.front.transmitted);
        for (cell, (own, other)) in tau.on(&cells, Between::Linear).iter().zip(&shares).enumerate() {
            assert!((own - other).abs() < 0.012 && (0.0..=1.0).contains(own), "cell {cell}: {own} {other}");
        }
        assert!(tau.error() < 0.01, "{}", tau.error());
        let turned =
            crate::compute::system::measure::upright::Upright(blind.optical_model(&blind.states()[0]).unwrap());
        let upright = DirectionalTransmittance::by_profile(&turned).unwrap();
        // What was up points to the right as seen from outside.
        let (up, right) = (Dir::from_theta_phi(0.9, FRAC_PI_2), Dir::from_theta_phi(0.9, 0.0));
        assert!((tau.at(up, Between::Linear) - upright.at(right, Between::Linear)).abs() < 1e-9);
    }
}
