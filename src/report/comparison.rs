//! Comparison chapter of a study report: figures of the candidates with their uncertainties, the same tile of each
//! candidate on a common colour scale, and the differences of each from the reference.

use super::ReportError;
use super::pages::{Figure, Pages};
use super::table::{Column, Table};
use super::tiles::room::Plan;
use super::tiles::{TileKind, draw_on, scale_of};
use crate::compute::btdf::Btdf;
use crate::compute::estimate::Estimate;
use crate::drawing::colours::{ColourScale, Inks};
use crate::drawing::hemisphere::{Projection, Round, Side};
use crate::drawing::ticks::number;
use crate::drawing::{Align, Drawing, Shape, legend};
use crate::study::comparison::difference::{Picture, of_q, of_rooms, of_tau, scale};
use crate::study::comparison::{FIGURES, Row, Value, Verdict, candidate, compare, facts_of, label, verdict_words};
use crate::study::scene_file::SceneFile;
use crate::study::subject::Subject;
use crate::texts::compare as texts;

/// Candidates of a study (scenes with results), with the tile that is drawn for each and the reference of their
/// differences.
pub struct Comparison {
    /// Names and results of the candidates, in the order of the scene.
    pub candidates: Vec<(String, Subject)>,
    /// Tile that is drawn for each candidate.
    pub tile: TileKind,
    /// Index of the reference candidate, from which differences are taken.
    pub base: usize,
}

impl Comparison {
    /// Creates the comparison of the candidates that a scene lists; `of` computes the results of each. `None` if the
    /// scene lists none.
    ///
    /// # Errors
    /// Returns the errors of `of`.
    pub fn of<E>(
        scene: &SceneFile,
        (tile, base): (TileKind, usize),
        mut of: impl FnMut(&SceneFile, &str) -> Result<Subject, E>,
    ) -> Result<Option<Self>, E> {
        let mut candidates = Vec::with_capacity(scene.compare.len());
        for keys in &scene.compare {
            let name = label(keys);
            let subject = of(&candidate(scene, keys), &name)?;
            candidates.push((name, subject));
        }
        let base = base.min(candidates.len().saturating_sub(1));
        Ok((!candidates.is_empty()).then_some(Self { candidates, tile, base }))
    }

    /// Returns the figures of all candidates, one row per figure, as in every comparison table of the program.
    pub fn rows(&self) -> Vec<Row> {
        let facts: Vec<_> = self.candidates.iter().map(|(_, subject)| facts_of(subject)).collect();
        let mut rows = compare(FIGURES, &facts.iter().collect::<Vec<_>>());
        rows.retain(|row| row.values.iter().any(Option::is_some));
        rows
    }

    /// Returns the names of the candidates, each with its number.
    fn names(&self) -> Vec<String> {
        self.candidates.iter().enumerate().map(|(k, (name, _))| format!("{} {name}", k + 1)).collect()
    }
}

/// Adds the comparison chapter to the report's pages.
///
/// # Errors
/// Returns an error if a tile that has something to show cannot be drawn.
pub(super) fn chapter(pages: &mut Pages, comparison: &Comparison, inks: &Inks) -> Result<(), ReportError> {
    let names = comparison.names();
    pages.heading(texts::CHAPTER.get());
    for name in &names {
        pages.paragraph(name);
    }
    pages.table(&table(&comparison.rows(), names.len()));
    pages.note(texts::MARK_NOTE.get());
    if names.len() < 2 {
        pages.note(texts::ONE_MORE.get());
    }
    let tile = comparison.tile;
    let range = scale_of(tile, comparison.candidates.iter().map(|(_, subject)| subject));
    let mut figures = Vec::with_capacity(names.len());
    for ((_, subject), name) in comparison.candidates.iter().zip(&names) {
        let high = if matches!(tile, TileKind::Room | TileKind::Transmittance) { 430.0 } else { 530.0 };
        let mut drawing = Drawing::new(400.0, high);
        let frame = drawing.frame().inside([6.0; 4]);
        let text = match draw_on(&mut drawing, frame, subject, (tile, range), inks) {
            Ok(text) => text,
            // Where a candidate has nothing to show, the reason stands in place of its picture.
            Err(ReportError::Nothing(_, why)) => why,
            Err(error) => return Err(error),
        };
        figures.push(Figure { drawing, caption: texts::not_drawn(name, text) });
    }
    pages.need(330.0);
    pages.heading(&texts::chapter_beside(tile.words()));
    rows_of(pages, figures);
    differences(pages, comparison, &names, inks);
    Ok(())
}

