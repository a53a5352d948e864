//! Luminaire as photometric files describe it: the data that EULUMDAT and IES LM-63 have in common.
//!
//! Plain data between the two formats and the rest of the program. Angles are in degrees here, as in the files.

use crate::compute::btdf::Finding;
use crate::compute::lid::Intensities;
use crate::compute::lid::c_gamma::{Aim, CGammaTable, Widened};
use std::f64::consts::FRAC_PI_2;

pub use super::luminaire_opening::{Opening, Shape};

/// Type of photometry: the axis about which the planes of a photometric file are rotated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Photometry {
    /// Type C: vertical axis of the C planes, with angles C of the planes and γ from the nadir.
    C,
    /// Type B: horizontal axis; vertical angles identify the planes, horizontal angles lie in them (LM-75-01). Read
    /// unchanged, not converted to C.
    B,
    /// Type A: vertical axis; horizontal angles identify the planes, vertical angles lie in them, from the horizon
    /// (LM-75-01). Read unchanged.
    A,
}

/// Texts that identify a luminaire and the origin of its data.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Description {
    /// Number of the report on the measurement or computation.
    pub report: String,
    /// Laboratory or program that measured or computed the intensities.
    pub laboratory: String,
    /// Date of issue of the data, as text.
    pub date: String,
    /// Maker of the luminaire.
    pub manufacturer: String,
    /// Catalogue number of the luminaire.
    pub number: String,
    /// Name of the luminaire.
    pub name: String,
    /// Name of the light source or lamp.
    pub lamp: String,
    /// Remarks for users of the file, one paragraph each.
    pub remarks: Vec<String>,
}

/// Luminaire with its luminous intensity distribution, as read from or written to a photometric file.
#[derive(Debug, Clone, PartialEq)]
pub struct Luminaire {
    /// Name of the format and edition, as the file states it.
    pub format: String,
    /// Texts that identify the luminaire.
    pub text: Description,
    /// Type of photometry, which defines planes and angles.
    pub photometry: Photometry,
    /// Luminous opening.
    pub opening: Opening,
    /// Angles of the planes, rising; for photometry C those of the full turn (360° not repeated), or one plane that
    /// represents all. \[°\]
    pub c_deg: Vec<f64>,
    /// Angles in each plane, rising; for photometry C γ from the nadir. \[°\]
    pub gamma_deg: Vec<f64>,
    /// Luminous intensities, plane by plane in the order of `c_deg`, in each for all angles of `gamma_deg`. \[cd\]
    pub intensity: Vec<f64>,
    /// Rated luminous flux of the lamps that the intensities belong to; `None` for absolute photometry. \[lm\]
    pub lamp_flux: Option<f64>,
    /// Electrical power of the luminaire. \[W\]
    pub power: f64,
    /// Findings of the file's reader, e.g. about assumptions it made.
    pub findings: Vec<Finding>,
}

impl Luminaire {
    /// Creates a luminaire that represents an aperture, from its tabulated luminous intensity distribution.
    ///
    /// `size` is the size of the aperture along the x and y axes of its frame \[m\]. Remarks on orientation,
    /// subdivision and quadrature are added to those of `text`, because a lighting program whose user does not know
    /// them computes the near field or the direction wrongly.
    pub fn from_table(table: &CGammaTable, size: [f64; 2], mut text: Description) -> Self {
        let [x, y] = size;
        let opening = match table.aim {
            Aim::Mounted => Opening::rectangular(0.0, x, y),
            Aim::Down => Opening::rectangular(x, y, 0.0),
        };
        text.remarks.extend(orientation_remarks(table.aim, size));
        text.remarks.push(table_remark(table));
        // To the digits that files have: a reader of ours finds the same numbers.
        let degrees = |angles: &[f64]| angles.iter().map(|angle| (1e4 * angle.to_degrees()).round() / 1e4).collect();
        Self {
            format: "computed".to_owned(),
            text,
            photometry: Photometry::C,
            opening,
            c_deg: degrees(&table.c),
            gamma_deg: degrees(&table.gamma),
            intensity: table.intensity.clone(),
            lamp_flux: Some(table.flux.value),
            power: 0.0,
            findings: Vec::new(),
        }
    }

    /// Returns the intensity distribution for evaluation in any direction, interpolated as by a lighting program, with
    /// angles in radians. Only for photometry C.
    pub fn intensities(&self) -> Intensities {
        Intensities { c: radians(&self.c_deg), gamma: radians(&self.gamma_deg), values: self.intensity.clone() }
    }

    /// Returns the intensities in the plane with index `plane`, one per angle of `gamma_deg`. \[cd\]
    pub fn plane(&self, plane: usize) -> &[f64] {
        &self.intensity[plane * self.gamma_deg.len()..][..self.gamma_deg.len()]
    }

    /// Returns the luminous flux between the nadir and the angle γ = `gamma_deg` \[°\] by the zonal sum: a zone between
    /// two angles has the mean of their intensities, a plane represents half the distance to its neighbours. \[lm\]
    /// Only for photometry C.
    pub fn flux_within(&self, gamma_deg: f64) -> f64 {
        let weights = self.plane_weights();
        let mut flux = 0.0;
        for (pair_index, pair) in self.gamma_deg.windows(2).enumerate() {
            if pair[0] >= gamma_deg {
                break;
            }
            let end = pair[1].min(gamma_deg);
            let share = (end - pair[0]) / (pair[1] - pair[0]);
            let zone = pair[0].to_radians().cos() - end.to_radians().cos();
            for (plane, weight) in weights.iter().enumerate() {
                let [from, to] = [pair_index, pair_index + 1].map(|k| self.plane(plane)[k]);
                let to = from + share * (to - from);
                flux += 0.5 * (from + to) * zone * weight;
            }
        }
        flux
    }

