//! Emissions multiplied by a factor, and weighted sums of several, for an aperture whose parts see different outsides
//! or states of the system.

use super::Emission;
use super::emission::{BandLight, CellLight};
use crate::compute::estimate::Estimate;
use std::f64::consts::PI;
use std::sync::Arc;

impl Emission {
    /// Returns the emission with all emitted light multiplied by `factor`, for a frame or dirt. The incident
    /// illuminances do not change.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.uniform = self.uniform * factor;
        for light in &mut self.cells {
            let parts = [&mut light.diffuse, &mut light.sun].into_iter().chain(&mut light.uncertainties);
            parts.flatten().for_each(|l| *l *= factor);
        }
        self.bands.iter_mut().for_each(|bands| bands.illuminance *= factor);
        self.regular = self.regular.map(|tau| tau.scaled(factor));
        self.beams.iter_mut().for_each(|beam| *beam = beam.scaled(factor));
        self
    }

    /// Returns the weighted sum of the scattered light of several emissions of one system, which have the same
    /// components; undeviated light from the sky and beams is left out.
    ///
    /// Weights may be negative (extrapolation); negative luminances in the sum are set to 0.
    pub fn mixed(parts: &[(f64, &Self)]) -> Self {
        let mut sum = Self::dark();
        for &(weight, part) in parts {
            sum.uniform.value += weight * part.uniform.value;
            sum.uniform.error += weight.abs() * part.uniform.error;
            sum.incident_diffuse.value += weight * part.incident_diffuse.value;
            sum.incident_diffuse.error += weight.abs() * part.incident_diffuse.error;
            sum.incident_sun += weight * part.incident_sun;
            for (k, light) in part.cells.iter().enumerate() {
                if k == sum.cells.len() {
                    let dark = || vec![0.0; light.basis.len()];
                    sum.cells.push(CellLight {
                        basis: Arc::clone(&light.basis),
                        diffuse: dark(),
                        sun: dark(),
                        uncertainties: vec![dark(); light.uncertainties.len()],
                        relative_error: 0.0,
                    });
                }
                let own = &mut sum.cells[k];
                own.relative_error = own.relative_error.max(light.relative_error);
                let pairs = [(&mut own.diffuse, &light.diffuse), (&mut own.sun, &light.sun)];
                for (to, from) in pairs.into_iter().chain(own.uncertainties.iter_mut().zip(&light.uncertainties)) {
                    to.iter_mut().zip(from).for_each(|(to, from)| *to += weight * from);
                }
            }
            for (k, bands) in part.bands.iter().enumerate() {
                if k == sum.bands.len() {
                    let mut light = bands.light.clone();
                    light.q.iter_mut().for_each(|q| *q = 0.0);
                    light.error = 0.0;
                    sum.bands.push(BandLight { light, illuminance: 1.0 });
                }
                let own = &mut sum.bands[k].light;
                own.q.iter_mut().zip(&bands.light.q).for_each(|(to, q)| *to += weight * bands.illuminance * q);
                own.error += weight.abs() * bands.illuminance * bands.light.error;
            }
        }
        sum.uniform.value = sum.uniform.value.max(0.0);
        sum.incident_diffuse.value = sum.incident_diffuse.value.max(0.0);
        let luminances = sum.cells.iter_mut().flat_map(|light| [&mut light.diffuse, &mut light.sun]);
        let all = luminances.chain(sum.bands.iter_mut().map(|bands| &mut bands.light.q));
        all.flatten().for_each(|l| *l = l.max(0.0));
        sum
    }

    /// Returns the scattered light as exitances: Lambertian component, then one per emergent cell or band of the
    /// profile angle, to compare emissions of one system. \[lm/m²\]
    pub fn fluxes(&self) -> Vec<f64> {
        let mut fluxes = vec![PI * self.uniform.value];
        for light in &self.cells {
            let weights = light.basis.cells().map(|cell| cell.projected_solid_angle());
            fluxes.extend(weights.zip(light.diffuse.iter().zip(&light.sun)).map(|(w, (d, s))| w * (d + s)));
        }
        for bands in &self.bands {
            let share = bands.light.share() * bands.illuminance;
            let sum: f64 = bands.light.q.iter().sum();
            let scale = if sum > 0.0 { share / sum } else { 0.0 };
            fluxes.extend(bands.light.q.iter().map(|q| scale * q));
        }
        fluxes
    }

    /// Returns the luminous exitance of the room side by scattered light alone. \[lm/m²\]
    pub fn scattered_exitance(&self) -> Estimate {
        let mut sum = self.uniform * PI;
        for light in &self.cells {
            let weights = light.basis.cells().map(|cell| cell.projected_solid_angle());
            let flux: f64 = weights.zip(light.diffuse.iter().zip(&light.sun)).map(|(w, (d, s))| w * (d + s)).sum();
            sum += Estimate::new(flux, flux * light.relative_error);
        }
        for bands in &self.bands {
            sum += Estimate::new(bands.light.share(), bands.light.error) * bands.illuminance;
        }
        sum
    }
}
