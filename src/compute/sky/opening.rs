//! Illuminance by sky and ground behind obstructions, seen through an aperture.
//!
//! The integral is swept over azimuths about the zenith, for which the horizon, the skyline, vertical edges and the
//! sun's altitude are simple.

use super::outside::Outside;
use super::prospect::Prospect;
use super::region::{Cap, Frame};
use super::scan_region::sector_bearings;
use crate::compute::direction::{Dir, World};
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::Tolerance;
use crate::compute::sweep::{rule_over, sweep};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Computes the illuminance of a receiver by sky, ground and obstructions seen through a convex aperture, the luminance
/// of every direction multiplied by `tau`. \[lx\]
///
/// `corners`: of the aperture, as vectors from the receiver's position ([`Outside::seen_from`]) in the world's axes
/// \[m\], all of them in front of the receiver; `normal`: normal of the receiver.
pub fn irradiance_through(
    outside: &Outside,
    corners: &[DVec3],
    normal: Dir<World>,
    tau: impl Fn(DVec3) -> f64,
    tolerance: Tolerance,
) -> Estimate {
    let Some((surroundings, eye)) = outside.foreground() else { return Estimate::default() };
    let open = outside.open();
    let prospect = Prospect::new(&open, surroundings, eye);
    let normal = normal.vector();
    let middle = corners.iter().sum::<DVec3>().normalize_or_zero();
    // Obstructions visible through the opening lie within the cone around its corners; without such a cone (≥ 90°), all
    // count.
    let aside = corners.iter().map(|corner| middle.dot(corner.normalize_or_zero())).fold(1.0, f64::min);
    let reach = if aside > 1e-6 { aside.min(1.0).acos() + 1e-6 } else { PI };
    let near = prospect.near(&Cap { middle, reach }).unwrap_or_default();
    let rim: Vec<[DVec3; 2]> = (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]]).collect();
    let planes: Vec<DVec3> = rim
        .iter()
        .filter_map(|[a, b]| {
            let plane = a.cross(*b).try_normalize()?;
            Some(if plane.dot(middle) >= 0.0 { plane } else { -plane })
        })
        .collect();
    let within = |d: DVec3| planes.iter().all(|plane| plane.dot(d) >= 0.0);
    let frame = Frame::DOME;
    // Azimuths are counted from the opening's middle, so that the opening does not lie across ±180°.
    let reference = frame.angles(middle).1;
    let turned = |v: DVec3| {
        let from = frame.angles(v).1 - reference;
        from - 2.0 * PI * (from / (2.0 * PI)).round()
    };
    let all_round = within(DVec3::Z) || within(DVec3::NEG_Z);
    let (mut low, mut high) = (-PI, PI);
    if !all_round {
        let places = || corners.iter().map(|corner| turned(*corner));
        (low, high) = (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
    }
    let mut knots = vec![low, high];
    let mut add = |v: DVec3| {
        let phi = turned(v);
        if phi > low + 1e-12 && phi < high - 1e-12 {
            knots.push(phi);
        }
    };
    corners.iter().for_each(|corner| add(*corner));
    surroundings.skyline.iter().flat_map(|skyline| skyline.corners()).for_each(&mut add);
    prospect.peak.into_iter().for_each(&mut add);
    near.edges.iter().flatten().copied().for_each(&mut add);
    if open.is_piecewise_constant() {
        sector_bearings().into_iter().for_each(|bearing| add(frame.direction(FRAC_PI_2, bearing)));
    }
    if all_round {
        [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y].into_iter().for_each(&mut add);
    }
    knots.sort_unstable_by(f64::total_cmp);
    let edges: Vec<[DVec3; 2]> = near.edges.iter().chain(&rim).copied().collect();
    let mut breaks = Vec::with_capacity(24);
    let line = |phi: f64| {
        let phi = phi + reference;
        prospect.breaks_at_bearing(phi, &edges, &[], &mut breaks);
        let mut sum = [0.0; 2];
        let along = prospect.along(&near, frame.meridian(phi));
        for pair in breaks.windows(2).filter(|pair| pair[1] - pair[0] > 1e-12) {
            let (from, width) = (pair[0], pair[1] - pair[0]);
            let middle = along.meridian.direction(from + 0.5 * width);
            if !within(middle) {
                continue;
            }
            let mut met = prospect.met(&along, middle);
            for &(x, share) in rule_over(width) {
                let theta = from + width * x;
                let d = along.meridian.direction(theta);
                let [luminance, error] = match &mut met {
                    Some(met) => met.luminance(d),
                    None => [prospect.open_luminance(d), 0.0],
                };
                let counts = share * width * theta.sin() * normal.dot(d).max(0.0) * tau(d);
                sum[0] += counts * luminance;
                sum[1] += counts * error;
            }
        }
        sum
    };
    let ([value, uncertainty], error) = sweep(line, &knots, tolerance.relative, tolerance.absolute);
    Estimate::new(value, error + uncertainty)
}
