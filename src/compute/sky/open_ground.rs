//! Panels on which the luminance of faces and of the ground is computed; the ground has panels as far as obstructions
//! change its luminance.

use super::scenery::Scenery;
use crate::compute::surroundings::face_light::{FaceLight, Limits};
use crate::compute::surroundings::solid::{Face, Solid};
use glam::DVec3;

/// Distance of a body from a face, relative to the face's size, below which it causes a steep gradient of illuminance
/// on the face: its outline is then a border of panels. Chosen: cost; results change within their stated error.
const CLOSE: f64 = 0.2;
/// Minimum width of the first panels, as a share of a side of the face. Chosen: cost; results change within their
/// stated error.
const NARROW: f64 = 0.03;
/// Distance up to which the luminance of the ground differs from that of unobstructed ground, in heights of the highest
/// body: in front of a long wall its deficit falls like (height/distance)²/4, at 25 heights to 4e-4.
const GROUND: f64 = 25.0;
/// Minimum length over which the illuminance of the ground changes near a body. \[m\] Chosen: cost; panels are halved
/// where the illuminance changes more steeply, and results change within their stated error.
const LEAST: f64 = 0.15;

/// Area of the ground whose luminance is changed by bodies, and the luminance of the ground outside.
pub(super) struct OpenGround {
    pub limits: Limits,
    /// Luminance of the ground outside `limits`, without the part directly reflected from the sun. \[cd/m²\]
    pub luminance: f64,
    /// Bodies on the ground or above it: outline in the ground's coordinates \[m\], a length over which the illuminance
    /// changes \[m\], and whether the body's outline is a border of panels.
    near: Vec<(Limits, f64, bool)>,
    /// Viewpoints in the ground's coordinates. \[m\]
    eyes: Vec<[f64; 2]>,
}

