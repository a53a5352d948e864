//! V·T·D of one aperture: columns for the sky by patch, one for the ground, one for the skyline; and the outside that
//! is seen straight through, by directions of every sensor's own.

use super::described::{Described, DescribedViews};
use super::far::{self, Constants};
use super::sun_way::SunWay;
use super::transport::{self, ACROSS, Transport};
use super::views::{Views, Want};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{AngularTransmittance, Btdf};
use crate::compute::direction::{Dir, World};
use crate::compute::dot::dot;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::Facing;
use crate::compute::quadrature::{Tolerance, gauss_legendre};
use crate::compute::room::through;
use crate::compute::sky::{Frame, Outside, SkySamples, incident_illuminances_within};
use crate::compute::system::measure::Side;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::Session;
use crate::study::session::responses::Responses;
use crate::study::session::sky_year::SkyYear;
use crate::study::system::VerySystem;
use glam::DVec3;
use rayon::prelude::*;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

/// Accuracy of the constant columns.
const RELATIVE: f64 = 1e-7;

/// One aperture.
pub(super) struct AperturePart {
    patches: RingBasis,
    frame: Frame,
    samples: SkySamples,
    /// Of the samples.
    fingerprint: u64,
    /// What they are in the hours of a year, where that is kept.
    year: Option<Arc<SkyYear>>,
    /// Illuminance through every patch of `samples` by a ground of luminance 1.
    by_ground: Vec<f64>,
    /// Sensor by sensor, a column for every patch of `samples`, one for the ground and one for the skyline: all
    /// diffuse light but what is seen straight through.
    total: Vec<f64>,
    reflected: Vec<f64>,
    doubtful: Vec<f64>,
    interpolated: Vec<f64>,
    /// What the system does with light.
    pub transport: Transport,
    /// The regular part.
    pub regular: Option<AngularTransmittance>,
    /// How the very sun comes through.
    pub sun: SunWay,
    seen: Vec<SensorView>,
    /// The luminances that the sensors see in the hours of a year, where they are kept.
    seen_year: Option<Arc<SkyYear>>,
    /// Mean relative gap of flux of the regular part.
    pub gap: f64,
    /// Share of the light that frame and dirt leave.
    pub clear: f64,
}

/// The outside as one sensor sees it straight through.
#[derive(Default)]
struct SensorView {
    directions: Vec<(Dir<World>, f64)>,
    ground: f64,
    skyline: f64,
}

/// How the light of a sky is found.
#[derive(Clone, Copy)]
pub(super) enum Way<'a> {
    /// By the fixed directions.
    Fixed,
    /// The same for an hour of the year that is kept.
    Hour(usize),
    /// By integrals; with a session they are kept.
    Exact(Option<&'a Session>),
}

/// What one sky gives, sensor by sensor.
pub(super) struct Sums {
    /// All.
    pub total: Vec<f64>,
    /// Interreflected.
    pub reflected: Vec<f64>,
    /// Doubt of that.
    pub doubtful: Vec<f64>,
    /// Doubt of the interpolation, signed.
    pub interpolated: Vec<f64>,
}

