//! Common scales for the pictures of several candidates: smallest and largest value, in the unit of the picture.

use crate::compute::angle::Bearing;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Btdf;
use crate::compute::direction::{Dir, Incident};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::Aim;
use crate::compute::sky::Outside;
use crate::drawing::colours::{ColourMap, ColourScale};
use crate::drawing::ticks::fine_ceil;

/// Smallest and largest value of a scale; `None` without any light.
pub type Range = Option<[f64; 2]>;

fn positive(values: impl Iterator<Item = f64>) -> Option<f64> {
    let greatest = values.filter(|value| value.is_finite()).fold(0.0, f64::max);
    (greatest > 0.0).then_some(greatest)
}

/// Returns the scale for luminance coefficients of scattered light, three decades up to the largest of all systems at
/// their incident directions. \[1/sr\]
pub fn of_q<'a>(list: impl Iterator<Item = (&'a Btdf, Incident)>) -> Range {
    let greatest = |(btdf, incident): (&Btdf, Incident)| {
        btdf.indicatrix(incident).map_or(0.0, |one| one.q.into_iter().fold(0.0, f64::max))
    };
    let scale = ColourScale::up_to(positive(list.map(greatest))?, true, 3, ColourMap::Sequential);
    Some([scale.lo, scale.hi])
}

/// Returns the scale for transmittances τ over the hemisphere, from 0 to a round number above the largest of all
/// systems.
pub fn of_tau<'a>(list: impl Iterator<Item = &'a Btdf>) -> Range {
    let basis = RingBasis::equal_area(16);
    let greatest = |btdf: &Btdf| basis.cells().map(|cell| btdf.tau(Incident(cell.centre()))).fold(0.0, f64::max);
    Some([0.0, fine_ceil(positive(list.map(greatest))?)])
}

/// Returns the scale for scattered luminous intensities, from 0 to the largest of all distributions on a raster of
/// directions. \[cd\]
pub fn of_lids<'a>(list: impl Iterator<Item = &'a Lid>) -> Range {
    let greatest = |lid: &Lid| {
        let aim = Aim::of(lid.surface);
        let directions = (0..72).flat_map(|c| (0..=90).map(move |gamma| [5.0 * f64::from(c), 2.0 * f64::from(gamma)]));
        directions
            .map(|[c, gamma]| lid.intensity(aim.direction(c.to_radians(), gamma.to_radians())))
            .fold(0.0, f64::max)
    };
    Some([0.0, positive(list.map(greatest))?])
}

/// Returns the scale for illuminances, from 0 to a round number above the largest. \[lx\]
pub fn of_illuminances(list: impl Iterator<Item = f64>) -> Range {
    Some([0.0, fine_ceil(positive(list)?)])
}

/// Returns the logarithmic scale for sky luminances, which encloses those of all skies; zero is left out. \[cd/m²\]
pub fn of_skies<'a>(list: impl Iterator<Item = &'a Outside>) -> Range {
    let mut range = [f64::INFINITY, 0.0_f64];
    for outside in list {
        for (ring, sector) in (0..18).flat_map(|ring| (0..36).map(move |sector| (f64::from(ring), f64::from(sector)))) {
            let bearing = Bearing::from_radians((10.0 * sector).to_radians());
            let value = outside.luminance(Dir::from_altitude_bearing((5.0 * ring + 2.5).to_radians(), bearing));
            if value.is_finite() && value > 0.0 {
                range = [range[0].min(value), range[1].max(value)];
            }
        }
    }
    let [low, high] = range;
    (low < high).then(|| {
        let scale = ColourScale::log_around(low.max(1e-3), high.max(1e-2), ColourMap::Sequential);
        [scale.lo, scale.hi]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_scale_holds_the_greatest_of_all_and_nothing_has_none() {
        let (dim, bright) = (Btdf::ideal_diffuse(0.2), Btdf::ideal_diffuse(0.6));
        let normal = Incident(Dir::from_theta_phi(0.1, 0.0));
        let [low, high] = of_q([(&dim, normal), (&bright, normal)].into_iter()).unwrap();
        assert!((0.6 / PI..3.0 * 0.6 / PI).contains(&high) && (high / low - 1000.0).abs() < 1e-6);
        assert_eq!(of_tau([&bright, &dim].into_iter()), Some([0.0, 0.6]));
        assert_eq!(of_illuminances([130.0, f64::NAN, 1210.0].into_iter()), Some([0.0, 1500.0]));
        assert_eq!(of_illuminances([0.0].into_iter()), None);
        assert_eq!(of_lids(std::iter::empty()), None);
    }
}
