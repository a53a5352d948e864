//! Rectangular aperture in the façade or the roof of a room, and its view from a sensor.

use crate::compute::direction::Surface;
use glam::DVec3;

/// Rectangular aperture in the façade (plane y = 0 of the room) or in the roof (plane z = room height).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aperture {
    /// Surface of the room that the aperture lies in.
    pub surface: Surface,
    /// Lower left corner seen from outside, in the room's frame. \[m\]
    pub corner: DVec3,
    /// Size of the aperture along x_F and along y_F of the façade frame. \[m\]
    pub size: [f64; 2],
}

/// Aperture as seen from a point in the room, in axes parallel to the façade frame with their origin in the point: the
/// rectangle `x[0]…x[1]` × `y[0]…y[1]` in the plane z = `distance`. \[m\] A vector from the point to the aperture is a
/// direction of undeviated light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Limits of the aperture along x_F, relative to the point. \[m\]
    pub x: [f64; 2],
    /// Limits of the aperture along y_F, relative to the point. \[m\]
    pub y: [f64; 2],
    /// Distance of the point from the aperture's plane, positive inside the room. \[m\]
    pub distance: f64,
    /// Normal of the sensor in the façade frame: light from the direction ω′ (unit vector from the point to the
    /// aperture) has the cosine of incidence normal·ω′.
    pub normal: DVec3,
}

/// Distance behind the plane of an aperture at which a sensor in the aperture is assumed to be, as a share of the
/// aperture's shorter side. Chosen: about the share of the light that is missed; held by the test
/// `a_sensor_in_the_opening_sees_what_one_just_inside_sees` (1e-8).
const JUST_INSIDE: f64 = 1e-9;

impl Aperture {
    /// Returns the area of the aperture. \[m²\]
    pub fn area(&self) -> f64 {
        self.size[0] * self.size[1]
    }

    /// Returns the distance of a point (room's frame) from the nearest point of the aperture. \[m\]
    pub fn distance(&self, position: DVec3) -> f64 {
        let to_corner = self.surface.facade_from_room(self.corner - position);
        let beyond = |from: f64, size: f64| from.max(-(from + size)).max(0.0);
        DVec3::new(beyond(to_corner.x, self.size[0]), beyond(to_corner.y, self.size[1]), to_corner.z).length()
    }

    /// Returns the four corners of the aperture in the room's frame, counter-clockwise seen from outside from the lower
    /// left. \[m\]
    pub fn corners(&self) -> [DVec3; 4] {
        let u = self.surface.room_from_facade(DVec3::X) * self.size[0];
        let v = self.surface.room_from_facade(DVec3::Y) * self.size[1];
        [self.corner, self.corner + u, self.corner + u + v, self.corner + v]
    }

    /// Returns the relative error of the solid angle of the aperture from a point by rounded coordinates.
    pub fn rounding(&self, position: DVec3) -> f64 {
        let largest = self.corner.abs().max(position.abs()).max_element() + self.size[0].max(self.size[1]);
        4.0 * f64::EPSILON * largest / self.size[0].min(self.size[1])
    }

    /// Returns the position with which a sensor is computed: slightly behind the aperture's plane for a sensor in the
    /// aperture itself, otherwise unchanged; unchanged also for a sensor that faces perpendicularly into the room.
    pub fn entered(&self, position: DVec3, normal: DVec3) -> DVec3 {
        let outward = self.surface.room_from_facade(DVec3::Z);
        let holds = self.holds(self.surface.facade_from_room(self.corner - position));
        if holds && normal.dot(outward) > -1.0 { position - self.just_inside() * outward } else { position }
    }

    /// Whether a point lies in the aperture, given the vector from it to the aperture's corner in the façade frame.
    fn holds(&self, to_corner: DVec3) -> bool {
        let within = |from: f64, size: f64| from <= 0.0 && from + size >= 0.0;
        to_corner.z == 0.0 && within(to_corner.x, self.size[0]) && within(to_corner.y, self.size[1])
    }

    /// Returns the distance behind the aperture's plane with which a sensor in the aperture is computed. \[m\]
    fn just_inside(&self) -> f64 {
        JUST_INSIDE * self.size[0].min(self.size[1])
    }

    /// Returns the view of the aperture from a sensor, given by its position and normal in the room's frame. `None` if
    /// no light from the aperture arrives: the sensor lies outside the aperture's plane, or in that plane and either
    /// beside the aperture or facing perpendicularly into the room. A sensor in the aperture itself has the view from
    /// slightly inside.
    pub fn view(&self, position: DVec3, normal: DVec3) -> Option<View> {
        let mut to_corner = self.surface.facade_from_room(self.corner - position);
        let normal = self.surface.facade_from_room(normal);
        if normal.z > -1.0 && self.holds(to_corner) {
            to_corner.z = self.just_inside();
        }
        (to_corner.z > 0.0).then(|| View {
            x: [to_corner.x, to_corner.x + self.size[0]],
            y: [to_corner.y, to_corner.y + self.size[1]],
            distance: to_corner.z,
            normal,
        })
    }
}

impl View {
    /// Returns the corners of the aperture as vectors from the sensor, façade frame. \[m\]
    pub fn corners(&self) -> [DVec3; 4] {
        [
            DVec3::new(self.x[0], self.y[0], self.distance),
            DVec3::new(self.x[1], self.y[0], self.distance),
            DVec3::new(self.x[1], self.y[1], self.distance),
            DVec3::new(self.x[0], self.y[1], self.distance),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::polygon::projected_solid_angle;
    use std::f64::consts::PI;

    #[test]
    fn a_sensor_in_the_opening_sees_what_one_just_inside_sees() {
        let facade = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 1.0), size: [3.0, 1.6] };
        let roof = Aperture { surface: Surface::Roof, corner: DVec3::new(0.5, 0.5, 3.0), size: [2.0, 2.0] };
        let seen = |aperture: &Aperture, position: DVec3, normal: DVec3| {
            aperture.view(position, normal).map_or(0.0, |view| projected_solid_angle(&view.corners(), view.normal))
        };
        for (aperture, at, out, across) in [
            (facade, DVec3::new(2.0, 0.0, 1.8), DVec3::NEG_Y, DVec3::Z),
            (roof, DVec3::new(1.5, 1.5, 3.0), DVec3::Z, DVec3::X),
        ] {
            assert!((seen(&aperture, at, out) - PI).abs() < 1e-8);
            assert!((seen(&aperture, at, across) - 0.5 * PI).abs() < 1e-8);
            assert_eq!(seen(&aperture, at, -out), 0.0);
            assert!((seen(&aperture, at - 1e-12 * out, out) - PI).abs() < 1e-8);
            // Beside the opening there is wall.
            assert!(aperture.view(DVec3::ZERO.with_z(at.z).with_y(at.y * 1.9), out).is_none());
        }
        // On the border half of the opening's light arrives.
        let border = seen(&facade, DVec3::new(0.5, 0.0, 1.8), DVec3::NEG_Y);
        assert!((border - 0.5 * PI).abs() < 1e-8, "{border}");
    }
}
