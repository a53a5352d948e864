//! Light that the room side of an aperture emits under given sky and sun: eq 8 of the IEA SHC Task 31 report, divided
//! into components for each of which the illuminance at a sensor has an exact or error-controlled integral.
//!
//! Patch-averaged data (eq 12): L_o = Σ_i q(i, o) · E_i with E_i = ∫_cell L_e cosθ dω, which keeps every incident
//! cell's flux τ_i E_i. The sun (eq 16): L_o = q(ω_S, o) · E_S.

use super::Facing;
use super::beams::BeamLight;
use super::lamp::Lamps;
use super::{EmergentLuminance, Lid, SunBeam};
use crate::compute::basis::{Ring, RingBasis};
use crate::compute::btdf::{AngularTransmittance, Btdf, Scattered, TensorTree};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::gauss_legendre;
use crate::compute::sky::{Frame, Outside, incident_illuminances};
use crate::compute::system::measure::ProfileLight;
use std::f64::consts::PI;
use std::sync::Arc;

/// Luminance of an aperture's room side on emergent cells, separately for light from the sky and for scattered
/// sunlight. \[cd/m²\]
#[derive(Debug, Clone)]
pub struct CellLight {
    /// Emergent cells; a cell holds the reversed emergent directions ω′ = −ω_a (directions of undeviated light).
    pub basis: Arc<RingBasis>,
    /// Luminance of every cell by light from sky, ground and skyline. \[cd/m²\]
    pub diffuse: Vec<f64>,
    /// Luminance of every cell by direct sunlight that the system scatters. \[cd/m²\]
    pub sun: Vec<f64>,
    /// Uncertainties of `diffuse` plus `sun`, independent of one another, each with a signed value per cell: for
    /// instance the difference to a simpler interpolation between the data, or the change with a shifted lobe.
    /// \[cd/m²\]
    pub uncertainties: Vec<Vec<f64>>,
    /// Estimated relative numerical error of the luminances.
    pub relative_error: f64,
}

/// Luminance of an aperture's room side by profile angle: luminance coefficients q times illuminance.
#[derive(Debug, Clone, PartialEq)]
pub struct BandLight {
    /// Luminance coefficients q \[1/sr\] by profile angle of the reversed emergent direction.
    pub light: ProfileLight,
    /// Illuminance of the aperture's outside, by which the coefficients of `light` are multiplied. \[lx\]
    pub illuminance: f64,
}

/// Origin of the beams of direct sun behind an aperture's system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BeamSource {
    /// No beams: no sun, or a system that transmits no light as beams.
    #[default]
    None,
    /// Optical model of a described system, or a regular transmittance.
    Described,
    /// Extraction of beams from patch-averaged data (peak extraction).
    Extracted,
    /// No beams extracted: direct sun is part of the patch-averaged data, blurred to their cells.
    Cells,
}

impl BeamSource {
    /// Returns the key of the origin, a constant English word for data files.
    pub fn word(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Described => "described",
            Self::Extracted => "extracted",
            Self::Cells => "cells",
        }
    }
}

/// Light that an aperture emits on its room side, as components that add up.
#[derive(Debug, Clone)]
pub struct Emission {
    /// Luminance of the Lambertian component. \[cd/m²\]
    pub uniform: Estimate,
    /// Luminances on emergent cells, each component with its basis.
    pub cells: Vec<CellLight>,
    /// Scattered light that depends on a profile angle alone, with the same bands of the profile angle in all
    /// components.
    pub bands: Vec<BandLight>,
    /// Regular transmittance, through which the outside is visible undeviated; `None` if there is no regular
    /// transmission.
    pub regular: Option<AngularTransmittance>,
    /// Beams of direct sun behind the aperture.
    pub beams: Vec<BeamLight>,
    /// Luminaires that replace the aperture and light the room independently of sky and sun; `None` for an aperture.
    pub lamps: Option<Arc<Lamps>>,
    /// Illuminance of the aperture's outside by diffuse light from sky, ground and obstructions. \[lx\]
    pub incident_diffuse: Estimate,
    /// Illuminance of the aperture's outside by direct sun. \[lx\]
    pub incident_sun: f64,
    /// Origin of the beams.
    pub beam_source: BeamSource,
    /// Notes on the methods that were used where there was a choice.
    pub notes: Vec<String>,
}

