//! The diffuse light of an aperture for eyes, hour by hour at the cost of a small product: luminance of the emergent cells
//! that an eye sees by what comes through each incident cell; and the outside straight through by fixed directions.
//!
//! For systems by their description, and those whose data are a pane's, even light, cells, single directions or a tree, before
//! an outside without boxes.

use crate::compute::basis::{Cell, RingBasis};
use crate::compute::btdf::{AngularTransmittance, Btdf, Scattered};
use crate::compute::direction::{Dir, Facade, Incident, World};
use crate::compute::dot::{add_scaled, dot};
use crate::compute::glare::Field;
use crate::compute::incidence::schemes::DiffuseScheme;
use crate::compute::lid::SkyThrough;
use crate::compute::lid::sky_columns::{PatchLight, ScatteredRows};
use crate::compute::quadrature::gauss_legendre;
use crate::compute::sky::Outside;
use crate::study::coefficients::{SPACING, incident_patches};
use crate::study::scene::Scene;
use crate::study::scene_file::Interpolation;
use crate::study::session::Session;
use crate::study::session::far;
use crate::study::session::sky_patches::SkyPatches;
use crate::study::session::sky_year::SkyYear;
use crate::study::system::VerySystem;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// One aperture, for some eyes.
pub(super) struct EyeLight {
    sky: Arc<SkyPatches>,
    /// What it is in the hours of the year, where that is kept.
    year: Option<Arc<SkyYear>>,
    /// A row for each emergent cell that any eye sees: open incident cells, then ground, then skyline.
    rows: Vec<f64>,
    width: usize,
    eyes: Vec<OfEye>,
    clear: f64,
}

/// What one eye sees.
struct OfEye {
    /// For every patch of the aperture, in the field's order, its rows.
    row: Vec<[Option<usize>; 2]>,
    /// The same for what is seen straight through: transmittance and direction; empty where nothing is.
    through: Vec<(f64, Dir<World>)>,
}

/// Can an aperture's diffuse light be had this way?
pub(super) fn is_tabled(scene: &Scene, index: usize) -> bool {
    let one = &scene.apertures[index];
    let Some(btdf) = one.transmission() else { return false };
    let scheme = matches!(scene.diffuse_interpolation, DiffuseScheme::Auto | DiffuseScheme::Shift);
    let by_directions = scheme || scene.interpolation == Interpolation::Patch;
    let by_data = by_directions || !matches!(btdf.scattered, Some(Scattered::Directions(_)));
    one.lamps.is_none() && (by_data || described(scene, index).is_some())
}

/// The description of an aperture's system, where it answers for the sky: it says more than its data.
fn described(scene: &Scene, index: usize) -> Option<&VerySystem> {
    let very = scene.apertures[index].system.very.as_ref();
    very.filter(|very| scene.beams && very.answers_for_the_sky())
}

