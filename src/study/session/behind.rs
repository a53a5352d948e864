//! Apertures behind boxes and skylines: the light of their parts, straight to the sensors and on the room's surfaces.

use super::seen::in_blocks;
use super::split::{Leaf, Part, Smooth, WHOLE, overlap, part_of};
use super::{DIRECT, LidResult, Session, cubature};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::{BeamLight, Emission, Facing};
use crate::compute::polygon::projected_solid_angle;
use crate::compute::quadrature::Tolerance;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::band_weights::BandWeights;
use crate::compute::room::beams_past::{beams_past, lit};
use crate::compute::room::direct::{self, DirectLight, Reception, Sensor};
use crate::compute::room::first_bounce::{FirstLight, PatchWeights};
use crate::compute::room::mesh::Mesh;
use crate::compute::room::near_field::NearField;
use crate::compute::room::outline::Outline;
use crate::compute::room::through;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// The light of one aperture, part by part.
pub(super) struct Split {
    /// Means over the aperture, everything counted but what is seen straight through in its place.
    pub whole: Emission,
    /// All that leaves it into the room, per area. \[lm/m²\]
    pub exitance: Estimate,
    /// Of sky and ground straight through: the transmittance, and its flux per area. \[lm/m²\]
    regular: Option<(AngularTransmittance, Estimate)>,
    /// Scattered light that is the same in all directions, of sky and ground.
    smooth: Vec<Smooth>,
    /// Parts of which other light of sky and ground comes.
    leaves: Vec<Leaf>,
    /// The sun's scattered light: parts of the aperture, from the whole of it downwards.
    sun: Option<(SunTile, Emission)>,
    /// The same for what the patches of the room can tell apart.
    quarters: Vec<(Aperture, Emission)>,
    /// The sun's beams per area that it reaches.
    beams: Vec<BeamLight>,
    /// What of the aperture the sun reaches, and its share.
    lit: Vec<Vec<DVec3>>,
    lit_share: f64,
    /// Luminance that the sun gives it there, the same in all directions. \[cd/m²\]
    glow: Estimate,
    /// What was split and why.
    pub words: Vec<String>,
}

/// A part of an aperture, what the sun reaches of it, and its halves where that is neither all nor nothing.
struct SunTile {
    part: Aperture,
    lit: f64,
    halves: Vec<SunTile>,
}

/// Tiles of scattered sunlight that lie in light and shade are so small a share of a side ...
const SUN_TILE: f64 = 1.0 / 32.0;
/// ... or of their distance from a sensor.
const SUN_TILE_AWAY: f64 = 0.1;
/// The room's patches see an aperture in so many parts along each side.
const QUARTERS: usize = 2;
/// What is seen straight past edges may be off by so much beyond the cubature's own error, relative.
const PAST_EDGES: f64 = 1e-4;
/// What a patch gets of what is seen straight through, relative: it is scaled to the flux that enters.
const AT_PATCHES: f64 = 1e-2;