impl Emission {
    /// Creates the emission of an aperture that transmits no light.
    pub fn dark() -> Self {
        Self {
            uniform: Estimate::default(),
            cells: Vec::new(),
            bands: Vec::new(),
            regular: None,
            beams: Vec::new(),
            lamps: None,
            beam_source: BeamSource::None,
            incident_diffuse: Estimate::default(),
            incident_sun: 0.0,
            notes: Vec::new(),
        }
    }

    /// Creates the emission of luminaires that replace an aperture: no light from outside is transmitted.
    pub fn lamps(lamps: Arc<Lamps>) -> Self {
        let note = format!(
            "luminaire files: {} of them, each cut into parts of a quarter of the distance, as a host takes them; sky and \
             sun of the scene do not change their light",
            lamps.list.len()
        );
        Self { lamps: Some(lamps), notes: vec![note], ..Self::dark() }
    }

    /// Computes the light that the room side of an aperture emits, from the BSDF data of its system and the sky and sun
    /// in front of it.
    pub fn new(btdf: &Btdf, facing: &Facing<'_>) -> Self {
        let incident_sun = facing.sun_illuminance();
        let sun_direction = facing.sun_entering().filter(|_| incident_sun > 0.0);
        let frame = Frame::of_aperture(facing.orientation, facing.surface);
        let mut emission = Self {
            uniform: Estimate::default(),
            cells: Vec::new(),
            bands: Vec::new(),
            regular: btdf.regular.clone(),
            beams: Vec::new(),
            lamps: None,
            incident_diffuse: Estimate::default(),
            incident_sun,
            beam_source: BeamSource::None,
            notes: Vec::new(),
        };
        emission.beams.extend(BeamLight::regular(btdf.regular.as_ref(), facing));
        emission.beam_source = match &btdf.scattered {
            _ if sun_direction.is_none() => BeamSource::None,
            _ if emission.beams.iter().any(|beam| beam.uncertainty > 0.0) => BeamSource::Extracted,
            _ if !emission.beams.is_empty() => BeamSource::Described,
            None | Some(Scattered::Lambert(_)) => BeamSource::None,
            Some(_) => BeamSource::Cells,
        };
        match &btdf.scattered {
            None => {
                emission.incident_diffuse = incident_illuminances(facing.outside, &bands(1), &frame).into_iter().sum();
            }
            Some(Scattered::Lambert(tau)) => {
                // A constant τ needs the total illuminance only; otherwise rings of 2.5°, each with τ at its mean
                // angle.
                let rings = if tau.constant().is_some() { 1 } else { 36 };
                let basis = bands(rings);
                let illuminance = incident_illuminances(facing.outside, &basis, &frame);
                let across = gauss_legendre(ACROSS);
                for (ring, &e) in basis.rings().iter().zip(&illuminance) {
                    emission.incident_diffuse += e;
                    emission.uniform += e * (tau.ring_mean(ring.theta_min, ring.theta_max, &across) / PI);
                }
                if let Some(sun) = sun_direction {
                    emission.uniform += Estimate::exact(tau.at(sun.theta().min(0.5 * PI)) * incident_sun / PI);
                }
            }
            Some(Scattered::Cells(matrix)) => {
                let illuminance = incident_illuminances(facing.outside, matrix.incident(), &frame);
                emission.incident_diffuse = illuminance.iter().copied().sum();
                let values: Vec<f64> = illuminance.iter().map(|e| e.value).collect();
                let sun = sun_direction
                    .and_then(|sun| matrix.incident().index(sun))
                    .map_or_else(Vec::new, |cell| matrix.row(cell).iter().map(|q| q * incident_sun).collect());
                emission.cells.push(CellLight {
                    basis: Arc::new(matrix.emergent().clone()),
                    diffuse: matrix.luminance(&values),
                    uncertainties: Vec::new(),
                    sun: if sun.is_empty() { vec![0.0; matrix.emergent().len()] } else { sun },
                    relative_error: relative(emission.incident_diffuse),
                });
            }
            Some(Scattered::Directions(data)) => {
                let cells = data.lattice().cloned().unwrap_or_else(|| RingBasis::equal_area(40));
                let illuminance = incident_illuminances(facing.outside, &cells, &frame);
                emission.incident_diffuse = illuminance.iter().copied().sum();
                let mut diffuse = vec![0.0; data.emergent().len()];
                let add = |d: Dir<Facade>, e: f64, to: &mut [f64]| {
                    if let Some(i) = data.standing_for(d).filter(|_| e > 0.0) {
                        to.iter_mut().zip(data.row(i).iter()).for_each(|(l, q)| *l += q * e);
                    }
                };
                for (cell, e) in cells.cells().zip(&illuminance) {
                    add(cell.centre(), e.value, &mut diffuse);
                }
                let mut sun = vec![0.0; data.emergent().len()];
                if let Some(direction) = sun_direction {
                    add(direction, incident_sun, &mut sun);
                }
                emission.cells.push(CellLight {
                    basis: Arc::new(data.emergent().clone()),
                    diffuse,
                    sun,
                    uncertainties: Vec::new(),
                    relative_error: relative(emission.incident_diffuse),
                });
            }
            Some(Scattered::Tree(tree)) => {
                let (illuminance, error) = tree_illuminances(tree, facing);
                emission.incident_diffuse = Estimate::new(illuminance.iter().sum(), error);
                let (basis, diffuse) = tree.luminance(&illuminance);
                let sun = sun_direction
                    .map_or_else(|| vec![0.0; basis.len()], |sun| tree.sun_luminance(Incident(sun), incident_sun).1);
                emission.cells.push(CellLight {
                    basis: Arc::new(basis),
                    diffuse,
                    sun,
                    uncertainties: Vec::new(),
                    relative_error: relative(emission.incident_diffuse) + TREE_CELL_ERROR,
                });
            }
        }
        emission
    }

