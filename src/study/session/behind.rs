//! Apertures behind boxes and skylines, whose parts see different outsides: their light, and the direct light from them
//! at the sensors and on the surfaces of the room.

use super::outside_seen::OutsideSeen;
use super::part::{Part, WHOLE, area, overlap, part_of};
use super::seen::in_blocks;
use super::split::{Leaf, Smooth, any_of, mean_of};
use super::{DIRECT_STAGE, LidResult, Session, cubature};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::lid::{BeamLight, Emission, Facing};
use crate::compute::polygon::projected_solid_angle;
use crate::compute::quadrature::Tolerance;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::band_weights::BandWeights;
use crate::compute::room::beams_past::{beams_past, lit, lit_by_rim};
use crate::compute::room::direct::{self, DirectLight, Reception, Sensor};
use crate::compute::room::first_bounce::FirstLight;
use crate::compute::room::mesh::Mesh;
use crate::compute::room::near_field::NearField;
use crate::compute::room::outline::Outline;
use crate::compute::room::patch_weights::PatchWeights;
use crate::compute::room::through;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// Light of one aperture behind obstructions, in parts with light of their own.
pub(super) struct Split {
    /// Light of the whole aperture as means over it, except regular transmission, which is evaluated for each sensor.
    pub whole: Emission,
    /// Luminous exitance of the aperture on its room side. \[lm/m²\]
    pub exitance: Estimate,
    /// Regular transmission of sky and ground: the transmittance, and its flux per area. \[lm/m²\]
    regular: Option<(AngularTransmittance, Estimate)>,
    /// Scattered light of sky and ground that has the same luminance in all directions, by part of the aperture.
    smooth: Vec<Smooth>,
    /// Parts of the aperture, with the remaining light of sky and ground.
    leaves: Vec<Leaf>,
    /// Scattered sunlight per sunlit area, and the tiles of the aperture on which the sun shines.
    sun: Option<(SunTile, Emission)>,
    /// Scattered light for the patches of the room: of sky and ground, and of the sun.
    scattered: [ScatteredParts; 2],
    /// Beams of the sun, per sunlit area of the aperture.
    beams: Vec<BeamLight>,
    /// Sunlit pieces of the aperture, in the room frame. \[m\]
    lit: Vec<Vec<DVec3>>,
    /// Sunlit pieces of the aperture as seen from points on the rim of the solar disc, in the room frame; only if beams
    /// are redirected. \[m\]
    rim: Vec<Vec<Vec<DVec3>>>,
    lit_share: f64,
    /// Luminance of the sunlit pieces by scattered sunlight that is the same in all directions. \[cd/m²\]
    glow: Estimate,
    /// Note on the parts into which the aperture was divided, and why.
    pub seen: OutsideSeen,
}

/// Scattered light of an aperture, in the few parts that the patches of the room can distinguish.
#[derive(Default)]
struct ScatteredParts {
    /// Pieces of the aperture with light that is the same in all directions: outline \[m\] and luminous exitance
    /// \[lm/m²\].
    even: Vec<(Vec<DVec3>, f64)>,
    /// Few parts of the aperture with all other light, since each needs weights of all patches.
    quarters: Vec<(Aperture, Emission)>,
    /// Smaller pieces with the total exitance of the light in `quarters`, which show more finely where it leaves:
    /// outline \[m\] and luminous exitance \[lm/m²\]. Empty if the parts themselves are fine enough.
    pieces: Vec<(Vec<DVec3>, f64)>,
}

/// Part of an aperture that just contains its sunlit area, with the sunlit share of the part, and its halves if the
/// share is below 1.
struct SunTile {
    part: Aperture,
    lit: f64,
    halves: Vec<SunTile>,
}

