//! An aperture whose points see the outside differently, in parts: each with its own outside and what the system makes
//! of it.
//!
//! The outside is asked for at 3 × 3 points of a part (Gauss's), light is a parabola between them. The part whose light is
//! known least is halved across what is bent most until what parabolas leave over is small against the error asked for;
//! where light hardly changes over the whole aperture, as before things that are far, nothing is split. What goes straight
//! through needs no parts: every sensor looks for itself.

use super::{ORDINARY_TARGET, Session};
use crate::compute::estimate::Estimate;
use crate::compute::lid::{Emission, Facing};
use crate::compute::polygon::projected_solid_angle;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::direct::Sensor;
use crate::study::scene::Scene;
use rayon::prelude::*;

/// From and to along both sides of the aperture, shares of them.
pub(super) type Part = [[f64; 2]; 2];

/// The whole aperture.
pub(super) const WHOLE: Part = [[0.0, 1.0], [0.0, 1.0]];

/// Gauss's points of −1 … 1 besides 0 ...
const POINT: f64 = 0.774_596_669_241_483_4;
/// ... and the weights of all three.
const WEIGHTS: [f64; 3] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];
/// Most parts, where the system's answer costs little ...
const MOST_PARTS: usize = 100;
/// ... and where it has to be interpolated anew for every point.
const MOST_DEAR_PARTS: usize = 5;
/// What parabolas over parts may leave, of the error asked for.
const SHARE: f64 = 0.01;
/// Light that changes less than this over the aperture is the same all over.
const SAME: f64 = 4e-3;
/// What the light at the points may be off beyond its own error, relative: references differ by up to 4e-4.
const AT_POINTS: f64 = 4e-4;
/// Tiles of a part are so small that light changes by no more than this from one to the next ...
const STEP: f64 = 0.015;
/// ... but a part has no more than so many along a side.
const MOST_TILES: f64 = 12.0;

/// The outside as it is from one point, and what the system makes of it; frame and dirt counted.
struct Node {
    emission: Emission,
    fluxes: Vec<f64>,
    /// With what goes straight through. \[lm/m²\]
    exitance: Estimate,
}

/// One part.
pub(super) struct Leaf {
    pub part: Part,
    /// Row by row.
    nodes: Vec<Node>,
    /// Relative change of its light from border to border along both sides.
    pub change: [f64; 2],
    /// What of it is bent: how far the parabola's middle lies beside the straight line, relative.
    bend: [f64; 2],
}

fn middle([low, high]: [f64; 2]) -> f64 {
    0.5 * (low + high)
}

fn area(part: Part) -> f64 {
    (part[0][1] - part[0][0]) * (part[1][1] - part[1][0])
}

/// Weights of the three points at a place of −1 … 1.
fn parabola(x: f64) -> [f64; 3] {
    let t = x / POINT;
    [0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0)]
}

impl Leaf {
    fn new(part: Part, nodes: Vec<Node>) -> Self {
        let count = nodes.first().map_or(0, |node| node.fluxes.len());
        let sum: f64 = nodes.iter().flat_map(|node| &node.fluxes).sum::<f64>() / 3.0;
        // Along a side, three lines of three points each: values in that order.
        let along = |axis: usize, of: &dyn Fn([f64; 3]) -> f64| -> f64 {
            let at = |line: usize, k: usize| if axis == 0 { 3 * line + k } else { 3 * k + line };
            let lines = (0..3).map(|line| {
                (0..count).map(|cell| of([0, 1, 2].map(|k| nodes[at(line, k)].fluxes[cell])).abs()).sum::<f64>()
            });
            if sum > 0.0 { lines.sum::<f64>() / sum } else { 0.0 }
        };
        let change = [0, 1].map(|axis| along(axis, &|[a, _, c]| (c - a) / POINT));
        let bend = [0, 1].map(|axis| along(axis, &|[a, b, c]| 0.5 * (a - 2.0 * b + c) / (POINT * POINT)));
        Self { part, nodes, change, bend }
    }

