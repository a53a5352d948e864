//! Shadows on the ground for pictures; they are those with which the luminance of the ground is computed.

use super::faces::direct_sun;
use super::outside::Outside;
use super::scenery::Setting;
use super::sun::Sun;
use crate::compute::direction::Orientation;
use glam::DVec2;

/// Distance below which two shadows are joined into one. \[m\] Chosen: pictures only; the rounding of coordinates of
/// 10⁶ m, the largest allowed, is a tenth of it.
const JOINED: f64 = 1e-9;

/// Ground in front of the building with the shadows of obstructions on it, in the room's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundShade {
    /// Height of the ground, z in the room's frame. \[m\]
    pub height: f64,
    /// Whether direct sun reaches the ground outside the shadows.
    pub is_sunny: bool,
    /// Outlines of the shadows for the centre of the sun's disc, (x, y) in the room's frame: convex and
    /// counter-clockwise; they may overlap. \[m\]
    pub shadows: Vec<Vec<DVec2>>,
}

impl GroundShade {
    /// Creates the shadows of obstructions `setting`, given in the room's frame; `outside`: the sky with its skyline.
    pub fn new(setting: &Setting, outside: &Outside, sun: Option<&Sun>, orientation: Orientation) -> Self {
        let skyline = outside.surroundings().and_then(|around| around.skyline.as_ref());
        let sun = direct_sun(outside, skyline, sun).map(|(direction, _)| orientation.to_room(direction));
        Self {
            height: setting.ground,
            is_sunny: sun.is_some_and(|sun| sun.z > 0.0),
            shadows: sun.map_or_else(Vec::new, |sun| setting.shadows_on_ground(sun)),
        }
    }

    /// Returns the shaded intervals of the line of constant `x` on the ground: lower and upper y of each, rising,
    /// room's frame. \[m\]
    pub fn stretches(&self, x: f64) -> Vec<[f64; 2]> {
        let mut stretches: Vec<[f64; 2]> = self.shadows.iter().filter_map(|shadow| stretch(shadow, x)).collect();
        stretches.sort_by(|a, b| a[0].total_cmp(&b[0]));
        stretches.dedup_by(|next, last| {
            let joined = next[0] <= last[1] + JOINED;
            if joined {
                last[1] = last[1].max(next[1]);
            }
            joined
        });
        stretches
    }
}

/// Returns the interval of the line of constant `x` that lies in a convex polygon: lower and upper y.
fn stretch(polygon: &[DVec2], x: f64) -> Option<[f64; 2]> {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed = sides.filter(|(p, q)| p.x != q.x && (p.x - x) * (q.x - x) <= 0.0);
    let ends = crossed.map(|(p, q)| p.y + (q.y - p.y) * (x - p.x) / (q.x - p.x));
    let [low, high] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
    (high > low).then_some([low, high])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::Dir;
    use crate::compute::sky::{Distribution, Finish};
    use crate::compute::surroundings::solid::Solid;
    use glam::DVec3;

    fn solid(from: [f64; 3], to: [f64; 3]) -> Solid {
        Solid::new(DVec3::from_array(from), DVec3::from_array(to), 0.0)
    }

    /// A room 4 × 6 × 3 m with a wall 2 m high and 0.1 m thick at 5 m from the façade.
    fn wall() -> Setting {
        Setting {
            boxes: vec![(solid([-50.0, -5.1, 0.0], [54.0, -5.0, 2.0]), Finish::Reflectance(0.3))],
            room: solid([0.0; 3], [4.0, 6.0, 3.0]),
            building: None,
            ground: 0.0,
        }
    }

    /// Returns the shaded stretches at x = 2 m of a room that faces south, to the millimetre; altitude and bearing of
    /// the sun in \[°\].
    fn shaded(setting: &Setting, altitude: f64, bearing: f64) -> Vec<[f64; 2]> {
        let shade = shade(setting, altitude, bearing, 0.0);
        shade.stretches(2.0).into_iter().map(|ends| ends.map(|y| (1e3 * y).round() / 1e3)).collect()
    }

    fn shade(setting: &Setting, altitude: f64, bearing: f64, skyline: f64) -> GroundShade {
        let outside = Outside::new(Distribution::uniform(), 1e4).unwrap().with_skyline(skyline, 0.0).unwrap();
        let direction = Dir::from_altitude_bearing(altitude.to_radians(), Bearing::from_degrees(bearing));
        let sun = Sun { direction, direct_normal: 5e4 };
        GroundShade::new(setting, &outside, Some(&sun), Orientation::new(Bearing::from_degrees(180.0)))
    }

    #[test]
    fn a_wall_shades_its_height_over_the_tangent_of_the_sun() {
        // Behind the wall from its outer side on; its top edge falls 2 m nearer to the façade.
        assert_eq!(shaded(&wall(), 45.0, 180.0), [[-5.1, -3.0]]);
        // From 60° beside the façade's normal half as far, by the profile angle.
        assert_eq!(shaded(&wall(), 45.0, 240.0), [[-5.1, -4.0]]);
        assert_eq!(shaded(&wall(), 45.0, 0.0), [[-7.1, -5.0]]);
        // Ground 3 m lower is below a wall of 5 m.
        let mut high = wall();
        high.ground = -3.0;
        high.boxes[0].0 = solid([-50.0, -5.1, -9.0], [54.0, -5.0, 2.0]);
        assert_eq!(shaded(&high, 45.0, 180.0), [[-5.1, 0.0]]);
        assert_eq!(shade(&high, 45.0, 180.0, 0.0).height, -3.0);
    }

    #[test]
    fn a_building_shades_the_ground_and_a_room_without_one_does_not() {
        let mut north = wall();
        assert_eq!(shaded(&north, 45.0, 0.0), [[-7.1, -5.0]]);
        // From the rear 9 m in front of the façade, over the wall and its shadow.
        north.building = Some((solid([-50.0, 0.0, 0.0], [54.0, 12.0, 9.0]), 0.3));
        assert_eq!(shaded(&north, 45.0, 0.0), [[-9.0, 12.0]]);
        assert_eq!(shaded(&north, 80.0, 0.0), [[-5.453, -5.0], [-1.587, 12.0]]);
    }

    #[test]
    fn what_the_sun_does_not_reach_has_no_shade() {
        let night = shade(&wall(), -10.0, 180.0, 0.0);
        assert!(!night.is_sunny && night.shadows.is_empty());
        let hidden = shade(&wall(), 20.0, 180.0, 30_f64.to_radians());
        assert!(!hidden.is_sunny && hidden.shadows.is_empty());
        let beside = shade(&wall(), 45.0, 180.0, 0.0);
        assert!(beside.is_sunny && beside.stretches(60.0).is_empty());
    }
}