/// Size of a tile across a shadow edge, as a share of the aperture's side, down to which tiles are halved.
const SUN_TILE: f64 = 1.0 / 32.0;
/// Maximum ratio of the size of a tile across a shadow edge to its distance from the sensor.
const SUN_TILE_AWAY: f64 = 0.1;
/// Number of parts along each side of an aperture for which the patches of the room receive light by emergent cells.
const QUARTERS: usize = 2;
/// Maximum number of pieces along each side of a part from which the patches of the room receive light that is the same
/// in all directions, for up to [`MANY_PARTS`] parts.
const PIECES: f64 = 4.0;
/// Number of parts of an aperture above which none is subdivided for light that is the same in all directions.
const MANY_PARTS: usize = 24;
/// Maximum number of parts for which the luminous intensity distribution uses nine points per part; for more, it uses
/// one point per part.
const FEW_PARTS: usize = 8;
/// Relative error of the outside seen past edges of boxes by regular transmission, in addition to that of the cubature.
const PAST_EDGES: f64 = 1e-4;
/// Relative accuracy of the illuminance of a patch by regular transmission; the sum over patches is scaled to the flux
/// that enters.
const AT_PATCHES: f64 = 1e-2;

impl Session {
    /// Computes the light of one aperture behind boxes or a skyline.
    ///
    /// # Errors
    /// Returns an error if cancelled.
    pub(super) fn split(&self, scene: &Scene, index: usize, progress: &dyn Progress) -> Result<Split, Cancelled> {
        let one = &scene.apertures[index];
        if let Some(lamps) = &one.lamps {
            return Ok(Split::of_lamps(scene, index, Emission::lamps(Arc::clone(lamps))));
        }
        let leaves = self.leaves(scene, index, progress)?;
        let same = Self::same_all_over(&leaves);
        let tiles: Vec<(Part, Emission)> = if same {
            leaves.iter().flat_map(Leaf::tiles).map(|(_, light)| (WHOLE, light)).collect()
        } else {
            leaves.iter().flat_map(Leaf::tiles).collect()
        };
        let weight = |part: Part| (part[0][1] - part[0][0]) * (part[1][1] - part[1][0]);
        let [through, incident] = leaves.iter().fold([Estimate::default(); 2], |sums, leaf| {
            let own = leaf.means();
            std::array::from_fn(|k| sums[k] + own[k] * weight(leaf.part))
        });
        // The sun alone: it is the same wherever it reaches, with or without obstructions.
        let dark = scene.outside.scaled(0.0);
        let facing = Facing { outside: &dark, ..scene.facing(index) };
        let sun = self.emission_under(scene, index, &facing);
        let around = scene.outside.surroundings();
        let (pieces, share) = around.map_or((Vec::new(), 0.0), |around| lit(&one.aperture, &facing, around));
        let share = if sun.incident_sun > 0.0 { share } else { 0.0 };
        let mut split = Split {
            whole: Emission::dark(),
            exitance: Estimate::default(),
            regular: any_of(&leaves).regular.clone().map(|tau| (tau, Estimate::default())),
            scattered: [scattered_parts(&one.aperture, &leaves, &tiles, same), ScatteredParts::default()],
            smooth: leaves.iter().map(|leaf| leaf.smooth(&one.aperture)).filter(Smooth::is_lit).collect(),
            sun: None,
            leaves: Vec::new(),
            beams: sun.beams.clone(),
            glow: sun.uniform,
            lit: if share > 0.0 { pieces } else { Vec::new() },
            rim: match around {
                Some(around) if sun.beams.iter().any(|beam| !beam.straight) => {
                    lit_by_rim(&one.aperture, &facing, around)
                }
                _ => Vec::new(),
            },
            lit_share: share,
            seen: seen(index, &leaves, same, &sun, share),
        };
        split.add_sun_tiles(&one.aperture, &sun, scene, index);
        // The totals of the aperture.
        let mut whole = mean_of(&leaves);
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
        whole.notes = any_of(&leaves).notes.iter().chain(&sun.notes).cloned().collect();
        let beams: f64 = whole.beams.iter().map(|beam| beam.exitance).sum();
        split.exitance = whole.scattered_exitance() + Estimate::exact(beams);
        if split.regular.is_some() {
            split.exitance += through;
        }
        split.whole = whole;
        split.leaves = leaves;
        Ok(split)
    }