    /// Returns the luminous exitance of the room side, beams included. \[lm/m²\]
    pub fn exitance(&self, facing: &Facing<'_>) -> Estimate {
        let mut sum = self.uniform * PI;
        for bands in &self.bands {
            sum += Estimate::new(bands.light.share(), bands.light.error) * bands.illuminance;
        }
        if let Some(lamps) = &self.lamps {
            sum += Estimate::exact(lamps.flux() / lamps.area);
        }
        for cells in &self.cells {
            let total: f64 = cells
                .basis
                .cells()
                .zip(cells.diffuse.iter().zip(&cells.sun))
                .map(|(cell, (diffuse, sun))| cell.projected_solid_angle() * (diffuse + sun))
                .sum();
            sum += Estimate::new(total, total * cells.relative_error);
        }
        if let Some(tau) = &self.regular {
            sum += match tau.constant() {
                Some(tau) => self.incident_diffuse * tau,
                None => {
                    let (basis, across) = (bands(36), gauss_legendre(ACROSS));
                    let frame = Frame::of_aperture(facing.orientation, facing.surface);
                    incident_illuminances(facing.outside, &basis, &frame)
                        .into_iter()
                        .zip(basis.rings())
                        .map(|(e, ring)| e * tau.ring_mean(ring.theta_min, ring.theta_max, &across))
                        .sum()
                }
            };
        }
        sum + Estimate::exact(self.beams.iter().map(|beam| beam.exitance).sum())
    }

    /// Whether the data of the system cause an uncertainty of the emitted light.
    pub fn is_uncertain(&self) -> bool {
        self.cells.iter().any(|light| !light.uncertainties.is_empty())
            || self.regular.as_ref().is_some_and(AngularTransmittance::is_estimated)
            || self.beams.iter().any(|beam| beam.uncertainty > 0.0)
    }

    /// Returns the uncertainty of [`Self::exitance`] caused by the data of the system. \[lm/m²\]
    pub fn exitance_uncertainty(&self) -> f64 {
        let flux = |light: &CellLight, uncertainty: &Vec<f64>| -> f64 {
            light.basis.cells().zip(uncertainty).map(|(cell, l)| cell.projected_solid_angle() * l).sum()
        };
        let on_cells =
            |light: &CellLight| light.uncertainties.iter().map(|d| flux(light, d).powi(2)).sum::<f64>().sqrt();
        let beams: f64 = self.beams.iter().map(|beam| beam.exitance * beam.uncertainty).sum();
        // Share of the illuminance by degree of incidence under a uniform outside.
        let even = |degree: usize| (2.0 * (degree as f64 + 0.5).to_radians()).sin() * PI / 180.0;
        let even = std::array::from_fn(|degree| self.incident_diffuse.value * even(degree));
        let through = self.regular.as_ref().map_or(0.0, |tau| tau.uncertainty_of_light(&even));
        self.cells.iter().map(on_cells).sum::<f64>() + through + beams
    }

