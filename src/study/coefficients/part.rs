//! V·T·D of one aperture: columns for the sky by patch, one for the ground, one for the skyline; and the outside that
//! is seen straight through, by directions of every sensor's own.

use super::described::{Described, DescribedViews};
use super::straight::{StraightView, seen_exactly};
use super::sun_way::SunWay;
use super::transport::{self, ACROSS, Transport};
use super::views::{Views, Want};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{AngularTransmittance, Btdf};
use crate::compute::direction::Dir;
use crate::compute::dot::add_scaled;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::quadrature::gauss_legendre;
use crate::compute::sky::Outside;
use crate::compute::system::measure::Side;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::Session;
use crate::study::session::far::{self, Constants};
use crate::study::session::responses::Responses;
use crate::study::session::sky_patches::{SkyPatches, illuminances};
use crate::study::session::sky_year::SkyYear;
use crate::study::system::VerySystem;
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, Par};
use glam::DVec3;
use rayon::prelude::*;
use std::hash::{DefaultHasher, Hasher};
use std::sync::Arc;

/// Skies whose sums are found at once.
pub(in crate::study) const TOGETHER: usize = 32;

/// One aperture.
pub(super) struct AperturePart {
    sky: Arc<SkyPatches>,
    /// What they are in the hours of a year, where that is kept.
    year: Option<Arc<SkyYear>>,
    /// Columns for every patch of the sky's samples, one for the ground and one for the skyline. Rows of all sensors for all
    /// diffuse light but what is seen straight through, then for what of it is interreflected, the doubt of that, and
    /// the doubt of the interpolation where there is any: what [`Sums`] holds. Half the digits are 10⁻⁶ of the sums.
    tables: Mat<f32>,
    /// What the system does with light.
    pub transport: Transport,
    /// The regular part.
    pub regular: Option<AngularTransmittance>,
    /// How the very sun comes through.
    pub sun: SunWay,
    seen: Vec<StraightView>,
    /// The moments of what the sensors see in the hours of a year, where they are kept.
    seen_year: Option<Arc<SkyYear>>,
    /// Mean relative gap of flux of the regular part.
    pub gap: f64,
    /// Share of the light that frame and dirt leave.
    pub clear: f64,
}

/// How the light of a sky is found.
#[derive(Clone, Copy)]
pub(super) enum Way<'a> {
    /// By the fixed directions.
    Fixed,
    /// The same for an hour of the year that is kept.
    Hour(usize),
    /// By integrals; with a session as a trial of the fixed directions, and kept.
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

