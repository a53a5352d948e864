//! Shading controls of a scene: from the keys of `[control]` and a product to a controller, and the state that it
//! chooses at the scene's moment.

pub mod device;
pub mod keys;
pub mod table;
pub mod year;

pub use device::Device;

use super::error::StudyError;
use super::files;
use crate::compute::control::controller::{Controller, Inputs, Period, Rounding, Rule, Settings, SunAt};
use crate::compute::direction::{Dir, Facade};
use crate::compute::lid::Facing;
use crate::compute::profile_angle::{Screen, disc_span};
use crate::compute::room::aperture::Aperture;
use crate::compute::room::beams_past::lit;
use crate::compute::sky::{SUN_HALF_ANGLE, irradiance};
use crate::formats::control_curve::read_control_curve;
use device::section_from_keys;
use glam::DVec3;
use keys::{ControlKeys, ControlMode, PeriodKeys, RoundingKey};
use std::path::Path;

/// Maximum size of a curve file. \[bytes\]
const LARGEST_CURVE: u64 = 1 << 20;

/// Input of a shading control at one moment.
#[derive(Debug, Clone, Copy)]
pub struct ControlQuestion<'a> {
    /// Keys of the control.
    pub keys: &'a ControlKeys,
    /// Folder from which the relative path of a curve file starts.
    pub base: &'a Path,
    /// Local time, in hours from midnight; `None` for a scene without a time.
    pub hour: Option<f64>,
    /// Time in seconds since the beginning of the year, see [`table::of_scene`]; `None` for a scene without a date.
    pub of_year: Option<f64>,
    /// Outside and sun in front of the aperture.
    pub facing: Facing<'a>,
    /// Position and size of the aperture.
    pub aperture: Aperture,
}

/// Returns the key of the state that a control chooses for a device at one moment.
///
/// # Errors
/// Returns an error if keys are wrong or do not belong together, or if the rule cannot move the device.
pub fn pick_state(device: &Device, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
    let settings = settings(asked.keys, device, asked.base)?;
    if matches!(&settings.rule, Rule::User(_, periods) if !periods.is_empty()) && asked.hour.is_none() {
        return Err(StudyError::key("control.schedule", "needs sky.time: with sun angles alone there is no clock"));
    }
    table::begun(&settings.rule, asked.of_year)?;
    let inputs = inputs(
        &asked.facing,
        &asked.aperture,
        asked.hour.unwrap_or(0.0),
        asked.keys.indoor,
        settings.close_above.is_some(),
        device.upright,
    );
    let inputs = Inputs { of_year: asked.of_year, ..inputs };
    let state = Controller::new(settings).step(0.0, &inputs).state;
    Ok(device.keys[state].clone())
}

/// Returns the readings of the façade's and the room's sensors at one moment, without a date. Direct illuminance is the
/// mean over the aperture past boxes; sky, ground and boxes are those seen from its centre.
///
/// `hour`: local time in hours; `indoor`: illuminance in the room \[lx\]; `global`: whether the illuminance of the
/// façade includes sky, ground and boxes, which takes an integral; `upright`: whether slats are vertical.
pub fn inputs(
    facing: &Facing<'_>,
    aperture: &Aperture,
    hour: f64,
    indoor: Option<f64>,
    global: bool,
    upright: bool,
) -> Inputs {
    let around = facing.outside.surroundings().filter(|around| !around.solids.is_empty());
    let direct = facing.sun_illuminance() * around.map_or(1.0, |around| lit(aperture, facing, around).1);
    let [low, _, high, _] = aperture.corners();
    let seen = || facing.outside.seen_from(facing.orientation.to_world(0.5 * (low + high)));
    let normal = facing.surface.room_dir(Dir::from_unit(DVec3::Z));
    let normal = facing.orientation.world_from_room(normal);
    Inputs {
        hour,
        of_year: None,
        day: facing.sun.is_some() || facing.outside.diffuse_horizontal() > 0.0,
        sun: sun_at(facing, upright).filter(|_| direct > 0.0),
        facade_direct: direct,
        facade_global: if global { direct + irradiance(&seen(), normal).value } else { direct },
        indoor,
    }
}

