//! Exposure to sunlight and view out of a scene's apertures by EN 17037. Both follow from geometry and the path of the
//! sun alone, whatever the states of the systems.

use super::settings::Settings;
use super::steps::Steps;
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Orientation};
use crate::compute::sunlight::exposure::{Exposure, is_before, reference_height};
use crate::compute::sunlight::view_out::{EYE_HEIGHT, Met, ViewOut, from_most};
use crate::compute::surroundings::first_hit;
use crate::compute::surroundings::solid::Solid;
use crate::compute::weather::{Day, SunPath};
use crate::study::error::StudyError;
use crate::study::outside::boxes;
use crate::study::scene_file::SceneFile;
use crate::study::scene_places::{apertures, room, sensors};
use crate::study::year_keys::SunlightKeys;
use glam::DVec3;

/// Exposure to sunlight and view out of a scene by EN 17037.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// Day for which the exposure to sunlight is evaluated.
    pub day: Day,
    /// Minimum solar altitude at which the sun counts. \[rad\]
    pub least_altitude: f64,
    /// Exposure to sunlight of each aperture.
    pub by_aperture: Vec<Exposure>,
    /// Exposure to sunlight of the room: while the sun shines on any aperture.
    pub any: Exposure,
    /// View out that is reached at three quarters of the sensors' positions, for observers at a height of 1.2 m.
    pub view: ViewOut,
    /// Number of positions at which the view out was evaluated.
    pub points: usize,
}

/// Aspects of EN 17037 that are not evaluated, to be stated with the results.
pub const NOT_JUDGED: [&str; 3] = [
    "the depth of the reveal: openings count as holes in a thin wall",
    "how clear the view is through the system, and what is seen: the scene knows boxes, a skyline and the horizon",
    "the least altitude of the sun and the day, which national annexes name: year.sunlight says them",
];

/// Returns the day that the keys name, in the year of the weather record for that day if there is one.
fn day(keys: &SunlightKeys, steps: &Steps) -> Result<Day, StudyError> {
    let wrong = || {
        StudyError::key(
            "year.sunlight.date",
            format!("\"{}\" is not a day of a sunlight exposure (allowed: \"02-01\" to \"03-21\", MM-DD)", keys.date),
        )
    };
    let (month, number) = keys.date.split_once('-').ok_or_else(wrong)?;
    let (month, number): (u8, u8) = (month.parse().map_err(|_| wrong())?, number.parse().map_err(|_| wrong())?);
    if !((2, 1)..=(3, 21)).contains(&(month, number)) {
        return Err(wrong());
    }
    let same =
        |step: &&super::Step| (step.time.month(), step.time.day()) == (month.cast_signed(), number.cast_signed());
    let year = steps.list.iter().find(same).or(steps.list.first()).map_or(2001, |step| step.time.year());
    Day::new(year, month, number).ok_or_else(wrong)
}

/// Evaluates exposure to sunlight and view out of a scene at the location of the weather station.
///
/// # Errors
/// Returns an error if a key of room, apertures, boxes, sensors or `year.sunlight` is wrong.
pub fn opening(file: &SceneFile, settings: &Settings, steps: &Steps) -> Result<Opening, StudyError> {
    let keys = &settings.keys.sunlight;
    if !(0.0..=45.0).contains(&keys.min_altitude) {
        let message = format!("{}° is out of range (allowed: 0 to 45°)", keys.min_altitude);
        return Err(StudyError::key("year.sunlight.min_altitude", message));
    }
    let day = day(keys, steps)?;
    let room = room(&file.room)?;
    let openings = apertures(&file.aperture, &room)?;
    let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
    let above_ground = |(solid, _): (Solid, _)| solid.above(file.site.ground_height);
    let in_room: Vec<Solid> = boxes(file, &room)?.into_iter().map(above_ground).collect();
    let solids: Vec<Solid> = in_room.iter().map(|solid| solid.turned(orientation.turn())).collect();
    let (outside, _) = steps.even_outside(0)?;
    let skyline = outside.surroundings().and_then(|around| around.skyline.clone());
    let level = outside.skyline_altitude().sin();
    let hidden =
        |direction: DVec3| direction.z < level || skyline.as_ref().is_some_and(|skyline| skyline.covers(direction));
    let mut path = SunPath::new(&steps.station);
    path.turn_to(day.number()).map_err(|error| StudyError::key("year.sunlight.date", error.to_string()))?;
    let least_altitude = keys.min_altitude.to_radians();
    let seen: Vec<Box<dyn Fn(f64) -> bool>> = openings
        .iter()
        .map(|one| {
            let [low, _, high, _] = one.corners();
            let middle = 0.5 * (low + high);
            let point = if high.z > low.z { middle.with_z(reference_height(low.z, high.z)) } else { middle };
            let point = orientation.to_world(point);
            let outward = orientation.to_world(one.surface.room_from_facade(DVec3::Z));
            let (path, solids, hidden) = (&path, &solids, &hidden);
            let free = move |minutes: f64| {
                let sun = path.at(minutes);
                is_before(sun, outward, least_altitude)
                    && !hidden(sun)
                    && first_hit(solids.iter().enumerate(), point, sun).is_none()
            };
            Box::new(free) as Box<dyn Fn(f64) -> bool>
        })
        .collect();
    let by_aperture = seen.iter().map(Exposure::of).collect();
    let any = Exposure::of(|minutes| seen.iter().any(|free| free(minutes)));
    let met = |point: DVec3, ray: DVec3| {
        if let Some((_, distance, _)) = first_hit(in_room.iter().enumerate(), point, ray) {
            return Met::Thing(Some(distance));
        }
        let world = orientation.world_from_room(Dir::from_unit(ray)).vector();
        match () {
            () if world.z >= 0.0 && hidden(world) => Met::Thing(None),
            () if world.z < 0.0 => Met::Ground,
            () => Met::Sky,
        }
    };
    let (places, _) = sensors(&file.sensors, &room)?;
    let views: Vec<ViewOut> = places
        .iter()
        .map(|sensor| {
            let point = sensor.position.with_z(EYE_HEIGHT.min(room.size.z));
            ViewOut::of(point, &openings, |ray| met(point, ray))
        })
        .collect();
    Ok(Opening { day, least_altitude, by_aperture, any, view: from_most(&views), points: views.len() })
}
