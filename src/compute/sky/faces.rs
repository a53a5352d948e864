//! Illuminance and luminance of the faces of obstructions and of the ground, from which [`Surroundings`] are created.
//!
//! Every point reflects diffusely with the luminance ρE/π; E is its illuminance by sky, skyline, sun and the other
//! surfaces. The part directly reflected from the sun is exact at every point, by a ray, with sharp shadows. The other
//! part is smooth: it is first computed on few panels of all surfaces together, as the solution of a system of linear
//! equations, which includes any number of reflections. The panels of the surfaces seen from the apertures are then
//! refined where the luminance changes steeply, and the equations are solved once more between them.

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

/// Fineness of the panels on which the smooth luminance of surfaces is computed.
pub(super) struct Fineness {
    /// Relative error of the interpolated luminance between nodes above which panels are halved.
    pub between: f64,
    /// Maximum number of panels of all faces together; each face has at least [`FEWEST`].
    pub most: usize,
}

impl Fineness {
    /// Returns the fineness for a single date and time; `target`: required relative error of the results.
    fn of_moment(target: f64) -> Self {
        Self { between: BETWEEN * target, most: MOST_PANELS[usize::from(target >= LOOSE)] }
    }
}

/// Error of the luminance of surfaces between nodes, as a share of the required error. Chosen: a fifth of the error
/// target, since apertures and room have errors, too; the misfit is part of the stated error, held by
/// `tests/scenes/exchange.rs`.
const BETWEEN: f64 = 0.2;
/// Maximum number of panels of all faces together, for a required error below [`LOOSE`], and for others. Chosen: cost;
/// the misfit of the panels is part of the stated error.
const MOST_PANELS: [usize; 2] = [300, 60];
/// Required error from which few panels are enough. Chosen: cost; above the default target of 0.01, below that of
/// previews during dragging in the window, 0.1.
const LOOSE: f64 = 0.05;
/// Maximum number of panels of one face. Chosen: cost; the misfit of the panels is part of the stated error.
const MOST: usize = 48;
/// Minimum number of panels of one face.
const FEWEST: usize = 1;
/// Maximum length of a ground panel in view, relative to the size of the next body, or to its distance. Source: with
/// panels as long as their distance polynomials of degree 4 gave 1e-4 of a room's light when the reference cases
/// `obstructions` were made; here the degree is 2, and panels are halved further. Held by
/// `tests/scenes/ground.rs::the_ground_under_an_endless_overhang_sees_what_it_leaves_of_the_sky`.
const FINE_GROUND: f64 = 1.0;
/// Minimum height of a viewpoint above the ground in the weights of ground panels. \[m\] Chosen: cost; results change
/// within their stated error.
const LOWEST_EYE: f64 = 0.5;
/// Height above the plane of a face up to which a point counts as in it, because lengths typed as decimals do not meet
/// exactly. \[m\]
const IN_PLANE: f64 = 1e-6;
/// Relative error of the luminance of a face in addition to that between its nodes. Source: the illuminance at a point
/// agrees with cubature to 2e-4 in the test `ground_below_a_skyline_gets_what_cubature_finds` of `vista`.
const REST: f64 = 2e-4;
/// Relative error that remains with the fine panels, as a share of the change between the coarse and the fine panels.
/// In the white well of `tests/scenes/courts.rs` the few panels are off by half and the fine ones by 1e-4; in its court
/// the fine ones are still off by 4e-3.
const LEFT_OVER: f64 = 0.03;

/// Points from which obstructions are seen, and the required accuracy, for the computation of the obstructions'
/// luminances.
pub struct Viewing<'a> {
    /// Points from which obstructions are seen (corners of the apertures), in the world's axes relative to the room's
    /// origin. \[m\]
    pub viewpoints: &'a [DVec3],
    /// Required relative error of a result of the scene; a fifth of it is allowed for the luminances of surfaces.
    pub target: f64,
}

/// Computes the surroundings for one date and time: boxes and ground with their luminances, in the world's axes.
/// `outside`: unobstructed sky and ground, with a flat skyline if there is one; `setting`: geometry and reflectances of
/// the obstructions; `turn`: cosine and sine of the angle from east to the room's x axis; `skyline`: skyline by
/// bearing.
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

/// Returns the direction towards the sun, world frame, and its normal illuminance \[lx\] by the part of the disc above
/// horizon and skyline; `None` if nothing of it is visible.
pub(super) fn direct_sun(outside: &Outside, skyline: Option<&Skyline>, sun: Option<&Sun>) -> Option<(DVec3, f64)> {
    let of = |sun: &Sun| (sun.direction.vector(), sun.direct_normal * share_above(outside, skyline, sun));
    sun.map(of).filter(|(_, normal)| *normal > 0.0)
}

/// Returns the indices of the surfaces that reflect light and are seen from a viewpoint: faces of boxes, and the
/// ground.
pub(super) fn wanted(scenery: &Scenery<'_>, viewpoints: &[DVec3]) -> Vec<usize> {
    let building = 6 * (scenery.bodies.len() - 1)..scenery.ground();
    let mut wanted = in_front(scenery, viewpoints, 1e-9);
    wanted.retain(|index| !building.contains(index));
    wanted
}

/// Returns the indices of the surfaces that reflect light and have a viewpoint in front of them, more than `height`
/// above their plane. \[m\]
fn in_front(scenery: &Scenery<'_>, viewpoints: &[DVec3], height: f64) -> Vec<usize> {
    let seen = |face: &Face| viewpoints.iter().any(|point| face.normal.dot(*point - face.origin) > height);
    let reflecting = scenery.surfaces.iter().enumerate().filter(|(_, surface)| surface.reflects());
    reflecting.filter(|(_, surface)| seen(&surface.face)).map(|(index, _)| index).collect()
}

/// Returns the indices of the surfaces that reflect light and lie in the plane of an aperture, for instance the façade
/// around it: no aperture sees them, but obstructions in front of them return their light.
pub(super) fn beside(scenery: &Scenery<'_>, viewpoints: &[DVec3]) -> Vec<usize> {
    let mut beside = in_front(scenery, viewpoints, -IN_PLANE);
    let wanted = wanted(scenery, viewpoints);
    beside.retain(|index| !wanted.contains(index));
    beside
}

/// Computes the luminance of all surfaces without the part directly reflected from the sun. The surfaces `wanted` and
/// those beside an aperture have panels that are refined where the luminance changes steeply.
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
    // Points of the ground are weighted by the solid angle under which they are seen, so that near ones count most.
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
        // A well stands on the roof around the aperture: its outline must be a border of panels on the roof, whatever
        // their number.
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
    // Reflections are solved between these panels; other surfaces keep their luminances from the coarse solution.
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

/// Returns the surroundings: boxes and ground with the given smooth luminances, and the part directly reflected from
/// the sun. `wanted`: indices of the surfaces that are seen; `sun`: direction towards the sun.
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

/// Returns the lines on surfaces, apart from edges of bodies, at which the luminance is discontinuous: edges of
/// shadows, and lines in which faces of overlapping boxes meet.
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

/// Returns the lines in which faces of overlapping boxes meet, which are edges of neither box.
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
