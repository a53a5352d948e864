//! Division of an aperture whose points see the outside differently into parts, each with its own outside and its own
//! light.
//!
//! The outside is evaluated at 3 × 3 points (Gauss's) of a part, and its light is taken as a parabola between them; two
//! more points near opposite corners test this. An aperture is first cut along its creases, where planes of near faces
//! meet it (see [`super::creases`]). Then the part with the largest remaining error is halved across the side with the
//! largest curvature, until the error of the parabolas is small against the error target; where light hardly changes
//! over the whole aperture, as with distant obstructions only, nothing is divided. Regular transmission is evaluated
//! for every sensor separately; its flux is the sum over the parts.

use super::creases::{creases, cut_along};
use super::part::{Part, WHOLE, area, halves, middle, part_of};
use super::{Session, check};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::lid::{CellLight, Emission, Facing};
use crate::compute::polygon::projected_solid_angle;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::beams_past::outer_face;
use crate::compute::room::direct::Sensor;
use crate::study::scene::Scene;
use crate::study::scene_file::ORDINARY_TARGET;
use glam::DVec3;
use rayon::prelude::*;

/// Position of the outer points of Gauss's rule with three points on −1 … 1; the third is at 0.
const POINT: f64 = 0.774_596_669_241_483_4;
/// Weights of the three points of Gauss's rule; their sum is 1.
const WEIGHTS: [f64; 3] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];
/// Positions of the two test points of a part, −1 … 1 along both sides; near corners, because steep changes lie along
/// borders.
const TRIED: [[f64; 2]; 2] = [[-0.9, -0.9], [0.9, 0.9]];
/// Share of the deviation at the test points that counts as error, because between the nodes it is smaller and of both
/// signs.
const TRIED_SHARE: f64 = 0.2;
/// Weights of the nine nodes of a part; their sum is 1.
const NODES: [f64; 9] = {
    let mut all = [0.0; 9];
    let mut k = 0;
    while k < 9 {
        all[k] = WEIGHTS[k % 3] * WEIGHTS[k / 3];
        k += 1;
    }
    all
};
/// Relative change of the luminous exitance over a piece of an aperture up to which the patches of the room take it as
/// uniform.
const EVEN: f64 = 0.15;
/// Maximum number of parts of an aperture if evaluating the system costs little.
const MOST_PARTS: usize = 100;
/// Maximum number of parts of an aperture if the system's response has to be interpolated again for every point.
const MOST_DEAR_PARTS: usize = 4;
/// Maximum number of parts of an aperture if its system does not scatter.
const MOST_STRAIGHT_PARTS: usize = 20;
/// Share of the error target that the parabolas over the parts may use.
const SHARE: f64 = 0.05;
/// Relative change of the emitted flux per area over the aperture up to which its light is taken as uniform.
const SAME: f64 = 4e-3;
/// Relative error of the light at the points in addition to its stated one; references differ by up to 4e-4.
const AT_POINTS: f64 = 2e-4;
/// Maximum relative change of the light from one tile of a part to the next.
const STEP: f64 = 0.015;
/// Maximum number of tiles of a part along one side.
const MOST_TILES: f64 = 12.0;

/// Outside as seen from one point of an aperture, and the light that the system emits there, reduced by frame and dirt.
struct Node {
    emission: Emission,
    /// Luminous fluxes per area: of scattered light by emergent direction, then of regular transmission. \[lm/m²\]
    fluxes: Vec<f64>,
    /// Luminous exitance on the room side at the point. \[lm/m²\]
    exitance: Estimate,
    /// Position of the point in the world frame. \[m\]
    eye: DVec3,
}

/// Part of an aperture with the light at its nodes, between which it is a parabola.
pub(super) struct Leaf {
    pub part: Part,
    /// Light at the nine nodes, row by row.
    nodes: Vec<Node>,
    /// Relative change of the emitted flux per area from border to border, summed over directions, along both sides of
    /// the part.
    pub change: [f64; 2],
    /// Relative curvature of the emitted flux per area along both sides: distance of the parabola's middle from the
    /// straight line.
    bend: [f64; 2],
    /// Mean deviation of the parabola at the test points: of the exitance \[lm/m²\], and of the luminance that is the
    /// same in all directions \[cd/m²\].
    off: [f64; 2],
}

/// Returns the weights of the three points of Gauss's rule for a parabola at the position `x`, −1 … 1.
fn parabola(x: f64) -> [f64; 3] {
    let t = x / POINT;
    [0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0)]
}