impl EyeLight {
    /// `fields`: what each eye sees of all apertures; `year`: its number, and how many hours it has.
    pub fn new(
        session: &Session,
        scene: &Scene,
        index: usize,
        btdf: &Btdf,
        fields: &[Field],
        year: (u64, usize),
    ) -> Self {
        let own = described(scene, index).map(|very| session.sky_through(very));
        let (patches, spacing) = match &own {
            Some(own) => (RingBasis::clone(own.1.basis()), SPACING),
            None => incident_patches(btdf, scene.interpolation),
        };
        let sky = session.sky_patches(scene, index, patches, spacing);
        let emergent = match &own {
            Some(own) => Emergents::Described(&own.1, own.1.by_patch()),
            None => Emergents::new(session, scene, btdf),
        };
        let regular = btdf.regular.as_ref().filter(|_| own.is_none());
        // The emergent cells that eyes see, each once.
        let mut number = vec![None; emergent.count()];
        let mut seen = Vec::new();
        let eyes = fields
            .iter()
            .map(|field| {
                let own = &field.patches[field.of[index].clone()];
                let mut row_of = |cell: usize| {
                    *number[cell].get_or_insert_with(|| {
                        seen.push(cell);
                        seen.len() - 1
                    })
                };
                let row =
                    own.iter().map(|patch| emergent.index(patch.through).map(|cell| cell.map(&mut row_of))).collect();
                let through = regular.map_or_else(Vec::new, |tau: &AngularTransmittance| {
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
                let all = emergent.through(p, &sky.patches.cell(p));
                seen.iter().map(|&cell| all[cell]).collect()
            };
            (0..sky.patches.len()).into_par_iter().map(of).collect()
        };
        let width = sky.samples.cells().len() + 2;
        let mut rows = vec![0.0; seen.len() * width];
        if !columns.is_empty() {
            for (at, row) in rows.chunks_exact_mut(width).enumerate() {
                for (to, &p) in row.iter_mut().zip(sky.samples.cells()) {
                    *to = columns[p][at];
                }
                row[width - 2] = columns.iter().zip(&sky.ground).map(|(column, e)| column[at] * e).sum();
                row[width - 1] = columns.iter().zip(&sky.skyline).map(|(column, e)| column[at] * e).sum();
            }
        }
        let year = session.sky_year(year, sky.fingerprint, sky.samples.cells().len());
        Self { sky, year, rows, width, eyes, clear: scene.apertures[index].clear }
    }

    /// Luminances of the emergent cells in an hour of the year, whose outside this is. \[cd/m²\]
    pub fn cells(&self, hour: usize, outside: &Outside) -> Vec<f64> {
        if self.rows.is_empty() {
            return Vec::new();
        }
        let find = || {
            let mut light = Vec::with_capacity(self.width);
            self.sky.samples.illuminances(outside, &mut light);
            light
        };
        let mut light = self.year.as_ref().map_or_else(find, |year| year.hour(hour, find).collect());
        light.extend([outside.ground_luminance(), far::luminance(outside)]);
        self.rows.chunks_exact(self.width).map(|row| self.clear * dot(row, &light)).collect()
    }

    /// Adds what an eye sees to its patches of this aperture, given [`Self::cells`].
    pub fn add(&self, eye: usize, cells: &[f64], outside: &Outside, luminance: &mut [f64]) {
        let own = &self.eyes[eye];
        for (sum, row) in luminance.iter_mut().zip(&own.row) {
            *sum += row.iter().flatten().map(|&row| cells[row]).sum::<f64>();
        }
        for (sum, (tau, direction)) in luminance.iter_mut().zip(&own.through) {
            *sum += self.clear * tau * outside.luminance(*direction);
        }
    }
}

/// What a system makes of light from a patch of the hemisphere, on emergent cells.
enum Emergents<'a> {
    /// Nothing is scattered.
    None,
    /// The same in all directions.
    Even(&'a AngularTransmittance),
    /// By cells of a basis: how to get there.
    Cells(RingBasis, Rows<'a>),
    /// By a description: on cells, and behind these in bands of a profile angle.
    Described(&'a SkyThrough, Vec<PatchLight>),
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
            Self::Described(system, _) => match system.rows() {
                ScatteredRows::Bands([first, ..]) => system.basis().len() + first.q.len(),
                _ => system.basis().len(),
            },
        }
    }

    /// What a direction is seen by.
    fn index(&self, through: Dir<Facade>) -> [Option<usize>; 2] {
        match self {
            Self::None => [None; 2],
            Self::Even(_) => [Some(0), None],
            Self::Cells(basis, _) => [basis.index(through), None],
            Self::Described(system, _) => {
                let cells = system.basis();
                let band = match system.rows() {
                    ScatteredRows::Bands([first, ..]) => Some(cells.len() + first.band_of(through)),
                    _ => None,
                };
                [cells.index(through), band]
            }
        }
    }

    fn through(&self, patch: usize, cell: &Cell) -> Vec<f64> {
        match self {
            Self::None => Vec::new(),
            Self::Even(tau) => vec![tau.ring_mean(cell.theta_min, cell.theta_max, &gauss_legendre(3)) / PI],
            Self::Cells(_, rows) => rows(patch, cell),
            Self::Described(system, patches) => {
                let mut light = vec![0.0; self.count()];
                let (cells, bands) = light.split_at_mut(system.basis().len());
                let patch = &patches[patch];
                patch.cells.iter().for_each(|&(cell, luminance)| cells[cell] += luminance);
                for &(row, share) in &patch.rows {
                    match system.rows() {
                        ScatteredRows::None => {}
                        ScatteredRows::Bands(rows) => add_scaled(bands, &rows[row].q, share),
                        ScatteredRows::Cells(rows) => add_scaled(cells, &rows[row], share),
                    }
                }
                light
            }
        }
    }
}
