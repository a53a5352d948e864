//! Light on what stands outside and on the ground: what [`Surroundings`] is made of.
//!
//! Every place sends ρE/π alike in all directions, E from all that it sees: sky, skyline, sun, and the light of the others.
//! The sun's own light is exact at every point, by a ray, with sharp shadows. The rest is smooth: it is first found on few
//! panels for all surfaces at once, as the solution of a system of linear equations, so that it does not matter how often
//! light goes to and fro; what is seen from the apertures then gathers it again, on panels that are small where it is steep.

use super::equations::coarse;
use super::open_ground::OpenGround;
use super::outside::Outside;
use super::sun::Sun;
use super::vista::{Scenery, Surface, share_above};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::surroundings::shading::{shadow, shadow_edges};
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::{Face, Solid};
use crate::compute::surroundings::{Ground, Line, Surroundings};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How a box shines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finish {
    /// Diffuse reflectance, 0 … 1.
    Reflectance(f64),
    /// The same luminance on all faces, whatever falls on them. \[cd/m²\]
    Luminance(f64),
}

/// What stands outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Overhangs, fins, neighbours: what rises above the ground.
    pub boxes: Vec<(Solid, Finish)>,
    /// The room's own box.
    pub room: Solid,
    /// The building that holds it, and its reflectance.
    pub building: Option<(Solid, f64)>,
    /// Height of the ground. \[m\]
    pub ground: f64,
}

impl Setting {
    /// The whole turned about the vertical through the origin; cosine and sine of the angle.
    pub fn turned(&self, turn: [f64; 2]) -> Self {
        Self {
            boxes: self.boxes.iter().map(|(solid, finish)| (solid.turned(turn), *finish)).collect(),
            room: self.room.turned(turn),
            building: self.building.as_ref().map(|(solid, reflectance)| (solid.turned(turn), *reflectance)),
            ground: self.ground,
        }
    }
}

/// What the light between the nodes may be off, relative to its mean, before panels are halved.
const BETWEEN: f64 = 1e-3;
/// Panels of a face at most, and of all faces together as far as each has its [`FEWEST`].
const MOST: usize = 48;
const MOST_OF_ALL: usize = 300;
const FEWEST: usize = 1;
/// Panels of the ground that is seen are no longer than this times the size of what stands near, or its distance.
const FINE_GROUND: f64 = 1.0;
/// Apertures count as so high above the ground at least. \[m\]
const LOWEST_EYE: f64 = 0.5;
/// Gathering is repeated until the light of every surface changes by less, relative, but no more often than this.
const SETTLED: f64 = 2e-3;
const MOST_OFTEN: usize = 4;
/// What remains of the light on a face beside what is seen at places between the nodes, relative.
const REST: f64 = 2e-4;

/// Boxes and ground with the light on them, everything in the world's axes. `outside`: the open sky and ground, with a flat
/// skyline if there is one. `turn`: of the room's x axis, cosine and sine. `viewpoints`: from where all of it is seen.
///
/// # Errors
/// [`Cancelled`] when `progress` says so.
pub fn surroundings(
    outside: &Outside,
    sun: Option<&Sun>,
    setting: &Setting,
    turn: [f64; 2],
    skyline: Option<Skyline>,
    viewpoints: &[DVec3],
    progress: &dyn Progress,
) -> Result<Surroundings, Cancelled> {
    let shining =
        sun.map(|sun| (sun.direction.vector(), sun.direct_normal * share_above(outside, skyline.as_ref(), sun)));
    let shining = shining.filter(|(_, normal)| *normal > 0.0);
    let scenery = scenery(outside, skyline.as_ref(), shining, setting, turn);
    let ground = OpenGround::of(&scenery, viewpoints);
    let mut lights = coarse(&scenery, &ground, progress)?;
    let seen = |face: &Face| viewpoints.iter().any(|point| face.normal.dot(*point - face.origin) > 1e-9);
    let boxes = 6 * setting.boxes.len();
    let wanted: Vec<usize> = (0..scenery.surfaces.len())
        .filter(|index| *index < boxes || *index == scenery.ground())
        .filter(|index| {
            let surface = &scenery.surfaces[*index];
            surface.reflectance > 0.0 && surface.stated.is_none() && seen(&surface.face)
        })
        .collect();
    // Of the ground what is near counts most: a place by the solid angle that it is seen in.
    let weight = |index: usize| {
        let face = scenery.surfaces[index].face;
        let ground = index == scenery.ground();
        move |[u, v]: [f64; 2]| {
            let seen = |eye: &DVec3| {
                let to = face.point(u, v) - *eye;
                let height = to.z.abs().max(LOWEST_EYE);
                height / (to.truncate().length_squared() + height * height).powf(1.5)
            };
            if ground { viewpoints.iter().map(seen).sum() } else { 1.0 }
        }
    };
    let most = (MOST_OF_ALL / wanted.len().max(1)).clamp(FEWEST, MOST);
    for _ in 0..MOST_OFTEN {
        let done = AtomicUsize::new(0);
        let gathered = wanted.par_iter().map(|&index| {
            let start = ground.panels(&scenery, index, most, FINE_GROUND, false);
            let most = if index == scenery.ground() { start.panels().max(most) + MOST } else { most };
            let light = start.fitted(BETWEEN, most, &weight(index), |places| {
                places.par_iter().map(|place| ground.light_at(&scenery, &lights, index, *place, progress)).collect()
            })?;
            progress.advance("outside", done.fetch_add(1, Ordering::Relaxed) + 1, wanted.len());
            Ok((index, light))
        });
        let gathered = gathered.collect::<Result<Vec<_>, Cancelled>>()?;
        let mut changed: f64 = 0.0;
        for (index, mut light) in gathered {
            let weight = weight(index);
            let (before, after) = (lights[index].mean(&weight), light.mean(&weight));
            let change = if after > 0.0 { ((after - before) / after).abs() } else { 0.0 };
            changed = changed.max(change);
            light.error = REST + 0.1 * change;
            lights[index] = light;
        }
        if changed < SETTLED {
            break;
        }
    }
    for (light, surface) in lights.iter_mut().zip(&scenery.surfaces) {
        light.sun = surface.sun;
    }
    let lines = lines(&scenery, &wanted, shining.map(|(direction, _)| direction));
    let of_ground = lights.pop().filter(|light| light.is_lit());
    let ground = of_ground.map(|light| Ground {
        face: scenery.surfaces[scenery.ground()].face,
        light,
        limits: ground.limits,
        open: ground.luminance,
    });
    let faces = lights.chunks_exact(6).take(setting.boxes.len());
    Ok(Surroundings {
        faces: faces.map(|six| std::array::from_fn(|k| six[k].clone())).collect(),
        solids: scenery.bodies[..setting.boxes.len()].to_vec(),
        building: scenery.bodies[setting.boxes.len()],
        shades_ground: setting.building.is_some(),
        ground,
        sun: shining.map(|(direction, _)| direction),
        lines,
        skyline,
    })
}

