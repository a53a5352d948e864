//! Apertures as seen by an eye: patches with exact solid angles, whose luminance is that towards the eye.

use super::gaze::Gaze;
use crate::compute::direction::Dir;
use crate::compute::direction::Facade;
use crate::compute::room::aperture::{Aperture, View};
use crate::compute::room::direct::Sensor;
use glam::{DVec2, DVec3};
use std::ops::Range;

/// Maximum width of a patch across the line of sight to it. \[rad\] Compared with 10⁵ directions, the midpoints give
/// DGP within 0.002, as `tests/scenes/glare` shows.
const WIDEST: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// Minimum number of patches along each side of an aperture. Chosen: three rows and three columns in each of the halves
/// whose difference is the error; no test depends on its exact value.
const FEWEST: f64 = 6.0;

/// Patch of an aperture as an eye sees it: its direction, position in the eye's picture, and solid angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Direction from the eye to the patch's middle, in the aperture's frame (x right seen from outside, y up, z
    /// outward). Light that arrives at the eye from there leaves the aperture in the opposite direction.
    pub through: Dir<Facade>,
    /// Unit vector from the eye to the patch's middle in the room's axes.
    pub to: DVec3,
    /// Position of the patch's middle in the eye's equiangular picture: x to the right, y up, at a distance from the
    /// middle equal to the angle off the line of sight. \[rad\]
    pub place: DVec2,
    /// Solid angle of the patch. \[sr\]
    pub solid_angle: f64,
    /// Projected solid angle of the patch: solid angle times the cosine of the angle to the line of sight. \[sr\]
    pub projected: f64,
    /// Quarter of the patches that this one belongs to, 0 to 3: twice the parity of its row plus that of its column.
    /// The difference between the four quarters gives the error due to the width of the patches.
    pub quarter: usize,
}

/// Apertures as an eye sees them, split into patches.
#[derive(Debug, Clone)]
pub struct Field {
    /// Eye of the observer: its position and line of sight.
    pub gaze: Gaze,
    /// Patches of all apertures that lie in front of the plane of the eye.
    pub patches: Vec<Patch>,
    /// Range of indices in `patches` of each aperture's patches, one entry per aperture.
    pub of: Vec<Range<usize>>,
    /// Indices of the patches that share a side with each patch: left, right, below, above, i.e. towards −x, +x, −y, +y
    /// of the aperture's frame; `None` beyond its edge.
    beside: Vec<[Option<usize>; 4]>,
    /// Indices of the patches in the order of rising z of their direction `to`.
    rising: Vec<usize>,
}

impl Field {
    /// Creates the field of an eye from the apertures, with patches of the default width.
    pub fn new<'a>(eye: &Sensor, apertures: impl IntoIterator<Item = &'a Aperture>) -> Self {
        Self::with_widest(eye, apertures, WIDEST)
    }

    /// Creates the field of an eye with a given maximum width of the patches. \[rad\]
    pub fn with_widest<'a>(eye: &Sensor, apertures: impl IntoIterator<Item = &'a Aperture>, widest: f64) -> Self {
        let gaze = Gaze::new(eye);
        let mut field = Self { gaze, patches: Vec::new(), of: Vec::new(), beside: Vec::new(), rising: Vec::new() };
        for aperture in apertures {
            let from = field.patches.len();
            if let Some(view) = aperture.view(eye.position, gaze.forward) {
                field.cut(aperture, &view, widest);
            }
            field.of.push(from..field.patches.len());
        }
        field.rising = (0..field.patches.len()).collect();
        field.rising.sort_by(|&a, &b| field.patches[a].to.z.total_cmp(&field.patches[b].to.z));
        field
    }

    /// Splits an aperture into patches of equal angles, at most `widest` \[rad\] wide, and adds those in front of the
    /// eye.
    fn cut(&mut self, aperture: &Aperture, view: &View, widest: f64) {
        let [columns, rows] = [view.x, view.y].map(|limits| knots(limits, view.distance, widest));
        let (width, height) = (columns.len() - 1, rows.len() - 1);
        let mut numbers = vec![None; width * height];
        for row in 0..height {
            for column in 0..width {
                let (x, y) = ([columns[column], columns[column + 1]], [rows[row], rows[row + 1]]);
                let [u, v] = [x, y].map(|[low, high]| middle(low, high, view.distance));
                let Some(through) = Dir::<Facade>::new(DVec3::new(u, v, view.distance)) else { continue };
                let to = aperture.surface.room_from_facade(through.vector());
                let cosine = to.dot(self.gaze.forward);
                if cosine <= 0.0 {
                    continue;
                }
                let corner =
                    |x: f64, y: f64| (x * y).atan2(view.distance * (x * x + y * y + view.distance.powi(2)).sqrt());
                let solid_angle = corner(x[1], y[1]) - corner(x[0], y[1]) - corner(x[1], y[0]) + corner(x[0], y[0]);
                numbers[row * width + column] = Some(self.patches.len());
                self.patches.push(Patch {
                    through,
                    to,
                    place: self.gaze.place(to),
                    solid_angle: solid_angle.max(0.0),
                    projected: solid_angle.max(0.0) * cosine,
                    quarter: 2 * (row % 2) + column % 2,
                });
            }
        }
        for at in (0..width * height).filter(|&at| numbers[at].is_some()) {
            let (row, column) = (at / width, at % width);
            let number = |row: usize, column: usize| {
                if row < height && column < width { numbers[row * width + column] } else { None }
            };
            self.beside.push([
                number(row, column.wrapping_sub(1)),
                number(row, column + 1),
                number(row.wrapping_sub(1), column),
                number(row + 1, column),
            ]);
        }
    }

    /// Returns the indices of the patches that share a side with the patch `patch`: left, right, below, above; `None`
    /// beyond the aperture's edge.
    pub(super) fn beside(&self, patch: usize) -> [Option<usize>; 4] {
        self.beside[patch]
    }

    /// Returns the indices of the patches in the order of rising z of their direction from the eye.
    pub(super) fn rising(&self) -> &[usize] {
        &self.rising
    }

    /// Returns the sum of the patches' solid angles, and that of their projected solid angles (towards the line of
    /// sight). \[sr\]
    pub fn solid_angles(&self) -> [f64; 2] {
        self.patches.iter().fold([0.0; 2], |[all, projected], p| [all + p.solid_angle, projected + p.projected])
    }
}

