//! The diffuse light of an aperture for eyes, hour by hour at the cost of a small product: luminance of the emergent cells
//! that an eye sees by what comes through each incident cell; and the outside straight through by fixed directions.
//!
//! For systems whose data are a pane's, even light, cells, single directions or a tree, before an outside without boxes.

use crate::compute::basis::{Cell, RingBasis};
use crate::compute::btdf::{AngularTransmittance, Btdf, Scattered};
use crate::compute::direction::{Dir, Facade, Incident, World};
use crate::compute::glare::Field;
use crate::compute::incidence::schemes::DiffuseScheme;
use crate::compute::quadrature::gauss_legendre;
use crate::compute::sky::{Distribution, Frame, Outside, SkySamples, incident_illuminances_within};
use crate::study::coefficients::incident_patches;
use crate::study::scene::Scene;
use crate::study::scene_file::Interpolation;
use crate::study::session::Session;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Accuracy of what ground and skyline send through each cell.
const EVEN: f64 = 1e-5;

/// One aperture, for some eyes.
pub(super) struct EyeLight {
    samples: SkySamples,
    /// A row for each emergent cell that any eye sees: open incident cells, then ground, then skyline.
    rows: Vec<f64>,
    width: usize,
    eyes: Vec<OfEye>,
    clear: f64,
}

/// What one eye sees.
struct OfEye {
    /// For every patch of the aperture, in the field's order, its row.
    row: Vec<Option<usize>>,
    /// The same for what is seen straight through: transmittance and direction; empty where nothing is.
    through: Vec<(f64, Dir<World>)>,
}

/// Can an aperture's diffuse light be had this way?
pub(super) fn is_tabled(scene: &Scene, index: usize) -> bool {
    let one = &scene.apertures[index];
    let Some(btdf) = one.system.dataset.transmission() else { return false };
    // A description that answers for the sky says more than its data.
    let described = scene.beams && one.system.very.as_ref().is_some_and(|very| very.answers_for_the_sky());
    let scheme = matches!(scene.diffuse_interpolation, DiffuseScheme::Auto | DiffuseScheme::Shift);
    let by_directions = scheme || scene.interpolation == Interpolation::Patch;
    one.lamps.is_none() && !described && (by_directions || !matches!(btdf.scattered, Some(Scattered::Directions(_))))
}

impl EyeLight {
    /// `fields`: what each eye sees of all apertures.
    pub fn new(session: &Session, scene: &Scene, index: usize, btdf: &Btdf, fields: &[Field]) -> Self {
        let frame = Frame::of_aperture(scene.orientation, scene.apertures[index].aperture.surface);
        let altitude = scene.outside.skyline_altitude();
        let (patches, spacing) = incident_patches(btdf, scene.interpolation);
        let samples = SkySamples::new(&patches, &frame, altitude, spacing);
        let emergent = Emergents::new(session, scene, btdf);
        // The emergent cells that eyes see, each once.
        let mut number = vec![None; emergent.count()];
        let mut seen = Vec::new();
        let eyes = fields
            .iter()
            .map(|field| {
                let own = &field.patches[field.of[index].clone()];
                let mut row_of = |through: Dir<Facade>| {
                    let cell = emergent.index(through)?;
                    Some(*number[cell].get_or_insert_with(|| {
                        seen.push(cell);
                        seen.len() - 1
                    }))
                };
                let row = own.iter().map(|patch| row_of(patch.through)).collect();
                let through = btdf.regular.as_ref().map_or_else(Vec::new, |tau: &AngularTransmittance| {
                    own.iter()
                        .map(|patch| {
                            let room = scene.apertures[index].aperture.surface.room_dir(patch.through);
                            (tau.at(patch.through.theta().min(FRAC_PI_2)), scene.orientation.world_from_room(room))
                        })
                        .collect()
                });
                OfEye { row, through }
            })
            .collect();
        let columns: Vec<Vec<f64>> = if seen.is_empty() {
            Vec::new()
        } else {
            let of = |p: usize| {
                let all = emergent.through(p, &patches.cell(p));
                seen.iter().map(|&cell| all[cell]).collect()
            };
            (0..patches.len()).into_par_iter().map(of).collect()
        };
        let width = samples.cells().len() + 2;
        let mut rows = vec![0.0; seen.len() * width];
        if !columns.is_empty() {
            let [ground, skyline] = constants(altitude).map(|outside| {
                outside.map_or_else(Vec::new, |o| incident_illuminances_within(&o, &patches, &frame, EVEN))
            });
            for (at, row) in rows.chunks_exact_mut(width).enumerate() {
                for (to, &p) in row.iter_mut().zip(samples.cells()) {
                    *to = columns[p][at];
                }
                row[width - 2] = columns.iter().zip(&ground).map(|(column, e)| column[at] * e.value).sum();
                row[width - 1] = columns.iter().zip(&skyline).map(|(column, e)| column[at] * e.value).sum();
            }
        }
        Self { samples, rows, width, eyes, clear: scene.apertures[index].clear }
    }

