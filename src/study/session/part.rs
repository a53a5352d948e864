//! Rectangular parts of an aperture, given as ranges along its sides.

use crate::compute::room::aperture::Aperture;

/// Part of an aperture: its ranges along both sides, as shares 0 … 1.
pub(super) type Part = [[f64; 2]; 2];

/// Part that is the whole aperture.
pub(super) const WHOLE: Part = [[0.0, 1.0], [0.0, 1.0]];

/// Returns the middle of a range.
pub(super) fn middle([low, high]: [f64; 2]) -> f64 {
    0.5 * (low + high)
}

/// Returns the area of a part as a share of the aperture's area.
pub(super) fn area(part: Part) -> f64 {
    (part[0][1] - part[0][0]) * (part[1][1] - part[1][0])
}

/// Cuts a part in two by a line across the side `axis`, at the position `at` along that side (0 … 1).
pub(super) fn halves(part: Part, axis: usize, at: f64) -> [Part; 2] {
    [[part[axis][0], at], [at, part[axis][1]]].map(|side| {
        let mut half = part;
        half[axis] = side;
        half
    })
}

/// Returns a part of an aperture as an aperture of its own, with corner and size in metres.
pub(super) fn part_of(aperture: &Aperture, part: Part) -> Aperture {
    let [u, v] = [glam::DVec3::X, glam::DVec3::Y].map(|axis| aperture.surface.room_from_facade(axis));
    let [w, h] = aperture.size;
    Aperture {
        surface: aperture.surface,
        corner: aperture.corner + u * (w * part[0][0]) + v * (h * part[1][0]),
        size: [w * (part[0][1] - part[0][0]), h * (part[1][1] - part[1][0])],
    }
}

/// Returns the share of the area of `part` that lies in `other`.
pub(super) fn overlap(part: Part, other: Part) -> f64 {
    let side = |axis: usize| (part[axis][1].min(other[axis][1]) - part[axis][0].max(other[axis][0])).max(0.0);
    side(0) * side(1) / area(part)
}
