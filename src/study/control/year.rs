//! States of controlled apertures over a year: every step from 1 January, evaluated at its middle, with the sun in
//! front of every aperture, the number that its control demands, and the resulting state.
//!
//! The sun shines whenever any part of its disc is up, as bright as in a [`ClearSky`], and the sky is taken as uniform
//! where illuminances are compared with thresholds; a [`Weather`] replaces both illuminances by those of its hours.
//! Indoor illuminances are not computed: `open_below` uses `control.indoor` alone; an annual simulation reads the
//! room's sensors. The skyline hides the sun by its altitude at the sun's bearing, boxes hide it from parts of an
//! aperture; sky and ground behind boxes count as dark here, and boxes reflect nothing.

use super::device::section_from_keys;
use super::keys::ControlKeys;
use super::table::begun;
use super::{Device, inputs, settings};
use crate::compute::angle::Bearing;
use crate::compute::control::controller::{Controller, Reason};
use crate::compute::control::cut_off::SlatRow;
use crate::compute::direction::{Dir, Orientation, Surface};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::lid::Facing;
use crate::compute::room::aperture::Aperture;
use crate::compute::sky::availability::{Cover, typical_illuminances};
use crate::compute::sky::clear_sky::clear_sky_illuminances;
use crate::compute::sky::{Distribution, Outside, SUN_HALF_ANGLE, Sun, irradiance};
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::Solid;
use crate::formats::state_table::of_year;
use crate::study::error::StudyError;
use crate::study::outside::boxes;
use crate::study::scene_file::{DstKey, IlluminanceKey, SceneFile, SystemKeys};
use crate::study::scene_places::{apertures, room};
use crate::study::sky::{CLEANEST, HAZIEST, HIGHEST, LOWEST};
use crate::study::skyline::skyline as by_bearing;
use crate::study::sun_position::{Place, parse_local_time, sun_position};
use glam::DVec3;
use jiff::ToSpan;
use jiff::civil::{Date, DateTime};
use std::path::Path;
use std::sync::Arc;

/// Value of a state in a scene file that leaves the state of an aperture to its control.
pub const CONTROLLED: &str = "controlled";

/// Source of the outdoor illuminances of a year: direct normal, and diffuse horizontal. \[lx\]
pub trait Weather: Sync {
    /// Returns direct normal and diffuse horizontal illuminance \[lx\] at `time` (local standard time) with the sun at
    /// `altitude` \[rad\]; `None` where they are unknown.
    fn illuminances(&self, time: DateTime, altitude: f64) -> Option<(f64, f64)>;
}

/// Minimum direct normal illuminance while any part of the disc is up, because the control depends on whether direct
/// sun passes, not on how much. \[lx\]
const LEAST_BEAM: f64 = 1.0;

/// Clear sky at all hours, with the illuminances that a scene uses for clear skies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ClearSky {
    /// Clear-sky model of Ineichen and Perez 2002.
    Air {
        /// Linke turbidity of the air.
        turbidity: f64,
        /// Elevation above sea level. \[m\]
        elevation: f64,
    },
    /// Clear sky of IES RP-21, 1984.
    Practice,
}

impl ClearSky {
    /// Creates the clear sky of a scene: of IES RP-21 where `sky.illuminance` says so, else by Linke turbidity.
    fn of(file: &SceneFile) -> Self {
        match file.sky.illuminance {
            IlluminanceKey::Rp21 => Self::Practice,
            IlluminanceKey::ClearSky | IlluminanceKey::Stated => {
                Self::Air { turbidity: file.sky.turbidity, elevation: file.site.elevation }
            }
        }
    }
}

impl Weather for ClearSky {
    fn illuminances(&self, time: DateTime, altitude: f64) -> Option<(f64, f64)> {
        let (direct, diffuse) = match *self {
            Self::Air { turbidity, elevation } => clear_sky_illuminances(altitude, turbidity, elevation),
            Self::Practice => {
                let day = time.day_of_year().unsigned_abs().min(365);
                typical_illuminances(Cover::Clear, altitude, Some(day))
            }
        };
        Some(if altitude > -SUN_HALF_ANGLE { (direct.max(LEAST_BEAM), diffuse) } else { (0.0, 0.0) })
    }
}

