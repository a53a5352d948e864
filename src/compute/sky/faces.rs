//! Light on the faces of what stands around: what [`Surroundings`] is made of.
//!
//! The smooth part, E from sky, skyline and ground past other boxes and the room (both black), is found at the nodes of
//! panels that are narrow where another body stands close; the sun's is exact at every point by a ray, with sharp
//! shadows. One reflection: the face sends ρE/π evenly in all directions.

use super::integral::irradiance;
use super::outside::Outside;
use super::prospect::Prospect;
use super::region::{Frame, Region, Weight};
use super::sun::Sun;
use crate::compute::direction::{Dir, World};
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::face_light::FaceLight;
use crate::compute::surroundings::shading::shadow_edges;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::{Face, Solid};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// How a box shines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finish {
    /// Diffuse reflectance, 0 … 1.
    Reflectance(f64),
    /// The same luminance on all faces, whatever falls on them. \[cd/m²\]
    Luminance(f64),
}

/// Relative accuracy asked of the light at a node.
const AT_NODES: f64 = 2e-3;
/// A body nearer to a face than this share of its size casts a steep gradient of light on it.
const CLOSE: f64 = 0.2;
/// Share of a face's side that is a panel of its own beside a close body.
const RIM: f64 = 0.12;
/// Panels along each side at least.
const PANELS: usize = 3;
/// Panels narrower than this share of a side are not made.
const NARROW: f64 = 0.03;
/// What remains of the light on a face beside what is seen at places between the nodes, relative.
const REST: f64 = 1e-3;

/// Boxes with the light on them. `outside`: the open sky and ground, with a flat skyline if there is one. `viewpoints`:
/// faces that none of them has before itself stay dark.
pub fn surroundings(
    outside: &Outside,
    sun: Option<&Sun>,
    boxes: &[(Solid, Finish)],
    room: Solid,
    skyline: Option<Skyline>,
    viewpoints: &[DVec3],
) -> Surroundings {
    let solids: Vec<Solid> = boxes.iter().map(|(solid, _)| *solid).collect();
    let shining = sun.map(|sun| (sun.direction.vector(), sun.direct_normal * above(outside, skyline.as_ref(), sun)));
    let shining = shining.filter(|(_, normal)| *normal > 0.0);
    let seen = |face: &Face| viewpoints.iter().any(|point| face.normal.dot(*point - face.origin) > 1e-9);
    let lit = |index: usize, number: usize| -> FaceLight {
        let (solid, finish) = &boxes[index];
        let face = solid.face(number);
        let rho = match finish {
            Finish::Luminance(luminance) => return FaceLight::even(*luminance),
            Finish::Reflectance(rho) => *rho,
        };
        if rho == 0.0 || !seen(&face) {
            return FaceLight::even(0.0);
        }
        let towards = shining.map_or(0.0, |(direction, normal)| normal * face.normal.dot(direction).max(0.0));
        let sun = rho / PI * towards;
        let others: Vec<&Solid> =
            solids.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, solid)| solid).collect();
        let others: Vec<&Solid> = others.into_iter().chain([&room]).collect();
        smooth(outside, skyline.as_ref(), &face, &others, rho, sun)
    };
    let faces: Vec<[FaceLight; 6]> =
        (0..boxes.len()).map(|index| std::array::from_fn(|number| lit(index, number))).collect();
    let mut edges = Vec::new();
    if let Some((direction, _)) = shining {
        for (index, own) in faces.iter().enumerate() {
            for (number, _) in own.iter().enumerate().filter(|(_, light)| light.sun > 0.0) {
                let others = solids.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, solid)| solid);
                edges.extend(shadow_edges(&solids[index].face(number), others.chain([&room]), direction));
            }
        }
    }
    Surroundings { solids, room, faces, sun: shining.map(|(direction, _)| direction), shadow_edges: edges, skyline }
}

