//! Division of a fan of light into pieces. A fan is light that a curved mirror distributes uniformly between two
//! directions.

use super::parallel::Beam;
use crate::compute::direction::{Dir, Facade};
use glam::DVec3;

/// Difference below which two direction cosines count as equal: above all rounding of f64 (2⁻⁵² ≈ 2.2e-16 per
/// operation), and
/// 0.0002″ as an angle.
const EQUAL: f64 = 1e-9;

/// Divides a fan into parts of equal angle, none wider than `step` \[rad\]; a parallel beam stays one part.
pub fn pieces(beam: &Beam, step: f64) -> impl Iterator<Item = Beam> {
    let beam = *beam;
    let parallel = beam.directions[0] == beam.directions[1];
    let count = if parallel { 1 } else { (wide(&beam) / step).ceil().max(1.0) as usize };
    let at = move |k: usize| between(&beam, k as f64 / count as f64);
    let share = beam.share / count as f64;
    (0..count).map(move |k| if count == 1 { beam } else { Beam { directions: [at(k), at(k + 1)], share, ..beam } })
}

/// Returns the direction in the middle of a fan, as a direction of undeviated light like those of its ends.
pub fn middle(beam: &Beam) -> Dir<Facade> {
    if beam.directions[0] == beam.directions[1] { beam.directions[0] } else { between(beam, 0.5) }
}

/// Returns the angle between the two end directions of a fan. \[rad\]
pub fn wide(beam: &Beam) -> f64 {
    let [a, b] = beam.directions.map(|direction| direction.vector());
    a.cross(b).length().atan2(a.dot(b))
}

/// Returns the direction at the fraction `part`, 0 … 1, of the way from one end of a fan to the other. Systems that are
/// endless along an axis keep the direction cosine along it and distribute light uniformly in the angle about it.
fn between(beam: &Beam, part: f64) -> Dir<Facade> {
    let [a, b] = beam.directions.map(|direction| direction.vector());
    let axis = if (a.x - b.x).abs() < EQUAL {
        DVec3::X
    } else if (a.y - b.y).abs() < EQUAL {
        DVec3::Y
    } else {
        a.cross(b)
    };
    let Some(axis) = axis.try_normalize() else { return beam.directions[0] };
    let across = a - axis * a.dot(axis);
    let aside = axis.cross(across);
    let angle = (b.dot(aside)).atan2(b.dot(across));
    let (sin, cos) = (part * angle).sin_cos();
    Dir::new(axis * a.dot(axis) + across * cos + aside * sin).unwrap_or(beam.directions[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_fill_the_fan_evenly_and_keep_what_its_axis_keeps() {
        let direction = |x: f64, angle: f64| {
            let rest = (1.0 - x * x).sqrt();
            Dir::from_unit(DVec3::new(x, rest * angle.sin(), rest * angle.cos()))
        };
        let fan = Beam { directions: [direction(0.4, -0.3), direction(0.4, 0.5)], share: 0.2, transmitted: true };
        let parts: Vec<Beam> = pieces(&fan, 0.1).collect();
        assert_eq!(parts.len(), 8);
        for (k, part) in parts.iter().enumerate() {
            let [from, to] = [k, k + 1].map(|k| direction(0.4, -0.3 + 0.1 * k as f64).vector());
            assert!(
                (part.directions[0].vector() - from).length() < 1e-12
                    && (part.directions[1].vector() - to).length() < 1e-12
            );
            assert!((part.share - 0.025).abs() < 1e-15 && part.transmitted);
        }
        assert!((middle(&fan).vector() - direction(0.4, 0.1).vector()).length() < 1e-12);
        let beam = Beam::back(direction(0.1, 0.2), 0.3);
        assert_eq!(pieces(&beam, 0.01).collect::<Vec<_>>(), [beam]);
    }
}
