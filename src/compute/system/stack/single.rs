//! Single directions of a stack: its beams, and the light that its layers scatter from them.
//!
//! The light that a layer scatters is computed on the requested emergent cells. The part that passes the remaining
//! layers undeviated stays on these cells; the rest, reflected between layers and scattered again, is computed on
//! coarser cells by matrices.

use super::flows::{Flows, Sources};
use super::passage::{Arrival, Passage, Place, follow};
use crate::compute::basis::{AzimuthMap, Resampling, RingBasis};
use crate::compute::direction::{Dir, Facade};
use crate::compute::system::measure::fan::middle;
use crate::compute::system::measure::kept::{Kept, Once};
use crate::compute::system::measure::{Beam, OpticalModel, ScatteredLight, Side, front_basis};
use std::f64::consts::PI;
use std::sync::Arc;

/// Maximum share of the incident light that may be neglected for each of two reasons: weak light that arrives at
/// layers, and beams that are too many to be traced. It counts as absorbed. Chosen: cost; small beside the error of
/// 0.01 that the layers are allowed.
const NEGLECTED: f64 = 1e-4;

/// Cache of the flux matrices of a stack, used by all single directions.
#[derive(Default)]
pub(super) struct Singles {
    flows: Once<Flows>,
}

/// Conversion of q between the requested emergent cells and the coarser cells of the matrices.
struct Emergent {
    to_coarse: Resampling,
    from_coarse: Resampling,
}

impl Emergent {
    /// Returns the conversion for the basis `cells`, cached for all stacks.
    fn of(cells: &RingBasis) -> Arc<Self> {
        static KEPT: Kept<Emergent> = Kept::new();
        KEPT.get(cells, || {
            let coarse = front_basis();
            Self { to_coarse: Resampling::new(cells, &coarse), from_coarse: Resampling::new(&coarse, cells) }
        })
    }
}

impl Singles {
    /// Returns the memory of the flux matrices. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.flows.bytes(Flows::bytes)
    }

    /// Returns the beams that leave the stack for parallel light from `side` with the direction of undeviated light
    /// `direction`; layers may use the result of a direction at most `within` \[rad\] from the exact one.
    pub fn beams(
        &self,
        layers: &[Box<dyn OpticalModel>],
        direction: Dir<Facade>,
        side: Side,
        within: f64,
    ) -> Vec<Beam> {
        follow(layers, direction, side, within).leaving
    }

    /// Computes the scattered light on the emergent cells `cells` for parallel light from `side` with the direction of
    /// undeviated light `direction`.
    pub fn scattered(
        &self,
        layers: &[Box<dyn OpticalModel>],
        direction: Dir<Facade>,
        side: Side,
        cells: &RingBasis,
    ) -> ScatteredLight {
        let Passage { mut arrivals, left, .. } = follow(layers, direction, side, 0.0);
        let faint = drop_faint(&mut arrivals);
        let mut error = faint;
        // q on the cells asked for, by through directions of light from `side`.
        let mut arising: Vec<(Place, Vec<f64>)> = Vec::new();
        let azimuth = cells.azimuth();
        // A layer that is met from the other side has the through directions rotated by 180°: so do its cells, in the
        // same order.
        let turned = cells.clone().with_azimuth(AzimuthMap { offset: azimuth.offset + PI, ..azimuth });
        for arrival in &arrivals {
            let own = if arrival.side == side { cells } else { &turned };
            let made = layers[arrival.layer].scattered(arrival.direction, arrival.side, own);
            error += arrival.share * made.error;
            let inwards = arrival.side == Side::Front;
            let beyond = if inwards { (arrival.layer + 1, true) } else { (arrival.layer, false) };
            let before = if inwards { (arrival.layer, false) } else { (arrival.layer + 1, true) };
            for (place, q) in [(beyond, made.transmitted), (before, made.reflected)] {
                if q.is_empty() {
                    continue;
                }
                match arising.iter_mut().find(|(known, _)| *known == place) {
                    Some((_, sum)) => sum.iter_mut().zip(q).for_each(|(sum, q)| *sum += arrival.share * q),
                    None => arising.push((place, q.into_iter().map(|q| arrival.share * q).collect())),
                }
            }
        }
        let unfollowed: f64 = left.iter().map(|(_, beam)| beam.share).sum();
        if arising.is_empty() && unfollowed <= NEGLECTED {
            return ScatteredLight { error: error + unfollowed, ..ScatteredLight::default() };
        }
        let flows = self.flows.get(|| Flows::new(layers));
        let emergent = Emergent::of(cells);
        let mut sources = Sources::dark(layers.len(), flows.cells.len());
        // Undeviated light on the cells asked for; and the same on the coarse ones, to be subtracted from the whole.
        let mut straight = [true, false].map(|_| vec![0.0; cells.len()]);
        let mut known = [true, false].map(|_| vec![0.0; flows.cells.len()]);
        for (place, q) in &arising {
            let shares = flows.straight_out(*place, side);
            let sense = usize::from(!place.1);
            let coarse = emergent.to_coarse.apply(q);
            for (c, q) in coarse.iter().enumerate() {
                let flux = q * flows.weight[c];
                sources.at(*place)[c] += flux;
                known[sense][c] += flux * shares[c];
            }
            // The shares of the coarse cells that each cell overlaps: the flux is that of the coarse ones.
            for ((out, q), share) in straight[sense].iter_mut().zip(q).zip(emergent.from_coarse.apply(&shares)) {
                *out += q * share;
            }
        }
        for (place, beam) in &left {
            if let Some(c) = flows.cells.index(middle(beam)) {
                sources.at(*place)[c] += beam.share;
            }
        }
        let leaving = flows.leaving(&sources, side);
        let mut followed = 0.0;
        let mut whole = |sense: usize| -> Vec<f64> {
            let rest: Vec<f64> = (0..flows.cells.len())
                .map(|c| {
                    let rest = (leaving[sense][c] - known[sense][c]).max(0.0);
                    followed += rest;
                    rest / flows.weight[c]
                })
                .collect();
            let rest = emergent.from_coarse.apply(&rest);
            straight[sense].iter().zip(rest).map(|(a, b)| a + b).collect()
        };
        let [inwards, outwards] = [whole(0), whole(1)];
        let (transmitted, reflected) = if side == Side::Front { (inwards, outwards) } else { (outwards, inwards) };
        ScatteredLight { transmitted, reflected, error: error + flows.error * followed }
    }
}

/// Removes the weakest arrivals, together at most [`NEGLECTED`], and returns their share of the incident light.
fn drop_faint(arrivals: &mut Vec<Arrival>) -> f64 {
    arrivals.sort_by(|a, b| b.share.total_cmp(&a.share));
    let mut dropped = 0.0;
    while let Some(last) = arrivals.last().filter(|last| dropped + last.share <= NEGLECTED) {
        dropped += last.share;
        arrivals.pop();
    }
    dropped
}

#[cfg(test)]
mod tests;
