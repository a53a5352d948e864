//! Transport of light in the section of slats: between faces, from outside to faces and past them, from sweeps of
//! parallel lines over all profile angles.

use super::arc::Point;
use super::chain::{Exit, Landing, Ray, Sequence, Trace};
use super::flows::{Exchange, Lobe, MirroredLight, Second, Transport, index};
use super::outline::SlatSection;
use super::profile_weights::ProfileGrid;
use super::reciprocal::settle;
use super::sweep::{Bundle, Met, sweep};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::measure::Side;
use rayon::prelude::*;
use std::rc::Rc;
use std::sync::{Mutex, PoisonError};

/// Contribution of consecutive nodes of the profile angle to the transport.
struct Chunk {
    /// Exchange between faces: without mirrors, and by way of them.
    exchange: [Exchange; 2],
    /// Light that each face sends out over the profile angles, which adds up to its length. \[pitches\]
    length: Vec<f64>,
    nodes: Vec<Node>,
}

/// Transport of parallel light of one profile angle from outside and from inside.
pub(super) struct Node {
    /// Width of the light that reaches every face without mirrors, from outside and from inside. \[pitches\]
    pub(super) incident: [Vec<f64>; 2],
    /// Width of the light that reaches every face by way of mirrors, from outside and from inside. \[pitches\]
    pub(super) second: [Vec<f64>; 2],
    /// Light that mirrors reflect out of the section, from outside and from inside.
    pub(super) mirrored: [MirroredLight; 2],
}

/// Computes the transport of parallel light of profile angle `psi` \[rad\] from `side`: its width on every face, and
/// the light that mirrors reflect out of the section. The entries of the other side have no light.
pub(super) fn beam(section: &SlatSection, psi: f64, side: Side, seed: u64) -> Node {
    // The exchange between faces is not followed.
    let mut none = Chunk { exchange: [Exchange::new(0), Exchange::new(0)], length: vec![], nodes: vec![] };
    let tracer = Tracer { only: Some(side), ..Tracer::new(section, psi, 0.0) };
    let mut node = tracer.node(&mut none, Sequence::new(seed, 0));
    for (incident, second) in node.incident.iter_mut().zip(&node.second) {
        incident.iter_mut().zip(second).for_each(|(sum, x)| *sum += x);
    }
    node
}

/// Bundle of lines that reaches a face, with the face or the side that it comes from.
struct Arrival {
    /// Face that sent the bundle; `None` for parallel light from a side.
    from: Option<Met>,
    to: Met,
    direction: Point,
    side: Side,
}

/// Sums to which the light of traced rays is added.
struct Into<'a> {
    /// Exchange between faces: without mirrors, and by way of them.
    exchange: &'a mut [Exchange; 2],
    node: &'a mut Node,
}

