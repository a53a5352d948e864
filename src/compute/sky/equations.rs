//! Light that faces and ground send each other, any number of times: on few panels, as the solution of linear equations.

use super::open_ground::OpenGround;
use super::vista::{Scenery, Surface, Vista};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::surroundings::face_light::FaceLight;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Of a face, panels of the equations.
const MOST_COARSE: usize = 4;
/// More surfaces than this have one value each in the equations.
const MANY: usize = 100;
/// Panels of the ground are no longer than this times the size of what stands near, or its distance.
const COARSE_GROUND: f64 = 2.0;
/// The equations are solved to this, relative.
const SOLVED: f64 = 1e-6;

/// The smooth light of all surfaces on few panels.
pub(super) fn coarse(
    scenery: &Scenery<'_>,
    ground: &OpenGround,
    progress: &dyn Progress,
) -> Result<Vec<FaceLight>, Cancelled> {
    let reflects = |surface: &Surface| surface.reflectance > 0.0 && surface.stated.is_none();
    let many = scenery.surfaces.iter().filter(|surface| reflects(surface)).count() > MANY;
    let of = |(index, surface): (usize, &Surface)| match surface.stated {
        Some(luminance) => FaceLight::even(luminance),
        None if !reflects(surface) => FaceLight::even(0.0),
        None => ground.panels(scenery, index, if many { 1 } else { MOST_COARSE }, COARSE_GROUND, many),
    };
    let mut lights: Vec<FaceLight> = scenery.surfaces.iter().enumerate().map(of).collect();
    // The values of all panels, one after the other.
    let mut first = Vec::with_capacity(lights.len());
    let mut nodes = Vec::new();
    for (index, light) in lights.iter().enumerate() {
        first.push(nodes.len());
        nodes.extend(light.places().into_iter().map(|place| (index, place)));
    }
    let done = AtomicUsize::new(0);
    let row = |&(index, [u, v]): &(usize, [f64; 2])| {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let surface = &scenery.surfaces[index];
        let point = surface.face.point(u, v);
        if scenery.is_covered(index, point) {
            return Ok((f64::NAN, Vec::new()));
        }
        let mut counts = vec![0.0; nodes.len()];
        let mut beyond = 0.0;
        let rest = Vista::new(scenery, index, point).gather(|other, at, weight| {
            if other == scenery.ground() && !ground.holds(at) {
                beyond += weight * ground.luminance;
            } else {
                lights[other].weigh(at, |node, share| counts[first[other] + node] += weight * share);
            }
        });
        let albedo = surface.reflectance / PI;
        let sparse = counts.into_iter().enumerate().filter(|(_, counts)| *counts != 0.0);
        let sparse: Vec<(u32, f64)> = sparse.map(|(node, counts)| (node as u32, albedo * counts)).collect();
        progress.advance("outside", done.fetch_add(1, Ordering::Relaxed) + 1, nodes.len());
        Ok((albedo * (rest + beyond), sparse))
    };
    let mut rows = nodes.par_iter().map(row).collect::<Result<Vec<_>, Cancelled>>()?;
    // Of places that a body covers the nearest free one of their panel stands for them.
    let mut of_node: Vec<usize> = Vec::with_capacity(nodes.len());
    for (light, from) in lights.iter_mut().zip(&first) {
        let count = light.places().len();
        let name = |node: usize| if rows[node].0.is_nan() { f64::NAN } else { (node + 1) as f64 };
        light.set(&(*from..from + count).map(name).collect::<Vec<f64>>());
        // Of a panel that is all covered every place stays what it is: dark.
        let own = |(k, name): (usize, &f64)| if *name > 0.0 { *name as usize - 1 } else { from + k };
        of_node.extend(light.values().iter().enumerate().map(own));
    }
    for (_, others) in &mut rows {
        others.iter_mut().for_each(|(node, _)| *node = of_node[*node as usize] as u32);
    }
    let light = solved(&rows);
    for (light_of, from) in lights.iter_mut().zip(first) {
        let own = from..from + light_of.values().len();
        light_of.set(&own.map(|node| light[of_node[node]]).collect::<Vec<f64>>());
    }
    Ok(lights)
}

/// Solves x = e + K x by Gauss and Seidel: no surface sends more than it gets, so that every step brings it nearer. Places
/// that a body covers stay dark.
fn solved(rows: &[(f64, Vec<(u32, f64)>)]) -> Vec<f64> {
    let mut light: Vec<f64> = rows.iter().map(|(own, _)| if own.is_nan() { 0.0 } else { *own }).collect();
    for _ in 0..1000 {
        let (mut changed, mut largest) = (0.0_f64, 0.0_f64);
        for (node, (own, others)) in rows.iter().enumerate().filter(|(_, (own, _))| !own.is_nan()) {
            let value = own + others.iter().map(|(other, counts)| counts * light[*other as usize]).sum::<f64>();
            changed = changed.max((value - light[node]).abs());
            largest = largest.max(value.abs());
            light[node] = value;
        }
        if changed <= SOLVED * largest {
            break;
        }
    }
    light
}
