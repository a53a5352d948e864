//! Diffusers: Lambertian sheets, opal volumes between smooth surfaces, and sheets that spread light in a lobe about its
//! undeviated direction.
//!
//! Reciprocity forbids a Lambertian emission whose transmittance depends on incidence. An opal sheet with smooth
//! surfaces lets light in and out through the same kind of surface, so that q = t F(θ_e) F(θ_a) / (π F̄), F the
//! transmittance of one surface at the angles of incidence and emergence, F̄ its hemispherical mean, and t the share
//! that the volume transmits of the light that has entered it.

use super::lobe::Lobe;
use super::sheet::{Sheet, Spread};
use crate::compute::btdf::{AngularTransmittance, Band, Btdf};
use crate::compute::system::family::{Family, OpticalModelError, PIECE, Polygons, rectangle};
use crate::compute::system::measure::OpticalModel;
use crate::compute::system::panes::glazing::{self, fresnel};

/// Diffuser: sheet that scatters light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Diffuser {
    /// Lambertian sheet: the same luminance in all directions, for every incident direction.
    Lambertian {
        /// Transmittance for every incident direction, 0 … 1.
        transmittance: f64,
        /// Reflectance for every incident direction, 0 … 1.
        reflectance: f64,
    },
    /// Opal sheet: scattering volume between two smooth surfaces.
    Opal(Opal),
    /// Sheet that transmits one part of the light undeviated, one in a lobe and one diffusely.
    Spreading(Spreading),
}

impl Diffuser {
    /// Creates the sheet with its distributions of light; `None` for values that no passive sheet can have.
    fn sheet(&self) -> Option<Sheet> {
        match self {
            Self::Lambertian { transmittance, reflectance } => Some(Sheet {
                transmission: Spread::lambertian(*transmittance),
                reflection: [Spread::lambertian(*reflectance), Spread::lambertian(*reflectance)],
            }),
            Self::Opal(opal) => opal.sheet(),
            Self::Spreading(sheet) => sheet.sheet(),
        }
    }
}

impl Family for Diffuser {
    fn word(&self) -> &'static str {
        "diffuser"
    }

    fn method(&self) -> &'static str {
        "separable diffuse light and a balanced Gaussian lobe in direction cosines"
    }

    fn drawing(&self, _: &str) -> Polygons {
        /// Thickness of the sheet in drawings; descriptions do not state it. \[m\] Chosen: affects drawings only, no
        /// figure.
        const SHEET: f64 = 0.004;
        vec![rectangle([-SHEET, 0.0], [0.0, PIECE])]
    }

    fn is_schematic(&self) -> bool {
        true
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        let sheet = self.sheet().ok_or_else(|| OpticalModelError::because("values that no passive sheet has"))?;
        Ok(Box::new(sheet))
    }
}

/// Opal sheet, the same from both sides: a scattering volume between two smooth surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opal {
    /// Refractive index of the surfaces.
    pub index: f64,
    /// Direct-hemispherical transmittance at normal incidence.
    pub transmittance: f64,
    /// Diffuse reflectance at normal incidence, without the specular reflection of the surface.
    pub reflectance: f64,
}

/// Sheet, the same from both sides, that transmits one part of the light undeviated, one in a lobe about that direction
/// and one diffusely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spreading {
    /// Refractive index of the sheet.
    pub index: f64,
    /// Share of the transmitted light that is undeviated, 0 … 1.
    pub regular: f64,
    /// Share of the transmitted light that leaves in a lobe about the undeviated direction, 0 … 1; the rest leaves
    /// diffusely.
    pub lobe: f64,
    /// Standard deviation of the lobe along either direction cosine (near the normal: the angle). \[rad\]
    pub spread: f64,
    /// Direct-hemispherical transmittance at normal incidence; at other angles it is proportional to that of a clear
    /// sheet with the same refractive index.
    pub transmittance: f64,
    /// Share that is absorbed of the light that is not transmitted, 0 … 1; the rest is reflected, diffusely or
    /// specularly.
    pub absorbed: f64,
}

