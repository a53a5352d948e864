//! Optical model of slats: means over cells, and light of one exact direction.
//!
//! For one direction the direct share is a closed form, flat mirrors reflect parallel beams and curved ones reflect
//! fans; matt faces scatter the light on them by the same balance as over cells, each direction of the section with its
//! own luminance. Solutions that serve all directions are cached.

use super::array::{SlatArray, Surface};
use super::balance::Balance;
use super::direct::Direct;
use super::flows::{Lobe, Transport, index};
use super::measure::PARTS_BY_DIRECTION;
use super::outline::SlatSection;
use super::profile::SlatProfile;
use super::profile_weights::{ProfileGrid, ProfileWeights};
use super::transport::{Node, beam};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::dot::dot;
use crate::compute::estimate::{Cancelled, Progress, Silent};
use crate::compute::sequence::recurrence;
use crate::compute::system::measure::kept::{Kept, Once};
use crate::compute::system::measure::{
    Beam, Measured, OpticalModel, ProfileLight, ScatteredLight, Setting, Side, Structure,
};
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::{FRAC_1_PI, PI};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// Optical model of an array of slats, with cached solutions of its section.
pub struct SlatModel {
    array: SlatArray,
    direct: Direct,
    /// Finely divided section for the beams of curved mirrors; `section` is the one for scattered light, and for the
    /// beams of flat mirrors.
    mirrors: OnceLock<SlatSection>,
    section: OnceLock<SlatSection>,
    solved: Once<Solved>,
    known: Mutex<HashMap<Place, Arc<Vec<MirrorBeam>>>>,
}

/// Key of a cached result: side, number of the profile angle in a lattice of equal steps, and the step as bits.
type Place = (Side, i64, u64);

/// Beam or fan reflected by mirrors, by the profile angles of its two ends \[rad\].
struct MirrorBeam {
    psi: [f64; 2],
    share: f64,
    transmitted: bool,
}

/// Solved section: what single directions need of the transport of light, and the interreflection between faces.
struct Solved {
    /// See [`Transport::incident`].
    incident: [Vec<Vec<f64>>; 2],
    balance: Balance,
}

/// Number of parts of a curved slat, each of which reflects a separate fan. Chosen; held by
/// `tests/scenes/sharp_sun.rs::real_geometry`, which compares curved mirrors with rays through the section.
const FANS: usize = 128;
/// Step of the profile angle at which the light scattered by matt faces is computed. \[rad\] Chosen: cost; linear
/// between steps, to (0.5°)²/8 ≈ 1e-5 of the second derivative.
const STEP: f64 = 0.5 * PI / 180.0;
/// Maximum number of cached lists of reflected beams: those of both sides at steps of 0.1°. Chosen: memory only.
const MAX_KNOWN: usize = 3600;
/// Seed of the rays' random steps, constant so that the same light always gives the same beams.
const SEED: u64 = 1;
/// Difference of profile angles below which two beams count as one. \[rad\] Above all rounding of f64, and 0.0002″.
const SAME: f64 = 1e-9;
/// Number of directions along the slats over which a ray of a rough mirror is spread. Chosen: cost; its light is kept,
/// only the distribution over cells depends on it, and no test of this module compares that.
const ALONG: usize = 24;

impl SlatModel {
    /// Creates the optical model of an array of slats.
    pub fn new(array: SlatArray) -> Self {
        let direct = Direct::without_knots(&array);
        Self {
            array,
            direct,
            mirrors: OnceLock::new(),
            section: OnceLock::new(),
            solved: Once::default(),
            known: Mutex::default(),
        }
    }

    /// Returns the section for beams, in which curved slats are finely divided: a fan is uniform only between the rays
    /// at the ends of one part.
    fn mirrors(&self) -> &SlatSection {
        if matches!(self.array.profile(), SlatProfile::Arc { .. }) {
            self.mirrors.get_or_init(|| SlatSection::new(&self.array, FANS))
        } else {
            self.section()
        }
    }