impl Leaf {
    /// Creates a part from the light at its points: the nine nodes of Gauss's rule, then the test points.
    fn new(part: Part, mut nodes: Vec<Node>) -> Self {
        // Where no light enters, as under a box on the glass, the light has no emergent directions.
        let count = nodes.iter().map(|node| node.fluxes.len()).max().unwrap_or(0);
        nodes.iter_mut().for_each(|node| node.fluxes.resize(count, 0.0));
        let tried = nodes.split_off(9);
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
        let mut leaf = Self { part, nodes, change, bend, off: [0.0; 2] };
        for (place, found) in TRIED.into_iter().zip(&tried) {
            let weights = leaf.weights(place[0], place[1]);
            let mean =
                |of: &dyn Fn(&Node) -> f64| leaf.nodes.iter().zip(weights).map(|(node, w)| w * of(node)).sum::<f64>();
            let off = |cell: usize| (found.fluxes[cell] - mean(&|node| node.fluxes[cell])).abs();
            let all = (0..count).map(off).sum::<f64>();
            let uniform = (found.emission.uniform.value - mean(&|node| node.emission.uniform.value)).abs();
            let share = 1.0 / TRIED.len() as f64;
            leaf.off = [leaf.off[0] + share * all, leaf.off[1] + share * uniform];
        }
        leaf
    }

    /// Returns the weights of the nine nodes at a position, −1 … 1 along both sides.
    fn weights(&self, x: f64, y: f64) -> [f64; 9] {
        let (a, b) = (parabola(x), parabola(y));
        std::array::from_fn(|k| a[k % 3] * b[k / 3])
    }

    fn flux(&self) -> f64 {
        let own = self.nodes.iter().zip(NODES).map(|(node, weight)| weight * node.fluxes.iter().sum::<f64>());
        own.sum::<f64>() * area(self.part)
    }

