//! Obstructions and ground prepared for many skies and suns: daylight coefficients of their surfaces.
//!
//! Weights of the sky's directions and of the surfaces' light on each other depend on the geometry alone and are computed once;
//! the luminance of all surfaces under another sky is then a sum. Light of sunlit surfaces is gathered for every sun, between
//! the exact edges of shadows. Panels are those that suit a uniform sky with a sun in front of the façade; their error under other
//! skies is part of the stated one.

use super::dome::Dome;
use super::equations::{Exchange, Panels, sparse};
use super::faces::{assembled, direct_sun, lights, wanted};
use super::open_ground::OpenGround;
use super::outside::Outside;
use super::scenery::{Setting, scenery};
use super::vista::{Collector, Vista};
use super::{Distribution, Sun};
use crate::compute::direction::Dir;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::surroundings::skyline::Skyline;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::Arc;

/// Spacing of the sky directions that light surfaces. \[rad\]
const SPACING: f64 = 0.1;
/// Moment that the panels are made for: reflectance of the ground; upward and sideward parts of the direction to the sun per
/// part along the façade's normal; direct normal illuminance per horizontal illuminance of the sky.
const TRIAL: [f64; 4] = [0.2, 0.8, 0.3, 3.0];
/// Error of the panels under other skies and suns, relative to the luminance of a surface without the sun's own: several times
/// the mean error in the test of this file.
const OTHERS: f64 = 1e-2;

/// Boxes, building and ground ready for any sky behind the same skyline, any sun and any reflectance of the ground.
pub struct Prepared {
    setting: Setting,
    turn: [f64; 2],
    viewpoints: Vec<DVec3>,
    dome: Dome,
    exchange: Exchange,
    /// Weights at the nodes of the exchange; `None` where a body covers one.
    rows: Vec<Option<Row>>,
    wanted: Vec<usize>,
}

/// Weights of everything that lights a node: projected solid angles. \[sr\]
struct Row {
    /// Directions of the sky.
    sky: Vec<f32>,
    skyline: f64,
    /// Illuminance by surfaces of stated luminance. \[lx\]
    stated: f64,
    /// Ground beyond the panels.
    beyond: f64,
}

/// Luminances of one moment. \[cd/m²\]
struct Moment {
    sky: Vec<f32>,
    skyline: f64,
    beyond: f64,
}

/// A row while it is collected.
struct Gathering<'a> {
    dome: &'a Dome,
    ground: (usize, &'a OpenGround),
    exchange: &'a Panels,
    sky: Vec<f64>,
    by_other: Vec<f64>,
    skyline: f64,
    stated: f64,
    beyond: f64,
}

impl Collector for Gathering<'_> {
    fn sky(&mut self, towards: DVec3, counts: f64) {
        self.dome.spread(towards, |node, share| self.sky[node] += counts * share);
    }

    fn skyline(&mut self, counts: f64) {
        self.skyline += counts;
    }

    fn stated(&mut self, luminance: f64, counts: f64) {
        self.stated += counts * luminance;
    }

    fn place(&mut self, surface: usize, at: [f64; 2], counts: f64) {
        if surface == self.ground.0 && !self.ground.1.holds(at) {
            self.beyond += counts;
            return;
        }
        self.exchange.weigh(surface, at, |node, share| self.by_other[node] += counts * share);
    }

    fn sunlit(&mut self, _: usize, _: f64) {}
}

impl Row {
    /// Returns the illuminance of the node without the light of the exchange. \[lx\]
    fn falling(&self, moment: &Moment) -> f64 {
        let sky: f32 = self.sky.iter().zip(&moment.sky).map(|(counts, luminance)| counts * luminance).sum();
        f64::from(sky) + self.skyline * moment.skyline + self.stated + self.beyond * moment.beyond
    }
}

fn skyline(outside: &Outside) -> Option<&Skyline> {
    outside.surroundings()?.skyline.as_ref()
}

