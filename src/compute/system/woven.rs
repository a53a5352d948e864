//! Woven screens by their openness and their yarn: the semi-empirical roller blind model of Kotey, Wright and Collins
//! ("Determining off-normal solar optical properties of roller blinds", ASHRAE Transactions 115, 2009).
//!
//! The share that passes between the yarns ends at a cut-off angle; what the yarns transmit leaves diffusely. The model
//! gives totals for each incidence; their distribution is made reciprocal, τ_d(θ_e) τ_d(θ_a)/(π τ̄_d), and reflection is
//! Lambertian, as the model has it.

use super::description::Woven;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::goniophotometer::sheet::{Sheet, Spread};
use std::f64::consts::FRAC_PI_2;

impl Woven {
    /// Share of light that passes between the yarns. \[rad\]
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

    /// Share of light that passes between and through the yarns. \[rad\]
    pub fn total(&self, theta: f64) -> f64 {
        let yarn = self.transmittance;
        let exponent = if yarn <= 0.33 { 0.133 * (yarn + 0.003).powf(-0.467) } else { 0.33 * (1.0 - yarn) };
        let normal = self.openness + yarn * (1.0 - self.openness);
        normal * theta.cos().max(0.0).powf(exponent)
    }

    /// The fabric as a sheet.
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

#[cfg(test)]
mod tests {
    use super::*;

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
