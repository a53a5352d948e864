//! Control tile: states over the profile angle, today's path of the sun on that curve, and the year.

use crate::drawing::chart;
use crate::drawing::colours::{ColourMap, Inks};
use crate::drawing::hemisphere::on_halo;
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::drawing::ticks::tick;
use crate::drawing::{Align, Drawing, Frame, Rgb, Shape, TEXT};
use crate::study::moment;
use crate::study::product_control::words;
use crate::study::subject::{Controlled, Subject};
use crate::texts::{export as texts, fixed};

fn colour(states: usize, index: usize) -> Rgb {
    ColourMap::Sequential.rgb(index as f32 / (states.max(2) - 1) as f32)
}

/// Returns the state with the given index as text, e.g. "state 45 (slat angle 45°)".
fn state(control: &Controlled, index: usize) -> String {
    let (quantity, unit) = control.quantity.split_once(" / ").unwrap_or((control.quantity, ""));
    control.states.get(index).map_or_else(String::new, |(key, value)| {
        if key.parse() == Ok(*value) { format!("{quantity} {}{unit}", tick(*value)) } else { texts::state(key) }
    })
}

pub(super) fn control(drawing: &mut Drawing, frame: Frame, subject: &Subject, inks: &Inks) -> Result<String, String> {
    let control = subject.control.as_ref().ok_or(texts::STILL)?;
    let year = control.year.as_ref().filter(|year| !year.hours.is_empty());
    let [upper, lower] = frame.cut_bottom(if year.is_some() { 0.46 * frame.height } else { 0.0 });
    curve(drawing, upper, control, inks);
    if let Some(year) = year {
        let [map, names] = lower.cut_bottom(20.0);
        hours(drawing, map, control, &year.hours, subject, inks);
        states(drawing, names, control, inks);
    }
    let now = control
        .profile_angle
        .map_or_else(|| texts::SUN_BEHIND.into(), |angle| texts::profile_angle_is(fixed(angle, 0)));
    let mut parts = vec![words(control.mode).does.to_owned(), now, state(control, control.current)];
    if let Some(year) = year {
        parts.push(texts::movements(year.movements));
    }
    Ok(parts.join(" · "))
}

fn curve(drawing: &mut Drawing, frame: Frame, control: &Controlled, inks: &Inks) {
    let values = control.states.iter().map(|(_, value)| *value).chain(control.curve.iter().map(|point| point[1]));
    let (lo, hi) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), value| (lo.min(value), hi.max(value)));
    let margin = 0.08 * (hi - lo).max(1.0);
    let (lo, hi) = (lo - margin, hi + margin);
    let (name, unit) = control.quantity.split_once(" / ").unwrap_or((control.quantity, ""));
    let unit = if unit == "°" { Unit::Degrees } else { Unit::Named("") };
    let value = |index: u16| control.states.get(usize::from(index)).map_or(f64::NAN, |(_, value)| *value);
    let today = control.today.iter().map(|(_, point)| match point {
        // The line ends at the end of the axis.
        Some((angle, index)) if *angle <= 90.0 => [*angle, value(*index)],
        _ => [f64::NAN; 2],
    });
    let now = control.profile_angle.filter(|angle| (0.0..=90.0).contains(angle));
    let mut series = vec![Series::line(texts::RULE, control.curve.iter().copied())];
    if !control.today.is_empty() {
        series.push(Series::line(texts::TODAY, today));
    }
    let plot = Plot {
        x: Axis::linear([0.0, 90.0], texts::PROFILE_ANGLE, Unit::Degrees),
        y: Axis::linear([lo, hi], name, unit),
        series,
        guides: now
            .map(|angle| Guide { name: texts::NOW.into(), ends: [[angle, lo], [angle, hi]] })
            .into_iter()
            .collect(),
    };
    let high = chart::names(drawing, frame.inside([40.0, 0.0, 8.0, 0.0]), &plot.series, inks);
    let panel = chart::panel(drawing, frame.inside([0.0, high, 8.0, 0.0]), &plot, inks);
    let mut used: Vec<Frame> = Vec::new();
    for (hour, point) in control.today.iter().filter(|(hour, _)| (hour - hour.round()).abs() < 1e-6) {
        let seen = point.filter(|(angle, _)| *angle <= 90.0);
        let Some(at) = seen.and_then(|(angle, index)| panel.of([angle, value(index)])) else { continue };
        drawing.add(Shape::dot(at, 3.0, inks.sun));
        drawing.add(Shape::ring(at, 3.0, inks.ink, 1.0));
        let text = Frame::new(at[0] - 14.0, at[1] - 20.0, 28.0, 14.0);
        if used.iter().all(|other| !other.meets(&text)) && panel.area.holds(&text) {
            used.push(text);
            drawing.shapes.extend(on_halo(text.centre(), &texts::hour_mark(fixed(*hour, 0)), inks));
        }
    }
    for (k, (_, value)) in control.states.iter().enumerate() {
        let Some([_, y]) = panel.of([0.0, *value]) else { continue };
        let radius = if k == control.current { 6.0 } else { 3.0 };
        let at = [panel.area.right(), y];
        drawing.add(Shape::dot(at, radius, colour(control.states.len(), k)));
        drawing.add(Shape::ring(at, radius, inks.ink, 1.0));
    }
}

