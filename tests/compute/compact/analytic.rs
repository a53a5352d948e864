//! Systems in closed form at the 145 façade-Tregenza incidences, by which the compact form is tried: a lobe that goes
//! straight on, one that is redirected, a smooth part.

#![allow(dead_code, reason = "each test takes what it needs")]

use cfs::compute::basis::{AzimuthMap, Ring, RingBasis};
use cfs::compute::btdf::Indicatrices;
use cfs::compute::direction::{Dir, Facade, Incident};
use glam::DVec3;
use std::f64::consts::PI;

/// Rings of `step` degrees in cells about as wide as high, as instruments have them.
pub fn rings(step: f64) -> RingBasis {
    let count = (90.0 / step).round() as usize;
    let ring = |i: usize| {
        let [theta_min, theta_max] = [i, i + 1].map(|k| (k as f64 * 90.0 / count as f64).to_radians());
        let sectors = 4.0 * (90.0 * (0.5 * (theta_min + theta_max)).sin() / step).round();
        Ring { theta_min, theta_max, sectors: (sectors as usize).max(1), first_phi: 0.0 }
    };
    RingBasis::new(format!("{step}°"), (0..count).map(ring).collect(), AzimuthMap::FACADE).unwrap()
}

/// Repeatable noise of mean 0 and deviation 1.
pub struct Noise(pub u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn next(&mut self) -> f64 {
        ((0..12).map(|_| self.uniform()).sum::<f64>()) - 6.0
    }
}

/// A lobe about a direction: exp((ω′·d − 1)/σ²).
fn lobe(twin: DVec3, about: DVec3, sigma_deg: f64) -> f64 {
    ((twin.dot(about) - 1.0) / sigma_deg.to_radians().powi(2)).exp()
}

/// Lobes (flux, direction, σ in degrees) and a smooth part (A + B u)/π with u = −y, for one incidence.
type Parts = (Vec<(f64, DVec3, f64)>, f64, f64);

fn pane(z: f64) -> f64 {
    1.0 - (1.0 - z).powi(5)
}

/// The systems' names.
pub const NAMES: [&str; 5] = ["clear", "laser-cut", "redirect", "slats", "diffuser"];

fn parts(name: &str, d: DVec3) -> Parts {
    let t = (d.y.abs() / 1.5) / (1.0 - (d.x / 1.5).powi(2) - (d.y / 1.5).powi(2)).sqrt() / 0.9;
    match name {
        "clear" => (vec![(0.9 * pane(d.z), d, 2.0)], 0.0, 0.0),
        "laser-cut" => {
            let share = 1.0 - (1.0 - t % 2.0).abs();
            let f = 0.9 * pane(d.z);
            (vec![((1.0 - share) * f, d, 2.0), (share * f, DVec3::new(d.x, -d.y, d.z), 2.0)], 0.0, 0.0)
        }
        "redirect" => {
            let s = if d.y > 0.0 { t.min(1.0) } else { 0.0 };
            let f = 0.88 * pane(d.z);
            let y = -0.75 * d.y;
            let up = DVec3::new(d.x, y, (1.0 - d.x * d.x - y * y).sqrt());
            (vec![((1.0 - s) * f, d, 2.5), (s * 0.85 * 0.8 * f, up, 4.0)], s * 0.85 * 0.2 * f, 0.0)
        }
        "slats" => {
            let (profile, tilt) = (d.y.atan2(d.z), 20_f64.to_radians());
            let through = (1.0 - 80.0 / 72.0 * (tilt + profile).sin().abs() / profile.cos()).max(0.0);
            let scattered = 0.35 * (1.0 - through);
            (vec![(through, d, 2.0)], scattered, 0.7 * scattered * (tilt + profile).sin())
        }
        _ => (vec![], 0.5 * pane(d.z), 0.0),
    }
}

