//! Daylight glare probability of one observer from the field of view.

use super::discs::Disc;
use super::field::Field;
use super::gaze::position_index;
use super::probability::dgp;
use super::sources::Sources;
use crate::compute::estimate::Estimate;
use glam::DVec2;
use std::f64::consts::PI;

/// Luminance threshold above which light is a glare source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// Fixed luminance. \[cd/m²\] Default of `evalglare` since 2.05: 2000 (Pierson et al. 2018).
    Luminance(f64),
    /// Multiple of the mean luminance of the field of view. Default of `evalglare` before 2.05: 5 (its `-b`; without a
    /// task).
    TimesMean(f64),
}

impl Default for Threshold {
    fn default() -> Self {
        Self::Luminance(2000.0)
    }
}

/// Field of view of an observer: luminances of the apertures, discs of the sun, and illuminance at the eye.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// Patches of the apertures as the eye sees them.
    pub field: &'a Field,
    /// Luminance of every patch of `field` towards the eye, in the order of the patches. \[cd/m²\]
    pub luminance: &'a [f64],
    /// Discs of direct or redirected sunlight.
    pub discs: &'a [Disc],
    /// Illuminance at the eye on the plane perpendicular to the line of sight, with the light of apertures, walls and
    /// sun. \[lx\]
    pub vertical: Estimate,
    /// Relative uncertainty of the patches' luminances, 0.01 for 1 %; all are assumed to be too high or too low
    /// together.
    pub relative: f64,
}

/// Glare of one observer at one moment: daylight glare probability, mean luminances and glare sources.
#[derive(Debug, Clone, PartialEq)]
pub struct Glare {
    /// Daylight glare probability DGP, 0 … 1, with its estimated absolute error.
    pub dgp: Estimate,
    /// Mean luminance of the hemisphere in front of the eye, for which the walls are assumed to have one uniform
    /// luminance. \[cd/m²\]
    pub mean: f64,
    /// Mean luminance of all that the eye sees besides the apertures' patches and the sun's discs: walls, floor,
    /// ceiling. \[cd/m²\] If it is above the threshold, the error of `dgp` includes the glare of uniform walls.
    pub walls: f64,
    /// Luminance above which light is a glare source. \[cd/m²\]
    pub threshold: f64,
    /// Glare sources of the observer.
    pub sources: Sources,
}

/// Hemisphere in front of an eye: patches and discs as given, all else of the one luminance that causes the remaining
/// illuminance.
struct Whole {
    /// Mean luminance. \[cd/m²\]
    mean: f64,
    /// Luminance of all but patches and discs. \[cd/m²\]
    walls: f64,
    /// Centroid of the luminance in the eye's equiangular picture, x to the right, y up. \[rad\]
    middle: DVec2,
}

/// Computes the luminance of the walls from the illuminance that patches and discs do not cause, and the means of the
/// hemisphere.
fn whole(view: &View<'_>) -> Whole {
    let (mut flux, mut illuminance) = (0.0, 0.0);
    // The centroid of a uniform hemisphere is that of the picture: walls lack what the apertures have.
    let (mut place, mut lacking) = (DVec2::ZERO, DVec2::ZERO);
    for (patch, l) in view.field.patches.iter().zip(view.luminance) {
        flux += l * patch.solid_angle;
        illuminance += l * patch.projected;
        place += l * patch.solid_angle * patch.place;
        lacking += patch.solid_angle * patch.place;
    }
    for disc in view.discs {
        let own = disc.luminance * disc.solid_angle;
        flux += own;
        place += own * view.field.gaze.place(disc.to);
        illuminance += own * disc.to.dot(view.field.gaze.forward).max(0.0);
    }
    let [seen, projected] = view.field.solid_angles();
    let rest = (PI - projected).max(0.0);
    let walls = if rest > 1e-6 { (view.vertical.value - illuminance).max(0.0) / rest } else { 0.0 };
    let all = flux + walls * (2.0 * PI - seen).max(0.0);
    let middle = if all > 0.0 { (place - walls * lacking) / all } else { DVec2::ZERO };
    Whole { mean: all / (2.0 * PI), walls, middle }
}