/// Returns sky and sun of the moment that panels are made for.
fn trial(outside: &Outside, [cos, sin]: [f64; 2]) -> (Outside, Sun) {
    let [reflectance, rise, aside, normal] = TRIAL;
    let [right, before] = [DVec3::new(cos, sin, 0.0), DVec3::new(sin, -cos, 0.0)];
    let direction = Dir::new(before + aside * right + rise * DVec3::Z).expect("parts along three axes");
    let sun = Sun { direction, direct_normal: normal };
    let sky = Outside::new(Distribution::uniform(), 1.0)
        .and_then(|sky| sky.with_ground(reflectance, sun.horizontal()))
        .and_then(|sky| sky.with_skyline(outside.skyline_altitude(), 0.0));
    (sky.expect("a uniform sky, and a skyline that is there already"), sun)
}

impl Prepared {
    /// Prepares `setting`, everything in the world's axes. `outside`: only the shape of its skyline counts. `turn`: cosine and
    /// sine of the turn of the room's x axis. `viewpoints`: corners of the apertures. \[m\]
    ///
    /// # Errors
    /// [`Cancelled`] when `progress` says so.
    pub fn new(
        outside: &Outside,
        setting: Setting,
        turn: [f64; 2],
        viewpoints: Vec<DVec3>,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let (sky, sun) = trial(outside, turn);
        let skyline = skyline(outside);
        let lit = direct_sun(&sky, skyline, Some(&sun));
        let tried = scenery(&sky, skyline, lit, &setting, turn);
        let ground = OpenGround::of(&tried, &viewpoints);
        let wanted = wanted(&tried, &viewpoints);
        let panels = Panels::new(lights(&tried, &ground, &wanted, &viewpoints, progress)?);
        // Without a sun every part of a surface is collected, whether it will be sunlit or not.
        let scenery = scenery(&sky, skyline, None, &setting, turn);
        let dome = Dome::new(SPACING);
        let row = |vista: Vista<'_>| {
            let mut all = Gathering {
                dome: &dome,
                ground: (scenery.ground(), &ground),
                exchange: &panels,
                sky: vec![0.0; dome.len()],
                by_other: vec![0.0; panels.places.len()],
                skyline: 0.0,
                stated: 0.0,
                beyond: 0.0,
            };
            vista.collect(&mut all);
            let row = Row {
                sky: all.sky.iter().map(|counts| *counts as f32).collect(),
                skyline: all.skyline,
                stated: all.stated,
                beyond: all.beyond,
            };
            (row, sparse(&all.by_other))
        };
        let found = panels.each(&scenery, progress, row)?;
        let (rows, seen) = found.into_iter().map(Option::unzip).unzip();
        let exchange = Exchange::new(panels, seen);
        Ok(Self { setting, turn, viewpoints, dome, exchange, rows, wanted })
    }

    /// Returns `outside`, which has the same skyline, with boxes and ground before it as sky and sun light them.
    pub fn under(&self, outside: &Outside, sun: Option<&Sun>) -> Outside {
        let skyline = skyline(outside);
        let direct_sun = direct_sun(outside, skyline, sun);
        let scenery = scenery(outside, skyline, direct_sun, &self.setting, self.turn);
        let ground = OpenGround::of(&scenery, &self.viewpoints);
        let moment = Moment {
            sky: self.dome.luminances(outside).into_iter().map(|luminance| luminance as f32).collect(),
            skyline: skyline.map_or(outside.skyline_luminance(), |skyline| skyline.luminance),
            beyond: ground.luminance,
        };
        let places = &self.exchange.panels().places;
        let falling = |(&(surface, [u, v]), row): (&(usize, [f64; 2]), &Option<Row>)| {
            let Some(row) = row else { return 0.0 };
            let vista = || Vista::new(&scenery, surface, scenery.surfaces[surface].face.point(u, v));
            row.falling(&moment) + if direct_sun.is_some() { vista().sunlit() } else { 0.0 }
        };
        let falling: Vec<f64> = places.par_iter().zip(&self.rows).map(falling).collect();
        let mut lights = self.exchange.panels().with(&self.exchange.solved(&scenery, &falling));
        lights.iter_mut().for_each(|light| light.error += OTHERS);
        let around = assembled(&scenery, &ground, lights, &self.wanted, direct_sun.map(|(direction, _)| direction));
        outside.open().behind(Arc::new(around))
    }
}

