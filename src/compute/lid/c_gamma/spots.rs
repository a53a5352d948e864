//! Widening of the beams in a C-γ table: a beam of the sun's width from one point would light a small spot, whereas the
//! rectangle that the beam leaves lights an area of its own outline.
//!
//! A beam of parallel light through a rectangle lights the rectangle's outline on the room's surfaces, with constant
//! illuminance on each of them. Seen from the rectangle's centre, this area covers a range of directions (*spot*),
//! whose intensities are chosen to cause that illuminance. Where the aperture ends, its edges are sharp; where another
//! tile continues, it fades across them ([`Panel`]). Nodes of C and γ lie so close together there that linear
//! interpolation between them reproduces the spot, its sharp edges blurred by an eighth of its width at most.

use super::cells::Cells;
use super::{Aim, CGammaTable, Panel, Widened};
use crate::compute::estimate::Estimate;
use crate::compute::lid::SunBeam;
use glam::DVec3;
use std::f64::consts::PI;

/// Beam with the rectangle of the aperture that it leaves: the directions from the centre to the lit area, with their
/// intensities.
pub(super) struct Spot {
    /// Direction and flux of the beam.
    pub beam: SunBeam,
    /// Rectangle that the beam leaves.
    pub panel: Panel,
}

/// Number of nodes across the narrower side of a spot, within the limits of [`STEPS`]. Chosen; held with [`EDGE`] and
/// [`ALONG`] by the test `a_beam_through_a_tile_lights_its_outline_evenly_and_nothing_beside`: within 2 % inside and
/// beside.
const ACROSS: f64 = 12.0;
/// Minimum and maximum distance of the nodes across a spot. \[°\] Chosen: size of the files; from a fifth of the sun's
/// disc of 0.53°, the narrowest spot, up to about all of it.
const STEPS: [f64; 2] = [0.1, 0.5];
/// Distance of the nodes on either side of an edge from it, as a share of the step. Chosen: the edge lies between two
/// nodes with a distance of 0.4 steps; see [`ACROSS`].
const EDGE: f64 = 0.2;
/// Maximum number of planes and of angles. Limits of readers of EULUMDAT, among them this program's
/// (`limits::LUMINAIRE_PLANES`, `LUMINAIRE_ANGLES`): half a degree all round, the plane at 360° not repeated.
pub(super) const MOST: [usize; 2] = [720, 361];
/// Number of points along a side of a spot for the search of its limits: a corner, and seven on the side, which is
/// curved in C and γ. Chosen; see [`ACROSS`].
const ALONG: usize = 8;

impl Spot {
    fn at(&self, direction: DVec3) -> f64 {
        self.panel.of_beam(&self.beam, direction)
    }

    /// Returns the limits of the spot in C (the lower below 0 where the spot lies across C0; a full turn where it
    /// contains a pole) and in γ, the smaller angular size of the two, and the largest sine of γ. \[rad\]
    fn limits(&self, aim: Aim) -> ([f64; 2], [f64; 2], f64, f64) {
        let beyond = self.panel.beyond();
        let reach = |axis: usize, at: f64| at * (0.5 * self.panel.size[axis] + beyond[axis][usize::from(at > 0.0)]);
        let (c0, gamma0) = aim.angles(self.beam.direction);
        let (mut c, mut gamma) = ([0.0_f64; 2], [gamma0; 2]);
        for k in 0..4 * ALONG {
            let (side, at) = (k / ALONG, 2.0 * (k % ALONG) as f64 / ALONG as f64 - 1.0);
            let (x, y) = [(at, -1.0), (1.0, at), (-at, 1.0), (-1.0, -at)][side];
            let (own_c, own_gamma) = aim.angles(self.panel.landing_of(&self.beam, [reach(0, x), reach(1, y)]));
            let turned = (own_c - c0 + PI).rem_euclid(2.0 * PI) - PI;
            c = [c[0].min(turned), c[1].max(turned)];
            gamma = [gamma[0].min(own_gamma), gamma[1].max(own_gamma)];
        }
        for (pole, at) in [(0.0, 0), (PI, 1)] {
            if self.at(aim.direction(0.0, pole).0.vector()) > 0.0 {
                (gamma[at], c) = (pole, [-PI, PI]);
            }
        }
        let [a, b] = gamma;
        let widest = if a <= 0.5 * PI && b >= 0.5 * PI { 1.0 } else { a.sin().max(b.sin()) };
        let narrow = ((c[1] - c[0]) * widest).min(b - a);
        ([c0 + c[0], c0 + c[1]], gamma, narrow, widest)
    }
}

/// Adds nodes at most `step` apart between two edges, and two close to each edge, one on either side, so that the edge
/// is sharp and in the right position. Inside, no node is added within half a step of an existing one. `place` maps an
/// angle to the table's range; `None` if it lies outside.
fn add_nodes(list: &mut Vec<f64>, [from, to]: [f64; 2], step: f64, place: &dyn Fn(f64) -> Option<f64>) {
    let count = ((to - from) / step).ceil().max(1.0);
    let step = (to - from) / count;
    let close = EDGE * step;
    let inside = (1..count as usize).map(|k| (from + k as f64 * step, 0.5 * step));
    let edges = [from - close, from + close, to - close, to + close].map(|node| (node, 0.1 * close));
    for (node, distance) in edges.into_iter().chain(inside) {
        let Some(node) = place(node) else { continue };
        let at = list.partition_point(|other| *other < node);
        let near = |other: Option<&f64>| other.is_some_and(|other| (other - node).abs() < distance);
        if !near(list.get(at)) && !near(at.checked_sub(1).and_then(|before| list.get(before))) {
            list.insert(at, node);
        }
    }
}

