//! LID tile: luminous intensity distribution of the aperture in polar diagrams, with the nadir at the bottom.

use crate::compute::direction::Surface;
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::{Aim, Peaks};
use crate::drawing::colours::Inks;
use crate::drawing::legend::{self, Name};
use crate::drawing::lid_curves::{LidPlane, SAMPLES, diffuser, sample, vertical_planes};
use crate::drawing::ticks::{self, number, si};
use crate::drawing::{Align, Drawing, Frame, Point, Shape, TEXT};
use crate::study::comparison::scales::Range;
use crate::study::subject::Subject;
use crate::texts::export as texts;
use std::f64::consts::{PI, TAU};

/// Space for the texts of the angles around the rim of a diagram. \[drawing units\]
const RIM: f64 = 27.0;
/// Minimum intensity of a beam that is drawn, relative to the strongest.
const FAINT_BEAM: f64 = 0.02;

/// Axes of a polar diagram: centre, radius and scale.
struct Polar {
    centre: Point,
    radius: f64,
    max: f64,
}

impl Polar {
    fn within(frame: Frame, max: f64) -> Self {
        let radius = (0.5 * frame.width.min(frame.height) - RIM).max(10.0);
        Self { centre: frame.centre(), radius, max: ticks::fine_ceil(max) }
    }

    /// Returns the point of the drawing for a value at an angle from the nadir towards the right \[rad\].
    fn place(&self, angle: f64, value: f64) -> Point {
        let r = (value / self.max).clamp(0.0, 1.05) * self.radius;
        [self.centre[0] + r * angle.sin(), self.centre[1] + r * angle.cos()]
    }

    fn axes(&self, drawing: &mut Drawing, label: impl Fn(f64) -> String, label_angle: f64, inks: &Inks) {
        for k in 0..12 {
            let angle = f64::from(k) * PI / 6.0;
            drawing.add(Shape::line([self.centre, self.place(angle, self.max)], inks.grid, 1.0));
            let far = 1.0 + 0.5 * RIM / self.radius;
            let at = [0, 1].map(|i| self.centre[i] + far * (self.place(angle, self.max)[i] - self.centre[i]));
            drawing.add(Shape::text(at, label(angle), inks.weak));
        }
        let rings = ticks::linear(0.0, self.max, if self.radius > 90.0 { 4 } else { 2 });
        for value in rings.iter().filter(|value| **value > 0.0) {
            drawing.add(Shape::ring(self.centre, value / self.max * self.radius, inks.grid, 1.0));
        }
        drawing.add(Shape::ring(self.centre, self.radius, inks.outline, 1.0));
        for value in rings.into_iter().filter(|value| *value > 0.0 && *value < 0.999 * self.max) {
            let [x, y] = self.place(label_angle, value);
            drawing.add(Shape::words([x + 2.0, y - 7.0], ticks::tick(value), inks.weak, TEXT, Align::Start));
        }
    }

    /// Returns the closed curve of values at equal angular steps over a whole turn.
    fn curve(&self, samples: &[f64]) -> Vec<Point> {
        let n = samples.len();
        (0..=n).map(|k| self.place(TAU * k as f64 / n as f64, samples[k % n].max(0.0))).collect()
    }
}

/// Returns the angles C and γ \[rad\] as text, e.g. "C 12°, γ 80°".
fn angles(c: f64, gamma: f64) -> String {
    format!("C {:.0}°, γ {:.0}°", c.to_degrees().round() % 360.0, gamma.to_degrees())
}

fn ideal(surface: Surface, flux: f64, section: LidPlane) -> Vec<f64> {
    (0..180).map(|k| diffuser(flux, section.direction(Aim::of(surface), TAU * f64::from(k) / 180.0))).collect()
}