impl Session {
    /// The light of an aperture behind boxes or a skyline.
    pub(super) fn split(&self, scene: &Scene, index: usize) -> Split {
        let one = &scene.apertures[index];
        let leaves = self.leaves(scene, index);
        let same = Self::same_all_over(&leaves);
        let tiles: Vec<(Part, Emission)> = if same {
            leaves.iter().flat_map(Leaf::tiles).map(|(_, light)| (WHOLE, light)).collect()
        } else {
            leaves.iter().flat_map(Leaf::tiles).collect()
        };
        let weight = |part: Part| (part[0][1] - part[0][0]) * (part[1][1] - part[1][0]);
        let means = leaves.iter().map(|leaf| (weight(leaf.part), leaf.means()));
        let (diffuse, incident) = means
            .fold((Estimate::default(), Estimate::default()), |(all, incident), (w, own)| {
                (all + own.0 * w, incident + own.1 * w)
            });
        // The sun alone: whatever stands outside, it is the same wherever it reaches.
        let dark = scene.outside.scaled(0.0);
        let facing = Facing { outside: &dark, ..scene.facing(index) };
        let sun = self.emission_under(scene, index, &facing);
        let around = scene.outside.surroundings();
        let (pieces, share) = around.map_or((Vec::new(), 0.0), |around| lit(&one.aperture, &facing, around));
        let share = if sun.incident_sun > 0.0 { share } else { 0.0 };
        let mut split = Split {
            whole: Emission::dark(),
            exitance: Estimate::default(),
            regular: leaves[0].any().regular.clone().map(|tau| (tau, Estimate::default())),
            quarters: quarters(&one.aperture, &tiles, same),
            smooth: leaves.iter().map(|leaf| leaf.smooth(&one.aperture)).filter(Smooth::is_lit).collect(),
            sun: None,
            leaves: Vec::new(),
            beams: sun.beams.clone(),
            glow: sun.uniform,
            lit: if share > 0.0 { pieces } else { Vec::new() },
            lit_share: share,
            words: words(index, &leaves, same, &sun, share),
        };
        split.add_sun_tiles(&one.aperture, &sun, scene, index);
        // What all of it comes to.
        let parts: Vec<(f64, &Emission)> = tiles.iter().map(|(part, light)| (weight(*part), light)).collect();
        let mut whole = Emission::mixed(&parts);
        let scattered = whole.scattered_exitance();
        let through = Estimate::new((diffuse.value - scattered.value).max(0.0), diffuse.error);
        if let Some((tau, flux)) = &mut split.regular {
            *flux = through;
            whole.regular = Some(tau.clone());
        }
        let sunlight = Emission { beams: Vec::new(), ..sun.clone() }.scaled(share);
        whole.uniform += sunlight.uniform;
        whole.cells.extend(sunlight.cells);
        whole.bands.extend(sunlight.bands);
        whole.beams = sun.beams.iter().map(|beam| BeamLight { exitance: share * beam.exitance, ..*beam }).collect();
        whole.incident_diffuse = incident;
        whole.incident_sun = share * sun.incident_sun;
        whole.beam_source = sun.beam_source;
        whole.notes = leaves[0].any().notes.iter().chain(&sun.notes).cloned().collect();
        let beams: f64 = whole.beams.iter().map(|beam| beam.exitance).sum();
        split.exitance = whole.scattered_exitance() + Estimate::exact(beams);
        if split.regular.is_some() {
            split.exitance += through;
        }
        split.whole = whole;
        split.leaves = leaves;
        split
    }

    /// All apertures of a scene where something stands outside; else none.
    pub(super) fn splits(&self, scene: &Scene) -> Result<Vec<Split>, StudyError> {
        if scene.outside.surroundings().is_none() {
            return Ok(Vec::new());
        }
        if scene.near_field != NearField::SolidAngle {
            return Err(StudyError::key(
                "compute.near_field",
                "with boxes or a skyline by bearing only the solid-angle method is there; leave the key out",
            ));
        }
        Ok((0..scene.apertures.len()).map(|index| self.split(scene, index)).collect())
    }

    /// Straight to the sensors.
    pub(super) fn direct_behind(
        &self,
        scene: &Scene,
        splits: &[Split],
        progress: &dyn Progress,
    ) -> Result<Vec<DirectLight>, StudyError> {
        // What lies between edges is judged by few points: more of them than an open sky needs.
        let relative = 0.3 * cubature(scene.error_target);
        let tolerance = Tolerance { absolute: 1e-7 * scene.outside.diffuse_horizontal(), relative, max_pieces: 4000 };
        in_blocks(scene, DIRECT, progress, |_, sensor| {
            let mut sum = DirectLight::default();
            for (index, split) in splits.iter().enumerate() {
                sum += split.at(sensor, &scene.apertures[index].aperture, &scene.facing(index), tolerance);
            }
            Ok(sum)
        })
    }
}

impl SunTile {
    fn of(part: Part, aperture: &Aperture, share: &dyn Fn(Part) -> f64) -> Self {
        let lit = share(part);
        let [w, h] = part.map(|[low, high]| high - low);
        let mut halves = Vec::new();
        if lit > 1e-9 && lit < 1.0 - 1e-9 && w.max(h) > SUN_TILE {
            let axis = usize::from(h * aperture.size[1] > w * aperture.size[0]);
            let cut = 0.5 * (part[axis][0] + part[axis][1]);
            for half in [[part[axis][0], cut], [cut, part[axis][1]]] {
                let mut part = part;
                part[axis] = half;
                halves.push(Self::of(part, aperture, share));
            }
        }
        Self { part: part_of(aperture, part), lit, halves }
    }

    /// Tiles that are small enough for an eye, with what the sun reaches of them.
    fn visit(&self, eye: DVec3, tell: &mut dyn FnMut(&Aperture, f64)) {
        let small = self.part.size[0].max(self.part.size[1]) <= SUN_TILE_AWAY * self.part.distance(eye);
        if self.halves.is_empty() || small {
            if self.lit > 1e-9 {
                tell(&self.part, self.lit);
            }
        } else {
            self.halves.iter().for_each(|half| half.visit(eye, tell));
        }
    }
}

