//! Interpolation within each triangle of incident directions: the treatment of its lobes, and the figures that decide
//! it.

use super::left_out::{Errors, LeftOut};
use super::model::Model;
use super::schemes::SunScheme;
use crate::compute::direction::Dir;
use glam::DVec3;
use rayon::prelude::*;

/// Share of the flux at the corners of a triangle below which lobes do not decide the treatment. Chosen: affects the
/// treatment that is shown, no light; one in a thousand is not visible.
const LEAST: f64 = 1e-3;

/// Treatment of the lobes of indicatrices in the interpolation within a triangle of incident directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Way {
    /// Shifted lobes: every lobe at a corner has a counterpart at the two other corners, and its centre is shifted
    /// between them.
    Moved,
    /// Fading lobes: at least one lobe has no counterpart at a corner; its flux decreases towards that corner, the
    /// other lobes are shifted.
    Faded,
    /// Blended bases: no corner has a lobe; the smooth indicatrices are added with barycentric weights.
    Blended,
    /// No light: τ is 0 at all corners.
    Dark,
}

impl Way {
    /// All treatments, in the order of the legend.
    pub const ALL: [Self; 4] = [Self::Moved, Self::Faded, Self::Blended, Self::Dark];
}

/// Triangle of three neighbouring incident directions, with the figures that decide how indicatrices are interpolated
/// in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangle {
    /// Incident directions at its corners as unit vectors, façade frame.
    pub corners: [DVec3; 3],
    /// Treatment of the lobes within the triangle.
    pub way: Way,
    /// Number of lobes of the indicatrix at each corner.
    pub lobes: [usize; 3],
    /// Share of the flux of the three indicatrices that is in lobes, 0 … 1.
    pub in_lobes: f64,
    /// Share of the flux in lobes whose lobe has counterparts at both other corners, 0 … 1.
    pub followed: f64,
    /// Largest angle between the centres of corresponding lobes at two corners. \[rad\]
    pub travel: f64,
    /// Stated uncertainty of each scheme in the triangle's middle, in the order of [`SunScheme::ALL`]: share of the
    /// transmitted flux that it sends in wrong directions.
    pub stated: Errors,
}

/// Returns all triangles of a model's incident directions, in the order of its triangulation. `left_out`:
/// cross-validation of the same model.
pub fn triangles(model: &Model, left_out: &LeftOut) -> Vec<Triangle> {
    model.lattice.triangles().par_iter().map(|vertices| triangle(model, left_out, *vertices)).collect()
}

/// Computes the treatment and the figures of the triangle between three incident directions, given by index.
fn triangle(model: &Model, left_out: &LeftOut, vertices: [usize; 3]) -> Triangle {
    let points = model.lattice.points();
    let corners = vertices.map(|v| points[v]);
    let (mut lobe_flux, mut followed, mut travel) = (0.0, 0.0, 0.0_f64);
    for v in vertices {
        for (l, lobe) in model.lobes[v].iter().enumerate() {
            let partner = |n: usize| {
                let k = model.lattice.neighbours(v).binary_search(&n).ok()?;
                Some(model.lobes[n][model.responses.partner[v][k][l]?].centre)
            };
            let others = vertices.into_iter().filter(|n| *n != v);
            let found: Vec<Option<DVec3>> = others.map(partner).collect();
            lobe_flux += lobe.flux;
            followed += if found.iter().all(Option::is_some) { lobe.flux } else { 0.0 };
            travel = found.into_iter().flatten().fold(travel, |most, to| most.max(lobe.centre.angle_between(to)));
        }
    }
    let all: f64 = lobe_flux + vertices.iter().map(|&v| model.base_flux[v]).sum::<f64>();
    let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
    let way = if all <= 0.0 {
        Way::Dark
    } else if lobe_flux <= LEAST * all {
        Way::Blended
    } else if lobe_flux - followed <= LEAST * all {
        Way::Moved
    } else {
        Way::Faded
    };
    let middle = model.lattice.locate(Dir::from_unit(corners.iter().sum::<DVec3>().normalize_or(DVec3::Z)));
    Triangle {
        corners,
        way,
        lobes: vertices.map(|v| model.lobes[v].len()),
        in_lobes: share(lobe_flux, all),
        followed: share(followed, lobe_flux),
        travel,
        stated: SunScheme::ALL.map(|scheme| left_out.stated(scheme, &middle)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::RingBasis;
    use crate::compute::btdf::Indicatrices;
    use crate::compute::direction::Incident;
    use std::sync::Arc;

    /// One value for each incident and emergent direction on Tregenza's directions.
    fn model(q: impl Fn(DVec3, DVec3) -> f64) -> Model {
        let (incident, cells) = (RingBasis::tregenza(), RingBasis::equal_area(24));
        let list: Vec<Incident> = incident.cells().map(|cell| Incident(cell.centre())).collect();
        let value = |from: &Incident| {
            let from = from.0.vector();
            cells.cells().map(|cell| q(from, cell.centre().vector())).collect::<Vec<f64>>()
        };
        let values = list.iter().flat_map(value).collect();
        Model::new(Arc::new(Indicatrices::new(list, cells, values).unwrap()))
    }

    fn count(list: &[Triangle], way: Way) -> usize {
        list.iter().filter(|one| one.way == way).count()
    }

    #[test]
    fn a_diffuser_is_blended_a_pane_moves_its_lobe_and_a_shutter_is_dark() {
        let all = |model: Model| triangles(&model, &LeftOut::new(&model));
        let diffuser = all(model(|_, _| 0.2));
        assert_eq!(count(&diffuser, Way::Blended), diffuser.len());
        assert!(diffuser.len() > 200 && diffuser.iter().all(|one| one.in_lobes < 1e-3), "{}", diffuser.len());
        // A lobe that follows the light.
        let pane = all(model(|from, to| 20.0 * (-(from.angle_between(to) / 0.12).powi(2)).exp()));
        assert!(count(&pane, Way::Moved) > pane.len() / 2, "{}", count(&pane, Way::Moved));
        let moved = pane.iter().find(|one| one.way == Way::Moved).unwrap();
        assert!(moved.followed > 0.999 && moved.travel > 0.05 && moved.lobes.iter().all(|n| *n > 0), "{moved:?}");
        let shutter = all(model(|_, _| 0.0));
        assert_eq!(count(&shutter, Way::Dark), shutter.len());
        // Light from above alone makes a lobe: it is missing on the other side of the edge.
        let blade = all(model(|from, to| {
            let lobe = (-(from.angle_between(to) / 0.12).powi(2)).exp();
            0.05 + if from.y > 0.0 { 20.0 * lobe } else { 0.0 }
        }));
        assert!(count(&blade, Way::Faded) > 3 && count(&blade, Way::Blended) > 20, "{:?}", count(&blade, Way::Faded));
    }
}