/// Finds the glare sources of a field of view and computes its DGP. The error of DGP contains that of the illuminance,
/// that of the luminances, the effect of the width of the patches, and that of patches so near the threshold that they
/// may or may not be glare sources.
pub fn glare(view: &View<'_>, threshold: Threshold) -> Glare {
    let Whole { mean, walls, middle } = whole(view);
    let limit = match threshold {
        Threshold::Luminance(limit) => limit,
        Threshold::TimesMean(times) => times * mean,
    };
    let sources = Sources::new(view.field, view.luminance, view.discs, limit);
    let e = view.vertical;
    let value = dgp(e.value, sources.sum);
    let off = |other: f64| (other - value).abs();
    let brighter = dgp(e.value, sources.sum * (1.0 + view.relative).powi(2));
    let more = dgp(e.value + e.error, sources.sum);
    let less = dgp((e.value - e.error).max(0.0), sources.sum);
    let finer = dgp(e.value, sources.sum + sources.error);
    let mut error = off(brighter) + off(more).max(off(less)) + off(finer);
    // DGP has a step at the threshold: only evaluated where a patch is near it.
    let band = [limit / (1.0 + view.relative), limit * (1.0 + view.relative)];
    if view.luminance.iter().any(|l| (band[0]..=band[1]).contains(l)) {
        let with = |limit: f64| dgp(e.value, Sources::new(view.field, view.luminance, view.discs, limit).sum);
        error += off(with(band[0])).max(off(with(band[1])));
    }
    // Walls are never uniform: where their mean is a glare source, a part of them is.
    if walls > limit {
        error += off(dgp(e.value, sources.sum.max(2.0 * PI * (mean / position_index(middle)).powi(2))));
    }
    Glare { dgp: Estimate::new(value, error), mean, walls, threshold: limit, sources }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::room::aperture::Aperture;
    use crate::compute::room::direct::Sensor;
    use glam::DVec3;

    fn field() -> Field {
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [4.0, 1.8] };
        Field::new(&Sensor { position: DVec3::new(2.5, 2.0, 1.2), normal: DVec3::NEG_Y }, [&aperture])
    }

    #[test]
    fn an_even_view_has_the_mean_of_its_illuminance() {
        let field = field();
        let luminance = vec![700.0; field.patches.len()];
        let view = View {
            field: &field,
            luminance: &luminance,
            discs: &[],
            vertical: Estimate::new(700.0 * PI, 1.0),
            relative: 0.01,
        };
        let found = glare(&view, Threshold::TimesMean(5.0));
        assert!((found.mean / 700.0 - 1.0).abs() < 1e-3, "{}", found.mean);
        assert!(found.sources.list.is_empty());
        assert!((found.dgp.value - (5.87e-5 * 700.0 * PI + 0.16)).abs() < 1e-12);
        assert!((found.dgp.error - 5.87e-5).abs() < 1e-9);
    }

    #[test]
    fn walls_above_the_threshold_are_in_the_error() {
        let field = field();
        let luminance = vec![5000.0; field.patches.len()];
        let vertical = Estimate::exact(5000.0 * field.solid_angles()[1] + 2100.0 * (PI - field.solid_angles()[1]));
        let view = View { field: &field, luminance: &luminance, discs: &[], vertical, relative: 0.0 };
        let found = glare(&view, Threshold::default());
        assert!((found.walls / 2100.0 - 1.0).abs() < 1e-9);
        // As one source: mean² 2π over the square of an index little above 1.
        let merged = dgp(vertical.value, found.mean.powi(2) * 2.0 * PI / 1.02_f64.powi(2));
        assert!((found.dgp.value + found.dgp.error - merged).abs() < 0.01, "{found:?} {merged}");
        assert!(glare(&view, Threshold::Luminance(2200.0)).dgp.error < 0.001);
    }

    #[test]
    fn a_window_at_the_threshold_has_the_step_for_an_error() {
        let field = field();
        let luminance = vec![1995.0; field.patches.len()];
        let view = View {
            field: &field,
            luminance: &luminance,
            discs: &[],
            vertical: Estimate::exact(2500.0),
            relative: 0.01,
        };
        let below = glare(&view, Threshold::default());
        let over = glare(&view, Threshold::Luminance(1990.0));
        assert!(below.sources.list.is_empty() && over.sources.list.len() == 1);
        let step = over.dgp.value - below.dgp.value;
        assert!(step > 0.01 && below.dgp.error >= step && over.dgp.error >= step);
    }
}
