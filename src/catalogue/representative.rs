//! By which rule a moving product works when nobody has said otherwise, and which of its states stands for it: in lists,
//! in thumbnails, and when it is set by hand.
//!
//! | the product | rule | state that stands for it |
//! | --- | --- | --- |
//! | has one state | none | that one |
//! | brings a control curve, and its states are numbered | its curve | what the curve asks for at [`TYPICAL_SUN`], the least closed state that reaches it |
//! | lying slats whose upper face mirrors most of what it reflects | redirect | the state nearest to the tilt that sends that sun to 30° above the horizontal |
//! | other lying slats | cut-off | the most open state that keeps that sun out |
//! | anything else: upright slats, screens, switchable glazing | by hand | the most open: the highest transmittance under uniform luminance; of equals the number nearest to 0, then the first |
//!
//! A rule that reads numbers is never chosen for states without numbers, and none that follows the profile angle for
//! slats that stand upright: their shadows do not depend on it.

use super::{CurvePoint, Product, blind_of};
use crate::compute::control::controller::cut_off_state;
use crate::compute::control::curve::{curve_value, redirecting_tilt};
use crate::compute::control::cut_off::SlatRow;
use crate::compute::control::states::{nearest, towards_closed};
use crate::compute::system::slats::Venetian;

/// Profile angle of the sun for which a state stands for its product: about that of an equinox noon on a south façade at
/// 50° of latitude. \[°\]
pub const TYPICAL_SUN: f64 = 40.0;
/// Elevation to which mirrors send it, as the rule does when it is told nothing else. \[°\]
const ELEVATION: f64 = 30.0;
/// Transmittances closer than this are the same.
const SAME: f64 = 1e-6;

/// The rule of a product that was just chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FirstRule {
    /// Its state is set by hand.
    #[default]
    ByHand,
    /// Its own control curve.
    Curve,
    /// The sun is kept just out.
    CutOff,
    /// Mirrors send the sun to the ceiling.
    Redirect,
}

/// What is known of a state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Numbers {
    /// Its number. \[°\]
    pub value: Option<f64>,
    /// Visible transmittance under uniform luminance.
    pub tau_hemispherical: Option<f64>,
}

/// The rule of a product, and the place of the state that stands for it. `system`: its description, empty for others.
pub fn representative(states: &[Numbers], curve: &[CurvePoint], system: &str) -> (FirstRule, usize) {
    let values: Option<Vec<f64>> = states.iter().map(|state| state.value.filter(|value| value.is_finite())).collect();
    by_rule(values.as_deref(), curve, system).unwrap_or_else(|| (FirstRule::ByHand, most_open(states)))
}

impl Product {
    /// The rule by which it works when nobody has said otherwise, and the place of the state that stands for it.
    pub fn representative(&self) -> (FirstRule, usize) {
        let numbers = |state: &super::State| Numbers { value: state.value, tau_hemispherical: state.tau_hemispherical };
        representative(&self.states.iter().map(numbers).collect::<Vec<_>>(), &self.control_curve, &self.system)
    }

    /// May a state turn out to stand for it? Where a rule decides, one does, whatever the data are.
    pub fn may_represent(&self, state: &str) -> bool {
        let values: Option<Vec<f64>> = self.states.iter().map(|one| one.value.filter(|v| v.is_finite())).collect();
        by_rule(values.as_deref(), &self.control_curve, &self.system)
            .is_none_or(|(_, place)| self.states[place].key == state)
    }
}

fn by_rule(values: Option<&[f64]>, curve: &[CurvePoint], system: &str) -> Option<(FirstRule, usize)> {
    let values = values.filter(|values| values.len() > 1)?;
    if !curve.is_empty() {
        let points: Vec<(f64, f64)> = curve.iter().map(|point| (point.profile_angle, point.value)).collect();
        return Some((FirstRule::Curve, towards_closed(values, curve_value(&points, TYPICAL_SUN)?)?));
    }
    if system.is_empty() {
        return None;
    }
    let (blind, psi) = (blind_of(system)?, TYPICAL_SUN.to_radians());
    if mirrors(&blind) {
        let tilt = redirecting_tilt(psi, ELEVATION.to_radians()).to_degrees();
        return Some((FirstRule::Redirect, nearest(values, tilt)?));
    }
    let row = SlatRow::of(&blind)?;
    let tilts: Vec<f64> = values.iter().map(|value| value.to_radians()).collect();
    let state = cut_off_state(&row, &tilts, 0.0, [psi, psi]);
    Some((FirstRule::CutOff, state))
}