/// Adds pictures to the pages, two per row.
fn rows_of(pages: &mut Pages, mut figures: Vec<Figure>) {
    while !figures.is_empty() {
        let rest = figures.split_off(figures.len().min(2));
        // One alone keeps the size of the others.
        if figures.len() == 1 {
            let (width, height) = (figures[0].drawing.width, figures[0].drawing.height);
            figures.push(Figure { drawing: Drawing::new(width, height), caption: String::new() });
        }
        pages.pictures(&figures, 330.0);
        pages.gap(4.0);
        figures = rest;
    }
}

/// Returns the table of the comparison, with figures in rows and candidates, by their numbers, in columns.
fn table(rows: &[Row], count: usize) -> Table {
    let column = |head: String, align| Column { head, align };
    let mut columns = vec![column(texts::FIGURE.into(), Align::Start)];
    columns.extend((1..=count).map(|number| column(number.to_string(), Align::End)));
    columns.push(column(texts::BETTER.into(), Align::Start));
    let numbers: Vec<String> = (1..=count).map(|number| number.to_string()).collect();
    let line = |row: &Row| {
        let unit = if row.figure.unit.is_empty() { String::new() } else { format!(" / {}", row.figure.unit) };
        let better = |place: usize| matches!(&row.verdict, Verdict::Better(list) if list.contains(&place));
        let value = |(place, value): (usize, &Option<Value>)| {
            let words = value.map_or_else(|| "–".to_owned(), Value::words);
            if better(place) { format!("▲ {words}") } else { words }
        };
        let verdict = match &row.verdict {
            Verdict::Better(list) => {
                let places: Vec<String> = list.iter().map(|place| (place + 1).to_string()).collect();
                format!("{} ({})", places.join(texts::AND.get()), row.figure.sense.words())
            }
            other => verdict_words(other, &numbers),
        };
        let first = format!("{}{unit}", row.figure.name);
        std::iter::once(first).chain(row.values.iter().enumerate().map(value)).chain([verdict]).collect()
    };
    Table { columns, rows: rows.iter().map(line).collect() }
}

/// Returns the tile in which differences are drawn: the compared one, else the room, else the transmittance.
fn of_tile(comparison: &Comparison) -> TileKind {
    match comparison.tile {
        tile @ (TileKind::Btdf | TileKind::Transmittance | TileKind::Room) => tile,
        _ if comparison.candidates.iter().all(|(_, one)| one.room.is_some() && one.scene.grid.is_some()) => {
            TileKind::Room
        }
        _ => TileKind::Transmittance,
    }
}

/// Returns the difference between the tiles of one candidate and of the reference; `None` if they have nothing in
/// common.
fn picture(tile: TileKind, one: &Subject, base: &Subject) -> Option<Picture> {
    if tile == TileKind::Room {
        let of = |subject: &Subject| {
            let sensors = &subject.room.as_ref()?.sensors;
            let positions: Vec<[f64; 3]> = sensors.iter().map(|one| one.sensor.position.to_array()).collect();
            let totals: Vec<Estimate> = sensors.iter().map(|one| one.total()).collect();
            Some((positions, totals))
        };
        let ((positions, totals), (others, base_totals)) = (of(one)?, of(base)?);
        let values = of_rooms([&positions, &others], [&totals, &base_totals])?;
        let room = &one.file.room;
        return Some(Picture::Plan { room: [room.width, room.depth], count: one.scene.grid?, values });
    }
    let (btdf, other): (&Btdf, &Btdf) = (one.transmission()?, base.transmission()?);
    Some(match tile {
        TileKind::Btdf => Picture::Disk { side: Side::Emergent, cells: of_q(btdf, other, one.incidence.direction) },
        _ => Picture::Disk { side: Side::Incident, cells: of_tau(btdf, other) },
    })
}