/// Means over the quarters of an aperture.
fn quarters(aperture: &Aperture, tiles: &[(Part, Emission)], same: bool) -> Vec<(Aperture, Emission)> {
    let count = if same { 1 } else { QUARTERS };
    let limits = |at: usize| [at as f64 / count as f64, (at + 1) as f64 / count as f64];
    let quarter = |k: usize| {
        let part = [limits(k % count), limits(k / count)];
        let shares = tiles.iter().map(|(tile, light)| (overlap(part, *tile), light));
        (part_of(aperture, part), Emission::mixed(&shares.filter(|(share, _)| *share > 0.0).collect::<Vec<_>>()))
    };
    (0..count * count).map(quarter).collect()
}

/// What the plan says.
fn words(index: usize, leaves: &[Leaf], same: bool, sun: &Emission, share: f64) -> Vec<String> {
    let number = index + 1;
    let any = leaves[0].any();
    let scatters = leaves.iter().any(|leaf| leaf.any().fluxes().iter().any(|flux| *flux > 0.0));
    let change = |leaf: &Leaf| leaf.change[0].max(leaf.change[1]);
    let most = leaves.iter().map(change).fold(0.0, f64::max);
    let mut words = Vec::new();
    if any.regular.is_some() {
        words.push(format!("aperture {number}: every sensor looks straight through and past what stands outside"));
    }
    if scatters && same {
        words.push(format!(
            "aperture {number}: not split, its points see the outside alike (light changes by {:.1} %)",
            100.0 * most
        ));
    } else if scatters {
        let parts = if leaves.len() == 1 { "one part".to_owned() } else { format!("{} parts", leaves.len()) };
        words.push(format!(
            "aperture {number}: split into {parts}, each with its own outside; over a part light still changes, smoothly, \
             by up to {:.0} %",
            100.0 * most
        ));
    }
    if sun.incident_sun > 0.0 {
        words.push(match share {
            share if share >= 1.0 - 1e-9 => format!("aperture {number}: the sun reaches all of it"),
            share if share <= 1e-9 => format!("aperture {number}: wholly in the shade of what stands outside"),
            share => format!(
                "aperture {number}: the sun reaches {:.0} % of it, cut along the edges of the shadows",
                100.0 * share
            ),
        });
    }
    words
}

impl Split {
    /// Scattered sunlight on tiles that lie in light, and on small ones across the shadows' edges.
    fn add_sun_tiles(&mut self, aperture: &Aperture, sun: &Emission, scene: &Scene, index: usize) {
        if self.lit_share <= 0.0 || (sun.cells.is_empty() && sun.bands.is_empty()) {
            return;
        }
        let scattered = Emission { uniform: Estimate::default(), beams: Vec::new(), regular: None, ..sun.clone() };
        let share = |part: Part| {
            let own = part_of(aperture, part);
            scene.outside.surroundings().map_or(0.0, |around| lit(&own, &scene.facing(index), around).1)
        };
        self.sun = Some((SunTile::of(WHOLE, aperture, &share), scattered.clone()));
        let count = if self.lit_share >= 1.0 - 1e-9 { 1 } else { QUARTERS };
        let limits = |at: usize| [at as f64 / count as f64, (at + 1) as f64 / count as f64];
        for k in 0..count * count {
            let part = [limits(k % count), limits(k / count)];
            let lit = share(part);
            if lit > 0.0 {
                self.quarters.push((part_of(aperture, part), scattered.clone().scaled(lit)));
            }
        }
    }

    /// As one luminaire: the mean of the parts; sky and ground seen straight through as from the aperture's middle.
    pub fn lid(&self, scene: &Scene, index: usize) -> LidResult {
        let aperture = &scene.apertures[index].aperture;
        let middle = 0.5 * (aperture.corners()[0] + aperture.corners()[2]);
        let outside = scene.outside.seen_from(scene.orientation.to_world(middle));
        let facing = Facing { outside: &outside, ..scene.facing(index) };
        LidResult {
            lid: self.whole.lid(&facing, aperture.size),
            flux: self.exitance * aperture.area(),
            incident: (self.whole.incident_diffuse, self.whole.incident_sun),
        }
    }

