//! The tables of README and guide on exactness, measured again on the reference cases.
//!
//! Rows of the tables have five columns: what is compared, with the folder of the cases in backquotes (and, behind a slash, a
//! word that the names of its scenes contain); scenes; points; worst error; share of the points whose stated uncertainty holds.

use crate::common::{SELECTION, root};
use crate::reference_kit::{number, scenes};
use crate::rooms::compute;
use cfs::study::{Library, load_scene};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::Path;

/// Errors below this share of the scene's mean are counted as shares of it: no percentages of darkness.
const FLOOR: f64 = 0.01;

/// Row of a table, and the same measured.
#[derive(Debug, Clone, Copy, Default)]
struct Row {
    scenes: usize,
    points: usize,
    /// Largest error beyond the reference's own uncertainty. \[%\]
    worst: f64,
    /// Share of the points whose error is at most what is stated. \[%\]
    held: f64,
    /// Whether the scenes are a selection of those that the table counts.
    selected: bool,
}

/// Rows of a page, with folder and word.
fn rows(page: &str) -> Vec<(String, Row)> {
    let percent = |cell: &str| cell.trim_matches('*').strip_suffix(" %")?.parse().ok();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, what, scenes, points, worst, held, _] = cells[..] else { return None };
        let folder = what.split('`').nth(1)?;
        let [scenes, points] = [scenes.parse().ok()?, points.replace(' ', "").parse().ok()?];
        Some((folder.to_owned(), Row { scenes, points, worst: percent(worst)?, held: percent(held)?, selected: false }))
    };
    page.lines().filter_map(row).collect()
}

/// A scene beside its table: points, those whose uncertainty holds, worst error as a share.
fn measured(path: &Path) -> (usize, usize, f64) {
    let result = compute(&load_scene(path, &Library::default()).unwrap());
    let table: Vec<HashMap<String, String>> =
        csv::Reader::from_path(path.with_extension("csv")).unwrap().deserialize().collect::<Result<_, _>>().unwrap();
    assert_eq!(table.len(), result.sensors.len(), "{}", path.display());
    let mean = table.iter().map(|row| number(row, "E_lx")).sum::<f64>() / table.len() as f64;
    let (mut held, mut worst) = (0, 0.0_f64);
    for (row, sensor) in table.iter().zip(&result.sensors) {
        let (want, uncertainty) = (number(row, "E_lx"), number(row, "E_error_lx"));
        let off = (sensor.total().value - want).abs();
        held += usize::from(off <= sensor.total().error + uncertainty + 1e-3);
        worst = worst.max((off - uncertainty) / want.max(FLOOR * mean));
    }
    (table.len(), held, worst)
}

/// The scenes of a folder, or those whose names contain a word.
fn measure(folder: &str) -> Option<Row> {
    let (folder, word) = folder.split_once('/').unwrap_or((folder, ""));
    let mut paths = scenes(folder)?;
    let selected = paths[0].with_file_name(SELECTION).exists();
    paths.retain(|path| path.file_stem().is_some_and(|name| name.to_string_lossy().contains(word)));
    let scenes: Vec<(usize, usize, f64)> = paths.par_iter().map(|path| measured(path)).collect();
    let points = scenes.iter().map(|one| one.0).sum::<usize>();
    let held = scenes.iter().map(|one| one.1).sum::<usize>() as f64 / points as f64;
    let worst = scenes.iter().map(|one| one.2).fold(0.0, f64::max);
    Some(Row { scenes: scenes.len(), points, worst: 100.0 * worst, held: 100.0 * held, selected })
}

/// Whether a row says what was measured: the worst error rounded up to two digits at most, the share to a percent. The
/// scenes of a selection are no worse than the row says.
fn agrees(said: Row, found: Row) -> bool {
    let counted = said.scenes == found.scenes && said.points == found.points;
    let whole = counted && said.worst <= (1.5 * found.worst).max(1e-3) && (said.held - found.held).abs() <= 1.0;
    found.worst <= 1.001 * said.worst && (found.selected || whole)
}

#[test]
fn readme_and_guide_state_the_errors_that_are_measured() {
    let page = |name: &str| std::fs::read_to_string(root().join(name)).unwrap();
    let pages = ["README.md", "assets/guide/exactness.md"].map(|name| (name, rows(&page(name))));
    assert!(pages.iter().all(|(_, rows)| rows.len() > 5), "{pages:?}");
    let mut known: HashMap<&str, Option<Row>> = HashMap::new();
    let mut wrong = Vec::new();
    for (name, rows) in &pages {
        for (folder, said) in rows {
            let Some(found) = *known.entry(folder).or_insert_with(|| measure(folder)) else { continue };
            if !agrees(*said, found) {
                wrong.push(format!("{name}: {folder}: says {said:?}, measured {found:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn rows_that_say_otherwise_are_seen() {
    let said = rows("| a | b |\n| direct light (`direct`) | 3 | 1 200 | 0.21 % | 99 % |\n| x | 1 | 2 | – | – |\n");
    let [(folder, row)] = &said[..] else { panic!("{said:?}") };
    assert_eq!(folder, "direct");
    let found = Row { scenes: 3, points: 1200, worst: 0.2, held: 98.7, selected: false };
    assert!(agrees(*row, found));
    assert!(!agrees(*row, Row { worst: 0.22, ..found }) && !agrees(*row, Row { worst: 0.1, ..found }));
    assert!(!agrees(*row, Row { held: 90.0, ..found }) && !agrees(*row, Row { points: 7, ..found }));
    let some = Row { scenes: 1, points: 7, worst: 0.1, held: 100.0, selected: true };
    assert!(agrees(*row, some) && !agrees(*row, Row { worst: 0.22, ..some }));
}
