//! Directions and the frames they are given in. The one place for angle and axis conventions.
//!
//! ```text
//!  World   x east, y north, z up.                      Sun and sky live here.
//!  Room    x right seen from outside, y into the room, z up; floor z = 0, façade y = 0, its outward normal −y.
//!  Facade  x right seen from outside, y up, z outward normal (right-handed).
//!          façade wall:  x_F = x_room, y_F = z_room, z_F = −y_room
//!          roof:         x_F = x_room, y_F = y_room, z_F =  z_room      ("up" of a system in a roof is +y)
//! ```
//! In the façade frame θ is counted from +z, φ counter-clockwise from +x towards +y (0 = right, 90 = up).
//!
//! * [`Incident`]: from the element **towards the source**. Light from outside: z_F > 0.
//! * [`Emergent`]: in which the light **leaves**. Light into the room: z_F < 0.
//! * **Direction of undeviated light** ω′ = −ω_a of an emergent direction ω_a: undeviated light that arrives from ω_e
//!   leaves in −ω_e, so ω′ is the incident direction from which a clear pane would send light along ω_a. All
//!   transmitted data are stored by ω′, so that a clear pane is a diagonal matrix and reciprocity is a plain transpose:
//!   q_front(ω_e, ω′) = q_back(ω′, ω_e). Light from inside is stored by the direction in which it travels (z_F > 0) on
//!   both sides. Reflected light r is stored by (−r_x, −r_y, r_z), so that a mirror is a diagonal matrix as well.
//!
//! A direction of bearing β and altitude h is x = −sin(β − A) cos h, y = −cos(β − A) cos h, z = sin h in the room's
//! axes, with A the bearing of the façade's outward normal.

use super::angle::{Bearing, wrap_two_pi};
use glam::DVec3;
use std::marker::PhantomData;

/// Frame tag of the world's axes: x east, y north, z up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct World;
/// Frame tag of the room's axes: x to the right seen from outside, y from the façade into the room, z up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room;
/// Frame tag of an aperture's axes (façade frame): x to the right seen from outside, y up, z outward normal; in a roof
/// x and y are those of the room and z points up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facade;

/// Direction as a unit vector in the axes of the frame `F` ([`World`], [`Room`] or [`Facade`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dir<F> {
    vector: DVec3,
    frame: PhantomData<F>,
}

impl<F> Dir<F> {
    /// Creates a direction from a vector of any length by scaling it to length 1; `None` if its length is 0 or not
    /// finite.
    pub fn new(vector: DVec3) -> Option<Self> {
        vector.try_normalize().map(Self::from_unit)
    }

    /// Creates a direction from a vector that is already of unit length (to rounding).
    pub const fn from_unit(vector: DVec3) -> Self {
        Self { vector, frame: PhantomData }
    }

    /// Creates a direction from the polar angle θ from the +z axis and the azimuth φ about it, from +x towards +y.
    /// \[rad\]
    pub fn from_theta_phi(theta: f64, phi: f64) -> Self {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_phi, cos_phi) = phi.sin_cos();
        Self::from_unit(DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta))
    }

    /// Returns the direction as a unit vector in the axes of its frame.
    pub const fn vector(self) -> DVec3 {
        self.vector
    }

    /// Returns the polar angle θ of the direction from the +z axis of its frame, 0 … π. \[rad\] Exact near the axis,
    /// where `acos` is not.
    pub fn theta(self) -> f64 {
        self.vector.truncate().length().atan2(self.vector.z)
    }

    /// Returns the azimuth φ of the direction about the z axis of its frame, from +x towards +y, 0 ≤ φ < 2π; 0 on the z
    /// axis. \[rad\]
    pub fn phi(self) -> f64 {
        wrap_two_pi(self.vector.y.atan2(self.vector.x))
    }

    /// Returns the opposite direction.
    pub fn reversed(self) -> Self {
        Self::from_unit(-self.vector)
    }

    /// Returns the cosine of the angle to another direction of the same frame.
    pub fn dot(self, other: Self) -> f64 {
        self.vector.dot(other.vector)
    }
}

