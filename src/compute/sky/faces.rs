//! Light on the faces of what stands around: what [`Surroundings`] is made of.
//!
//! The smooth part, E from sky, skyline and ground past other boxes and the room (both black), is found at the nodes of
//! panels that are small where it is steep; the sun's is exact at every point by a ray, with sharp shadows. One
//! reflection: the face sends ρE/π evenly in all directions.

use super::hidden::Hidden;
use super::integral::irradiance;
use super::outside::Outside;
use super::sun::{SUN_HALF_ANGLE, Sun};
use crate::compute::direction::Dir;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::surroundings::face_light::FaceLight;
use crate::compute::surroundings::shading::shadow_edges;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::{Face, Solid};
use crate::compute::surroundings::{Line, Surroundings};
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

/// Relative accuracy asked of the light at a node.
const AT_NODES: f64 = 8e-3;
/// What the light between the nodes may be off, relative to its mean, before panels are halved.
const BETWEEN: f64 = 5e-4;
/// A body nearer to a face than this share of its size casts a steep gradient of light on it: its outline is a border of
/// panels.
const CLOSE: f64 = 0.2;
/// Panels narrower than this share of a side are not made at the outset.
const NARROW: f64 = 0.03;
/// Panels of a face at most, and of all faces together as far as each has its [`FEWEST`].
const MOST: usize = 48;
const MOST_OF_ALL: usize = 1000;
const FEWEST: usize = 1;
/// What remains of the light on a face beside what is seen at places between the nodes, relative.
const REST: f64 = 1e-3;

/// Boxes with the light on them. `outside`: the open sky and ground, with a flat skyline if there is one. `viewpoints`:
/// faces that none of them has before itself stay dark.
///
/// # Errors
/// [`Cancelled`] when `progress` says so.
pub fn surroundings(
    outside: &Outside,
    sun: Option<&Sun>,
    boxes: &[(Solid, Finish)],
    room: Solid,
    skyline: Option<Skyline>,
    viewpoints: &[DVec3],
    progress: &dyn Progress,
) -> Result<Surroundings, Cancelled> {
    let solids: Vec<Solid> = boxes.iter().map(|(solid, _)| *solid).collect();
    let shining = sun.map(|sun| (sun.direction.vector(), sun.direct_normal * above(outside, skyline.as_ref(), sun)));
    let shining = shining.filter(|(_, normal)| *normal > 0.0);
    let seen = |face: &Face| viewpoints.iter().any(|point| face.normal.dot(*point - face.origin) > 1e-9);
    let dark = |finish: &Finish| match finish {
        Finish::Luminance(luminance) => FaceLight::even(*luminance),
        Finish::Reflectance(_) => FaceLight::even(0.0),
    };
    let mut faces: Vec<[FaceLight; 6]> =
        boxes.iter().map(|(_, finish)| std::array::from_fn(|_| dark(finish))).collect();
    let reflects = |(index, (solid, finish)): (usize, &(Solid, Finish))| {
        let rho = if let Finish::Reflectance(rho) = finish { *rho } else { 0.0 };
        let own = (0..6).map(move |number| (index, number, solid.face(number), rho));
        own.filter(|(_, _, face, rho)| *rho > 0.0 && seen(face)).collect::<Vec<_>>()
    };
    let asked: Vec<(usize, usize, Face, f64)> = boxes.iter().enumerate().flat_map(reflects).collect();
    let most = (MOST_OF_ALL / asked.len().max(1)).clamp(FEWEST, MOST);
    let done = AtomicUsize::new(0);
    let lit = asked.par_iter().map(|(index, number, face, rho)| {
        let others = solids.iter().enumerate().filter(|(other, _)| other != index).map(|(_, solid)| solid);
        let others: Vec<&Solid> = others.chain([&room]).collect();
        let mut light = smooth(outside, skyline.as_ref(), face, &others, most, progress)?;
        light.sun = shining.map_or(0.0, |(direction, normal)| normal * face.normal.dot(direction).max(0.0)) / PI;
        light.scale(*rho);
        progress.advance("outside", done.fetch_add(1, Ordering::Relaxed) + 1, asked.len());
        Ok((*index, *number, light))
    });
    for (index, number, light) in lit.collect::<Result<Vec<_>, Cancelled>>()? {
        faces[index][number] = light;
    }
    let mut lines = seams(&solids);
    if let Some((direction, _)) = shining {
        for (index, own) in faces.iter().enumerate() {
            for (number, _) in own.iter().enumerate().filter(|(_, light)| light.sun > 0.0) {
                let others = solids.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, solid)| solid);
                let face = solids[index].face(number);
                let edges = shadow_edges(&face, others.chain([&room]), direction);
                lines.extend(edges.into_iter().map(|ends| Line { ends, faces: [face; 2] }));
            }
        }
    }
    Ok(Surroundings { solids, room, faces, sun: shining.map(|(direction, _)| direction), lines, skyline })
}