/// Aperture whose state a control chooses, ready to be stepped through time.
#[derive(Debug, Clone)]
pub struct Moving {
    /// Number of the aperture in the scene, from 1.
    pub aperture: usize,
    /// Position and size of the aperture.
    pub opening: Aperture,
    /// Shading device that the control sets.
    pub device: Device,
    /// Keys of the control.
    pub keys: ControlKeys,
    /// Cross-section of the slats, where it is known; it determines whether direct sun passes between them.
    pub section: Option<SlatRow>,
}

/// State that the control chose for one aperture at one moment, and the reasons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Profile angle of the sun's centre \[rad\]; `None` while nothing of the sun is in front of the aperture.
    pub profile_angle: Option<f64>,
    /// Number of the state that the rule demands, such as a slat angle, in the unit of the states' numbers; `None` for
    /// rules that name a state.
    pub demanded: Option<f64>,
    /// Index of the resulting state in the device.
    pub state: usize,
    /// Whether direct sun passes between the slats; `None` where their section is not known.
    pub passes: Option<bool>,
    /// Reason for choosing the state.
    pub reason: Reason,
    /// Whether the state differs from that of the previous step.
    pub moved: bool,
}

/// States of all controlled apertures at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// Local standard time of the moment.
    pub time: DateTime,
    /// True altitude of the sun. \[rad\]
    pub altitude: f64,
    /// Bearing of the sun, clockwise from north.
    pub bearing: Bearing,
    /// States of the controlled apertures, in their order.
    pub settings: Vec<Setting>,
}

/// Returns the apertures whose state a control chooses, with their devices and keys. `device`: returns the device of a
/// system.
///
/// # Errors
/// Returns an error if a product is missing, a control is not valid, or no aperture is controlled.
pub fn moving(
    file: &SceneFile,
    base: &Path,
    device: &dyn Fn(&SystemKeys) -> Result<Device, StudyError>,
) -> Result<Vec<Moving>, StudyError> {
    let mut list = Vec::new();
    let geometry = apertures(&file.aperture, &room(&file.room)?)?;
    for (index, (aperture, opening)) in file.aperture.iter().zip(geometry).enumerate() {
        if aperture.system == SystemKeys::Ranked {
            return Err(StudyError::ranked(format!("aperture[{}].system", index + 1)));
        }
        let (SystemKeys::Catalogue { state: Some(word), .. }
        | SystemKeys::File { state: Some(word), .. }
        | SystemKeys::Family { state: Some(word), .. }) = &aperture.system
        else {
            continue;
        };
        if word != CONTROLLED {
            continue;
        }
        let keys = aperture.control.as_ref().or(file.control.as_ref()).ok_or_else(|| {
            StudyError::key(
                format!("aperture[{}].system.state", index + 1),
                "\"controlled\" needs a [control] section with a mode",
            )
        })?;
        let device = device(&aperture.system)?;
        // Checked here, so that a wrong key is reported before the year starts.
        settings(keys, &device, base)?;
        let described = keys.slats.as_ref().map(section_from_keys).transpose()?;
        let section = described.or_else(|| device.section.clone());
        list.push(Moving { aperture: index + 1, opening, device, keys: keys.clone(), section });
    }
    if list.is_empty() {
        let message = "nothing moves: give an aperture system = { catalogue = \"…\", state = \"controlled\" }";
        return Err(StudyError::key("aperture", message));
    }
    Ok(list)
}

/// Conditions of a year of control, without its apertures: place, clock, surroundings and sky.
#[derive(Debug, Clone, PartialEq)]
pub struct Situation {
    /// Geographic location for which the sun's position is computed.
    pub place: Place,
    /// UTC offset of the standard time at the geographic location. \[h\]
    pub utc_offset: f64,
    /// Rule of summer time, which the periods of schedules follow.
    pub dst: DstKey,
    /// Calendar year.
    pub year: i16,
    /// Bearing of the façade's outward normal, clockwise from north.
    pub facade: Bearing,
    /// Reflectance of the uniform ground, 0 … 1.
    pub ground_reflectance: f64,
    /// Altitude of a uniform skyline. \[rad\]
    pub skyline: f64,
    /// Skyline whose altitude varies with the bearing; it replaces `skyline`.
    pub skyline_by_bearing: Option<Skyline>,
    /// Boxes outside, in the world frame.
    pub boxes: Vec<Solid>,
    /// Clear sky that gives the illuminances of a year without weather data.
    pub sky: ClearSky,
}

