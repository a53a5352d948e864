//! Section curves of an aperture's luminous intensity distribution (LID), for polar diagrams.

use crate::compute::direction::{Emergent, Surface};
use crate::compute::lid::c_gamma::{Aim, Peak, Peaks};
use crate::compute::lid::{EmergentLuminance, Lid};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Plane in which a polar diagram shows a luminous intensity distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LidPlane {
    /// Vertical plane C – C + 180°, by C in whole degrees: 0° is into the room, 90° along the façade.
    Vertical(u16),
    /// Horizontal plane γ = 90°; C = 0° points down in the drawing.
    Horizontal,
}

impl LidPlane {
    /// Returns the emergent direction at an angle \[rad\] in this plane, counted from nadir (in
    /// [`LidPlane::Horizontal`] from C = 0°) towards the right of the drawing. `aim`: orientation of C and γ in the
    /// luminaire file of the aperture.
    pub fn direction(self, aim: Aim, angle: f64) -> Emergent {
        match self {
            Self::Vertical(c) => aim.direction(f64::from(c).to_radians(), angle),
            Self::Horizontal => aim.direction(angle, FRAC_PI_2),
        }
    }

    /// Returns the name of the plane for a legend, such as "C0–C180": both of its half-planes, the one at the right of
    /// the drawing first.
    pub fn label(&self) -> String {
        match *self {
            Self::Vertical(c) => format!("C{c}–C{}", (c + 180) % 360),
            Self::Horizontal => "γ = 90°".to_owned(),
        }
    }
}

/// Returns the vertical C planes to draw: the one perpendicular to the aperture (C0), and the one of the greatest
/// scattered intensity, which is never left out. Where both are the same, and for roof apertures, the plane along the
/// aperture (C90) is added.
pub fn vertical_planes(surface: Surface, peaks: Option<&Peaks>) -> Vec<LidPlane> {
    let mut planes = vec![LidPlane::Vertical(0)];
    // At nadir and zenith all planes meet.
    let tilted = |peak: &Peak| peak.gamma.sin() > 0.01;
    let peak = peaks.and_then(|peaks| peaks.scattered).filter(tilted);
    if let Some(peak) = peak {
        let c = peak.c.to_degrees().round().rem_euclid(360.0) as u16;
        if !c.is_multiple_of(180) {
            planes.push(LidPlane::Vertical(c));
        }
    }
    let along = LidPlane::Vertical(90);
    if planes.len() == 1 || surface == Surface::Roof && !planes.iter().any(|plane| same_plane(*plane, along)) {
        planes.push(along);
    }
    planes
}

/// Whether two planes are the same; vertical planes of C and C + 180° are.
fn same_plane(a: LidPlane, b: LidPlane) -> bool {
    match (a, b) {
        (LidPlane::Vertical(a), LidPlane::Vertical(b)) => a % 180 == b % 180,
        (a, b) => a == b,
    }
}

/// Number of samples of a section curve, evenly over a full turn from nadir: one every 0.5°.
pub const SAMPLES: usize = 720;

/// Luminous intensities of a distribution, sampled along the section curves of a polar diagram. \[cd\]
#[derive(Debug, Clone)]
pub struct Curves {
    /// Vertical planes, each with its intensities at equal angles over a full turn, from nadir towards the right of the
    /// drawing. \[cd\]
    pub vertical: Vec<(LidPlane, Vec<f64>)>,
    /// Intensities in the horizontal plane γ = 90°, at equal angles over a full turn from C = 0°. \[cd\]
    pub horizontal: Vec<f64>,
    /// Largest intensity of all curves. \[cd\]
    pub max: f64,
}

/// Returns the luminous intensity of the scattered light in an emergent direction, without beams; never negative.
/// \[cd\]
pub fn intensity(lid: &Lid, d: Emergent) -> f64 {
    lid.intensity(d).max(0.0)
}

/// Samples the luminous intensities of a distribution in the horizontal and the given vertical planes, at [`SAMPLES`]
/// angles each.
pub fn sample(lid: &Lid, planes: &[LidPlane]) -> Curves {
    sample_at(lid, planes, SAMPLES)
}