/// Returns the profile angle of an incident direction of the façade frame: in the vertical section of horizontal slats,
/// or with `upright` in the horizontal section of vertical ones. \[rad\]
pub fn slat_angle(direction: Dir<Facade>, upright: bool) -> f64 {
    let v = direction.vector();
    if upright { v.x } else { v.y }.atan2(v.z)
}

/// Returns the solar disc in the section perpendicular to the slats, as profile angles; `None` if nothing of it is in
/// front of the aperture and above the skyline. Vertical slats (`upright`) are treated as horizontal ones rotated by
/// 90°, whose "up" points to the right as seen from outside.
pub fn sun_at(facing: &Facing<'_>, upright: bool) -> Option<SunAt> {
    let turned = |v: DVec3| if upright { DVec3::new(-v.y, v.x, v.z) } else { v };
    let direction = Dir::from_unit(turned(facing.sun_direction()?.vector()));
    let zenith = turned(facing.surface.facade_from_room(DVec3::Z));
    let screen = Screen { normal: zenith, offset: facing.outside.skyline_altitude().sin() };
    let span = disc_span(direction, SUN_HALF_ANGLE, screen)?;
    Some(SunAt { centre: slat_angle(direction, false).clamp(span[0], span[1]), span })
}

/// Creates the settings of a controller for a device from the keys of a scene. Angles of `keys` and `device` are in
/// degrees, those of the result in radians; numbers of states that are not angles are scaled like angles throughout,
/// which has no effect on the choice of states. `base`: folder of the scene.
///
/// # Errors
/// Returns the errors of [`pick_state`].
pub fn settings(keys: &ControlKeys, device: &Device, base: &Path) -> Result<Settings, StudyError> {
    // Ignored, such a key would look as if it did something.
    if let Some((key, modes)) = keys.misplaced() {
        return Err(StudyError::key(format!("control.{key}"), format!("is only valid with mode = {modes}; remove it")));
    }
    let unmoved = || Settings::new(vec![0.0; device.keys.len()], Rule::Fixed(0));
    let by_name = matches!(keys.mode, ControlMode::Fixed | ControlMode::User | ControlMode::Table);
    let values = match &device.values {
        Some(values) => values.iter().map(|value| value.to_radians()).collect(),
        // Rules that name states never look at the numbers: any numbers serve that distinguish the states.
        None if by_name || device.keys.len() == 1 => {
            (0..device.keys.len()).map(|k| (k as f64).to_radians()).collect::<Vec<f64>>()
        }
        None => {
            let message = format!("'{}' has states without numbers; name one of them instead", device.name);
            return Err(StudyError::key("system.state", message));
        }
    };
    // A device of one state cannot move, whatever the rule wants to know of its slats.
    let rule = if device.keys.len() == 1 { Rule::Fixed(0) } else { rule(keys, device, base)? };
    let empty = || StudyError::Catalogue(format!("'{}' has no states", device.name));
    let mut settings = Settings::new(values, rule).or_else(unmoved).ok_or_else(empty)?;
    let within = |key: &str, value: Option<f64>, default: f64, [min, max]: [f64; 2], unit: &str| match value {
        Some(value) if !(min..=max).contains(&value) => Err(StudyError::key(
            format!("control.{key}"),
            format!("{value}{unit} is out of range (allowed: {min} to {max}{unit})"),
        )),
        value => Ok(value.unwrap_or(default)),
    };
    const LUX: [f64; 2] = [0.0, 1e6];
    settings.threshold = within("threshold", keys.threshold, 0.0, LUX, " lx")?;
    // Checked only: left out, these mean never, for which there is no number.
    within("close_above", keys.close_above, 0.0, LUX, " lx")?;
    within("open_below", keys.open_below, 0.0, LUX, " lx")?;
    within("indoor", keys.indoor, 0.0, LUX, " lx")?;
    (settings.close_above, settings.open_below) = (keys.close_above, keys.open_below);
    settings.release = within("release", keys.release, 1.0, [0.0, 1.0], "")?;
    settings.hysteresis = within("hysteresis", keys.hysteresis, 0.0, [0.0, 360.0], "")?.to_radians();
    settings.dwell = 60.0 * within("dwell", keys.dwell, 0.0, [0.0, 1440.0], " min")?;
    for (key, name, place) in [
        (&keys.open_state, "control.open_state", &mut settings.open),
        (&keys.closed_state, "control.closed_state", &mut settings.closed),
        (&keys.night_state, "control.night_state", &mut settings.night),
    ] {
        if let Some(key) = key {
            *place = device.state(key, name)?;
        }
    }
    // After `open_state`, which also rules the night unless that is named.
    if keys.night_state.is_none() {
        settings.night = settings.open;
    }
    Ok(settings)
}

