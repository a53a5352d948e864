//! The view out of a room from its points (EN 17037, 5.2): sight angle, distance, layers. Geometry alone.

use crate::compute::direction::Surface;
use crate::compute::room::aperture::Aperture;
use glam::DVec3;

/// Eye height of a seated person (EN 17037). \[m\]
pub const EYE_HEIGHT: f64 = 1.2;
/// Share of the points of a room from which a level of view out has to be reached (EN 17037).
pub const SHARE: f64 = 0.75;
/// Levels of view out by EN 17037: name, minimum horizontal sight angle \[rad\], minimum distance \[m\], minimum number
/// of layers.
pub const LEVELS: [(&str, f64, f64, usize); 3] = [
    ("minimum", 14.0 * std::f64::consts::PI / 180.0, 6.0, 1),
    ("medium", 28.0 * std::f64::consts::PI / 180.0, 20.0, 2),
    ("high", 54.0 * std::f64::consts::PI / 180.0, 50.0, 3),
];
/// Number of horizontal rays through the sight angle; the distance is their median. Chosen: 2° or less from ray to ray;
/// held by the test `what_stands_before_it_is_as_far_as_it_is`.
const RAYS: usize = 90;
/// Number of rays along each side of an opening by which layers are found. Chosen: cost; a layer on less than 1/24 of
/// the opening's height may be missed. No test depends on its exact value.
const SIDE: usize = 24;

/// Object that a line of sight meets outside the room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Met {
    /// Sky: the ray points above the horizon and meets no obstruction.
    Sky,
    /// Ground: the ray points below the horizon and meets no obstruction.
    Ground,
    /// Obstruction, with its distance from the eye \[m\]; `None` where the distance is not known, e.g. that of a
    /// skyline.
    Thing(Option<f64>),
}

/// View out through the openings of a façade from one point of the room, by the criteria of EN 17037.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ViewOut {
    /// Horizontal sight angle: sum of the angles under which the openings of the façade are seen, overlaps counted
    /// once. \[rad\]
    pub sight_angle: f64,
    /// Outside distance of the view: half of the sight angle sees at least so far. \[m\] Infinite without obstructions.
    /// `None` if the scene does not specify the distance of what is seen, or if there is no view.
    pub distance: Option<f64>,
    /// Whether the layer of sky is seen.
    pub sky: bool,
    /// Whether the layer of landscape is seen: the horizon, or an obstruction in front of it.
    pub landscape: bool,
    /// Whether the layer of ground is seen.
    pub ground: bool,
}

impl ViewOut {
    /// Computes the view from a point in the room's axes \[m\] through `apertures`; `met` returns the object that a ray
    /// from the point in a unit direction of the same axes meets outside.
    pub fn of(point: DVec3, apertures: &[Aperture], met: impl Fn(DVec3) -> Met) -> Self {
        let mut view = Self::default();
        let mut spans = Vec::new();
        for aperture in apertures.iter().filter(|one| one.surface == Surface::Facade && point.y > one.corner.y) {
            let away = point.y - aperture.corner.y;
            let [left, right] = [0.0, aperture.size[0]].map(|x| (aperture.corner.x + x - point.x).atan2(away));
            spans.push([left, right]);
            let middle = |size: f64, k: usize| size * (k as f64 + 0.5) / SIDE as f64;
            for at in 0..SIDE * SIDE {
                let (x, z) = (middle(aperture.size[0], at % SIDE), middle(aperture.size[1], at / SIDE));
                let Some(ray) = (aperture.corner + DVec3::new(x, 0.0, z) - point).try_normalize() else { continue };
                match met(ray) {
                    Met::Sky => view.sky = true,
                    Met::Ground => view.ground = true,
                    Met::Thing(_) => view.landscape = true,
                }
            }
            // The horizon itself is between two rays.
            view.landscape |= (aperture.corner.z..aperture.corner.z + aperture.size[1]).contains(&point.z);
        }
        let spans = merged(spans);
        view.sight_angle = spans.iter().map(|[from, to]| to - from).sum();
        let mut distances = Vec::new();
        for [from, to] in spans {
            let count = ((RAYS as f64 * (to - from) / view.sight_angle.max(f64::MIN_POSITIVE)).ceil() as usize).max(1);
            for k in 0..count {
                let angle = from + (to - from) * (k as f64 + 0.5) / count as f64;
                distances.push(match met(DVec3::new(angle.sin(), -angle.cos(), 0.0)) {
                    Met::Thing(distance) => distance,
                    Met::Sky | Met::Ground => Some(f64::INFINITY),
                });
            }
        }
        // What is not known may be near.
        distances.sort_by(|a, b| a.unwrap_or(0.0).total_cmp(&b.unwrap_or(0.0)));
        view.distance = distances.get(distances.len() / 2).copied().flatten();
        view
    }

    /// Returns the number of layers seen, 0 to 3: sky, landscape, ground.
    pub fn layers(&self) -> usize {
        [self.sky, self.landscape, self.ground].into_iter().filter(|seen| *seen).count()
    }