    fn flux(&self) -> f64 {
        let mean = |(k, node): (usize, &Node)| WEIGHTS[k % 3] * WEIGHTS[k / 3] * node.fluxes.iter().sum::<f64>();
        self.nodes.iter().enumerate().map(mean).sum::<f64>() * area(self.part)
    }

    /// What a parabola leaves over along both sides, relative: the next term of a series whose terms fall as those of an
    /// exponential function do, and half as much again.
    fn rest(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.bend[axis] * (0.5 * self.change[axis] + self.bend[axis]) / 2.0)
    }

    /// The same as flux.
    fn left_over(&self) -> f64 {
        self.rest().iter().sum::<f64>() * self.flux()
    }

    /// The light at a place, −1 … 1 along both sides.
    fn at(&self, x: f64, y: f64) -> Emission {
        let (a, b) = (parabola(x), parabola(y));
        let parts: Vec<(f64, &Emission)> =
            self.nodes.iter().enumerate().map(|(k, node)| (a[k % 3] * b[k / 3], &node.emission)).collect();
        Emission::mixed(&parts)
    }

    /// Its light that is the same in all directions.
    pub fn smooth(&self, aperture: &Aperture) -> Smooth {
        let values = std::array::from_fn(|k| self.nodes[k].emission.uniform.value);
        let relative = |node: &Node| node.emission.uniform.error / node.emission.uniform.value.max(f64::MIN_POSITIVE);
        let error = self.nodes.iter().map(relative).sum::<f64>() / 9.0 + self.rest().iter().sum::<f64>() + AT_POINTS;
        Smooth { part: part_of(aperture, self.part), values, change: self.change, error }
    }

    /// Its tiles: light as it is in their middles.
    pub fn tiles(&self) -> Vec<(Part, Emission)> {
        let count = self.change.map(|change| (change / STEP).ceil().clamp(1.0, MOST_TILES));
        self.cut(count, self.change.iter().zip(count).map(|(change, count)| change / count / 8.0).sum())
    }

    /// Its light that is not the same in all directions, in tiles for one sensor; nothing where there is none.
    pub fn tiles_for(&self, aperture: &Aperture, sensor: &Sensor) -> Vec<(Part, Emission)> {
        if self.any().cells.is_empty() && self.any().bands.is_empty() {
            return Vec::new();
        }
        let part = part_of(aperture, self.part);
        let (count, left) = TILES_OF_CELLS.of(self.change, part.size, part.distance(sensor.position));
        let mut tiles = self.cut(count, left);
        tiles.iter_mut().for_each(|(_, light)| light.uniform = Estimate::default());
        tiles
    }

    /// So many tiles along both sides, whose steps may cost `steps` at a sensor, relative.
    fn cut(&self, count: [f64; 2], steps: f64) -> Vec<(Part, Emission)> {
        let [columns, rows] = count.map(|count| count as usize);
        let place = |axis: usize, at: usize| {
            let [low, high] = self.part[axis];
            let step = (high - low) / count[axis];
            [low + at as f64 * step, low + (at + 1) as f64 * step]
        };
        let local = |axis: usize, at: usize| (2 * at + 1) as f64 / count[axis] - 1.0;
        let tile = |(i, k): (usize, usize)| {
            let mut light = self.at(local(0, i), local(1, k));
            self.doubt(&mut light, steps);
            ([place(0, i), place(1, k)], light)
        };
        (0..columns).flat_map(|i| (0..rows).map(move |k| (i, k))).map(tile).collect()
    }

    /// What parabolas and the steps from tile to tile may be off at a sensor that sees little else than one part, near the
    /// glass.
    fn doubt(&self, light: &mut Emission, steps: f64) {
        let relative = self.rest().iter().sum::<f64>() + steps + AT_POINTS;
        light.uniform.error += relative * light.uniform.value;
        light.cells.iter_mut().for_each(|cells| cells.relative_error += relative);
        for bands in &mut light.bands {
            bands.light.error += relative * bands.light.share();
        }
    }

    /// Mean of everything that leaves the part, per area; and of what falls on it.
    pub fn means(&self) -> (Estimate, Estimate) {
        let weight = |k: usize| WEIGHTS[k % 3] * WEIGHTS[k / 3];
        let mean = |of: &dyn Fn(&Node) -> Estimate| {
            self.nodes.iter().enumerate().map(|(k, node)| of(node) * weight(k)).sum::<Estimate>()
        };
        (mean(&|node| node.exitance), mean(&|node| node.emission.incident_diffuse))
    }

    /// The system's regular transmittance, which the parts have in common.
    pub fn any(&self) -> &Emission {
        &self.nodes[0].emission
    }
}

