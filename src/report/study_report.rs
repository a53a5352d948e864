//! Report on a study, for designers: question, situation, figures with their uncertainties, pictures, and accuracy of
//! the methods.

use super::comparison::{Comparison, chapter};
use super::pages::{Figure, Pages};
use super::product::{flux, provenance};
use super::table::Table;
use super::tiles::{TileKind, draw};
use super::words::{beam_words, stage_words};
use super::{ReportError, picture};
use crate::compute::estimate::Estimate;
use crate::drawing::Drawing;
use crate::drawing::colours::Inks;
use crate::drawing::ticks::{number, si, tick};
use crate::study::scene_file::{SceneFile, SurfaceKey};
use crate::study::scene_words::{coordinates, error_words, station_place};
use crate::study::subject::Subject;
use crate::study::{RoomResult, SensorResult};
use crate::texts::{Text, export as texts};

/// Input of a study report.
pub struct Study<'a> {
    /// Scene of the study with its results.
    pub subject: &'a Subject,
    /// Title of the report; empty: the product's name.
    pub title: &'a str,
    /// Question of the study; empty: not specified.
    pub question: &'a str,
    /// Comparison with other candidates, if any.
    pub comparison: Option<&'a Comparison>,
    /// Colours of the pictures, for screen or print.
    pub inks: &'a Inks,
}

/// Returns the pages of a study report.
///
/// # Errors
/// Returns an error if a tile that has something to show cannot be drawn.
pub fn pages(study: &Study<'_>) -> Result<Vec<Drawing>, ReportError> {
    let (subject, inks) = (study.subject, study.inks);
    let title = if study.title.is_empty() { &subject.name } else { study.title };
    let mut pages = Pages::new(texts::STUDY.get(), title, &picture::situation(&subject.file), inks);
    if !study.question.is_empty() {
        pages.heading(texts::QUESTION.get());
        pages.paragraph(study.question);
    }
    pages.heading(texts::SITUATION.get());
    pages.figures(&situation(subject));
    if let Some(room) = &subject.room {
        pages.heading(texts::FIGURES.get());
        results(&mut pages, subject, room);
    }
    // Together with the first of them.
    pages.need(265.0);
    pages.heading(texts::PICTURES.get());
    tiles(&mut pages, subject, inks)?;
    if let Some(comparison) = study.comparison {
        chapter(&mut pages, comparison, inks)?;
    }
    accuracy(&mut pages, subject);
    provenance(&mut pages, subject);
    Ok(pages.finish())
}

fn situation(subject: &Subject) -> Vec<(String, String)> {
    let file = &subject.file;
    let mut list: Vec<(String, String)> = Vec::new();
    let mut add = |name: Text, value: String| list.push((name.into(), value));
    add(texts::SYSTEM, subject.name.clone());
    let site = &file.site;
    if let Some(weather) = &subject.scene.weather {
        add(texts::WEATHER, format!("{}: {}", station_place(&weather.station), weather.interval));
    } else if let (Some(latitude), Some(longitude)) = (site.latitude, site.longitude) {
        add(texts::PLACE, format!("{}, {} m", coordinates(latitude, longitude), tick(site.elevation)));
    }
    add(texts::FACADE_FACES, texts::from_north(tick(site.azimuth)));
    add(texts::GROUND, tick(site.ground_reflectance));
    if file.has_outside() {
        let named = if file.building.is_some() { texts::BUILDING_NAMED } else { texts::BUILDING_NOT_NAMED };
        add(texts::OUTSIDE, texts::boxes_and_ground(file.outside.len(), tick(site.ground_height), named.get()));
    }
    let room = &file.room;
    add(texts::ROOM, format!("{} × {} × {} m", tick(room.width), tick(room.depth), tick(room.height)));
    let rho = &room.reflectance;
    add(texts::RHO_ROOM, [rho.floor, rho.walls, rho.ceiling].map(tick).join(texts::LIST_OF_THREE.get()));
    add(texts::E_DIFFUSE, si(subject.scene.outside.diffuse_horizontal(), "lx"));
    add(texts::E_DIRECT, si(subject.scene.sun.map_or(0.0, |sun| sun.horizontal()), "lx"));
    for (k, aperture) in file.aperture.iter().enumerate() {
        let ([x, y], [width, height]) = (aperture.origin, aperture.size);
        let surface = if aperture.surface == SurfaceKey::Facade { texts::FACADE } else { texts::ROOF };
        let [x, y, width, height] = [x, y, width, height].map(tick);
        list.push((texts::window_number(k + 1), texts::window_at(surface, width, height, x, y)));
    }
    list.push((texts::SENSORS.into(), sensors(file)));
    list
}