/// Returns the transmittance of one surface between air and a material for unpolarised light at the angle of incidence
/// `theta`. \[rad\]
fn surface_transmittance(index: f64, theta: f64) -> f64 {
    let ([s, p], _) = fresnel(index, theta);
    1.0 - 0.5 * (s + p)
}

/// Returns a table of a function of the polar angle θ \[rad\] in steps of half a degree.
fn table(f: impl Fn(f64) -> f64) -> AngularTransmittance {
    AngularTransmittance::sample(180, f)
}

impl Opal {
    /// Returns the shares of the light that has entered the volume: transmitted, and reflected by the volume. `None`
    /// for values that no passive sheet can have.
    pub fn shares(&self) -> Option<(f64, f64)> {
        let enters = surface_transmittance(self.index, 0.0);
        let (passed, returned) = (self.transmittance / enters, self.reflectance / enters);
        let sane = self.index >= 1.0 && passed >= 0.0 && returned >= 0.0 && passed + returned <= 1.0;
        sane.then_some((passed, returned))
    }

    /// Creates the sheet with its distributions of light; `None` for values that no passive sheet can have.
    pub fn sheet(&self) -> Option<Sheet> {
        let (passed, returned) = self.shares()?;
        let enters = |share: f64| table(|theta| share * surface_transmittance(self.index, theta));
        let reflection = Spread {
            regular: table(|theta| 1.0 - surface_transmittance(self.index, theta)),
            diffuse: enters(returned),
            lobe: None,
        };
        let transmission = Spread { regular: AngularTransmittance::Constant(0.0), diffuse: enters(passed), lobe: None };
        Some(Sheet { transmission, reflection: [reflection.clone(), reflection] })
    }
}

impl Spreading {
    /// Returns the transmittance of a clear, non-absorbing sheet with the same refractive index at the angle of
    /// incidence `theta`. \[rad\]
    pub fn clear(&self, theta: f64) -> f64 {
        let pane = glazing::Pane { index: self.index, thickness: 0.0, absorption: 0.0 };
        glazing::stack(&[pane], theta).transmitted
    }

    /// Returns the ratio of the sheet's transmittance to that of a clear sheet with the same refractive index, for all
    /// angles. `None` for values that no passive sheet can have.
    pub fn scale(&self) -> Option<f64> {
        let scale = self.transmittance / self.clear(0.0);
        let shares = [self.regular, self.lobe, 1.0 - self.regular - self.lobe, self.absorbed];
        let sane = shares.iter().all(|share| (-1e-12..=1.0).contains(share)) && (0.0..=1.0).contains(&scale);
        (sane && self.index >= 1.0 && self.spread > 0.01).then_some(scale)
    }

    /// Creates the sheet with its distributions of light; `None` for values that no passive sheet can have.
    pub fn sheet(&self) -> Option<Sheet> {
        let haze = (1.0 - self.regular - self.lobe).max(0.0);
        let scale = self.scale()?;
        let part = |share: f64| table(|theta| share * scale * self.clear(theta));
        let transmission = Spread {
            regular: part(self.regular),
            diffuse: part(haze),
            lobe: (self.lobe > 0.0).then(|| Lobe::new(part(self.lobe), self.spread)),
        };
        // The part that a clear sheet mirrors stays mirrored; the rest of what does not pass is absorbed or reflected.
        let kept = 1.0 - self.absorbed;
        let reflection = Spread {
            regular: table(|theta| (1.0 - self.clear(theta)) * kept),
            diffuse: table(|theta| (1.0 - scale) * self.clear(theta) * kept),
            lobe: None,
        };
        Some(Sheet { transmission, reflection: [reflection.clone(), reflection] })
    }
}

