//! A second model of venetian blinds, independent of the program's: flat Lambertian slats, infinitely many and
//! infinitely long.
//!
//! Only the profile angle ψ = atan2(y_F, z_F) of a direction matters. In the section, two neighbouring slats and
//! the two openings between them bound a parallelogram; its interreflection is solved by strips whose form factors
//! follow from Hottel's crossed strings. With g_i(ψ) the illuminance of strip i per illuminance of the façade from
//! outside, h_i(ψ) the same from inside, and M = (1/ρ − F)⁻¹,
//! q(ψ → ψ′) = (Δ/πs) Σ_ij h_i(ψ′) M_ij g_j(ψ): the light that leaves towards ψ′ comes from what ψ′ would light.

use cfs::compute::basis::RingBasis;
use cfs::compute::basis::sub_directions;
use cfs::compute::btdf::{Band, Btdf, CellMatrix, Component, Scattered, reciprocity_error};
use cfs::compute::direction::{Dir, Incident};
use cfs::compute::profile_angle::profile_angle;
use cfs::compute::system::measure::front_basis;
use std::f64::consts::PI;

/// Flat slats that turn about the middle of their chord.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatSlats {
    /// Chord. \[m\]
    pub width: f64,
    /// Vertical pitch. \[m\]
    pub spacing: f64,
    /// Tilt, > 0 = outer edge lowered, −80° … 80°. \[rad\]
    pub tilt: f64,
    /// Diffuse reflectance of the upper face, 0 … 1.
    pub upper: f64,
    /// Diffuse reflectance of the lower face, 0 … 1.
    pub lower: f64,
}

/// Strips a face: 20 keep the error of τ below 6e-4 even for very bright slats (ρ 0.95), 1e-4 would take 40.
const STRIPS: usize = 20;
/// A value for every strip: upper faces first, from the inner edge outwards.
type Strips = [f64; 2 * STRIPS];
/// A value for every strip, for every cell.
type Rows = Vec<Strips>;

/// Directions along each side of a cell over which incidence and emission are averaged.
const SUB: usize = 10;

