//! Base and matched lobes: bases blended, lobes of neighbouring directions paired by place and flux, and each turned to
//! the weighted mean of its partners.
//!
//! Pairs are made between two directions at a time and do not depend on which comes first, so that the two triangles
//! at an edge agree on it. A pivot per triangle, which decides for all three, would jump there.

use super::between::Between;
use super::blend::{Blend, Shape};
use crate::compute::incidence::lobes::Lobe;
use crate::compute::incidence::model::Model;
use glam::{DQuat, DVec3};

/// What disagreement in flux costs, per unit of ln(f/f′).
const FLUX_COST: f64 = 0.05;
/// Lobes further apart than this are two lobes. \[rad\]
const GATE: f64 = 40.0 * std::f64::consts::PI / 180.0;

/// The scheme.
pub(super) fn blend(model: &Model, between: &Between) -> Blend {
    let mut blend = Blend::default();
    for &(v, w) in &between.used {
        blend.push(Shape::Base(v), DQuat::IDENTITY, w * model.base_flux[v]);
    }
    for (k, &(v, w)) in between.used.iter().enumerate() {
        let others: Vec<(usize, f64, Vec<Option<usize>>)> = between
            .used
            .iter()
            .enumerate()
            .filter(|(j, _)| *j != k)
            .map(|(_, &(n, wn))| (n, wn, pairs(&model.lobes[v], &model.lobes[n])))
            .collect();
        for (l, lobe) in model.lobes[v].iter().enumerate() {
            let mut to: DVec3 = lobe.centre * w;
            for (n, wn, partner) in &others {
                if let Some(m) = partner[l] {
                    to += model.lobes[*n][m].centre * *wn;
                }
            }
            let turn = if to.length() > 1e-9 {
                DQuat::from_rotation_arc(lobe.centre, to.normalize_or(lobe.centre))
            } else {
                DQuat::IDENTITY
            };
            blend.push(Shape::Lobe(v, l), turn, w * lobe.flux);
        }
    }
    blend
}

/// For every lobe of `a` the one of `b` that it is paired with: cheapest pairs first, each lobe once.
fn pairs(a: &[Lobe], b: &[Lobe]) -> Vec<Option<usize>> {
    let mut costs: Vec<(f64, usize, usize)> = Vec::with_capacity(a.len() * b.len());
    for (i, p) in a.iter().enumerate() {
        for (j, q) in b.iter().enumerate() {
            let cosine = p.centre.dot(q.centre);
            if cosine > GATE.cos() {
                costs.push((1.0 - cosine + FLUX_COST * (p.flux / q.flux).ln().abs(), i, j));
            }
        }
    }
    costs.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1 + x.2).cmp(&(y.1 + y.2))));
    let (mut partner, mut taken) = (vec![None; a.len()], vec![false; b.len()]);
    for (_, i, j) in costs {
        if partner[i].is_none() && !taken[j] {
            partner[i] = Some(j);
            taken[j] = true;
        }
    }
    partner
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::incidence::samples;

    #[test]
    fn pairs_do_not_depend_on_the_order() {
        let model = samples::model(&samples::panel());
        let points = model.lattice().points();
        let mut made = 0;
        for v in 0..points.len() {
            for &n in model.lattice().neighbours(v) {
                let (there, back) = (pairs(&model.lobes[v], &model.lobes[n]), pairs(&model.lobes[n], &model.lobes[v]));
                for (l, m) in there.iter().enumerate() {
                    assert!(m.is_none_or(|m| back[m] == Some(l)));
                    made += usize::from(m.is_some());
                }
            }
        }
        assert!(made > 402, "{made}");
    }
}