    /// Returns the relative rise and fall of the light along both sides: by the straight line, and by the curvature on
    /// it. The light of a symmetric part does not change from border to border, and yet is not uniform.
    fn uneven(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.change[axis] + 2.0 * self.bend[axis])
    }

    /// Returns the relative error of the parabola along both sides: the next term of a series whose terms fall like
    /// those of an exponential function, and half as much again.
    fn rest(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.bend[axis] * (0.5 * self.change[axis] + self.bend[axis]) / 2.0)
    }

    /// Returns the error of the parabola, and the error found at the test points, both as flux per area of the
    /// aperture. \[lm/m²\]
    fn left_over(&self) -> [f64; 2] {
        let flux = self.flux();
        // Errors of the points themselves, three times as large where the parabola extends beyond them.
        let off = (self.off[0] * area(self.part) - 3.0 * AT_POINTS * flux).max(0.0);
        [self.rest().iter().sum::<f64>() * flux, TRIED_SHARE * off]
    }

    /// Returns the sum of both errors of the parabola, relative to the flux.
    fn rough(&self) -> f64 {
        let flux = self.flux();
        if flux > 0.0 { self.left_over().iter().sum::<f64>() / flux } else { 0.0 }
    }

    /// Returns the light at a position, −1 … 1 along both sides.
    fn at(&self, x: f64, y: f64) -> Emission {
        let parts: Vec<(f64, &Emission)> =
            self.weights(x, y).into_iter().zip(self.nodes.iter().map(|node| &node.emission)).collect();
        Emission::mixed(&parts)
    }

    /// Returns the light of the part that has the same luminance in all directions.
    pub fn smooth(&self, aperture: &Aperture) -> Smooth {
        let values = std::array::from_fn(|k| self.nodes[k].emission.uniform.value);
        let own = self.nodes.iter().zip(NODES).map(|(node, weight)| weight * node.emission.uniform.error);
        Smooth {
            part: part_of(aperture, self.part),
            values,
            uneven: self.uneven(),
            relative: self.rest().iter().sum::<f64>() + AT_POINTS,
            error: own.sum::<f64>() + TRIED_SHARE * self.off[1],
        }
    }

    /// Returns the tiles into which the part is divided, each with the light at its centre.
    pub fn tiles(&self) -> Vec<(Part, Emission)> {
        let uneven = self.uneven();
        let count = uneven.map(|change| (change / STEP).ceil().clamp(1.0, MOST_TILES));
        self.cut(count, uneven.iter().zip(count).map(|(change, count)| change / count / 8.0).sum())
    }

    /// Returns the light of the part that is not the same in all directions, as tiles that are small enough for one
    /// sensor; empty if there is none.
    pub fn tiles_for(&self, aperture: &Aperture, sensor: &Sensor) -> Vec<(Part, Emission)> {
        if self.any().cells.is_empty() && self.any().bands.is_empty() {
            return Vec::new();
        }
        let part = part_of(aperture, self.part);
        let (count, left) = TILES_OF_CELLS.of(self.uneven(), part.size, part.distance(sensor.position));
        let mut tiles = self.cut(count, left);
        tiles.iter_mut().for_each(|(_, light)| light.uniform = Estimate::default());
        tiles
    }

    /// Cuts the part into `count` tiles along both sides, with the light at the centre of each. `steps`: relative error
    /// by the steps from tile to tile, which is added to the light.
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
            add_relative_error(&mut light, self.rough() + steps + AT_POINTS);
            ([place(0, i), place(1, k)], light)
        };
        (0..columns).flat_map(|i| (0..rows).map(move |k| (i, k))).map(tile).collect()
    }

    /// Returns means over the part: luminous exitance by regular transmission \[lm/m²\], and illuminance from outside
    /// \[lx\].
    pub fn means(&self) -> [Estimate; 2] {
        let mean = |of: &dyn Fn(&Node) -> Estimate| {
            self.nodes.iter().zip(NODES).map(|(node, weight)| of(node) * weight).sum::<Estimate>()
        };
        let through = mean(&|node| Estimate::new(self.through(node), node.exitance.error));
        let incident = mean(&|node| node.emission.incident_diffuse);
        let left = self.left_over().iter().sum::<f64>() / area(self.part);
        [
            Estimate::new(through.value, through.error + left),
            Estimate::new(incident.value, incident.error + self.rough() * incident.value),
        ]
    }

    /// Whether the part emits no light that is the same in all directions.
    fn is_straight(&self) -> bool {
        self.nodes.iter().all(|node| node.emission.uniform.value <= 0.0)
    }

    /// Returns the luminous exitance by regular transmission at a node. \[lm/m²\]
    fn through(&self, node: &Node) -> f64 {
        node.fluxes.last().copied().filter(|_| self.any().regular.is_some()).unwrap_or(0.0)
    }

    /// Returns points of the part (in the world frame \[m\]) from which the outside is seen by regular transmission,
    /// each with the share of the aperture that it represents: all nine nodes, or the centre for all of them.
    pub fn eyes(&self, all: bool) -> Vec<(f64, DVec3)> {
        let through = |k: usize| self.through(&self.nodes[k]);
        let mean: f64 = (0..9).map(|k| NODES[k] * through(k)).sum();
        if all || through(4) <= 0.0 {
            (0..9).map(|k| (NODES[k] * area(self.part), self.nodes[k].eye)).collect()
        } else {
            vec![(mean / through(4) * area(self.part), self.nodes[4].eye)]
        }
    }

    /// Returns pieces of the part over each of which the light is nearly uniform, at most `most` along one side.
    pub fn pieces(&self, most: f64) -> Vec<Part> {
        let count = self.uneven().map(|change| (change / EVEN).ceil().clamp(1.0, most));
        let place = |axis: usize, at: usize| -> [f64; 2] {
            let [low, high] = self.part[axis];
            [at, at + 1].map(|at| low + at as f64 * (high - low) / count[axis])
        };
        let [columns, rows] = count.map(|count| count as usize);
        (0..columns).flat_map(|i| (0..rows).map(move |k| [place(0, i), place(1, k)])).collect()
    }

    /// Returns the light at the node where it has most components (cells, bands, regular transmission); dark nodes may
    /// lack some.
    pub fn any(&self) -> &Emission {
        fullest(self.nodes.iter().map(|node| &node.emission)).unwrap_or(&self.nodes[0].emission)
    }
}

/// Returns the light of the parts where it has most components; `leaves` contains at least one part.
pub(super) fn any_of(leaves: &[Leaf]) -> &Emission {
    fullest(leaves.iter().map(Leaf::any)).unwrap_or(leaves[0].any())
}

/// Returns the first light of a list that has the largest number of components.
fn fullest<'a>(list: impl Iterator<Item = &'a Emission>) -> Option<&'a Emission> {
    let kinds = |light: &Emission| light.cells.len() + light.bands.len() + usize::from(light.regular.is_some());
    list.reduce(|best, one| if kinds(one) > kinds(best) { one } else { best })
}

/// Adds a relative error, by parabolas and by steps from tile to tile, to all components of a light.
fn add_relative_error(light: &mut Emission, relative: f64) {
    light.uniform.error += relative * light.uniform.value;
    light.cells.iter_mut().for_each(|cells| cells.relative_error += relative);
    for bands in &mut light.bands {
        bands.light.error += relative * bands.light.share();
    }
}