impl Situation {
    /// Creates the conditions from a scene; a scene without a time gets the year 2026.
    ///
    /// # Errors
    /// Returns an error if place, clock, sky or obstructions of the scene are missing or not valid.
    pub fn of(file: &SceneFile) -> Result<Self, StudyError> {
        let site = &file.site;
        let need = |key: &str, value: Option<f64>| {
            value.ok_or_else(|| StudyError::key(format!("site.{key}"), "missing: a year needs the place and its clock"))
        };
        let [latitude, longitude, offset] = [
            need("latitude", site.latitude)?,
            need("longitude", site.longitude)?,
            need("utc_offset", site.utc_offset)?,
        ];
        let place =
            Place::new(latitude, longitude, offset).map_err(|error| StudyError::key("site", error.to_string()))?;
        let year = match &file.sky.time {
            Some(time) => {
                parse_local_time(&time.text()).map_err(|error| StudyError::key("sky.time", error.to_string()))?.year()
            }
            None => 2026,
        };
        if file.sky.skyline.is_some() && file.sky.obstruction.is_some() {
            let message = "given together with sky.obstruction: give one of them";
            return Err(StudyError::key("sky.skyline", message));
        }
        let skyline_by_bearing = file.sky.skyline.as_ref().map(by_bearing).transpose();
        let skyline_by_bearing = skyline_by_bearing.map_err(|(key, message)| StudyError::key(key, message))?;
        let skyline = file.sky.obstruction.map_or(0.0, |keys| keys.altitude);
        for (key, value, [min, max]) in [
            ("site.azimuth", site.azimuth, [-360.0, 360.0]),
            ("site.ground_reflectance", site.ground_reflectance, [0.0, 1.0]),
            ("sky.obstruction.altitude", skyline, [0.0, 89.999]),
            ("site.elevation", site.elevation, [LOWEST, HIGHEST]),
            ("sky.turbidity", file.sky.turbidity, [CLEANEST, HAZIEST]),
        ] {
            if !(min..=max).contains(&value) {
                return Err(StudyError::key(key, format!("{value} is out of range (allowed: {min} to {max})")));
            }
        }
        let facade = Bearing::from_degrees(site.azimuth);
        let turn = Orientation::new(facade).turn();
        let boxes = boxes(file, &room(&file.room)?)?.into_iter().map(|(solid, _)| solid.turned(turn)).collect();
        Ok(Self {
            place,
            utc_offset: offset,
            dst: site.dst,
            year,
            facade,
            ground_reflectance: site.ground_reflectance,
            skyline: skyline.to_radians(),
            skyline_by_bearing,
            boxes,
            sky: ClearSky::of(file),
        })
    }

    /// Returns the altitude of the skyline at a bearing, uniform or not. \[rad\]
    fn skyline_at(&self, bearing: Bearing) -> f64 {
        self.skyline_by_bearing.as_ref().map_or(self.skyline, |skyline| skyline.altitude(bearing.radians()))
    }
}

/// Steps the controls through a year. `minutes`: length of a step, 1 to 1440, which must divide a day; `weather`:
/// outdoor illuminances.
///
/// # Errors
/// Returns an error if the step or the scene is not valid, or [`Cancelled`].
pub fn year(
    situation: &Situation,
    base: &Path,
    moving: &[Moving],
    minutes: u32,
    weather: &dyn Weather,
    progress: &dyn Progress,
) -> Result<Vec<Moment>, StudyError> {
    if minutes == 0 || 1440 % minutes != 0 {
        return Err(StudyError::key("step", format!("{minutes} min does not divide a day: e.g. 5, 15, 60")));
    }
    let wrong = |error: jiff::Error| StudyError::key("sky.time", error.to_string());
    let first = Date::new(situation.year, 1, 1).map_err(wrong)?;
    let days = usize::try_from(first.days_in_year()).unwrap_or(365);
    let a_day = (1440 / minutes) as usize;
    let mut stepper = Stepper::new(situation, base, moving, weather)?;
    let mut moments = Vec::with_capacity(days * a_day);
    let start = first.at(0, 0, 0, 0).checked_add((30 * i64::from(minutes)).seconds()).map_err(wrong)?;
    for step in 0..days * a_day {
        if step % a_day == 0 {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            progress.advance("days", step / a_day, days);
        }
        let since = 60 * i64::from(minutes) * step as i64;
        let time = start.checked_add(since.seconds()).map_err(wrong)?;
        moments.push(stepper.moment(time, since as f64)?);
    }
    Ok(moments)
}