/// Returns the coordinates of the patches' limits along one side of an aperture
/// \[m, like its limits and its distance from the eye\], at equal steps of the angle, none above `widest` \[rad\].
fn knots([low, high]: [f64; 2], distance: f64, widest: f64) -> Vec<f64> {
    let (from, to) = (low.atan2(distance), high.atan2(distance));
    let count = ((to - from) / widest).ceil().max(FEWEST);
    let inner = (1..count as usize).map(|k| (from + (to - from) * k as f64 / count).tan() * distance);
    std::iter::once(low).chain(inner).chain(std::iter::once(high)).collect()
}

/// Returns the coordinate whose angle, seen from the eye at `distance`, is the mean of those of `low` and `high`. \[m\]
fn middle(low: f64, high: f64, distance: f64) -> f64 {
    (0.5 * (low.atan2(distance) + high.atan2(distance))).tan() * distance
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::polygon::projected_solid_angle;

    #[test]
    fn patches_fill_the_opening_and_keep_their_neighbours() {
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [4.0, 1.8] };
        let eye = Sensor { position: DVec3::new(2.5, 2.0, 1.2), normal: DVec3::NEG_Y };
        let field = Field::new(&eye, [&aperture]);
        let [all, projected] = field.solid_angles();
        let view = aperture.view(eye.position, eye.normal).unwrap();
        let exact = projected_solid_angle(&view.corners(), view.normal);
        assert!((projected / exact - 1.0).abs() < 2e-4, "{projected} {exact}");
        // Half of a box seen from its middle: Ω by the corners' own formula, by symmetry.
        let f = |x: f64, y: f64| (x * y / (2.0 * (4.0 + x * x + y * y).sqrt())).atan();
        assert!((all - 2.0 * (f(2.0, 1.5) + f(2.0, 0.3))).abs() < 1e-12);
        assert!(field.patches.iter().all(|p| p.solid_angle < 1.3e-3));
        for (at, beside) in (0..field.patches.len()).map(|at| (at, field.beside(at))) {
            for (side, other) in beside.into_iter().enumerate() {
                if let Some(other) = other {
                    assert_eq!(field.beside(other)[side ^ 1], Some(at));
                    let differ = field.patches[other].quarter ^ field.patches[at].quarter;
                    assert_eq!(differ, if side < 2 { 1 } else { 2 });
                }
            }
        }
    }

    #[test]
    fn what_is_behind_the_eye_is_not_seen_and_a_speck_is() {
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [4.0, 1.8] };
        let eye = Sensor { position: DVec3::new(2.5, 2.0, 1.2), normal: DVec3::X };
        let field = Field::new(&eye, [&aperture]);
        assert!(!field.patches.is_empty() && field.patches.iter().all(|p| p.to.x > 0.0));
        let away = Sensor { normal: DVec3::Y, ..eye };
        assert!(Field::new(&away, [&aperture]).patches.is_empty());
        let speck = Aperture { size: [1e-3, 1e-3], ..aperture };
        let [all, _] = Field::new(&Sensor { normal: DVec3::NEG_Y, ..eye }, [&speck]).solid_angles();
        let to = DVec3::new(0.5, 0.0, 0.9) - eye.position;
        let expected = 1e-6 * 2.0 / to.length().powi(3);
        assert!((all / expected - 1.0).abs() < 1e-3, "{all} {expected}");
    }
}
