//! V·T: illuminance at every sensor per illuminance of an aperture from one incident direction or through one incident
//! patch.

use super::views::{Opening, SensorRows, Views, Want, even};
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::btdf::{AngularTransmittance, Btdf, CellMatrix, Indicatrices, Scattered, TensorTree};
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::incidence::superpose::{REST, sub_patches};
use crate::compute::lid::Interpolator;
use crate::compute::quadrature::gauss_legendre;
use crate::study::error::StudyError;
use crate::study::scene_file::Interpolation;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// Size of the incident patches for systems whose data do not define any. \[rad\]
const PATCH: f64 = 4.5 * PI / 180.0;
/// Maximum number of incident cells of a tensor tree that is evaluated by its own cells; trees with more are evaluated
/// on sub-patches.
const TREE_CELLS: usize = 4096;
/// Maximum number of incident cells of a tensor tree that is evaluated at four points of each cell; trees with more are
/// evaluated at the centres only.
pub(super) const TREE_SAMPLED: usize = 1024;
/// Size of the incident patches on which lobes are interpolated. \[rad\]
const SUB_PATCH: f64 = 2.5 * PI / 180.0;
/// Maximum distance between the directions in which a sky is evaluated, for incident patches as wide as those of
/// datasets. \[rad\]
pub(crate) const SPACING: f64 = 4.0 * PI / 180.0;
/// Number of Gauss points in θ for the mean of τ over a ring of patches.
pub(super) const ACROSS: usize = 3;
/// Relative error of the illuminances behind a tensor tree, because its square cells are replaced by cells of rings.
const TREE_CELL_ERROR: f64 = 5e-3;

/// Response of the sensors to light that the system of one aperture scatters.
pub(super) enum Transport {
    /// System that scatters nothing.
    Straight,
    /// Lambertian system: its transmittance τ, and the illuminances at the sensors for a uniform luminance of 1 cd/m².
    Even(AngularTransmittance, SensorRows),
    /// Patch-averaged data: basis of incident cells, with the illuminances at the sensors per illuminance through each.
    Cells(RingBasis, Vec<SensorRows>),
    /// Data at single directions of which the nearest is used, with the illuminances at the sensors per illuminance
    /// from each.
    Nearest(Arc<Indicatrices>, Vec<SensorRows>),
    /// Data at single directions between which lobes are interpolated.
    Lobes(Box<Lobes>),
    /// Tensor tree, with the responses of the sensors to the luminances of its emergent cells.
    Tree(Box<TensorTree>, Views),
}

/// Lobes that move with the incident direction. Light that does not move (the bases) is stored as illuminances at the
/// sensors, the lobes are evaluated by emergent cells.
pub(super) struct Lobes {
    interpolator: Arc<Interpolator>,
    bases: Vec<SensorRows>,
    views: Views,
    /// Responses of the sensors to luminances on finer cells, for the sun; `None` where the data's cells are as good.
    fine: Option<Views>,
}

/// Illuminances at the sensors for light from one incident direction, per illuminance of the aperture. \[lx/lx\]
pub(super) struct Column {
    /// Illuminances in three rows (all light, its interreflected part, the uncertainty of that part), see
    /// [`SensorRows`].
    pub light: SensorRows,
    /// Difference between a simpler interpolation of the data and the one used, with its sign, by sensor: measure of
    /// the uncertainty by interpolation. Empty where nothing is interpolated.
    pub difference: Vec<f64>,
}

/// Returns the basis of the incident hemisphere that suits a system's data, and the maximum distance between the
/// directions in which a sky is evaluated on it. \[rad\]
pub(crate) fn patches(btdf: &Btdf, interpolation: Interpolation) -> (RingBasis, f64) {
    match &btdf.scattered {
        None | Some(Scattered::Lambert(_)) => (sub_patches(PATCH), SPACING),
        Some(Scattered::Cells(matrix)) => (matrix.incident().clone(), SPACING),
        Some(Scattered::Directions(data)) if interpolation == Interpolation::Patch => {
            (data.lattice().cloned().unwrap_or_else(|| RingBasis::equal_area(40)), SPACING)
        }
        Some(Scattered::Directions(_)) => (sub_patches(SUB_PATCH), SUB_PATCH),
        Some(Scattered::Tree(tree)) => {
            let grid = tree.incident_grid();
            (if grid.len() <= TREE_CELLS { grid.rings() } else { sub_patches(SUB_PATCH) }, SPACING)
        }
    }
}

