//! Cells of faces and ground with the luminance by directly reflected sunlight: the illuminance by sunlit surfaces is a
//! sum over cells with weights that do not depend on the sun.

use super::equations::Panels;
use super::open_ground::OpenGround;
use super::scenery::{Scenery, Surface};
use crate::compute::polygon::area;
use crate::compute::surroundings::face_light::{Branch, FaceLight, Limits};
use crate::compute::surroundings::shading::{area_without, without};
use glam::{DVec2, DVec3};

/// Distance of a viewpoint, relative to its height above the ground, from which cells of the ground grow with the
/// square of the distance, because their solid angle falls with its cube. Chosen: cost; held by the test
/// `boxes_are_lit_as_at_single_moments` of `prepared`.
const FAR: f64 = 6.0;
/// Minimum height of a viewpoint above the ground in the size of ground cells. \[m\] Chosen: cost; equal to
/// `LOWEST_EYE` of `faces`.
const LOWEST: f64 = 0.5;
/// Sunlit share of a cell's area that is negligible.
const NOTHING: f64 = 1e-9;

/// Cells of all reflecting surfaces, numbered consecutively.
pub(super) struct SunCells {
    panels: Panels,
    /// Tree of the cells of every surface, and index of its first cell.
    trees: Vec<(Vec<Branch>, usize)>,
}

impl SunCells {
    /// Divides the reflecting surfaces, or those of them that are `wanted`, into cells whose sides are at most `side`
    /// times the distance from the nearest viewpoint, or `least` \[m\] if that is larger. `viewpoints`: in the world's
    /// axes \[m\].
    pub fn new(
        scenery: &Scenery<'_>,
        ground: &OpenGround,
        wanted: Option<&[usize]>,
        viewpoints: &[DVec3],
        [side, least]: [f64; 2],
    ) -> Self {
        let of = |(index, surface): (usize, &Surface)| {
            if !surface.reflects() || wanted.is_some_and(|wanted| !wanted.contains(&index)) {
                return FaceLight::even(0.0);
            }
            let level = index == scenery.ground();
            let cut = |panel: &Limits| {
                let length = panel.map(|[low, high]| high - low);
                let axis = usize::from(length[1] > length[0]);
                let most = |eye: &DVec3| {
                    let [u, v] = surface.face.coordinates(*eye);
                    let nearest =
                        surface.face.point(u.clamp(panel[0][0], panel[0][1]), v.clamp(panel[1][0], panel[1][1]));
                    let to = nearest - *eye;
                    let far = to.truncate().length() / (FAR * to.z.abs().max(LOWEST));
                    side * to.length() * if level { far.max(1.0) } else { 1.0 }
                };
                let most = viewpoints.iter().map(most).fold(f64::INFINITY, f64::min);
                (length[axis] > most.max(least)).then(|| (axis, 0.5 * (panel[axis][0] + panel[axis][1])))
            };
            FaceLight::panelled(if level { ground.limits } else { surface.face.limits }, true, &cut)
        };
        let panels = Panels::new(scenery.surfaces.iter().enumerate().map(of).collect());
        let mut first = 0;
        let tree = |(index, light): (usize, &FaceLight)| {
            let limits = if index == scenery.ground() { ground.limits } else { scenery.surfaces[index].face.limits };
            let tree = (light.branches(limits), first);
            first += light.values().len();
            tree
        };
        let trees = panels.lights.iter().enumerate().map(tree).collect();
        Self { panels, trees }
    }

    /// Returns the number of cells of all surfaces.
    pub const fn len(&self) -> usize {
        self.panels.places.len()
    }

    /// Calls `add` with the index of the cell at a point of a surface, if there is one.
    pub fn at(&self, surface: usize, at: [f64; 2], mut add: impl FnMut(usize)) {
        self.panels.weigh(surface, at, |cell, _| add(cell));
    }

    /// Returns the luminance of every cell by directly reflected sunlight, the mean where the edge of a shadow crosses
    /// the cell. \[cd/m²\]
    pub fn luminances(&self, scenery: &Scenery<'_>) -> Vec<f64> {
        let mut all = vec![0.0; self.len()];
        for (surface, (tree, first)) in scenery.surfaces.iter().zip(&self.trees) {
            if surface.sun > 0.0 {
                let shadows: Vec<Shadow<'_>> = surface.shadows.iter().map(|outline| Shadow::new(outline)).collect();
                let shadows: Vec<&Shadow<'_>> = shadows.iter().collect();
                light_up(tree, 0, &shadows, surface.sun, &mut all[*first..]);
            }
        }
        all
    }
}

/// Convex shadow on a surface, with its bounding rectangle.
struct Shadow<'a> {
    outline: &'a [DVec2],
    bounds: Limits,
}

/// Extent to which a shadow covers a rectangle.
enum Cover {
    Nothing,
    Part,
    All,
}

