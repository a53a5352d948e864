//! Curves of several candidates in one plot each: luminous intensities, illuminance along the depth, transmittance and
//! state against the profile angle.

use crate::compute::btdf::Btdf;
use crate::compute::direction::{Dir, Incident};
use crate::compute::estimate::Estimate;
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::Aim;
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::texts::compare as texts;
use std::f64::consts::FRAC_PI_2;

/// Step of the curves in γ and in profile angle. \[°\]
const STEP: i32 = 1;

fn plot(x: Axis, name: &str, unit: &'static str, mut series: Vec<Series>) -> Plot {
    let values =
        series.iter().flat_map(|one| one.points.iter().map(|point| point[1])).filter(|value| value.is_finite());
    let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    for one in &mut series {
        one.points.retain(|point| point[0].is_finite());
    }
    let reach = if high > low { 0.05 * (high - low) } else { 0.5 };
    let low = if low < 0.0 { low - reach } else { 0.0 };
    Plot { x, y: Axis::linear([low, high + reach], name, Unit::Named(unit)), series, guides: Vec::new() }
}

/// Returns the plots of the scattered luminous intensities of several candidates against γ, in the planes C0–C180 and
/// C90–C270; γ is negative towards C180 and C270. `list`: labels and distributions.
pub fn of_lids(list: &[(String, &Lid)]) -> [Plot; 2] {
    [0.0_f64, 90.0].map(|c| {
        let series = list.iter().map(|(name, lid)| {
            let aim = Aim::of(lid.surface);
            let at = |gamma: i32| {
                let gamma = f64::from(gamma);
                let turned = if gamma < 0.0 { c + 180.0 } else { c };
                let direction = aim.direction(turned.to_radians(), gamma.abs().to_radians());
                [gamma, lid.intensity(direction).max(0.0)]
            };
            Series::line(name.as_str(), (-180..=180).step_by(STEP as usize).map(at))
        });
        let axis = Axis::linear([-180.0, 180.0], texts::gamma_in(format!("C{:.0}–C{c:.0}", c + 180.0)), Unit::Degrees);
        plot(axis, "I", "cd", series.collect())
    })
}

/// Illuminances of a candidate at sensors on a grid.
#[derive(Debug, Clone, Copy)]
pub struct Grid<'a> {
    /// Depth of the room, perpendicular to the façade. \[m\]
    pub depth: f64,
    /// Numbers of sensors along x and y.
    pub count: [usize; 2],
    /// Illuminances at the sensors, x running fastest. \[lx\]
    pub values: &'a [Estimate],
}

/// Returns the plot of illuminance against the distance from the façade, in the middle row of sensors of each
/// candidate, with its errors as a band.
pub fn of_rooms(list: &[(String, Grid<'_>)]) -> Plot {
    let series = list.iter().map(|(name, grid)| {
        let [nx, ny] = grid.count;
        let at = |j: usize| ((j as f64 + 0.5) / ny as f64 * grid.depth, grid.values[j * nx + nx / 2]);
        let line = Series::line(name.as_str(), (0..ny).map(|j| [at(j).0, at(j).1.value]));
        let band = (0..ny).map(|j| at(j).1).map(|one| [one.value - one.error, one.value + one.error]);
        Series { band: band.collect(), ..line }
    });
    let depth = list.iter().map(|(_, grid)| grid.depth).fold(0.0, f64::max);
    let axis = Axis::linear([0.0, depth], texts::FROM_FACADE, Unit::Named("m"));
    let guides =
        [300.0, 500.0].map(|level| Guide { name: format!("{level:.0} lx"), ends: [[0.0, level], [depth, level]] });
    Plot { guides: guides.into(), ..plot(axis, texts::E_MIDDLE_ROW.get(), "lx", series.collect()) }
}

/// Returns the plot of transmittance τ against profile angle, for incident directions in the vertical plane through the
/// normal, from −90° (from straight below) to 90° (from straight above).
pub fn of_transmittances(list: &[(String, &Btdf)]) -> Plot {
    let series = list.iter().map(|(name, btdf)| {
        let at = |angle: i32| {
            let upwards = if angle < 0 { -FRAC_PI_2 } else { FRAC_PI_2 };
            let incident = Incident(Dir::from_theta_phi(f64::from(angle.abs()).to_radians(), upwards));
            [f64::from(angle), btdf.tau(incident)]
        };
        Series::line(name.as_str(), (-89..=89).step_by(STEP as usize).map(at))
    });
    plot(Axis::linear([-90.0, 90.0], texts::PROFILE_ANGLE, Unit::Degrees), "τ", "", series.collect())
}

/// Returns the plot of the state that the control demands against the profile angle of the sun. `list`: labels, and
/// points of profile angle \[°\] and number of the state, such as the slat angle \[°\].
pub fn of_controls(list: &[(String, Vec<[f64; 2]>)]) -> Plot {
    let series = list.iter().map(|(name, curve)| Series::line(name.as_str(), curve.iter().copied()));
    plot(Axis::linear([-90.0, 90.0], texts::PROFILE_ANGLE, Unit::Degrees), texts::STATE.get(), "°", series.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::lid::EmergentLuminance;
    use std::f64::consts::PI;

    #[test]
    fn a_diffuse_window_shines_into_the_room_alone() {
        let lid = Lid {
            surface: Surface::Facade,
            size: [2.0, 1.0],
            parts: vec![EmergentLuminance::Uniform(100.0)],
            beams: vec![],
        };
        let [across, along] = of_lids(&[("a".to_owned(), &lid)]);
        let at = |plot: &Plot, gamma: f64| plot.series[0].points.iter().find(|point| point[0] == gamma).unwrap()[1];
        // Straight into the room: L A.
        assert!((at(&across, 90.0) - 200.0).abs() < 1e-9 && at(&across, -90.0) == 0.0);
        assert!((at(&across, 30.0) - 100.0).abs() < 1e-9);
        assert!(along.series[0].points.iter().all(|point| point[1].abs() < 1e-6));
        assert!(across.y.range[1] > 200.0);
    }

    #[test]
    fn rooms_and_transmittances_are_read_off_where_they_are() {
        let values: Vec<Estimate> = (0..6).map(|k| Estimate::new(f64::from(k), 0.5)).collect();
        let plot = of_rooms(&[("a".to_owned(), Grid { depth: 3.0, count: [2, 3], values: &values })]);
        assert_eq!(plot.series[0].points, [[0.5, 1.0], [1.5, 3.0], [2.5, 5.0]]);
        assert_eq!(plot.series[0].band[1], [2.5, 3.5]);
        let clear = of_transmittances(&[("b".to_owned(), &Btdf::ideal_diffuse(0.2 * PI))]);
        assert!(clear.series[0].points.iter().all(|point| (point[1] - 0.2 * PI).abs() < 1e-12));
    }
}
