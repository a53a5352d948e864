//! Light on obstructions and on the ground, of which [`Surroundings`] is made.
//!
//! Every place reflects ρE/π alike in all directions, with E from all that it sees: sky, skyline, sun, and the light of
//! the others. The sun's own light is exact at every point, by a ray, with sharp shadows. The rest is smooth: it is
//! first found on few panels for all surfaces at once, as the solution of a system of linear equations, which holds any
//! number of reflections. Panels of the surfaces seen from the apertures then gather it; they are small where it is
//! steep, and between them the equations are solved once more.

use super::equations::{Exchange, Panels, SparseSum, coarse};
use super::open_ground::OpenGround;
use super::outside::Outside;
use super::received::Views;
use super::scenery::{Scenery, Setting, scenery, share_above};
use super::sun::Sun;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::surroundings::face_light::FaceLight;
use crate::compute::surroundings::shading::shadow_edges;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::{Face, Solid};
use crate::compute::surroundings::{Ground, Line, Surroundings};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Fineness of the panels on which light on surfaces is computed.
pub(super) struct Fineness {
    /// Relative error of the light between nodes above which panels are halved.
    pub between: f64,
    /// Maximum number of panels of all faces together, as far as each has its [`FEWEST`].
    pub most: usize,
}

impl Fineness {
    /// Returns the fineness for a single moment, by the relative error of its results.
    fn of_moment(target: f64) -> Self {
        Self { between: BETWEEN * target, most: MOST_PANELS[usize::from(target >= LOOSE)] }
    }
}

/// Error of the light of surfaces between nodes, as a share of the required error. Chosen: a fifth of the error target,
/// since apertures and room have errors, too; the misfit is part of the stated error, held by
/// `tests/scenes/exchange.rs`.
const BETWEEN: f64 = 0.2;
/// Maximum number of panels of all faces together, for a required error below [`LOOSE`] and from there on. Chosen:
/// cost; the misfit of the panels is part of the stated error.
const MOST_PANELS: [usize; 2] = [300, 60];
/// Required error from which few panels are enough. Chosen: cost; above the default target of 0.01, below that of
/// previews while something is dragged, 0.1.
const LOOSE: f64 = 0.05;
/// Maximum number of panels of a face. Chosen: cost; the misfit of the panels is part of the stated error.
const MOST: usize = 48;
/// Minimum number of panels of a face.
const FEWEST: usize = 1;
/// Maximum length of a ground panel in view, relative to the size of the next body, or to its distance. Source: with
/// panels as long as their distance polynomials of degree 4 gave 1e-4 of a room's light when the reference cases
/// `obstructions` were made; here the degree is 2, and panels are halved further. Held by
/// `tests/scenes/ground.rs::the_ground_under_an_endless_overhang_sees_what_it_leaves_of_the_sky`.
const FINE_GROUND: f64 = 1.0;
/// Minimum height of a viewpoint above the ground in the weights of ground panels. \[m\] Chosen: cost; results change
/// within their stated error.
const LOWEST_EYE: f64 = 0.5;
/// Height below which a place lies in the plane of a face: lengths typed as decimals do not meet exactly. \[m\]
const IN_PLANE: f64 = 1e-6;
/// Relative error of the light on a face in addition to that between its nodes. Source: what a place collects agrees
/// with cubature to 2e-4 in the test `ground_below_a_skyline_gets_what_cubature_finds` of `vista`.
const REST: f64 = 2e-4;
/// Error that remains with the fine panels, as a share of the change that they made. In the white well of
/// `tests/scenes/courts.rs` the few panels are off by half and the fine ones by 1e-4; in its court the fine ones are
/// still off by 4e-3.
const LEFT_OVER: f64 = 0.03;

/// Points that obstructions are seen from, and accuracy of the obstructions' light.
pub struct Viewing<'a> {
    /// Viewpoints in the world's axes. \[m\]
    pub viewpoints: &'a [DVec3],
    /// Required relative error of a result, a part of which is granted to the light of surfaces.
    pub target: f64,
}