impl Into<'_> {
    /// Adds light of a bundle that reaches a face by way of mirrors. `width` \[pitches\]; `weight`: quadrature weight
    /// of the profile angle.
    fn land(&mut self, arrival: &Arrival, face: usize, width: f64, weight: f64) {
        match arrival.from {
            Some(from) => self.exchange[1].add(from.face, face, weight * width),
            None => self.node.second[index(arrival.side)][face] += width,
        }
    }

    /// Adds the specularly reflected light of a part of a bundle, `width` \[pitches\] wide, by the traces of three rays
    /// at its lower end, middle and upper end.
    fn add(&mut self, section: &SlatSection, arrival: &Arrival, traces: [&Trace; 3], width: f64, weight: f64) {
        let [low, middle, high] = traces;
        for (k, landing) in middle.hits.iter().enumerate() {
            let amount = width * landing.weight;
            let same = |other: &Landing| other.facet == landing.facet && other.right == landing.right;
            match (low.hits.get(k), high.hits.get(k)) {
                (Some(a), Some(b)) if same(a) && same(b) => {
                    section.divide(landing, a.share, b.share, |face, part| {
                        self.land(arrival, face, amount * part, weight);
                    });
                }
                (Some(a), Some(b)) => {
                    for (landing, part) in [(a, 0.25), (landing, 0.5), (b, 0.25)] {
                        section.divide(landing, landing.share, landing.share, |face, _| {
                            self.land(arrival, face, amount * part, weight);
                        });
                    }
                }
                _ => section.divide(landing, landing.share, landing.share, |face, _| {
                    self.land(arrival, face, amount, weight);
                }),
            }
        }
        if arrival.from.is_some() {
            return;
        }
        match (low.exit, middle.exit, high.exit) {
            (Some(a), Some(b), Some(c)) => {
                self.leave(arrival, [&a, &b], 0.5 * width);
                self.leave(arrival, [&b, &c], 0.5 * width);
            }
            (_, Some(exit), _) => self.leave(arrival, [&exit; 2], width),
            _ => (),
        }
    }

    /// Adds light of a bundle, `width` \[pitches\] wide, that leaves the section between two rays.
    fn leave(&mut self, arrival: &Arrival, exits: [&Exit; 2], width: f64) {
        // Through directions: against the light from outside, along the light from inside.
        let front = arrival.side == Side::Front;
        let sign = if front { -1.0 } else { 1.0 };
        let psi = exits.map(|exit| (sign * exit.direction[1]).clamp(-1.0, 1.0).asin());
        let exit = exits[0];
        let outwards = exit.direction[0] > 0.0;
        let mirrored = &mut self.node.mirrored[index(arrival.side)];
        let list = if outwards == front { &mut mirrored.back } else { &mut mirrored.through };
        list.push(Lobe { psi, width: width * exit.weight, variance: exit.variance });
    }
}

/// Numbers of rays per pitch of parallel light, and of light from a face, where mirrors spread light. Chosen: cost; the
/// deficit of their sums is stated as error. Held by the test `a_rough_sheet_scatters_by_steps_on_spheres` of `rough`
/// and `tests/compute/goniophotometer_slats.rs::mixed_surfaces_keep_energy_and_reciprocity`.
const ROUGH: [f64; 2] = [400.0, 64.0];
/// Smallest part of a bundle that is traced separately, as a share of its width. Chosen: cost; where paths differ, a
/// 64th of a bundle at most follows its middle ray. Held by
/// `tests/compute/goniophotometer_slats.rs::level_mirrors_pass_light_after_as_many_reflections_as_unfolding_counts`.
const FINEST: f64 = 1.0 / 64.0;
/// Number of nodes per chunk whose sums are added in order: fixed, so that threads do not change the order. Chosen:
/// cost; results change in their last digits.
const CHUNK: usize = 12;

struct Tracer<'a> {
    section: &'a SlatSection,
    direction: Point,
    weight: f64,
    rough: bool,
    /// Side whose parallel light alone is traced; `None`: that of both sides, and the light of the faces.
    only: Option<Side>,
}

