//! The outside as one aperture faces it: sky, ground, skyline, and the sun.

use crate::compute::direction::{Dir, Facade, Orientation, Surface};
use crate::compute::sky::sun_disc::{self, Edge};
use crate::compute::sky::{Outside, SUN_HALF_ANGLE, Sun};
use glam::DVec3;

/// Outside as one aperture faces it.
#[derive(Debug, Clone, Copy)]
pub struct Facing<'a> {
    /// Sky, ground and skyline.
    pub outside: &'a Outside,
    /// Sun's disc; `None` if it does not shine.
    pub sun: Option<&'a Sun>,
    /// Orientation of the room to the compass.
    pub orientation: Orientation,
    /// Surface that the aperture lies in.
    pub surface: Surface,
}

impl Facing<'_> {
    /// Returns the luminance of the outside in a direction of the aperture's frame. \[cd/m²\]
    pub fn luminance(&self, d: Dir<Facade>) -> f64 {
        self.outside.luminance(self.orientation.world_from_room(self.surface.room_dir(d)))
    }

    /// Returns the direction of the sun in the aperture's frame; `None` without sun.
    pub fn sun_direction(&self) -> Option<Dir<Facade>> {
        self.sun.map(|sun| self.surface.facade_dir(self.orientation.room_from_world(sun.direction)))
    }

    /// Returns the direction from which the light of the disc comes as a whole, in the aperture's frame: the middle of
    /// what neither horizon nor the aperture's own plane hides; `None` when nothing of it is in front.
    pub fn sun_entering(&self) -> Option<Dir<Facade>> {
        self.unhidden(self.sun_direction()?)
    }

    /// Returns the middle of what neither horizon nor the aperture's own plane hides of a sun's disc about the
    /// direction `disc`, in the aperture's frame; `None` when nothing of it is in front.
    pub fn unhidden(&self, disc: Dir<Facade>) -> Option<Dir<Facade>> {
        match sun_disc::middle(disc.vector(), self.sun_edges())? {
            middle if middle == disc.vector() => Some(disc),
            middle => Dir::new(middle),
        }
    }

    /// Returns the edges that hide the sun from anything in this surface: horizon or skyline, and the aperture's own
    /// plane; in the aperture's frame. Boxes are not among them: they hide it from some points. Where a skyline has a
    /// corner in front of the disc, a straight edge stands for it that leaves the same share of the disc.
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

    /// Returns the illuminance of the aperture's outside by the sun's disc. \[lx\]
    pub fn sun_illuminance(&self) -> f64 {
        match (self.sun, self.sun_direction()) {
            (Some(sun), Some(direction)) => {
                sun.direct_normal * sun_disc::share(direction.vector(), DVec3::Z, self.sun_edges())
            }
            _ => 0.0,
        }
    }
}
