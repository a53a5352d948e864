//! Writing of `.btdf.txt` files in the layout `rings`, one function of one state per file.
//!
//! Values are written with all their digits. Incident and emergent cells are written unchanged where the file can
//! express them: rings with one sector centred on φ = 0. Everything else is averaged: over Klems cells for incident
//! directions, over rings of 5° or the same rings with rotated sectors for emergent ones; a finding reports it.

use super::FORMAT;
use super::beams::added;
use super::frame::{Naming, tidy};
use super::points::even_rings;
use super::quote::quoted;
use crate::compute::basis::{AzimuthMap, Resampling, Ring, RingBasis, same_cells};
use crate::compute::btdf::{Btdf, CellMatrix, Component, Dataset, Finding, Scattered, matrix_on};
use crate::compute::direction::{Dir, Facade};
use crate::formats::Written;
use crate::formats::location::{FormatError, Location};
use std::fmt::Write as _;

/// Returns a file of the dataset's transmission from outside or, without one, of its first function. Findings list the
/// functions that the file does not contain; [`write_component`] writes those.
///
/// # Errors
/// Returns an error if the dataset has no visible function.
pub fn write(dataset: &Dataset) -> Result<Written, FormatError> {
    let components = dataset.visible.components();
    let Some(first) = components.first() else {
        return Err(FormatError::new(Location::file(), "a dataset without visible functions", "at least one to write"));
    };
    let mut written = write_component(dataset, *first)?;
    for component in &components[1..] {
        let name = component.key().replace('_', " ");
        written.findings.push(Finding::info(
            "function-not-written",
            format!(
                "{name}: not written; a file of this format holds one function, here the {}.",
                first.key().replace('_', " ")
            ),
        ));
    }
    Ok(written)
}

/// Returns a `.btdf.txt` file of one function of the dataset.
///
/// # Errors
/// Returns an error if the dataset does not have that function.
pub fn write_component(dataset: &Dataset, component: Component) -> Result<Written, FormatError> {
    let Some(btdf) = dataset.visible.get(component) else {
        let have: Vec<&str> = dataset.visible.components().into_iter().map(Component::key).collect();
        return Err(FormatError::new(
            Location::file(),
            format!("a dataset without {}", component.key()),
            format!("one of: {}", have.join(", ")),
        ));
    };
    let mut findings = Vec::new();
    let table = Table::of(btdf, component, &mut findings);
    if dataset.derived.contains(&component) {
        findings
            .push(Finding::info("derived-written", "The function was derived; the file gives it like measured data."));
    }
    if dataset.solar.is_some() {
        findings.push(Finding::info("solar-not-written", "The solar band has no place in the format."));
    }
    if !dataset.thermal.is_empty() {
        findings.push(Finding::info("thermal-not-written", "Thermal data and extents have no place in the format."));
    }
    let mut text = String::new();
    head(&mut text, dataset, component, &table);
    table.records(&mut text, Naming::incident(component));
    Ok(Written { bytes: added(text, dataset)?.into_bytes(), findings })
}

/// Data of a file in its order: incident directions, emergent cells, values.
struct Table {
    incidence: &'static str,
    mean: bool,
    names: Vec<Dir<Facade>>,
    emergent: RingBasis,
    /// Values of q \[1/sr\] in one row per incident direction, in the order of `emergent`.
    rows: Vec<Vec<f64>>,
}

impl Table {
    fn of(btdf: &Btdf, component: Component, findings: &mut Vec<Finding>) -> Self {
        let mut report = |code, text: String| findings.push(Finding::info(code, text));
        let made;
        let (mut table, emergent) = match &btdf.scattered {
            // Only without straight light, which the format cannot say: it must go into cells first, as below.
            Some(Scattered::Directions(data)) if btdf.regular.is_none() => {
                let rows = (0..data.incident().len()).map(|k| data.row(k).into_owned()).collect();
                let names = data.incident().iter().map(|d| d.0).collect();
                let incidence = lattice_word(data.lattice());
                (Self { incidence, mean: false, names, emergent: data.emergent().clone(), rows }, data.emergent())
            }
            Some(Scattered::Cells(matrix)) if btdf.regular.is_none() => {
                (Self::of_matrix(matrix, &mut report), matrix.emergent())
            }
            other => {
                let from = match other {
                    Some(Scattered::Tree(_)) => "a tensor tree",
                    Some(Scattered::Lambert(_)) => "a diffuse function",
                    Some(Scattered::Directions(_) | Scattered::Cells(_)) => "cells and regular transmission",
                    None => "regular transmission",
                };
                // The finest incident cells whose means the format knows.
                let incident = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
                made = matrix_on(btdf, &incident, &even_rings(5_f64.to_radians()));
                report(
                    "resampled",
                    format!("{from}, averaged over Klems' 145 incident cells and emergent rings of 5°."),
                );
                if btdf.regular.is_some() {
                    report(
                        "regular-in-cells",
                        "Regular transmission is spread over its incident cell (10° to 15°).".to_owned(),
                    );
                }
                (Self::of_matrix(&made, &mut report), made.emergent())
            }
        };
        // A file counts sectors from φ = 0 of its own angles. Where that only renumbers cells, values stay exact.
        let own = emergent.clone();
        table.emergent = file_basis(&own, Naming::emergent(component));
        match same_cells(&own, &table.emergent) {
            Some(places) => {
                table.rows.iter_mut().for_each(|row| *row = places.iter().map(|&k| row[k]).collect());
            }
            None => {
                let resampling = Resampling::new(&own, &table.emergent);
                table.rows.iter_mut().for_each(|row| *row = resampling.apply(row));
                report(
                    "resampled",
                    "Emergent sectors were turned by parts of a cell, since a file's first sector is centred on φ = 0."
                        .to_owned(),
                );
            }
        }
        // Last: a lattice is not listed but named, and its records stand in the order of its definition.
        table.sort(Naming::incident(component));
        table
    }