/// Returns the BSDF data of an ideal diffuser, Lambertian in transmission and reflection for every incident direction.
pub fn lambertian(transmittance: f64, reflectance: f64) -> Band {
    Band {
        transmission_front: Some(Btdf::ideal_diffuse(transmittance)),
        transmission_back: Some(Btdf::ideal_diffuse(transmittance)),
        reflection_front: Some(Btdf::ideal_diffuse(reflectance)),
        reflection_back: Some(Btdf::ideal_diffuse(reflectance)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::cell_mean;
    use crate::compute::btdf::{Scattered, reciprocity_error};
    use crate::compute::direction::{Dir, Facade, Incident};
    use crate::compute::estimate::Silent;
    use crate::compute::system::measure::{Setting, front_basis};

    fn measured(sheet: &Sheet) -> Band {
        let cells = front_basis();
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 0 };
        sheet.examine(&setting, &Silent).unwrap().0
    }

    fn check(band: &Band) {
        let [t, r] = [&band.transmission_front, &band.reflection_front].map(|b| b.as_ref().unwrap());
        assert!(reciprocity_error(t, band.transmission_back.as_ref().unwrap()).unwrap() < 1e-12);
        assert!(reciprocity_error(r, r).unwrap() < 1e-12);
        for k in 0..90 {
            let light = Incident(Dir::from_theta_phi(f64::from(k).to_radians(), 0.3));
            // Regular parts are pointwise, cells are means: they meet within a cell's own variation.
            assert!(t.tau(light) + r.tau(light) <= 1.06 || k > 74, "{k}°");
        }
        assert!(t.tau_hemispherical() + r.tau_hemispherical() <= 1.0 + 1e-4);
    }

    #[test]
    fn internal_diffuse_reflection_of_a_surface_is_the_known_one() {
        // External diffuse reflectance of a surface, n = 1.5 (Duntley 1942; Judd 1942): 0.0919.
        let reflectance = 1.0 - table(|theta| surface_transmittance(1.5, theta)).hemispherical();
        assert!((reflectance - 0.0919).abs() < 3e-3, "{reflectance}");
    }

    #[test]
    fn opal_keeps_energy_and_its_transmittance() {
        let band = measured(&Opal { index: 1.49, transmittance: 0.5, reflectance: 0.35 }.sheet().unwrap());
        check(&band);
        assert!((band.transmission_front.unwrap().tau_normal() - 0.5).abs() < 1e-4);
        assert!(Opal { index: 1.49, transmittance: 0.7, reflectance: 0.35 }.sheet().is_none());
    }

    #[test]
    fn spreading_sheet_keeps_its_transmittance_and_is_brightest_straight_on() {
        let sheet = Spreading {
            index: 1.49,
            regular: 0.1,
            lobe: 0.6,
            spread: 12_f64.to_radians(),
            transmittance: 0.8,
            absorbed: 0.2,
        };
        let band = measured(&sheet.sheet().unwrap());
        check(&band);
        let t = band.transmission_front.unwrap();
        assert!((t.tau_normal() - 0.8).abs() < 1e-4, "{}", t.tau_normal());
        let Some(Scattered::Cells(m)) = &t.scattered else { panic!() };
        // Rows carry 0.9 of the clear sheet's τ(θ), scaled.
        for (cell, tau) in m.incident().cells().zip(m.tau_by_cell()) {
            let clear = |d: Dir<Facade>| {
                let pane = glazing::Pane { index: 1.49, thickness: 0.0, absorption: 0.0 };
                glazing::stack(&[pane], d.theta()).transmitted
            };
            let expected = 0.9 * 0.8 * cell_mean(&cell, 40, clear) / clear(Dir::from_theta_phi(0.0, 0.0));
            assert!((tau - expected).abs() < 2e-3, "{tau} {expected}");
        }
        for (i, cell) in m.incident().cells().enumerate().filter(|(_, cell)| cell.theta() < 1.0) {
            let brightest = (0..m.emergent().len()).max_by(|&a, &b| m.row(i)[a].total_cmp(&m.row(i)[b])).unwrap();
            let to = m.emergent().cell(brightest).centre();
            assert!(to.dot(cell.centre()) > 20_f64.to_radians().cos(), "{i}");
        }
    }
}