/// Does the upper face mirror most of what it reflects, so that the slats can send light on?
fn mirrors(blind: &Venetian) -> bool {
    blind.upper.mirror > 0.5 && blind.upper.mirror > blind.upper.diffuse
}

fn most_open(states: &[Numbers]) -> usize {
    let tau = |place: usize| states[place].tau_hemispherical.filter(|tau| tau.is_finite());
    let highest = (0..states.len()).filter_map(tau).fold(f64::NEG_INFINITY, f64::max);
    let aside = |place: &usize| states[*place].value.map_or(f64::INFINITY, f64::abs);
    // The first of equals, as `min_by` gives it.
    let open = (0..states.len()).filter(|place| tau(*place).is_none_or(|tau| tau > highest - SAME));
    let known = open.filter(|place| highest == f64::NEG_INFINITY || tau(*place).is_some());
    known.min_by(|a, b| aside(a).total_cmp(&aside(b))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn states(list: &[(f64, f64)]) -> Vec<Numbers> {
        list.iter().map(|&(value, tau)| Numbers { value: Some(value), tau_hemispherical: Some(tau) }).collect()
    }

    fn slats(head: &str, upper: &str) -> String {
        format!(
            "name = \"x\"\nkind = \"venetian\"\n{head}[venetian]\nwidth = 0.08\nspacing = 0.072\n\
             angles = {{ from = -90.0, to = 90.0, step = 15.0 }}\nupper = {{ {upper} }}\nlower = {{ reflectance = 0.5 }}\n"
        )
    }

    #[test]
    fn a_curve_is_followed_at_a_typical_sun() {
        let list = states(&[(-90.0, 0.0), (0.0, 0.7), (15.0, 0.6), (30.0, 0.4), (90.0, 0.0)]);
        let curve = [(0.0, 60.0), (80.0, 0.0)].map(|(profile_angle, value)| CurvePoint { profile_angle, value });
        // 30° at 40° of profile angle; were it a little more, the next closed one.
        assert_eq!(representative(&list, &curve, ""), (FirstRule::Curve, 3));
        let more = [CurvePoint { profile_angle: 0.0, value: 31.0 }];
        assert_eq!(representative(&list, &more, ""), (FirstRule::Curve, 4));
        // States without numbers cannot follow it.
        let named = [Numbers { value: None, tau_hemispherical: Some(0.1) }; 2];
        assert_eq!(representative(&named, &curve, ""), (FirstRule::ByHand, 0));
    }

    #[test]
    fn slats_without_a_curve_shade_or_redirect_by_their_finish() {
        let angles: Vec<(f64, f64)> = (-6..=6).map(|k| (f64::from(15 * k), 0.5)).collect();
        let list = states(&angles);
        let rule = |head: &str, upper: &str| {
            let (rule, state) = representative(&list, &[], &slats(head, upper));
            (rule, angles[state].0)
        };
        // asin(0.9 cos 40°) − 40° = 3.6°, up to the next state.
        assert_eq!(rule("", "reflectance = 0.6"), (FirstRule::CutOff, 15.0));
        // ½ (30° − 40°) = −5°.
        assert_eq!(rule("", "reflectance = 0.05, specular = 0.8"), (FirstRule::Redirect, 0.0));
        // Upright slats do not follow the profile angle.
        assert_eq!(rule("upright = true\n", "reflectance = 0.05, specular = 0.8"), (FirstRule::ByHand, 0.0));
    }

    #[test]
    fn without_a_rule_the_most_open_state_stands_for_all() {
        let by_hand = |list: &[Numbers]| {
            let (rule, state) = representative(list, &[], "");
            assert_eq!(rule, FirstRule::ByHand);
            state
        };
        assert_eq!(by_hand(&states(&[(-90.0, 0.0), (-30.0, 0.5), (0.0, 0.7), (30.0, 0.5)])), 2);
        assert_eq!(by_hand(&states(&[(-30.0, 0.5), (-10.0, 0.5), (30.0, 0.5)])), 1);
        let tints = [0.02, 0.6, f64::NAN].map(|tau| Numbers { value: None, tau_hemispherical: Some(tau) });
        assert_eq!(by_hand(&tints), 1);
        assert_eq!((by_hand(&[Numbers::default(); 3]), by_hand(&[])), (0, 0));
    }
}