    /// What one sensor gets straight.
    fn at(&self, sensor: &Sensor, aperture: &Aperture, facing: &Facing<'_>, tolerance: Tolerance) -> DirectLight {
        let mut sum = DirectLight::default();
        let Some(around) = facing.outside.surroundings() else { return sum };
        let Some(view) = aperture.view(sensor.position, sensor.normal) else { return sum };
        let mut add = |tile: &Aperture, emission: &Emission| {
            let Some(view) = tile.view(sensor.position, sensor.normal) else { return };
            let mut receptions: Vec<Reception> =
                emission.cells.iter().map(|light| Reception::new(sensor, tile, Some(&light.basis))).collect();
            if receptions.is_empty() {
                receptions.push(Reception::new(sensor, tile, None));
            }
            let own: Vec<&Reception> = receptions.iter().collect();
            let bands =
                emission.bands.first().map(|bands| BandWeights::new(&view, bands.light.upright, bands.light.q.len()));
            sum += direct::illuminance(sensor, tile, &own, bands.as_ref(), emission, facing, tolerance);
        };
        for (tile, light) in self.leaves.iter().flat_map(|leaf| leaf.tiles_for(aperture, sensor)) {
            add(&part_of(aperture, tile), &light);
        }
        if let Some((tile, light)) = &self.sun {
            tile.visit(sensor.position, &mut |part, lit| add(part, &light.clone().scaled(lit)));
        }
        for part in &self.smooth {
            sum += DirectLight { all: part.at(sensor), ..DirectLight::default() };
        }
        for piece in &self.lit {
            if self.glow.value > 0.0 {
                let corners: Vec<DVec3> = piece.iter().map(|corner| *corner - sensor.position).collect();
                let all = self.glow * projected_solid_angle(&corners, sensor.normal);
                sum += DirectLight { all, ..DirectLight::default() };
            }
        }
        if let Some((tau, _)) = &self.regular {
            let outside = facing.outside.seen_from(facing.orientation.to_world(sensor.position));
            let mut all = through::illuminance(&view, &Facing { outside: &outside, ..*facing }, tau, tolerance);
            all.error += PAST_EDGES * all.value;
            sum += DirectLight { all, ..DirectLight::default() };
        }
        sum += beams_past(sensor, aperture, &self.lit, &self.beams, facing, around);
        sum
    }

    /// On the surfaces of the room. `weights`: what the patches receive from a part by the cells of a basis.
    pub fn add_to(
        &self,
        first: &mut FirstLight,
        mesh: &Mesh,
        aperture: &Aperture,
        facing: &Facing<'_>,
        weights: &dyn Fn(&Aperture, &Arc<RingBasis>) -> Arc<PatchWeights>,
    ) {
        let wall = mesh.walls.iter().position(|wall| {
            // The wall that the aperture lies in: both look into the room from the same plane.
            let inward = -aperture.surface.room_from_facade(DVec3::Z);
            wall.normal.dot(inward) > 0.5
        });
        let Some(wall) = wall else { return };
        let flat = |corners: &[DVec3]| -> Vec<DVec2> {
            let along = mesh.walls[wall].along;
            corners.iter().map(|corner| DVec2::new(corner[along[0]], corner[along[1]])).collect()
        };
        let mut outlines = Vec::new();
        for (quarter, emission) in &self.quarters {
            if emission.uniform.value > 0.0 {
                let exitance = PI * emission.uniform.value;
                outlines.push(Outline { wall, corners: flat(&quarter.corners()), exitance });
            }
            first.add_cells(emission, &|basis| weights(quarter, basis));
        }
        if self.glow.value > 0.0 {
            let exitance = PI * self.glow.value;
            outlines.extend(self.lit.iter().map(|piece| Outline { wall, corners: flat(piece), exitance }));
        }
        if !outlines.is_empty() {
            first.add_outlines(mesh, &outlines);
        }
        if let Some((tau, flux)) = &self.regular {
            let tolerance = Tolerance { absolute: 1e-4 * flux.value, ..Tolerance::relative(AT_PATCHES) };
            let at = |sensor: &Sensor| {
                let Some(view) = aperture.view(sensor.position, sensor.normal) else { return 0.0 };
                let outside = facing.outside.seen_from(facing.orientation.to_world(sensor.position));
                through::illuminance(&view, &Facing { outside: &outside, ..*facing }, tau, tolerance).value
            };
            first.add_seen(mesh, aperture, flux.value * aperture.area(), at);
        }
        self.beams.iter().for_each(|beam| first.add_beam_through(aperture, &self.lit, beam, facing));
    }
}