/// Steps the controls through one day from midnight to midnight, every `minutes`, with hysteresis and dwell time.
///
/// # Errors
/// Returns the errors of [`year`].
pub fn day(
    situation: &Situation,
    base: &Path,
    moving: &[Moving],
    date: Date,
    minutes: u32,
    weather: &dyn Weather,
) -> Result<Vec<Moment>, StudyError> {
    let mut stepper = Stepper::new(situation, base, moving, weather)?;
    let wrong = |error: jiff::Error| StudyError::key("sky.time", error.to_string());
    (0..=1440 / minutes.max(1))
        .map(|step| {
            let since = 60 * i64::from(minutes * step);
            let time = date.at(0, 0, 0, 0).checked_add(since.seconds()).map_err(wrong)?;
            stepper.moment(time, since as f64)
        })
        .collect()
}

/// Controllers of all moving apertures, stepped through time, with what they need of the surroundings.
struct Stepper<'a> {
    situation: &'a Situation,
    moving: &'a [Moving],
    controllers: Vec<Controller>,
    weather: &'a dyn Weather,
    /// Boxes in front of the apertures, without light; `None` if there are none.
    around: Option<Arc<Surroundings>>,
    /// Illuminance at the centre of each aperture per diffuse horizontal illuminance of a uniform sky, and per luminous
    /// exitance of the ground.
    received: Vec<[f64; 2]>,
}

/// Returns the illuminance at the centre of an aperture per diffuse horizontal illuminance of a uniform sky, and per
/// luminous exitance of the ground. `around`: boxes outside.
fn received(aperture: &Aperture, around: Option<&Arc<Surroundings>>, orientation: Orientation) -> [f64; 2] {
    let Some(around) = around else {
        return match aperture.surface {
            Surface::Roof => [1.0, 0.0],
            Surface::Facade => [0.5, 0.5],
        };
    };
    let [low, _, high, _] = aperture.corners();
    let normal = orientation.to_world(aperture.surface.room_from_facade(DVec3::Z));
    let past = |sky: f64, reflectance: f64| {
        let open = Outside::new(Distribution::uniform(), sky).and_then(|all| all.with_ground(reflectance, 1.0 - sky));
        let behind =
            open.map(|open| open.behind(Arc::clone(around)).seen_from(orientation.to_world(0.5 * (low + high))));
        behind.map_or(0.0, |outside| irradiance(&outside, Dir::from_unit(normal)).value)
    };
    [past(1.0, 0.0), past(0.0, 1.0)]
}

impl<'a> Stepper<'a> {
    fn new(
        situation: &'a Situation,
        base: &Path,
        moving: &'a [Moving],
        weather: &'a dyn Weather,
    ) -> Result<Self, StudyError> {
        let controllers: Result<Vec<Controller>, StudyError> =
            moving.iter().map(|one| Ok(Controller::new(settings(&one.keys, &one.device, base)?))).collect();
        let dark = || Arc::new(Surroundings::dark(situation.boxes.clone(), None));
        let around = (!situation.boxes.is_empty()).then(dark);
        let orientation = Orientation::new(situation.facade);
        let received = moving.iter().map(|one| received(&one.opening, around.as_ref(), orientation)).collect();
        Ok(Self { situation, moving, controllers: controllers?, weather, around, received })
    }