impl OpenGround {
    /// Creates the area of a scenery's ground; `viewpoints`: points from which it is seen, in the world's axes. \[m\]
    pub fn of(scenery: &Scenery<'_>, viewpoints: &[DVec3]) -> Self {
        let surface = &scenery.surfaces[scenery.ground()];
        let height = scenery.ground_height();
        let mut near = Vec::new();
        let (mut limits, mut top) = ([[f64::INFINITY, f64::NEG_INFINITY]; 2], 0.0_f64);
        for (_, solid) in scenery.others(scenery.ground()) {
            let corners = solid.corners().map(|corner| surface.face.coordinates(corner));
            let outline = [0, 1].map(|axis| {
                let places = || corners.iter().map(|corner| corner[axis]);
                [places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max)]
            });
            let [foot, head] = solid.heights().map(|z| z - height);
            top = top.max(head);
            let stands = foot <= 1e-9;
            let size = if stands { 0.5 * head } else { (0.7 * foot + 0.3 * (head - foot)).min(0.5 * head + 1.0) };
            let straight = corners
                .iter()
                .all(|corner| (0..2).all(|axis| outline[axis].iter().any(|line| (line - corner[axis]).abs() < 1e-9)));
            near.push((outline, size.max(LEAST), stands && straight));
            for axis in 0..2 {
                limits[axis] = [limits[axis][0].min(outline[axis][0]), limits[axis][1].max(outline[axis][1])];
            }
        }
        let limits = limits.map(|[low, high]| [low - GROUND * top, high + GROUND * top]);
        let luminance = (scenery.open.ground_luminance() - surface.sun).max(0.0);
        let eyes = viewpoints.iter().map(|eye| surface.face.coordinates(*eye)).collect();
        Self { limits, luminance, near, eyes }
    }

    /// Returns panels of luminance 0 for the surface with index `index`. `most`: maximum number of panels of a face;
    /// `coarse`: maximum length of ground panels, relative to the size or distance of the nearest body; `single`:
    /// whether a panel has one node only.
    pub fn panels(&self, scenery: &Scenery<'_>, index: usize, most: usize, coarse: f64, single: bool) -> FaceLight {
        let surface = &scenery.surfaces[index];
        if index == scenery.ground() {
            return FaceLight::panelled(self.limits, false, &|panel| self.cut(panel, coarse));
        }
        let others: Vec<&Solid> = scenery.others(index).map(|(_, solid)| solid).collect();
        let lines = borders(&surface.face, &others, most);
        FaceLight::panelled(surface.face.limits, single, &|panel| {
            let inside = |axis: usize| {
                let [low, high] = panel[axis];
                let own: Vec<f64> = lines[axis].iter().copied().filter(|line| *line > low && *line < high).collect();
                (!own.is_empty()).then(|| (axis, own[own.len() / 2]))
            };
            inside(0).or_else(|| inside(1))
        })
    }

    /// Returns the index of the axis across which a panel of the ground is divided, and the coordinate: at the outlines
    /// of bodies, then in the middle of panels that are long compared with the nearest body.
    fn cut(&self, panel: &Limits, factor: f64) -> Option<(usize, f64)> {
        let gap = |axis: usize, outline: &Limits| {
            (outline[axis][0] - panel[axis][1]).max(panel[axis][0] - outline[axis][1]).max(0.0)
        };
        for (outline, size, _) in self.near.iter().filter(|(_, _, border)| *border) {
            for axis in 0..2 {
                let beside = gap(1 - axis, outline) < *size;
                let inner = outline[axis].into_iter().find(|line| {
                    let least = 1e-3 * (panel[axis][1] - panel[axis][0]);
                    *line > panel[axis][0] + least && *line < panel[axis][1] - least
                });
                if let Some(line) = inner.filter(|_| beside) {
                    return Some((axis, line));
                }
            }
        }
        let length = |axis: usize| panel[axis][1] - panel[axis][0];
        let axis = usize::from(length(1) > length(0));
        let away = |outline: &Limits| gap(0, outline).hypot(gap(1, outline));
        // Panels may be longer at a greater distance from all viewpoints.
        let eye = self.eyes.iter().map(|[u, v]| away(&[[*u; 2], [*v; 2]])).fold(f64::INFINITY, f64::min);
        let long = length(axis) > 0.5 * factor * eye
            && self.near.iter().any(|(outline, size, _)| length(axis) > 1.001 * factor * size.max(away(outline)));
        long.then(|| (axis, 0.5 * (panel[axis][0] + panel[axis][1])))
    }

    /// Whether a point of the ground lies in the area whose luminance is changed by bodies.
    pub fn holds(&self, [u, v]: [f64; 2]) -> bool {
        let [[a, b], [c, d]] = self.limits;
        (a..=b).contains(&u) && (c..=d).contains(&v)
    }
}

/// Returns the borders of a face's first panels along both axes: the outlines of close bodies, of which every other one
/// is dropped until there are at most `most` panels.
fn borders(face: &Face, others: &[&Solid], most: usize) -> [Vec<f64>; 2] {
    let corners = face.corners();
    let size = face.limits.map(|[low, high]| high - low);
    let near: Vec<&&Solid> =
        others.iter().filter(|solid| solid.gap_to(&corners) < CLOSE * size[0].min(size[1])).collect();
    let mut borders = std::array::from_fn(|axis| {
        let [low, high] = face.limits[axis];
        let mut lines: Vec<f64> = near
            .iter()
            .filter(|solid| solid.corners().iter().any(|corner| face.normal.dot(*corner - face.origin) > 1e-9))
            .flat_map(|solid| solid.corners())
            .map(|corner| face.coordinates(corner)[axis])
            .collect();
        lines.sort_unstable_by(f64::total_cmp);
        let mut kept: Vec<f64> = vec![low];
        for line in lines {
            if line - kept[kept.len() - 1] > NARROW * size[axis] && high - line > NARROW * size[axis] {
                kept.push(line);
            }
        }
        kept.push(high);
        kept
    });
    while (borders[0].len() - 1) * (borders[1].len() - 1) > most {
        let longer = usize::from(borders[1].len() > borders[0].len());
        // Every other border is removed, but not the two ends.
        let last = borders[longer].len() - 1;
        let mut index = 0;
        borders[longer].retain(|_| {
            index += 1;
            (index - 1) % 2 == 0 || index - 1 == last
        });
    }
    borders
}