#[cfg(test)]
mod tests {
    use super::super::faces::surroundings;
    use super::super::scenery::Finish;
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::estimate::Silent;
    use crate::compute::surroundings::Surroundings;
    use crate::compute::surroundings::solid::Solid;
    use std::f64::consts::PI;

    #[test]
    fn boxes_are_lit_as_at_single_moments() {
        let solid = |from, to| Solid::new(DVec3::from_array(from), DVec3::from_array(to), 0.0);
        let setting = Setting {
            boxes: vec![
                (solid([0.0, -1.2, 2.75], [4.0, 0.0, 2.9]), Finish::Reflectance(0.5)),
                (solid([-8.0, -16.0, 0.0], [12.0, -10.0, 9.0]), Finish::Reflectance(0.4)),
                (solid([5.0, -4.0, 0.0], [6.0, -3.0, 5.0]), Finish::Luminance(900.0)),
            ],
            room: solid([0.0; 3], [4.0, 6.0, 3.0]),
            building: Some((solid([-5.0, 0.0, 0.0], [9.0, 12.0, 9.0]), 0.3)),
            ground: 0.0,
        };
        let turn = [1.0, 0.0];
        let eyes: Vec<DVec3> =
            [[0.5, 0.0, 0.9], [3.5, 0.0, 0.9], [3.5, 0.0, 2.7], [0.5, 0.0, 2.7]].map(DVec3::from_array).to_vec();
        let skyline = Skyline::new([[1.0, 0.2], [3.0, 0.3], [3.2, 0.1]], 900.0).unwrap();
        let under = |altitude: f64, bearing: f64, kind: u8, ground: f64| {
            let direction = Dir::from_altitude_bearing(altitude, Bearing::from_degrees(bearing));
            let sun = Sun { direction, direct_normal: if kind == 16 { 0.0 } else { 6e4 } };
            let sky = Outside::new(Distribution::cie(kind, direction).unwrap(), 1.2e4).unwrap();
            let sky = sky.with_ground(ground, sun.horizontal()).unwrap();
            (sky.behind(Arc::new(Surroundings::dark(Vec::new(), Some(skyline.clone())))), sun)
        };
        let (first, _) = under(0.5, 180.0, 16, 0.2);
        let prepared = Prepared::new(&first, setting.clone(), turn, eyes.clone(), &Silent).unwrap();
        let mut most = 0.0_f64;
        for (altitude, bearing, kind, ground) in [
            (0.3, 120.0, 12, 0.2),
            (0.7, 200.0, 12, 0.6),
            (1.0, 250.0, 8, 0.2),
            (0.5, 20.0, 12, 0.2),
            (0.5, 180.0, 16, 0.1),
        ] {
            let (outside, sun) = under(altitude, bearing, kind, ground);
            let found = prepared.under(&outside, Some(&sun));
            let exact =
                surroundings(&outside.open(), Some(&sun), &setting, turn, Some(skyline.clone()), &eyes, &Silent);
            let exact = outside.open().behind(Arc::new(exact.unwrap()));
            let (mut off, mut all) = (0.0, 0.0);
            for k in 0..4000 {
                let (u, v) = ((0.754_877 * f64::from(k)).fract(), (0.569_840 * f64::from(k)).fract());
                let (radius, phi) = (u.sqrt(), 2.0 * PI * v);
                let towards = DVec3::new(radius * phi.cos(), -(1.0 - u).sqrt(), radius * phi.sin());
                let eye = DVec3::new(2.0, 0.0, 1.8);
                let [a, b] = [&found, &exact].map(|one| one.seen_from(eye).luminance(Dir::from_unit(towards)));
                off += (a - b).abs();
                all += b;
            }
            most = most.max(off / all);
        }
        assert!(most < 2e-3, "{most:.2e}");
    }
}