    /// Returns the name of the highest of [`LEVELS`] that sight angle, distance and layers reach together; the lowest
    /// requires the landscape. `None` where none is reached, or where the distance is not known.
    pub fn level(&self) -> Option<&'static str> {
        let distance = self.distance.filter(|_| self.landscape)?;
        LEVELS
            .iter()
            .rev()
            .find(|(_, angle, far, layers)| self.sight_angle >= *angle && distance >= *far && self.layers() >= *layers)
            .map(|(name, ..)| *name)
    }
}

/// Returns the sight angle, distance and layers that are reached from at least [`SHARE`] of the points whose views are
/// given, each of these figures separately.
pub fn from_most(views: &[ViewOut]) -> ViewOut {
    // So many points from the best down are enough.
    let rank = (SHARE * views.len() as f64 - 1e-9).ceil() as usize;
    let Some(last) = rank.checked_sub(1) else { return ViewOut::default() };
    let sorted = |mut values: Vec<f64>| {
        values.sort_by(|a, b| b.total_cmp(a));
        values[last]
    };
    let most = |seen: fn(&ViewOut) -> bool| views.iter().filter(|view| seen(view)).count() >= rank;
    let known = views.iter().filter(|view| view.distance.is_some()).count() >= rank;
    ViewOut {
        sight_angle: sorted(views.iter().map(|view| view.sight_angle).collect()),
        distance: known.then(|| sorted(views.iter().map(|view| view.distance.unwrap_or(0.0)).collect())),
        sky: most(|view| view.sky),
        landscape: most(|view| view.landscape),
        ground: most(|view| view.ground),
    }
}

/// Merges overlapping spans of horizontal angle \[rad\] into disjoint ones.
fn merged(mut spans: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut all: Vec<[f64; 2]> = Vec::new();
    for span in spans {
        match all.last_mut() {
            Some(last) if span[0] <= last[1] => last[1] = last[1].max(span[1]),
            _ => all.push(span),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(x: f64, width: f64) -> Aperture {
        Aperture { surface: Surface::Facade, corner: DVec3::new(x, 0.0, 0.9), size: [width, 1.8] }
    }

    fn open(ray: DVec3) -> Met {
        if ray.z < 0.0 { Met::Ground } else { Met::Sky }
    }

    #[test]
    fn angles_are_those_of_the_plan_and_overlaps_count_once() {
        let eye = DVec3::new(2.5, 4.0, EYE_HEIGHT);
        let view = ViewOut::of(eye, &[window(0.5, 4.0)], open);
        assert!((view.sight_angle - 2.0 * 0.5_f64.atan()).abs() < 1e-12);
        assert_eq!((view.layers(), view.distance, view.level()), (3, Some(f64::INFINITY), Some("medium")));
        let two = ViewOut::of(eye, &[window(0.5, 2.5), window(2.0, 2.5)], open);
        assert!((two.sight_angle - view.sight_angle).abs() < 1e-12);
        let apart = ViewOut::of(eye, &[window(0.5, 1.0), window(3.5, 1.0)], open);
        assert!((apart.sight_angle - 2.0 * (0.5_f64.atan() - 0.25_f64.atan())).abs() < 1e-12);
        // A high strip shows the sky alone: no view by the standard.
        let strip = Aperture { corner: DVec3::new(0.5, 0.0, 2.0), ..window(0.5, 4.0) };
        let high = ViewOut::of(eye, &[strip], open);
        assert_eq!((high.sky, high.landscape, high.ground, high.level()), (true, false, false, None));
    }

    #[test]
    fn what_stands_before_it_is_as_far_as_it_is() {
        // A wall 10 m in front of the façade, 4 m high.
        let eye = DVec3::new(2.5, 4.0, EYE_HEIGHT);
        let wall = |ray: DVec3| {
            let distance = 14.0 / -ray.y;
            let height = EYE_HEIGHT + distance * ray.z;
            if (0.0..4.0).contains(&height) { Met::Thing(Some(distance)) } else { open(ray) }
        };
        let view = ViewOut::of(eye, &[window(0.5, 4.0)], wall);
        let median = 14.0 / (0.5 * 0.5_f64.atan()).cos();
        assert!((view.distance.unwrap() - median).abs() < 0.05 && view.landscape);
        assert_eq!(view.level(), Some("minimum"));
        let unknown = ViewOut::of(eye, &[window(0.5, 4.0)], |_| Met::Thing(None));
        assert_eq!((unknown.distance, unknown.level()), (None, None));
    }

    #[test]
    fn three_of_four_points_are_enough() {
        let of = |sight_angle: f64| ViewOut { sight_angle, distance: Some(30.0), ..ViewOut::default() };
        let all = from_most(&[of(0.1), of(0.4), of(0.5), of(0.6)]);
        assert_eq!((all.sight_angle, all.distance), (0.4, Some(30.0)));
        assert_eq!(from_most(&[]), ViewOut::default());
    }
}