/// Adds the intensities of spots to a table of scattered light, with additional nodes.
pub(super) fn lay(table: &mut CGammaTable, spots: &[Spot]) {
    if spots.is_empty() {
        return;
    }
    let turn = 2.0 * PI;
    let all: Vec<_> = spots.iter().map(|spot| spot.limits(table.aim)).collect();
    let limits = STEPS.map(f64::to_radians);
    let mut coarser = 1.0;
    let (c, gamma, steps) = loop {
        let (mut c, mut gamma) = (table.c.clone(), table.gamma.clone());
        let mut steps = [f64::INFINITY; 2];
        for (c_range, gamma_range, narrow, widest) in &all {
            let step = (narrow / ACROSS).clamp(limits[0], limits[1]) * coarser;
            let in_turn = |angle: f64| Some(angle.rem_euclid(turn));
            add_nodes(&mut c, *c_range, step / widest.max(1e-3), &in_turn);
            add_nodes(&mut gamma, *gamma_range, step, &|angle| (0.0..=PI).contains(&angle).then_some(angle));
            steps = steps.map(|least| least.min(step));
        }
        // Stops when the table is small enough, or so coarse that no node is added.
        if (c.len() <= MOST[0] && gamma.len() <= MOST[1]) || coarser > 100.0 {
            break (c, gamma, steps);
        }
        coarser *= 1.25;
    };
    table.at_nodes(c, gamma);
    table.close();
    table.beams = vec![0.0; table.intensity.len()];
    let cells = Cells::new(table.aim, &table.c, &table.gamma);
    for (spot, (c_range, gamma_range, ..)) in spots.iter().zip(&all) {
        add(&cells, &mut table.beams, spot, *c_range, *gamma_range);
    }
    for (value, beam) in table.intensity.iter_mut().zip(&table.beams) {
        *value += beam;
    }
    let largest = |of: &dyn Fn(&Spot) -> f64| spots.iter().map(of).fold(0.0, f64::max);
    let distances = || spots.iter().map(|spot| spot.panel.distance(&spot.beam));
    table.beam_flux = spots.iter().map(|spot| spot.beam.flux).sum();
    table.flux += Estimate::exact(table.beam_flux);
    table.widened = Some(Widened {
        size: [largest(&|spot| spot.panel.size[0]), largest(&|spot| spot.panel.size[1])],
        distance: [distances().fold(f64::INFINITY, f64::min), distances().fold(0.0, f64::max)],
        step: steps,
    });
}

/// Adds the means of a spot's intensity over the cells to `values`, scaled so that a zonal sum gives exactly the flux
/// of its beam.
fn add(cells: &Cells<'_>, values: &mut [f64], spot: &Spot, c_range: [f64; 2], gamma_range: [f64; 2]) {
    let (turn, angles) = (2.0 * PI, cells.gamma.len());
    let meets = |[low, high]: [f64; 2], [from, to]: [f64; 2]| low <= to && high >= from;
    let in_gamma: Vec<usize> = (0..angles).filter(|angle| meets(cells.gamma_cell(*angle), gamma_range)).collect();
    let of_turns = |plane: &usize| {
        let [low, high] = cells.c_cell(*plane);
        (-1..=1).any(|k| meets([low + f64::from(k) * turn, high + f64::from(k) * turn], c_range))
    };
    let in_c: Vec<usize> = (0..cells.c.len()).filter(of_turns).collect();
    let mut own: Vec<(usize, f64)> = Vec::with_capacity(in_c.len() * in_gamma.len());
    for &angle in &in_gamma {
        let mean = |plane: usize| cells.mean(&|way| spot.at(way), cells.c_cell(plane), cells.gamma_cell(angle));
        if cells.gamma[angle] > 0.0 && angle + 1 < angles {
            own.extend(in_c.iter().map(|&plane| (plane * angles + angle, mean(plane))));
        } else {
            // One direction in all planes.
            let all: f64 = (0..cells.c.len()).map(|plane| cells.weights.0[plane] * mean(plane)).sum();
            own.extend((0..cells.c.len()).map(|plane| (plane * angles + angle, all / turn)));
        }
    }
    let found: f64 = own.iter().map(|(node, value)| value * cells.weight(*node)).sum();
    if found > 0.0 {
        own.iter().for_each(|(node, value)| values[*node] += spot.beam.flux / found * value);
        return;
    }
    // A spot narrower than the sampling of the cells goes to the nearest cell as a whole.
    let (c, gamma) = cells.aim.angles(spot.beam.direction);
    let inside = |[low, high]: [f64; 2], at: f64| low <= at && at <= high;
    let plane = (0..cells.c.len()).find(|plane| inside(cells.c_cell(*plane), c)).unwrap_or(0);
    let angle = (0..angles).find(|angle| inside(cells.gamma_cell(*angle), gamma)).unwrap_or(0);
    let nearest = plane * angles + angle;
    values[nearest] += spot.beam.flux / cells.weight(nearest);
}
