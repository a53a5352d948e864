//! Beams to and fro between the layers of a stack, followed one by one.
//!
//! All names are those of light from the side that is asked about. A layer that is met from the other side knows the same
//! light by the name turned by 180°.

use crate::compute::direction::{Dir, Facade};
use crate::compute::system::measure::fan::{middle, pieces};
use crate::compute::system::measure::merged::{SAME, merged};
use crate::compute::system::measure::{Beam, Side, Specimen};
use glam::DVec3;
use std::collections::BTreeMap;

/// Light still on its way at which following ends, in all.
const ENOUGH: f64 = 1e-7;
/// Width of the parts in which a fan meets a layer. \[rad\]
const PIECE: f64 = 0.25 * std::f64::consts::PI / 180.0;
/// Layers asked, each for another direction: up to the first number every beam is followed, up to the second those of at
/// least [`WEAK`]. Panes and cut panels need a handful; prisms make ever more directions of ever less light.
const ASKED: [usize; 2] = [200, 600];
/// See [`ASKED`].
const WEAK: f64 = 1e-5;

/// Light in a gap: number of the gap (0 is outside) and whether it travels inwards.
pub(super) type Place = (usize, bool);

/// Light of one direction at a layer.
pub(super) struct Arrival {
    pub layer: usize,
    /// The side it comes from.
    pub side: Side,
    /// As the layer names it.
    pub name: Dir<Facade>,
    /// Of the light on the stack, all passages together.
    pub share: f64,
    /// What the layer makes of it.
    beams: Vec<Beam>,
}

/// What becomes of parallel light between layers.
#[derive(Default)]
pub(super) struct Passage {
    /// Beams that leave the stack.
    pub leaving: Vec<Beam>,
    /// What reached the layers.
    pub arrivals: Vec<Arrival>,
    /// Beams that were not followed any more, with their places.
    pub left: Vec<(Place, Beam)>,
}

/// The same light for the other side's names: turned by 180° about the normal.
pub(super) fn half_turn(name: Dir<Facade>) -> Dir<Facade> {
    let v = name.vector();
    Dir::from_unit(DVec3::new(-v.x, -v.y, v.z))
}

/// Follows light of a name from a side through the layers, outside first.
pub(super) fn follow(layers: &[Box<dyn Specimen>], name: Dir<Facade>, side: Side) -> Passage {
    let n = layers.len();
    let mut passage = Passage::default();
    let mut known: BTreeMap<(usize, bool, [i64; 2]), usize> = BTreeMap::new();
    let start = if side == Side::Front { (0, true) } else { (n, false) };
    let mut light: Vec<(Place, Beam)> = vec![(start, Beam::through(name, 1.0))];
    while !light.is_empty() {
        let mut next: BTreeMap<Place, Vec<Beam>> = BTreeMap::new();
        for ((gap, inwards), beam) in light {
            let from = if inwards { Side::Front } else { Side::Back };
            let named = |name: Dir<Facade>| if from == side { name } else { half_turn(name) };
            let layer = if inwards { gap } else { gap - 1 };
            for piece in pieces(&beam, PIECE) {
                let asked = named(middle(&piece));
                let v = asked.vector();
                let key = (layer, inwards, [v.x, v.y].map(|cosine| (cosine / SAME).round() as i64));
                let number = if let Some(&number) = known.get(&key) {
                    number
                } else {
                    let count = passage.arrivals.len();
                    if count >= ASKED[1] || (count >= ASKED[0] && piece.share < WEAK) {
                        passage.left.push(((gap, inwards), piece));
                        continue;
                    }
                    let beams = layers[layer].beams(asked, from);
                    passage.arrivals.push(Arrival { layer, side: from, name: asked, share: 0.0, beams });
                    known.insert(key, count);
                    count
                };
                let arrival = &mut passage.arrivals[number];
                arrival.share += piece.share;
                for made in &arrival.beams {
                    let kept = made.names.iter().all(|to| (to.vector() - arrival.name.vector()).length() < SAME);
                    let names = if kept { piece.names } else { made.names.map(named) };
                    let place = match (made.transmitted, inwards) {
                        (true, true) => (gap + 1, true),
                        (true, false) => (gap - 1, false),
                        (false, _) => (gap, !inwards),
                    };
                    next.entry(place).or_default().push(Beam {
                        names,
                        share: piece.share * made.share,
                        transmitted: true,
                    });
                }
            }
        }
        light = Vec::new();
        for (place, beams) in next {
            let whole = merged(beams).into_iter().filter(|beam| beam.share > 0.0);
            match place {
                (0, false) => {
                    passage.leaving.extend(whole.map(|beam| Beam { transmitted: side == Side::Back, ..beam }));
                }
                (gap, true) if gap == n => {
                    passage.leaving.extend(whole.map(|beam| Beam { transmitted: side == Side::Front, ..beam }));
                }
                _ => light.extend(whole.map(|beam| (place, beam))),
            }
        }
        if light.iter().map(|(_, beam)| beam.share).sum::<f64>() < ENOUGH {
            break;
        }
        // The strongest are asked for first, while there is room for them.
        light.sort_by(|a, b| b.1.share.total_cmp(&a.1.share));
    }
    passage.leaving = merged(passage.leaving);
    passage
}