/// Light of a part that is the same in all directions, as a parabola over it.
pub(super) struct Smooth {
    part: Aperture,
    /// Luminance at the points, row by row. \[cd/m²\]
    values: [f64; 9],
    /// Relative change from border to border along both sides.
    change: [f64; 2],
    /// Relative error of the parabola.
    error: f64,
}

/// How finely light that changes over a part is cut for a sensor: the finer the nearer it is. Where a tile looks the same
/// from end to end its change does not count; of the rest, a part of tile over distance is left.
struct Cut {
    /// What of it: more of light on cells, of which a sensor sees this one here and that one beside it.
    part: f64,
    /// A tile that is larger from there does not cost more: for cells, a cell's width. \[rad\]
    near: f64,
    /// What it may cost, relative ...
    allowed: f64,
    /// ... if no more tiles than so many along a side are needed for it.
    most: f64,
}

const TILES_OF_UNIFORM: Cut = Cut { part: 1.0 / 6.0, near: 3.0, allowed: 5e-4, most: 40.0 };
const TILES_OF_CELLS: Cut = Cut { part: 1.25, near: 0.2, allowed: 1.5e-3, most: 8.0 };

impl Cut {
    /// Tiles along both sides, and what their steps still cost.
    fn of(&self, change: [f64; 2], size: [f64; 2], distance: f64) -> ([f64; 2], f64) {
        let cost = |axis: usize, count: f64| {
            let tile = size[axis] / count / distance.max(1e-6);
            self.part * change[axis] / count * tile.min(self.near)
        };
        let count = [0, 1].map(|axis| (cost(axis, 1.0) / self.allowed).sqrt().ceil().clamp(1.0, self.most));
        (count, cost(0, count[0]) + cost(1, count[1]))
    }
}

impl Smooth {
    /// Is there any?
    pub fn is_lit(&self) -> bool {
        self.values.iter().any(|value| *value > 0.0)
    }

    /// Illuminance at a sensor. \[lx\]
    pub fn at(&self, sensor: &Sensor) -> Estimate {
        let distance = self.part.distance(sensor.position);
        let (count, steps) = TILES_OF_UNIFORM.of(self.change, self.part.size, distance);
        let corners = self.part.corners().map(|corner| corner - sensor.position);
        let (u, v) = (corners[1] - corners[0], corners[3] - corners[0]);
        let mut sum = 0.0;
        for k in 0..count[1] as usize {
            let [low, high] = [k, k + 1].map(|k| k as f64 / count[1]);
            let across = parabola(low + high - 1.0);
            for i in 0..count[0] as usize {
                let [left, right] = [i, i + 1].map(|i| i as f64 / count[0]);
                let along = parabola(left + right - 1.0);
                let luminance: f64 = (0..9).map(|k| along[k % 3] * across[k / 3] * self.values[k]).sum();
                let tile = [(left, low), (right, low), (right, high), (left, high)];
                let tile = tile.map(|(x, y)| corners[0] + u * x + v * y);
                sum += luminance.max(0.0) * projected_solid_angle(&tile, sensor.normal);
            }
        }
        Estimate::new(sum, sum * (self.error + steps))
    }
}

