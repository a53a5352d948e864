//! Cells of faces and ground of which the sun lights a share: with them, what the sun adds to all that is seen is a sum over cells
//! with weights that do not depend on the sun.

use super::equations::Panels;
use super::open_ground::OpenGround;
use super::scenery::{Scenery, Surface};
use crate::compute::polygon::area;
use crate::compute::surroundings::face_light::{FaceLight, Limits};
use crate::compute::surroundings::shading::without;
use glam::{DVec2, DVec3};

/// Distance over height of the eye above the ground from which cells of the ground grow in proportion to the square of the
/// distance: the solid angle that they are seen in falls with its cube.
const FAR: f64 = 6.0;
/// Height of an eye above the ground that counts at least. \[m\]
const LOWEST: f64 = 0.5;
/// Share of a cell's area that is nothing.
const NOTHING: f64 = 1e-9;

/// Cells of all surfaces that reflect, numbered throughout.
pub(super) struct SunCells {
    panels: Panels,
    /// Sides of every cell. \[m\]
    limits: Vec<Limits>,
}

impl SunCells {
    /// Cuts the surfaces that reflect, or those of them that are `wanted`, into cells whose sides are no longer than `side` times
    /// the distance from the nearest viewpoint, or `least`. \[m\]
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
        let limits = panels.lights.iter().flat_map(FaceLight::limits).collect();
        Self { panels, limits }
    }

    /// Returns the number of cells.
    pub const fn len(&self) -> usize {
        self.limits.len()
    }

    /// Calls `add` with the cell at a point of a surface, if there is one.
    pub fn at(&self, surface: usize, at: [f64; 2], mut add: impl FnMut(usize)) {
        self.panels.weigh(surface, at, |cell, _| add(cell));
    }

    /// Returns the luminance that the sun adds to every cell, its mean where a shadow's edge crosses it. \[cd/m²\]
    pub fn luminances<'a>(&'a self, scenery: &'a Scenery<'_>) -> impl Iterator<Item = f64> + 'a {
        let bounds: Vec<Vec<Limits>> =
            scenery.surfaces.iter().map(|surface| surface.shadows.iter().map(|one| bounds(one)).collect()).collect();
        self.panels.places.iter().zip(&self.limits).map(move |(&(index, _), cell)| {
            let surface = &scenery.surfaces[index];
            if surface.sun > 0.0 { surface.sun * lit_share(cell, &surface.shadows, &bounds[index]) } else { 0.0 }
        })
    }
}

fn bounds(polygon: &[DVec2]) -> Limits {
    let range = |of: fn(&DVec2) -> f64| {
        let values = || polygon.iter().map(of);
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    [range(|p| p.x), range(|p| p.y)]
}

/// Share of a cell outside of all shadows.
fn lit_share(cell: &Limits, shadows: &[Vec<DVec2>], bounds: &[Limits]) -> f64 {
    let [[a, b], [c, d]] = *cell;
    let corners = [DVec2::new(a, c), DVec2::new(b, c), DVec2::new(b, d), DVec2::new(a, d)];
    let whole = (b - a) * (d - c);
    let mut pieces = Vec::new();
    for (shadow, bounds) in shadows.iter().zip(bounds) {
        if (0..2).any(|axis| bounds[axis][0] >= cell[axis][1] || bounds[axis][1] <= cell[axis][0]) {
            continue;
        }
        let sides = || shadow.iter().zip(shadow.iter().cycle().skip(1));
        let inside = |p: &DVec2, (from, to): (&DVec2, &DVec2)| (*to - *from).perp_dot(*p - *from) >= 0.0;
        if sides().any(|side| corners.iter().all(|p| !inside(p, side))) {
            continue;
        }
        if sides().all(|side| corners.iter().all(|p| inside(p, side))) {
            return 0.0;
        }
        if pieces.is_empty() {
            pieces.push(corners.to_vec());
        }
        pieces = without(pieces, shadow, NOTHING * whole);
        if pieces.is_empty() {
            return 0.0;
        }
    }
    if pieces.is_empty() { 1.0 } else { pieces.iter().map(|piece| area(piece).abs()).sum::<f64>() / whole }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shadows_take_the_share_of_a_cell_that_they_cover_together() {
        let square = |a: f64, b: f64, c: f64, d: f64| {
            vec![DVec2::new(a, c), DVec2::new(b, c), DVec2::new(b, d), DVec2::new(a, d)]
        };
        let cell = [[0.0, 2.0], [0.0, 1.0]];
        let lit = |shadows: &[Vec<DVec2>]| {
            let bounds: Vec<Limits> = shadows.iter().map(|one| bounds(one)).collect();
            lit_share(&cell, shadows, &bounds)
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
            assert!((lit(&shadows) - share).abs() < 1e-12, "{shadows:?}: {}", lit(&shadows));
        }
    }
}