    /// Computes the light of all apertures of a scene with boxes outside or a skyline that varies with the bearing;
    /// empty without these.
    pub(super) fn splits(&self, scene: &Scene, progress: &dyn Progress) -> Result<Vec<Split>, StudyError> {
        if scene.outside.surroundings().is_none() {
            return Ok(Vec::new());
        }
        if scene.near_field != NearField::SolidAngle {
            return Err(StudyError::key(
                "compute.near_field",
                "with boxes or a skyline by bearing only the solid-angle method is available; remove the key",
            ));
        }
        let all = (0..scene.apertures.len()).map(|index| self.split(scene, index, progress));
        Ok(all.collect::<Result<_, Cancelled>>()?)
    }

    /// Computes the direct light at the sensors from apertures behind obstructions.
    pub(super) fn direct_behind(
        &self,
        scene: &Scene,
        splits: &[Split],
        progress: &dyn Progress,
    ) -> Result<Vec<DirectLight>, StudyError> {
        // What lies between edges is judged by few points: more of them than an open sky needs.
        let relative = 0.3 * cubature(scene.error_target);
        let tolerance = Tolerance { absolute: 1e-7 * scene.outside.diffuse_horizontal(), relative, max_pieces: 4000 };
        in_blocks(scene, DIRECT_STAGE, progress, |_, sensor| {
            let mut sum = DirectLight::default();
            for (index, split) in splits.iter().enumerate() {
                sum += split.at(sensor, &scene.apertures[index].aperture, &scene.facing(index), tolerance);
            }
            Ok(sum)
        })
    }
}

impl SunTile {
    /// Creates the sunlit tiles of a part of an aperture. `reached`: returns the bounds of the sunlit area of a part,
    /// and its sunlit share. Shaded areas belong to no tile.
    fn of(part: Part, aperture: &Aperture, reached: &dyn Fn(Part) -> (Part, f64)) -> Self {
        let (part, lit) = reached(part);
        let [w, h] = part.map(|[low, high]| high - low);
        let mut halves = Vec::new();
        if lit > 1e-9 && lit < 1.0 - 1e-9 && w.max(h) > SUN_TILE {
            let axis = usize::from(h * aperture.size[1] > w * aperture.size[0]);
            let cut = 0.5 * (part[axis][0] + part[axis][1]);
            for half in [[part[axis][0], cut], [cut, part[axis][1]]] {
                let mut part = part;
                part[axis] = half;
                halves.push(Self::of(part, aperture, reached));
            }
        }
        Self { part: part_of(aperture, part), lit, halves }
    }

    /// Calls `on_tile` for every tile that is small enough for a sensor at `eye`, with the sunlit share of the tile.
    fn visit(&self, eye: DVec3, on_tile: &mut dyn FnMut(&Aperture, f64)) {
        let small = self.part.size[0].max(self.part.size[1]) <= SUN_TILE_AWAY * self.part.distance(eye);
        if self.halves.is_empty() || small {
            if self.lit > 1e-9 {
                on_tile(&self.part, self.lit);
            }
        } else {
            self.halves.iter().for_each(|half| half.visit(eye, on_tile));
        }
    }
}

/// Returns the parts of an aperture from which the patches of the room receive light by cells. `same`: whether the
/// aperture is uniform, so that one part is enough.
fn quarters(same: bool) -> Vec<Part> {
    let count = if same { 1 } else { QUARTERS };
    let limits = |at: usize| [at as f64 / count as f64, (at + 1) as f64 / count as f64];
    (0..count * count).map(|k| [limits(k % count), limits(k / count)]).collect()
}

