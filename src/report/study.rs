//! The report on a study, for designers: the question, the situation, figures with their errors, pictures, and how exact
//! all of it is.

use super::pages::{Figure, Pages};
use super::product::{flux, provenance};
use super::table::Table;
use super::tiles::{TileKind, draw};
use super::{ReportError, picture};
use crate::compute::estimate::Estimate;
use crate::drawing::Drawing;
use crate::drawing::colours::Inks;
use crate::drawing::ticks::{number, si, tick};
use crate::study::scene_file::{SceneFile, SurfaceKey};
use crate::study::scene_words::{coordinates, error_words};
use crate::study::subject::Subject;
use crate::study::{RoomResult, SensorResult};

/// What a report is made from.
pub struct Study<'a> {
    /// The scene with its results.
    pub subject: &'a Subject,
    /// Its title; empty: the product's name.
    pub title: &'a str,
    /// What was asked; empty: not told.
    pub question: &'a str,
    /// A comparison with other systems, made by whoever compared them: products in rows, figures with errors in columns.
    pub comparison: Option<&'a Table>,
    /// Colours or print.
    pub inks: &'a Inks,
}

/// The pages of a report.
///
/// # Errors
/// A tile that has something to show cannot be drawn.
pub fn pages(study: &Study<'_>) -> Result<Vec<Drawing>, ReportError> {
    let (subject, inks) = (study.subject, study.inks);
    let title = if study.title.is_empty() { &subject.name } else { study.title };
    let mut pages = Pages::new("Daylight study", title, &picture::situation(&subject.file), inks);
    if !study.question.is_empty() {
        pages.heading("Question");
        pages.paragraph(study.question);
    }
    pages.heading("Situation");
    pages.figures(&situation(subject));
    if let Some(room) = &subject.room {
        pages.heading("Figures");
        results(&mut pages, subject, room);
    }
    // With the first of them.
    pages.need(265.0);
    pages.heading("Pictures");
    tiles(&mut pages, subject, inks)?;
    if let Some(table) = study.comparison {
        pages.heading("Comparison");
        pages.table(table);
    }
    accuracy(&mut pages, subject);
    provenance(&mut pages, subject);
    Ok(pages.finish())
}

fn situation(subject: &Subject) -> Vec<(String, String)> {
    let file = &subject.file;
    let mut list: Vec<(String, String)> = Vec::new();
    let mut add = |name: &str, value: String| list.push((name.to_owned(), value));
    add("system", subject.name.clone());
    let site = &file.site;
    if let (Some(latitude), Some(longitude)) = (site.latitude, site.longitude) {
        add("place", format!("{}, {} m", coordinates(latitude, longitude), tick(site.elevation)));
    }
    add("façade faces", format!("{}° from north", tick(site.azimuth)));
    add("ground reflectance", tick(site.ground_reflectance));
    let room = &file.room;
    add("room", format!("{} × {} × {} m", tick(room.width), tick(room.depth), tick(room.height)));
    let rho = &room.reflectance;
    add("ρ floor, walls, ceiling", [rho.floor, rho.walls, rho.ceiling].map(tick).join(", "));
    add("E diffuse horizontal", si(subject.scene.outside.diffuse_horizontal(), "lx"));
    add("E direct horizontal", si(subject.scene.sun.map_or(0.0, |sun| sun.horizontal()), "lx"));
    for (k, aperture) in file.aperture.iter().enumerate() {
        let ([x, y], [width, height]) = (aperture.origin, aperture.size);
        let surface = if aperture.surface == SurfaceKey::Facade { "façade" } else { "roof" };
        let [x, y, width, height] = [x, y, width, height].map(tick);
        add(&format!("window {}", k + 1), format!("{surface}, {width} × {height} m at {x}, {y} m"));
    }
    add("sensors", sensors(file));
    list
}

fn sensors(file: &SceneFile) -> String {
    match &file.sensors.plane {
        Some(plane) => format!("{} × {} at {} m", plane.nx, plane.ny, tick(plane.z)),
        None => format!("{} listed", file.sensors.points.len()),
    }
}