    fn section(&self) -> &SlatSection {
        self.section.get_or_init(|| SlatSection::new(&self.array, PARTS_BY_DIRECTION))
    }

    fn solved(&self) -> &Solved {
        self.solved.get(|| {
            let grid = ProfileGrid::new(STEP);
            let hat: Vec<f64> = (0..grid.len()).map(|node| grid.hat(node)).collect();
            let transport = match Transport::new(self.section(), grid, SEED, &Silent) {
                Ok(transport) => transport,
                Err(Cancelled) => unreachable!("nobody can cancel it"),
            };
            let balance = Balance::new(self.section(), &transport, &hat);
            Solved { incident: transport.incident, balance }
        })
    }

    /// Locks the cached lists of beams, which are complete even if another thread has failed while it held the lock.
    fn known(&self) -> MutexGuard<'_, HashMap<Place, Arc<Vec<MirrorBeam>>>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn has(&self, share: fn(Surface) -> f64) -> bool {
        // The edge of a solid slat is matt.
        let edge = (self.array.thickness() > 0.0).then(|| self.array.edge());
        [self.array.upper(), self.array.lower()].into_iter().chain(edge).any(|side| share(side) > 0.0)
    }
}

/// Returns the weights of the nodes of the profile angle for each cell of a basis, cached for all systems of slats.
fn weights(cells: &RingBasis) -> Arc<ProfileWeights> {
    static KEPT: Kept<ProfileWeights> = Kept::new();
    KEPT.get(cells, || ProfileWeights::new(cells, ProfileGrid::new(STEP)))
}

/// Returns the direction cosine x along the slats and the profile angle \[rad\] of a direction.
fn section_angles(direction: Dir<Facade>) -> (f64, f64) {
    let v = direction.vector();
    (v.x, v.y.atan2(v.z))
}

/// Returns the direction with the direction cosine `x` along the slats and the profile angle `psi`. \[rad\]
fn direction_of(x: f64, psi: f64) -> Dir<Facade> {
    let across = (1.0 - x * x).max(0.0).sqrt();
    Dir::from_unit(DVec3::new(x, across * psi.sin(), across * psi.cos()))
}

impl OpticalModel for SlatModel {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        self.array.measure(setting, progress)
    }

    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        self.beams_by(direction, |psi| Arc::new(self.mirror_beams(psi, side)))
    }

    /// Returns the beams for a direction near `direction`: those of mirrors are computed at profile angles in steps of
    /// 2 `within` and cached.
    fn beams_about(&self, direction: Dir<Facade>, side: Side, within: f64) -> Vec<Beam> {
        self.beams_by(direction, |psi| {
            let place = (psi / (2.0 * within)).round();
            let key = (side, place as i64, within.to_bits());
            if let Some(beams) = self.known().get(&key) {
                return Arc::clone(beams);
            }
            let beams = Arc::new(self.mirror_beams(place * 2.0 * within, side));
            let mut known = self.known();
            if known.len() >= MAX_KNOWN {
                known.clear();
            }
            known.insert(key, Arc::clone(&beams));
            beams
        })
    }

    fn structure(&self) -> Structure {
        Structure::Along { upright: false }
    }

    fn by_profile_alone(&self) -> Option<bool> {
        (!self.has(|surface| surface.mirror * surface.spread)).then_some(false)
    }

    fn straight(&self, direction: Dir<Facade>, _: Side) -> f64 {
        self.direct.share(section_angles(direction).1)
    }

    /// Returns the light that matt faces transmit scattered, by profile angle; `None` without matt faces or with rough
    /// mirrors, which spread light along the slats.
    fn profile_light(&self, direction: Dir<Facade>, side: Side) -> Option<ProfileLight> {
        let (_, psi) = section_angles(direction);
        // Rough mirrors spread along the slats, too.
        if psi.cos() <= 0.0
            || !self.has(|surface| surface.diffuse)
            || self.has(|surface| surface.mirror * surface.spread)
        {
            return None;
        }
        let node = beam(self.section(), psi, side, SEED);
        let sent = self.sent(&node, psi, side);
        Some(ProfileLight {
            upright: false,
            q: self.luminance(&self.solved().incident[1 - index(side)], &sent),
            error: self.uncertainty(&node, psi, side),
        })
    }

    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        self.scattered_light(direction, side, emergent, true)
    }

    fn scattered_through(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        self.scattered_light(direction, side, emergent, false)
    }

    fn bytes(&self) -> usize {
        let beams = self.known().values().map(|beams| size_of_val(&beams[..])).sum::<usize>();
        let rows = |solved: &Solved| solved.incident.iter().flatten().map(|row| size_of_val(&row[..])).sum::<usize>();
        beams + self.solved.bytes(|solved| rows(solved) + solved.balance.bytes())
    }
}