/// Returns the scattered light of sky and ground for the patches of the room. `leaves`: parts of the aperture; `tiles`:
/// their subdivision with the light of each; `same`: whether the aperture is uniform.
fn scattered_parts(aperture: &Aperture, leaves: &[Leaf], tiles: &[(Part, Emission)], same: bool) -> ScatteredParts {
    let quarter = |part: Part| {
        let shares = tiles.iter().map(|(tile, light)| (overlap(part, *tile), light));
        (part_of(aperture, part), Emission::mixed(&shares.filter(|(share, _)| *share > 0.0).collect::<Vec<_>>()))
    };
    let quarters: Vec<_> = quarters(same).into_iter().map(quarter).collect();
    let most = if leaves.len() > MANY_PARTS { 1.0 } else { PIECES };
    let pieces: Vec<Part> = if same { vec![WHOLE] } else { leaves.iter().flat_map(|leaf| leaf.pieces(most)).collect() };
    let fluxes: Vec<(Part, [f64; 2])> = tiles
        .iter()
        .map(|(tile, light)| {
            let even = PI * light.uniform.value;
            (*tile, [even, light.scattered_exitance().value - even])
        })
        .collect();
    let of = |kind: usize| -> Vec<(Vec<DVec3>, f64)> {
        let mean = |part: &Part| fluxes.iter().map(|(tile, flux)| overlap(*part, *tile) * flux[kind]).sum::<f64>();
        let all = pieces.iter().map(|part| (part_of(aperture, *part).corners().to_vec(), mean(part)));
        all.filter(|(_, exitance)| *exitance > 0.0).collect()
    };
    let on_cells = !same && quarters.iter().any(|(_, light)| !light.cells.is_empty() || !light.bands.is_empty());
    ScatteredParts { even: of(0), quarters, pieces: if on_cells { of(1) } else { Vec::new() } }
}

/// Returns the note on how the aperture was divided, for the plan of the computation. `share`: sunlit share of the
/// aperture.
fn seen(index: usize, leaves: &[Leaf], same: bool, sun: &Emission, share: f64) -> OutsideSeen {
    let scatters = leaves.iter().any(|leaf| leaf.any().fluxes().iter().any(|flux| *flux > 0.0));
    let most = leaves.iter().map(|leaf| leaf.change[0].max(leaf.change[1])).fold(0.0, f64::max);
    OutsideSeen {
        aperture: index,
        through: any_of(leaves).regular.is_some(),
        parts: scatters.then_some(if same { 0 } else { leaves.len() }),
        change: most,
        sunlit: (sun.incident_sun > 0.0).then_some(share),
    }
}

impl Split {
    /// Creates the light of an aperture that is replaced by luminaire files, which does not depend on obstructions.
    fn of_lamps(scene: &Scene, index: usize, whole: Emission) -> Self {
        Self {
            exitance: whole.exitance(&scene.facing(index)),
            regular: None,
            smooth: Vec::new(),
            leaves: Vec::new(),
            sun: None,
            scattered: Default::default(),
            beams: Vec::new(),
            lit: Vec::new(),
            rim: Vec::new(),
            lit_share: 0.0,
            glow: Estimate::default(),
            // The light from outside is in the files: there is nothing to note.
            seen: OutsideSeen { aperture: index, through: false, parts: None, change: 0.0, sunlit: None },
            whole,
        }
    }

    /// Adds scattered sunlight on the sunlit tiles of the aperture, which are small across the edges of shadows.
    fn add_sun_tiles(&mut self, aperture: &Aperture, sun: &Emission, scene: &Scene, index: usize) {
        if self.lit_share <= 0.0 || (sun.cells.is_empty() && sun.bands.is_empty()) {
            return;
        }
        let scattered = Emission { uniform: Estimate::default(), beams: Vec::new(), regular: None, ..sun.clone() };
        let share = |part: Part| {
            let own = part_of(aperture, part);
            scene.outside.surroundings().map_or(0.0, |around| lit(&own, &scene.facing(index), around).1)
        };
        let reached = |part: Part| {
            let own = part_of(aperture, part);
            let around = scene.outside.surroundings();
            let (pieces, lit) = around.map_or((Vec::new(), 0.0), |around| lit(&own, &scene.facing(index), around));
            let places = pieces.iter().flatten().map(|p| aperture.surface.facade_from_room(*p - aperture.corner));
            let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
            let [low, high] = places.fold(none, |[low, high], p| [low.min(p), high.max(p)]);
            let bounds: Part = [0, 1].map(|axis| [low[axis], high[axis]].map(|at| at / aperture.size[axis]));
            let size = area(bounds);
            if lit > 1e-9 && size > 0.0 { (bounds, (lit * area(part) / size).min(1.0)) } else { (part, 0.0) }
        };
        self.sun = Some((SunTile::of(WHOLE, aperture, &reached), scattered.clone()));
        let whole = self.lit_share >= 1.0 - 1e-9;
        let exitance = scattered.scattered_exitance().value;
        let [_, sunlit] = &mut self.scattered;
        for part in quarters(whole) {
            let lit = share(part);
            if lit > 0.0 {
                sunlit.quarters.push((part_of(aperture, part), scattered.clone().scaled(lit)));
            }
        }
        if !whole {
            sunlit.pieces = self.lit.iter().map(|piece| (piece.clone(), exitance)).collect();
        }
    }