/// A part of an aperture as an aperture of its own.
pub(super) fn part_of(aperture: &Aperture, part: Part) -> Aperture {
    let [u, v] = [glam::DVec3::X, glam::DVec3::Y].map(|axis| aperture.surface.room_from_facade(axis));
    let [w, h] = aperture.size;
    Aperture {
        surface: aperture.surface,
        corner: aperture.corner + u * (w * part[0][0]) + v * (h * part[1][0]),
        size: [w * (part[0][1] - part[0][0]), h * (part[1][1] - part[1][0])],
    }
}

/// Share of `part` that lies in `other`.
pub(super) fn overlap(part: Part, other: Part) -> f64 {
    let side = |axis: usize| (part[axis][1].min(other[axis][1]) - part[axis][0].max(other[axis][0])).max(0.0);
    side(0) * side(1) / area(part)
}

impl Session {
    /// Sky and ground at one point of an aperture.
    fn node(&self, scene: &Scene, index: usize, at: [f64; 2]) -> Node {
        let one = &scene.apertures[index];
        let point = part_of(&one.aperture, [[at[0], 1.0], [at[1], 1.0]]).corner;
        let outside = scene.outside.seen_from(scene.orientation.to_world(point));
        let facing = Facing { outside: &outside, sun: None, ..scene.facing(index) };
        let emission = self.emission_under(scene, index, &facing);
        Node { fluxes: emission.fluxes(), exitance: emission.exitance(&facing), emission }
    }

    fn leaf(&self, scene: &Scene, index: usize, part: Part) -> Leaf {
        let place = |axis: usize, at: usize| {
            let [low, high] = part[axis];
            middle(part[axis]) + 0.5 * (high - low) * POINT * (at as f64 - 1.0)
        };
        let places: Vec<[f64; 2]> = (0..9).map(|k| [place(0, k % 3), place(1, k / 3)]).collect();
        Leaf::new(part, places.par_iter().map(|at| self.node(scene, index, *at)).collect())
    }

    /// The parts of an aperture.
    pub(super) fn leaves(&self, scene: &Scene, index: usize) -> Vec<Leaf> {
        let mut leaves = vec![self.leaf(scene, index, WHOLE)];
        let dear = leaves[0]
            .any()
            .cells
            .iter()
            .any(|light| light.basis.len() > crate::compute::room::first_bounce::MOST_CELLS);
        let most = if dear { MOST_DEAR_PARTS } else { MOST_PARTS };
        let target = SHARE * scene.error_target.unwrap_or(ORDINARY_TARGET);
        loop {
            let (flux, left): (f64, f64) =
                leaves.iter().fold((0.0, 0.0), |(flux, left), leaf| (flux + leaf.flux(), left + leaf.left_over()));
            if leaves.len() >= most || left <= target * flux {
                return leaves;
            }
            // A sensor near the glass sees little of it: small parts count for more than their light.
            let weight = |leaf: &Leaf| leaf.left_over() / area(leaf.part).sqrt();
            let worst = (0..leaves.len()).max_by(|a, b| weight(&leaves[*a]).total_cmp(&weight(&leaves[*b])));
            let Some(worst) = worst else { return leaves };
            let leaf = leaves.swap_remove(worst);
            let rest = leaf.rest();
            let axis = usize::from(rest[1] > rest[0]);
            let cut = middle(leaf.part[axis]);
            for half in [[leaf.part[axis][0], cut], [cut, leaf.part[axis][1]]] {
                let mut part = leaf.part;
                part[axis] = half;
                leaves.push(self.leaf(scene, index, part));
            }
        }
    }

    /// Is the light the same all over the aperture?
    pub(super) fn same_all_over(leaves: &[Leaf]) -> bool {
        leaves.len() == 1 && leaves[0].change.iter().chain(&leaves[0].bend).all(|change| *change <= SAME)
    }
}
