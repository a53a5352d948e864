//! Optical model of panes: light is transmitted undeviated or mirrored, and transmittance depends on the polar angle
//! only.
//!
//! An incident and an emergent cell overlap in a rectangle of θ and φ, so that means over cells are one-dimensional
//! integrals.

use super::coated::{Layer, stack};
use super::glazing::Share;
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::btdf::{AngularTransmittance, Band, Btdf};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::quadrature::gauss_legendre;
use crate::compute::system::measure::{
    Beam, Measured, OneSide, OpticalModel, Quality, ScatteredLight, Setting, Side, Structure,
};
use std::f64::consts::PI;

/// Optical model of panes one behind the other with air between.
#[derive(Debug, Clone, PartialEq)]
pub struct Panes {
    /// Panes in their order from outside to inside.
    pub layers: Vec<Layer>,
}

/// Orders of the quadrature over θ: for the values, and for the estimate of their error. Gauss–Legendre rules of n
/// points integrate polynomials of degree 2n − 1 exactly; uncoated panes are smooth enough for both to agree to 1e-14.
const ORDERS: [usize; 2] = [64, 40];
/// Number of steps of the tables of transmittance and reflectance over θ: half a degree each. Chosen: cost; the cubics
/// between them give uncoated panes to 2e-6 up to 85°, to 1e-3 within the last half degree, which receives 8e-5 of
/// uniform light.
const STEPS: usize = 180;

impl Panes {
    /// Creates the optical model of a glazing of `n` equal panes.
    pub fn equal(layer: Layer, n: usize) -> Self {
        Self { layers: vec![layer; n] }
    }

    /// Returns transmittance and reflectances of the glazing for unpolarised light at a polar angle of incidence.
    /// \[rad\]
    pub fn shares(&self, theta: f64) -> Share {
        stack(&self.layers, theta)
    }
}

impl OpticalModel for Panes {
    /// Returns `true`, since all light is undeviated or mirrored.
    fn separates_regular(&self) -> bool {
        true
    }

    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        let shares = self.shares(direction.theta());
        let reflected = if side == Side::Front { shares.reflected_front } else { shares.reflected_back };
        vec![Beam::through(direction, shares.transmitted), Beam::back(direction, reflected)]
    }

    fn structure(&self) -> Structure {
        Structure::Even
    }

    /// Returns no scattered light, since panes are clear.
    fn scattered(&self, _: Dir<Facade>, _: Side, _: &RingBasis) -> ScatteredLight {
        ScatteredLight::default()
    }

    /// Returns the band with regular transmission and reflection as tables over the polar angle.
    fn examine(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Band, Quality), Cancelled> {
        let quality = self.measure(setting, progress)?.quality();
        let table = |part: fn(&Share) -> f64| {
            let regular = AngularTransmittance::sample(STEPS, |theta| part(&self.shares(theta)));
            Some(Btdf { regular: Some(regular), scattered: None })
        };
        let band = Band {
            transmission_front: table(|share| share.transmitted),
            transmission_back: table(|share| share.transmitted),
            reflection_front: table(|share| share.reflected_front),
            reflection_back: table(|share| share.reflected_back),
        };
        Ok((band, quality))
    }

    /// Computes patch-averaged data: light of an incident cell reaches the emergent cells that overlap it.
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        let (mut measured, m) = (Measured::dark(setting), setting.emergent.len());
        self.add_to([&mut measured.front, &mut measured.back], |i, o| i * m + o, setting, progress)?;
        Ok(measured)
    }

    fn by_cell(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Option<[OneSide; 2]>, Cancelled> {
        let n = setting.incident.len();
        let [mut front, mut back] = [OneSide::dark(n, n), OneSide::dark(n, n)];
        self.add_to([&mut front, &mut back], |i, _| i, setting, progress)?;
        Ok(Some([front, back]))
    }
}

