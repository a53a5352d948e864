//! Daylight coefficients (V·T·D) of one aperture: a column for each sky patch, one for the ground, one for the skyline;
//! and the outside seen by regular transmission, in directions chosen for every sensor.

use super::behind::{Behind, Moment, Past, luminances, nodes};
use super::columns::Columns;
use super::described::{Described, DescribedViews};
use super::sent::Sent;
use super::straight::{StraightView, seen_exactly};
use super::sun_way::SunWay;
use super::transport::{self, Transport};
use super::views::Opening;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{AngularTransmittance, Btdf};
use crate::compute::direction::Dir;
use crate::compute::estimate::Estimate;
use crate::compute::lid::SkyThrough;
use crate::compute::room::sunlit_part::SunlitPart;
use crate::compute::sky::{Outside, Prepared, Sun};
use crate::compute::system::measure::Side;
use crate::study::cache::Cache;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::far::{self, Constants};
use crate::study::session::sky_patches::{SkyPatches, illuminances};
use crate::study::session::sky_year::{SkyYear, SunlitYear};
use crate::study::session::{OfModel, Session};
use crate::study::system::SystemModel;
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, Par};
use glam::DVec3;
use rayon::prelude::*;
use std::hash::{DefaultHasher, Hasher};
use std::sync::{Arc, OnceLock};

/// Maximum number of skies whose illuminances are computed together. With more than 64 columns, products of matrices of
/// up to 64 rows sum in another order than with fewer, if there is as much to sum as behind boxes.
pub(crate) const TOGETHER: usize = 64;
/// Multiple to which the number of skies is filled up with dark ones, so that the sums for a sky do not depend on the
/// number of others.
const COLUMNS: usize = 32;

/// Aperture of a scene, prepared for many skies and suns.
pub(super) struct AperturePart {
    sky: Seen,
    /// Illuminances through the patches in the hours of a year, where they are stored.
    year: Option<Arc<SkyYear>>,
    /// Sunlit part of the aperture in the hours of a year, behind boxes.
    sunlit: Option<Arc<SunlitYear>>,
    /// Response of the sensors to light that is scattered by the system.
    pub transport: Transport,
    /// Estimate of the relative error of scattered light, of the data or of the description.
    pub relative_error: f64,
    /// Regular transmittance of the system; `None` if it has none.
    pub regular: Option<AngularTransmittance>,
    /// Method for the transmission of direct sunlight through the system.
    pub sun: SunWay,
    /// Mean relative gap between flux through the aperture and flux found in the room, for regular transmission.
    pub gap: f64,
    /// Transmission factor of frame and dirt, 0–1.
    pub clear: f64,
}

/// Description of what an aperture sees of the outside.
enum Seen {
    /// Patches of the outside that are the same at all points of the aperture; regular transmission is evaluated sensor
    /// by sensor.
    Alike {
        patches: Arc<SkyPatches>,
        /// Table of daylight coefficients. Columns: one for every sky patch, one for the ground and one for the
        /// skyline. Rows: all sensors for the diffuse light without regular transmission, then for its interreflected
        /// part, the uncertainty of that part, and the uncertainty of the interpolation where there is any (the fields
        /// of [`Sums`]). Single precision is 10⁻⁶ of the sums.
        tables: Mat<f32>,
        straight: Vec<StraightView>,
        /// Moments of what the sensors see by regular transmission in the hours of a year, where they are stored.
        year: Option<Arc<SkyYear>>,
    },
    /// Luminances of the outside past boxes, which differ between points of the aperture; with the light that enters at
    /// its nodes in the hours of a year, where it is stored.
    Behind(Arc<Prepared>, Box<Past>, Option<Arc<SkyYear>>),
}