impl AperturePart {
    pub fn new(
        session: &Session,
        scene: &Scene,
        index: usize,
        btdf: &Btdf,
        room: Option<&Responses>,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let sensors = scene.sensors.len();
        let facing = scene.facing(index);
        let frame = Frame::of_aperture(scene.orientation, facing.surface);
        let altitude = scene.outside.skyline_altitude();
        let very = scene.apertures[index].system.very.as_ref().filter(|_| scene.beams);
        let described = very.map(|very| described_views(session, scene, index, very, room, progress)).transpose()?;
        let by_description = match (very, &described) {
            (Some(very), Some(views)) if very.answers_for_the_sky() => {
                let through = session.sky_through(very);
                Some(Described::new(&through.1, views))
            }
            _ => None,
        };
        // What the description answers for is not asked of the data, which need not be there.
        let nothing = Btdf::default();
        let btdf = if by_description.is_some() { &nothing } else { btdf };
        let (patches, spacing, transport) = match by_description {
            Some(own) => (RingBasis::clone(&own.basis), transport::SPACING, Transport::Described(Box::new(own))),
            None => {
                let (patches, spacing) = transport::patches(btdf, scene.interpolation);
                (patches, spacing, Transport::new(session, scene, index, btdf, room, progress)?)
            }
        };
        let mut samples = SkySamples::new(&patches, &frame, altitude, spacing);
        let constants = Constants::of(&scene.outside);
        if let (Some(even), Some(skyline)) = (&constants.even, far::shape(&scene.outside)) {
            let open = illuminances(even, &patches, &frame, RELATIVE);
            let open: Vec<f64> = samples.cells().iter().map(|&cell| open[cell]).collect();
            samples.without(|d| skyline.covers(d), &open);
        }
        let by_angle = match &transport {
            Transport::Described(own) => own.by_angle.clone(),
            _ => None,
        };
        let very = very.cloned().zip(described).map(|(very, views)| (very, views, by_angle));
        let sun = SunWay::new(session, scene, index, btdf, very, room, progress)?;
        // What goes straight to the sensors is left to `seen`: here is what the room makes of that light.
        let straight = match (&btdf.regular, room) {
            (Some(tau), Some(room)) => {
                let basis = Arc::new(patches.clone());
                let views = Views::new(session, scene, index, basis, Some(room), Want::Reflected, progress)?;
                Some((tau, views))
            }
            _ => None,
        };
        let across = gauss_legendre(ACROSS);
        let columns: Vec<transport::Column> = (0..patches.len())
            .into_par_iter()
            .map(|p| {
                let cell = patches.cell(p);
                let mut column = transport.through_patch(p, &cell, sensors);
                if let Some((tau, views)) = &straight {
                    // What goes straight leaves by the patch that it came through, as a luminance even over it.
                    let passed = tau.ring_mean(cell.theta_min, cell.theta_max, &across);
                    views.add(p, passed / cell.projected_solid_angle(), &mut column.light);
                }
                column
            })
            .collect();
        // Both are even, whatever the sky: summed over all patches now, a new sky needs their two luminances alone.
        let [ground, skyline] = [&constants.ground, &constants.skyline].map(|outside| {
            outside.as_ref().map_or_else(|| vec![0.0; patches.len()], |o| illuminances(o, &patches, &frame, RELATIVE))
        });
        // Patches wholly under the horizon hold ground and skyline only, and need no column of the sky.
        let open = samples.cells();
        let width = open.len() + 2;
        // Only lobes between directions are in doubt of their interpolation: others save the fourth table.
        let doubts = columns.iter().any(|column| !column.doubt.is_empty());
        let mut tables: Vec<Vec<f64>> =
            (0..4).map(|k| if k < 3 || doubts { vec![0.0; sensors * width] } else { Vec::new() }).collect();
        for (k, table) in tables.iter_mut().enumerate() {
            for (s, row) in table.chunks_exact_mut(width).enumerate() {
                let of =
                    |column: &transport::Column| if k < 3 { column.light[k * sensors + s] } else { column.doubt[s] };
                for (to, &p) in row.iter_mut().zip(open) {
                    *to = of(&columns[p]);
                }
                row[width - 2] = columns.iter().zip(&ground).map(|(column, e)| of(column) * e).sum();
                row[width - 1] = columns.iter().zip(&skyline).map(|(column, e)| of(column) * e).sum();
            }
        }
        let interpolated = tables.pop().unwrap_or_default();
        let doubtful = tables.pop().unwrap_or_default();
        let reflected = tables.pop().unwrap_or_default();
        let total = tables.pop().unwrap_or_default();
        // Through an opening every sensor sees another part of the sky, with sharp borders: patches would blur them.
        let seen = match &btdf.regular {
            Some(tau) => {
                let view = |sensor| SensorView::new(scene, index, sensor, tau, &constants);
                scene.sensors.par_iter().map(view).collect()
            }
            None => Vec::new(),
        };
        Ok(Self {
            by_ground: open.iter().map(|&p| ground[p]).collect(),
            patches,
            frame,
            fingerprint: samples.fingerprint(),
            year: None,
            samples,
            total,
            reflected,
            doubtful,
            interpolated,
            transport,
            sun,
            regular: btdf.regular.clone(),
            seen,
            seen_year: None,
            gap: straight.map_or(0.0, |(_, views)| views.gap),
            clear: scene.apertures[index].clear,
        })
    }

