//! Sky tile: luminances of the dome as seen from the façade, and a section through the sun.

use crate::compute::angle::{Bearing, wrap_two_pi};
use crate::compute::direction::Dir;
use crate::drawing::chart;
use crate::drawing::colours::{ColourMap, ColourScale, Inks, mixed};
use crate::drawing::hemisphere::{Round, dome_point, on_halo, side_without};
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::drawing::ticks::si;
use crate::drawing::{Drawing, Frame, Shape, legend};
use crate::study::comparison::scales::Range;
use crate::study::moment::{height_words, sun_of_site};
use crate::study::subject::Subject;
use crate::texts::{export as texts, fixed, words};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Returns altitude and bearing of the centres of small pieces of the dome. \[rad\]
fn pieces() -> impl Iterator<Item = (f64, f64)> {
    (0..18)
        .flat_map(|row| (0..72).map(move |column| (f64::from(row), f64::from(column))))
        .map(|(row, column)| ((row + 0.5) / 18.0 * FRAC_PI_2, (column + 0.5) / 72.0 * TAU))
}

pub(super) fn sky(drawing: &mut Drawing, frame: Frame, subject: &Subject, range: Range, inks: &Inks) -> String {
    let scene = &subject.scene;
    let luminance = |altitude: f64, bearing: f64| {
        scene.outside.luminance(Dir::from_altitude_bearing(altitude, Bearing::from_radians(bearing)))
    };
    let (low, high) = pieces()
        .map(|(altitude, bearing)| luminance(altitude, bearing))
        .filter(|value| *value > 0.0)
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let scale = match range {
        Some([lo, hi]) => ColourScale { lo, hi, log: true, map: ColourMap::Sequential },
        None if high > 0.0 => ColourScale::log_around(low, high, ColourMap::Sequential),
        None => ColourScale::up_to(1.0, true, 3, ColourMap::Sequential),
    };
    let [left, right] =
        if frame.width > 1.25 * frame.height { frame.split(0.55) } else { frame.cut_bottom(0.36 * frame.height) };
    let [dome, below] = left.cut_bottom(legend::HEIGHT);
    let round = Round::within(dome, 20.0);
    let facade = subject.file.site.azimuth.to_radians();
    let colour = |[right, up]: [f64; 2]| {
        let r = right.hypot(up).min(1.0);
        let (altitude, bearing) = ((1.0 - r) * FRAC_PI_2, wrap_two_pi((-right).atan2(up)));
        let full = scale.rgb(luminance(altitude, bearing));
        if (bearing - facade).cos() >= 0.0 { full } else { mixed(full, inks.face, 0.62) }
    };
    drawing.shapes.extend(round.field(colour));
    let place = match &subject.scene.weather {
        Some(weather) => Some((weather.hour.sun.altitude(), weather.hour.sun.bearing().radians())),
        None => sun_of_site(&subject.file).map(|(altitude, bearing)| (altitude, bearing.to_radians())),
    };
    let up = place.filter(|(altitude, _)| *altitude >= 0.0);
    let side = side_without(up);
    for degrees in [30.0_f64, 60.0] {
        let r = round.radius * (1.0 - degrees / 90.0);
        drawing.add(Shape::ring(round.centre, r, inks.outline, 0.6));
        let aside = r * std::f64::consts::FRAC_1_SQRT_2;
        let at = [round.centre[0] + side * aside, round.centre[1] + aside];
        drawing.shapes.extend(on_halo(at, &format!("{degrees:.0}°"), inks));
    }
    let skyline = scene.outside.skyline_altitude();
    if skyline > 0.0 {
        drawing.add(Shape::ring(round.centre, round.radius * (1.0 - skyline / FRAC_PI_2), inks.ink, 2.0));
    }
    drawing.add(Shape::ring(round.centre, round.radius, inks.outline, 1.5));
    let along = [-1.0, 1.0].map(|side| round.place(dome_point(0.0, facade + side * FRAC_PI_2)));
    drawing.add(Shape::line(along, inks.ink, 2.0));
    for (word, degrees) in [(words::N, 0.0_f64), (words::E, 90.0), (words::S, 180.0), (words::W, 270.0)] {
        let [x, y] = dome_point(0.0, degrees.to_radians());
        let far = 1.0 + 10.0 / round.radius;
        drawing.add(Shape::text(round.place([far * x, far * y]), word, inks.ink));
    }
    legend::scale(drawing, below, &scale, "cd/m²", inks);
    if let Some((altitude, bearing)) = up {
        let at = round.place(dome_point(altitude, bearing));
        drawing.add(Shape::dot(at, 7.0, inks.sun));
        drawing.add(Shape::ring(at, 7.0, [0; 3], 1.5));
    }
    let bearing = place.map_or(facade, |(_, bearing)| bearing);
    // Negative: the side away from the sun.
    let point = |degrees: i32| {
        let side = if degrees < 0 { bearing + 0.5 * TAU } else { bearing };
        let altitude = FRAC_PI_2 - f64::from(degrees.abs()).to_radians();
        [f64::from(degrees), luminance(altitude, wrap_two_pi(side))]
    };
    let at_sun = up.map(|(altitude, _)| 90.0 - altitude.to_degrees());
    let plot = Plot {
        x: Axis::linear([-90.0, 90.0], texts::ZENITH_ANGLE, Unit::Degrees),
        y: Axis::log([scale.lo, scale.hi], "L", Unit::Named("cd/m²")),
        series: vec![Series::line(texts::SKY, (-90..=90).map(point))],
        guides: at_sun
            .map(|x| Guide { name: texts::SUN.into(), ends: [[x, scale.lo], [x, scale.hi]] })
            .into_iter()
            .collect(),
    };
    let high = right.height.min(0.8 * right.width).max(60.0);
    let middle = Frame::new(right.left + 8.0, right.top + 0.5 * (right.height - high), right.width - 8.0, high);
    chart::panel(drawing, middle, &plot, inks);
    figures(subject, place)
}

/// Returns position of the sun and illuminances as text.
fn figures(subject: &Subject, place: Option<(f64, f64)>) -> String {
    let scene = &subject.scene;
    let mut parts = vec![place.map_or_else(
        || texts::NO_SUN.into(),
        |(altitude, bearing)| {
            let bearing = bearing.to_degrees().round().rem_euclid(360.0);
            texts::sun_at(height_words(altitude.to_degrees(), 1), fixed(bearing, 0))
        },
    )];
    parts.push(texts::diffuse_horizontal(si(scene.outside.diffuse_horizontal(), "lx")));
    parts.push(texts::direct_horizontal(si(scene.sun.map_or(0.0, |sun| sun.horizontal()), "lx")));
    if let Some((lid, _)) = &subject.lid {
        let (diffuse, direct) = lid.incident;
        parts.push(texts::e_on_aperture(si(diffuse.value + direct, "lx")));
    }
    parts.join(" · ")
}