impl Sums {
    /// Nothing yet at so many sensors.
    pub fn dark(sensors: usize) -> Self {
        let dark = || vec![0.0; sensors];
        Self { total: dark(), reflected: dark(), doubtful: dark(), interpolated: dark() }
    }
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
        let sky = session.sky_patches(scene, index, patches, spacing);
        let patches = &sky.patches;
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
        // Patches wholly under the horizon hold ground and skyline only, and need no column of the sky.
        let open = sky.samples.cells();
        let width = open.len() + 2;
        // Only lobes between directions are in doubt of their interpolation: others save the fourth table.
        let doubts = columns.iter().any(|column| !column.doubt.is_empty());
        let rows = sensors * if doubts { 4 } else { 3 };
        let mut tables = Mat::zeros(rows, width);
        let mut put = |to: usize, light: &mut dyn Iterator<Item = f64>| {
            tables.col_as_slice_mut(to).iter_mut().zip(light).for_each(|(to, e): (&mut f32, f64)| *to = e as f32);
        };
        for (to, &p) in open.iter().enumerate() {
            put(to, &mut columns[p].light.iter().chain(&columns[p].doubt).copied());
        }
        // Both are even, whatever the sky: summed over all patches now, a new sky needs their two luminances alone.
        for (to, share) in [(width - 2, &sky.ground), (width - 1, &sky.skyline)] {
            let mut sum = vec![0.0; rows];
            for (column, share) in columns.iter().zip(share) {
                let (light, doubt) = sum.split_at_mut(3 * sensors);
                add_scaled(light, &column.light, *share);
                add_scaled(doubt, &column.doubt, *share);
            }
            put(to, &mut sum.into_iter());
        }
        // Through an opening every sensor sees another part of the sky, with sharp borders: patches would blur them.
        let seen = match &btdf.regular {
            Some(tau) => {
                let constants = Constants::of(&scene.outside);
                let view = |sensor| StraightView::new(scene, index, sensor, tau, &constants);
                scene.sensors.par_iter().map(view).collect()
            }
            None => Vec::new(),
        };
        Ok(Self {
            year: None,
            tables,
            transport,
            sun,
            regular: btdf.regular.clone(),
            seen,
            seen_year: None,
            gap: straight.map_or(0.0, |(_, views)| views.gap),
            clear: scene.apertures[index].clear,
            sky,
        })
    }

    /// May the sun come on as beams?
    pub fn sends_beams(&self) -> bool {
        self.regular.is_some() || !matches!(self.sun, SunWay::Data)
    }

    /// Number of luminances that a new sky costs.
    pub fn evaluations(&self) -> usize {
        self.sky.samples.len() + self.seen.iter().map(StraightView::directions).sum::<usize>()
    }

    /// Keeps in `session` what the hours of a year are on its patches; `year`: its number, and how many hours it has.
    pub fn keep_year(&mut self, session: &Session, year: (u64, usize)) {
        self.year = session.sky_year(year, self.sky.fingerprint, self.sky.samples.cells().len());
        let mut hasher = DefaultHasher::new();
        self.seen.iter().for_each(|seen| seen.hash(&mut hasher));
        let moments = self.seen.iter().map(StraightView::moments).sum();
        self.seen_year = session.seen_year(year, hasher.finish(), moments);
    }

    /// Illuminance through every patch, then the luminances of ground and skyline.
    fn light(&self, outside: &Outside, way: Way<'_>) -> Vec<f64> {
        let mut e = Vec::with_capacity(self.sky.samples.cells().len() + 2);
        match (way, &self.year) {
            (Way::Hour(hour), Some(year)) => {
                let find = || {
                    let mut e = Vec::new();
                    self.sky.samples.illuminances(outside, &mut e);
                    e
                };
                e.extend(year.hour(hour, find));
            }
            (Way::Fixed | Way::Hour(_), _) => self.sky.samples.illuminances(outside, &mut e),
            (Way::Exact(session), _) => {
                let find = || illuminances(outside, &self.sky.patches, &self.sky.frame, EXACT);
                let all =
                    session.map_or_else(|| Arc::new(find()), |s| s.exact_sky(outside, self.sky.fingerprint, find));
                let ground = outside.ground_luminance();
                e.extend(self.sky.samples.cells().iter().map(|&p| all[p] - ground * self.sky.ground[p]));
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
        let light: Vec<f32> = self.light(outside, way).into_iter().map(|e| e as f32).collect();
        let mut all = vec![0.0_f32; scene.sensors.len()];
        let table = self.tables.subrows(0, all.len());
        matmul(ColMut::from_slice_mut(&mut all), Accum::Replace, table, ColRef::from_slice(&light), 1.0, Par::Seq);
        out.iter_mut().zip(all).for_each(|(sum, e)| *sum += f64::from(e));
        self.add_seen(scene, index, outside, way, out);
    }

    fn add_seen(&self, scene: &Scene, index: usize, outside: &Outside, way: Way<'_>, out: &mut [f64]) {
        let Some(tau) = &self.regular else { return };
        if !matches!(way, Way::Exact(_)) {
            let find = || {
                let mut moments = Vec::new();
                self.seen.iter().for_each(|seen| seen.gather(outside, &mut moments));
                moments
            };
            let moments: Vec<f64> = match (way, &self.seen_year) {
                (Way::Hour(hour), Some(year)) => year.hour(hour, find).collect(),
                _ => find(),
            };
            let mut moments = moments.into_iter();
            for (sum, seen) in out.iter_mut().zip(&self.seen) {
                *sum += self.clear * seen.light(outside, &mut moments);
            }
        } else {
            let accuracy = if matches!(way, Way::Exact(Some(_))) { TRIED } else { EXACT };
            let exact: Vec<Estimate> = scene
                .sensors
                .par_iter()
                .map(|sensor| seen_exactly(scene, index, sensor, tau, outside, accuracy))
                .collect();
            out.iter_mut().zip(exact).for_each(|(sum, e)| *sum += self.clear * e.value);
        }
    }

    /// The same of many skies with all that its error needs.
    pub fn add_sums(&self, scene: &Scene, index: usize, skies: &[(&Outside, Way<'_>)], sums: &mut [Sums]) {
        for (skies, sums) in skies.chunks(TOGETHER).zip(sums.chunks_mut(TOGETHER)) {
            // As many columns whatever is asked, so that no sky's sums hang on the others'.
            let mut light = Mat::zeros(self.tables.ncols(), TOGETHER);
            for (column, (outside, way)) in light.col_iter_mut().zip(skies) {
                column.iter_mut().zip(self.light(outside, *way)).for_each(|(to, e)| *to = e as f32);
            }
            let mut all: Mat<f32> = Mat::zeros(self.tables.nrows(), TOGETHER);
            matmul(all.as_mut(), Accum::Replace, &self.tables, &light, 1.0, Par::Seq);
            for ((found, (outside, way)), sums) in all.col_iter().zip(skies).zip(sums) {
                let parts = [&mut sums.total, &mut sums.reflected, &mut sums.doubtful, &mut sums.interpolated];
                for (sum, e) in parts.into_iter().flatten().zip(found.iter()) {
                    *sum += f64::from(*e);
                }
                self.add_seen(scene, index, outside, *way, &mut sums.total);
            }
        }
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
/// The same where fixed directions are tried against it, which are off by some 1e-4 and more.
const TRIED: f64 = 1e-4;
