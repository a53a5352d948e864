//! Schemes that move indicatrices as a whole, as the report has them: the nearest one, the nearest one displaced, and
//! three displaced and superposed. Right for one lobe; between two, the centroid lies where no light is.

use super::blend::Blend;
use super::{Between, Schemes};
use glam::{DQuat, DVec3};

/// The indicatrix of the nearest direction that lets anything through. Jumps half way between two directions.
pub(super) fn nearest(schemes: &Schemes, between: &Between) -> Blend {
    nearest_vertex(schemes, between)
        .map(|v| Blend::of_whole(&schemes.model, v, DQuat::IDENTITY, between.tau))
        .unwrap_or_default()
}

/// The same, turned so that its flux centroid comes to the interpolated one. Its shape jumps half way.
pub(super) fn displaced_nearest(schemes: &Schemes, between: &Between) -> Blend {
    let Some(v) = nearest_vertex(schemes, between) else {
        return Blend::default();
    };
    Blend::of_whole(&schemes.model, v, turn(schemes, v, centroid(schemes, between)), between.tau)
}

/// Every indicatrix around turned to the interpolated centroid, superposed with its barycentric weight.
pub(super) fn superposed(schemes: &Schemes, between: &Between) -> Blend {
    let to = centroid(schemes, between);
    let mut blend = Blend::default();
    for &(v, w) in &between.used {
        let tau = schemes.model.data.tau_by_direction()[v];
        blend.add(&Blend::of_whole(&schemes.model, v, turn(schemes, v, to), w * tau), 1.0);
    }
    blend
}

fn nearest_vertex(schemes: &Schemes, between: &Between) -> Option<usize> {
    let cosine = |v: usize| schemes.model.lattice.points()[v].dot(between.direction);
    let open = between.used.iter().map(|&(v, _)| v).filter(|&v| schemes.centroid[v].is_some());
    open.max_by(|&a, &b| cosine(a).total_cmp(&cosine(b)).then(b.cmp(&a)))
}

/// Weighted mean of the flux centroids; `None` where they cancel.
fn centroid(schemes: &Schemes, between: &Between) -> Option<DVec3> {
    let sum: DVec3 = between.used.iter().filter_map(|&(v, w)| schemes.centroid[v].map(|c| c * w)).sum();
    (sum.length() > 1e-9).then(|| sum.normalize())
}

fn turn(schemes: &Schemes, vertex: usize, to: Option<DVec3>) -> DQuat {
    match (schemes.centroid[vertex], to) {
        (Some(from), Some(to)) => DQuat::from_rotation_arc(from, to),
        _ => DQuat::IDENTITY,
    }
}