/// Share of the disc above horizon and skyline.
fn above(outside: &Outside, skyline: Option<&Skyline>, sun: &Sun) -> f64 {
    let bearing = sun.direction.bearing().radians();
    sun.share_above(skyline.map_or(outside.skyline_altitude(), |skyline| skyline.altitude(bearing)))
}

/// The smooth light of a face, and the sun's.
fn smooth(
    outside: &Outside,
    skyline: Option<&Skyline>,
    face: &Face,
    others: &[&Solid],
    rho: f64,
    sun: f64,
) -> FaceLight {
    let with_sun = |mut light: FaceLight| {
        light.sun = sun;
        light
    };
    if !outside.is_lit() && skyline.is_none_or(|skyline| skyline.luminance == 0.0) {
        return with_sun(FaceLight::even(0.0));
    }
    let normal = Dir::<World>::from_unit(face.normal);
    let free = irradiance(outside, normal).value;
    let at = |[u, v]: [f64; 2]| {
        let point = face.point(u, v);
        // Bodies behind the face's plane hide nothing of it.
        let before = |solid: &&&Solid| solid.corners().iter().any(|c| face.normal.dot(*c - point) > 1e-9);
        let prospect = Prospect::black(outside, others.iter().filter(before).copied().collect(), skyline, point);
        rho / PI * (free + hidden(&prospect, normal, AT_NODES * free)).max(0.0)
    };
    let lines = panels(face, others);
    let places = FaceLight::places(&lines);
    let values: Vec<f64> = places.par_iter().map(|place| at(*place)).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let mut light = FaceLight::with_panels(lines, values, sun, 0.0);
    // Between the nodes of every panel.
    let tries: Vec<[f64; 2]> = places
        .chunks(crate::compute::surroundings::face_light::NODES.pow(2))
        .map(|panel| {
            let (a, b) = (panel[0], panel[panel.len() - 1]);
            [a[0] + 0.28 * (b[0] - a[0]), a[1] + 0.73 * (b[1] - a[1])]
        })
        .collect();
    let off = tries.par_iter().map(|place| (light.diffuse(place[0], place[1]) - at(*place)).abs()).sum::<f64>();
    light.error = REST + if mean > 0.0 { off / tries.len() as f64 / mean } else { 0.0 };
    light
}

/// What bodies take from a plane at a point: less than 0 but where a skyline is brighter than the sky. \[lx\]
fn hidden(prospect: &Prospect<'_>, normal: Dir<World>, absolute: f64) -> f64 {
    let frame = Frame::facing(normal);
    let region = Region { frame, theta: (0.0, FRAC_PI_2), phi: (-PI, PI) };
    prospect.over(&region, Weight::Projected, 1e-3, absolute).map_or(0.0, |(parts, _)| parts.before - parts.behind)
}

/// Borders of a face's panels along both axes.
fn panels(face: &Face, others: &[&Solid]) -> [Vec<f64>; 2] {
    let corners = face.corners();
    let size = face.limits.map(|[low, high]| high - low);
    let near: Vec<&&Solid> =
        others.iter().filter(|solid| solid.gap_to(&corners) < CLOSE * size[0].min(size[1])).collect();
    std::array::from_fn(|axis| {
        let [low, high] = face.limits[axis];
        let width = high - low;
        let mut lines = vec![low, high];
        lines.extend((1..PANELS).map(|k| low + k as f64 / PANELS as f64 * width));
        if !near.is_empty() {
            lines.extend([low + RIM * width, high - RIM * width]);
        }
        for corner in near.iter().flat_map(|solid| solid.corners()) {
            lines.push(face.coordinates(corner)[axis]);
        }
        lines.retain(|line| *line >= low && *line <= high);
        lines.sort_unstable_by(f64::total_cmp);
        let mut kept: Vec<f64> = vec![low];
        for line in lines {
            if line - kept[kept.len() - 1] > NARROW * width && high - line > NARROW * width {
                kept.push(line);
            }
        }
        kept.push(high);
        kept
    })
}