fn differences(pages: &mut Pages, comparison: &Comparison, names: &[String], inks: &Inks) {
    if names.len() < 2 {
        return;
    }
    let (tile, base) = (of_tile(comparison), comparison.base);
    let of = |(_, subject): &(String, Subject)| picture(tile, subject, &comparison.candidates[base].1);
    let pictures: Vec<Option<Picture>> = comparison.candidates.iter().map(of).collect();
    let scale = scale(pictures.iter().flatten().map(Picture::reach).fold(0.0, f64::max));
    pages.need(330.0);
    pages.heading(&texts::chapter_difference(tile.words(), &names[base]));
    let others = pictures.iter().zip(names).enumerate().filter(|(place, _)| *place != base);
    let figures = others.map(|(_, (picture, name))| {
        let mut drawing = Drawing::new(400.0, 330.0);
        let text = match picture {
            Some(picture) => {
                draw(&mut drawing, picture, &scale, inks);
                summary(picture)
            }
            None => texts::NO_DIFFERENCE.into(),
        };
        Figure { drawing, caption: texts::not_drawn(name, text) }
    });
    rows_of(pages, figures.collect());
    pages.note(texts::SIGN_NOTE.get());
}

fn draw(drawing: &mut Drawing, picture: &Picture, scale: &ColourScale, inks: &Inks) {
    let [body, below] = drawing.frame().inside([8.0; 4]).cut_bottom(legend::HEIGHT);
    match picture {
        Picture::Plan { room, count: [nx, ny], values } => {
            let plan = Plan::within(body.inside([10.0, 4.0, 10.0, 6.0]), *room);
            let step = [room[0] / *nx as f64, room[1] / *ny as f64];
            for (k, one) in values.iter().enumerate() {
                drawing.add(Shape::cell(plan.cell([k % nx, k / nx], step).corners(), scale.rgb(one.value)));
            }
            drawing.add(Shape::line(plan.area.outline(), inks.outline, 1.5));
        }
        Picture::Disk { side, cells } => {
            const PROJECTION: Projection = Projection::ProjectedSolidAngle;
            let round = Round::within(body, 19.0);
            drawing.shapes.extend(round.cells((PROJECTION, *side), &cells.basis, |cell| scale.rgb(cells.values[cell])));
            drawing.shapes.extend(round.rim(PROJECTION, inks));
        }
    }
    let [name, unit] = picture.quantity();
    legend::scale(drawing, below, scale, format!("{name} {unit}").trim_end(), inks);
}

fn signed(value: f64, unit: &str) -> String {
    let sign = if value < 0.0 { "−" } else { "+" };
    format!("{sign}{} {unit}", number(value.abs(), 3)).trim_end().to_owned()
}

/// Returns mean and extremes of a difference as text.
fn summary(picture: &Picture) -> String {
    let [name, unit] = picture.quantity();
    match picture {
        Picture::Plan { values, .. } => {
            let mean = values.iter().map(|one| one.value).sum::<f64>() / values.len().max(1) as f64;
            let distinct = values.iter().filter(|one| one.value.abs() > one.error).count();
            texts::mean_difference(name, signed(mean, unit), distinct, values.len())
        }
        Picture::Disk { cells, .. } => {
            let ends = cells.values.iter().fold([0.0_f64; 2], |[low, high], one| [low.min(*one), high.max(*one)]);
            let [low, high] = ends.map(|end| signed(end, unit));
            texts::ends(name, low, high)
        }
    }
}
