//! Woven screens by their openness and their yarn: the semi-empirical roller blind model of Kotey, Wright and Collins
//! ("Determining off-normal solar optical properties of roller blinds", ASHRAE Transactions 115, 2009).
//!
//! The share of light that passes between the yarns falls to 0 at a cut-off angle; light through the yarns leaves
//! diffusely. The model gives totals for each incidence; their distribution is made reciprocal, τ_d(θ_e) τ_d(θ_a)/(π
//! τ̄_d), and reflection is Lambertian, as in the model.

use super::sheet::{Sheet, Spread};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{AngularTransmittance, Band};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::family::{Family, OpticalModelError, Polygons};
use crate::compute::system::measure::{Beam, Measured, OpticalModel, Quality, ScatteredLight, Setting, Side};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Pitch of the yarns in drawings; descriptions do not state it. \[m\] Chosen: affects drawings only, no figure.
const YARN_PITCH: f64 = 0.001;

/// Woven screen, described by its openness and the optical values of its yarn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Woven {
    /// Openness: open share of the area at normal incidence, 0 … 1.
    pub openness: f64,
    /// Diffuse reflectances of the yarn on the outer and on the inner face.
    pub reflectance: [f64; 2],
    /// Transmittance of the yarn; all light through it is diffuse.
    pub transmittance: f64,
}

impl Woven {
    /// Returns the share of light, 0 … 1, that passes undeviated between the yarns at a polar angle of incidence.
    /// \[rad\]
    pub fn open(&self, theta: f64) -> f64 {
        let closed = (FRAC_PI_2 * self.openness).cos();
        let cut_off = (90.0 - 25.0 * closed).to_radians();
        if theta >= cut_off {
            return 0.0;
        }
        let passed = self.openness * (FRAC_PI_2 * theta / cut_off).cos().powf(0.6 * closed.powf(0.3));
        // The two correlations may cross by a little.
        passed.min(self.total(theta))
    }

    /// Returns the transmittance, between and through the yarns together, at a polar angle of incidence. \[rad\]
    pub fn total(&self, theta: f64) -> f64 {
        let yarn = self.transmittance;
        let exponent = if yarn <= 0.33 { 0.133 * (yarn + 0.003).powf(-0.467) } else { 0.33 * (1.0 - yarn) };
        let normal = self.openness + yarn * (1.0 - self.openness);
        normal * theta.cos().max(0.0).powf(exponent)
    }

    /// Creates the optical model of the fabric as a plane sheet.
    pub fn sheet(&self) -> Sheet {
        let table = |f: &dyn Fn(f64) -> f64| AngularTransmittance::sample(180, f);
        Sheet {
            transmission: Spread {
                regular: table(&|theta| self.open(theta)),
                diffuse: table(&|theta| self.total(theta) - self.open(theta)),
                lobe: None,
            },
            reflection: self.reflectance.map(|yarn| Spread::lambertian(yarn * (1.0 - self.openness))),
        }
    }
}

impl Family for Woven {
    fn word(&self) -> &'static str {
        "woven"
    }

    fn method(&self) -> &'static str {
        "roller blind model of Kotey, Wright and Collins (ASHRAE Transactions 115, 2009)"
    }

    /// Returns the section of a yarn of a plain weave: with the pitch p its threads of width d leave (1 − d/p)² open.
    fn drawing(&self, _: &str) -> Polygons {
        /// Number of corners of a yarn's section in drawings. Chosen: affects drawings only, no figure.
        const CORNERS: usize = 32;
        let radius = 0.5 * YARN_PITCH * (1.0 - self.openness.max(0.0).sqrt());
        let corner = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / CORNERS as f64).sin_cos();
            [radius * (cos - 1.0), 0.5 * YARN_PITCH + radius * sin]
        };
        vec![(0..CORNERS).map(corner).collect()]
    }

    fn drawing_period(&self) -> Option<f64> {
        Some(YARN_PITCH)
    }

    fn is_schematic(&self) -> bool {
        true
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        Ok(Box::new(Fabric { woven: *self, sheet: self.sheet() }))
    }
}

/// Optical model of a fabric: a sheet with tables over the polar angle, and for single directions the equations
/// themselves, whose steep fall to 0 at the cut-off angle no table reproduces.
struct Fabric {
    woven: Woven,
    sheet: Sheet,
}

impl OpticalModel for Fabric {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        self.sheet.measure(setting, progress)
    }

    fn examine(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Band, Quality), Cancelled> {
        self.sheet.examine(setting, progress)
    }

    fn separates_regular(&self) -> bool {
        true
    }

    fn beams(&self, direction: Dir<Facade>, _: Side) -> Vec<Beam> {
        let open = self.woven.open(direction.theta());
        if open > 0.0 { vec![Beam::through(direction, open)] } else { vec![] }
    }

    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        let reflected = self.sheet.reflected(direction, side, emergent);
        ScatteredLight { reflected, ..self.scattered_through(direction, side, emergent) }
    }

    fn scattered_through(&self, direction: Dir<Facade>, _: Side, emergent: &RingBasis) -> ScatteredLight {
        let theta = direction.theta();
        let through_yarns = self.woven.total(theta) - self.woven.open(theta);
        self.sheet.transmitted_with(direction, emergent, through_yarns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::system::measure::front_basis;

    #[test]
    fn single_directions_have_the_totals_of_the_model() {
        let fabric = Woven { openness: 0.05, reflectance: [0.7, 0.3], transmittance: 0.1 };
        let specimen = fabric.optical_model("").unwrap();
        let cells = front_basis();
        let weight = cells.projected_solid_angles();
        let share = |q: &[f64]| q.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
        for k in 0..890 {
            let theta = (0.1 * f64::from(k)).to_radians();
            let direction = Dir::from_theta_phi(theta, 0.1 * f64::from(k));
            let beams: f64 = specimen.beams(direction, Side::Front).iter().map(|beam| beam.share).sum();
            assert!((beams - fabric.open(theta)).abs() < 1e-12);
            let found = specimen.scattered(direction, Side::Back, &cells);
            assert!((share(&found.transmitted) + beams - fabric.total(theta)).abs() < 1e-12);
            assert!((share(&found.reflected) - 0.3 * 0.95).abs() < 1e-12);
        }
    }

    #[test]
    fn yarns_leave_the_openness() {
        let fabric = Woven { openness: 0.09, reflectance: [0.5; 2], transmittance: 0.0 };
        let heights = fabric.drawing("")[0].iter().map(|p| p[1]).collect::<Vec<_>>();
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let free = 1.0 - (high - low) / fabric.drawing_period().unwrap();
        assert!((free * free - 0.09).abs() < 1e-9);
    }

    #[test]
    fn openness_and_yarn_at_normal_incidence_and_the_cut_off() {
        let fabric = Woven { openness: 0.05, reflectance: [0.7, 0.3], transmittance: 0.1 };
        assert!((fabric.open(0.0) - 0.05).abs() < 1e-15 && (fabric.total(0.0) - 0.145).abs() < 1e-15);
        // 90° − 25° cos(4.5°) = 65.08°.
        assert!(fabric.open(65.0_f64.to_radians()) > 0.0 && fabric.open(65.1_f64.to_radians()) == 0.0);
        for k in 0..90 {
            let theta = f64::from(k).to_radians();
            assert!(fabric.open(theta) <= fabric.total(theta) + 1e-15);
        }
        let open = Woven { openness: 0.3, reflectance: [0.0; 2], transmittance: 0.0 };
        assert!((open.total(0.5) - open.open(0.5)).abs() < 0.06, "yarns that pass nothing leave little diffuse light");
    }
}