impl Dir<World> {
    /// Creates a direction from its altitude above the horizon \[rad\] and its compass bearing (clockwise from north).
    pub fn from_altitude_bearing(altitude: f64, bearing: Bearing) -> Self {
        let (sin_bearing, cos_bearing) = bearing.radians().sin_cos();
        let cos_altitude = altitude.cos();
        Self::from_unit(DVec3::new(sin_bearing * cos_altitude, cos_bearing * cos_altitude, altitude.sin()))
    }

    /// Returns the altitude of the direction above the horizon, −π/2 … π/2. \[rad\]
    pub fn altitude(self) -> f64 {
        self.vector.z.atan2(self.vector.truncate().length())
    }

    /// Returns the compass bearing of the direction's horizontal component, clockwise from north.
    pub fn bearing(self) -> Bearing {
        Bearing::from_radians(wrap_two_pi(self.vector.x.atan2(self.vector.y)))
    }
}

/// Incident direction: unit vector from the aperture towards the light source, in the façade frame (z outward normal).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incident(pub Dir<Facade>);

/// Emergent direction: unit vector in which light leaves the aperture, in the façade frame (z outward normal, so that
/// light into the room has z < 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Emergent(pub Dir<Facade>);

impl Emergent {
    /// Returns the emergent direction −ω_e of light that arrives from the incident direction ω_e and passes undeviated.
    pub fn from_undeviated(incident: Dir<Facade>) -> Self {
        Self(incident.reversed())
    }

    /// Returns the direction of undeviated light ω′ = −ω_a: the incident direction from which a clear pane would send
    /// light in this emergent direction ω_a.
    pub fn undeviated_incident(self) -> Dir<Facade> {
        self.0.reversed()
    }
}

/// Orientation of the room to the compass: rotation about the vertical between the world's axes (x east, y north) and
/// the room's (x to the right seen from outside, y into the room).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orientation {
    sin: f64,
    cos: f64,
}

impl Orientation {
    /// Creates the orientation of a room from the bearing of its façade's outward normal.
    pub fn new(facade_normal: Bearing) -> Self {
        let (sin, cos) = facade_normal.radians().sin_cos();
        Self { sin, cos }
    }

    /// Converts a direction from the world's axes to the room's. With A the bearing of the façade's outward normal, the
    /// room's axes in (east, north) are x_room = (−cos A, sin A) and y_room = (−sin A, −cos A).
    pub fn room_from_world(self, d: Dir<World>) -> Dir<Room> {
        let v = d.vector();
        Dir::from_unit(DVec3::new(-self.cos * v.x + self.sin * v.y, -self.sin * v.x - self.cos * v.y, v.z))
    }

    /// Converts a direction from the room's axes to the world's (x east, y north, z up).
    pub fn world_from_room(self, d: Dir<Room>) -> Dir<World> {
        Dir::from_unit(self.to_world(d.vector()))
    }

    /// Converts a vector, or a point relative to the room's origin, from the room's axes to the world's (x east, y
    /// north, z up).
    pub fn to_world(self, v: DVec3) -> DVec3 {
        DVec3::new(-self.cos * v.x - self.sin * v.y, self.sin * v.x - self.cos * v.y, v.z)
    }

    /// Converts a vector, or a point relative to the room's origin, from the world's axes (x east, y north, z up) to
    /// the room's.
    pub fn to_room(self, v: DVec3) -> DVec3 {
        DVec3::new(-self.cos * v.x + self.sin * v.y, -self.sin * v.x - self.cos * v.y, v.z)
    }

    /// Returns cosine and sine of the angle from east to the room's x axis, counter-clockwise seen from above.
    pub fn turn(self) -> [f64; 2] {
        [-self.cos, self.sin]
    }
}

