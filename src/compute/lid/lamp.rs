//! Luminaire with the usual computation of lighting programs: a luminous area, divided into parts of at most a quarter
//! of their distance, each of which is a point source with the intensity distribution of the whole; intensities between
//! the nodes of C and γ by linear interpolation.

use super::c_gamma::Aim;
use super::intensities::Intensities;
use super::tiling::{Tile, parts};
use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use glam::DVec3;
use std::sync::Arc;

/// Luminaire in the room: a rectangular luminous area with a luminous-intensity distribution.
#[derive(Debug, Clone)]
pub struct Lamp {
    /// Position and size of the luminous area.
    pub tile: Tile,
    /// Surface of the room that the area lies in.
    pub surface: Surface,
    /// Orientation of the C-γ system relative to the surface.
    pub aim: Aim,
    /// Luminous flux of the luminaire. \[lm\]
    pub flux: f64,
    /// Luminous-intensity distribution of the luminaire. \[cd\]
    pub table: Arc<Intensities>,
}

impl Lamp {
    /// Returns the luminous intensity of the luminaire in a direction of propagation, façade frame. \[cd\]
    pub fn intensity(&self, emergent: Emergent) -> f64 {
        let (c, gamma) = self.aim.angles(emergent);
        self.table.at(c, gamma)
    }

    /// Returns the direct illuminance by the luminaire at a point with the surface normal `normal`, both in the room's
    /// frame. \[lx\] Points in or behind the plane of the luminous area receive no light.
    pub fn illuminance(&self, position: DVec3, normal: DVec3) -> f64 {
        let Tile { centre, size } = self.tile;
        let to = self.surface.facade_from_room(position - centre);
        if to.z >= 0.0 {
            return 0.0;
        }
        let normal = self.surface.facade_from_room(normal);
        let n = parts(size, to.length());
        let at = |k: usize, length: f64| ((k as f64 + 0.5) / n as f64 - 0.5) * length;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let ray = to - DVec3::new(at(i, size[0]), at(j, size[1]), 0.0);
                let square = ray.length_squared();
                let along = ray / square.sqrt();
                let cosine = -along.dot(normal);
                if cosine > 0.0 {
                    sum += self.intensity(Emergent(Dir::<Facade>::from_unit(along))) * cosine / square;
                }
            }
        }
        sum / (n * n) as f64
    }
}

/// Luminaires that together replace an aperture.
#[derive(Debug, Clone)]
pub struct Lamps {
    /// Luminaires, one per tile of the aperture.
    pub list: Vec<Lamp>,
    /// Area of the aperture. \[m²\]
    pub area: f64,
}

impl Lamps {
    /// Returns the total luminous flux of the luminaires. \[lm\]
    pub fn flux(&self) -> f64 {
        self.list.iter().map(|lamp| lamp.flux).sum()
    }

    /// Returns the direct illuminance by all luminaires at a point with the surface normal `normal`, both in the room's
    /// frame. \[lx\]
    pub fn illuminance(&self, position: DVec3, normal: DVec3) -> f64 {
        self.list.iter().map(|lamp| lamp.illuminance(position, normal)).sum()
    }

    /// Returns the mean luminance of the replaced aperture for light that leaves in the direction −`undeviated` (façade
    /// frame); `undeviated` is the direction of undeviated light. \[cd/m²\]
    pub fn luminance(&self, undeviated: Dir<Facade>) -> f64 {
        let cosine = undeviated.vector().z;
        if cosine <= 1e-9 {
            return 0.0;
        }
        let emergent = Emergent::from_undeviated(undeviated);
        self.list.iter().map(|lamp| lamp.intensity(emergent)).sum::<f64>() / (self.area * cosine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// An opening of luminance 1000 cd/m² in the façade, 1.2 m x 1.0 m, at the origin.
    fn lambert() -> Lamp {
        let nodes = |count: usize, step: f64| (0..count).map(|k| k as f64 * step).collect::<Vec<_>>();
        let (c, gamma) = (nodes(360, PI / 180.0), nodes(181, PI / 180.0));
        let at = |c: f64, gamma: f64| 1200.0 * (gamma.sin() * c.cos()).max(0.0);
        let values = c.iter().flat_map(|c| gamma.iter().map(move |gamma| at(*c, *gamma))).collect();
        Lamp {
            tile: Tile { centre: DVec3::ZERO, size: [1.2, 1.0] },
            surface: Surface::Facade,
            aim: Aim::Mounted,
            flux: 1200.0 * PI,
            table: Arc::new(Intensities { c, gamma, values }),
        }
    }

    #[test]
    fn a_bright_opening_lights_as_its_solid_angle_does() {
        let lamp = lambert();
        // In front of its middle: the closed form of a rectangle.
        let across = |a: f64, b: f64, d: f64| {
            let corner = |a: f64, b: f64| {
                let (r, s) = (a.hypot(d), b.hypot(d));
                0.5 * (a / r * (b / r).atan() + b / s * (a / s).atan())
            };
            4.0 * 1000.0 * corner(a, b)
        };
        // Parts of a quarter of the distance leave (w/d)²/6 and less.
        for (distance, tolerance) in [(10.0, 5e-3), (3.0, 1.1e-2), (1.0, 1.1e-2)] {
            let e = lamp.illuminance(DVec3::new(0.0, distance, 0.0), -DVec3::Y);
            let exact = across(0.6, 0.5, distance);
            assert!((e / exact - 1.0).abs() < tolerance, "{distance} m: {e} {exact}");
        }
        assert_eq!(lamp.illuminance(DVec3::new(0.0, 1.0, 0.0), DVec3::Y), 0.0);
        assert_eq!(lamp.illuminance(DVec3::new(0.0, -1.0, 0.0), DVec3::Y), 0.0);
    }
}