/// Values of one incidence, each the mean of 3 × 3 points of its cell.
pub fn row(name: &str, basis: &RingBasis, d: DVec3) -> Vec<f64> {
    let (lobes, a, b) = parts(name, d);
    let weights = basis.projected_solid_angles();
    let mut values = vec![0.0; basis.len()];
    let points: Vec<Vec<DVec3>> = basis
        .cells()
        .map(|cell| {
            let at = |k: usize| (k as f64 + 0.5) / 3.0;
            let (s0, s1) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
            let point = |k: usize| {
                let theta = (s0 + (s1 - s0) * at(k % 3)).sqrt().asin();
                Dir::<Facade>::from_theta_phi(theta, cell.phi + cell.width * (at(k / 3) - 0.5)).vector()
            };
            (0..9).map(point).collect()
        })
        .collect();
    for (flux, about, sigma) in lobes {
        let shape: Vec<f64> =
            points.iter().map(|list| list.iter().map(|p| lobe(*p, about, sigma)).sum::<f64>() / 9.0).collect();
        let total: f64 = shape.iter().zip(&weights).map(|(g, w)| g * w).sum();
        values.iter_mut().zip(&shape).for_each(|(v, g)| *v += flux * g / total);
    }
    for (value, list) in values.iter_mut().zip(&points) {
        let y = list.iter().map(|p| p.y).sum::<f64>() / 9.0;
        *value += (a - b * y).max(0.0) / PI;
    }
    // As files have them: nothing below a millionth of the peak.
    let peak = values.iter().copied().fold(0.0, f64::max);
    values.iter_mut().filter(|v| **v < 1e-6 * peak).for_each(|v| *v = 0.0);
    values
}

/// A system on cells of `step` degrees, with relative noise.
pub fn system(name: &str, step: f64, noise: f64) -> Indicatrices {
    let basis = rings(step);
    let incident: Vec<Incident> = RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect();
    let mut random = Noise(0x9E37_79B9_7F4A_7C15);
    let values = incident.iter().flat_map(|d| row(name, &basis, d.0.vector()));
    let values = values.map(|q| if noise > 0.0 { (q * (1.0 + noise * random.next())).max(0.0) } else { q }).collect();
    Indicatrices::new(incident, basis, values).unwrap()
}

/// A minimal reader of the `.btdf.txt` form, rings only: enough for the reference kit's own files.
pub fn read_text(text: &str) -> Indicatrices {
    let (header, body) = text.trim_start_matches("---").split_once("\n---").unwrap();
    let list = header.lines().find_map(|line| line.strip_prefix("rings = ")).unwrap();
    let numbers: Vec<f64> = list
        .split(|c: char| !(c.is_ascii_digit() || c == '.'))
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().unwrap())
        .collect();
    // θ of the file is that of the travelling light: through-name 180° − θ, azimuth turned by half.
    let ring = |triple: &[f64]| Ring {
        theta_min: (180.0 - triple[1]).to_radians(),
        theta_max: (180.0 - triple[0]).to_radians(),
        sectors: triple[2] as usize,
        first_phi: 0.0,
    };
    let azimuth = AzimuthMap { sign: 1.0, offset: PI };
    let basis = RingBasis::new("rings", numbers.chunks(3).map(ring).collect(), azimuth).unwrap();
    let (mut incident, mut values) = (vec![], vec![]);
    for line in body.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#')) {
        let mut words = line.split_whitespace().map(|word| word.parse::<f64>().unwrap());
        let (theta, phi) = (words.next().unwrap(), words.next().unwrap());
        incident.push(Incident(Dir::from_theta_phi(theta.to_radians(), phi.to_radians())));
        values.extend(words);
    }
    Indicatrices::new(incident, basis, values).unwrap()
}

/// The two glasses of the report's Figure 11 as closed forms, for light from 48° above: redirecting (upward lobe of
/// 3° × 9°, a rest straight on, haze) and diffusing.
pub fn glass(redirecting: bool, basis: &RingBasis) -> Vec<f64> {
    let about = |altitude: f64, phi: f64| {
        Dir::<Facade>::from_theta_phi((90.0 - altitude).to_radians(), phi.to_radians()).vector()
    };
    let oval = |v: DVec3, d: DVec3, high: f64, wide: f64| {
        let across = DVec3::Y.cross(d).normalize_or_zero();
        let along = d.cross(across);
        let (a, b) = (v.dot(across) / wide.to_radians(), v.dot(along) / high.to_radians());
        if v.dot(d) > 0.0 { (-0.5 * (a * a + b * b)).exp() } else { 0.0 }
    };
    let value = |v: DVec3| {
        if redirecting {
            0.75 * oval(v, about(48.0, 90.0), 3.0, 9.0)
                + 0.15 * oval(v, about(48.0, -90.0), 2.0, 5.0)
                + 0.04 * v.z.max(0.0).sqrt()
        } else {
            0.32 * (0.35 + 0.65 * v.dot(about(60.0, -90.0)).max(0.0).powi(3)) * v.z.max(0.0).powf(0.15)
        }
    };
    basis.cells().map(|cell| value(cell.centre().vector())).collect()
}