/// Share of the disc above horizon and skyline.
fn above(outside: &Outside, skyline: Option<&Skyline>, sun: &Sun) -> f64 {
    match skyline {
        Some(skyline) => skyline.free_share(sun.direction.vector(), SUN_HALF_ANGLE),
        None => sun.share_above(outside.skyline_altitude()),
    }
}

/// The smooth light that falls on a face, over π: what a white one shines with.
fn smooth(
    outside: &Outside,
    skyline: Option<&Skyline>,
    face: &Face,
    others: &[&Solid],
    most: usize,
    progress: &dyn Progress,
) -> Result<FaceLight, Cancelled> {
    if !outside.is_lit() && skyline.is_none_or(|skyline| skyline.luminance == 0.0) {
        return Ok(FaceLight::even(0.0));
    }
    let free = irradiance(outside, Dir::from_unit(face.normal)).value;
    let at = |[u, v]: [f64; 2]| {
        let hidden = Hidden::new(outside, skyline, others, (face.point(u, v), face.normal), free);
        hidden.map_or(0.0, |hidden| (free + hidden.change(AT_NODES * free)).max(0.0) / PI)
    };
    let measure = |places: &[[f64; 2]]| {
        let at = |place: &[f64; 2]| if progress.cancelled() { Err(Cancelled) } else { Ok(at(*place)) };
        places.par_iter().map(at).collect()
    };
    let mut light = FaceLight::fitted(&borders(face, others, most), BETWEEN, most, measure)?;
    light.error += REST;
    Ok(light)
}

/// Borders of a face's first panels along both axes: the outlines of bodies that stand close, as far as they make no more
/// than `most`.
fn borders(face: &Face, others: &[&Solid], most: usize) -> [Vec<f64>; 2] {
    let corners = face.corners();
    let size = face.limits.map(|[low, high]| high - low);
    let near: Vec<&&Solid> =
        others.iter().filter(|solid| solid.gap_to(&corners) < CLOSE * size[0].min(size[1])).collect();
    let mut borders = std::array::from_fn(|axis| {
        let [low, high] = face.limits[axis];
        let mut lines: Vec<f64> = near
            .iter()
            .filter(|solid| solid.corners().iter().any(|corner| face.normal.dot(*corner - face.origin) > 1e-9))
            .flat_map(|solid| solid.corners())
            .map(|corner| face.coordinates(corner)[axis])
            .collect();
        lines.sort_unstable_by(f64::total_cmp);
        let mut kept: Vec<f64> = vec![low];
        for line in lines {
            if line - kept[kept.len() - 1] > NARROW * size[axis] && high - line > NARROW * size[axis] {
                kept.push(line);
            }
        }
        kept.push(high);
        kept
    });
    while (borders[0].len() - 1) * (borders[1].len() - 1) > most {
        let longer = usize::from(borders[1].len() > borders[0].len());
        // Every other one, but both ends.
        let last = borders[longer].len() - 1;
        let mut index = 0;
        borders[longer].retain(|_| {
            index += 1;
            (index - 1) % 2 == 0 || index - 1 == last
        });
    }
    borders
}

/// Where faces of boxes that overlap meet: no edge of either box, and yet a border of what is seen.
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
