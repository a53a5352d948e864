//! Widening of scattered lobes that are narrower than the angular size of a tile seen from the lit surface. A luminaire
//! file makes the tile a point source, whose narrow lobe lights a small spot, whereas the tile lights an area as wide
//! as itself. Near such lobes the table is given the intensities that, sent from the tile's centre, cause the
//! illuminance of the room's surfaces by the whole tile.

use super::cells::Cells;
use super::spots::MOST;
use super::{CGammaTable, Panel};
use crate::compute::lid::Lid;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Relative difference of the intensities at neighbouring nodes above which the distribution counts as narrow there.
/// Chosen; held with the constants below by the test
/// `narrow_scattered_light_is_as_wide_as_the_tile_and_what_it_lights`: within 6 % of a sum over the tile.
const STEEP: f64 = 0.3;
/// Share of the largest intensity up to which the distribution never counts as narrow. Chosen: cost; such low
/// intensities are left unchanged.
const DIM: f64 = 0.02;
/// Number of points per side of the tile, for a mean over it and over the node's cell. Chosen: cost, see [`STEEP`]; a
/// prime, see [`mean`].
const POINTS: usize = 7;
/// Maximum number of parts into which the regular step is divided where the distribution is narrow. Chosen: size of the
/// files; see [`STEEP`].
const FINER: usize = 3;

/// Returns the indices of the nodes around which the intensity of a table changes steeply (more than [`STEEP`]).
pub(super) fn nodes(table: &CGammaTable) -> Vec<usize> {
    let (planes, angles) = (table.planes(), table.angles());
    let brightest = table.intensity.iter().copied().fold(0.0, f64::max);
    let around = |node: &usize| {
        let (plane, angle) = (node / angles, node % angles);
        let list = (0..9).map(|k| {
            let plane = (plane + planes + k / 3 - 1) % planes;
            table.plane(plane)[(angle + k % 3).saturating_sub(1).min(angles - 1)]
        });
        let (low, high) = list.fold((f64::INFINITY, 0.0_f64), |(low, high), one| (low.min(one), high.max(one)));
        high > DIM * brightest && high - low > STEEP * high
    };
    (0..planes * angles).filter(around).collect()
}

/// Widens narrow lobes in the table of an aperture for a tile that holds `share` of its area: near the nodes `steep`,
/// mean intensities are replaced by those that, sent from the tile's centre, cause the illuminance of the room's
/// surfaces by the whole tile. *Near* means within half the angular size of the tile seen from the lit surface, plus
/// one step. Nodes are added there. The flux near these nodes and that of the whole table are unchanged.
pub(super) fn widen(table: &mut CGammaTable, steep: &[usize], lid: &Lid, panel: &Panel, share: f64) {
    if steep.is_empty() {
        return;
    }
    let (c, gamma) = (table.c.clone(), table.gamma.clone());
    let near = near(table, steep, panel);
    let angles = gamma.len();
    let planes_near: Vec<bool> = near.chunks(angles).map(|plane| plane.contains(&true)).collect();
    let angles_near: Vec<bool> = (0..angles).map(|j| near.iter().skip(j).step_by(angles).any(|near| *near)).collect();
    let c_finer = finer(&c, &planes_near, 2.0 * PI, MOST[0]);
    let gamma_finer = finer(&gamma, &angles_near, PI, MOST[1]);
    table.at_nodes(c_finer, gamma_finer);
    let cells = Cells::new(table.aim, &table.c, &table.gamma);
    // Between regular nodes, both regular neighbours count.
    let is_near = |node: &usize| {
        let (own_c, own_gamma) = (table.c[node / table.gamma.len()], table.gamma[node % table.gamma.len()]);
        let (i, j) = (c.partition_point(|c| *c <= own_c) - 1, gamma.partition_point(|gamma| *gamma <= own_gamma) - 1);
        let (k, l) = (if c[i] < own_c { (i + 1) % c.len() } else { i }, if gamma[j] < own_gamma { j + 1 } else { j });
        near[i * angles + j] && near[k * angles + j] && near[i * angles + l] && near[k * angles + l]
    };
    let list: Vec<usize> = (0..table.intensity.len()).filter(is_near).collect();
    let found: Vec<f64> = list.par_iter().map(|node| mean(&cells, *node, lid, panel)).collect();
    let flux = |value: &dyn Fn(usize) -> f64| (0..list.len()).map(|k| cells.weight(list[k]) * value(k)).sum::<f64>();
    let (before, after) = (flux(&|k| share * table.intensity[list[k]]), flux(&|k| found[k]));
    let scale = if after > 0.0 { before / after } else { return };
    // The table is still that of the whole aperture.
    for (node, value) in list.iter().zip(&found) {
        table.intensity[*node] = scale * value / share;
    }
    table.close();
}

