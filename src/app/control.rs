//! What control does with a moving product: which rule, which state at which hour of today and of the year.
//!
//! Today and the year are told for a sun that shines: which hours it is before the façade, and which state it asks for.

use super::moment;
use crate::catalogue::Product;
use crate::compute::angle::Bearing;
use crate::compute::control::profile_angle;
use crate::compute::direction::{Dir, Orientation, Surface};
use crate::compute::estimate::Progress;
use crate::compute::lid::Facing;
use crate::compute::sky::{Distribution, Outside, Sun};
use crate::study::control::pick_state;
use crate::study::scene_file::{ControlMode, SceneFile, SurfaceKey};
use crate::study::sun_position::{Place, sun_position};
use jiff::ToSpan;
use jiff::civil::{Date, date};
use std::sync::Arc;

/// The word that leaves an aperture's state to the scene's control.
pub const CONTROLLED: &str = "controlled";

/// What the window calls a rule.
pub const fn word(mode: ControlMode) -> &'static str {
    match mode {
        ControlMode::Fixed => "fixed by hand",
        ControlMode::Curve => "follows the curve",
        ControlMode::CutOff => "follows the cut-off curve",
        ControlMode::Din5034 => "closed in sun (DIN 5034)",
    }
}

/// Where the scene's first aperture lies.
pub fn surface(scene: &SceneFile) -> Surface {
    match scene.aperture.first().map(|aperture| aperture.surface) {
        Some(SurfaceKey::Roof) => Surface::Roof,
        _ => Surface::Facade,
    }
}

/// Place, façade and rule: all that a year of control hangs on.
#[derive(Debug, Clone, PartialEq)]
pub struct YearKey {
    /// Which product moves.
    pub product: String,
    /// By which rule.
    pub mode: ControlMode,
    /// The state that is set by hand; empty while a rule picks.
    pub fixed: String,
    place: Place,
    year: i16,
    azimuth: f64,
    roof: bool,
    skyline: f64,
}

impl YearKey {
    /// Of a scene and a selection; `None` without place and date.
    pub fn new(scene: &SceneFile, product: &str, mode: ControlMode, fixed: &str) -> Option<Self> {
        Some(Self {
            product: product.to_owned(),
            mode,
            fixed: if mode == ControlMode::Fixed { fixed.to_owned() } else { String::new() },
            place: moment::place(scene)?,
            year: moment::of(scene)?.year(),
            azimuth: scene.site.azimuth,
            roof: surface(scene) == Surface::Roof,
            skyline: scene.sky.obstruction.map_or(0.0, |keys| keys.altitude),
        })
    }

    fn surface(&self) -> Surface {
        if self.roof { Surface::Roof } else { Surface::Facade }
    }
}

/// A state for every hour of the year.
#[derive(Debug, Clone, PartialEq)]
pub struct Year {
    /// Of what.
    pub key: YearKey,
    /// Keys of the states, by rising value.
    pub states: Vec<String>,
    /// Day by day, the middle of each hour; `None` while the sun is not before the façade.
    pub hours: Vec<Option<u16>>,
}

/// Keys and numbers of the states, by rising value. Without numbers their order stands for them.
pub fn ordered_states(product: &Product) -> Vec<(String, f64)> {
    let number = |(i, state): (usize, &crate::catalogue::State)| (state.key.clone(), state.value.unwrap_or(i as f64));
    let mut list: Vec<(String, f64)> = product.states.iter().enumerate().map(number).collect();
    list.sort_by(|a, b| a.1.total_cmp(&b.1));
    list
}

/// Picks states for suns before one façade.
struct Chooser<'a> {
    product: &'a Product,
    key: &'a YearKey,
    states: Vec<String>,
    outside: Outside,
}

impl<'a> Chooser<'a> {
    fn new(product: &'a Product, key: &'a YearKey) -> Result<Self, String> {
        let states = ordered_states(product).into_iter().map(|(state, _)| state).collect();
        let outside = Outside::new(Distribution::uniform(), 1.0)
            .and_then(|outside| outside.with_skyline(key.skyline.to_radians(), 0.0))
            .map_err(|error| error.to_string())?;
        Ok(Self { product, key, states, outside })
    }

    /// Profile angle \[°\] and index of the state; `None` while the sun is not before the façade.
    fn at(&self, day: Date, hour: f64) -> Result<Option<(f64, u16)>, String> {
        let minutes = (hour * 60.0).round() as i64;
        let Ok(time) = day.at(0, 0, 0, 0).checked_add(minutes.minutes()) else { return Ok(None) };
        let (altitude, bearing) = sun_position(&self.key.place, time).map_err(|error| error.to_string())?;
        let sun = Sun { direction: Dir::from_altitude_bearing(altitude, bearing), direct_normal: 1.0 };
        let facing = Facing {
            outside: &self.outside,
            sun: Some(&sun),
            orientation: Orientation::new(Bearing::from_degrees(self.key.azimuth)),
            surface: self.key.surface(),
        };
        if altitude <= 0.0 || facing.sun_illuminance() <= 0.0 {
            return Ok(None);
        }
        let Some(psi) = facing.sun_direction().and_then(profile_angle) else { return Ok(None) };
        let picked = match self.key.mode {
            ControlMode::Fixed => self.key.fixed.clone(),
            mode => pick_state(self.product, mode, &facing).map_err(|error| error.to_string())?,
        };
        let index = self.states.iter().position(|state| *state == picked).unwrap_or(0);
        Ok(Some((psi.to_degrees(), u16::try_from(index).unwrap_or(u16::MAX))))
    }
}

/// The year of a product. Called in a job.
pub fn year(product: &Arc<Product>, key: YearKey, progress: &dyn Progress) -> Result<Year, String> {
    let chooser = Chooser::new(product, &key)?;
    let first = Date::new(key.year, 1, 1).map_err(|error| error.to_string())?;
    let days = usize::try_from(first.days_in_year()).unwrap_or(365);
    let mut hours = Vec::with_capacity(24 * days);
    let mut day = first;
    for number in 0..days {
        if progress.cancelled() {
            return Err("withdrawn".to_owned());
        }
        progress.advance("days", number, days);
        for hour in 0..24 {
            hours.push(chooser.at(day, f64::from(hour) + 0.5)?.map(|(_, index)| index));
        }
        day = day.tomorrow().map_err(|error| error.to_string())?;
    }
    let states = chooser.states;
    Ok(Year { key, states, hours })
}

/// A point of today: hour, profile angle \[°\] and state, or neither while the sun is not before the façade.
pub type TodayPoint = (f64, Option<(f64, u16)>);

/// Every half hour of the scene's day.
pub fn today(product: &Product, key: &YearKey, scene: &SceneFile) -> Result<Vec<TodayPoint>, String> {
    let Some(time) = moment::of(scene) else { return Ok(Vec::new()) };
    let chooser = Chooser::new(product, key)?;
    let day = date(time.year(), time.month(), time.day());
    (0..=48).map(|i| 0.5 * f64::from(i)).map(|hour| Ok((hour, chooser.at(day, hour)?))).collect()
}
