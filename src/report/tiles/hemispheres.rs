//! Hemispheres of the BTDF tile, and τ over the incident hemisphere with sun paths.

use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Btdf, Indicatrix, Scattered};
use crate::compute::direction::{Emergent, Incident};
use crate::drawing::colours::{ColourMap, ColourScale, Inks};
use crate::drawing::flux_split::{FluxSplit, percent};
use crate::drawing::font::{LEADING, wrapped};
use crate::drawing::hemisphere::{
    Projection, Round, Side, cell_outline, emergent_disk, incident_cells, incident_disk, listed, on_halo,
};
use crate::drawing::ticks::number;
use crate::drawing::{Align, Drawing, Frame, Point, Shape, TEXT, legend};
use crate::study::comparison::scales::Range;
use crate::study::facing::surface;
use crate::study::incidence::{Incidence, Source};
use crate::study::incoming::{flux_split, sun_paths};
use crate::study::moment::{place_of_site, place_of_station};
use crate::study::subject::Subject;
use crate::texts::words::MONTHS;
use crate::texts::{export as texts, fixed};

const PROJECTION: Projection = Projection::ProjectedSolidAngle;
/// Space around a disk for the texts at its rim. \[drawing units\]
const RIM: f64 = 19.0;

/// Returns the positions in a frame of the disk, of the legend under it, and of the caption between them.
fn places(frame: Frame) -> (Round, Frame, Point) {
    let [above, below] = frame.cut_bottom(legend::HEIGHT);
    let [disk, caption] = above.cut_bottom(20.0);
    (Round::within(disk, RIM), below, [caption.centre()[0], caption.top + 8.0])
}

/// Draws a ring at an incident direction other than the sun's, and a dot at the sun.
fn mark(drawing: &mut Drawing, round: &Round, incidence: &Incidence, sun: Option<Incident>, inks: &Inks) {
    if incidence.source != Source::Sun {
        let at = round.place(incident_disk(PROJECTION, incidence.direction));
        drawing.add(Shape::ring(at, 6.0, [255; 3], 4.0));
        drawing.add(Shape::ring(at, 6.0, inks.series[0], 2.0));
    }
    if let Some(sun) = sun {
        let at = round.place(incident_disk(PROJECTION, sun));
        drawing.add(Shape::dot(at, 6.0, inks.sun));
        drawing.add(Shape::ring(at, 6.0, [0; 3], 1.5));
    }
}

/// Draws the light distribution for one incident direction over the emergent hemisphere, with a caption. `range`:
/// maximum \[1/sr\] and number of decades of the logarithmic colour scale; `None`: from the data.
pub fn indicatrix(
    drawing: &mut Drawing,
    frame: Frame,
    btdf: &Btdf,
    incident: Incident,
    (caption, range): (&str, Option<(f64, i32)>),
    inks: &Inks,
) {
    let (round, below, at) = places(frame);
    drawing.add(Shape::dot(round.centre, round.radius, inks.face));
    match btdf.indicatrix(incident) {
        Some(Indicatrix { basis, q }) => {
            let (max, decades) = range.unwrap_or_else(|| (q.iter().copied().fold(0.0, f64::max), 3));
            let scale = ColourScale::up_to(max, true, decades, ColourMap::Sequential);
            drawing.shapes.extend(round.cells((PROJECTION, Side::Emergent), &basis, |i| scale.rgb(q[i])));
            legend::scale(drawing, below, &scale, "q / (1/sr)", inks);
        }
        None => {
            drawing.add(Shape::text([below.centre()[0], below.top + 10.0], texts::NOTHING_SCATTERED, inks.weak));
        }
    }
    drawing.shapes.extend(round.rim(PROJECTION, inks));
    drawing.add(Shape::text(at, caption, inks.ink));
    let regular = btdf.regular.as_ref().map_or(0.0, |regular| regular.at(incident.0.theta()));
    if regular > 0.0 && incident.0.vector().z > 0.0 {
        let at = round.place(emergent_disk(PROJECTION, Emergent::from_undeviated(incident.0)));
        drawing.add(Shape::dot(at, 5.0, inks.beam));
        drawing.add(Shape::ring(at, 5.0, [255; 3], 1.5));
        let words = texts::regular_tau(number(regular, 3));
        // Beside the middle, so that the words stay on the disk.
        let over = if at[1] > round.centre[1] { -16.0 } else { 16.0 };
        let half = 0.5 * crate::drawing::font::width(&words, TEXT);
        let x = at[0].clamp(frame.left + half, (frame.right() - half).max(frame.left + half));
        drawing.shapes.extend(on_halo([x, at[1] + over], &words, inks));
    }
}