fn dot(a: &Strips, b: &Strips) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl FlatSlats {
    /// Share of light of a profile angle that passes between the slats: max(0, 1 − w|sin(β+ψ)|/(s cosψ)).
    pub fn direct_share(&self, psi: f64) -> f64 {
        (1.0 - self.width * (self.tilt + psi).sin().abs() / (self.spacing * psi.cos())).max(0.0)
    }

    /// The four functions on Klems cells; unscattered light stays in its cell. `None` for parameters that are out of
    /// range.
    pub fn band(&self) -> Option<Band> {
        let sane = self.width > 0.0
            && self.spacing > 0.0
            && self.tilt.abs() <= 80_f64.to_radians() + 1e-12
            && (0.0..=1.0).contains(&self.upper)
            && (0.0..=1.0).contains(&self.lower);
        if !sane {
            return None;
        }
        let basis = front_basis();
        let (outside, inside, direct) = self.lighting(&basis);
        // The name of reflected light has the opposite profile angle: the cells turned in y.
        let turned: Vec<usize> = basis
            .cells()
            .map(|c| basis.index(Dir::from_theta_phi(c.theta(), -c.phi)).expect("the cells cover all"))
            .collect();
        let mirrored = |lit: &Rows| -> Rows { turned.iter().map(|&cell| lit[cell]).collect() };
        let response = self.response();
        let scale = self.width / STRIPS as f64 / (PI * self.spacing);
        let matrix = |from: &Rows, to: &Rows, straight: Option<&[f64]>| {
            let n = basis.len();
            let mut values = Vec::with_capacity(n * n);
            for lit in from {
                let exitance = response.map(|row| dot(&row, lit));
                values.extend(to.iter().map(|seen| (scale * dot(seen, &exitance)).max(0.0)));
            }
            if let Some(straight) = straight {
                for (i, cell) in basis.cells().enumerate() {
                    values[i * n + i] += straight[i] / cell.projected_solid_angle();
                }
            }
            CellMatrix::new(basis.clone(), basis.clone(), values).expect("n² values for n cells")
        };
        let through = matrix(&outside, &inside, Some(&direct));
        Some(Band {
            transmission_back: Some(Btdf::from_cells(through.reversed())),
            transmission_front: Some(Btdf::from_cells(through)),
            reflection_front: Some(Btdf::from_cells(matrix(&outside, &mirrored(&outside), None))),
            reflection_back: Some(Btdf::from_cells(matrix(&inside, &mirrored(&inside), None))),
        })
    }

    /// Illuminance of every strip per illuminance of the façade, for every cell: light from outside, light from inside; and the direct share of every cell.
    fn lighting(&self, basis: &RingBasis) -> (Rows, Rows, Vec<f64>) {
        let mut outside = vec![[0.0; 2 * STRIPS]; basis.len()];
        let mut inside = outside.clone();
        let mut direct = vec![0.0; basis.len()];
        let weight = 1.0 / (SUB * SUB) as f64;
        for (index, cell) in basis.cells().enumerate() {
            for d in sub_directions(&cell, SUB) {
                let psi = profile_angle(d).expect("directions inside a cell lie before the façade");
                direct[index] += weight * self.direct_share(psi);
                let sine = (self.tilt + psi).sin();
                let density = sine.abs() / psi.cos();
                if density < 1e-12 {
                    continue;
                }
                // Lit length of the chord, in strips, counted from the edge that light meets first.
                let lit = (self.spacing / density / self.width).min(1.0) * STRIPS as f64;
                // From outside: upper faces for sin(β+ψ) > 0, from the outer edge. From inside the light travels
                // towards (ψ), so it comes from the opposite side: the other face, from the inner edge.
                let (face_out, face_in) = if sine > 0.0 { (0, STRIPS) } else { (STRIPS, 0) };
                for k in 0..STRIPS.min(lit.ceil() as usize) {
                    let share = weight * density * (lit - k as f64).min(1.0);
                    outside[index][face_out + STRIPS - 1 - k] += share;
                    inside[index][face_in + k] += share;
                }
            }
        }
        (outside, inside, direct)
    }

    /// Exitance of strip i per illuminance of strip j from outside the enclosure: (1/ρ − F)⁻¹, with black faces left
    /// dark.
    fn response(&self) -> [Strips; 2 * STRIPS] {
        let factors = self.form_factors();
        let rho = |strip: usize| if strip < STRIPS { self.upper } else { self.lower };
        // (1 − ρF) M = ρ: the sum over all reflections, which converges since the strips see the openings as well.
        let mut response = [[0.0; 2 * STRIPS]; 2 * STRIPS];
        for source in 0..2 * STRIPS {
            let mut light = [0.0; 2 * STRIPS];
            light[source] = 1.0;
            while light.iter().any(|light| *light > 1e-16) {
                let exitance: Strips = std::array::from_fn(|strip| rho(strip) * light[strip]);
                exitance.iter().enumerate().for_each(|(strip, exitance)| response[strip][source] += exitance);
                light = std::array::from_fn(|strip| dot(&factors[strip], &exitance));
            }
        }
        response
    }

    /// Form factors between the strips of a slat's upper face and of the lower face of the slat above it.
    fn form_factors(&self) -> [Strips; 2 * STRIPS] {
        let step = self.width / STRIPS as f64;
        let (sin, cos) = self.tilt.sin_cos();
        // Edge k of the lower slat's upper face, and of the upper slat's lower face: (outward, upward).
        let edge = |k: usize, lift: f64| {
            let p = -0.5 * self.width + k as f64 * step;
            [p * cos, lift - p * sin]
        };
        let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        // Of two strips of equal length the factors are the same both ways.
        let factor = |i: usize, j: usize| {
            let (a, b) = (edge(i, 0.0), edge(i + 1, 0.0));
            let (c, d) = (edge(j, self.spacing), edge(j + 1, self.spacing));
            let crossed = distance(a, d) + distance(b, c);
            let along = distance(a, c) + distance(b, d);
            ((crossed - along) / (2.0 * step)).max(0.0)
        };
        std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i < STRIPS, j < STRIPS) {
                (true, false) => factor(i, j - STRIPS),
                (false, true) => factor(j, i - STRIPS),
                _ => 0.0,
            })
        })
    }
}

fn blind(tilt: f64, upper: f64, lower: f64) -> FlatSlats {
    FlatSlats { width: 0.080, spacing: 0.072, tilt: tilt.to_radians(), upper, lower }
}

