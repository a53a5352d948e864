//! What control does with a moving product: which rule, which state at which hour of today and of the year.
//!
//! Today and the year are told for a sun that shines: which hours it is before the façade, and which state it asks for.

use super::StudyError;
use super::control::year::{Moment, Moving, Setting, Situation, day, year as study_year};
use super::control::{Device, curve, settings};
use super::moment;
use super::scene_file::{ControlKeys, ControlMode, SceneFile};
use super::scene_places::opening;
use crate::catalogue::{FirstRule, Product, State};
use crate::compute::estimate::Progress;
use crate::compute::room::aperture::Aperture;
use crate::texts::{Text, decimal, words as texts};
use jiff::civil::Date;
use std::path::{Path, PathBuf};

/// Minutes between the hours of a year.
const YEAR_STEP: u32 = 60;
/// Minutes between the points of today.
const DAY_STEP: u32 = 30;

/// What people call a rule.
pub struct Words {
    /// In a list.
    pub short: &'static str,
    /// As what a product does.
    pub does: &'static str,
    /// As what it is told to do.
    pub order: &'static str,
    /// One sentence.
    pub tip: &'static str,
}

/// What people call a rule, in the language that is spoken.
pub fn words(mode: ControlMode) -> Words {
    use texts::*;
    let [short, does, order, tip] = match mode {
        ControlMode::Fixed => [BY_HAND, BY_HAND_DOES, BY_HAND_ORDER, BY_HAND_TIP],
        ControlMode::Curve => [CURVE, CURVE_DOES, CURVE_ORDER, CURVE_TIP],
        ControlMode::CutOff => [CUT_OFF, CUT_OFF_DOES, CUT_OFF_ORDER, CUT_OFF_TIP],
        ControlMode::Din5034 => [DIN_5034, DIN_5034_DOES, DIN_5034_DOES, DIN_5034_TIP],
        ControlMode::RetroReflect => [RETRO, RETRO_DOES, RETRO_ORDER, RETRO_TIP],
        ControlMode::Redirect => [REDIRECT, REDIRECT_DOES, REDIRECT_ORDER, REDIRECT_TIP],
        ControlMode::User => [USER, USER_DOES, USER_DOES, USER_TIP],
        ControlMode::Table => [TABLE, TABLE_DOES, TABLE_DOES, TABLE_TIP],
    }
    .map(Text::get);
    Words { short, does, order, tip }
}

/// A state in words: slat angles and other numbers as degrees, else as the product calls it.
pub fn state_words(state: &State) -> String {
    match state.value {
        // A key that is the number: the format wrote an angle.
        Some(value) if state.key.parse() == Ok(value) => decimal(format!("{value}°")),
        _ if state.label.is_empty() => state.key.clone(),
        _ => state.label.clone(),
    }
}

/// The control of a product that was just chosen; `None`: by hand.
pub fn first_keys(rule: FirstRule) -> Option<ControlKeys> {
    let mode = match rule {
        FirstRule::ByHand => return None,
        FirstRule::Curve => ControlMode::Curve,
        FirstRule::CutOff => ControlMode::CutOff,
        FirstRule::Redirect => ControlMode::Redirect,
    };
    Some(ControlKeys::of(mode))
}

/// Place, façade and rule: all that a year of control hangs on.
#[derive(Debug, Clone, PartialEq)]
pub struct YearKey {
    /// Which product moves.
    pub product: String,
    /// By which rule; "fixed" with the state that is set by hand.
    pub keys: ControlKeys,
    situation: Situation,
    opening: Aperture,
    base: PathBuf,
}

impl YearKey {
    /// Of a scene in whose `aperture`, from 0, one product moves by these keys; `None` without place and date.
    pub fn new(scene: &SceneFile, product: &str, keys: ControlKeys, aperture: usize, base: PathBuf) -> Option<Self> {
        moment::of(scene)?;
        let (situation, opening) = (Situation::of(scene).ok()?, opening(scene, aperture).ok()??);
        Some(Self { product: product.to_owned(), keys, situation, opening, base })
    }

    /// Why a scene has no year of control, and what can be done.
    pub fn missing(scene: &SceneFile) -> Option<String> {
        if moment::of(scene).is_none() {
            return Some(texts::YEAR_NEEDS_DATE.into());
        }
        let place = Situation::of(scene).err();
        place.or_else(|| opening(scene, 0).err()).map(texts::no_year)
    }

    fn moving(&self, product: &Product) -> Result<Vec<Moving>, StudyError> {
        let device = Device::of(product)?;
        let section = device.section.clone();
        Ok(vec![Moving { aperture: 1, opening: self.opening, device, keys: self.keys.clone(), section }])
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
    let number = |(i, state): (usize, &State)| (state.key.clone(), state.value.unwrap_or(i as f64));
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
pub fn year(product: &Product, key: YearKey, progress: &dyn Progress) -> Result<Year, StudyError> {
    let moving = key.moving(product)?;
    let moments = study_year(&key.situation, &key.base, &moving, YEAR_STEP, &key.situation.sky, progress)?;
    let states = ordered_keys(product);
    let of = |moment: &Moment| seen(product, &states, &moment.settings[0]).map(|(_, index)| index);
    let hours = moments.iter().map(of).collect();
    let movements = moments.iter().filter(|moment| moment.settings[0].moved).count();
    Ok(Year { key, states, hours, movements })
}

/// A point of today: hour, profile angle \[°\] and state, or neither while the sun is not before the façade.
pub type TodayPoint = (f64, Option<(f64, u16)>);

/// Every half hour of the scene's day.
pub fn today(product: &Product, key: &YearKey, scene: &SceneFile) -> Result<Vec<TodayPoint>, StudyError> {
    let Some(time) = moment::of(scene) else { return Ok(Vec::new()) };
    let date: Date = time.date();
    let moving = key.moving(product)?;
    let moments = day(&key.situation, &key.base, &moving, date, DAY_STEP, &key.situation.sky)?;
    let states = ordered_keys(product);
    let hour = |step: usize| step as f64 * f64::from(DAY_STEP) / 60.0;
    Ok(moments.iter().enumerate().map(|(k, moment)| (hour(k), seen(product, &states, &moment.settings[0]))).collect())
}

/// What a rule asks for at profile angles: points of its curve (profile angle \[°\], value); none for rules without one.
pub fn rule_curve(product: &Product, keys: &ControlKeys, base: &Path) -> Result<Vec<[f64; 2]>, StudyError> {
    let device = Device::of(product)?;
    if keys.mode == ControlMode::Curve {
        return curve(keys, &device, base);
    }
    let settings = settings(keys, &device, base)?;
    Ok(settings.curve().into_iter().map(|(psi, value)| [psi.to_degrees(), value.to_degrees()]).collect())
}

/// What the numbers of a product's states are.
pub fn quantity(product: &Product) -> &'static str {
    let numeric = product.states.iter().all(|state| state.value.is_some());
    match (numeric, product.kind.as_str()) {
        (true, "venetian" | "slats" | "venetian blind") => texts::SLAT_ANGLE,
        (true, _) => texts::STATE_ANGLE,
        (false, _) => texts::STATE,
    }
    .get()
}