    /// Steps all controllers to a moment: sun and outdoor illuminances, readings, and the chosen states. `seconds`:
    /// time for hysteresis and dwell time.
    fn moment(&mut self, time: DateTime, seconds: f64) -> Result<Moment, StudyError> {
        let here = self.situation;
        let at_site = |error: &dyn std::fmt::Display| StudyError::key("site", error.to_string());
        let (altitude, bearing) = sun_position(&here.place, time).map_err(|error| at_site(&error))?;
        let (direct, diffuse) = self.weather.illuminances(time, altitude).unwrap_or((0.0, 0.0));
        let up = altitude > -SUN_HALF_ANGLE;
        let outside = Outside::new(Distribution::uniform(), if up { diffuse.max(LEAST_BEAM) } else { 0.0 })
            .and_then(|outside| outside.with_skyline(here.skyline_at(bearing), 0.0))
            .map_err(|error| at_site(&error))?;
        let outside = match &self.around {
            Some(around) => outside.behind(Arc::clone(around)),
            None => outside,
        };
        let sun = Sun { direction: Dir::from_altitude_bearing(altitude, bearing), direct_normal: direct };
        // Schedules follow local time, summer time included.
        let clock = here.dst.clock(time, here.utc_offset);
        let hour = f64::from(clock.hour()) + f64::from(clock.minute()) / 60.0 + f64::from(clock.second()) / 3600.0;
        let mut list = Vec::with_capacity(self.moving.len());
        let moving = self.moving.iter().zip(&self.received);
        for ((one, [of_sky, of_ground]), controller) in moving.zip(&mut self.controllers) {
            let facing = Facing {
                outside: &outside,
                sun: (up && direct > 0.0).then_some(&sun),
                orientation: Orientation::new(here.facade),
                surface: one.opening.surface,
            };
            let mut inputs = inputs(&facing, &one.opening, hour, one.keys.indoor, false, one.device.upright);
            let at = of_year(time);
            inputs.of_year = Some(at);
            if up {
                begun(&controller.settings().rule, Some(at))?;
            }
            // A uniform sky, and the ground below it.
            let horizontal = diffuse + direct * altitude.sin().max(0.0);
            inputs.facade_global += of_sky * diffuse + of_ground * here.ground_reflectance * horizontal;
            let decision = controller.step(seconds, &inputs);
            let value = controller.settings().values[decision.state];
            let passes = |section: &SlatRow| inputs.sun.is_some_and(|sun| !section.blocks(value, 0.0, sun.span));
            list.push(Setting {
                profile_angle: inputs.sun.map(|sun| sun.centre),
                demanded: decision.demanded.map(f64::to_degrees),
                state: decision.state,
                passes: one.section.as_ref().map(passes),
                reason: decision.reason,
                moved: decision.moved,
            });
        }
        Ok(Moment { time, altitude, bearing, settings: list })
    }
}

/// Summary of a year of control of one aperture.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Number of state changes.
    pub movements: usize,
    /// Time with sun on the aperture. \[h\]
    pub sun_hours: f64,
    /// Time with direct sun through the aperture \[h\]; `None` where the slats are not known.
    pub direct_hours: Option<f64>,
    /// Time in each state while the sun is up, by index of the state. \[h\]
    pub state_hours: Vec<f64>,
}

/// Sums up a year of control for the controlled aperture `index`. `states`: number of its states; `minutes`: length of
/// a step.
pub fn summary(moments: &[Moment], index: usize, states: usize, minutes: u32) -> Summary {
    let hours = f64::from(minutes) / 60.0;
    let of = |moment: &Moment| moment.settings[index];
    let count = |what: &dyn Fn(&Setting) -> bool| moments.iter().filter(|m| what(&of(m))).count();
    let mut state_hours = vec![0.0; states];
    for moment in moments.iter().filter(|moment| moment.altitude > 0.0) {
        state_hours[of(moment).state] += hours;
    }
    let known = moments.first().is_some_and(|moment| of(moment).passes.is_some());
    Summary {
        movements: count(&|setting| setting.moved),
        sun_hours: hours * count(&|setting| setting.profile_angle.is_some()) as f64,
        direct_hours: known.then(|| hours * count(&|setting| setting.passes == Some(true)) as f64),
        state_hours,
    }
}