/// Bodies and surfaces. `shining`: towards the sun, and its normal illuminance.
fn scenery<'a>(
    outside: &'a Outside,
    skyline: Option<&'a Skyline>,
    shining: Option<(DVec3, f64)>,
    setting: &Setting,
    turn: [f64; 2],
) -> Scenery<'a> {
    let height = setting.ground;
    let above = |solid: &Solid| solid.above(height);
    let mut bodies: Vec<Solid> = setting.boxes.iter().map(|(solid, _)| above(solid)).collect();
    // What a room above the ground stands on hides from faces what is behind it, whatever it is.
    bodies.push(setting.building.as_ref().map_or(setting.room.down_to(height), |(solid, _)| above(solid)));
    let finishes = setting.boxes.iter().map(|(_, finish)| *finish);
    let last = setting.building.as_ref().map_or(0.0, |(_, reflectance)| *reflectance);
    let mut surfaces = Vec::with_capacity(6 * bodies.len() + 1);
    for (solid, finish) in bodies.iter().zip(finishes.chain([Finish::Reflectance(last)])) {
        for number in 0..6 {
            // What stands on the ground shows nothing of its underside.
            let hidden = number == 4 && solid.heights()[0] <= height + 1e-9;
            let (reflectance, stated) = match finish {
                Finish::Reflectance(rho) => (if hidden { 0.0 } else { rho }, None),
                Finish::Luminance(luminance) => (0.0, Some(luminance)),
            };
            surfaces.push(Surface { face: solid.face(number), reflectance, stated, sun: 0.0, shadows: Vec::new() });
        }
    }
    surfaces.push(Surface::ground(height, outside.ground_reflectance(), turn));
    let from_ground = setting.boxes.len() + usize::from(setting.building.is_some());
    let mut scenery = Scenery { open: outside, skyline, bodies, from_ground, surfaces };
    if let Some((sun, normal)) = shining {
        for index in 0..scenery.surfaces.len() {
            let Surface { face, reflectance, stated, .. } = &scenery.surfaces[index];
            let towards = face.normal.dot(sun);
            if stated.is_some() || *reflectance <= 0.0 || towards <= 1e-6 {
                continue;
            }
            let light = reflectance * normal * towards / PI;
            let cast = scenery.others(index).map(|(_, solid)| shadow(solid, face, sun));
            let shadows = cast.filter(|outline| outline.len() >= 3).collect();
            (scenery.surfaces[index].sun, scenery.surfaces[index].shadows) = (light, shadows);
        }
    }
    scenery
}

/// Where the luminance of what is seen jumps beside the bodies' own edges: at shadows' edges, and where faces of boxes that
/// overlap meet.
fn lines(scenery: &Scenery<'_>, seen: &[usize], sun: Option<DVec3>) -> Vec<Line> {
    let mut lines = seams(&scenery.bodies[..scenery.bodies.len() - 1]);
    let Some(sun) = sun else { return lines };
    for &index in seen.iter().filter(|index| scenery.surfaces[**index].sun > 0.0) {
        let face = scenery.surfaces[index].face;
        let edges = shadow_edges(&face, scenery.others(index).map(|(_, solid)| solid), sun);
        lines.extend(edges.into_iter().map(|ends| Line { ends, faces: [face; 2] }));
    }
    lines
}

/// No edge of either box, and yet a border of what is seen.
fn seams(solids: &[Solid]) -> Vec<Line> {
    let mut seams = Vec::new();
    for (index, one) in solids.iter().enumerate() {
        for other in solids[..index].iter().filter(|other| one.overlaps(other, 0.0)) {
            for (a, b) in (0..6).flat_map(|a| (0..6).map(move |b| (one.face(a), other.face(b)))) {
                seams.extend(a.meets(&b).map(|ends| Line { ends, faces: [a, b] }));
            }
        }
    }
    seams
}
