//! Products like another one, by what they do to light and not by how they are called.
//!
//! The distance of two products is the root of the mean square of five differences, all shares of the light that falls on
//! the window, so that 0.01 is one per cent of it done otherwise:
//!
//! | term | difference of |
//! | --- | --- |
//! | τ | the transmittance under uniform luminance |
//! | profile | the transmittances at [`PROFILE_ANGLES`]: root of their mean square, weighted by what the façade receives (cos ψ dψ) |
//! | ceiling | the light that leaves upwards: its share of the transmitted light times τ |
//! | sun | the share of a high sun that is kept out |
//! | view | the share at normal incidence that goes straight on |
//!
//! All count the same: two products that one would exchange for each other have to agree in how much light they pass, from
//! where, to where, and in what is seen through them; none of the five follows from the others. A term that one of the
//! two does not know is left out. Moving products are taken by the state that stands for them
//! ([`representative`](super::representative())).

use super::{PROFILE_ANGLES, ProductRow};
use crate::texts::{Text, catalogue as text, fixed};

/// Words of the terms, in the order of [`Apart::terms`].
const TERMS: [Text; 5] = [text::APART_TAU, text::APART_PROFILE, text::APART_CEILING, text::APART_SUN, text::APART_VIEW];
/// Differences that two decimals show.
const SHOWN: f64 = 0.005;
/// Most terms that are told.
const MOST_TOLD: usize = 3;

/// How far a product is from another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Apart {
    /// Root of the mean square of the terms that are known of both.
    pub distance: f64,
    /// τ, profile (never negative), ceiling, sun blocked, view: this product less the other; `None` where not known.
    pub terms: [Option<f64>; 5],
}

/// Products by how far they are from one of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Likeness {
    /// Key of the product that the others are like.
    pub key: String,
    /// Its name.
    pub name: String,
    /// How far each entry is from it, in the order of the entries.
    pub apart: Vec<Apart>,
}

impl Apart {
    /// Of one product from another; `None` where nothing is known of both.
    pub fn of(one: &ProductRow, other: &ProductRow) -> Option<Self> {
        let less = |a: Option<f64>, b: Option<f64>| Some(a? - b?);
        let upwards = |row: &ProductRow| match (row.to_ceiling, row.tau_hemispherical) {
            (Some(share), Some(tau)) => Some(share * tau),
            // Where nothing is transmitted nothing goes up.
            (None, Some(tau)) if tau < 1e-6 => Some(0.0),
            _ => None,
        };
        let terms = [
            less(one.tau_hemispherical, other.tau_hemispherical),
            profile(&one.tau_profile, &other.tau_profile),
            less(upwards(one), upwards(other)),
            less(one.sun_blocked, other.sun_blocked),
            less(one.view, other.view),
        ];
        let known = terms.iter().flatten().filter(|term| term.is_finite());
        let (sum, count) = known.fold((0.0, 0), |(sum, count), term| (sum + term * term, count + 1));
        (count > 0).then(|| Self { distance: (sum / f64::from(count)).sqrt(), terms })
    }

    /// `0.03 apart: ceiling +0.06, τ −0.01`: the terms that matter most, greatest first.
    pub fn words(&self) -> String {
        let mut told: Vec<(Text, f64)> =
            TERMS.into_iter().zip(self.terms).filter_map(|(word, term)| Some((word, term?))).collect();
        told.retain(|(_, term)| term.abs() >= SHOWN);
        told.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let one = |(word, term): &(Text, f64)| match (*word == TERMS[1], *term < 0.0) {
            (true, _) => format!("{word} {}", fixed(*term, 2)),
            (false, true) => format!("{word} −{}", fixed(-term, 2)),
            (false, false) => format!("{word} +{}", fixed(*term, 2)),
        };
        let told: Vec<String> = told.iter().take(MOST_TOLD).map(one).collect();
        if told.is_empty() {
            text::no_difference(fixed(SHOWN, 3))
        } else {
            text::apart(fixed(self.distance, 2), told.join(", "))
        }
    }
}

/// Root of the mean square of the differences of two profiles.
fn profile(one: &[f64], other: &[f64]) -> Option<f64> {
    let last = PROFILE_ANGLES.len() - 1;
    if one.len() != last + 1 || other.len() != last + 1 {
        return None;
    }
    let weight = |at: usize| {
        let width = PROFILE_ANGLES[(at + 1).min(last)] - PROFILE_ANGLES[at.saturating_sub(1)];
        PROFILE_ANGLES[at].to_radians().cos() * width
    };
    let add =
        |[sum, weights]: [f64; 2], at: usize| [sum + weight(at) * (one[at] - other[at]).powi(2), weights + weight(at)];
    let [sum, weights] = (0..=last).fold([0.0; 2], add);
    Some((sum / weights).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FirstRule, Origin};

    fn row(tau: f64, ceiling: f64) -> ProductRow {
        ProductRow {
            key: String::new(),
            name: String::new(),
            manufacturer: String::new(),
            kind: String::new(),
            origin: Origin::Unknown,
            states: vec![String::new()],
            representative: 0,
            dataset: None,
            rule: FirstRule::ByHand,
            tau_normal: Some(tau),
            tau_hemispherical: Some(tau),
            tau_profile: vec![tau; PROFILE_ANGLES.len()],
            to_ceiling: Some(ceiling),
            sun_blocked: Some(1.0 - tau),
            view: Some(0.0),
            favourite: false,
            builtin: false,
            subscribed: String::new(),
        }
    }

    #[test]
    fn the_distance_is_the_root_mean_square_of_shares_of_the_light() {
        let (a, b) = (row(0.5, 0.4), row(0.4, 0.4));
        let apart = Apart::of(&a, &b).unwrap();
        // τ, profile and sun differ by 0.1, the light to the ceiling by 0.04, the view not at all.
        assert!((apart.distance - ((0.03 + 0.0016) / 5.0_f64).sqrt()).abs() < 1e-12);
        assert_eq!(apart.words(), "0.08 apart: τ +0.10, profile 0.10, sun blocked −0.10");
        let back = Apart::of(&b, &a).unwrap();
        assert_eq!(back.distance, apart.distance);
        assert!((back.terms[0].unwrap() + 0.1).abs() < 1e-12);
        assert_eq!(Apart::of(&a, &a).unwrap().distance, 0.0);
        assert_eq!(Apart::of(&a, &a).unwrap().words(), "no difference above 0.005");
    }

    #[test]
    fn what_is_not_known_is_left_out() {
        let (a, mut b) = (row(0.5, 0.4), row(0.4, 0.4));
        (b.to_ceiling, b.sun_blocked, b.view, b.tau_profile) = (None, None, None, Vec::new());
        let apart = Apart::of(&a, &b).unwrap();
        assert!((apart.distance - 0.1).abs() < 1e-12 && apart.terms[1..] == [None; 4]);
        b.tau_hemispherical = None;
        assert_eq!(Apart::of(&a, &b), None);
    }
}