    /// May the sun come on as beams?
    pub fn sends_beams(&self) -> bool {
        self.regular.is_some() || !matches!(self.sun, SunWay::Data)
    }

    /// Number of luminances that a new sky costs.
    pub fn evaluations(&self) -> usize {
        self.samples.len() + self.seen.iter().map(|seen| seen.directions.len()).sum::<usize>()
    }

    /// Keeps in `session` what the hours of a year are on its patches; `year`: its number, and how many hours it has.
    pub fn keep_year(&mut self, session: &Session, year: (u64, usize)) {
        self.year = session.sky_year(year, self.fingerprint, self.samples.cells().len());
        let mut hasher = DefaultHasher::new();
        let seen = self.seen.iter().flat_map(|seen| &seen.directions);
        seen.clone().for_each(|(d, _)| d.vector().to_array().map(f64::to_bits).hash(&mut hasher));
        self.seen_year = session.seen_year(year, hasher.finish(), seen.count());
    }

    /// Illuminance through every patch, then the luminances of ground and skyline.
    fn light(&self, outside: &Outside, way: Way<'_>) -> Vec<f64> {
        let mut e = Vec::with_capacity(self.samples.cells().len() + 2);
        match (way, &self.year) {
            (Way::Hour(hour), Some(year)) => {
                let find = || {
                    let mut e = Vec::new();
                    self.samples.illuminances(outside, &mut e);
                    e
                };
                e.extend(year.hour(hour, find));
            }
            (Way::Fixed | Way::Hour(_), _) => self.samples.illuminances(outside, &mut e),
            (Way::Exact(session), _) => {
                let find = || illuminances(outside, &self.patches, &self.frame, EXACT);
                let all = session.map_or_else(|| Arc::new(find()), |s| s.exact_sky(outside, self.fingerprint, find));
                let ground = outside.ground_luminance();
                e.extend(self.samples.cells().iter().zip(&self.by_ground).map(|(&p, g)| all[p] - ground * g));
            }
        }
        let smooth = !matches!(way, Way::Exact(_));
        e.push(outside.ground_luminance());
        e.push(if smooth { far::luminance(outside) } else { 0.0 });
        e.iter_mut().for_each(|e| *e *= self.clear);
        e
    }

    /// Adds the diffuse light to what every sensor has.
    pub fn add(&self, scene: &Scene, index: usize, outside: &Outside, way: Way<'_>, out: &mut [f64]) {
        let light = self.light(outside, way);
        for (sum, row) in out.iter_mut().zip(self.total.chunks_exact(light.len())) {
            *sum += dot(row, &light);
        }
        self.add_seen(scene, index, outside, way, out);
    }

    fn add_seen(&self, scene: &Scene, index: usize, outside: &Outside, way: Way<'_>, out: &mut [f64]) {
        let Some(tau) = &self.regular else { return };
        if !matches!(way, Way::Exact(_)) {
            let find = || {
                let all = self.seen.iter().flat_map(|seen| &seen.directions);
                all.map(|(d, _)| outside.luminance(*d)).collect::<Vec<f64>>()
            };
            let luminances: Vec<f64> = match (way, &self.seen_year) {
                (Way::Hour(hour), Some(year)) => year.hour(hour, find).collect(),
                _ => find(),
            };
            let mut luminances = luminances.as_slice();
            for (sum, seen) in out.iter_mut().zip(&self.seen) {
                let (own, others) = luminances.split_at(seen.directions.len());
                luminances = others;
                let sky: f64 = seen.directions.iter().zip(own).map(|((_, weight), luminance)| weight * luminance).sum();
                let seen = sky + seen.ground * outside.ground_luminance() + seen.skyline * far::luminance(outside);
                *sum += self.clear * seen;
            }
        } else {
            let exact: Vec<Estimate> = scene
                .sensors
                .par_iter()
                .map(|sensor| seen_exactly(scene, index, sensor, tau, outside, EXACT))
                .collect();
            out.iter_mut().zip(exact).for_each(|(sum, e)| *sum += self.clear * e.value);
        }
    }