/// Computes the surroundings: boxes and ground with the light on them, everything in the world's axes. `outside`: the
/// open sky and ground, with a flat skyline if there is one. `turn`: cosine and sine of the rotation of the room's x
/// axis.
///
/// # Errors
/// Returns [`Cancelled`] if `progress` is cancelled.
pub fn surroundings(
    outside: &Outside,
    sun: Option<&Sun>,
    setting: &Setting,
    turn: [f64; 2],
    skyline: Option<Skyline>,
    viewing: &Viewing<'_>,
    progress: &dyn Progress,
) -> Result<Surroundings, Cancelled> {
    let viewpoints = viewing.viewpoints;
    let direct_sun = direct_sun(outside, skyline.as_ref(), sun);
    let scenery = scenery(outside, skyline.as_ref(), direct_sun, setting, turn);
    let ground = OpenGround::of(&scenery, viewpoints);
    let wanted = wanted(&scenery, viewpoints);
    let fineness = Fineness::of_moment(viewing.target);
    let lights = lights(&scenery, &ground, &wanted, viewpoints, &fineness, progress)?;
    Ok(assembled(&scenery, &ground, lights, &wanted, direct_sun.map(|(direction, _)| direction)))
}

/// Returns the direction towards a sun that is not hidden, and its normal illuminance. \[lx\]
pub(super) fn direct_sun(outside: &Outside, skyline: Option<&Skyline>, sun: Option<&Sun>) -> Option<(DVec3, f64)> {
    let of = |sun: &Sun| (sun.direction.vector(), sun.direct_normal * share_above(outside, skyline, sun));
    sun.map(of).filter(|(_, normal)| *normal > 0.0)
}

/// Returns the surfaces that reflect and are seen: faces of boxes, and the ground.
pub(super) fn wanted(scenery: &Scenery<'_>, viewpoints: &[DVec3]) -> Vec<usize> {
    let building = 6 * (scenery.bodies.len() - 1)..scenery.ground();
    let mut wanted = in_front(scenery, viewpoints, 1e-9);
    wanted.retain(|index| !building.contains(index));
    wanted
}

/// Returns the surfaces that reflect and have a viewpoint in front of them, higher than `height` above their plane.
/// \[m\]
fn in_front(scenery: &Scenery<'_>, viewpoints: &[DVec3], height: f64) -> Vec<usize> {
    let seen = |face: &Face| viewpoints.iter().any(|point| face.normal.dot(*point - face.origin) > height);
    let reflecting = scenery.surfaces.iter().enumerate().filter(|(_, surface)| surface.reflects());
    reflecting.filter(|(_, surface)| seen(&surface.face)).map(|(index, _)| index).collect()
}

/// Returns the surfaces that reflect and lie in the plane of an aperture, as the façade around it: no aperture sees
/// them, but obstructions in front of them return their light.
pub(super) fn beside(scenery: &Scenery<'_>, viewpoints: &[DVec3]) -> Vec<usize> {
    let mut beside = in_front(scenery, viewpoints, -IN_PLANE);
    let wanted = wanted(scenery, viewpoints);
    beside.retain(|index| !wanted.contains(index));
    beside
}