/// Surface of the room that an aperture lies in; it fixes the aperture's axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Surface {
    /// Façade wall, the plane y = 0 of the room.
    Facade,
    /// Flat roof: the ceiling, the plane z = room height.
    Roof,
}

impl Surface {
    /// Converts a vector (direction or offset) from the room's axes to the façade frame of an aperture in this surface
    /// (x to the right seen from outside, y up, z outward normal).
    pub fn facade_from_room(self, v: DVec3) -> DVec3 {
        match self {
            Self::Facade => DVec3::new(v.x, v.z, -v.y),
            Self::Roof => v,
        }
    }

    /// Converts a vector (direction or offset) from the façade frame of an aperture in this surface to the room's axes;
    /// the inverse of [`Self::facade_from_room`].
    pub fn room_from_facade(self, v: DVec3) -> DVec3 {
        match self {
            Self::Facade => DVec3::new(v.x, -v.z, v.y),
            Self::Roof => v,
        }
    }

    /// Converts a direction from the room's axes to the façade frame of an aperture in this surface.
    pub fn facade_dir(self, d: Dir<Room>) -> Dir<Facade> {
        Dir::from_unit(self.facade_from_room(d.vector()))
    }

    /// Converts a direction from the façade frame of an aperture in this surface to the room's axes.
    pub fn room_dir(self, d: Dir<Facade>) -> Dir<Room> {
        Dir::from_unit(self.room_from_facade(d.vector()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn south_facade_has_x_east_and_y_north() {
        let south = Orientation::new(Bearing::from_degrees(180.0));
        let x = south.world_from_room(Dir::from_unit(DVec3::X)).vector();
        let y = south.world_from_room(Dir::from_unit(DVec3::Y)).vector();
        assert!((x - DVec3::X).length() < 1e-15 && (y - DVec3::Y).length() < 1e-15);
    }

    #[test]
    fn bearings_map_as_the_scene_file_says() {
        let (a, b, h) = (130_f64, 200_f64, 25_f64);
        let room = Orientation::new(Bearing::from_degrees(a))
            .room_from_world(Dir::from_altitude_bearing(h.to_radians(), Bearing::from_degrees(b)))
            .vector();
        let d = (b - a).to_radians();
        let expected =
            DVec3::new(-d.sin() * h.to_radians().cos(), -d.cos() * h.to_radians().cos(), h.to_radians().sin());
        assert!((room - expected).length() < 1e-15);
    }

    #[test]
    fn frames_are_right_handed_and_invertible() {
        for surface in [Surface::Facade, Surface::Roof] {
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| surface.room_from_facade(v));
            assert!((x.cross(y) - z).length() < 1e-15);
            let v = DVec3::new(0.3, -0.5, 0.8);
            assert_eq!(surface.facade_from_room(surface.room_from_facade(v)), v);
        }
        assert_eq!(Surface::Facade.room_from_facade(DVec3::Z), -DVec3::Y);
        let o = Orientation::new(Bearing::from_degrees(77.0));
        let d = Dir::from_altitude_bearing(0.4, Bearing::from_degrees(10.0));
        assert!((o.world_from_room(o.room_from_world(d)).vector() - d.vector()).length() < 1e-15);
    }

    #[test]
    fn sun_above_a_facade_is_at_phi_90_and_leaves_downwards() {
        let south = Orientation::new(Bearing::from_degrees(180.0));
        let sun = Dir::from_altitude_bearing(40_f64.to_radians(), Bearing::from_degrees(180.0));
        let incident = Incident(Surface::Facade.facade_dir(south.room_from_world(sun)));
        assert!((incident.0.phi().to_degrees() - 90.0).abs() < 1e-12);
        assert!((incident.0.theta().to_degrees() - 40.0).abs() < 1e-12);
        let through = Emergent::from_undeviated(incident.0);
        assert!((through.0.phi().to_degrees() - 270.0).abs() < 1e-12);
        assert!((through.0.theta().to_degrees() - 140.0).abs() < 1e-12);
    }
}
