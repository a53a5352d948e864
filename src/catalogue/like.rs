//! Similarity of products by their effect on light, not by their names.
//!
//! The distance of two products is the root mean square of five differences, all as shares of the luminous flux that is
//! incident on the window: 0.01 is a difference of one per cent of that flux.
//!
//! | term | difference of |
//! | --- | --- |
//! | τ | the transmittance under uniform luminance |
//! | profile | the transmittances at [`PROFILE_ANGLES`]: root mean square, weighted by the light received (cos ψ dψ) |
//! | ceiling | the light that leaves upwards: its share of the transmitted light times τ |
//! | sun | the share of direct sun that is blocked at 45° solar altitude |
//! | view | the normal–normal transmittance |
//!
//! All terms have the same weight: two products that can replace each other must agree in how much light they transmit,
//! from where, to where, and in the view through them; none of the five follows from the others. A term that is unknown
//! for one of the two is left out. Products with several states are compared by the state that represents them
//! ([`representative`](super::representative())).

use super::{PROFILE_ANGLES, ProductRow};
use crate::texts::{Text, catalogue as text, fixed};

/// Labels of the terms, in the order of [`ProductDistance::terms`].
const TERMS: [Text; 5] =
    [text::DISTANCE_TAU, text::DISTANCE_PROFILE, text::DISTANCE_CEILING, text::DISTANCE_SUN, text::DISTANCE_VIEW];
/// Smallest absolute difference (share of the incident flux) that is named in the text; smaller ones vanish with two
/// decimals.
const SHOWN: f64 = 0.005;
/// Maximum number of terms that the text names.
const MAX_TERMS: usize = 3;

/// Distance of a product from another one by their effect on light, with the five differences of which it is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProductDistance {
    /// Root mean square of the terms that are known for both products, as a share of the incident flux.
    pub distance: f64,
    /// Differences, this product minus the other, as shares of the incident flux: τ, profile (never negative), ceiling,
    /// sun blocked, view; `None` where unknown.
    pub terms: [Option<f64>; 5],
}

/// Distances of found products from one product, by their effect on light.
#[derive(Debug, Clone, PartialEq)]
pub struct Likeness {
    /// Key of the product from which the distances are counted.
    pub key: String,
    /// Name of that product.
    pub name: String,
    /// Distance of each found product from that product, in the order of the list of found products.
    pub distances: Vec<ProductDistance>,
}

impl ProductDistance {
    /// Returns the distance between two products by their effect on light; `None` where no term is known for both.
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

    /// Returns the distance as a translated text such as `0.03 apart: ceiling +0.06, τ −0.01`, with the largest terms
    /// in falling order.
    pub fn words(&self) -> String {
        let mut terms: Vec<(Text, f64)> =
            TERMS.into_iter().zip(self.terms).filter_map(|(word, term)| Some((word, term?))).collect();
        terms.retain(|(_, term)| term.abs() >= SHOWN);
        terms.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let one = |(word, term): &(Text, f64)| match (*word == TERMS[1], *term < 0.0) {
            (true, _) => format!("{word} {}", fixed(*term, 2)),
            (false, true) => format!("{word} −{}", fixed(-term, 2)),
            (false, false) => format!("{word} +{}", fixed(*term, 2)),
        };
        let parts: Vec<String> = terms.iter().take(MAX_TERMS).map(one).collect();
        if parts.is_empty() {
            text::no_difference(fixed(SHOWN, 3))
        } else {
            text::distance_is(fixed(self.distance, 2), parts.join(", "))
        }
    }
}

/// Returns the root mean square of the differences of two lists of transmittances at [`PROFILE_ANGLES`], weighted by
/// the flux received (cos ψ dψ); `None` if a list is not known.
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
        let distance = ProductDistance::of(&a, &b).unwrap();
        // τ, profile and sun differ by 0.1, the light to the ceiling by 0.04, the view not at all.
        assert!((distance.distance - ((0.03 + 0.0016) / 5.0_f64).sqrt()).abs() < 1e-12);
        assert_eq!(distance.words(), "0.08 apart: τ +0.10, profile 0.10, sun blocked −0.10");
        let back = ProductDistance::of(&b, &a).unwrap();
        assert_eq!(back.distance, distance.distance);
        assert!((back.terms[0].unwrap() + 0.1).abs() < 1e-12);
        assert_eq!(ProductDistance::of(&a, &a).unwrap().distance, 0.0);
        assert_eq!(ProductDistance::of(&a, &a).unwrap().words(), "no difference above 0.005");
    }

    #[test]
    fn what_is_not_known_is_left_out() {
        let (a, mut b) = (row(0.5, 0.4), row(0.4, 0.4));
        (b.to_ceiling, b.sun_blocked, b.view, b.tau_profile) = (None, None, None, Vec::new());
        let distance = ProductDistance::of(&a, &b).unwrap();
        assert!((distance.distance - 0.1).abs() < 1e-12 && distance.terms[1..] == [None; 4]);
        b.tau_hemispherical = None;
        assert_eq!(ProductDistance::of(&a, &b), None);
    }
}