/// A quantity, its value, and what it may be off.
fn results(pages: &mut Pages, subject: &Subject, room: &RoomResult) {
    let totals: Vec<Estimate> = room.sensors.iter().map(SensorResult::total).collect();
    let count = totals.len().max(1) as f64;
    let mean_of = |of: fn(&SensorResult) -> Estimate| {
        let sum: Estimate = room.sensors.iter().map(of).sum();
        Estimate::new(sum.value / count, sum.error / count)
    };
    let mean = mean_of(SensorResult::total);
    let least =
        totals.iter().copied().fold(Estimate::exact(f64::INFINITY), |a, b| if b.value < a.value { b } else { a });
    let most = totals.iter().copied().fold(Estimate::exact(0.0), |a, b| if b.value > a.value { b } else { a });
    let mut table = Table::of(["quantity", "value", "error"]);
    let mut lux = |name: &str, value: Estimate| {
        table.row([name.to_owned(), si(value.value, "lx"), format!("± {}", si(value.error, "lx"))]);
    };
    lux("illuminance, mean of the sensors", mean);
    lux("smallest", least);
    lux("largest", most);
    lux("mean of what comes straight from the windows", mean_of(|one| one.direct));
    lux("mean of what the room's surfaces reflect", mean_of(|one| one.interreflected));
    if mean.value > 0.0 {
        let even = least.value / mean.value;
        let error = (least.error + even * mean.error) / mean.value;
        table.row(["uniformity, smallest to mean".to_owned(), number(even, 3), format!("± {}", number(error, 2))]);
    }
    let outside = subject.scene.outside.diffuse_horizontal();
    if subject.scene.sun.is_none() && outside > 0.0 {
        let factor = |value: f64| format!("{} %", number(100.0 * value / outside, 3));
        table.row(["daylight factor, mean".to_owned(), factor(mean.value), format!("± {}", factor(mean.error))]);
    }
    if let Some(flux) = flux(subject) {
        let (value, error) = flux.split_once(" ± ").unwrap_or((&flux, "–"));
        table.row(["flux through the first window".to_owned(), value.to_owned(), format!("± {error}")]);
    }
    pages.table(&table);
    let said = error_words(totals.iter().copied());
    pages.note(&format!(
        "Stated: {said}, at sensors that are not in the dark; errors of means are sums of the sensors' own."
    ));
}

fn tiles(pages: &mut Pages, subject: &Subject, inks: &crate::drawing::colours::Inks) -> Result<(), ReportError> {
    let shown = |tile: TileKind| match tile {
        TileKind::Room => subject.room.is_some() && subject.scene.grid.is_some(),
        TileKind::Lid => subject.lid.is_some(),
        TileKind::Control => subject.control.is_some(),
        _ => true,
    };
    let figure = |tile: TileKind, size: [f64; 2]| -> Result<Figure, ReportError> {
        let mut drawing = Drawing::new(size[0], size[1]);
        let frame = drawing.frame().inside([6.0; 4]);
        let said = draw(&mut drawing, frame, subject, tile, inks)?;
        Ok(Figure { drawing, caption: format!("{}: {said}", tile.title()) })
    };
    let rows: [&[(TileKind, [f64; 2])]; 4] = [
        &[(TileKind::Room, [820.0, 330.0])],
        &[(TileKind::Sky, [400.0, 530.0]), (TileKind::Lid, [400.0, 530.0])],
        &[(TileKind::Btdf, [820.0, 400.0])],
        &[(TileKind::Transmittance, [400.0, 400.0]), (TileKind::Control, [400.0, 400.0])],
    ];
    for row in rows {
        let row: Vec<Figure> = row
            .iter()
            .filter(|(tile, _)| shown(*tile))
            .map(|(tile, size)| figure(*tile, *size))
            .collect::<Result<_, _>>()?;
        pages.pictures(&row, 330.0);
        pages.gap(4.0);
    }
    Ok(())
}

/// How it was computed, and how far that is to be trusted.
fn accuracy(pages: &mut Pages, subject: &Subject) {
    let Some(room) = &subject.room else { return };
    pages.heading("Accuracy");
    let reached = 100.0 * room.reached();
    let mut said = format!(
        "Largest relative error that is stated, at sensors that are not in the dark: {} %. Share of the light that the data \
         leave open: {} %.",
        number(reached, 2),
        number(100.0 * room.data_share(), 2)
    );
    if let Some(target) = subject.scene.error_target {
        said.push_str(&format!(" Asked for: {} %.", number(100.0 * target, 2)));
    }
    pages.paragraph(&said);
    let mut table = Table::of(["stage", "what was done"]);
    table.columns[1].align = crate::drawing::Align::Start;
    // What was kept from before says nothing about this study.
    let kept = |reason: &str| reason.starts_with("reused") || reason == "not there yet";
    for stage in room.plan.stages.iter().filter(|stage| !kept(&stage.reason)) {
        let done = if stage.runs { "computed" } else { "left out" };
        table.row([stage.name.to_owned(), format!("{done}: {}", stage.reason)]);
    }
    for (k, (source, reason)) in room.beams.iter().enumerate() {
        table.row([format!("sun's beam, window {}", k + 1), format!("{}: {reason}", source.word())]);
    }
    pages.table(&table);
    if let Some(note) = subject.scene.illuminances.and_then(|light| light.note()) {
        pages.note(&note);
    }
}