/// Draws the map of the year: one column per day, noon in the middle, every hour in the colour of its state.
fn hours(
    drawing: &mut Drawing,
    frame: Frame,
    control: &Controlled,
    year: &[Option<u16>],
    subject: &Subject,
    inks: &Inks,
) {
    let days = year.len().div_ceil(24);
    let plot = Plot {
        x: Axis::linear([0.0, days as f64], "", Unit::Days),
        y: Axis::linear([0.0, 24.0], "", Unit::Hours),
        series: Vec::new(),
        guides: Vec::new(),
    };
    let panel = chart::panel(drawing, frame.inside([18.0, 0.0, 8.0, 0.0]), &plot, inks);
    drawing.add(Shape::area(panel.area.corners(), inks.face));
    for hour in 0..24 {
        // Days of one state side by side are one piece.
        let mut day = 0;
        while day < days {
            let at = |day: usize| year.get(24 * day + hour).copied().flatten();
            let (first, index) = (day, at(day));
            while day < days && at(day) == index {
                day += 1;
            }
            let Some(index) = index else { continue };
            let [left, bottom] = panel.place([first as f64, hour as f64]);
            let [right, top] = panel.place([day as f64, hour as f64 + 1.0]);
            let piece = Frame::new(left, top, right - left, bottom - top);
            drawing.add(Shape::cell(piece.corners(), colour(control.states.len(), usize::from(index))));
        }
    }
    drawing.add(Shape::line(panel.area.outline(), inks.outline, 1.0));
    if let Some(time) = moment::of(&subject.file) {
        let hour = f64::from(time.hour()) + f64::from(time.minute()) / 60.0;
        let at = panel.place([f64::from(time.day_of_year()) - 0.5, hour]);
        drawing.add(Shape::dot(at, 4.5, inks.sun));
        drawing.add(Shape::ring(at, 4.5, [0; 3], 1.5));
    }
}

/// Draws the legend of the colours of the states.
fn states(drawing: &mut Drawing, frame: Frame, control: &Controlled, inks: &Inks) {
    let count = control.states.len();
    let room = ((frame.width - 180.0) / 48.0).max(2.0) as usize;
    let mut x = frame.left + 40.0;
    let y = frame.centre()[1];
    let write = |drawing: &mut Drawing, x: f64, text: String, colour| {
        drawing.add(Shape::words([x, y], text, colour, TEXT, Align::Start));
    };
    for k in (0..count).step_by(count.div_ceil(room).max(1)) {
        let swatch = Frame::new(x, y - 5.0, 10.0, 10.0);
        drawing.add(Shape::area(swatch.corners(), colour(count, k)));
        drawing.add(Shape::line(swatch.outline(), inks.outline, 1.0));
        let text = tick(control.states[k].1);
        let wide = crate::drawing::font::width(&text, TEXT);
        write(drawing, x + 14.0, text, inks.ink);
        x += 24.0 + wide;
    }
    write(drawing, x + 4.0, control.quantity.to_owned(), inks.weak);
}