impl<'a> Shadow<'a> {
    fn new(outline: &'a [DVec2]) -> Self {
        let range = |of: fn(&DVec2) -> f64| {
            let values = || outline.iter().map(of);
            [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
        };
        Self { outline, bounds: [range(|p| p.x), range(|p| p.y)] }
    }

    /// Returns whether the shadow covers none, a part or all of a rectangle; an outline that only comes close may count
    /// as a part.
    fn cover(&self, rectangle: &Limits) -> Cover {
        if (0..2).any(|axis| self.bounds[axis][0] >= rectangle[axis][1] || self.bounds[axis][1] <= rectangle[axis][0]) {
            return Cover::Nothing;
        }
        let corners = corners(rectangle);
        let mut cover = Cover::All;
        for (k, from) in self.outline.iter().enumerate() {
            let along = self.outline[(k + 1) % self.outline.len()] - *from;
            match corners.iter().filter(|p| along.perp_dot(**p - *from) >= 0.0).count() {
                0 => return Cover::Nothing,
                4 => {}
                _ => cover = Cover::Part,
            }
        }
        cover
    }
}

const fn corners(&[[a, b], [c, d]]: &Limits) -> [DVec2; 4] {
    [DVec2::new(a, c), DVec2::new(b, c), DVec2::new(b, d), DVec2::new(a, d)]
}

/// Writes the luminances of the cells in a part of the tree into `all`: `sun` times the share outside `shadows`, which
/// contains all shadows that may reach that part. \[cd/m²\]
fn light_up(tree: &[Branch], part: usize, shadows: &[&Shadow<'_>], sun: f64, all: &mut [f64]) {
    let Branch { limits, halves, values } = &tree[part];
    let mut near = Vec::with_capacity(shadows.len());
    for shadow in shadows {
        match shadow.cover(limits) {
            Cover::Nothing => {}
            Cover::Part => near.push(*shadow),
            Cover::All => return,
        }
    }
    match halves {
        Some(halves) if !near.is_empty() => halves.iter().for_each(|half| light_up(tree, *half, &near, sun, all)),
        _ => all[values.clone()].fill(sun * lit_share(limits, &near)),
    }
}

/// Returns the share of a rectangle that lies outside all shadows, 0 … 1.
fn lit_share(rectangle: &Limits, shadows: &[&Shadow<'_>]) -> f64 {
    let Some((last, others)) = shadows.split_last() else { return 1.0 };
    let whole = corners(rectangle).to_vec();
    let size = area(&whole);
    let clear = |pieces, shadow: &&Shadow<'_>| without(pieces, shadow.outline, NOTHING * size);
    area_without(others.iter().fold(vec![whole], clear), last.outline) / size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shadows_take_the_share_of_a_cell_that_they_cover_together() {
        let square = |a: f64, b: f64, c: f64, d: f64| {
            vec![DVec2::new(a, c), DVec2::new(b, c), DVec2::new(b, d), DVec2::new(a, d)]
        };
        // Alone, and in cells of a quarter of its sides.
        let cell = [[0.0, 2.0], [0.0, 1.0]];
        let lit = |shadows: &[Vec<DVec2>], least: f64| {
            let halved = |panel: &Limits| {
                let axis = usize::from(panel[1][1] - panel[1][0] > panel[0][1] - panel[0][0]);
                let [low, high] = panel[axis];
                (high - low > least).then_some((axis, 0.5 * (low + high)))
            };
            let cells = FaceLight::panelled(cell, true, &halved);
            let shadows: Vec<Shadow<'_>> = shadows.iter().map(|outline| Shadow::new(outline)).collect();
            let mut all = vec![0.0; cells.values().len()];
            light_up(&cells.branches(cell), 0, &shadows.iter().collect::<Vec<_>>(), 1.0, &mut all);
            let width = |[[a, b], [c, d]]: Limits| (b - a) * (d - c) / 2.0;
            let panels = cells.branches(cell).into_iter().filter(|branch| branch.halves.is_none());
            panels.map(|panel| all[panel.values.start] * width(panel.limits)).sum::<f64>()
        };
        let triangle = vec![DVec2::new(0.0, 0.0), DVec2::new(2.0, 0.0), DVec2::new(0.0, 1.0)];
        for (shadows, share) in [
            (vec![], 1.0),
            (vec![square(2.5, 3.0, 0.0, 1.0)], 1.0),
            (vec![square(-1.0, 1.0, -1.0, 2.0)], 0.5),
            (vec![square(-1.0, 1.0, -1.0, 2.0), square(0.5, 1.5, 0.0, 1.0)], 0.25),
            (vec![square(-1.0, 1.0, -1.0, 2.0), square(0.5, 3.0, 0.0, 1.0)], 0.0),
            (vec![square(-1.0, 4.0, -1.0, 4.0)], 0.0),
            (vec![triangle.clone()], 0.5),
            (vec![triangle, square(-1.0, 3.0, 0.5, 3.0)], 0.125),
        ] {
            for least in [2.0, 0.25] {
                let lit = lit(&shadows, least);
                assert!((lit - share).abs() < 1e-12, "{shadows:?} {least}: {lit}");
            }
        }
    }
}