pub(super) fn btdf(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    range: Range,
    inks: &Inks,
) -> Result<String, String> {
    let btdf = subject.transmission().ok_or(texts::NO_DATA)?;
    let [outside, inside] =
        if frame.width > 1.1 * frame.height { frame.split(0.5) } else { frame.cut_bottom(0.5 * frame.height) };
    let (round, below, at) = places(outside);
    let basis = incident_cells(btdf);
    let tau: Vec<f64> = basis.cells().map(|cell| btdf.tau(Incident(cell.centre()))).collect();
    let max = tau.iter().copied().fold(0.0, f64::max).max(1e-3);
    let scale = ColourScale::up_to(max, false, 3, ColourMap::Grey);
    drawing.shapes.extend(round.cells((PROJECTION, Side::Incident), &basis, |i| scale.rgb(tau[i])));
    if let Some(data) = listed(btdf) {
        for d in data.incident() {
            let at = round.place(incident_disk(PROJECTION, *d));
            drawing.add(Shape::dot(at, 2.2, [0; 3]));
            drawing.add(Shape::dot(at, 1.6, [255; 3]));
        }
    } else {
        outlines(drawing, &round, &basis, inks);
    }
    legend::scale(drawing, below, &scale, "τ", inks);
    drawing.shapes.extend(round.rim(PROJECTION, inks));
    drawing.add(Shape::text(at, texts::OUTSIDE_FROM, inks.ink));
    mark(drawing, &round, &subject.incidence, subject.sun, inks);
    let incident = subject.incidence.direction;
    indicatrix(drawing, inside, btdf, incident, (texts::INSIDE_TO.get(), range.map(|[_, high]| (high, 3))), inks);
    Ok(of_incidence(btdf, &subject.incidence))
}

/// Draws thin lines between the cells of a basis, if these are large enough to be distinguished.
fn outlines(drawing: &mut Drawing, round: &Round, basis: &RingBasis, inks: &Inks) {
    if basis.len() > 400 {
        return;
    }
    for cell in basis.cells() {
        let mut points: Vec<Point> =
            cell_outline(PROJECTION, Side::Incident, &cell).into_iter().map(|p| round.place(p)).collect();
        points.extend(points.first().copied());
        drawing.add(Shape::line(points, inks.outline, 0.4));
    }
}

/// Returns an incident direction and its transmittance as text, e.g. "sun at θ 49°, φ 98°, profile angle 49° · τ 0.41
/// (scattered 0.35, regular 0.06)".
pub(super) fn of_incidence(btdf: &Btdf, incidence: &Incidence) -> String {
    let incident = incidence.direction;
    let tau = btdf.tau(incident);
    let regular = btdf.regular.as_ref().map_or(0.0, |regular| regular.at(incident.0.theta()));
    let parts = if regular > 0.0 && btdf.scattered.is_some() {
        texts::scattered_regular(number(tau - regular, 3), number(regular, 3))
    } else {
        String::new()
    };
    let [full, ..] = incidence.texts();
    format!("{full} · τ {}{parts}", number(tau, 3))
}

pub(super) fn transmittance(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    range: Range,
    inks: &Inks,
) -> Result<String, String> {
    let btdf = subject.transmission().ok_or(texts::NO_DATA)?;
    let split = flux_split(btdf, subject.incidence.direction, surface(&subject.file));
    let map = if frame.width > 1.1 * frame.height {
        let [map, beside] = frame.split(1.0 - (190.0 / frame.width).min(0.4));
        bar(drawing, beside, &split, &subject.incidence, inks);
        map
    } else {
        let [map, under] = frame.cut_bottom(22.0);
        drawing.add(Shape::text(under.centre(), split.lines()[0].clone(), inks.ink));
        map
    };
    let (round, below, at) = places(map);
    let basis = incident_cells(btdf);
    let max = basis.cells().map(|cell| btdf.tau(Incident(cell.centre()))).fold(0.0, f64::max);
    let scale = ColourScale::up_to(range.map_or(max.max(1e-3), |[_, high]| high), false, 3, ColourMap::Sequential);
    let cells = match &btdf.scattered {
        // Measured cells stay flat, so that the picture shows no resolution that the data do not have.
        Some(Scattered::Cells(_) | Scattered::Directions(_) | Scattered::Tree(_)) => {
            round.cells((PROJECTION, Side::Incident), &basis, |i| scale.rgb(btdf.tau(Incident(basis.cell(i).centre()))))
        }
        _ => round.field(|p| {
            let d = Side::Incident.direction_at(PROJECTION, p);
            scale.rgb(d.map_or(0.0, |d| btdf.tau(Incident(d))))
        }),
    };
    drawing.shapes.extend(cells);
    legend::scale(drawing, below, &scale, "τ", inks);
    drawing.shapes.extend(round.rim(PROJECTION, inks));
    drawing.add(Shape::text(at, texts::FROM_WITH_PATHS, inks.ink));
    paths(drawing, &round, subject, inks);
    mark(drawing, &round, &subject.incidence, subject.sun, inks);
    Ok(format!("{}. {}", of_incidence(btdf, &subject.incidence), split.sentence()))
}