/// Returns an incident direction in a cell. `s`: position in its range of sin²θ, 0 … 1; `t`: offset in azimuth from its
/// middle, as a share of its width.
pub(super) fn within(cell: &Cell, (s, t): (f64, f64)) -> Dir<Facade> {
    let (a, b) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
    Dir::from_theta_phi((a + (b - a) * s).sqrt().asin(), cell.phi + t * cell.width)
}

/// Computes the illuminances at the sensors for every row of a system's data. `views`: responses of the sensors to
/// emergent luminances; `row`: luminances per illuminance in a row. \[1/sr\]
fn lights(views: &Views, count: usize, row: impl Fn(usize) -> Vec<f64> + Sync) -> Vec<SensorRows> {
    let light = |i: usize| {
        let mut light = vec![0.0; views.width()];
        views.add_all(&row(i), &mut light);
        light
    };
    (0..count).into_par_iter().map(light).collect()
}

impl Transport {
    /// Computes the response of the sensors to the scattered light of an aperture's system.
    pub fn new(opening: &Opening<'_>, btdf: &Btdf) -> Result<Self, StudyError> {
        let Opening { session, scene, .. } = *opening;
        let views = |basis: &RingBasis, want: Want| Views::new(opening, Arc::new(basis.clone()), want);
        Ok(match &btdf.scattered {
            None => Self::Straight,
            Some(Scattered::Lambert(tau)) => Self::Even(tau.clone(), even(opening)?),
            Some(Scattered::Cells(matrix)) => {
                let matrix: &CellMatrix = matrix;
                let views = views(matrix.emergent(), Want::All)?;
                // An incident cell is the same all over: only its light at the sensors is needed, so that the views
                // may be dropped.
                let columns = lights(&views, matrix.incident().len(), |i| matrix.row(i).into_owned());
                Self::Cells(matrix.incident().clone(), columns)
            }
            Some(Scattered::Directions(data)) if scene.interpolation == Interpolation::Patch => {
                let views = views(data.emergent(), Want::All)?;
                let columns = lights(&views, data.incident().len(), |i| data.row(i).into_owned());
                Self::Nearest(Arc::clone(data), columns)
            }
            Some(Scattered::Directions(data)) => {
                let interpolator = session.interpolator(data);
                let (own, sun) = (interpolator.model().grid().basis(), interpolator.sun_grid().basis());
                let views_of_data = views(own, Want::All)?;
                // Light that does not move with incidence is summed at once; lobes move with the sun and need the
                // views.
                let bases = lights(&views_of_data, data.incident().len(), |i| interpolator.model().base(i));
                // A narrow lobe of the sun would jump between the data's cells. For the finer ones the sum is enough:
                // the error is that of the data's own.
                let fine = if sun == own { None } else { Some(views(sun, Want::Sum)?) };
                Self::Lobes(Box::new(Lobes { interpolator, bases, views: views_of_data, fine }))
            }
            // Trees have too many cells for a row each to be kept: theirs are computed when a direction is needed.
            Some(Scattered::Tree(tree)) => Self::Tree(tree.clone(), views(&tree.incident_grid().rings(), Want::All)?),
        })
    }

    /// Returns an estimate of the relative error of the computed illuminances that other stated errors do not contain:
    /// of interpolated lobes, or of a tensor tree's cells; 0 for other data.
    pub fn relative_error(&self) -> f64 {
        match self {
            Self::Lobes(_) => REST,
            Self::Tree(..) => TREE_CELL_ERROR,
            _ => 0.0,
        }
    }

    /// Whether [`Column::light`] contains the uncertainty of diffuse light by the data, so that it need not be added.
    pub fn estimates_uncertainty(&self) -> bool {
        matches!(self, Self::Lobes(_))
    }

    /// Computes the illuminances at the sensors per illuminance through the incident patch `cell`, which has the index
    /// `index` in the basis of [`patches`].
    pub fn through_patch(&self, index: usize, cell: &Cell, sensors: usize) -> Column {
        match self {
            Self::Even(tau, even) => {
                Column::scaled(even, tau.ring_mean(cell.theta_min, cell.theta_max, &gauss_legendre(ACROSS)) / PI)
            }
            Self::Cells(_, columns) => Column::scaled(&columns[index], 1.0),
            Self::Tree(tree, views) => {
                let mut column = Column::dark(sensors);
                let four = [(0.25, -0.25), (0.25, 0.25), (0.75, -0.25), (0.75, 0.25)];
                let points = if tree.incident_grid().len() > TREE_SAMPLED { &[(0.5, 0.0)][..] } else { &four };
                for d in points.iter().map(|point| within(cell, *point)) {
                    let mut q = tree.indicatrix(Incident(d)).q;
                    q.iter_mut().for_each(|q| *q /= points.len() as f64);
                    views.add_all(&q, &mut column.light);
                }
                column
            }
            _ => self.for_direction(cell.centre(), sensors),
        }
    }

