//! Beams transmitted and reflected between the layers of a stack, traced one by one.
//!
//! All directions are directions of undeviated light as for light from the side that the incident light comes from. For
//! a layer that is met from its other side they are rotated by 180° about the normal.

use crate::compute::direction::{Dir, Facade};
use crate::compute::system::measure::fan::{middle, pieces};
use crate::compute::system::measure::merged::{SAME, merged, place};
use crate::compute::system::measure::{Beam, OpticalModel, Side};
use glam::DVec3;
use std::collections::BTreeMap;

/// Share of the incident light still between the layers below which tracing ends: for an exact direction, and where
/// neighbouring directions share a result. Chosen: cost; the first is held to 2e-7 by the test
/// `panes_as_layers_follow_their_geometric_series` of `single`.
const ENOUGH: [f64; 2] = [1e-7, 1e-5];
/// Share of [`ENOUGH`] that may be dropped per bounce, faintest beams first. Chosen: cost; ten bounces drop no more
/// than [`ENOUGH`].
const FAINT: f64 = 0.1;
/// Angular width of the parts into which a fan of light is divided at a layer. \[rad\] Chosen: half the sun's diameter
/// of 0.53°.
const PIECE: f64 = 0.25 * std::f64::consts::PI / 180.0;
/// Limits for the number of pairs of layer and direction: up to the first limit every beam is traced, up to the second
/// those with a share of at least [`WEAK`]. Panes and cut panels need a handful; prisms produce ever more directions of
/// ever less light. Chosen: cost; light that is not traced counts as scattered.
const ASKED: [usize; 2] = [200, 600];
/// Share of the incident light from which a beam is traced beyond the first limit of [`ASKED`]. Chosen: cost; a tenth
/// of the share that may be neglected in all.
const WEAK: f64 = 1e-5;

/// Position and sense of light in a stack: number of the gap between layers (0 is outside), and whether the light
/// travels inwards.
pub(super) type Place = (usize, bool);

/// Parallel light of one direction that arrives at a layer from one side.
pub(super) struct Arrival {
    /// Index of the layer, from the outermost on.
    pub layer: usize,
    /// Side that the light comes from.
    pub side: Side,
    /// Direction of undeviated light for the layer, as seen from the side that the light comes from.
    pub direction: Dir<Facade>,
    /// Share of the light on the stack that arrives, summed over all bounces between layers.
    pub share: f64,
    /// Beams that the layer transmits and reflects of this light.
    beams: Vec<Beam>,
}

/// Result of tracing parallel light through a stack, with all bounces between layers.
#[derive(Default)]
pub(super) struct Passage {
    /// Beams that leave the stack, transmitted or reflected.
    pub leaving: Vec<Beam>,
    /// Light that arrived at the layers, by layer, side and direction.
    pub arrivals: Vec<Arrival>,
    /// Beams that were not traced any further, with the gap and the sense in which they travel.
    pub left: Vec<(Place, Beam)>,
}

/// Returns the direction of undeviated light as it is for light from the other side: rotated by 180° about the normal.
pub(super) fn half_turn(direction: Dir<Facade>) -> Dir<Facade> {
    let v = direction.vector();
    Dir::from_unit(DVec3::new(-v.x, -v.y, v.z))
}

/// Traces parallel light from `side` with the direction of undeviated light `direction` through `layers` (outermost
/// first). Layers may use the result of a direction at most `within` \[rad\] from the exact one.
pub(super) fn follow(layers: &[Box<dyn OpticalModel>], direction: Dir<Facade>, side: Side, within: f64) -> Passage {
    let n = layers.len();
    let enough = ENOUGH[usize::from(within > 0.0)];
    let mut passage = Passage::default();
    let mut known: BTreeMap<(usize, bool, [i64; 2]), usize> = BTreeMap::new();
    let start = if side == Side::Front { (0, true) } else { (n, false) };
    let mut light: Vec<(Place, Beam)> = vec![(start, Beam::through(direction, 1.0))];
    // By gap, outwards and inwards.
    let mut next: Vec<Vec<Beam>> = vec![Vec::new(); 2 * (n + 1)];
    while !light.is_empty() {
        for ((gap, inwards), beam) in light.drain(..) {
            let from = if inwards { Side::Front } else { Side::Back };
            let named = |direction: Dir<Facade>| if from == side { direction } else { half_turn(direction) };
            let layer = if inwards { gap } else { gap - 1 };
            for piece in pieces(&beam, PIECE) {
                let asked = named(middle(&piece));
                let v = asked.vector();
                let key = (layer, inwards, [v.x, v.y].map(place));
                let number = if let Some(&number) = known.get(&key) {
                    number
                } else {
                    let count = passage.arrivals.len();
                    if count >= ASKED[1] || (count >= ASKED[0] && piece.share < WEAK) {
                        passage.left.push(((gap, inwards), piece));
                        continue;
                    }
                    let beams = if within > 0.0 {
                        layers[layer].beams_about(asked, from, within)
                    } else {
                        layers[layer].beams(asked, from)
                    };
                    passage.arrivals.push(Arrival { layer, side: from, direction: asked, share: 0.0, beams });
                    known.insert(key, count);
                    count
                };
                let arrival = &mut passage.arrivals[number];
                arrival.share += piece.share;
                for made in &arrival.beams {
                    let kept =
                        made.directions.iter().all(|to| (to.vector() - arrival.direction.vector()).length() < SAME);
                    let directions = if kept { piece.directions } else { made.directions.map(named) };
                    let (to, inwards) = match (made.transmitted, inwards) {
                        (true, true) => (gap + 1, true),
                        (true, false) => (gap - 1, false),
                        (false, _) => (gap, !inwards),
                    };
                    next[2 * to + usize::from(inwards)].push(Beam {
                        directions,
                        share: piece.share * made.share,
                        transmitted: true,
                    });
                }
            }
        }
        for (k, beams) in next.iter_mut().enumerate().filter(|(_, beams)| !beams.is_empty()) {
            let whole = merged(beams.drain(..)).into_iter().filter(|beam| beam.share > 0.0);
            match (k / 2, k % 2 == 1) {
                (0, false) => {
                    passage.leaving.extend(whole.map(|beam| Beam { transmitted: side == Side::Back, ..beam }));
                }
                (gap, true) if gap == n => {
                    passage.leaving.extend(whole.map(|beam| Beam { transmitted: side == Side::Front, ..beam }));
                }
                place => light.extend(whole.map(|beam| (place, beam))),
            }
        }
        if light.iter().map(|(_, beam)| beam.share).sum::<f64>() < enough {
            break;
        }
        // The strongest are asked for first, while there is room for them.
        light.sort_by(|a, b| b.1.share.total_cmp(&a.1.share));
        let mut left_out = FAINT * enough;
        while let Some((_, last)) = light.last().filter(|(_, last)| last.share <= left_out) {
            left_out -= last.share;
            light.pop();
        }
    }
    passage.leaving = merged(passage.leaving);
    passage
}