impl SlatModel {
    /// Computes the light that matt faces and rough mirrors scatter, on emergent cells; `back`: the reflected light,
    /// too, not only the transmitted.
    fn scattered_light(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis, back: bool) -> ScatteredLight {
        let (x, psi) = section_angles(direction);
        let rough = self.has(|surface| surface.mirror * surface.spread);
        let matt = self.has(|surface| surface.diffuse);
        if psi.cos() <= 0.0 || !(matt || rough) {
            return ScatteredLight::default();
        }
        let node = beam(self.section(), psi, side, SEED);
        let mut light = if matt { self.matt(&node, psi, side, emergent, back) } else { ScatteredLight::default() };
        if rough {
            let mirrored = &node.mirrored[index(side)];
            add_rough(&mut light.transmitted, &mirrored.through, [x, psi], emergent);
            if back {
                add_rough(&mut light.reflected, &mirrored.back, [x, psi], emergent);
            }
        }
        light
    }

    /// Returns the beams and fans that ideal mirrors reflect out of the slats, for parallel light of profile angle
    /// `psi` \[rad\] from `side`; equal ones are merged.
    fn mirror_beams(&self, psi: f64, side: Side) -> Vec<MirrorBeam> {
        let node = beam(self.mirrors(), psi, side, SEED);
        let mirrored = &node.mirrored[index(side)];
        let mut all: Vec<MirrorBeam> = Vec::new();
        for (lobes, transmitted) in [(&mirrored.through, true), (&mirrored.back, false)] {
            let from = all.len();
            for lobe in lobes.iter().filter(|lobe| lobe.variance <= 0.0) {
                let share = lobe.width / psi.cos();
                let alike = |other: &&mut MirrorBeam| other.psi.iter().zip(lobe.psi).all(|(a, b)| (a - b).abs() < SAME);
                match all[from..].iter_mut().find(alike) {
                    Some(known) => known.share += share,
                    None => all.push(MirrorBeam { psi: lobe.psi, share, transmitted }),
                }
            }
        }
        all
    }

    /// Returns the direct beam and the beams reflected by mirrors for the direction `direction`; `mirror_beams`
    /// supplies the latter for its profile angle.
    fn beams_by(&self, direction: Dir<Facade>, mirror_beams: impl FnOnce(f64) -> Arc<Vec<MirrorBeam>>) -> Vec<Beam> {
        let (x, psi) = section_angles(direction);
        let mut beams = Vec::new();
        let open = self.direct.share(psi);
        if open > 0.0 {
            beams.push(Beam::through(direction, open));
        }
        if psi.cos() <= 0.0 || !self.has(|surface| surface.mirror) {
            return beams;
        }
        let named = |one: &MirrorBeam| Beam {
            directions: one.psi.map(|psi| direction_of(x, psi)),
            share: one.share,
            transmitted: one.transmitted,
        };
        beams.extend(mirror_beams(psi).iter().map(named));
        beams
    }