    /// Computes the illuminances at the sensors per illuminance of the aperture from one incident direction, such as
    /// that of the sun.
    pub fn for_direction(&self, d: Dir<Facade>, sensors: usize) -> Column {
        match self {
            Self::Straight => Column::dark(sensors),
            Self::Even(tau, even) => Column::scaled(even, tau.at(d.theta().min(0.5 * PI)) / PI),
            Self::Cells(basis, columns) => {
                basis.index(d).map_or_else(|| Column::dark(sensors), |cell| Column::scaled(&columns[cell], 1.0))
            }
            Self::Nearest(data, columns) => {
                data.standing_for(d).map_or_else(|| Column::dark(sensors), |i| Column::scaled(&columns[i], 1.0))
            }
            Self::Lobes(lobes) => lobes.for_direction(d, sensors),
            Self::Tree(tree, views) => {
                let mut column = Column::dark(sensors);
                views.add_all(&tree.indicatrix(Incident(d)).q, &mut column.light);
                column
            }
        }
    }

    /// Adds the illuminances at the sensors by the sun in the incident direction `d` to `out` \[lx\]. `illuminance`:
    /// illuminance of the aperture by the sun \[lx\]. Unlike [`Self::for_direction`], it evaluates lobes on finer
    /// cells; then only the first row (all light) is added.
    pub fn sun(&self, d: Dir<Facade>, sensors: usize, out: &mut [f64], illuminance: f64) {
        match self {
            Self::Lobes(lobes) if lobes.fine.is_some() => lobes.sun(d, out, illuminance),
            _ => {
                let column = self.for_direction(d, sensors);
                out.iter_mut().zip(&column.light).for_each(|(sum, e)| *sum += e * illuminance);
            }
        }
    }
}

impl Lobes {
    /// Computes the illuminances at the sensors per illuminance from an incident direction, as the sum of bases and
    /// lobes.
    fn for_direction(&self, d: Dir<Facade>, sensors: usize) -> Column {
        let mut column = Column::dark(sensors);
        column.difference = vec![0.0; sensors];
        let (model, grid) = (self.interpolator.model(), self.interpolator.model().grid());
        let recipe = model.recipe(d);
        for base in &recipe.bases {
            let light = &self.bases[base.vertex];
            column.light.iter_mut().zip(light).for_each(|(sum, e)| *sum += base.factor * e);
            column.difference.iter_mut().zip(light).for_each(|(sum, e)| *sum += (base.linear - base.factor) * e);
        }
        let mut scratch = Vec::new();
        let mut lobe = vec![0.0; self.views.width()];
        for copy in &recipe.copies {
            model.moved(copy, grid, 1, &mut scratch);
            lobe.fill(0.0);
            scratch.iter().for_each(|&(cell, q)| self.views.add(cell as usize, q, &mut lobe));
            let difference = copy.linear / copy.flux - 1.0;
            column.light.iter_mut().zip(&lobe).for_each(|(sum, e)| *sum += e);
            column.difference.iter_mut().zip(&lobe).for_each(|(sum, e)| *sum += difference * e);
        }
        column
    }

    /// Adds the illuminances at the sensors by the sun in the incident direction `d` to `out` \[lx\], with lobes on the
    /// finer cells. `illuminance`: illuminance of the aperture by the sun. \[lx\]
    fn sun(&self, d: Dir<Facade>, out: &mut [f64], illuminance: f64) {
        let (model, grid) = (self.interpolator.model(), self.interpolator.sun_grid());
        let recipe = model.recipe(d);
        for base in &recipe.bases {
            let factor = base.factor * illuminance;
            out.iter_mut().zip(&self.bases[base.vertex]).for_each(|(sum, e)| *sum += factor * e);
        }
        let mut scratch = Vec::new();
        if let Some(fine) = &self.fine {
            for copy in &recipe.copies {
                model.moved(copy, grid, SUN_POINTS, &mut scratch);
                scratch.iter().for_each(|&(cell, q)| fine.add(cell as usize, q * illuminance, out));
            }
        }
    }
}

/// Number of points along each side of an emergent cell at which a lobe of the sun is evaluated.
const SUN_POINTS: usize = 2;

impl Column {
    fn dark(sensors: usize) -> Self {
        Self { light: vec![0.0; 3 * sensors], difference: Vec::new() }
    }

    fn scaled(light: &[f64], factor: f64) -> Self {
        Self { light: light.iter().map(|e| e * factor).collect(), difference: Vec::new() }
    }
}
