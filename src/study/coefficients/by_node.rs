//! Interreflected light of an aperture behind boxes, by the nodes at which it enters.
//!
//! E = N·W·L: luminances L outside, weights W with which the nodes of the aperture see them through the incident
//! patches, illuminances N at the sensors per illuminance through a patch at a node. For few patches W·L is formed
//! first: it does not depend on the system, so that a year needs it once for all systems on the same patches. For many
//! patches N·W is.

use super::columns::Columns;
use super::transport::Column;
use super::views::Opening;
use crate::compute::dot::wide;
use crate::compute::room::grid::Grid;
use crate::compute::room::nodes::Nodes;
use crate::compute::sky::{Counts, Prepared, SparseSum};
use crate::study::session::sky_year::{SkyYear, of_moments};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use rayon::prelude::*;
use std::sync::Arc;

/// Minimum number of luminances per patch and node for which W·L is formed before N·W. Chosen: cost only.
const FEW: usize = 3;
/// Number of rows of N that are multiplied by W together. Chosen: memory only, no effect on results.
const BLOCK: usize = 64;

/// Interreflected light of an aperture by luminances outside.
pub(super) struct ByNode {
    patches: usize,
    /// Weights W, by luminance and node a list of patches. \[sr\]
    seen: Arc<Vec<Vec<Counts>>>,
    /// Table N. Columns: node by node, patch by patch. Rows: sensor by sensor, then their uncertainties.
    entering: Mat<f32>,
    /// Table N·W, with a column for each luminance, if it is formed first.
    by_luminance: Option<Vec<f32>>,
}

impl ByNode {
    /// Creates the light from the illuminances at the sensors by incident patch, node by node (`columns`; `None` without
    /// interreflection), and the weights `seen` of luminances at the nodes.
    pub fn new(
        opening: &Opening<'_>,
        nodes: &Nodes,
        columns: Option<&Columns<'_>>,
        seen: Arc<Vec<Vec<Counts>>>,
    ) -> Self {
        let (sensors, patches) = (opening.scene.sensors.len(), columns.map_or(0, Columns::count));
        let places = sensors * nodes.count();
        let mut entering: Mat<f32> = Mat::zeros(2 * sensors, nodes.count() * patches);
        let put = |patch: usize, column: &Column| {
            for node in 0..nodes.count() {
                // All light is the same as interreflected light.
                let rows = column.light.chunks_exact(places).skip(1).flat_map(|row| &row[node * sensors..][..sensors]);
                let to = entering.col_as_slice_mut(node * patches + patch);
                to.iter_mut().zip(rows).for_each(|(to, e): (&mut f32, &f64)| *to = *e as f32);
            }
        };
        if let Some(columns) = columns {
            columns.each(put);
        }
        let mut own = Self { patches, seen, entering, by_luminance: None };
        if FEW * own.entering.ncols() > own.seen.len() {
            own.by_luminance = Some(own.each_luminance());
        }
        own
    }

    /// Returns the table N·W, column by column.
    fn each_luminance(&self) -> Vec<f32> {
        let rows = self.entering.nrows();
        let mut table = vec![0.0; rows * self.seen.len()];
        let summed = |(by_node, column): (&Vec<Counts>, &mut [f32])| {
            for (block, sums) in column.chunks_mut(BLOCK).enumerate() {
                let own = block * BLOCK..block * BLOCK + sums.len();
                wide(|| {
                    for (place, counts) in self.places(by_node) {
                        let light = &self.entering.col_as_slice(place)[own.clone()];
                        sums.iter_mut().zip(light).for_each(|(sum, e)| *sum += counts * e);
                    }
                });
            }
        };
        self.seen.par_iter().zip(table.par_chunks_mut(rows.max(1))).for_each(summed);
        table
    }