    /// Returns the luminous flux of the whole distribution. \[lm\] For a single plane of photometry A or B, which does
    /// not determine the flux, 0.
    pub fn flux(&self) -> f64 {
        let (horizontal, vertical) = match self.photometry {
            Photometry::C => return self.flux_within(180.0),
            Photometry::A => (about_axis(&self.c_deg), from_equator(&self.gamma_deg)),
            Photometry::B => (from_equator(&self.c_deg), about_axis(&self.gamma_deg)),
        };
        let plane = |plane: usize| self.plane(plane).iter().zip(&vertical).map(|(cd, weight)| cd * weight).sum::<f64>();
        let flux = horizontal.iter().enumerate().map(|(k, weight)| weight * plane(k)).sum::<f64>();
        // LM-63: horizontal angles from 0 stand for both sides.
        if self.c_deg[0] == 0.0 { 2.0 * flux } else { flux }
    }

    /// Returns the range of the angle C that each plane represents. \[rad\]
    fn plane_weights(&self) -> Vec<f64> {
        let n = self.c_deg.len();
        (0..n)
            .map(|k| {
                let next = if k + 1 < n { self.c_deg[k + 1] } else { self.c_deg[0] + 360.0 };
                let last = if k > 0 { self.c_deg[k - 1] } else { self.c_deg[n - 1] - 360.0 };
                (0.5 * (next - last)).to_radians()
            })
            .collect()
    }

    /// Returns the largest luminous intensity. \[cd\]
    pub fn peak(&self) -> f64 {
        self.intensity.iter().copied().fold(0.0, f64::max)
    }
}

fn radians(degrees: &[f64]) -> Vec<f64> {
    degrees.iter().map(|angle| angle.to_radians()).collect()
}

/// Returns the integration weights of plane angles, given in degrees, for intensities that are linear between planes.
/// \[rad\]
fn about_axis(degrees: &[f64]) -> Vec<f64> {
    weights(&radians(degrees), |[a, b]| [0.5 * (b - a); 2])
}

/// Returns the integration weights of angles from the equator, given in degrees, for intensities that are linear
/// between them: integrals over the cosine.
fn from_equator(degrees: &[f64]) -> Vec<f64> {
    let angles: Vec<f64> = radians(degrees).iter().map(|angle| angle.clamp(-FRAC_PI_2, FRAC_PI_2)).collect();
    weights(&angles, |[a, b]| {
        // Beyond a pole there is nothing.
        if b <= a {
            return [0.0; 2];
        }
        let mean = (a.cos() - b.cos()) / (b - a);
        [mean - a.sin(), b.sin() - mean]
    })
}

/// Returns the integration weights of angles, as sums of those that `of_pair` returns for the two ends of each
/// interval.
fn weights(angles: &[f64], of_pair: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<f64> {
    let mut weights = vec![0.0; angles.len()];
    for (k, pair) in angles.windows(2).enumerate() {
        let [first, second] = of_pair([pair[0], pair[1]]);
        weights[k] += first;
        weights[k + 1] += second;
    }
    weights
}

fn orientation_remarks(aim: Aim, [x, y]: [f64; 2]) -> Vec<String> {
    let orientation = match aim {
        Aim::Mounted => {
            "Orientation: type C as mounted in the facade. Nadir is down, C0 points into the room, C90 to the left seen \
             from outside (C counted counter-clockwise seen from above). Place without tilt."
        }
        Aim::Down => {
            "Orientation: outward normal up, light goes down (as in a roof). C0 is the right seen from outside, C90 the \
             aperture's up. For a facade tilt by 90 deg so that C90 points up and the nadir into the room."
        }
    };
    vec![
        orientation.to_owned(),
        format!(
            "Opening {x:.4} m x {y:.4} m (width x height seen from outside). The host must subdivide the luminous area: \
             as a point source it is wrong nearer than about five times its size."
        ),
    ]
}

fn table_remark(table: &CGammaTable) -> String {
    let mut text = format!(
        "Intensities are means over cells of {} deg; zonal flux {:.4} lm, scaled by {:+.4} % to match the computed flux \
         (numerical error {:.4} lm).",
        table.step.degrees(),
        table.flux.value,
        100.0 * (table.scaled_by - 1.0),
        table.flux.error
    );
    let flux = table.beam_flux;
    let beams = match table.widened {
        _ if flux == 0.0 => String::new(),
        None => format!(
            " The unscattered sunbeam of {flux:.4} lm is spread over the four nearest nodes: patches of sun are blurred to \
             this step."
        ),
        Some(Widened { size: [x, y], distance: [near, far], step: [across, along] }) => format!(
            " Unscattered sunlight of {flux:.4} lm is widened to {x:.3} m x {y:.3} m at {near:.2} m to {far:.2} m, where \
             it meets a surface, with nodes as close as {:.2} deg in C and {:.2} deg in gamma round it: edges of patches \
             of sun are blurred by that, flux and place are kept.",
            across.to_degrees(),
            along.to_degrees()
        ),
    };
    text.push_str(&beams);
    text
}