#[test]
fn black_slats_let_pass_the_direct_share_alone() {
    let band = blind(30.0, 0.0, 0.0).band().unwrap();
    let t = band.transmission_front.unwrap();
    assert!(band.reflection_front.unwrap().tau_hemispherical() == 0.0);
    // Uniform light: crossed strings between the two openings of the parallelogram.
    let (w, s, b) = (0.080_f64, 0.072_f64, 30_f64.to_radians());
    let long = (w * w + s * s + 2.0 * w * s * b.sin()).sqrt();
    let short = (w * w + s * s - 2.0 * w * s * b.sin()).sqrt();
    let exact = (long + short - 2.0 * w) / (2.0 * s);
    assert!((t.tau_hemispherical() - exact).abs() < 2e-3, "{} {exact}", t.tau_hemispherical());
}

#[test]
fn white_slats_lose_nothing_and_grey_ones_something() {
    for tilt in [0.0, 45.0, 75.0, -30.0] {
        for (rho, low, high) in [(1.0, 0.98, 1.02), (0.7, 0.0, 1.0)] {
            let band = blind(tilt, rho, rho).band().unwrap();
            let (t, r) = (band.transmission_front.unwrap(), band.reflection_front.unwrap());
            for ((cell, t), r) in front_basis().cells().zip(taus(&t)).zip(taus(&r)) {
                assert!((low..=high).contains(&(t + r)), "{tilt}° {rho} {}: {t} + {r}", cell.theta());
            }
        }
    }
}

fn taus(btdf: &Btdf) -> Vec<f64> {
    match &btdf.scattered {
        Some(Scattered::Cells(m)) => m.tau_by_cell().to_vec(),
        _ => panic!("a blind is given on cells"),
    }
}

#[test]
fn reciprocal_through_and_back_even_with_unequal_faces() {
    let band = blind(40.0, 0.8, 0.3).band().unwrap();
    let [tf, tb, rf, rb] = Component::ALL.map(|c| band.get(c).unwrap());
    assert!(reciprocity_error(tf, tb).unwrap() < 1e-12);
    // Reflected light is named with its lateral parts turned round: (a → b) and (b → a) swap names with a turn.
    for (function, name) in [(rf, "front"), (rb, "back")] {
        let Some(Scattered::Cells(m)) = &function.scattered else { panic!() };
        let turn = |i: usize| {
            let c = m.incident().cell(i);
            m.incident().index(Dir::from_theta_phi(c.theta(), c.phi + PI)).unwrap()
        };
        for i in 0..m.incident().len() {
            for o in 0..m.emergent().len() {
                let (a, b) = (m.row(i)[o], m.row(turn(o))[turn(i)]);
                assert!((a - b).abs() < 1e-12, "{name} {i} {o}: {a} {b}");
            }
        }
    }
}

#[test]
fn lowered_outer_edges_shade_high_sun_and_turn_it_with_the_room() {
    let sun = |degrees: f64| {
        let turned = if degrees >= 0.0 { 90_f64 } else { 270.0 };
        Incident(Dir::from_theta_phi(degrees.abs().to_radians(), turned.to_radians()))
    };
    let t = |tilt: f64| blind(tilt, 0.5, 0.5).band().unwrap().transmission_front.unwrap();
    assert!(t(45.0).tau(sun(40.0)) < 0.3 * t(45.0).tau(sun(-40.0)));
    // Turned upside down, the world changes sides.
    let (a, b) = (t(45.0).tau(sun(40.0)), t(-45.0).tau(sun(-40.0)));
    assert!((a - b).abs() < 1e-9, "{a} {b}");
}

#[test]
fn one_bounce_matches_a_direct_quadrature() {
    // Slats at 0°, sun at ψ = 30°: with little reflectance, the strip's light to the room is E ρ F(strip → inside).
    let slats = blind(0.0, 1e-3, 1e-3);
    let basis = front_basis();
    let (outside, inside, _) = slats.lighting(&basis);
    // Every strip's hemispherical view of the room by h must be its crossed-string factor to the inner opening.
    let weights = basis.projected_solid_angles();
    let step = slats.width / STRIPS as f64;
    for strip in 0..STRIPS {
        let seen = inside.iter().zip(&weights).map(|(lit, weight)| lit[strip] * weight).sum::<f64>() / PI;
        let (a, b) = (strip as f64 * step, (strip + 1) as f64 * step);
        // Strip from a to b away from the inner edge, opening of height s standing on that edge.
        let s = slats.spacing;
        let exact = ((s + b) - s + a.hypot(s) - (a + b.hypot(s))) / (2.0 * step);
        assert!((seen - exact).abs() < 0.01, "{strip}: {seen} {exact}");
    }
    assert!(outside.iter().flatten().any(|lit| *lit > 0.0));
}
