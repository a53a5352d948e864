//! Direct share: light that passes between the slats without touching them, in closed form, and its exact means over
//! cells.

use super::array::SlatArray;
use super::outline;
use super::profile::{SlatProfile, arc};
use super::profile_weights::Piece;
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::quadrature::gauss_legendre;
use std::f64::consts::{FRAC_PI_2, PI};

/// Direct share (light that passes without touching a slat) as a function of the profile angle ψ, with the angles at
/// which it is not smooth.
#[derive(Debug, Clone)]
pub(super) struct Direct {
    profile: SlatProfile,
    tilt: f64,
    pitch: f64,
    knots: Vec<f64>,
}

/// Number of straight pieces by which the outline of a curved slat with thickness is approximated. Chosen: cost; the
/// pieces miss the arc by 1/256² ≈ 1.5e-5 of its rise (2e-5 for half a circle).
const OUTLINE: usize = 256;

impl SlatArray {
    /// Returns the share, 0 … 1, of light with profile angle `psi` \[rad\] that passes without touching a slat.
    pub fn direct_share(&self, psi: f64) -> f64 {
        Direct::without_knots(self).share(psi)
    }
}

impl Direct {
    /// Creates the direct share of an array of slats, with the profile angles at which it is not smooth (knots).
    pub(super) fn new(array: &SlatArray) -> Self {
        let direct = Self::without_knots(array);
        Self { knots: direct.find_knots(), ..direct }
    }

    /// Creates the direct share of an array of slats without knots, for single profile angles, where nothing is
    /// integrated.
    pub(super) fn without_knots(array: &SlatArray) -> Self {
        // A solid slat blocks its outline's extent; the outline is given at its tilt already.
        let solid = array.thickness() > 0.0;
        let (profile, tilt) = if solid {
            let mut points = outline::polygon(array, OUTLINE);
            points.push(points[0]);
            (SlatProfile::Polyline(points), 0.0)
        } else {
            (array.profile().clone(), array.tilt())
        };
        Self { profile, tilt, pitch: array.spacing(), knots: vec![] }
    }

    /// Returns the share of light, 0 … 1, that passes without touching a slat at a profile angle. \[rad\]
    pub(super) fn share(&self, psi: f64) -> f64 {
        self.profile.open_share(self.tilt, self.pitch, psi)
    }

    /// Returns the profile angles at which the formula of a slat's extent changes, and at which the direct share
    /// reaches 0. \[rad\]
    fn find_knots(&self) -> Vec<f64> {
        let mut slopes: Vec<f64> = match &self.profile {
            SlatProfile::Flat { .. } => vec![0.0],
            SlatProfile::Arc { width, rise } => {
                let half = arc(*width, *rise).1;
                // The tangent leaves the arc at its ends; with ends and crown at one height the law changes, too.
                vec![half, -half, 0.0]
            }
            SlatProfile::Polyline(points) => {
                let hull = hull(points);
                let next = hull.iter().cycle().skip(1);
                hull.iter().zip(next).map(|(a, b)| (b[1] - a[1]).atan2(b[0] - a[0])).collect()
            }
        };
        slopes.iter_mut().for_each(|slope| *slope = (*slope - self.tilt + FRAC_PI_2).rem_euclid(PI) - FRAC_PI_2);
        slopes.extend([-FRAC_PI_2, FRAC_PI_2]);
        slopes.sort_by(f64::total_cmp);
        slopes.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        let mut knots = slopes.clone();
        let closed = |psi: f64| self.profile.clearance(self.tilt, self.pitch, psi) < 0.0;
        /// Number of steps, at most 2.8° wide, in which the direct share is searched for zeros between two such angles.
        /// Chosen; held by `tests/compute/goniophotometer_slats.rs::the_direct_share_is_exact_in_every_cell` (1e-5).
        const SCAN: usize = 64;
        for pair in slopes.windows(2) {
            let step = (pair[1] - pair[0]) / SCAN as f64;
            for k in 0..SCAN {
                let (mut low, mut high) = (pair[0] + k as f64 * step, pair[0] + (k + 1) as f64 * step);
                let below = closed(low);
                if below == closed(high) {
                    continue;
                }
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if closed(middle) == below { low = middle } else { high = middle }
                }
                knots.push(0.5 * (low + high));
            }
        }
        knots
    }

    fn integrate(&self, pieces: &[Piece], rule: &[(f64, f64)]) -> f64 {
        let mut sum = 0.0;
        for piece in pieces {
            piece.integrate(rule, &self.knots, |psi, weight| sum += weight * psi.cos() * self.share(psi));
        }
        sum
    }

    /// Returns, for every incident cell, the mean direct share and its flux into emergent cells: pairs of the emergent
    /// cell's index and ∫ share dPΩ over the overlap of both cells (PΩ: projected solid angle \[sr\]).
    pub(super) fn cells(&self, incident: &RingBasis, emergent: &RingBasis) -> Vec<(f64, Vec<(usize, f64)>)> {
        let rule = gauss_legendre(10);
        let rings = RingIndex::new(emergent);
        incident
            .cells()
            .map(|cell| {
                let parts: Vec<(usize, f64)> = rings
                    .near(&cell)
                    .filter_map(|o| {
                        let pieces = Piece::shared(&cell, &emergent.cell(o));
                        let flux = self.integrate(&pieces, &rule);
                        (flux > 0.0).then_some((o, flux))
                    })
                    .collect();
                (self.integrate(&Piece::of(&cell), &rule) / cell.projected_solid_angle(), parts)
            })
            .collect()
    }
}

/// Rings of a basis by their polar angle θ, to find the cells that overlap a ring.
struct RingIndex {
    rings: Vec<(f64, f64, std::ops::Range<usize>)>,
}

impl RingIndex {
    fn new(basis: &RingBasis) -> Self {
        let rings = basis.rings().iter().enumerate();
        Self {
            rings: rings
                .map(|(k, ring)| {
                    let first = basis.first_cell(k);
                    (ring.theta_min, ring.theta_max, first..first + ring.sectors)
                })
                .collect(),
        }
    }

    fn near<'a>(&'a self, cell: &'a Cell) -> impl Iterator<Item = usize> + 'a {
        let meets = |ring: &&(f64, f64, std::ops::Range<usize>)| ring.0 < cell.theta_max && ring.1 > cell.theta_min;
        self.rings.iter().filter(meets).flat_map(|ring| ring.2.clone())
    }
}

/// Returns the convex hull of points, counter-clockwise (Andrew's monotone chain).
fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let chain = |order: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut list: Vec<[f64; 2]> = vec![];
        for &p in order {
            while let [.., a, b] = list[..] {
                if (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0.0 {
                    break;
                }
                list.pop();
            }
            list.push(p);
        }
        list.pop();
        list
    };
    let mut list = chain(&mut sorted.iter());
    list.extend(chain(&mut sorted.iter().rev()));
    list
}