pub(super) fn lid(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    range: Range,
    inks: &Inks,
) -> Result<String, String> {
    let (result, peaks) = subject.lid.as_ref().ok_or(texts::NO_LID)?;
    let lid = &result.lid;
    let planes = vertical_planes(lid.surface, Some(peaks));
    let curves = sample(lid, &planes);
    let [body, below] = frame.cut_bottom(3.0 * legend::LINE);
    let two = body.width > 1.25 * body.height;
    let [main, side] = if two { body.split(0.54) } else { [body, body] };
    let scattered = result.flux.value - lid.beam_flux();
    let max = range.map_or(curves.max, |[_, high]| high);
    let axes = Polar::within(main, max);
    axes.axes(drawing, |a| format!("{:.0}°", a.min(TAU - a).to_degrees()), -7.0 * PI / 12.0, inks);
    if scattered > 0.0 {
        let points = axes.curve(&ideal(lid.surface, scattered, LidPlane::Vertical(0)));
        drawing.add(Shape::dashed(points, inks.weak, 1.3, [5.0, 4.0]));
    }
    for (k, (_, values)) in curves.vertical.iter().enumerate().rev() {
        drawing.add(inks.curve(k, axes.curve(values), 2.0));
    }
    beams(drawing, &axes, lid, inks);
    if two {
        let axes = Polar::within(side, max);
        axes.axes(drawing, |a| format!("C{:.0}", a.to_degrees()), 7.0 * PI / 12.0, inks);
        if scattered > 0.0 {
            let points = axes.curve(&ideal(lid.surface, scattered, LidPlane::Horizontal));
            drawing.add(Shape::dashed(points, inks.weak, 1.3, [5.0, 4.0]));
        }
        drawing.add(inks.curve(3, axes.curve(&curves.horizontal), 2.0));
    }
    debug_assert_eq!(curves.horizontal.len(), SAMPLES);
    let sample_line = || vec![[0.0, 0.0], [18.0, 0.0]];
    let name = |sample: Shape, text: String| Name { sample, text };
    let mut names: Vec<Name> = curves
        .vertical
        .iter()
        .enumerate()
        .map(|(k, (plane, _))| {
            let flat = *plane == LidPlane::Vertical(90) && lid.surface == Surface::Facade;
            let words = if flat { texts::curve_cd_flat(plane.label()) } else { texts::curve_cd(plane.label()) };
            name(inks.curve(k, sample_line(), 2.5), words)
        })
        .collect();
    if two {
        names.push(name(inks.curve(3, sample_line(), 2.5), texts::FROM_ABOVE_CD.into()));
    }
    if scattered > 0.0 {
        let dashes = Shape::dashed(sample_line(), inks.weak, 1.5, [5.0, 4.0]);
        names.push(name(dashes, texts::IDEAL_DIFFUSER.into()));
    }
    if lid.beam_flux() > 0.0 {
        let dots = Shape::dashed(sample_line(), inks.beam, 2.0, [2.0, 4.0]);
        names.push(name(dots, texts::SUN_BEAM_NO_SCALE.into()));
    }
    legend::names(drawing, below, &names, inks);
    Ok(figures(lid, peaks, scattered, result.flux.error))
}

/// Draws the beams as rays in the C 0° plane.
fn beams(drawing: &mut Drawing, axes: &Polar, lid: &Lid, inks: &Inks) {
    let strongest = lid.beams.iter().map(|beam| beam.flux).fold(0.0, f64::max);
    for beam in lid.beams.iter().filter(|beam| beam.flux > FAINT_BEAM * strongest) {
        let (c, gamma) = Aim::of(lid.surface).angles(beam.direction);
        let angle = (gamma.sin() * c.cos()).atan2(gamma.cos());
        let to = axes.place(angle, axes.max);
        drawing.add(Shape::dashed([axes.centre, to], inks.beam, 2.0, [2.0, 4.0]));
        drawing.add(Shape::dot(to, 3.5, inks.beam));
    }
}

/// Returns the luminous flux and the peak intensities as text.
fn figures(lid: &Lid, peaks: &Peaks, scattered: f64, error: f64) -> String {
    let flux = match error {
        error if error > 0.0 => format!("{} ± {}", si(scattered, "lm"), si(error, "lm")),
        _ => si(scattered, "lm"),
    };
    let mut words = vec![texts::scattered_flux(flux)];
    if let Some(peak) = &peaks.scattered {
        words.push(texts::peak(si(peak.intensity, "cd"), angles(peak.c, peak.gamma)));
    }
    if lid.beam_flux() > 0.0 {
        let flux = si(lid.beam_flux(), "lm");
        words.push(match &peaks.beam {
            Some(peak) => texts::sun_beam_to(flux, angles(peak.c, peak.gamma)),
            None => texts::sun_beam(flux),
        });
    }
    words.push(texts::aperture(number(lid.size[0], 3), number(lid.size[1], 3)));
    words.join(" · ")
}