    /// Returns the luminous-intensity distribution (eq 5) of an aperture with this emission and a size along x_F and
    /// y_F. \[m\]
    pub fn lid(&self, facing: &Facing<'_>, size: [f64; 2]) -> Lid {
        self.lid_through(facing, size, vec![(1.0, facing.outside.clone())])
    }

    /// Returns the luminous-intensity distribution of an aperture of a size \[m\] along x_F and y_F, whose regular
    /// transmission shows the weighted mean of several outsides; `seen` holds their shares.
    pub fn lid_through(&self, facing: &Facing<'_>, size: [f64; 2], seen: Vec<(f64, Outside)>) -> Lid {
        let mut parts = Vec::new();
        if self.uniform.value > 0.0 {
            parts.push(EmergentLuminance::Uniform(self.uniform.value));
        }
        for cells in &self.cells {
            parts.push(EmergentLuminance::Cells {
                basis: Arc::clone(&cells.basis),
                luminance: cells.diffuse.iter().zip(&cells.sun).map(|(a, b)| a + b).collect(),
            });
        }
        if let Some(first) = self.bands.first() {
            let mut sum = ProfileLight { q: vec![0.0; first.light.q.len()], error: 0.0, ..first.light.clone() };
            for bands in &self.bands {
                sum.q.iter_mut().zip(&bands.light.q).for_each(|(l, q)| *l += q * bands.illuminance);
                sum.error += bands.light.error * bands.illuminance;
            }
            parts.push(EmergentLuminance::Bands(sum));
        }
        if let Some(tau) = &self.regular {
            let tau = tau.clone();
            let (orientation, surface) = (facing.orientation, facing.surface);
            parts.push(EmergentLuminance::Function(Arc::new(move |undeviated: Dir<Facade>| {
                let world = orientation.world_from_room(surface.room_dir(undeviated));
                tau.at(undeviated.theta())
                    * seen.iter().map(|(share, outside)| share * outside.luminance(world)).sum::<f64>()
            })));
        }
        if let Some(lamps) = self.lamps.clone() {
            parts.push(EmergentLuminance::Function(Arc::new(move |undeviated: Dir<Facade>| {
                lamps.luminance(undeviated)
            })));
        }
        let area = size[0] * size[1];
        let beam = |beam: &BeamLight| SunBeam {
            direction: Emergent::from_undeviated(beam.to),
            flux: beam.exitance * area,
            straight: beam.straight,
        };
        Lid { surface: facing.surface, size, parts, beams: self.beams.iter().map(beam).collect() }
    }
}

/// Relative error of the illuminance at a sensor by replacing the skewed cells of the Shirley–Chiu square with straight
/// ones. Found on the slat and fabric trees of the reference kit.
const TREE_CELL_ERROR: f64 = 5e-3;

/// Computes the illuminance of the aperture from every finest incident cell of a tensor tree, by midpoints of equal
/// projected solid angle, and the error of the total, estimated with half the density. \[lx\]
fn tree_illuminances(tree: &TensorTree, facing: &Facing<'_>) -> (Vec<f64>, f64) {
    let grid = tree.incident_grid();
    let fine = (128 / tree.incident_resolution()).max(2);
    let sample = |n: usize| -> Vec<f64> {
        let weight = grid.projected_solid_angle() / (n * n) as f64;
        grid.cells().map(|cell| cell.samples(n).map(|d| facing.luminance(d)).sum::<f64>() * weight).collect()
    };
    let values = sample(fine);
    let coarse: f64 = sample(fine / 2).iter().sum();
    let total: f64 = values.iter().sum();
    (values, (total - coarse).abs())
}

fn relative(e: Estimate) -> f64 {
    if e.value > 0.0 { e.error / e.value } else { 0.0 }
}

/// Number of Gauss points for τ across a ring: exact for polynomials in sin²θ up to degree 5, over rings of 2.5°.
const ACROSS: usize = 3;

/// Returns a basis of `count` rings of equal width in θ, undivided in φ.
fn bands(count: usize) -> RingBasis {
    let step = 0.5 * PI / count as f64;
    let rings = (0..count)
        .map(|i| Ring { theta_min: i as f64 * step, theta_max: (i + 1) as f64 * step, sectors: 1, first_phi: 0.0 })
        .collect();
    RingBasis::new("bands", rings, crate::compute::basis::AzimuthMap::FACADE).expect("equal steps rise from 0 to 90°")
}