/// Returns the scattered light of all parts as a mean over the aperture.
pub(super) fn mean_of(leaves: &[Leaf]) -> Emission {
    let points = leaves
        .iter()
        .flat_map(|leaf| leaf.nodes.iter().zip(NODES).map(|(node, weight)| (weight * area(leaf.part), &node.emission)));
    let mut mean = Emission::mixed(&points.collect::<Vec<_>>());
    let (flux, left) = leaves
        .iter()
        .fold((0.0, 0.0), |(flux, left), leaf| (flux + leaf.flux(), left + leaf.left_over().iter().sum::<f64>()));
    add_relative_error(&mut mean, AT_POINTS + if flux > 0.0 { left / flux } else { 0.0 });
    mean
}

/// Light of a part that has the same luminance in all directions, as a parabola over the part.
pub(super) struct Smooth {
    part: Aperture,
    /// Luminance at the nine nodes, row by row. \[cd/m²\]
    values: [f64; 9],
    /// Relative rise and fall of the luminance along both sides.
    uneven: [f64; 2],
    /// Relative error of the luminance by the parabola.
    relative: f64,
    /// Error of the luminance at the nodes, in addition to that of the parabola. \[cd/m²\]
    error: f64,
}

/// Rule by which a part whose light varies is cut into tiles for a sensor, more finely the nearer it is. A variation
/// over a tile that the sensor sees under the same angle throughout does not matter; the error is a share of the rest,
/// in proportion to the ratio of tile size to distance.
struct Cut {
    /// Factor from the relative change over a tile times its size over its distance to the error; larger for light on
    /// cells, since a sensor sees one cell here and another beside it.
    part: f64,
    /// Angular size of a tile above which its error does not grow; for light on cells, the width of a cell. \[rad\]
    near: f64,
    /// Maximum relative error of the tiles at a sensor.
    allowed: f64,
    /// Maximum number of tiles along one side, which takes precedence over `allowed`.
    most: f64,
}

const TILES_OF_UNIFORM: Cut = Cut { part: 1.0 / 6.0, near: 3.0, allowed: 1e-4, most: 40.0 };
const TILES_OF_CELLS: Cut = Cut { part: 1.25, near: 0.2, allowed: 1.5e-3, most: 8.0 };

impl Cut {
    /// Returns the numbers of tiles along both sides, and the relative error that remains. `change`: relative change
    /// along both sides; `size`, `distance`: of the part. \[m\]
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
    /// Whether the part emits any light that is the same in all directions.
    pub fn is_lit(&self) -> bool {
        self.values.iter().any(|value| *value > 0.0)
    }

    /// Returns the illuminance at a sensor by this light. \[lx\]
    pub fn at(&self, sensor: &Sensor) -> Estimate {
        let distance = self.part.distance(sensor.position);
        let (count, steps) = TILES_OF_UNIFORM.of(self.uneven, self.part.size, distance);
        let corners = self.part.corners().map(|corner| corner - sensor.position);
        let (u, v) = (corners[1] - corners[0], corners[3] - corners[0]);
        let (mut sum, mut solid) = (0.0, 0.0);
        for k in 0..count[1] as usize {
            let [low, high] = [k, k + 1].map(|k| k as f64 / count[1]);
            let across = parabola(low + high - 1.0);
            for i in 0..count[0] as usize {
                let [left, right] = [i, i + 1].map(|i| i as f64 / count[0]);
                let along = parabola(left + right - 1.0);
                let luminance: f64 = (0..9).map(|k| along[k % 3] * across[k / 3] * self.values[k]).sum();
                let tile = [(left, low), (right, low), (right, high), (left, high)];
                let tile = tile.map(|(x, y)| corners[0] + u * x + v * y);
                let seen = projected_solid_angle(&tile, sensor.normal);
                sum += luminance.max(0.0) * seen;
                solid += seen;
            }
        }
        Estimate::new(sum, sum * (self.relative + steps) + solid * self.error)
    }
}

impl Session {
    /// Computes the light of sky and ground at one point of an aperture. `at`: position, 0 … 1 along both sides.
    fn node(&self, scene: &Scene, index: usize, at: [f64; 2]) -> Node {
        let one = &scene.apertures[index];
        let eye = scene.orientation.to_world(part_of(&one.aperture, [[at[0], 1.0], [at[1], 1.0]]).corner);
        let outside = scene.outside.seen_from(eye);
        let facing = Facing { outside: &outside, sun: None, ..scene.facing(index) };
        let emission = self.emission_under(scene, index, &facing);
        let exitance = emission.exitance(&facing);
        let mut fluxes = emission.fluxes();
        if emission.regular.is_some() {
            fluxes.push((exitance.value - emission.scattered_exitance().value).max(0.0));
        }
        Node { emission, fluxes, exitance, eye }
    }