    /// Returns the columns of the table N that belong to weights by node and patch, with these weights.
    fn places<'a>(&self, by_node: &'a [Counts]) -> impl Iterator<Item = (usize, f32)> + use<'a> {
        let patches = self.patches;
        let of_node = move |(node, counts): (usize, &'a Counts)| {
            counts.iter().map(move |(patch, counts)| (node * patches + *patch as usize, *counts))
        };
        by_node.iter().enumerate().flat_map(of_node)
    }

    /// Returns the illuminances W·L through all patches at all nodes, for several columns of luminances. \[lx\]
    fn through(&self, luminances: MatRef<'_, f32>) -> Vec<Vec<f32>> {
        // All columns of one luminance lie together, and so do the sums of one place.
        let by_luminance = luminances.transpose().to_owned();
        let mut sums: Mat<f32> = Mat::zeros(luminances.ncols(), self.entering.ncols());
        for (by_node, light) in self.seen.iter().zip(by_luminance.col_iter()) {
            let light = light.try_as_col_major().expect("columns of a matrix lie in one piece").as_slice();
            if light.iter().all(|luminance| *luminance == 0.0) {
                continue;
            }
            wide(|| {
                for (place, counts) in self.places(by_node) {
                    let sums = sums.col_as_slice_mut(place).iter_mut();
                    sums.zip(light).for_each(|(sum, luminance)| *sum += counts * luminance);
                }
            });
        }
        sums.row_iter().map(|row| row.iter().copied().collect()).collect()
    }

    /// Number of values that are stored for each hour of a year: 0 where the table is by luminance.
    pub fn numbers(&self) -> usize {
        if self.by_luminance.is_some() { 0 } else { self.entering.ncols() }
    }

    /// Computes the interreflected illuminances at the sensors and their uncertainties, a column of `light` for each
    /// list of luminances. \[lx\] `hours`: index of the year's hour of each, where it has one; `year`: store of
    /// [`Self::numbers`] values for each hour.
    pub fn light(
        &self,
        luminances: MatRef<'_, f32>,
        hours: &[Option<usize>],
        year: Option<&SkyYear>,
        light: MatMut<'_, f32>,
    ) {
        if let Some(table) = &self.by_luminance {
            let table = MatRef::from_column_major_slice(table, self.entering.nrows(), self.seen.len());
            return matmul(light, Accum::Replace, table, luminances, 1.0, Par::Seq);
        }
        let find = |missing: &[usize]| {
            let of = |place: usize, moment: usize| luminances[(place, missing[moment])];
            self.through(Mat::from_fn(luminances.nrows(), missing.len(), of).as_ref())
        };
        let through = of_moments(year, hours, [self.entering.ncols(), luminances.ncols()], find);
        matmul(light, Accum::Replace, &self.entering, &through, 1.0, Par::Seq);
    }

    /// Returns the interreflected illuminances of a sensor by light through one incident patch, node by node, per
    /// illuminance through the patch.
    pub fn of_patch(&self, patch: usize, sensor: usize) -> impl Iterator<Item = f32> + '_ {
        (patch..self.entering.ncols()).step_by(self.patches.max(1)).map(move |place| self.entering[(sensor, place)])
    }
}

/// Returns the weights of outside luminances at the nodes of an aperture, by luminance and node a list of incident
/// patches \[sr\], from those at the points of a grid.
pub(super) fn seen_by_nodes(
    prepared: &Prepared,
    (grid, nodes): (&Grid, &Nodes),
    patches: usize,
    by_point: &[Vec<Counts>],
) -> Vec<Vec<Counts>> {
    let of_node = |on_node: &Vec<f64>| {
        let mut seen = SparseSum::new(prepared.count());
        let of_patch = |p: usize| {
            for (by_patch, share) in by_point.iter().zip(on_node) {
                by_patch[p].iter().for_each(|(k, counts)| seen.add(*k as usize, share * f64::from(*counts)));
            }
            seen.take()
        };
        (0..patches).map(of_patch).collect()
    };
    let by_node: Vec<Vec<Counts>> = nodes.of_grid(grid).par_iter().map(of_node).collect();
    let mut by_luminance = vec![vec![Counts::new(); nodes.count()]; prepared.count()];
    for (node, by_patch) in by_node.iter().enumerate() {
        for (p, seen) in by_patch.iter().enumerate() {
            seen.iter().for_each(|(k, counts)| by_luminance[*k as usize][node].push((p as u32, *counts)));
        }
    }
    by_luminance
}