/// Marks the regular nodes whose angular distance from a node of `steep` is at most one step plus half the angular size
/// of the tile (of a part of it, where host programs subdivide it), seen from the lit surface.
fn near(table: &CGammaTable, steep: &[usize], panel: &Panel) -> Vec<bool> {
    let (planes, angles) = (table.planes(), table.angles());
    let step = table.step.degrees().to_radians();
    let mut near = vec![false; planes * angles];
    for node in steep {
        let (plane, angle) = (node / angles, node % angles);
        let gamma = table.gamma[angle];
        let (away, _) = panel.reach(table.aim.direction(table.c[plane], gamma).0.vector());
        let part = panel.part(away).size;
        let seen = (0.5 * part[0].hypot(part[1]) / away.max(1e-3)).min(0.5 * PI) + step;
        let [along, across] = [seen, seen / gamma.sin().max(1e-3)].map(|angle| (angle / step).ceil() as usize);
        let across = across.min(planes / 2);
        for i in plane + planes - across..=plane + planes + across {
            for j in angle.saturating_sub(along).max(1)..=(angle + along).min(angles - 2) {
                near[(i % planes) * angles + j] = true;
            }
        }
    }
    near
}

/// Returns the nodes with up to `FINER − 1` additional ones between neighbours that are both marked; fewer if the table
/// would exceed `most` nodes.
fn finer(nodes: &[f64], marked: &[bool], end: f64, most: usize) -> Vec<f64> {
    let pairs = nodes.iter().zip(nodes.iter().skip(1).chain([&end]));
    let both = marked.iter().zip(marked.iter().cycle().skip(1)).map(|(a, b)| *a && *b);
    let gaps: Vec<_> = pairs.zip(both).filter(|((from, to), _)| from < to).collect();
    let count = gaps.iter().filter(|(_, both)| *both).count();
    let room = most.saturating_sub(nodes.len()) / 2;
    let by = (1..=FINER).rev().find(|by| (by - 1) * count <= room).unwrap_or(1);
    let mut list = Vec::with_capacity(nodes.len() + (by - 1) * count);
    for ((from, to), both) in &gaps {
        let by = if *both { by } else { 1 };
        list.extend((0..by).map(|k| *from + (*to - *from) * k as f64 / by as f64));
    }
    // The last of the angles ends the last gap; the last plane begins one.
    list.extend(nodes.last().filter(|last| **last >= end));
    list
}

/// Returns the mean over a node's cell of the luminous intensity that, sent from the tile's centre, causes the
/// illuminance of the room's surfaces by the whole tile. \[cd\]
fn mean(cells: &Cells<'_>, node: usize, lid: &Lid, panel: &Panel) -> f64 {
    let (plane, angle) = (node / cells.gamma.len(), node % cells.gamma.len());
    let (away, _) = panel.reach(cells.aim.direction(cells.c[plane], cells.gamma[angle]).0.vector());
    let part = panel.part(away);
    let parts = (panel.size[0] * panel.size[1]) / (part.size[0] * part.size[1]);
    let at = |k: usize| ((k % POINTS) as f64 + 0.5) / POINTS as f64;
    let inside = |[low, high]: [f64; 2], share: f64| low + share * (high - low);
    let (c, gamma) = (cells.c_cell(plane), cells.gamma_cell(angle));
    let mut sum = 0.0;
    for i in 0..POINTS {
        for j in 0..POINTS {
            // Every row and column of the cell meets every row and column of the tile, and each other, once: modulo a
            // prime, the factors and their determinant have inverses.
            let beside = [(at(i) - 0.5) * part.size[0], (at(j) - 0.5) * part.size[1]];
            let way = cells.aim.direction(inside(c, at(2 * i + 3 * j)), inside(gamma, at(3 * i + 2 * j)));
            sum += part.of_point(lid, beside, way.0.vector());
        }
    }
    parts * sum / (POINTS * POINTS) as f64
}
