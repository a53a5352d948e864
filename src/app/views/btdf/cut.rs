//! Section curves of the scattered light for one incident direction: q over the emergent angle, in the plane of
//! incidence and in the plane perpendicular to it.

use super::words::drawn;
use crate::app::paint::colour_scale::ColourScale;
use crate::app::paint::palette::Palette;
use crate::app::paint::plot::{self, Look};
use crate::app::paint::tile;
use crate::compute::btdf::Indicatrix;
use crate::compute::direction::{Dir, Incident};
use crate::drawing::plot::{Axis, Plot, Series, Unit};
use crate::drawing::ticks::number;
use crate::texts::{Text, tiles as say};
use egui::{Rect, Ui};
use std::f64::consts::{FRAC_PI_2, PI};

/// Number of steps of the emergent angle from the normal to ±90°, i.e. steps of 0.5°.
const STEPS: i32 = 180;

/// Returns the value q, or q·cosθ if `weighted`, \[1/sr\] of an emergent direction, given by the direction of
/// undeviated light: its angle to the normal `angle`, −π/2 … π/2 \[rad\], and its azimuth `phi` \[rad\], or `phi` + π
/// for negative angles.
fn value(indicatrix: &Indicatrix, phi: f64, angle: f64, weighted: bool) -> f64 {
    let phi = if angle < 0.0 { phi + PI } else { phi };
    let index = indicatrix.basis.index(Dir::from_theta_phi(angle.abs(), phi));
    index.map_or(0.0, |index| drawn(indicatrix.q[index], &indicatrix.basis.cell(index), weighted))
}

/// Returns the plot of the two section curves; for perpendicular incidence they are those in the vertical and the
/// horizontal plane. Angles are positive on the side of undeviated light.
fn curves(indicatrix: &Indicatrix, direction: Incident, scale: &ColourScale, weighted: bool) -> Plot {
    let oblique = direction.0.theta() > 0.01;
    let phi = if oblique { direction.0.phi() } else { FRAC_PI_2 };
    let names = if oblique { [say::CUT_IN, say::CUT_ACROSS] } else { [say::CUT_UPRIGHT, say::CUT_LEVEL] };
    let line = |(name, phi): (Text, f64)| {
        let point = |k: i32| {
            let angle = f64::from(k) / f64::from(STEPS) * (FRAC_PI_2 - 1e-9);
            [angle.to_degrees(), value(indicatrix, phi, angle, weighted)]
        };
        Series::line(name, (-STEPS..=STEPS).map(point))
    };
    let axis = if scale.log { Axis::log } else { Axis::linear };
    let what = if weighted { "q·cosθ" } else { "q" };
    Plot {
        x: Axis::linear([-90.0, 90.0], say::CUT_AXIS, Unit::Degrees),
        y: axis([scale.lo, scale.hi], what, Unit::Named("1/sr")),
        series: names.into_iter().zip([phi, phi + FRAC_PI_2]).map(line).collect(),
        guides: vec![],
    }
}

/// Draws the plot of the section curves.
pub(super) fn show(
    ui: &mut Ui,
    rect: Rect,
    indicatrix: &Indicatrix,
    direction: Incident,
    scale: &ColourScale,
    weighted: bool,
) {
    let palette = Palette::of(ui.visuals());
    let plot = curves(indicatrix, direction, scale, weighted);
    let colours = [palette.first, palette.second];
    let look = Look::tile(ui.scope_id().with("cuts"), &colours, palette.weak);
    let shown = plot::show(ui, rect, &plot, &look, |_| {});
    let largest = plot.series.iter().flat_map(|series| &series.points).map(|[_, y]| *y).fold(0.0, f64::max);
    tile::name(ui, &shown.response, say::EMERGENT_CUTS, &say::largest(number(largest, 3)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::paint::palette::ColourMap;
    use crate::compute::basis::{AzimuthMap, RingBasis};

    #[test]
    fn light_that_goes_straight_on_stands_at_its_own_angle() {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let from = Dir::from_theta_phi(40_f64.to_radians(), 1.1);
        let own = basis.index(from).unwrap();
        let q = (0..basis.len()).map(|cell| if cell == own { 3.0 } else { 0.01 }).collect();
        let scale = ColourScale { lo: 0.0, hi: 3.0, log: false, map: ColourMap::Sequential };
        let plot = curves(&Indicatrix { basis, q }, Incident(from), &scale, false);
        let peak = |series: &Series| {
            let high: Vec<f64> = series.points.iter().filter(|[_, y]| *y > 1.0).map(|[x, _]| *x).collect();
            (high.first().copied(), high.last().copied())
        };
        let (Some(first), Some(last)) = peak(&plot.series[0]) else { panic!("no peak in the plane") };
        assert!(first < 40.0 && last > 40.0 && first > 30.0 && last < 50.0, "{first} {last}");
        assert_eq!(peak(&plot.series[1]), (None, None));
    }
}