/// Method by which the light of a sky is evaluated.
#[derive(Clone, Copy)]
pub(super) enum Way<'a> {
    /// Luminances in fixed directions.
    Fixed,
    /// Luminances in fixed directions for an hour of the year, which are stored; with the sun of that hour.
    Hour(usize, Option<&'a Sun>),
    /// Integration; with a session it is a test of the fixed directions, whose result is stored.
    Exact(Option<&'a Session>),
}

impl<'a> Way<'a> {
    const fn moment(self, outside: &'a Outside) -> Moment<'a> {
        let (hour, sun) = if let Self::Hour(hour, sun) = self { (Some(hour), sun) } else { (None, None) };
        Moment { outside, sun, hour }
    }
}

/// Illuminances under one sky, sensor by sensor. \[lx\]
pub(super) struct Sums {
    /// All diffuse light, direct and interreflected.
    pub total: Vec<f64>,
    /// Interreflected part of `total`.
    pub reflected: Vec<f64>,
    /// Uncertainty of `reflected`.
    pub reflected_uncertainty: Vec<f64>,
    /// Uncertainty by the interpolation between incident directions, with its sign.
    pub interpolated: Vec<f64>,
}

impl Sums {
    /// Creates illuminances of 0 at `sensors` sensors.
    pub fn dark(sensors: usize) -> Self {
        let dark = || vec![0.0; sensors];
        Self { total: dark(), reflected: dark(), reflected_uncertainty: dark(), interpolated: dark() }
    }
}

impl AperturePart {
    /// Prepares an aperture. `btdf`: transmission of its system; `obstructed`: obstructions in front of it, and a cache
    /// of direct light by aperture.
    pub fn new(
        opening: &Opening<'_>,
        btdf: &Btdf,
        obstructed: Option<(&Behind, &Cache<Mat<f32>>)>,
    ) -> Result<Self, StudyError> {
        let Opening { session, scene, index, room, .. } = *opening;
        let through = described_through(session, scene, index);
        let described = |opening: &Opening<'_>| {
            let described = through.as_ref().map(|(model, through)| {
                Ok::<_, StudyError>(Described::new(&through.1, Arc::new(described_views(opening, model)?)))
            });
            described.transpose()
        };
        let own = described(opening)?;
        // Light that the description covers is not computed from the data, which need not exist.
        let nothing = Btdf::default();
        let btdf = if own.is_some() { &nothing } else { btdf };
        let transport = Transport::new(opening, btdf)?;
        let (patches, spacing) = match &own {
            Some(own) => (RingBasis::clone(&own.basis), transport::SPACING),
            None => transport::patches(btdf, scene.interpolation),
        };
        let regular = btdf.regular.as_ref();
        let (sky, gap) = match obstructed {
            Some((behind, direct)) => {
                let nodes = nodes(&scene.apertures[index].aperture);
                let reflecting = Opening { nodes: Some(&nodes), ..*opening };
                let by_node = match room {
                    Some(_) => Some((described(&reflecting)?, Transport::new(&reflecting, btdf)?)),
                    None => None,
                };
                let columns = by_node.as_ref().map(|(described, transport)| {
                    Columns::new(&reflecting, (described.as_ref(), transport), &patches, regular)
                });
                let columns = columns.transpose()?;
                let sent = match &through {
                    Some((_, through)) => Some(Sent::described(&through.1)),
                    None => Sent::of_data(session, btdf, scene.interpolation, &patches),
                };
                let past = behind.past(opening, nodes.clone(), (&patches, columns.as_ref()), sent, regular, direct)?;
                let gap = columns.as_ref().map_or(0.0, Columns::gap);
                (Seen::Behind(Arc::clone(&behind.prepared), Box::new(past), None), gap)
            }
            None => {
                let columns = Columns::new(opening, (own.as_ref(), &transport), &patches, regular)?;
                let gap = columns.gap();
                let sky = session.sky_patches(scene, index, patches.clone(), spacing);
                let tables = columns.table(&sky);
                // Through an aperture every sensor sees another part of the sky, with sharp borders: patches would
                // blur them.
                let constants = regular.map(|_| Constants::of(&scene.outside));
                let view = |sensor| {
                    let (tau, constants) = regular.zip(constants.as_ref())?;
                    Some(StraightView::new(scene, index, sensor, tau, constants))
                };
                let straight = scene.sensors.par_iter().filter_map(view).collect();
                (Seen::Alike { patches: sky, tables, straight, year: None }, gap)
            }
        };
        let relative_error = own.as_ref().map_or(transport.relative_error(), |own| own.error);
        let model = scene.apertures[index].system.model.as_ref().filter(|_| scene.beams);
        let model = model.map(|model| match own {
            Some(own) => Ok((model.clone(), own.views, own.by_angle)),
            None => Ok::<_, StudyError>((model.clone(), Arc::new(described_views(opening, model)?), None)),
        });
        let sun = SunWay::new(opening, btdf, model.transpose()?)?;
        Ok(Self {
            year: None,
            sunlit: None,
            transport,
            relative_error,
            sun,
            regular: btdf.regular.clone(),
            gap,
            clear: scene.apertures[index].clear,
            sky,
        })
    }

    /// Whether sunlight may leave the aperture as beams.
    pub fn sends_beams(&self) -> bool {
        self.regular.is_some() || !matches!(self.sun, SunWay::Data)
    }

    /// Returns the aperture as prepared behind obstructions; `None` without obstructions.
    pub fn past(&self) -> Option<&Past> {
        if let Seen::Behind(_, past, _) = &self.sky { Some(past) } else { None }
    }

    /// Returns the store for the sunlit part of the aperture in an hour of the year; `None` where the year is not
    /// stored or the aperture has no obstructions.
    pub fn sunlit(&self, hour: Option<usize>) -> Option<&OnceLock<SunlitPart>> {
        self.sunlit.as_ref().zip(hour).map(|(year, hour)| &year[hour])
    }

    /// Returns the number of directions in which the luminance of a new sky is evaluated.
    pub fn evaluations(&self) -> usize {
        match &self.sky {
            Seen::Alike { patches, straight, .. } => {
                patches.samples.len() + straight.iter().map(StraightView::directions).sum::<usize>()
            }
            Seen::Behind(prepared, ..) => prepared.count(),
        }
    }

    /// Stores in `session` the light of the hours of a year on the patches of the aperture. `year`: a number that no year
    /// of other skies has, and the number of its hours.
    pub fn keep_year(&mut self, session: &Session, (scene, index): (&Scene, usize), year: (u64, usize)) {
        self.year = match &mut self.sky {
            Seen::Behind(prepared, past, at_nodes) => {
                let numbers = past.reflected.numbers();
                *at_nodes = session.entering_year(year, prepared.number(), (scene, index), past.patches(), numbers);
                self.sunlit = Some(session.sunlit_year(year, prepared.number(), (scene, index)));
                session.sky_year(year, prepared.number(), prepared.count())
            }
            Seen::Alike { patches, straight, year: seen_year, .. } => {
                let mut hasher = DefaultHasher::new();
                straight.iter().for_each(|seen| seen.hash(&mut hasher));
                let moments = straight.iter().map(StraightView::moments).sum();
                *seen_year = session.sky_year(year, hasher.finish(), moments);
                session.sky_year(year, patches.fingerprint, patches.samples.cells().len())
            }
        };
    }

    /// Returns the input of the table's columns for one outside without boxes, frame and dirt included: illuminance
    /// through every patch \[lx\], then the luminances of ground and skyline. \[cd/m²\]
    fn light(&self, sky: &SkyPatches, outside: &Outside, way: Way<'_>) -> Vec<f64> {
        let mut e = Vec::with_capacity(sky.samples.cells().len() + 2);
        match (way, &self.year) {
            (Way::Hour(hour, _), Some(year)) => {
                let find = || {
                    let mut e = Vec::new();
                    sky.samples.illuminances(outside, &mut e);
                    e
                };
                e.extend(year.hour(hour, find));
            }
            (Way::Fixed | Way::Hour(..), _) => sky.samples.illuminances(outside, &mut e),
            (Way::Exact(session), _) => {
                let find = || illuminances(outside, &sky.patches, &sky.frame, EXACT);
                let all = session.map_or_else(|| Arc::new(find()), |s| s.exact_sky(outside, sky.fingerprint, find));
                let ground = outside.ground_luminance();
                e.extend(sky.samples.cells().iter().map(|&p| all[p] - ground * sky.ground[p]));
            }
        }
        let smooth = !matches!(way, Way::Exact(_));
        e.push(outside.ground_luminance());
        e.push(if smooth { far::luminance(outside) } else { 0.0 });
        e.iter_mut().for_each(|e| *e *= self.clear);
        e
    }

    /// Adds the diffuse illuminance through this aperture at every sensor to `out`. \[lx\]
    pub fn add(&self, scene: &Scene, index: usize, outside: &Outside, way: Way<'_>, out: &mut [f64]) {
        let Seen::Alike { patches, tables, .. } = &self.sky else {
            let mut sums = [Sums::dark(out.len())];
            self.add_sums(scene, index, &[(outside, way)], &mut sums);
            return out.iter_mut().zip(&sums[0].total).for_each(|(sum, e)| *sum += e);
        };
        let light: Vec<f32> = self.light(patches, outside, way).into_iter().map(|e| e as f32).collect();
        let mut all = vec![0.0_f32; scene.sensors.len()];
        let table = tables.subrows(0, all.len());
        matmul(ColMut::from_slice_mut(&mut all), Accum::Replace, table, ColRef::from_slice(&light), 1.0, Par::Seq);
        out.iter_mut().zip(all).for_each(|(sum, e)| *sum += f64::from(e));
        self.add_seen(scene, index, outside, way, out);
    }

    /// Adds the illuminance by the outside that the sensors see by regular transmission, of apertures without
    /// obstructions. \[lx\]
    fn add_seen(&self, scene: &Scene, index: usize, outside: &Outside, way: Way<'_>, out: &mut [f64]) {
        let (Some(tau), Seen::Alike { straight, year, .. }) = (&self.regular, &self.sky) else { return };
        if !matches!(way, Way::Exact(_)) {
            let find = || {
                let mut moments = Vec::new();
                straight.iter().for_each(|seen| seen.gather(outside, &mut moments));
                moments
            };
            let moments: Vec<f64> = match (way, year) {
                (Way::Hour(hour, _), Some(year)) => year.hour(hour, find).collect(),
                _ => find(),
            };
            let mut moments = moments.into_iter();
            for (sum, seen) in out.iter_mut().zip(straight) {
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

    /// Adds the diffuse illuminances of many skies at every sensor, with the values from which their errors follow.
    pub fn add_sums(&self, scene: &Scene, index: usize, skies: &[(&Outside, Way<'_>)], sums: &mut [Sums]) {
        for (skies, sums) in skies.chunks(TOGETHER).zip(sums.chunks_mut(TOGETHER)) {
            let columns = skies.len().next_multiple_of(COLUMNS);
            let (all, factor) = match &self.sky {
                Seen::Alike { patches, tables, .. } => {
                    let mut light = Mat::zeros(tables.ncols(), columns);
                    for (to, (outside, way)) in light.col_iter_mut().zip(skies) {
                        let own = self.light(patches, outside, *way);
                        to.iter_mut().zip(own).for_each(|(to, e)| *to = e as f32);
                    }
                    let mut all: Mat<f32> = Mat::zeros(tables.nrows(), columns);
                    matmul(all.as_mut(), Accum::Replace, tables, &light, 1.0, Par::Seq);
                    (all, 1.0)
                }
                Seen::Behind(prepared, past, at_nodes) => {
                    let moments: Vec<_> = skies.iter().map(|(outside, way)| way.moment(outside)).collect();
                    let light = luminances(prepared, self.year.as_deref(), &moments, columns);
                    let hours: Vec<Option<usize>> = moments.iter().map(|moment| moment.hour).collect();
                    (past.sums(&light, &hours, at_nodes.as_deref()), self.clear)
                }
            };
            for ((found, (outside, way)), sums) in all.col_iter().zip(skies).zip(sums) {
                let parts =
                    [&mut sums.total, &mut sums.reflected, &mut sums.reflected_uncertainty, &mut sums.interpolated];
                for (sum, e) in parts.into_iter().flatten().zip(found.iter()) {
                    *sum += factor * f64::from(*e);
                }
                self.add_seen(scene, index, outside, *way, &mut sums.total);
            }
        }
    }
}

/// Returns the optical model of an aperture's system with its transmission of sky and ground, if light of the sky is
/// computed from the description; `None` for systems given by data.
fn described_through<'a>(
    session: &Session,
    scene: &'a Scene,
    index: usize,
) -> Option<(&'a SystemModel, Arc<OfModel<SkyThrough>>)> {
    let model =
        scene.apertures[index].system.model.as_ref().filter(|model| scene.beams && model.answers_for_the_sky())?;
    Some((model, session.sky_through(model)))
}

/// Computes the responses of the sensors to the light that a described system emits.
fn described_views(opening: &Opening<'_>, model: &SystemModel) -> Result<DescribedViews, StudyError> {
    let normal = Dir::from_unit(DVec3::Z);
    let bands = model.0.profile_light(normal, Side::Front).map(|light| (light.upright, light.q.len()));
    DescribedViews::new(opening, bands)
}

/// Relative accuracy to which light is integrated that cannot be evaluated in fixed directions.
const EXACT: f64 = 1e-5;
/// Relative accuracy of the integrals with which fixed directions are compared; the error of these is some 1e-4 or
/// more.
const TRIED: f64 = 1e-4;
