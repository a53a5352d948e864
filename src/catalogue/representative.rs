//! Default control rule of a product with several states, and the state that represents the product in lists, in
//! thumbnails and when it is first set by hand.
//!
//! | product | rule | state that represents it |
//! | --- | --- | --- |
//! | has one state | none | the only one |
//! | has a curve and numbered states | its curve | least closed that reaches the curve at [`TYPICAL_SUN`] |
//! | horizontal slats, upper face mostly specular | redirect | nearest to the tilt that sends that sun 30° upwards |
//! | other horizontal slats | cut-off | the most open state that blocks that sun |
//! | anything else: vertical slats, screens, switchable glazing | by hand | the most open: highest hemispherical τ |
//!
//! The most open state has the highest transmittance under uniform luminance; among equals it is the one whose number
//! is nearest to 0, then the first. A rule that reads numbers is never chosen for states without numbers, and none that
//! follows the profile angle for vertical slats: their shadows do not depend on it.

use super::{CurvePoint, Product, blind_of};
use crate::compute::control::controller::cut_off_state;
use crate::compute::control::curve::{curve_value, redirecting_tilt};
use crate::compute::control::cut_off::SlatRow;
use crate::compute::control::states::{nearest, towards_closed};
use crate::compute::system::slats::Venetian;

/// Profile angle of the sun for which the representative state is chosen: about that of an equinox noon on a south
/// façade at 50° of latitude. \[°\]
pub const TYPICAL_SUN: f64 = 40.0;
/// Elevation to which specular slats redirect direct sunlight, as in the control rule with default settings. \[°\]
const ELEVATION: f64 = 30.0;
/// Difference below which transmittances τ count as equal.
const SAME: f64 = 1e-6;

/// Control rule that a newly chosen product gets by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FirstRule {
    /// State set by hand, not by a rule.
    #[default]
    ByHand,
    /// Control curve of the product: slat angle over the profile angle of the sun.
    Curve,
    /// Cut-off control: the state that just blocks direct sun.
    CutOff,
    /// Redirection of direct sunlight to the ceiling by specular slats.
    Redirect,
}

/// Number and transmittance of a state, as far as they are known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Numbers {
    /// Number of the state: an angle \[°\] or another value.
    pub value: Option<f64>,
    /// Visible hemispherical transmittance τ: of light from outside under uniform luminance.
    pub tau_hemispherical: Option<f64>,
}

/// Returns the default control rule of a product, and the index of the state that represents it. `curve`: control curve
/// of the product, may be empty; `system`: text of its system description, empty for products without one.
pub fn representative(states: &[Numbers], curve: &[CurvePoint], system: &str) -> (FirstRule, usize) {
    let values: Option<Vec<f64>> = states.iter().map(|state| state.value.filter(|value| value.is_finite())).collect();
    by_rule(values.as_deref(), curve, system).unwrap_or_else(|| (FirstRule::ByHand, most_open(states)))
}

impl Product {
    /// Returns the default control rule of the product, and the index of the state that represents it.
    pub fn representative(&self) -> (FirstRule, usize) {
        let numbers = |state: &super::State| Numbers { value: state.value, tau_hemispherical: state.tau_hemispherical };
        representative(&self.states.iter().map(numbers).collect::<Vec<_>>(), &self.control_curve, &self.system)
    }

    /// Whether a state can represent the product. Where a control rule determines the representative state, only that
    /// one can; otherwise any, depending on the transmittances.
    pub fn may_represent(&self, state: &str) -> bool {
        let values: Option<Vec<f64>> = self.states.iter().map(|one| one.value.filter(|v| v.is_finite())).collect();
        by_rule(values.as_deref(), &self.control_curve, &self.system)
            .is_none_or(|(_, place)| self.states[place].key == state)
    }
}

/// Returns the control rule and the representative state that it sets for the sun at [`TYPICAL_SUN`]; `None` if no rule
/// applies. `values`: numbers of the states, such as slat angles. \[°\]
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

/// Whether the upper face of the slats reflects mostly specularly, so that they can redirect light.
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
        // Vertical slats do not follow the profile angle.
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