impl Transport {
    /// Computes the transport of a section on a grid of profile angles.
    pub(super) fn new(
        section: &SlatSection,
        grid: ProfileGrid,
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let nodes: Vec<usize> = (0..grid.len()).collect();
        let size = section.faces.len();
        let mut all = Self {
            exchange: Exchange::new(size),
            length: vec![0.0; size],
            incident: [vec![], vec![]],
            mirrored: [vec![], vec![]],
            rough: None,
        };
        let mut second = Second { exchange: Exchange::new(size), incident: [vec![], vec![]] };
        // Large matrices from the system cost more time than emptying those of the chunks before.
        let empty: Mutex<Vec<[Exchange; 2]>> = Mutex::default();
        let kept = || empty.lock().unwrap_or_else(PoisonError::into_inner);
        let chunk = |chunk: &[usize]| {
            let exchange = kept().pop();
            let exchange = exchange.unwrap_or_else(|| [Exchange::new(size), Exchange::new(size)]);
            let mut part = Chunk { exchange, length: vec![0.0; size], nodes: vec![] };
            for &node in chunk {
                let tracer = Tracer::new(section, grid.psi(node), 0.5 * grid.hat(node));
                let done = tracer.node(&mut part, Sequence::new(seed, node as u64));
                part.nodes.push(done);
            }
            part
        };
        // A few chunks for every thread at a time, added in their order: their matrices are large, and the sum is the
        // same however many threads there are.
        let together = CHUNK * 4 * rayon::current_num_threads();
        let mut added = |mut part: Chunk| {
            all.exchange.add_all(&part.exchange[0]);
            second.exchange.add_all(&part.exchange[1]);
            part.exchange.iter_mut().for_each(|exchange| exchange.values.fill(0.0));
            kept().push(part.exchange);
            all.length.iter_mut().zip(&part.length).for_each(|(sum, x)| *sum += x);
            for node in part.nodes {
                for (side, (incident, more)) in node.incident.into_iter().zip(node.second).enumerate() {
                    all.incident[side].push(incident);
                    second.incident[side].push(more);
                }
                for (side, mirrored) in node.mirrored.into_iter().enumerate() {
                    all.mirrored[side].push(mirrored);
                }
            }
        };
        for wave in nodes.chunks(together) {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            wave.par_chunks(CHUNK).map(chunk).collect::<Vec<_>>().into_iter().for_each(&mut added);
        }
        let matt = |face: usize| section.faces[face].surface.diffuse > 0.0;
        for i in 0..size {
            for j in 0..i {
                let (there, back) = (second.exchange.values[i * size + j], second.exchange.values[j * size + i]);
                // Chains of mirrors are followed from either end: their mean is what both ends agree on. They are not
                // followed from faces that send nothing.
                let mean = match (matt(i), matt(j)) {
                    (true, false) => there,
                    (false, true) => back,
                    _ => 0.5 * (there + back),
                };
                second.exchange.values[i * size + j] = mean;
                second.exchange.values[j * size + i] = mean;
            }
        }
        if section.rough() {
            all.rough = Some(settle(section, grid, &all, &mut second));
        }
        all.exchange.add_all(&second.exchange);
        for (rows, more) in all.incident.iter_mut().zip(&second.incident) {
            for (row, more) in rows.iter_mut().zip(more) {
                row.iter_mut().zip(more).for_each(|(sum, x)| *sum += x);
            }
        }
        Ok(all)
    }
}

impl<'a> Tracer<'a> {
    fn new(section: &'a SlatSection, psi: f64, weight: f64) -> Self {
        Self { section, direction: [psi.cos().max(0.0), psi.sin()], weight, rough: section.rough(), only: None }
    }

    /// Sweeps over all lines of one profile angle and returns the transport of its parallel light; the light between
    /// faces is added to `part`.
    fn node(&self, part: &mut Chunk, mut sequence: Sequence) -> Node {
        let none = || vec![0.0; self.section.faces.len()];
        let mut node = Node {
            incident: [none(), none()],
            second: [none(), none()],
            mirrored: [MirroredLight::default(), MirroredLight::default()],
        };
        sweep(self.section, self.direction, |bundle| {
            let backwards = self.direction.map(|x| -x);
            for (from, to, direction, side) in
                [(bundle.from, bundle.to, self.direction, Side::Back), (bundle.to, bundle.from, backwards, Side::Front)]
            {
                if self.only.is_some_and(|only| from.is_some() || side != only) {
                    continue;
                }
                if let Some(from) = from {
                    part.length[from.face] += self.weight * bundle.width;
                }
                let Some(to) = to else { continue };
                match from {
                    Some(from) => part.exchange[0].add(from.face, to.face, self.weight * bundle.width),
                    None => node.incident[index(side)][to.face] += bundle.width,
                }
                let arrival = Arrival { from, to, direction, side };
                let mut into = Into { exchange: &mut part.exchange, node: &mut node };
                let faces = &self.section.faces;
                let sends = from.is_none_or(|from| faces[from.face].surface.diffuse > 0.0);
                if sends && faces[to.face].surface.mirror > 0.0 {
                    self.mirror(&bundle, &arrival, &mut into, &mut sequence);
                }
            }
        });
        node
    }

