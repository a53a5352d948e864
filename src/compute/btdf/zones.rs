//! Shares of transmitted light by the elevation of the emergent direction.
//!
//! Regular transmission leaves undeviated; scattered light is summed over the emergent cells. A cell that straddles a
//! limit is divided by projected solid angle, on points that are distributed uniformly in it; other cells count as a
//! whole.

use super::Btdf;
use crate::compute::direction::{Dir, Incident};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Minimum number of points on a whole hemisphere. A straight limit is met to less than 1 % of the flux; held by the
/// test `an_ideal_diffuser_fills_segments_of_a_disc`.
const POINTS: usize = 40_000;

/// Returns the shares of the incident flux that leave in zones of elevation: above the first limit, between consecutive
/// limits, and below the last. `limits`: elevations \[rad\], falling. The sum of the `N + 1` shares is τ of the
/// incident direction.
///
/// `up`: unit vector upwards in the façade frame (in a façade y, in a roof z).
pub fn zone_shares<const N: usize>(btdf: &Btdf, incident: Incident, up: DVec3, limits: [f64; N]) -> Vec<f64> {
    let mut shares = vec![0.0; N + 1];
    let sines = limits.map(f64::sin);
    // A direction of undeviated light is opposite to the propagation: above the horizon, light goes down.
    let zone = |incident: DVec3| {
        let elevation = -incident.dot(up);
        sines.iter().position(|sine| elevation >= *sine).unwrap_or(N)
    };
    if let Some(regular) = &btdf.regular {
        shares[zone(incident.0.vector())] += regular.at(incident.0.theta());
    }
    let Some(indicatrix) = btdf.indicatrix(incident) else { return shares };
    let side = ((POINTS as f64 / indicatrix.basis.len().max(1) as f64).sqrt().ceil() as usize).max(4);
    let middles = |i: usize| (i as f64 + 0.5) / side as f64;
    let elevations = limits.map(|limit| limit.clamp(-FRAC_PI_2, FRAC_PI_2));
    for (cell, q) in indicatrix.basis.cells().zip(&indicatrix.q).filter(|(_, q)| **q > 0.0) {
        let share = q * cell.projected_solid_angle();
        // Upper bound of the angle from a cell's middle to any of its points: half its extent in θ plus half its arc in
        // φ.
        let middle = Dir::<()>::from_theta_phi(0.5 * (cell.theta_min + cell.theta_max), cell.phi).vector();
        let around = cell.theta_max.min(FRAC_PI_2).sin() * 0.5 * cell.width;
        let reach = 0.5 * (cell.theta_max - cell.theta_min) + around;
        let elevation = (-middle.dot(up)).clamp(-1.0, 1.0).asin();
        if elevations.iter().all(|limit| (elevation - limit).abs() > reach) {
            shares[zone(middle)] += share;
            continue;
        }
        let (inner, outer) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
        let turns: Vec<DVec3> = (0..side)
            .map(|j| cell.phi + cell.width * (middles(j) - 0.5))
            .map(|phi| DVec3::new(phi.cos(), phi.sin(), 0.0))
            .collect();
        for squared in (0..side).map(|i| inner + (outer - inner) * middles(i)) {
            let (sine, cosine) = (squared.sqrt(), (1.0 - squared).max(0.0).sqrt());
            for turn in &turns {
                shares[zone(sine * *turn + cosine * DVec3::Z)] += share / (side * side) as f64;
            }
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn from_above(altitude: f64) -> Incident {
        Incident(Dir::from_theta_phi(altitude, 0.5 * PI))
    }

    /// Seen along the normal, directions above an elevation ε are a segment of the unit disc, y ≥ sin ε.
    fn segment(elevation: f64) -> f64 {
        let s = elevation.sin();
        (s.acos() - s * (1.0 - s * s).sqrt()) / PI
    }

    #[test]
    fn an_ideal_diffuser_fills_segments_of_a_disc() {
        let limits = [10_f64, -10.0, -45.0].map(f64::to_radians);
        let shares = zone_shares(&Btdf::ideal_diffuse(0.6), from_above(0.7), DVec3::Y, limits);
        let above: Vec<f64> = limits.iter().map(|limit| 0.6 * segment(*limit)).collect();
        let expected = [above[0], above[1] - above[0], above[2] - above[1], 0.6 - above[2]];
        for (share, expected) in shares.iter().zip(expected) {
            assert!((share - expected).abs() < 2e-3, "{share} {expected}");
        }
        assert!((shares.iter().sum::<f64>() - 0.6).abs() < 1e-9);
    }

    #[test]
    fn through_a_clear_opening_the_suns_beam_goes_down_and_light_from_below_goes_up() {
        let limits = [10_f64, -10.0, -45.0].map(f64::to_radians);
        let clear = Btdf::ideal_transparent(0.9);
        let shares = |degrees: f64| zone_shares(&clear, from_above(degrees.to_radians()), DVec3::Y, limits);
        assert_eq!(shares(30.0), [0.0, 0.0, 0.9, 0.0]);
        assert_eq!(shares(60.0), [0.0, 0.0, 0.0, 0.9]);
        assert_eq!(shares(5.0), [0.0, 0.9, 0.0, 0.0]);
        let below = Incident(Dir::from_theta_phi(0.5, -0.5 * PI));
        assert_eq!(zone_shares(&clear, below, DVec3::Y, limits), [0.9, 0.0, 0.0, 0.0]);
        // Under a roof everything goes down, steeply when it comes steeply.
        assert_eq!(zone_shares(&clear, from_above(0.2), DVec3::Z, limits), [0.0, 0.0, 0.0, 0.9]);
    }
}