    /// The same with all that its error needs.
    pub fn add_sums(&self, scene: &Scene, index: usize, outside: &Outside, way: Way<'_>, sums: &mut Sums) {
        let light = self.light(outside, way);
        for (to, table) in [
            (&mut sums.total, &self.total),
            (&mut sums.reflected, &self.reflected),
            (&mut sums.doubtful, &self.doubtful),
            (&mut sums.interpolated, &self.interpolated),
        ] {
            to.iter_mut().zip(table.chunks_exact(light.len())).for_each(|(sum, row)| *sum += dot(row, &light));
        }
        self.add_seen(scene, index, outside, way, &mut sums.total);
    }
}

/// What the sensors see of a system known by its description.
fn described_views(
    session: &Session,
    scene: &Scene,
    index: usize,
    very: &VerySystem,
    room: Option<&Responses>,
    progress: &dyn Progress,
) -> Result<DescribedViews, StudyError> {
    let normal = Dir::from_unit(DVec3::Z);
    let bands = very.0.profile_light(normal, Side::Front).map(|light| (light.upright, light.q.len()));
    DescribedViews::new(session, scene, index, bands, room, progress)
}

/// Accuracy of what is not done by fixed directions.
const EXACT: f64 = 1e-5;

impl SensorView {
    fn new(
        scene: &Scene,
        index: usize,
        sensor: &crate::compute::room::direct::Sensor,
        tau: &AngularTransmittance,
        constants: &Constants,
    ) -> Self {
        let facing = scene.facing(index);
        let Some(view) = scene.apertures[index].aperture.view(sensor.position, sensor.normal) else {
            return Self::default();
        };
        let altitude = scene.outside.skyline_altitude();
        let mut directions: Vec<(Dir<World>, f64)> = through::samples(&view, facing.surface, altitude, tau, POINTS)
            .into_iter()
            .map(|(d, weight)| (scene.orientation.world_from_room(d), weight))
            .collect();
        let exact = |outside: &Option<Outside>| {
            outside.as_ref().map_or(0.0, |o| seen_exactly(scene, index, sensor, tau, o, RELATIVE).value)
        };
        if let Some(skyline) = far::shape(&scene.outside) {
            let open = exact(&constants.even);
            let free = |(d, _): &(Dir<World>, f64)| !skyline.covers(d.vector());
            // Of an opening of which but a corner shows sky, between the directions, they stand for it.
            if directions.iter().any(free) {
                directions.retain(free);
            }
            let kept: f64 = directions.iter().map(|(_, weight)| weight).sum();
            directions.iter_mut().for_each(|(_, weight)| *weight *= if kept > 0.0 { open / kept } else { 0.0 });
        }
        let [ground, skyline] = [&constants.ground, &constants.skyline].map(exact);
        Self { directions, ground, skyline }
    }
}

/// Gauss points along each side of a piece of what a sensor sees straight through, at least.
const POINTS: usize = 4;

fn illuminances(outside: &Outside, basis: &RingBasis, frame: &Frame, relative: f64) -> Vec<f64> {
    incident_illuminances_within(outside, basis, frame, relative).into_iter().map(|e| e.value).collect()
}

/// The outside through the opening, integrated for one sensor.
fn seen_exactly(
    scene: &Scene,
    index: usize,
    sensor: &crate::compute::room::direct::Sensor,
    tau: &AngularTransmittance,
    outside: &Outside,
    relative: f64,
) -> Estimate {
    let Some(view) = scene.apertures[index].aperture.view(sensor.position, sensor.normal) else {
        return Estimate::default();
    };
    let scale = outside.diffuse_horizontal().max(outside.ground_luminance()).max(outside.skyline_luminance());
    let tolerance = Tolerance { absolute: 1e-3 * relative * scale, relative, max_pieces: 4000 };
    through::illuminance(&view, &Facing { outside, ..scene.facing(index) }, tau, tolerance)
}