/// Samples the luminous intensities of a distribution in the horizontal and the given vertical planes, at `count` equal
/// angles over a full turn each.
pub fn sample_at(lid: &Lid, planes: &[LidPlane], count: usize) -> Curves {
    let cuts = Cuts::of(lid, count);
    let vertical: Vec<_> = planes.iter().map(|plane| (*plane, cuts.along(*plane, 1))).collect();
    let horizontal = cuts.along(LidPlane::Horizontal, 1);
    let all = vertical.iter().flat_map(|(_, values)| values).chain(&horizontal).copied();
    let max = all.filter(|v| v.is_finite()).fold(0.0, f64::max);
    Curves { vertical, horizontal, max }
}

/// Returns the luminous intensities as the section curves show them, in steps of `step` degrees (a divisor of 180): for
/// each C from 0° on, a list over γ from 0° (nadir) to 180°. \[cd\]
pub fn table(lid: &Lid, step: u16) -> Vec<Vec<f64>> {
    let turn = usize::from(360 / step);
    // Whole multiples of the samples of a curve, about as many.
    let every = SAMPLES.div_ceil(turn);
    let cuts = Cuts::of(lid, turn * every);
    let planes = (0..180).step_by(usize::from(step));
    let cut: Vec<Vec<f64>> = planes.map(|c| cuts.along(LidPlane::Vertical(c), every)).collect();
    let here = cut.iter().map(|all| all[..=turn / 2].to_vec());
    let opposite = cut.iter().map(|all| (0..=turn / 2).map(|k| all[(turn - k) % turn]).collect());
    here.chain(opposite).collect()
}

/// Luminous intensity distribution prepared for section curves. Luminances on fine cells are means over the cell,
/// constant within it; multiplied by the cosine they would give sawtooth curves. They are therefore smoothed by a
/// moving mean over the width of a cell.
struct Cuts {
    /// Luminances on fine cells, which are smoothed.
    fine: Lid,
    rest: Lid,
    /// Number of samples of a full turn.
    count: usize,
    /// Number of samples in half the width of a cell; 0 if nothing is smoothed.
    half: usize,
}

impl Cuts {
    fn of(lid: &Lid, count: usize) -> Self {
        let (fine, rest): (Vec<_>, Vec<_>) = lid.parts.iter().cloned().partition(|part| cell_width(part) <= FINE);
        let width = fine.iter().map(cell_width).fold(0.0, f64::max);
        let part = |parts| Lid { parts, beams: Vec::new(), ..lid.clone() };
        let half = (0.5 * width / TAU * count as f64).round() as usize;
        Self { fine: part(fine), rest: part(rest), count, half }
    }

    /// Returns every `every`-th sample of a section curve, smoothed where the cells are fine. \[cd\]
    fn along(&self, section: LidPlane, every: usize) -> Vec<f64> {
        let aim = Aim::of(self.fine.surface);
        let of = |lid: &Lid, ahead: f64, every: usize| -> Vec<f64> {
            if lid.parts.is_empty() {
                return vec![0.0; self.count.div_ceil(every)];
            }
            let angle = |k: usize| TAU * (k as f64 + ahead) / self.count as f64;
            (0..self.count).step_by(every).map(|k| intensity(lid, section.direction(aim, angle(k)))).collect()
        };
        // Between the samples: edges of cells lie on even angles.
        let smooth = match self.half {
            0 => of(&self.fine, 0.0, every),
            half => moving_mean(&of(&self.fine, 0.5, 1), half, every),
        };
        smooth.into_iter().zip(of(&self.rest, 0.0, every)).map(|(a, b)| a + b).collect()
    }
}

/// Maximum width of cells that are smoothed: wider cells are drawn as steps, since the data have no finer information.
/// \[rad\]
const FINE: f64 = 4.0 * PI / 180.0;