    fn of_matrix(matrix: &CellMatrix, report: &mut impl FnMut(&'static str, String)) -> Self {
        let names: Vec<Dir<Facade>> = matrix.incident().cells().map(|cell| cell.centre()).collect();
        let rows = (0..names.len()).map(|k| matrix.row(k).to_vec()).collect();
        let lattice = [RingBasis::tregenza(), RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)]
            .into_iter()
            .find(|basis| same_cells(matrix.incident(), basis).is_some());
        if lattice.is_none() {
            report(
                "means-as-directions",
                format!(
                    "Means over the {} incident cells of {} are written as values at their centres: the format knows means \
                     for Tregenza's and Klems' 145 cells alone.",
                    names.len(),
                    matrix.incident().name()
                ),
            );
        }
        Self {
            incidence: lattice_word(lattice.as_ref()),
            mean: lattice.is_some(),
            names,
            emergent: matrix.emergent().clone(),
            rows,
        }
    }

    /// Sorts lattices in the order that their definition gives them in the file's angles: Tregenza's rows from the
    /// horizon, Klems' rings from the normal, φ rising.
    fn sort(&mut self, naming: Naming) {
        if self.incidence == "listed" {
            return;
        }
        let key = |name: &Dir<Facade>| {
            let ring = (name.theta().to_degrees() * 100.0).round();
            (if self.incidence == "tregenza-145" { -ring } else { ring }, naming.file_angles(*name)[1])
        };
        let mut order: Vec<usize> = (0..self.names.len()).collect();
        let keys: Vec<(f64, f64)> = self.names.iter().map(key).collect();
        order.sort_by(|&a, &b| keys[a].0.total_cmp(&keys[b].0).then(keys[a].1.total_cmp(&keys[b].1)));
        self.names = order.iter().map(|&k| self.names[k]).collect();
        self.rows = order.iter().map(|&k| std::mem::take(&mut self.rows[k])).collect();
    }

    fn records(&self, text: &mut String, naming: Naming) {
        for (name, row) in self.names.iter().zip(&self.rows) {
            let [theta, phi] = naming.file_angles(*name);
            let _ = write!(text, "{theta} {phi}");
            for q in row {
                // Shortest digits that read back as the same number.
                let _ = if *q == 0.0 || *q >= 1e-3 { write!(text, " {q}") } else { write!(text, " {q:e}") };
            }
            text.push('\n');
        }
    }
}

fn lattice_word(lattice: Option<&RingBasis>) -> &'static str {
    match lattice {
        Some(basis) if basis.rings() == RingBasis::tregenza().rings() => "tregenza-145",
        Some(_) => "klems-145",
        None => "listed",
    }
}

/// Returns the rings of a basis with azimuths counted as in the file.
fn file_basis(own: &RingBasis, naming: Naming) -> RingBasis {
    let rings: Vec<Ring> = own.rings().iter().map(|ring| Ring { first_phi: 0.0, ..*ring }).collect();
    RingBasis::new(own.name(), rings, AzimuthMap { sign: 1.0, offset: naming.turn() })
        .expect("the rings divided the hemisphere before")
}

fn head(text: &mut String, dataset: &Dataset, component: Component, table: &Table) {
    let naming = Naming::emergent(component);
    let mut line = |key: &str, value: &str| {
        let _ = writeln!(text, "{key} = {value}");
    };
    line("format", &quoted(FORMAT));
    line("name", &quoted(&dataset.name));
    line("manufacturer", &quoted(&dataset.manufacturer));
    if !dataset.description.is_empty() {
        line("description", &quoted(&dataset.description));
    }
    if let Some(thickness) = dataset.thickness {
        line("thickness", &format!("{thickness:?}"));
    }
    line("quantity", &quoted(if component.is_transmission() { "btdf" } else { "brdf" }));
    line("light_from", &quoted(if component.is_front() { "outside" } else { "inside" }));
    if !dataset.state.is_empty() {
        line("state", &quoted(&dataset.state));
    }
    line("layout", "\"rings\"");
    let rings = table.emergent.rings().iter().map(|ring| {
        let limits = [ring.theta_min, ring.theta_max].map(|theta| tidy(naming.theta(tidy(theta.to_degrees()))));
        format!("[{:?}, {:?}, {}]", limits[0].min(limits[1]), limits[0].max(limits[1]), ring.sectors)
    });
    line("rings", &format!("[{}]", rings.collect::<Vec<_>>().join(", ")));
    line("incidence", &quoted(table.incidence));
    line("incident_mean", if table.mean { "true" } else { "false" });
    text.insert_str(0, "---\n");
    text.push_str("---\n");
}