    /// Computes several parts of an aperture, with the light at all their points.
    fn asked(
        &self,
        scene: &Scene,
        index: usize,
        parts: Vec<Part>,
        progress: &dyn Progress,
    ) -> Result<Vec<Leaf>, Cancelled> {
        let at = |part: Part, place: [f64; 2]| {
            [0, 1].map(|axis| middle(part[axis]) + 0.5 * (part[axis][1] - part[axis][0]) * place[axis])
        };
        let nodes = (0..9).map(|k| [k % 3, k / 3].map(|step: usize| POINT * (step as f64 - 1.0)));
        let own: Vec<[f64; 2]> = nodes.chain(TRIED).collect();
        let places: Vec<[f64; 2]> = parts.iter().flat_map(|part| own.iter().map(|place| at(*part, *place))).collect();
        let node = |place: [f64; 2]| check(progress).map(|()| self.node(scene, index, place));
        let mut nodes: Vec<Node> = places.into_par_iter().map(node).collect::<Result<_, Cancelled>>()?;
        let mut leaves = Vec::with_capacity(parts.len());
        for part in parts.into_iter().rev() {
            leaves.push(Leaf::new(part, nodes.split_off(nodes.len() - own.len())));
        }
        leaves.reverse();
        Ok(leaves)
    }

    /// Divides an aperture into parts, and computes the light of sky and ground on them.
    ///
    /// # Errors
    /// Returns an error if cancelled.
    pub(super) fn leaves(&self, scene: &Scene, index: usize, progress: &dyn Progress) -> Result<Vec<Leaf>, Cancelled> {
        let aperture = &scene.apertures[index].aperture;
        let target = SHARE * scene.error_target.unwrap_or(ORDINARY_TARGET);
        let solids = scene.outside.surroundings().map_or(&[][..], |around| &around.solids);
        let lines = creases(aperture, &outer_face(aperture, scene.orientation), solids);
        let many = |light: &CellLight| light.basis.len() > crate::compute::room::patch_weights::MOST_CELLS;
        let most_of = |any: &Emission| if any.cells.iter().any(many) { MOST_DEAR_PARTS } else { MOST_PARTS };
        let parts = if lines.is_empty() {
            vec![WHOLE]
        } else {
            cut_along(&lines, most_of(&self.node(scene, index, [0.5; 2]).emission).div_ceil(2))
        };
        let mut leaves = self.asked(scene, index, parts, progress)?;
        let any = any_of(&leaves);
        // Of regular transmission only the flux is needed: it scales what the room's patches see themselves.
        let straight = any.cells.is_empty() && any.bands.is_empty() && leaves.iter().all(Leaf::is_straight);
        let (most, target) = if straight { (MOST_STRAIGHT_PARTS, 10.0 * target) } else { (most_of(any), target) };
        loop {
            progress.advance("apertures", leaves.len(), most);
            let (flux, left): (f64, f64) = leaves.iter().fold((0.0, 0.0), |(flux, left), leaf| {
                (flux + leaf.flux(), left + leaf.left_over().iter().sum::<f64>())
            });
            if leaves.len() >= most || left <= target * flux {
                return Ok(leaves);
            }
            // A sensor near the glass sees little of it: small parts count for more than their light.
            let weight = |leaf: &Leaf| leaf.left_over().iter().sum::<f64>() / area(leaf.part).sqrt();
            let worst = (0..leaves.len()).max_by(|a, b| weight(&leaves[*a]).total_cmp(&weight(&leaves[*b])));
            let Some(worst) = worst else { return Ok(leaves) };
            let leaf = leaves.swap_remove(worst);
            let [bent, off] = leaf.left_over();
            // The test points do not show across which side to cut.
            let sides = if off > bent {
                [0, 1].map(|axis| (leaf.part[axis][1] - leaf.part[axis][0]) * aperture.size[axis])
            } else {
                leaf.rest()
            };
            let axis = usize::from(sides[1] > sides[0]);
            let halves = halves(leaf.part, axis, middle(leaf.part[axis])).to_vec();
            leaves.extend(self.asked(scene, index, halves, progress)?);
        }
    }

    /// Whether the light is uniform over the whole aperture.
    pub(super) fn same_all_over(leaves: &[Leaf]) -> bool {
        leaves.len() == 1 && leaves[0].change.iter().chain(&leaves[0].bend).all(|change| *change <= SAME)
    }
}