    /// Luminances of the emergent cells under an outside. \[cd/m²\]
    pub fn cells(&self, outside: &Outside) -> Vec<f64> {
        if self.rows.is_empty() {
            return Vec::new();
        }
        let mut light = Vec::with_capacity(self.width);
        self.samples.illuminances(outside, &mut light);
        light.extend([outside.ground_luminance(), outside.skyline_luminance()]);
        let of = |row: &[f64]| self.clear * row.iter().zip(&light).map(|(q, e)| q * e).sum::<f64>();
        self.rows.chunks_exact(self.width).map(of).collect()
    }

    /// Adds what an eye sees to its patches of this aperture, given [`Self::cells`].
    pub fn add(&self, eye: usize, cells: &[f64], outside: &Outside, luminance: &mut [f64]) {
        let own = &self.eyes[eye];
        for (sum, row) in luminance.iter_mut().zip(&own.row) {
            *sum += row.map_or(0.0, |row| cells[row]);
        }
        for (sum, (tau, direction)) in luminance.iter_mut().zip(&own.through) {
            *sum += self.clear * tau * outside.luminance(*direction);
        }
    }
}

/// Black sky with a ground of luminance 1, and with a skyline of luminance 1 where it stands above the horizon.
fn constants(altitude: f64) -> [Option<Outside>; 2] {
    let black = || Outside::new(Distribution::uniform(), 0.0).ok();
    [
        black().and_then(|outside| outside.with_skyline(altitude, 0.0).ok()?.with_ground(1.0, PI).ok()),
        black().filter(|_| altitude > 0.0).and_then(|outside| outside.with_skyline(altitude, 1.0).ok()),
    ]
}

/// What a system makes of light from a patch of the hemisphere, on emergent cells.
enum Emergents<'a> {
    /// Nothing is scattered.
    None,
    /// The same in all directions.
    Even(&'a AngularTransmittance),
    /// By cells of a basis: how to get there.
    Cells(RingBasis, Rows<'a>),
}

/// Luminance of the cells per illuminance through an incident patch.
type Rows<'a> = Box<dyn Fn(usize, &Cell) -> Vec<f64> + Sync + 'a>;

impl<'a> Emergents<'a> {
    fn new(session: &Session, scene: &Scene, btdf: &'a Btdf) -> Self {
        match &btdf.scattered {
            None => Self::None,
            Some(Scattered::Lambert(tau)) => Self::Even(tau),
            Some(Scattered::Cells(matrix)) => {
                Self::Cells(matrix.emergent().clone(), Box::new(|i, _| matrix.row(i).into_owned()))
            }
            Some(Scattered::Directions(data)) if scene.interpolation == Interpolation::Patch => {
                let dark = vec![0.0; data.emergent().len()];
                let row = move |_: usize, cell: &Cell| {
                    data.standing_for(cell.centre()).map_or_else(|| dark.clone(), |i| data.row(i).into_owned())
                };
                Self::Cells(data.emergent().clone(), Box::new(row))
            }
            Some(Scattered::Directions(data)) => {
                let interpolator = session.interpolator(data);
                let bases: Vec<Vec<f64>> =
                    (0..data.incident().len()).map(|vertex| interpolator.model().base(vertex)).collect();
                let basis = interpolator.model().grid().basis().clone();
                let row = move |_: usize, cell: &Cell| {
                    let model = interpolator.model();
                    let recipe = model.recipe(cell.centre());
                    let mut q = vec![0.0; model.grid().basis().len()];
                    for base in &recipe.bases {
                        q.iter_mut().zip(&bases[base.vertex]).for_each(|(sum, q)| *sum += base.factor * q);
                    }
                    let mut lobe = Vec::new();
                    for copy in &recipe.copies {
                        model.moved(copy, model.grid(), 1, &mut lobe);
                        lobe.iter().for_each(|&(cell, value)| q[cell as usize] += value);
                    }
                    q
                };
                Self::Cells(basis, Box::new(row))
            }
            Some(Scattered::Tree(tree)) => {
                let row = move |_: usize, cell: &Cell| {
                    let mut sum = Vec::new();
                    for (s, t) in [(0.25, -0.25), (0.25, 0.25), (0.75, -0.25), (0.75, 0.25)] {
                        let [a, b] = [cell.theta_min, cell.theta_max].map(|theta| theta.sin().powi(2));
                        let d = Dir::from_theta_phi((a + (b - a) * s).sqrt().asin(), cell.phi + t * cell.width);
                        let q = tree.indicatrix(Incident(d)).q;
                        sum.resize(q.len(), 0.0);
                        sum.iter_mut().zip(&q).for_each(|(sum, q)| *sum += 0.25 * q);
                    }
                    sum
                };
                Self::Cells(tree.incident_grid().rings(), Box::new(row))
            }
        }
    }

    fn count(&self) -> usize {
        match self {
            Self::None => 0,
            Self::Even(_) => 1,
            Self::Cells(basis, _) => basis.len(),
        }
    }

    fn index(&self, through: Dir<Facade>) -> Option<usize> {
        match self {
            Self::None => None,
            Self::Even(_) => Some(0),
            Self::Cells(basis, _) => basis.index(through),
        }
    }

    fn through(&self, patch: usize, cell: &Cell) -> Vec<f64> {
        match self {
            Self::None => Vec::new(),
            Self::Even(tau) => vec![tau.ring_mean(cell.theta_min, cell.theta_max, &gauss_legendre(3)) / PI],
            Self::Cells(_, rows) => rows(patch, cell),
        }
    }
}
