//! Conversion between the directions of a file and stored directions: the only module with the angle conventions of
//! this format. A stored direction (θ′, φ′), `name` in the code, is a direction of undeviated light (for reflected
//! light: of its mirror image) as [`crate::compute::direction`] defines it.
//!
//! | light from | direction | θ in the file | stored θ′ | stored φ′ |
//! | --- | --- | --- | --- | --- |
//! | outside | incident | 0…90 | θ | φ |
//! | outside | transmitted | 90…180 | 180 − θ | φ + 180 |
//! | outside | reflected | 0…90 | θ | φ + 180 |
//! | inside | incident | 90…180 | 180 − θ | φ + 180 |
//! | inside | transmitted | 0…90 | θ | φ |
//! | inside | reflected | 90…180 | 180 − θ | φ |

use crate::compute::angle::wrap_two_pi;
use crate::compute::btdf::Component;
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::PI;

/// Conversion of angles of a file to stored directions, for incident or emergent directions of one function: θ may be
/// mirrored, φ rotated by 180°.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Naming {
    /// Whether θ in the file runs from 90° to 180°, with θ′ = 180° − θ.
    pub inward: bool,
    /// Whether φ′ = φ + 180°; otherwise φ′ = φ.
    pub turned: bool,
}

impl Naming {
    /// Creates the conversion for the incident directions (towards the source) of a function.
    pub fn incident(component: Component) -> Self {
        let inside = !component.is_front();
        Self { inward: inside, turned: inside }
    }

    /// Creates the conversion for the emergent directions (in which light leaves) of a function.
    pub fn emergent(component: Component) -> Self {
        // Light travels inwards if it is transmitted from outside, or reflected back inside.
        Self { inward: component.is_transmission() == component.is_front(), turned: component.is_front() }
    }

    /// Returns the allowed range of θ in the file. \[°\]
    pub fn range(self) -> [f64; 2] {
        if self.inward { [90.0, 180.0] } else { [0.0, 90.0] }
    }

    /// Converts θ of the file to θ′ of stored directions, or back. \[°\]
    pub fn theta(self, theta_deg: f64) -> f64 {
        if self.inward { 180.0 - theta_deg } else { theta_deg }
    }

    /// Returns the difference φ′ − φ between the azimuths of stored directions and of the file. \[rad\]
    pub fn turn(self) -> f64 {
        if self.turned { PI } else { 0.0 }
    }

    /// Returns the stored direction for angles θ and φ of the file \[°\]; `None` when θ is out of range (by more than
    /// rounding).
    pub fn name(self, theta_deg: f64, phi_deg: f64) -> Option<Dir<Facade>> {
        const SLACK: f64 = 1e-6;
        let [low, high] = self.range();
        if !(theta_deg >= low - SLACK && theta_deg <= high + SLACK) {
            return None;
        }
        let theta = self.theta(theta_deg).clamp(0.0, 90.0).to_radians();
        Some(Dir::from_theta_phi(theta, phi_deg.to_radians() + self.turn()))
    }

    /// Returns θ and φ in the file for a stored direction, without rounding noise of radians; φ = 0 on the normal.
    /// \[°\]
    pub fn file_angles(self, name: Dir<Facade>) -> [f64; 2] {
        let theta = tidy(name.theta().to_degrees());
        let phi = if theta == 0.0 { 0.0 } else { tidy(wrap_two_pi(name.phi() - self.turn()).to_degrees()) };
        [tidy(self.theta(theta)), if phi >= 360.0 { 0.0 } else { phi }]
    }
}

/// Returns an angle in degrees rounded to 1e-9°, without negative zero.
pub(super) fn tidy(degrees: f64) -> f64 {
    (degrees * 1e9).round() / 1e9 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_angles_survive_the_way_through_names() {
        for component in Component::ALL {
            for naming in [Naming::incident(component), Naming::emergent(component)] {
                let [low, high] = naming.range();
                for (theta, phi) in [(low + 30.0, 0.0), (high - 12.0, 90.0), (low + 7.5, 312.0)] {
                    let name = naming.name(theta, phi).unwrap();
                    assert!(name.vector().z >= 0.0);
                    assert_eq!(naming.file_angles(name), [theta, phi]);
                }
                assert!(naming.name(low - 1.0, 0.0).is_none() && naming.name(f64::NAN, 0.0).is_none());
            }
        }
    }

    #[test]
    fn names_agree_with_vectors() {
        // A clear pane and a mirror keep their names.
        let towards_source = Naming::incident(Component::TransmissionFront).name(40.0, 70.0).unwrap();
        assert_eq!(Naming::emergent(Component::TransmissionFront).file_angles(towards_source), [140.0, 250.0]);
        assert_eq!(Naming::emergent(Component::ReflectionFront).file_angles(towards_source), [40.0, 250.0]);
        let from_inside = Naming::incident(Component::TransmissionBack).name(140.0, 250.0).unwrap();
        assert_eq!(Naming::emergent(Component::TransmissionBack).file_angles(from_inside), [40.0, 70.0]);
        assert_eq!(Naming::emergent(Component::ReflectionBack).file_angles(from_inside), [140.0, 70.0]);
    }
}