fn sensors(file: &SceneFile) -> String {
    match &file.sensors.plane {
        Some(plane) => texts::sensors_plane(plane.nx, plane.ny, tick(plane.z)),
        None => texts::sensors_listed(file.sensors.points.len()),
    }
}

/// Adds the table of results: quantities with their values and uncertainties.
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
    let mut table = Table::of([texts::QUANTITY, texts::VALUE, texts::ERROR].map(Text::get));
    let mut lux = |name: Text, value: Estimate| {
        table.row([name.into(), si(value.value, "lx"), format!("± {}", si(value.error, "lx"))]);
    };
    lux(texts::MEAN, mean);
    lux(texts::SMALLEST, least);
    lux(texts::LARGEST, most);
    lux(texts::MEAN_DIRECT, mean_of(|one| one.direct));
    lux(texts::MEAN_REFLECTED, mean_of(|one| one.interreflected));
    if mean.value > 0.0 {
        let even = least.value / mean.value;
        let error = (least.error + even * mean.error) / mean.value;
        table.row([texts::UNIFORMITY.into(), number(even, 3), format!("± {}", number(error, 2))]);
    }
    let outside = subject.scene.outside.diffuse_horizontal();
    if subject.scene.sun.is_none() && outside > 0.0 {
        let factor = |value: f64| format!("{} %", number(100.0 * value / outside, 3));
        table.row([texts::DAYLIGHT_FACTOR.into(), factor(mean.value), format!("± {}", factor(mean.error))]);
    }
    if let Some(flux) = flux(subject) {
        let (value, error) = flux.split_once(" ± ").unwrap_or((&flux, "–"));
        table.row([texts::FLUX.into(), value.to_owned(), format!("± {error}")]);
    }
    pages.table(&table);
    let text = error_words(totals.iter().copied());
    pages.note(&texts::stated_note(text));
}

fn tiles(pages: &mut Pages, subject: &Subject, inks: &crate::drawing::colours::Inks) -> Result<(), ReportError> {
    let shown = |tile: TileKind| match tile {
        TileKind::Room => subject.room.is_some() && subject.scene.grid.is_some(),
        TileKind::Lid => subject.lid.is_some(),
        TileKind::Control => subject.control.is_some(),
        TileKind::Year => subject.year.is_some(),
        TileKind::Choose => subject.ranking.is_some(),
        _ => true,
    };
    let figure = |tile: TileKind, size: [f64; 2]| -> Result<Figure, ReportError> {
        let mut drawing = Drawing::new(size[0], size[1]);
        let frame = drawing.frame().inside([6.0; 4]);
        let text = draw(&mut drawing, frame, subject, tile, inks)?;
        Ok(Figure { drawing, caption: format!("{}: {text}", tile.words()) })
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

/// Adds the text about the methods of the computation and their accuracy.
fn accuracy(pages: &mut Pages, subject: &Subject) {
    let Some(room) = &subject.room else { return };
    pages.heading(texts::ACCURACY.get());
    let reached = 100.0 * room.reached();
    let mut text = texts::accuracy_reached(number(reached, 2), number(100.0 * room.data_share(), 2));
    if let Some(target) = subject.scene.error_target {
        text.push_str(&texts::accuracy_asked(number(100.0 * target, 2)));
    }
    pages.paragraph(&text);
    let mut table = Table::of([texts::STAGE, texts::WHAT_WAS_DONE].map(Text::get));
    table.columns[1].align = crate::drawing::Align::Start;
    // Results from the cache say nothing about this study.
    for stage in room.plan.stages.iter().filter(|stage| !stage.is_kept()) {
        let done = if stage.runs { texts::stage_computed(&stage.reason) } else { texts::stage_left_out(&stage.reason) };
        table.row([stage_words(stage.name), done]);
    }
    for (k, (source, reason)) in room.beams.iter().enumerate() {
        table.row([texts::beam_of_window(k + 1), format!("{}: {reason}", beam_words(*source))]);
    }
    pages.table(&table);
    if let Some(note) = subject.scene.illuminances.and_then(|light| light.note()) {
        pages.note(&note);
    }
}
