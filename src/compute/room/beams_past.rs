//! Beams of the sun through an aperture that obstructions shade in part: shadows with sharp edges, and penumbra for
//! undeviated beams.

use super::aperture::Aperture;
use super::direct::{DirectLight, Sensor};
use crate::compute::direction::{Dir, Orientation, World};
use crate::compute::estimate::Estimate;
use crate::compute::lid::{BeamLight, Facing};
use crate::compute::sky::sun_disc::{self, Edge};
use crate::compute::sky::{SUN_HALF_ANGLE, Sun};
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::shading::lit_pieces;
use crate::compute::surroundings::solid::Face;
use glam::DVec3;

/// Returns the outside of an aperture as a face in the world's axes, with its origin in the lower left corner.
pub fn outer_face(aperture: &Aperture, orientation: Orientation) -> Face {
    let axis = |v: DVec3| orientation.to_world(aperture.surface.room_from_facade(v));
    Face {
        origin: orientation.to_world(aperture.corner),
        normal: axis(DVec3::Z),
        u: axis(DVec3::X),
        v: axis(DVec3::Y),
        limits: [[0.0, aperture.size[0]], [0.0, aperture.size[1]]],
    }
}

/// Returns the sunlit part of an aperture behind obstructions, for the centre of the sun's disc: convex pieces with
/// their corners in the room's frame \[m\], and their share of the aperture's area. `facing`: sun and orientation;
/// `around`: obstructions.
pub fn lit(aperture: &Aperture, facing: &Facing<'_>, around: &Surroundings) -> (Vec<Vec<DVec3>>, f64) {
    let Some(sun) = facing.sun else { return (Vec::new(), 0.0) };
    let face = outer_face(aperture, facing.orientation);
    let pieces = lit_pieces(&face, around.solids.iter(), sun.direction.vector());
    let share = pieces.iter().map(|piece| crate::compute::polygon::area(piece).abs()).sum::<f64>() / aperture.area();
    let corner = |p: &glam::DVec2| facing.orientation.to_room(face.point(p.x, p.y));
    (pieces.iter().map(|piece| piece.iter().map(corner).collect()).collect(), share)
}

/// Returns the sunlit parts of an aperture for four points on the rim of the sun's disc, two across and two along. They
/// bound the position of shadow edges if it is not known how a system rotates the disc.
pub fn lit_by_rim(aperture: &Aperture, facing: &Facing<'_>, around: &Surroundings) -> Vec<Vec<Vec<DVec3>>> {
    let Some(sun) = facing.sun else { return Vec::new() };
    let middle = sun.direction.vector();
    let (u, v) = middle.any_orthonormal_pair();
    let by = |aside: DVec3| {
        let direction = Dir::<World>::new(middle + SUN_HALF_ANGLE.tan() * aside).unwrap_or(sun.direction);
        lit(aperture, &Facing { sun: Some(&Sun { direction, ..*sun }), ..*facing }, around).0
    };
    [u, -u, v, -v].map(by).into()
}

/// Computes the illuminance of a sensor by beams of the sun through an aperture behind obstructions. An undeviated beam
/// lights the sensor in proportion to the part of the disc that it sees past the obstructions. A redirected beam comes
/// from the pieces `lit` of the aperture, which are sunlit for the centre of the disc; its error is the change with the
/// pieces `rim`, which are sunlit for points of the disc's rim; it has no penumbra of the obstructions.
pub fn beams_past(
    sensor: &Sensor,
    aperture: &Aperture,
    lit: &[Vec<DVec3>],
    rim: &[Vec<Vec<DVec3>>],
    beams: &[BeamLight],
    facing: &Facing<'_>,
    around: &Surroundings,
) -> DirectLight {
    let Some(view) = aperture.view(sensor.position, sensor.normal).filter(|_| !beams.is_empty()) else {
        return DirectLight::default();
    };
    let surface = aperture.surface;
    let own = [Edge::great_circle(DVec3::Z), Edge::great_circle(view.normal)];
    let mut bodies: Option<Vec<Vec<DVec3>>> = None;
    let (mut sum, mut data_error) = (Estimate::default(), 0.0);
    for beam in beams {
        let to = beam.to.vector();
        let mut off: f64 = 0.0;
        let e = if beam.straight {
            let bodies = bodies.get_or_insert_with(|| {
                let eye = facing.orientation.to_world(sensor.position);
                let turned = |n: DVec3| surface.facade_from_room(facing.orientation.to_room(n));
                around.solids.iter().map(|solid| solid.cone(eye).into_iter().map(turned).collect()).collect()
            });
            let edges = sun_disc::opening(&view.corners()).into_iter().chain(own).chain([facing.sun_edges()[0]]);
            sun_disc::share_past(to, view.normal, edges, bodies)
        } else {
            let through = |piece: &Vec<DVec3>| {
                let corners: Vec<DVec3> =
                    piece.iter().map(|corner| surface.facade_from_room(*corner - sensor.position)).collect();
                sun_disc::share(to, view.normal, sun_disc::opening(&corners).into_iter().chain(own))
            };
            let e = lit.iter().map(through).sum::<f64>();
            off = rim.iter().map(|lit| (lit.iter().map(through).sum::<f64>() - e).abs()).fold(0.0, f64::max);
            e
        };
        let e = beam.normal * e;
        sum += Estimate::new(e, e * beam.error + beam.normal * off);
        data_error += e * beam.uncertainty;
    }
    DirectLight { all: sum, beam: sum.value, data_error }
}