/// Creates the rule of the controller from the keys of the mode.
fn rule(keys: &ControlKeys, device: &Device, base: &Path) -> Result<Rule, StudyError> {
    let rounding = |default| match keys.rounding {
        Some(RoundingKey::Closed) => Rounding::Closed,
        Some(RoundingKey::Nearest) => Rounding::Nearest,
        None => default,
    };
    let named = || keys.state.as_deref().map_or(Ok(0), |key| device.state(key, "control.state"));
    Ok(match keys.mode {
        ControlMode::CutOff => {
            let tolerance = keys.tolerance.unwrap_or(0.0);
            if !(0.0..=45.0).contains(&tolerance) {
                let message = format!("{tolerance}° is out of range (allowed: 0 to 45°)");
                return Err(StudyError::key("control.tolerance", message));
            }
            // The slats that the scene describes replace those of the product.
            let described = keys.slats.as_ref().map(section_from_keys).transpose()?;
            match described.or_else(|| device.section.clone()) {
                Some(section) => Rule::CutOff { section, tolerance: tolerance.to_radians() },
                None if device.curve.is_empty() => {
                    let message = format!(
                        "'{}' has neither slats nor a control curve; give control.slats, or use \"din-5034\" or \"fixed\"",
                        device.name
                    );
                    return Err(StudyError::key("control.mode", message));
                }
                // Without a section the maker's own curve replaces the cut-off; rounded to the nearest it could let
                // the sun in.
                None => Rule::Curve(radians(&device.curve), Rounding::Closed),
            }
        }
        ControlMode::Din5034 => Rule::Din5034,
        ControlMode::Curve => Rule::Curve(radians(&curve(keys, device, base)?), rounding(Rounding::Closed)),
        ControlMode::RetroReflect => Rule::RetroReflect(rounding(Rounding::Closed)),
        ControlMode::Redirect => {
            // Here the aim is where light goes, not that none comes in: the nearest state serves it best.
            let elevation = keys.elevation.unwrap_or(DEFAULT_ELEVATION);
            if !(-90.0..=90.0).contains(&elevation) {
                let message = format!("{elevation}° is out of range (allowed: -90 to 90°)");
                return Err(StudyError::key("control.elevation", message));
            }
            Rule::Redirect(elevation.to_radians(), rounding(Rounding::Nearest))
        }
        ControlMode::Fixed => Rule::Fixed(named()?),
        ControlMode::User => {
            let periods: Vec<Period> =
                keys.schedule.iter().map(|keys| period(keys, device)).collect::<Result<_, _>>()?;
            distinct(&periods, &keys.schedule)?;
            // Between the periods: the state that is named, else the product's first.
            Rule::User(named()?, periods)
        }
        ControlMode::Table => Rule::Table(table::read(keys.file.as_deref(), device, base)?),
    })
}

/// Default elevation in which light is redirected; it then reaches the ceiling deep in a room of usual height. \[°\]
pub const DEFAULT_ELEVATION: f64 = 30.0;

