//! Scattered light that a system emits for incident light through each patch of its incident hemisphere, from data or
//! description.

use super::transport::{ACROSS, TREE_SAMPLED};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Btdf, Scattered};
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::lid::SkyThrough;
use crate::compute::lid::sky_columns::ScatteredRows;
use crate::compute::quadrature::gauss_legendre;
use crate::compute::system::measure::ProfileLight;
use crate::study::scene_file::Interpolation;
use crate::study::session::Session;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// Emergent cells or bands of the profile angle, each with its luminance per illuminance of the aperture. \[1/sr\]
pub(crate) type Luminances = Vec<(usize, f64)>;

/// Scattered light that a system emits for incident light through each patch of its incident hemisphere.
pub(crate) struct Sent {
    /// Basis of the emergent hemisphere.
    pub cells: Arc<RingBasis>,
    /// Bands of the profile angle, where the rows are by these: whether the angle is in the horizontal plane (vertical
    /// structures), and the number of bands.
    pub bands: Option<(bool, usize)>,
    /// Emergent distributions that many patches share, on cells or bands.
    pub rows: Vec<Luminances>,
    /// Emergent light for each incident patch.
    pub patches: Vec<Patch>,
}

/// Emergent light of a system for light through one incident patch, per illuminance through it.
#[derive(Default)]
pub(crate) struct Patch {
    /// Luminances of this patch alone, by emergent cell.
    pub own: Luminances,
    /// Shared distributions, by their indices in [`Sent::rows`], each with its factor.
    pub rows: Vec<(usize, f64)>,
}

/// Returns the cells with a value other than 0, each with its value.
pub(super) fn lit(row: &[f64]) -> Luminances {
    row.iter().copied().enumerate().filter(|(_, q)| *q != 0.0).collect()
}

impl Sent {
    /// Returns the number of emergent cells and bands together.
    pub fn count(&self) -> usize {
        self.cells.len() + self.bands.map_or(0, |(_, count)| count)
    }

    /// Returns the indices of the cell and the band that contain an emergent direction; bands are numbered after the
    /// cells. `through`: incident direction whose undeviated light leaves in the emergent direction.
    pub fn index(&self, through: Dir<Facade>) -> [Option<usize>; 2] {
        let band = |(upright, count)| {
            self.cells.len() + ProfileLight::band(ProfileLight::angle_of(upright, through), count).min(count - 1)
        };
        [self.cells.index(through), self.bands.map(band)]
    }

    /// Returns the luminances of all emergent cells and bands per illuminance through an incident patch. \[1/sr\]
    pub fn through(&self, patch: usize) -> Vec<f64> {
        let mut all = vec![0.0; self.count()];
        let first = if self.bands.is_some() { self.cells.len() } else { 0 };
        let Patch { own, rows } = &self.patches[patch];
        own.iter().for_each(|(cell, q)| all[*cell] += q);
        for (row, share) in rows {
            self.rows[*row].iter().for_each(|(place, q)| all[first + place] += share * q);
        }
        all
    }

    /// Creates the emergent light of a described system.
    pub fn described(through: &SkyThrough) -> Self {
        let (bands, rows) = match through.rows() {
            ScatteredRows::None => (None, Vec::new()),
            ScatteredRows::Bands(rows) => {
                (rows.first().map(|row| (row.upright, row.q.len())), rows.iter().map(|row| lit(&row.q)).collect())
            }
            ScatteredRows::Cells(rows) => (None, rows.iter().map(|row| lit(row)).collect()),
        };
        let patches = through.by_patch().into_iter().map(|patch| Patch { own: patch.cells, rows: patch.rows });
        Self { cells: Arc::clone(through.basis()), bands, rows, patches: patches.collect() }
    }

    /// Creates the emergent light of a system given by data, for the patches that suit them
    /// ([`super::transport::patches`]); `None` where nothing is scattered.
    pub fn of_data(session: &Session, btdf: &Btdf, interpolation: Interpolation, patches: &RingBasis) -> Option<Self> {
        let single = |row: usize, share: f64| Patch { own: Vec::new(), rows: vec![(row, share)] };
        let sent = |cells: &RingBasis, rows: Vec<Luminances>, patches: Vec<Patch>| {
            Some(Self { cells: Arc::new(cells.clone()), bands: None, rows, patches })
        };
        match btdf.scattered.as_ref()? {
            Scattered::Lambert(tau) => {
                let rule = gauss_legendre(ACROSS);
                let share = |cell: crate::compute::basis::Cell| tau.ring_mean(cell.theta_min, cell.theta_max, &rule);
                let patches = patches.cells().map(|cell| single(0, share(cell))).collect();
                sent(&RingBasis::hemisphere(), vec![vec![(0, 1.0 / PI)]], patches)
            }
            Scattered::Cells(matrix) => {
                let count = matrix.incident().len();
                let rows = (0..count).map(|i| lit(&matrix.row(i))).collect();
                sent(matrix.emergent(), rows, (0..count).map(|i| single(i, 1.0)).collect())
            }
            Scattered::Directions(data) if interpolation == Interpolation::Patch => {
                let rows = (0..data.incident().len()).map(|i| lit(&data.row(i))).collect();
                let near = |cell: crate::compute::basis::Cell| data.standing_for(cell.centre());
                let patches = patches.cells().map(|cell| near(cell).map_or_else(Patch::default, |i| single(i, 1.0)));
                sent(data.emergent(), rows, patches.collect())
            }
            Scattered::Directions(data) => {
                let interpolator = session.interpolator(data);
                let (model, grid) = (interpolator.model(), interpolator.model().grid());
                let rows = (0..data.incident().len()).map(|i| lit(&model.base(i))).collect();
                let of = |p: usize| {
                    let recipe = model.recipe(patches.cell(p).centre());
                    let (mut own, mut scratch) = (Vec::new(), Vec::new());
                    for copy in &recipe.copies {
                        model.moved(copy, grid, 1, &mut scratch);
                        own.extend(scratch.iter().map(|&(cell, q)| (cell as usize, q)));
                    }
                    Patch { own, rows: recipe.bases.iter().map(|base| (base.vertex, base.factor)).collect() }
                };
                let patches = (0..patches.len()).into_par_iter().map(of).collect();
                sent(grid.basis(), rows, patches)
            }
            Scattered::Tree(tree) => {
                let four = [(0.25, -0.25), (0.25, 0.25), (0.75, -0.25), (0.75, 0.25)];
                let points = if tree.incident_grid().len() > TREE_SAMPLED { &[(0.5, 0.0)][..] } else { &four };
                let of = |p: usize| {
                    let cell = patches.cell(p);
                    let mut sum = vec![0.0; tree.incident_grid().len()];
                    for d in points.iter().map(|point| super::transport::within(&cell, *point)) {
                        let q = tree.indicatrix(Incident(d)).q;
                        sum.iter_mut().zip(q).for_each(|(sum, q)| *sum += q / points.len() as f64);
                    }
                    Patch { own: lit(&sum), rows: Vec::new() }
                };
                let patches = (0..patches.len()).into_par_iter().map(of).collect();
                sent(&tree.incident_grid().rings(), Vec::new(), patches)
            }
        }
    }
}