/// Computes the smooth light of all surfaces. Surfaces of `wanted` and those beside an aperture have panels as fine as
/// their light is steep.
pub(super) fn lights(
    scenery: &Scenery<'_>,
    ground: &OpenGround,
    wanted: &[usize],
    viewpoints: &[DVec3],
    fineness: &Fineness,
    progress: &dyn Progress,
) -> Result<Vec<FaceLight>, Cancelled> {
    let mut lights = coarse(scenery, ground, progress)?;
    let (seen, wanted) = (wanted.len(), [wanted, &beside(scenery, viewpoints)].concat());
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
    let most = (fineness.most / wanted.len().max(1)).clamp(FEWEST, MOST);
    let views = Views::new(scenery, ground);
    let done = AtomicUsize::new(0);
    let fitted = wanted.par_iter().enumerate().map(|(number, &index)| {
        // A well stands on the roof around the aperture: its outline is a border there, however few panels there are.
        let start = ground.panels(scenery, index, if number < seen { most } else { MOST }, FINE_GROUND, false);
        let most = start.panels().max(most) + if index == scenery.ground() { MOST } else { 0 };
        let albedo = scenery.surfaces[index].reflectance / PI;
        let light_at = |place: &[f64; 2]| {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            Ok(views.of(index, *place).map_or(f64::NAN, |view| albedo * view.illuminance(&lights)))
        };
        let light =
            start.fitted(fineness.between, most, &weight(index), |places| places.par_iter().map(light_at).collect())?;
        progress.advance("outside", done.fetch_add(1, Ordering::Relaxed) + 1, wanted.len());
        Ok(light)
    });
    let fitted: Vec<FaceLight> = fitted.collect::<Result<_, Cancelled>>()?;
    let before: Vec<f64> = wanted.iter().zip(&fitted).map(|(index, light)| light.mean(&weight(*index))).collect();
    // Light is reflected between these panels; other surfaces keep what the few panels gave them.
    let mut all: Vec<FaceLight> = lights.iter().map(|_| FaceLight::even(0.0)).collect();
    let mut others: Vec<Option<&FaceLight>> = lights.iter().map(Some).collect();
    for (index, light) in wanted.iter().zip(fitted) {
        (all[*index], others[*index]) = (light, None);
    }
    let panels = Panels::new(all);
    let rows = panels.places.par_iter().map_init(
        || SparseSum::new(panels.places.len()),
        |sum, (surface, at)| {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            Ok(views.of(*surface, *at).map(|view| view.by_node(&panels, &others, sum)))
        },
    );
    let rows: Vec<Option<_>> = rows.collect::<Result<_, Cancelled>>()?;
    let (rest, seen): (Vec<_>, Vec<_>) = rows.into_iter().map(Option::unzip).unzip();
    let exchange = Exchange::new(panels, seen);
    let falling: Vec<f64> = rest.into_iter().map(Option::unwrap_or_default).collect();
    let mut solved = exchange.panels().with(&exchange.solved(scenery, &falling));
    for (index, before) in wanted.iter().zip(before) {
        let light = &mut solved[*index];
        let after = light.mean(&weight(*index));
        let change = if after > 0.0 { ((after - before) / after).abs() } else { 0.0 };
        light.error = REST + LEFT_OVER * change;
        std::mem::swap(&mut lights[*index], light);
    }
    Ok(lights)
}

/// Returns the surroundings: boxes and ground with known smooth light, and the sun's own.
pub(super) fn assembled(
    scenery: &Scenery<'_>,
    ground: &OpenGround,
    mut lights: Vec<FaceLight>,
    wanted: &[usize],
    sun: Option<DVec3>,
) -> Surroundings {
    for (light, surface) in lights.iter_mut().zip(&scenery.surfaces) {
        light.sun = surface.sun;
    }
    let lines = lines(scenery, wanted, sun);
    let of_ground = lights.pop().filter(|light| light.is_lit());
    let ground = of_ground.map(|light| Ground {
        face: scenery.surfaces[scenery.ground()].face,
        light,
        limits: ground.limits,
        open: ground.luminance,
    });
    let boxes = scenery.bodies.len() - 1;
    Surroundings {
        faces: lights.chunks_exact(6).take(boxes).map(|six| std::array::from_fn(|k| six[k].clone())).collect(),
        solids: scenery.bodies[..boxes].to_vec(),
        building: scenery.bodies[boxes],
        shades_ground: scenery.from_ground > boxes,
        ground,
        sun,
        lines,
        skyline: scenery.skyline.cloned(),
    }
}

/// Returns the lines at which the luminance jumps beside the bodies' own edges: edges of shadows, and lines in which
/// faces of overlapping boxes meet.
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

/// Returns the lines in which faces of overlapping boxes meet: borders in view that are edges of neither box.
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