fn radians(curve: &[[f64; 2]]) -> Vec<(f64, f64)> {
    curve.iter().map(|[angle, value]| (angle.to_radians(), value.to_radians())).collect()
}

/// Returns the curve of mode "curve" – that of the scene or its file, or else the product's – as points: profile angle
/// of the sun \[°\], and number of the state such as the slat angle \[°\]. `base`: folder of the scene.
pub fn curve(keys: &ControlKeys, device: &Device, base: &Path) -> Result<Vec<[f64; 2]>, StudyError> {
    if let Some(file) = &keys.curve_file {
        if !keys.curve.is_empty() {
            return Err(StudyError::key("control.curve", "give curve or curve_file, not both"));
        }
        let path = base.join(file);
        let wrong = |message: String| StudyError::key("control.curve_file", format!("{}: {message}", path.display()));
        let length = std::fs::metadata(&path).map_err(|error| wrong(error.to_string()))?.len();
        if length > LARGEST_CURVE {
            return Err(wrong(format!("{length} bytes; curves of up to {LARGEST_CURVE} bytes are read")));
        }
        files::keep(&path);
        let bytes = std::fs::read(&path).map_err(|error| wrong(error.to_string()))?;
        return read_control_curve(&bytes).map_err(|error| wrong(error.to_string()));
    }
    if keys.curve.is_empty() {
        if device.curve.is_empty() {
            let message = format!("'{}' has no control curve; give control.curve or control.curve_file", device.name);
            return Err(StudyError::key("control.mode", message));
        }
        return Ok(device.curve.clone());
    }
    let finite = keys.curve.iter().flatten().all(|number| number.is_finite());
    let rising = keys.curve.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if !finite || !rising || keys.curve.iter().any(|point| point[0].abs() > 90.0) {
        let message = "profile angles must rise, from -90 to 90°, and all numbers be finite";
        return Err(StudyError::key("control.curve", message));
    }
    Ok(keys.curve.clone())
}

/// Creates a period of mode "user" from its keys, after checking times and state.
fn period(keys: &PeriodKeys, device: &Device) -> Result<Period, StudyError> {
    let hour = |text: &str| {
        let (hours, minutes) = text.split_once(':')?;
        let (hours, minutes): (u32, u32) = (hours.parse().ok()?, minutes.parse().ok()?);
        (minutes < 60 && 60 * hours + minutes <= 24 * 60).then(|| f64::from(hours) + f64::from(minutes) / 60.0)
    };
    let read = |text: &str| {
        hour(text).ok_or_else(|| {
            StudyError::key(
                "control.schedule",
                format!("\"{text}\" is not a time of the day: write HH:MM, 00:00 to 24:00"),
            )
        })
    };
    Ok(Period { from: read(&keys.from)?, to: read(&keys.to)?, state: device.state(&keys.state, "control.schedule")? })
}

/// Checks that periods do not overlap, because the state would then depend on their order.
fn distinct(periods: &[Period], keys: &[PeriodKeys]) -> Result<(), StudyError> {
    let spans = |period: &Period| {
        if period.from <= period.to {
            [(period.from, period.to), (0.0, 0.0)]
        } else {
            [(period.from, 24.0), (0.0, period.to)]
        }
    };
    let overlap = |one: &Period, other: &Period| {
        let shared = |a: &(f64, f64)| spans(other).iter().any(|b| a.0.max(b.0) < a.1.min(b.1));
        spans(one).iter().any(shared)
    };
    for (place, period) in periods.iter().enumerate() {
        if let Some(earlier) = periods[..place].iter().position(|other| overlap(other, period)) {
            let [a, b] = [&keys[earlier], &keys[place]].map(|keys| format!("{} to {}", keys.from, keys.to));
            let message = format!("the periods {a} and {b} overlap; expected one state at every time of the day");
            return Err(StudyError::key("control.schedule", message));
        }
    }
    Ok(())
}
