//! Shading control of a moving product: its rule, and its states over a day and a year.
//!
//! Day and year are computed for permanent sunshine: for the hours with the sun in front of the façade, the states that
//! the rule demands.

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

/// Time step of a year. \[min\]
const YEAR_STEP: u32 = 60;
/// Time step of a day. \[min\]
const DAY_STEP: u32 = 30;

/// Texts about a control rule.
pub struct Words {
    /// Name of the rule in a list.
    pub short: &'static str,
    /// Phrase for what a product does under the rule.
    pub does: &'static str,
    /// Phrase for the rule as an instruction.
    pub order: &'static str,
    /// Description of the rule in one sentence.
    pub tip: &'static str,
}

/// Returns the texts about a control rule in the current language.
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

/// Returns the label of a state: slat angles and other numbers in degrees, else the name that the product gives.
pub fn state_words(state: &State) -> String {
    match state.value {
        // If the key is the number, the format has written an angle.
        Some(value) if state.key.parse() == Ok(value) => decimal(format!("{value}°")),
        _ if state.label.is_empty() => state.key.clone(),
        _ => state.label.clone(),
    }
}

/// Returns the control keys that a newly chosen product gets by default; `None` if its state is set by hand.
pub fn first_keys(rule: FirstRule) -> Option<ControlKeys> {
    let mode = match rule {
        FirstRule::ByHand => return None,
        FirstRule::Curve => ControlMode::Curve,
        FirstRule::CutOff => ControlMode::CutOff,
        FirstRule::Redirect => ControlMode::Redirect,
    };
    Some(ControlKeys::of(mode))
}

/// Input of a year of control: product, control keys, site and façade. Years with equal input are equal.
#[derive(Debug, Clone, PartialEq)]
pub struct YearKey {
    /// Key of the moving product.
    pub product: String,
    /// Keys of the control; mode "fixed" for a state that is set by hand.
    pub keys: ControlKeys,
    situation: Situation,
    opening: Aperture,
    base: PathBuf,
}

impl YearKey {
    /// Creates the input for a scene with one product in the aperture `aperture`, counted from 0; `None` if the scene
    /// has no site or date. `keys`: keys of the control; `base`: folder of the scene.
    pub fn new(scene: &SceneFile, product: &str, keys: ControlKeys, aperture: usize, base: PathBuf) -> Option<Self> {
        moment::of(scene)?;
        let (situation, opening) = (Situation::of(scene).ok()?, opening(scene, aperture).ok()??);
        Some(Self { product: product.to_owned(), keys, situation, opening, base })
    }

    /// Returns the reason why the control of a scene cannot be computed over a year, and the remedy; `None` if it can.
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

/// States that the control of a product demands in every hour of a year.
#[derive(Debug, Clone, PartialEq)]
pub struct Year {
    /// Input from which the year was computed.
    pub key: YearKey,
    /// Keys of the states, in ascending order of their numbers.
    pub states: Vec<String>,
    /// Index of the state in the middle of each hour, day by day; `None` while the sun is not in front of the façade.
    pub hours: Vec<Option<u16>>,
    /// Number of state changes.
    pub movements: usize,
}

/// Returns keys and numbers of the states, in ascending order of the numbers; for states without numbers their
/// positions are used.
pub fn ordered_states(product: &Product) -> Vec<(String, f64)> {
    let number = |(i, state): (usize, &State)| (state.key.clone(), state.value.unwrap_or(i as f64));
    let mut list: Vec<(String, f64)> = product.states.iter().enumerate().map(number).collect();
    list.sort_by(|a, b| a.1.total_cmp(&b.1));
    list
}

/// Returns the profile angle of the sun \[°\], and the index of the state in the list of ordered keys `states`; `None`
/// while the sun is not in front of the façade.
fn seen(product: &Product, states: &[String], setting: &Setting) -> Option<(f64, u16)> {
    let psi = setting.profile_angle?;
    let key = &product.states[setting.state].key;
    let index = states.iter().position(|state| state == key).unwrap_or(0);
    Some((psi.to_degrees(), u16::try_from(index).unwrap_or(u16::MAX)))
}

fn ordered_keys(product: &Product) -> Vec<String> {
    ordered_states(product).into_iter().map(|(state, _)| state).collect()
}

/// Computes the states of a product over a year. Runs as a background job.
pub fn year(product: &Product, key: YearKey, progress: &dyn Progress) -> Result<Year, StudyError> {
    let moving = key.moving(product)?;
    let moments = study_year(&key.situation, &key.base, &moving, YEAR_STEP, &key.situation.sky, progress)?;
    let states = ordered_keys(product);
    let of = |moment: &Moment| seen(product, &states, &moment.settings[0]).map(|(_, index)| index);
    let hours = moments.iter().map(of).collect();
    let movements = moments.iter().filter(|moment| moment.settings[0].moved).count();
    Ok(Year { key, states, hours, movements })
}

/// State at one time of a day: hour of the day \[h\], and profile angle of the sun \[°\] with the index of the state;
/// `None` while the sun is not in front of the façade.
pub type TodayPoint = (f64, Option<(f64, u16)>);

/// Computes the states of a product for every half hour of the scene's day.
pub fn today(product: &Product, key: &YearKey, scene: &SceneFile) -> Result<Vec<TodayPoint>, StudyError> {
    let Some(time) = moment::of(scene) else { return Ok(Vec::new()) };
    let date: Date = time.date();
    let moving = key.moving(product)?;
    let moments = day(&key.situation, &key.base, &moving, date, DAY_STEP, &key.situation.sky)?;
    let states = ordered_keys(product);
    let hour = |step: usize| step as f64 * f64::from(DAY_STEP) / 60.0;
    Ok(moments.iter().enumerate().map(|(k, moment)| (hour(k), seen(product, &states, &moment.settings[0]))).collect())
}

/// Returns the curve of a control rule as points: profile angle of the sun \[°\], and number of the state such as the
/// slat angle \[°\]; empty for rules without a curve.
pub fn rule_curve(product: &Product, keys: &ControlKeys, base: &Path) -> Result<Vec<[f64; 2]>, StudyError> {
    let device = Device::of(product)?;
    if keys.mode == ControlMode::Curve {
        return curve(keys, &device, base);
    }
    let settings = settings(keys, &device, base)?;
    Ok(settings.curve().into_iter().map(|(psi, value)| [psi.to_degrees(), value.to_degrees()]).collect())
}

/// Returns the translated name of the numbers of a product's states, such as "slat angle".
pub fn quantity(product: &Product) -> &'static str {
    let numeric = product.states.iter().all(|state| state.value.is_some());
    match (numeric, product.kind.as_str()) {
        (true, "venetian" | "slats" | "venetian blind") => texts::SLAT_ANGLE,
        (true, _) => texts::STATE_ANGLE,
        (false, _) => texts::STATE,
    }
    .get()
}