impl Panes {
    /// Adds the data on the cells of `setting` to those of light from outside and from inside. `place`: index of the
    /// coefficient of an incident and an emergent cell that overlap.
    fn add_to(
        &self,
        [front, back]: [&mut OneSide; 2],
        place: impl Fn(usize, usize) -> usize,
        setting: &Setting<'_>,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let rules = ORDERS.map(gauss_legendre);
        let emergent: Vec<Cell> = setting.emergent.cells().collect();
        let n = setting.incident.len();
        let mut known = Known { panes: self, rules, values: vec![] };
        for (i, cell) in setting.incident.cells().enumerate() {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let whole = cell.projected_solid_angle();
            // Light keeps its through direction, so that only cells that overlap exchange any: with the overlap Δφ by
            // θ₁ … θ₂, q = Δφ ∫ τ sinθ cosθ dθ / (PΩᵢ PΩₒ).
            for (o, out) in emergent.iter().enumerate() {
                let (from, to) = (cell.theta_min.max(out.theta_min), cell.theta_max.min(out.theta_max));
                // Rings that only touch, and below azimuths that do, differ by rounding.
                if to - from <= 1e-12 {
                    continue;
                }
                let width = overlap(&cell, out);
                if width > 1e-12 {
                    let ([mean, _], _) = known.integral(from, to);
                    let (q, k) = (width / (whole * out.projected_solid_angle()), place(i, o));
                    front.transmitted[k] += mean.transmitted * q;
                    back.transmitted[k] += mean.transmitted * q;
                    front.reflected[k] += mean.reflected_front * q;
                    back.reflected[k] += mean.reflected_back * q;
                }
            }
            // Absorbed and error need no azimuth: its width falls out of means over the whole cell.
            let ([mean, coarse], weight) = known.integral(cell.theta_min, cell.theta_max);
            for (seen, side) in [&mut *front, &mut *back].into_iter().zip(Side::BOTH) {
                let reflected = |s: &Share| if side == Side::Front { s.reflected_front } else { s.reflected_back };
                // The part neither transmitted nor reflected; clear panes leave 0, and rounding.
                seen.absorbed[i] = (weight - mean.transmitted - reflected(&mean)).max(0.0) / weight;
                let difference = (mean.transmitted - coarse.transmitted).abs();
                seen.error[i] = difference.max((reflected(&mean) - reflected(&coarse)).abs()) / weight;
            }
            progress.advance("goniophotometer", i + 1, n);
        }
        Ok(())
    }
}

/// Returns the width of the range of azimuths that two cells have in common. \[rad\]
fn overlap(a: &Cell, b: &Cell) -> f64 {
    let separation = (a.phi - b.phi + PI).rem_euclid(2.0 * PI) - PI;
    [-2.0 * PI, 0.0, 2.0 * PI]
        .iter()
        .map(|turn| {
            let middle = separation + turn;
            let (low, high) =
                ((middle - 0.5 * a.width).max(-0.5 * b.width), (middle + 0.5 * a.width).min(0.5 * b.width));
            (high - low).max(0.0)
        })
        .sum()
}

/// Cache of integrals over ranges of θ, of which rings of cells need the same ones repeatedly.
struct Known<'a> {
    panes: &'a Panes,
    rules: [Vec<(f64, f64)>; 2],
    values: Vec<([f64; 2], [Share; 2])>,
}

impl Known<'_> {
    /// Returns ∫ share(θ) sinθ cosθ dθ between two polar angles \[rad\] for transmittance and reflectances, by both
    /// orders of [`ORDERS`], and ∫ sinθ cosθ dθ.
    fn integral(&mut self, from: f64, to: f64) -> ([Share; 2], f64) {
        let weight = 0.5 * (to - from).sin() * (to + from).sin();
        if let Some((_, found)) = self.values.iter().find(|(range, _)| *range == [from, to]) {
            return (*found, weight);
        }
        let with = |rule: &Vec<(f64, f64)>| {
            let mut sum = Share { transmitted: 0.0, reflected_front: 0.0, reflected_back: 0.0 };
            let mut total = 0.0;
            for &(x, w) in rule {
                let theta = from + (to - from) * x;
                let share = self.panes.shares(theta);
                let w = w * theta.sin() * theta.cos();
                total += w;
                sum.transmitted += w * share.transmitted;
                sum.reflected_front += w * share.reflected_front;
                sum.reflected_back += w * share.reflected_back;
            }
            let scale = weight / total;
            Share {
                transmitted: sum.transmitted * scale,
                reflected_front: sum.reflected_front * scale,
                reflected_back: sum.reflected_back * scale,
            }
        };
        let found = [with(&self.rules[0]), with(&self.rules[1])];
        self.values.push(([from, to], found));
        (found, weight)
    }
}
