//! Angles of photometric tables: checks of rising lists, and planes of the full turn from the mirror images of stored
//! ones.

use super::FormatError;
use super::luminaire_text::at_line;

/// Difference below which two angles are equal when written with four decimals. \[°\]
pub(super) const CLOSEST: f64 = 2e-4;

/// Distance from 360° below which a plane counts as that at 0° (rounding). \[°\]
const SAME_PLANE: f64 = 1e-6;

/// Whether two angles are equal when written in a file. \[°\]
pub(super) fn same_angle(a: f64, b: f64) -> bool {
    (a - b).abs() < CLOSEST
}

/// Vertical planes of symmetry of an intensity distribution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mirrors {
    None,
    /// Symmetry about the plane C0–C180.
    C0,
    /// Symmetry about the plane C90–C270.
    C90,
    Both,
}

/// Planes of the full turn, and for each the index of the stored plane that it copies.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Turn {
    /// Angles of the planes, from 0° to below 360°, rising. \[°\]
    pub c_deg: Vec<f64>,
    /// Index of the stored plane that each plane of `c_deg` copies.
    pub source: Vec<usize>,
}

impl Turn {
    /// Creates the planes of the full turn from the stored ones \[°\] and their mirror images, sorted by angle. A plane
    /// at 360° counts as that at 0°; a single plane represents all and is put at 0°.
    pub fn new(stored: &[f64], mirrors: Mirrors) -> Self {
        if stored.len() == 1 {
            return Self { c_deg: vec![0.0], source: vec![0] };
        }
        let mut all: Vec<(f64, usize)> = stored.iter().copied().zip(0..).collect();
        if matches!(mirrors, Mirrors::C90 | Mirrors::Both) {
            let image = |c: f64| if c <= 180.0 { 180.0 - c } else { 540.0 - c };
            all.extend(all.clone().into_iter().map(|(c, k)| (image(c), k)));
        }
        if matches!(mirrors, Mirrors::C0 | Mirrors::Both) {
            all.extend(all.clone().into_iter().map(|(c, k)| ((360.0 - c).rem_euclid(360.0), k)));
        }
        for (c, _) in &mut all {
            if let Some(first) = [0.0, stored[0]].into_iter().find(|first| (*c - first - 360.0).abs() < SAME_PLANE) {
                *c = first;
            }
        }
        // Stable, so that a plane itself comes before a mirror image that lies on it.
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.dedup_by(|a, b| same_angle(a.0, b.0));
        let (c_deg, source) = all.into_iter().unzip();
        Self { c_deg, source }
    }
}

/// Checks that the angles rise by steps that files can distinguish; returns an error otherwise. `line`, `name`:
/// position and name of the list for the message.
pub(super) fn check_rising(angles: &[f64], line: usize, name: &str) -> Result<(), FormatError> {
    match angles.windows(2).find(|pair| pair[1] - pair[0] < CLOSEST) {
        Some(pair) => Err(at_line(
            line,
            format!("{name} {} after {}", pair[1], pair[0]),
            format!("{name}s that increase strictly"),
        )),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_are_found_by_angle_whatever_the_order_and_the_steps() {
        let turn = |stored: &[f64], mirrors| {
            let turn = Turn::new(stored, mirrors);
            turn.c_deg.into_iter().zip(turn.source).collect::<Vec<_>>()
        };
        assert_eq!(
            turn(&[0.0, 20.0, 90.0], Mirrors::Both),
            [(0.0, 0), (20.0, 1), (90.0, 2), (160.0, 1), (180.0, 0), (200.0, 1), (270.0, 2), (340.0, 1)]
        );
        assert_eq!(
            turn(&[270.0, 300.0, 0.0, 90.0], Mirrors::C90),
            [(0.0, 2), (90.0, 3), (180.0, 2), (240.0, 1), (270.0, 0), (300.0, 1)]
        );
        assert_eq!(turn(&[0.0, 70.0, 180.0], Mirrors::C0), [(0.0, 0), (70.0, 1), (180.0, 2), (290.0, 1)]);
        assert_eq!(turn(&[0.0, 120.0, 240.0, 360.0], Mirrors::None), [(0.0, 0), (120.0, 1), (240.0, 2)]);
    }
}
