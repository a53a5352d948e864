//! Reciprocal BSDF data from separate computations of light from both sides.
//!
//! Light from direction i outside to direction o inside, and light on the reverse path, have the same q (Helmholtz
//! reciprocity). If both are computed separately, their mean is a better estimate than either. With these means, τ + ρ
//! of an incident cell is no longer exactly the computed value; a factor for every cell, such that all sums are right
//! again, corrects that.

use super::beams::mirror_images;
use super::{Measured, Side};
use crate::compute::scaling::by_newton;
use std::f64::consts::PI;

/// Tolerance of τ + ρ of a cell after the correction by factors. Above the rounding of its sums over both sides (290
/// Klems cells · 2⁻⁵² ≈ 6e-14), below every allowed error.
const LEFT: f64 = 1e-10;

impl Measured {
    /// Returns the data made reciprocal, with τ + ρ of every incident cell unchanged. Returns the data unchanged where
    /// the emergent cells are not the incident ones, or cannot be rotated by 180°.
    pub(super) fn made_reciprocal(mut self) -> Self {
        let Some(turn) = mirror_images(&self.incident, |phi| phi + PI).filter(|_| self.incident == self.emergent)
        else {
            return self;
        };
        let n = turn.len();
        let wanted = Side::BOTH.map(|side| {
            let seen = self.seen(side);
            let pairs = self.shares(&seen.transmitted).into_iter().zip(self.shares(&seen.reflected));
            pairs.map(|(t, r)| t + r).collect::<Vec<f64>>()
        });
        let pairs = (0..n).flat_map(|i| (0..n).map(move |o| (i, o)));
        for (i, o) in pairs.clone() {
            let (there, way_back) = (&mut self.front.transmitted[i * n + o], &mut self.back.transmitted[o * n + i]);
            let mean = 0.5 * (*there + *way_back);
            (*there, *way_back) = (mean, mean);
        }
        for side in Side::BOTH {
            let q = &mut self.seen_mut(side).reflected;
            for (i, o) in pairs.clone() {
                // Through directions of reflected light are opposite.
                let way_back = turn[o] * n + turn[i];
                let mean = 0.5 * (q[i * n + o] + q[way_back]);
                (q[i * n + o], q[way_back]) = (mean, mean);
            }
        }
        let weight = self.incident.projected_solid_angles();
        // Flux between cells of the front (the first half of all lists) and of the back.
        let flux = |scales: &[f64]| {
            let mut sums = vec![0.0; 2 * n];
            for i in 0..n {
                for o in 0..n {
                    let both = weight[i] * weight[o];
                    let q = self.front.transmitted[i * n + o] * both;
                    sums[i] += q * scales[n + o];
                    sums[n + o] += q * scales[i];
                    sums[i] += self.front.reflected[i * n + o] * both * scales[turn[o]];
                    sums[n + i] += self.back.reflected[i * n + o] * both * scales[n + turn[o]];
                }
            }
            sums
        };
        let wanted: Vec<f64> = wanted.iter().flat_map(|side| side.iter().zip(&weight).map(|(x, w)| x * w)).collect();
        let smallest = weight.iter().copied().fold(f64::INFINITY, f64::min);
        let scales = by_newton(flux, &wanted, LEFT * smallest);
        let (front, inside) = scales.split_at(n);
        for (i, o) in pairs {
            let q = self.front.transmitted[i * n + o] * front[i] * inside[o];
            (self.front.transmitted[i * n + o], self.back.transmitted[o * n + i]) = (q, q);
            let [outside, room] = [&mut self.front, &mut self.back].map(|seen| &mut seen.reflected[i * n + o]);
            *outside = *outside * front[i] * front[turn[o]];
            *room = *room * inside[i] * inside[turn[o]];
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::system::measure::Setting;
    use crate::compute::system::measure::front_basis;

    /// A reciprocal, lossy whole, and the same with every row scattered by a few per cent.
    #[test]
    fn scatter_is_averaged_and_the_sums_stay() {
        let cells = front_basis();
        let n = cells.len();
        let turn = mirror_images(&cells, |phi| phi + PI).unwrap();
        let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
        let noise = |k: usize| 1.0 + 0.05 * ((k as f64 * 12.9898).sin() * 43_758.545_3).fract();
        let (mut truth, mut found) = (Measured::dark(&setting), Measured::dark(&setting));
        let shape = |i: usize, o: usize| 0.1 + 0.05 * ((i + o) as f64).sin() + if i == o { 3.0 } else { 0.0 };
        for i in 0..n {
            for (o, &turned) in turn.iter().enumerate() {
                truth.front.transmitted[i * n + o] = shape(i, o);
                truth.back.transmitted[o * n + i] = shape(i, o);
                truth.front.reflected[i * n + o] = 0.3 * shape(i, turned);
                truth.back.reflected[i * n + o] = 0.2 * shape(i, turned);
            }
        }
        for side in Side::BOTH {
            let offset = if side == Side::Front { 0 } else { 7 * n * n };
            let scattered =
                |q: &[f64], at: usize| q.iter().enumerate().map(|(k, q)| q * noise(offset + at + k)).collect();
            found.seen_mut(side).transmitted = scattered(&truth.seen(side).transmitted, 0);
            found.seen_mut(side).reflected = scattered(&truth.seen(side).reflected, 3 * n * n);
        }
        let sums = |m: &Measured, side: Side| -> Vec<f64> {
            let seen = m.seen(side);
            m.shares(&seen.transmitted).into_iter().zip(m.shares(&seen.reflected)).map(|(t, r)| t + r).collect()
        };
        let apart = |m: &Measured| -> f64 {
            Side::BOTH
                .into_iter()
                .flat_map(|side| {
                    let (a, b) = (m.seen(side), truth.seen(side));
                    let t = a.transmitted.iter().zip(&b.transmitted).map(|(x, y)| ((x - y) / y).powi(2));
                    t.chain(a.reflected.iter().zip(&b.reflected).map(|(x, y)| ((x - y) / y).powi(2)))
                        .collect::<Vec<_>>()
                })
                .sum()
        };
        assert!(found.quality().reciprocity.unwrap() > 0.02);
        let made = found.clone().made_reciprocal();
        assert!(made.quality().reciprocity.unwrap() < 1e-14);
        for side in Side::BOTH {
            for (a, b) in sums(&made, side).iter().zip(sums(&found, side)) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
            let q = &made.seen(side).reflected;
            assert!((0..n * n).all(|k| (q[k] - q[turn[k % n] * n + turn[k / n]]).abs() < 1e-12));
        }
        // Two independent estimates: half the variance.
        assert!((0.4..0.65).contains(&(apart(&made) / apart(&found))), "{}", apart(&made) / apart(&found));
        // What is reciprocal already stays.
        let same = truth.clone().made_reciprocal();
        assert!(same.front.transmitted.iter().zip(&truth.front.transmitted).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