    /// Returns the luminance of each face per illuminance of the façade's plane by parallel light of profile angle
    /// `psi` \[rad\] from `side`, M g / (π cosψ) with M of [`super::balance`]. \[1/sr\]
    fn sent(&self, node: &Node, psi: f64, side: Side) -> Vec<f64> {
        let incident = &node.incident[index(side)];
        let response = &self.solved().balance.response;
        let scale = FRAC_1_PI / psi.cos();
        let mut sent = vec![0.0; incident.len()];
        for (j, incident) in incident.iter().enumerate().filter(|(_, incident)| **incident != 0.0) {
            // Columns lie in one piece.
            sent.iter_mut().zip(response.col(j).iter()).for_each(|(sum, value)| *sum += scale * incident * value);
        }
        sent
    }

    /// Returns the error of the share of the light that leaves the slats by diffuse reflection, to either side.
    fn uncertainty(&self, node: &Node, psi: f64, side: Side) -> f64 {
        let incident = &node.incident[index(side)];
        let one =
            |uncertainty: &[f64]| incident.iter().zip(uncertainty).map(|(g, d)| g * d).sum::<f64>().abs() / psi.cos();
        let [inside, outside] = &self.solved().balance.uncertainty;
        one(inside).max(one(outside))
    }

    /// Returns q of the scattered light at each node of the profile angle \[1/sr\]: the faces' luminances `sent`,
    /// weighted by the width in which each is seen from there, `incident`.
    fn luminance(&self, incident: &[Vec<f64>], sent: &[f64]) -> Vec<f64> {
        let at = |(node, row): (usize, &Vec<f64>)| {
            // Along the slats the pitch is seen foreshortened; at ±90° nothing of it is seen.
            let cosine = ProfileGrid::new(STEP).psi(node).cos();
            let width = dot(row, sent);
            // The extrapolation to endless strips may fall below 0 where nothing arrives.
            if cosine > 1e-9 { (width / cosine).max(0.0) } else { 0.0 }
        };
        incident.iter().enumerate().map(at).collect()
    }

    /// Computes the light that matt faces scatter, on emergent cells; `back`: the reflected light, too.
    fn matt(&self, node: &Node, psi: f64, side: Side, emergent: &RingBasis, back: bool) -> ScatteredLight {
        let sent = self.sent(node, psi, side);
        let weights = weights(emergent);
        let by_cell = |rows: &[Vec<f64>], turned: bool| -> Vec<f64> {
            let mut widths: Vec<f64> = rows.iter().map(|row| dot(row, &sent)).collect();
            if turned {
                widths.reverse();
            }
            let of = |(cell, solid): (usize, f64)| {
                let (first, row) = weights.cell(cell);
                let sum: f64 = row.iter().zip(&widths[first..]).map(|(w, l)| w * l).sum();
                (sum / solid).max(0.0)
            };
            emergent.projected_solid_angles().into_iter().enumerate().map(of).collect()
        };
        let incident = &self.solved().incident;
        ScatteredLight {
            transmitted: by_cell(&incident[1 - index(side)], false),
            reflected: if back { by_cell(&incident[index(side)], true) } else { vec![] },
            error: self.uncertainty(node, psi, side),
        }
    }
}