/// Returns the width in θ of the narrowest ring of cells of a part of the luminance; infinite for luminances that are
/// not given on cells. \[rad\]
fn cell_width(part: &EmergentLuminance) -> f64 {
    let EmergentLuminance::Cells { basis, .. } = part else { return f64::INFINITY };
    basis.cells().map(|cell| cell.theta_max - cell.theta_min).fold(f64::INFINITY, f64::min)
}

/// Returns the means over `half` values before and after every `every`-th position of a closed curve; the values lie
/// half a step after the positions.
fn moving_mean(values: &[f64], half: usize, every: usize) -> Vec<f64> {
    let n = values.len();
    let around = |k: usize| (0..2 * half).map(move |j| (k + n * half + j - half) % n);
    (0..n).step_by(every).map(|k| around(k).map(|at| values[at]).sum::<f64>() / (2 * half) as f64).collect()
}

/// Returns the luminous intensity that an ideal (Lambertian) diffuser of the same flux has in an emergent direction:
/// Φ/π · cos θ, with θ from the aperture's normal into the room. \[cd\]
///
/// `flux`: luminous flux Φ. \[lm\]
pub fn diffuser(flux: f64, d: Emergent) -> f64 {
    flux / PI * (-d.0.vector().z).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
    use std::sync::Arc;

    /// Returns a distribution on rings of `degrees`, each with the luminance of its middle.
    fn on_rings(degrees: f64, luminance: fn(f64) -> f64) -> Lid {
        let step = degrees.to_radians();
        let ring = |i: u32| {
            let [theta_min, theta_max] = [i, i + 1].map(|edge| f64::from(edge) * step);
            Ring { theta_min, theta_max, sectors: 1, first_phi: 0.0 }
        };
        let rings: Vec<Ring> = (0..(90.0 / degrees) as u32).map(ring).collect();
        let luminance = rings.iter().map(|ring| luminance(0.5 * (ring.theta_min + ring.theta_max))).collect();
        let basis = Arc::new(RingBasis::new("rings", rings, AzimuthMap::FACADE).unwrap());
        let parts = vec![EmergentLuminance::Cells { basis, luminance }];
        Lid { surface: Surface::Facade, size: [1.0, 1.0], parts, beams: vec![] }
    }

    /// Half-plane from nadir to the horizontal into the room.
    fn down(lid: &Lid) -> Vec<f64> {
        sample(lid, &[LidPlane::Vertical(0)]).vertical[0].1[..=SAMPLES / 4].to_vec()
    }

    #[test]
    fn fine_cells_are_drawn_as_the_smooth_light_that_they_tell() {
        // θ = 90° − γ: I = sinθ cosθ = ½ sin 2γ.
        let drawn = down(&on_rings(3.0, f64::sin));
        for (k, value) in drawn.iter().enumerate().skip(10).take(160) {
            let gamma = TAU * k as f64 / SAMPLES as f64;
            assert!((value - 0.5 * (2.0 * gamma).sin()).abs() < 2e-3, "{k}: {value}");
        }
        assert!(drawn[10..85].is_sorted(), "no teeth");
    }

    #[test]
    fn tables_hold_what_the_curves_show() {
        let lid = on_rings(3.0, f64::sin);
        for step in [3, 5] {
            let table = table(&lid, step);
            assert_eq!((table.len(), table[0].len()), (360 / usize::from(step), 180 / usize::from(step) + 1));
            for c in [0, 30, 45, 90] {
                let drawn = &sample(&lid, &[LidPlane::Vertical(c)]).vertical[0].1;
                let list = &table[usize::from(c / step)];
                let opposite = &table[usize::from((c + 180) / step)];
                for k in 0..list.len() {
                    let at = 2 * k * usize::from(step);
                    assert!((list[k] - drawn[at]).abs() < 1e-12, "C {c}° {at}");
                    assert!((opposite[k] - drawn[(SAMPLES - at) % SAMPLES]).abs() < 1e-12, "C {c}° + 180° {at}");
                }
            }
        }
    }

    #[test]
    fn coarse_cells_are_drawn_as_steps() {
        let drawn = down(&on_rings(10.0, f64::sin));
        assert!(!drawn[10..85].is_sorted(), "data know no better");
    }
}
