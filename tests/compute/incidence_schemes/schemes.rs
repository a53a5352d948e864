//! The reference kit's analytic systems: q in closed form at every incident direction.

use cfs::compute::basis::RingBasis;
use cfs::compute::incidence::grid::Grid;
use cfs::compute::incidence::superpose::sub_patches;
use glam::DVec3;
use std::f64::consts::PI;

/// Names of the systems whose files are in the kit.
pub const NAMES: [&str; 7] = ["clear", "scatter", "lcp", "lcpskew", "redirect", "slats", "diffuser"];

/// Lobes as (flux, direction, σ \[°\]), then A and B of (A + B u)/π, u along the given vector.
struct Parts {
    lobes: Vec<(f64, DVec3, f64)>,
    a: f64,
    b: f64,
}

fn pane(t: f64, z: f64) -> f64 {
    t * (1.0 - (1.0 - z).powi(5))
}

/// A laser-cut panel rolled about its normal.
fn laser_cut(d: DVec3, depth: f64, roll: f64) -> Parts {
    let (right, up) = (DVec3::new(roll.cos(), roll.sin(), 0.0), DVec3::new(-roll.sin(), roll.cos(), 0.0));
    let (x, y) = (d.dot(right), d.dot(up));
    let inside = y.abs() / 1.5;
    let t = inside / (1.0 - (x / 1.5).powi(2) - inside * inside).sqrt() / depth;
    let (s, f) = (1.0 - (1.0 - t % 2.0).abs(), pane(0.9, d.z));
    let mirrored = right * x - up * y + DVec3::Z * d.z;
    Parts { lobes: vec![((1.0 - s) * f, d, 2.0), (s * f, mirrored, 2.0)], a: 0.0, b: 0.0 }
}

fn parts(name: &str, d: DVec3) -> Parts {
    match name {
        "clear" => Parts { lobes: vec![(pane(0.9, d.z), d, 2.0)], a: 0.0, b: 0.0 },
        "scatter" => {
            let f = pane(0.85, d.z);
            Parts { lobes: vec![(0.8 * f, d, 10.0)], a: 0.2 * f, b: 0.0 }
        }
        "lcp" => laser_cut(d, 0.7, 0.0),
        "lcpskew" => laser_cut(d, 0.9, 20_f64.to_radians()),
        "redirect" => {
            let inside = d.y.abs() / 1.5;
            let t = inside / (1.0 - (d.x / 1.5).powi(2) - inside * inside).sqrt() / 0.9;
            let s = if d.y > 0.0 { t.min(1.0) } else { 0.0 };
            let f = pane(0.88, d.z);
            let y = -0.75 * d.y;
            let bent = DVec3::new(d.x, y, (1.0 - d.x * d.x - y * y).sqrt());
            let lobes = vec![((1.0 - s) * f, d, 2.5), (s * 0.85 * 0.8 * f, bent, 4.0)];
            Parts { lobes, a: s * 0.85 * 0.2 * f, b: 0.0 }
        }
        "slats" => {
            let (profile, tilt) = (d.y.atan2(d.z), 20_f64.to_radians());
            let through = (1.0 - 80.0 / 72.0 * (tilt + profile).sin().abs() / profile.cos()).max(0.0);
            let a = 0.35 * (1.0 - through);
            Parts { lobes: vec![(through, d, 2.0)], a, b: 0.7 * a * (tilt + profile).sin() }
        }
        "diffuser" => Parts { lobes: vec![], a: pane(0.5, d.z), b: 0.0 },
        other => panic!("no system {other}"),
    }
}

/// Compares indicatrices with the truth by flux on cells of 7.5°, blurred.
pub struct Judge {
    fine: Grid,
    compare: Grid,
}

impl Judge {
    pub fn new(cells: &RingBasis) -> Self {
        Self { fine: Grid::new(cells), compare: Grid::new(&sub_patches(7.5_f64.to_radians())) }
    }

    /// q as means over the fine cells, every lobe with exactly its flux.
    pub fn truth(&self, name: &str, d: DVec3) -> Vec<f64> {
        let parts = parts(name, d);
        // u = −y′ for every system that has B.
        let smooth = |c: &DVec3| (parts.a - parts.b * c.y).max(0.0) / PI;
        let mut q: Vec<f64> = self.fine.centre.iter().map(smooth).collect();
        for (flux, centre, spread) in parts.lobes {
            let square = spread.to_radians().powi(2);
            let mut cells = vec![];
            self.fine.within(centre, 5.0 * spread.to_radians(), |cell| {
                cells.push((cell, self.fine.cell_mean(cell, 6, |e| ((e.dot(centre) - 1.0) / square).exp())));
            });
            let own: f64 = cells.iter().map(|&(cell, g)| g * self.fine.projected[cell]).sum();
            cells.iter().for_each(|&(cell, g)| q[cell] += flux * g / own);
        }
        q
    }

    fn picture(&self, q: &[f64]) -> Vec<f64> {
        let mut flux = vec![0.0; self.compare.centre.len()];
        for ((q, w), &c) in q.iter().zip(&self.fine.projected).zip(&self.fine.centre) {
            for (ring, k, _, share) in self.compare.around_rings(c) {
                flux[self.compare.basis().first_cell(ring) + k] += q * w * share;
            }
        }
        flux.iter_mut().zip(&self.compare.projected).for_each(|(f, w)| *f /= w);
        self.compare.blurred(&flux)
    }

    /// Share of the flux that is not where it should be, for every indicatrix on the fine cells; `None` where nothing
    /// gets through.
    pub fn misplaced(&self, name: &str, d: DVec3, list: &[Vec<f64>]) -> Option<Vec<f64>> {
        let truth = self.picture(&self.truth(name, d));
        let weights = &self.compare.projected;
        let tau: f64 = truth.iter().zip(weights).map(|(q, w)| q * w).sum();
        let apart = |q: &Vec<f64>| -> f64 {
            self.picture(q).iter().zip(&truth).zip(weights).map(|((a, b), w)| (a - b).abs() * w).sum()
        };
        (tau > 1e-6).then(|| list.iter().map(|q| 0.5 * apart(q) / tau).collect())
    }
}