/// Adds the light reflected by rough mirrors to `q` by emergent cell \[1/sr\]. The profile angles of `lobes` contain
/// the random spread already; the spread of x along the slats is drawn here (see the parent module's head).
fn add_rough(q: &mut Vec<f64>, lobes: &[Lobe], [x, psi]: [f64; 2], emergent: &RingBasis) {
    let rough = || lobes.iter().filter(|lobe| lobe.variance > 0.0);
    if rough().next().is_none() {
        return;
    }
    q.resize(emergent.len(), 0.0);
    let solid = emergent.projected_solid_angles();
    for (number, lobe) in rough().enumerate() {
        let spread = lobe.variance.sqrt();
        for k in 0..ALONG {
            let at = (number * ALONG + k) as f64;
            let [r, s, t] = [2.0_f64, 3.0, 5.0].map(|prime| recurrence(0.5, at, prime.sqrt()));
            // One component of a normal step; the other two enter by its length's square.
            let normal = |r: f64, s: f64| (-2.0 * (1.0 - r).ln()).sqrt() * (2.0 * PI * s).cos();
            let step = spread * normal(r, s);
            let rest = spread * (-2.0 * (1.0 - t).ln()).sqrt();
            let (length, across) = (step.hypot(rest), (1.0 - x * x).max(0.0).sqrt());
            let sine = if length > 0.0 { length.sin() * step / length } else { 0.0 };
            let moved = (x * length.cos() + across * sine).clamp(-1.0, 1.0);
            if let Some(cell) = emergent.index(direction_of(moved, lobe.psi[0])) {
                q[cell] += lobe.width / (psi.cos() * ALONG as f64 * solid[cell]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chord of the slats of the tests, those of an exterior blind of 80 mm with a pitch of 72 mm. \[m\]
    const WIDTH: f64 = 0.08;

    fn array(rise: f64, tilt: f64, faces: [Surface; 2]) -> SlatArray {
        SlatArray::new(SlatProfile::curved(WIDTH, rise), 0.0, 0.072, tilt, faces).unwrap()
    }

    /// Transmitted and thrown back, of one direction, beams and all.
    fn shares(model: &SlatModel, direction: Dir<Facade>, side: Side, cells: &RingBasis) -> [f64; 2] {
        let mut sums = [0.0; 2];
        model.beams(direction, side).iter().for_each(|beam| sums[usize::from(!beam.transmitted)] += beam.share);
        let light = model.scattered(direction, side, cells);
        let solid = cells.projected_solid_angles();
        for (sum, q) in sums.iter_mut().zip([&light.transmitted, &light.reflected]) {
            *sum += q.iter().zip(&solid).map(|(q, w)| q * w).sum::<f64>();
        }
        sums
    }

    #[test]
    fn whoever_asks_for_what_is_transmitted_gets_all_of_it() {
        let rough = Surface { diffuse: 0.1, mirror: 0.7, spread: 0.08 };
        let cells = RingBasis::even(3_f64.to_radians());
        for faces in [[Surface::matt(0.7); 2], [Surface::mirror(0.8), Surface::matt(0.3)], [rough, Surface::matt(0.3)]]
        {
            let model = SlatModel::new(array(0.006, 0.3, faces));
            for (side, theta) in Side::BOTH.into_iter().zip([0.4, 1.1]) {
                let direction = Dir::from_theta_phi(theta, 1.9);
                let (all, through) =
                    (model.scattered(direction, side, &cells), model.scattered_through(direction, side, &cells));
                assert!(all.transmitted.iter().any(|q| *q > 0.0) && all.reflected.iter().any(|q| *q > 0.0));
                assert!(all.transmitted == through.transmitted && through.reflected.is_empty());
            }
        }
    }

    /// What is left out where light comes from one side alone is what the other side's light does.
    #[test]
    fn light_from_one_side_meets_what_it_meets_beside_all_light() {
        let model = SlatModel::new(array(0.006, 0.2, [Surface::mirror(0.8), Surface::matt(0.3)]));
        let section = model.section();
        let landed = |psi: f64, side: Side| beam(section, psi, side, SEED).incident[index(side)].clone();
        let grid = ProfileGrid::new(STEP);
        let all = &model.solved().incident;
        for node in (5..grid.len() - 5).step_by(17) {
            for side in Side::BOTH {
                let own = landed(grid.psi(node), side);
                let apart = own.iter().zip(&all[index(side)][node]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-12, "{node} {side:?}: {apart}");
            }
        }
    }

    #[test]
    fn single_directions_keep_the_balance_of_profile_angles() {
        let matt = [Surface::matt(0.7), Surface::matt(0.4)];
        let mirror = [Surface::mirror(0.85), Surface::matt(0.2)];
        let rough = [Surface { diffuse: 0.1, mirror: 0.7, spread: 0.08 }, Surface::matt(0.3)];
        let cells = RingBasis::even(3_f64.to_radians());
        for (rise, tilt, faces, bound) in [
            (0.0, 0.0, matt, 2e-3),
            (0.006, 0.5, matt, 2e-3),
            (0.0, 0.3, mirror, 2e-3),
            (0.008, -0.2, mirror, 4e-3),
            (0.0, 0.2, rough, 0.02),
        ] {
            let array = array(rise, tilt, faces);
            let model = SlatModel::new(array.clone());
            for side in Side::BOTH {
                let psi = [-0.6, 0.1, 0.45, 0.9];
                let known = array.profile_shares(side, &psi, 1, &Silent).unwrap();
                for (psi, known) in psi.into_iter().zip(known) {
                    for x in [0.0, 0.6] {
                        let found = shares(&model, direction_of(x, psi), side, &cells);
                        let apart = (found[0] - known.transmitted).abs().max((found[1] - known.reflected).abs());
                        assert!(apart < bound, "{rise} {tilt} {side:?} {psi} {x}: {found:?} {known:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn light_by_profile_angle_is_the_light_on_cells() {
        let model = SlatModel::new(array(0.0, 0.3, [Surface::matt(0.7); 2]));
        let cells = RingBasis::even(3_f64.to_radians());
        let direction = direction_of(0.3, 0.6);
        let (on, by) =
            (model.scattered(direction, Side::Front, &cells), model.profile_light(direction, Side::Front).unwrap());
        let largest = on.transmitted.iter().copied().fold(0.0, f64::max);
        for (cell, (a, b)) in on.transmitted.iter().zip(by.on(&cells)).enumerate() {
            assert!((a - b).abs() < 0.02 * largest, "{cell}: {a} {b}");
        }
    }

    #[test]
    fn a_flat_mirror_throws_one_beam_as_far_as_the_next_slat_lets_it() {
        // Level mirrors turn ψ into −ψ.
        let model = SlatModel::new(array(0.0, 0.0, [Surface::mirror(1.0), Surface::matt(0.0)]));
        let psi = 60_f64.to_radians();
        let beams = model.beams(direction_of(0.2, psi), Side::Front);
        let turned: Vec<&Beam> = beams.iter().filter(|beam| beam.transmitted).collect();
        assert_eq!(turned.len(), 1, "{beams:?}");
        assert!(turned[0].directions[0].vector().distance(direction_of(0.2, -psi).vector()) < 1e-9);
        // A slat is lit from its outer edge over s/tanψ. What it mirrors rises to the slat above within another s/tanψ,
        // and leaves where that is beyond its width.
        let reach = 0.072 / psi.tan();
        let leaves = (reach - (WIDTH - reach)).clamp(0.0, reach) / reach;
        assert!((turned[0].share - leaves).abs() < 2e-3, "{} {leaves}", turned[0].share);
    }

    #[test]
    fn cached_beams_are_counted_once_for_neighbouring_directions() {
        let model = SlatModel::new(array(0.0, 0.0, [Surface::mirror(1.0), Surface::matt(0.0)]));
        let mut due = 0;
        for (degrees, is_new) in [(60.0_f64, true), (60.01, false), (50.0, true)] {
            let mirrored = model.beams_about(direction_of(0.2, degrees.to_radians()), Side::Front, 1e-3).len();
            due += if is_new { mirrored * size_of::<MirrorBeam>() } else { 0 };
            assert!(model.bytes() == due && due > 0, "{degrees}");
        }
    }
}