    /// Traces the specularly reflected part of a bundle that has reached a face: the bundle is split until the rays at
    /// both ends of a part take the same path as the one between, which then represents it.
    fn mirror(&self, bundle: &Bundle, arrival: &Arrival, into: &mut Into<'_>, sequence: &mut Sequence) {
        let [low, high] = [-0.5, 0.5].map(|side| bundle.across + side * bundle.width);
        let trace = |share: f64, sequence: &mut Sequence| {
            let point = self.on_strip(arrival.to, low + share * (high - low));
            let met = Met { copy: 0, ..arrival.to };
            let mut trace = Trace::default();
            self.section.follow(Ray { point, direction: arrival.direction, met }, sequence, &mut trace);
            // Shared by the parts on either side of it.
            Rc::new(trace)
        };
        if self.rough {
            // As many from grazing parallel light, of which a pitch takes little, as from any other.
            let density = match arrival.from {
                Some(_) => ROUGH[1],
                None => ROUGH[0] / self.direction[0].max(0.1),
            };
            let rays = (density * bundle.width).ceil().max(1.0);
            for k in 0..rays as usize {
                let done = trace((k as f64 + 0.5) / rays, sequence);
                into.add(self.section, arrival, [&done; 3], bundle.width / rays, self.weight);
            }
            return;
        }
        // Just inside, where a neighbour bundle's edge does not decide.
        let edge = 1e-6;
        let mut open = vec![(edge, 1.0 - edge, trace(edge, sequence), trace(1.0 - edge, sequence))];
        while let Some((from, to, first, last)) = open.pop() {
            let middle = 0.5 * (from + to);
            let done = trace(middle, sequence);
            if (done.way == first.way && done.way == last.way) || to - from < FINEST {
                let width = (to - from) / (1.0 - 2.0 * edge) * bundle.width;
                let between: [&Trace; 3] =
                    if done.way == first.way && done.way == last.way { [&first, &done, &last] } else { [&done; 3] };
                into.add(self.section, arrival, between, width, self.weight);
            } else {
                open.push((middle, to, Rc::clone(&done), last));
                open.push((from, middle, first, done));
            }
        }
    }

    /// Returns the point at which the line at `across` (distance to the left of the direction, \[pitches\]) meets a
    /// strip, relative to the strip's slat.
    fn on_strip(&self, met: Met, across: f64) -> Point {
        let strip = &self.section.strips[met.strip];
        let [cos, sin] = self.direction;
        let of = |[u, v]: Point| v * cos - u * sin;
        let (a, b) = (of(strip.a), of(strip.b));
        let share = (across - f64::from(met.copy) * cos - a) / (b - a);
        // Bundles are wider than rounding, and so are the strips that they meet.
        let point = super::outline::between(strip.a, strip.b, share.clamp(0.0, 1.0));
        let Some(circle) = &self.section.facets[self.section.facet_of[met.strip]].circle else { return point };
        // The strip is a chord: the same line on the arc, or the arc's nearest point.
        let near = |x: &f64, y: &f64| x.abs().total_cmp(&y.abs());
        if let Some(distance) = circle.meets(point, self.direction).into_iter().flatten().min_by(near) {
            let on = [point[0] + distance * cos, point[1] + distance * sin];
            if (on[0] - point[0]).hypot(on[1] - point[1]) < (strip.b[0] - strip.a[0]).hypot(strip.b[1] - strip.a[1]) {
                return on;
            }
        }
        circle.at(circle.share(circle.normal(point)).clamp(0.0, 1.0))
    }
}
