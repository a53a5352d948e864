//! Schemes that move indicatrices as a whole, as the report has them: the nearest one, the nearest one displaced, and
//! three displaced and superposed. Right for one lobe; between two, the centroid lies where no light is.

use super::between::Between;
use super::blend::Blend;
use crate::compute::incidence::model::Model;
use glam::{DQuat, DVec3};

/// Mean direction of every indicatrix by flux; `None` where nothing gets through.
type Centroids = [Option<DVec3>];

/// The indicatrix of the nearest direction that lets anything through. Jumps half way between two directions.
pub(super) fn nearest(model: &Model, centroids: &Centroids, between: &Between) -> Blend {
    nearest_vertex(model, centroids, between)
        .map(|v| Blend::of_whole(model, v, DQuat::IDENTITY, between.tau))
        .unwrap_or_default()
}

/// The same, turned so that its flux centroid comes to the interpolated one. Its shape jumps half way.
pub(super) fn displaced_nearest(model: &Model, centroids: &Centroids, between: &Between) -> Blend {
    let Some(v) = nearest_vertex(model, centroids, between) else {
        return Blend::default();
    };
    Blend::of_whole(model, v, turn(centroids, v, centroid(centroids, between)), between.tau)
}

/// Every indicatrix around turned to the interpolated centroid, superposed with its barycentric weight.
pub(super) fn superposed(model: &Model, centroids: &Centroids, between: &Between) -> Blend {
    let to = centroid(centroids, between);
    let mut blend = Blend::default();
    for &(v, w) in &between.used {
        let tau = model.data.tau_by_direction()[v];
        blend.add(&Blend::of_whole(model, v, turn(centroids, v, to), w * tau), 1.0);
    }
    blend
}

fn nearest_vertex(model: &Model, centroids: &Centroids, between: &Between) -> Option<usize> {
    let cosine = |v: usize| model.lattice.points()[v].dot(between.direction);
    let open = between.used.iter().map(|&(v, _)| v).filter(|&v| centroids[v].is_some());
    open.max_by(|&a, &b| cosine(a).total_cmp(&cosine(b)).then(b.cmp(&a)))
}

/// Weighted mean of the flux centroids; `None` where they cancel.
fn centroid(centroids: &Centroids, between: &Between) -> Option<DVec3> {
    let sum: DVec3 = between.used.iter().filter_map(|&(v, w)| centroids[v].map(|c| c * w)).sum();
    sum.try_normalize().filter(|_| sum.length() > 1e-9)
}

fn turn(centroids: &Centroids, vertex: usize, to: Option<DVec3>) -> DQuat {
    match (centroids[vertex], to) {
        (Some(from), Some(to)) => DQuat::from_rotation_arc(from, to),
        _ => DQuat::IDENTITY,
    }
}
