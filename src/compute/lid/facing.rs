//! Sky, ground, skyline and sun in the façade frame of one aperture.

use crate::compute::direction::{Dir, Facade, Orientation, Surface};
use crate::compute::sky::sun_disc::{self, Edge};
use crate::compute::sky::{Outside, SUN_HALF_ANGLE, Sun};
use glam::DVec3;

/// Sky, ground, skyline and sun in front of one aperture, with the orientation of the aperture.
#[derive(Debug, Clone, Copy)]
pub struct Facing<'a> {
    /// Luminances of sky, ground and skyline.
    pub outside: &'a Outside,
    /// Direct sun; `None` if it does not shine.
    pub sun: Option<&'a Sun>,
    /// Orientation of the room to the compass.
    pub orientation: Orientation,
    /// Surface of the room that the aperture lies in.
    pub surface: Surface,
}

impl Facing<'_> {
    /// Returns the luminance of sky, ground or skyline in a direction of the façade frame, without the sun. \[cd/m²\]
    pub fn luminance(&self, d: Dir<Facade>) -> f64 {
        self.outside.luminance(self.orientation.world_from_room(self.surface.room_dir(d)))
    }

    /// Returns the direction towards the centre of the sun in the façade frame; `None` without sun.
    pub fn sun_direction(&self) -> Option<Dir<Facade>> {
        self.sun.map(|sun| self.surface.facade_dir(self.orientation.room_from_world(sun.direction)))
    }

    /// Returns the direction towards the middle of the visible part of the sun's disc, in the façade frame: the part
    /// that is hidden neither by the horizon or skyline nor by the aperture's plane. `None` if no part is visible.
    pub fn sun_entering(&self) -> Option<Dir<Facade>> {
        self.unhidden(self.sun_direction()?)
    }

    /// Returns the direction towards the middle of the visible part of a disc of the sun's size about the direction
    /// `disc`, in the façade frame: the part that is hidden neither by the horizon or skyline nor by the aperture's
    /// plane. `None` if no part is visible.
    pub fn unhidden(&self, disc: Dir<Facade>) -> Option<Dir<Facade>> {
        match sun_disc::middle(disc.vector(), self.sun_edges())? {
            middle if middle == disc.vector() => Some(disc),
            middle => Dir::new(middle),
        }
    }

    /// Returns the straight edges that hide the sun from all points of the aperture's surface, in the façade frame:
    /// horizon or skyline, and the aperture's plane. Boxes are not among them, because they hide it from some points
    /// only. A corner of the skyline in front of the disc is replaced by a straight edge that leaves the same share of
    /// the disc visible.
    pub fn sun_edges(&self) -> [Edge; 2] {
        let skyline = self.outside.surroundings().and_then(|surroundings| surroundings.skyline.as_ref());
        if let (Some(skyline), Some(sun)) = (skyline, self.sun) {
            let to = sun.direction.vector();
            let up = skyline.plane(sun.direction.bearing().radians());
            let free = skyline.free_share(to, SUN_HALF_ANGLE);
            let edge = Edge::leaving(self.surface.facade_from_room(self.orientation.to_room(up)), up.dot(to), free);
            return [edge, Edge::great_circle(DVec3::Z)];
        }
        let zenith = self.surface.facade_from_room(DVec3::Z);
        let offset = self.outside.skyline_altitude().sin();
        [Edge { normal: zenith, offset }, Edge::great_circle(DVec3::Z)]
    }

    /// Returns the illuminance of the aperture's outside by direct sun, without the shadow of boxes. \[lx\]
    pub fn sun_illuminance(&self) -> f64 {
        match (self.sun, self.sun_direction()) {
            (Some(sun), Some(direction)) => {
                sun.direct_normal * sun_disc::share(direction.vector(), DVec3::Z, self.sun_edges())
            }
            _ => 0.0,
        }
    }
}