    /// Returns the luminous intensity distribution of the whole aperture: the sum over its parts, with sky and ground
    /// as each part sees them by regular transmission.
    pub fn lid(&self, scene: &Scene, index: usize) -> LidResult {
        let aperture = &scene.apertures[index].aperture;
        let facing = scene.facing(index);
        let all = self.leaves.len() <= FEW_PARTS;
        let eyes = self.leaves.iter().flat_map(|leaf| leaf.eyes(all)).filter(|_| self.regular.is_some());
        let seen = eyes.map(|(share, eye)| (share, scene.outside.seen_from(eye))).collect();
        LidResult {
            lid: self.whole.lid_through(&facing, aperture.size, seen),
            flux: (self.exitance + Estimate::new(0.0, self.whole.exitance_uncertainty())) * aperture.area(),
            incident: (self.whole.incident_diffuse, self.whole.incident_sun),
        }
    }

    /// Returns the direct light of the aperture at one sensor.
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
        if self.whole.lamps.is_some() {
            add(aperture, &self.whole);
        }
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
            let mut seen = direct::seen_through(&view, &Facing { outside: &outside, ..*facing }, tau, tolerance);
            seen.all.error += PAST_EDGES * seen.all.value;
            sum += seen;
        }
        sum += beams_past(sensor, aperture, &self.lit, &self.rim, &self.beams, facing, around);
        sum
    }

    /// Adds the light of the aperture on the surfaces of the room to `first`. `weights`: returns the weights with which
    /// the patches receive light from a part of an aperture by the cells of a basis.
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
        let outline = |corners: &[DVec3], exitance: f64| Outline { wall, corners: flat(corners), exitance };
        let of = |pieces: &[(Vec<DVec3>, f64)]| -> Vec<Outline> {
            pieces.iter().map(|(corners, exitance)| outline(corners, *exitance)).collect()
        };
        let mut outlines = Vec::new();
        for scattered in &self.scattered {
            outlines.extend(of(&scattered.even));
            let mut on_cells = FirstLight::dark(mesh.patches.len());
            scattered
                .quarters
                .iter()
                .for_each(|(part, light)| on_cells.add_cells(light, &|basis| weights(part, basis)));
            let (coarse, fine) = if scattered.pieces.is_empty() {
                (Vec::new(), Vec::new())
            } else {
                let parts = scattered.quarters.iter().map(|(part, light)| {
                    outline(&part.corners(), light.scattered_exitance().value - PI * light.uniform.value)
                });
                (parts.collect(), of(&scattered.pieces))
            };
            first.add_shifted(mesh, on_cells, &coarse, &fine);
        }
        if self.glow.value > 0.0 {
            outlines.extend(self.lit.iter().map(|piece| outline(piece, PI * self.glow.value)));
        }
        if !outlines.is_empty() {
            first.add_outlines(mesh, &outlines);
        }
        if let Some(lamps) = &self.whole.lamps {
            first.add_lamps(mesh, aperture, lamps);
        }
        if let Some((tau, flux)) = &self.regular {
            let tolerance = Tolerance { absolute: 1e-4 * flux.value, ..Tolerance::relative(AT_PATCHES) };
            let at = |sensor: &Sensor| {
                let Some(view) = aperture.view(sensor.position, sensor.normal) else { return 0.0 };
                let outside = facing.outside.seen_from(facing.orientation.to_world(sensor.position));
                through::illuminance(&view, &Facing { outside: &outside, ..*facing }, tau, tolerance).value
            };
            first.add_seen(mesh, aperture, *flux * aperture.area(), at);
        }
        self.beams.iter().for_each(|beam| first.add_beam_through(aperture, &self.lit, beam, facing));
    }
}
