//! What control does with a moving product: which rule, which state at which hour of today and of the year.
//!
//! Today and the year are told for a sun that shines: which hours it is before the façade, and which state it asks for.

use super::moment;
use super::state::State;
use crate::catalogue::Product;
use crate::compute::direction::Surface;
use crate::compute::estimate::Progress;
pub use crate::study::control::year::CONTROLLED;
use crate::study::control::year::{ClearSky, Moment, Moving, Setting, Situation, day, year as study_year};
use crate::study::control::{Device, curve, settings};
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile, SurfaceKey};
use jiff::civil::Date;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Minutes between the hours of a year.
const YEAR_STEP: u32 = 60;
/// Minutes between the points of today.
const DAY_STEP: u32 = 30;

/// What the window calls a rule.
pub const fn word(mode: ControlMode) -> &'static str {
    match mode {
        ControlMode::Fixed => "fixed by hand",
        ControlMode::Curve => "follows the curve",
        ControlMode::CutOff => "keeps the sun just out (cut-off)",
        ControlMode::Din5034 => "closed in sun (DIN 5034)",
        ControlMode::RetroReflect => "throws the sun back",
        ControlMode::Redirect => "redirects the sun",
        ControlMode::User => "by the user's clock",
    }
}

/// Where an aperture of the scene lies; the façade where there is none.
pub fn surface_of(scene: &SceneFile, aperture: usize) -> Surface {
    match scene.aperture.get(aperture).map(|aperture| aperture.surface) {
        Some(SurfaceKey::Roof) => Surface::Roof,
        _ => Surface::Facade,
    }
}

/// Where the scene's first aperture lies.
pub fn surface(scene: &SceneFile) -> Surface {
    surface_of(scene, 0)
}

/// The rule of an aperture: its own, else the scene's.
pub fn rule(scene: &SceneFile, aperture: usize) -> Option<&ControlKeys> {
    scene.aperture.get(aperture).and_then(|aperture| aperture.control.as_ref()).or(scene.control.as_ref())
}

/// Place, façade and rule: all that a year of control hangs on.
#[derive(Debug, Clone, PartialEq)]
pub struct YearKey {
    /// Which product moves.
    pub product: String,
    /// By which rule; "fixed" with the state that is set by hand.
    pub keys: ControlKeys,
    situation: Situation,
    surface: Surface,
    base: PathBuf,
}

impl YearKey {
    /// Of the window's scene and selection; `None` without place and date.
    pub fn new(state: &State, product: &str) -> Option<Self> {
        let scene = &state.document.scene;
        moment::of(scene)?;
        Some(Self {
            product: product.to_owned(),
            keys: state.control_keys(),
            situation: Situation::of(scene).ok()?,
            surface: surface_of(scene, state.control_aperture()),
            base: state.base(),
        })
    }

    fn moving(&self, product: &Product) -> Result<Vec<Moving>, String> {
        let device = Device::of(product).map_err(|error| error.to_string())?;
        let section = device.section.clone();
        Ok(vec![Moving { aperture: 1, surface: self.surface, device, keys: self.keys.clone(), section }])
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
    /// How often the device moves.
    pub movements: usize,
}

/// Keys and numbers of the states, by rising value. Without numbers their order stands for them.
pub fn ordered_states(product: &Product) -> Vec<(String, f64)> {
    let number = |(i, state): (usize, &crate::catalogue::State)| (state.key.clone(), state.value.unwrap_or(i as f64));
    let mut list: Vec<(String, f64)> = product.states.iter().enumerate().map(number).collect();
    list.sort_by(|a, b| a.1.total_cmp(&b.1));
    list
}

/// Profile angle \[°\] and place of the state among the ordered ones; `None` while the sun is not before the façade.
fn seen(product: &Product, states: &[String], setting: &Setting) -> Option<(f64, u16)> {
    let psi = setting.profile_angle?;
    let key = &product.states[setting.state].key;
    let index = states.iter().position(|state| state == key).unwrap_or(0);
    Some((psi.to_degrees(), u16::try_from(index).unwrap_or(u16::MAX)))
}

fn ordered_keys(product: &Product) -> Vec<String> {
    ordered_states(product).into_iter().map(|(state, _)| state).collect()
}

/// The year of a product. Called in a job.
pub fn year(product: &Arc<Product>, key: YearKey, progress: &dyn Progress) -> Result<Year, String> {
    let moving = key.moving(product)?;
    let moments = study_year(&key.situation, &key.base, &moving, YEAR_STEP, &ClearSky, progress)
        .map_err(|error| error.to_string())?;
    let states = ordered_keys(product);
    let of = |moment: &Moment| seen(product, &states, &moment.settings[0]).map(|(_, index)| index);
    let hours = moments.iter().map(of).collect();
    let movements = moments.iter().filter(|moment| moment.settings[0].moved).count();
    Ok(Year { key, states, hours, movements })
}

/// A point of today: hour, profile angle \[°\] and state, or neither while the sun is not before the façade.
pub type TodayPoint = (f64, Option<(f64, u16)>);

/// Every half hour of the scene's day.
pub fn today(product: &Product, key: &YearKey, scene: &SceneFile) -> Result<Vec<TodayPoint>, String> {
    let Some(time) = moment::of(scene) else { return Ok(Vec::new()) };
    let date: Date = time.date();
    let moving = key.moving(product)?;
    let moments =
        day(&key.situation, &key.base, &moving, date, DAY_STEP, &ClearSky).map_err(|error| error.to_string())?;
    let states = ordered_keys(product);
    let hour = |step: usize| step as f64 * f64::from(DAY_STEP) / 60.0;
    Ok(moments.iter().enumerate().map(|(k, moment)| (hour(k), seen(product, &states, &moment.settings[0]))).collect())
}

/// What a rule asks for at profile angles: points of its curve (profile angle \[°\], value); none for rules without one.
pub fn rule_curve(product: &Product, keys: &ControlKeys, base: &Path) -> Result<Vec<[f64; 2]>, String> {
    let told = |error: crate::study::StudyError| error.to_string();
    let device = Device::of(product).map_err(told)?;
    if keys.mode == ControlMode::Curve {
        return curve(keys, &device, base).map_err(told);
    }
    let settings = settings(keys, &device, base).map_err(told)?;
    Ok(settings.curve().into_iter().map(|(psi, value)| [psi.to_degrees(), value.to_degrees()]).collect())
}
