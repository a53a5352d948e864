//! Beams reflected and transmitted between the layers of a stack, followed one by one.
//!
//! All through directions are those of light from the side that is asked about. A layer that is met from the other side
//! has the same light at the through direction rotated by 180°.

use crate::compute::direction::{Dir, Facade};
use crate::compute::system::measure::fan::{middle, pieces};
use crate::compute::system::measure::merged::{SAME, merged, place};
use crate::compute::system::measure::{Beam, OpticalModel, Side};
use glam::DVec3;
use std::collections::BTreeMap;

/// Share of light still between the layers below which following ends: for an exact direction, and where neighbouring
/// directions share a result. Chosen: cost; the first is held to 2e-7 by the test
/// `panes_as_layers_follow_their_geometric_series` of `single`.
const ENOUGH: [f64; 2] = [1e-7, 1e-5];
/// Share of [`ENOUGH`] that may be dropped per bounce, faintest beams first. Chosen: cost; ten bounces drop no more
/// than [`ENOUGH`].
const FAINT: f64 = 0.1;
/// Width of the parts into which a fan is divided at a layer. \[rad\] Chosen: half the sun's diameter of 0.53°.
const PIECE: f64 = 0.25 * std::f64::consts::PI / 180.0;
/// Numbers of pairs of layer and direction: up to the first number every beam is followed, up to the second those of at
/// least [`WEAK`]. Panes and cut panels need a handful; prisms produce ever more directions of ever less light. Chosen:
/// cost; light that is not followed counts as scattered.
const ASKED: [usize; 2] = [200, 600];
/// Share from which a beam is followed beyond the first number of [`ASKED`]. Chosen: cost; a tenth of the share that
/// may be neglected in all.
const WEAK: f64 = 1e-5;

/// Place of light: number of the gap (0 is outside) and whether it travels inwards.
pub(super) type Place = (usize, bool);

/// Light of one direction that arrives at a layer.
pub(super) struct Arrival {
    pub layer: usize,
    /// Side that the light comes from.
    pub side: Side,
    /// Through direction for the layer.
    pub name: Dir<Facade>,
    /// Share of the light on the stack, all bounces together.
    pub share: f64,
    /// Beams that the layer makes of it.
    beams: Vec<Beam>,
}

/// Parallel light after all bounces between layers.
#[derive(Default)]
pub(super) struct Passage {
    /// Beams that leave the stack.
    pub leaving: Vec<Beam>,
    /// Light that arrived at the layers.
    pub arrivals: Vec<Arrival>,
    /// Beams that were not followed any further, with their places.
    pub left: Vec<(Place, Beam)>,
}

/// Returns the through direction for light from the other side: rotated by 180° about the normal.
pub(super) fn half_turn(name: Dir<Facade>) -> Dir<Facade> {
    let v = name.vector();
    Dir::from_unit(DVec3::new(-v.x, -v.y, v.z))
}

/// Follows light of a through direction from a side through the layers, outside first; layers may use a direction at
/// most `within` \[rad\] from the one asked for.
pub(super) fn follow(layers: &[Box<dyn OpticalModel>], name: Dir<Facade>, side: Side, within: f64) -> Passage {
    let n = layers.len();
    let enough = ENOUGH[usize::from(within > 0.0)];
    let mut passage = Passage::default();
    let mut known: BTreeMap<(usize, bool, [i64; 2]), usize> = BTreeMap::new();
    let start = if side == Side::Front { (0, true) } else { (n, false) };
    let mut light: Vec<(Place, Beam)> = vec![(start, Beam::through(name, 1.0))];
    // By gap, outwards and inwards.
    let mut next: Vec<Vec<Beam>> = vec![Vec::new(); 2 * (n + 1)];
    while !light.is_empty() {
        for ((gap, inwards), beam) in light.drain(..) {
            let from = if inwards { Side::Front } else { Side::Back };
            let named = |name: Dir<Facade>| if from == side { name } else { half_turn(name) };
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
                    passage.arrivals.push(Arrival { layer, side: from, name: asked, share: 0.0, beams });
                    known.insert(key, count);
                    count
                };
                let arrival = &mut passage.arrivals[number];
                arrival.share += piece.share;
                for made in &arrival.beams {
                    let kept = made.names.iter().all(|to| (to.vector() - arrival.name.vector()).length() < SAME);
                    let names = if kept { piece.names } else { made.names.map(named) };
                    let (to, inwards) = match (made.transmitted, inwards) {
                        (true, true) => (gap + 1, true),
                        (true, false) => (gap - 1, false),
                        (false, _) => (gap, !inwards),
                    };
                    next[2 * to + usize::from(inwards)].push(Beam {
                        names,
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