/// Draws the sun paths of the 21st of each month on the disk, with hours and the names of three months.
fn paths(drawing: &mut Drawing, round: &Round, subject: &Subject, inks: &Inks) {
    let mut names: Vec<(Frame, Point, String)> = Vec::new();
    let mut name = |at: Point, text: String| {
        let half = 0.5 * crate::drawing::font::width(&text, TEXT) + 4.0;
        let place = Frame::new(at[0] - half, at[1] - 9.0, 2.0 * half, 18.0);
        if names.iter().all(|(other, ..)| !other.meets(&place)) {
            names.push((place, at, text));
        }
    };
    let place = match &subject.scene.weather {
        Some(hour) => place_of_station(&hour.station),
        None => place_of_site(&subject.file),
    };
    for (month, path) in sun_paths(&subject.file, place).iter().enumerate() {
        // The second half of the year repeats the first: thinner.
        let thick = if month <= 5 || month == 11 { 1.6 } else { 0.8 };
        let mut runs = vec![Vec::new()];
        for (hour, incident) in path {
            let at = round.place(incident_disk(PROJECTION, *incident));
            match (incident.0.vector().z > 0.0, runs.last_mut()) {
                (true, Some(run)) => run.push((*hour, at)),
                _ => runs.push(Vec::new()),
            }
        }
        for run in runs.iter().filter(|run| run.len() > 1) {
            let points: Vec<Point> = run.iter().map(|(_, at)| *at).collect();
            drawing.add(Shape::line(points.clone(), [60; 3], thick + 1.4));
            drawing.add(Shape::line(points, [255; 3], thick));
        }
        for (hour, at) in runs.iter().flatten().filter(|(hour, _)| (hour - hour.round()).abs() < 1e-6) {
            drawing.add(Shape::dot(*at, 2.2, [60; 3]));
            drawing.add(Shape::dot(*at, 1.7, [255; 3]));
            if (month == 11 || month == 5) && (hour.round() as i64) % 3 == 0 {
                let aside = if month == 5 { -11.0 } else { 11.0 };
                name([at[0], at[1] + aside], texts::hour_mark(fixed(*hour, 0)));
            }
        }
        let longest = runs.iter().max_by_key(|run| run.len()).filter(|run| run.len() > 3);
        if let (Some(run), true) = (longest, [2, 5, 11].contains(&month)) {
            name(run[run.len() / 4].1, MONTHS[month].into());
        }
    }
    for (_, at, text) in names {
        drawing.shapes.extend(on_halo(at, &text, inks));
    }
}

/// Draws the shares of the light of one incident direction, by the directions in which it leaves, as a vertical bar.
fn bar(drawing: &mut Drawing, frame: Frame, split: &FluxSplit, incidence: &Incidence, inks: &Inks) {
    let line = LEADING * TEXT;
    let words = |drawing: &mut Drawing, y: f64, text: &str, colour| {
        drawing.add(Shape::words([frame.left + 8.0, y], text, colour, TEXT, Align::Start));
    };
    words(drawing, frame.top + 10.0, incidence.name(), inks.weak);
    words(drawing, frame.top + 10.0 + line, texts::LEAVING_TO.get(), inks.weak);
    let sentence = wrapped(&split.sentence(), TEXT, frame.width - 10.0);
    let high = (frame.height - 3.2 * line - sentence.len() as f64 * line).max(40.0);
    let column = Frame::new(frame.left + 8.0, frame.top + 2.4 * line, 26.0, high);
    let total = split.total();
    let mut top = column.top;
    let mut floor = column.top;
    for (k, (zone, share)) in split.parts().into_iter().enumerate() {
        let part = if total > 0.0 { share / total * column.height } else { 0.0 };
        let colour = ColourMap::Sequential.rgb(0.85 - 0.23 * k as f32);
        drawing.add(Shape::area(Frame::new(column.left, top, column.width, part).corners(), colour));
        // Names keep a line's height between them and stay beside the bar.
        let latest = column.bottom() - line * (3 - k) as f64 - 7.0;
        let y = (top + 0.5 * part).max(floor + 7.0).min(latest.max(floor + 7.0));
        floor = y + 9.0;
        let text = format!("{zone} {}", percent(share));
        drawing.add(Shape::words([column.right() + 7.0, y], text, inks.ink, TEXT, Align::Start));
        top += part;
    }
    drawing.add(Shape::line(column.outline(), inks.outline, 1.0));
    for (k, text) in sentence.iter().enumerate() {
        words(drawing, column.bottom() + (0.9 + k as f64) * line, text, inks.ink);
    }
}
