//! Reading of a dataset from a `.btdf.txt` file: header, records, symmetry, order, plausibility.

use super::beams::fingerprint;
use super::frame::Naming;
use super::header::{CatalogueFields, Header, Layout, Split, split};
use super::points::resample;
use super::records::{Incidence, point_records, ring_records};
use super::rings::{FileRings, file_rings};
use super::symmetry::{Known, fill};
use super::{FAMILY, MOST_INCIDENCES, MOST_VALUES, SAME_DIRECTION, incidence};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Btdf, CellMatrix, Component, Dataset, Finding, Indicatrices, Scattered};
use crate::compute::direction::{Dir, Facade, Incident};
use crate::formats::encoding::{decode, repaired};
use crate::formats::location::{FormatError, Location};
use std::sync::Arc;

/// Direct-hemispherical value of an indicatrix above which the file is refused, even if it is in percent.
const IMPOSSIBLE: f64 = 150.0;
/// Direct-hemispherical value of an indicatrix above which the values are assumed to be in another unit.
const OTHER_UNIT: f64 = 1.5;
/// Direct-hemispherical value up to which a missing π or cosine explains the values as well as percent; above it the
/// data check assumes percent.
const OTHER_FACTOR: f64 = 4.0;
/// Direct-hemispherical value above which the data are not fit for use.
const PLAUSIBLE: f64 = 1.05;
/// Direct-hemispherical value up to which an excess over 1 counts as rounding.
const ROUNDING: f64 = 1.001;

/// Reads a `.btdf.txt` file into a dataset that has one of the four visible functions.
///
/// # Errors
/// Returns an error, with line, what was found and what was expected, if the meaning of the numbers is ambiguous: no
/// header, unknown keys or words, counts that do not fit, values that are not finite or are below zero by more than
/// noise, incidences that are given twice or lie off the lattice that the header names, more light out than in.
pub fn read(bytes: &[u8]) -> Result<Dataset, FormatError> {
    let text = decode(bytes)?;
    let Split { mut header, body, body_line } = split(&text)?;
    let stored = header.stored_description.take();
    let Measured { list, rows, basis, mut findings } = records(&header, body, body_line)?;
    findings.extend(repaired(bytes));
    plausible(&header, &list, &rows, &basis, &mut findings)?;
    let (names, rows, lattice) = complete(&header, &list, rows, &basis, &mut findings)?;
    if header.is_mean_unspecified {
        let message =
            "The header does not say incident_mean; values are taken at the incident directions, not as means.";
        findings.push(Finding::info("incident-mean-not-told", message));
    }
    let described = stored.and_then(|stored| {
        let now = fingerprint(&header, body, &stored.described);
        stored.restored(&now).map_err(|finding| findings.push(finding)).ok()
    });
    let cells = basis.len();
    let scattered = match lattice {
        Some(lattice) if header.incident_mean => {
            let matrix = CellMatrix::new(lattice, basis, rows).expect("a row was found for every cell");
            Scattered::Cells(Box::new(matrix))
        }
        _ => {
            let names: Vec<Incident> = names.into_iter().map(Incident).collect();
            let data = Indicatrices::new(names, basis, rows).ok_or_else(|| {
                FormatError::new(Location::file(), "incident directions that coincide", "directions 0.1° apart or more")
            })?;
            Scattered::Directions(Arc::new(data))
        }
    };
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    let layout = match header.layout {
        Layout::Rings => "rings",
        Layout::Points => "points",
    };
    let mut dataset = Dataset {
        name: header.name.trim().to_owned(),
        manufacturer: header.manufacturer.trim().to_owned(),
        description: header.description.trim().to_owned(),
        state: header.state,
        thickness: header.thickness,
        format: format!("{FAMILY} {layout}"),
        incident_basis: header.incidence.word().to_owned(),
        emergent_basis: format!("{layout}, {cells} cells"),
        findings,
        described,
        ..Dataset::default()
    };
    dataset.visible.set(header.component, Btdf { regular: None, scattered: Some(scattered) });
    Ok(dataset)
}

/// Returns the product data for the catalogue in the header of a `.btdf.txt` file, beyond its dataset.
///
/// # Errors
/// Returns an error if the header is not valid.
pub fn catalogue_fields(bytes: &[u8]) -> Result<CatalogueFields, FormatError> {
    Ok(split(&decode(bytes)?)?.header.fields)
}

/// Data that the file states, before symmetry is applied.
struct Measured {
    list: Vec<Incidence>,
    rows: Vec<f64>,
    basis: RingBasis,
    findings: Vec<Finding>,
}

fn records(header: &Header, body: &str, line: usize) -> Result<Measured, FormatError> {
    let (incident, emergent) = (Naming::incident(header.component), Naming::emergent(header.component));
    let rings = match &header.rings {
        Some((list, line)) => Some(file_rings(list, *line, emergent)?),
        None => None,
    };
    let measured = match (header.layout, rings) {
        (Layout::Rings, Some(FileRings { basis, columns })) => {
            let ((list, mut rows), noise) = ring_records(body, line, basis.len(), incident)?;
            if let Some(columns) = columns {
                let sorted = rows.chunks_exact(basis.len()).flat_map(|row| columns.iter().map(|&k| row[k]));
                rows = sorted.collect();
            }
            Measured { list, rows, basis, findings: noise.into_iter().collect() }
        }
        (_, rings) => {
            let (list, noise) = point_records(body, line, incident, emergent)?;
            let distinct: Vec<Incidence> = list.iter().map(|(incidence, _)| *incidence).collect();
            incidence::distinct(&distinct)?;
            if list.is_empty() {
                return Err(no_records(line));
            }
            let made = resample(&list, rings, emergent)?;
            let findings = made.findings.into_iter().chain(noise).collect();
            Measured { list: distinct, rows: made.rows, basis: made.basis, findings }
        }
    };
    if measured.list.is_empty() { Err(no_records(line)) } else { Ok(measured) }
}

fn no_records(line: usize) -> FormatError {
    FormatError::new(Location::line(line), "no records behind the header", "a line of numbers for every incidence")
}

/// Checks the direct-hemispherical values of all indicatrices: adds findings on values above 1 and on data without
/// light, or returns an error for impossible ones.
fn plausible(
    header: &Header,
    list: &[Incidence],
    rows: &[f64],
    basis: &RingBasis,
    findings: &mut Vec<Finding>,
) -> Result<(), FormatError> {
    let weights = basis.projected_solid_angles();
    // Values are finite and not negative: a sum may overflow to infinity, but is never NaN.
    let sum = |row: &[f64]| -> f64 { row.iter().zip(&weights).map(|(q, w)| q * w).sum() };
    let sums: Vec<f64> = rows.chunks_exact(weights.len()).map(sum).collect();
    let largest = sums.iter().copied().fold(0.0, f64::max);
    let above = sums.iter().filter(|tau| **tau > ROUNDING).count();
    let percent = largest > OTHER_FACTOR && largest <= IMPOSSIBLE;
    let wrong = list.iter().zip(&sums).find(|(_, tau)| **tau > OTHER_UNIT && !percent);
    if let Some((incidence, &tau)) = wrong {
        let sum = if tau < 1e4 { format!("{tau:.4}") } else { format!("{tau:.3e}") };
        return Err(FormatError::new(
            Location::line(incidence.line),
            format!("{sum} times the light that comes from θ {}° φ {}° leaves", incidence.theta, incidence.phi),
            "at most 1 (100 in percent): values q = L/E in 1/sr, without π or the cosine of the emergent angle",
        ));
    }
    let rows_of = list.len();
    let what = if header.component.is_transmission() { "transmission" } else { "reflection" };
    let what = format!("{what} of light from {}", if header.component.is_front() { "outside" } else { "inside" });
    if largest > ROUNDING && largest <= OTHER_UNIT {
        let message =
            format!("{what}: up to {largest:.4} of the light leaves, more than 1 at {above} of {rows_of} incidences");
        findings.push(if largest > PLAUSIBLE {
            Finding::error("energy-above-one", format!("{message}: unphysical."))
        } else {
            Finding::warning("energy-above-one", format!("{message} (measuring error)."))
        });
    } else if largest == 0.0 && header.component == Component::TransmissionFront {
        findings.push(Finding::warning("opaque", "The visible transmission from outside is zero everywhere (opaque)."));
    }
    if header.component != Component::TransmissionFront {
        findings.push(Finding::info(
            "one-function",
            format!(
                "The file holds the {what} alone; to light a room the system needs its transmission from outside too."
            ),
        ));
    }
    Ok(())
}

/// Incident directions, values in rows in the same order, and the lattice of whose cells the directions are the
/// centres, if there is one.
type Ordered = (Vec<Dir<Facade>>, Vec<f64>, Option<RingBasis>);

/// Sorts the incident directions in the order of their lattice, adds those that a declared symmetry gives, and reports
/// missing ones.
fn complete(
    header: &Header,
    list: &[Incidence],
    rows: Vec<f64>,
    basis: &RingBasis,
    findings: &mut Vec<Finding>,
) -> Result<Ordered, FormatError> {
    let naming = Naming::incident(header.component);
    let lattice = incidence::lattice(header.incidence, header.component, header.incident_mean);
    let places = match &lattice {
        Some(lattice) => Some(incidence::place_on(list, lattice, header.incidence, naming)?),
        None => {
            incidence::distinct(list)?;
            None
        }
    };
    let mut known = Known { names: list.iter().map(|one| one.name).collect(), rows };
    let gaps = |places: &[Option<usize>], lattice: &RingBasis| -> Vec<Dir<Facade>> {
        let empty = lattice.cells().zip(places).filter(|(_, place)| place.is_none());
        empty.map(|(cell, _)| cell.centre()).collect()
    };
    if let Some(symmetry) = header.symmetry {
        let missing = lattice.as_ref().zip(places.as_ref()).map(|(lattice, places)| gaps(places, lattice));
        let most = MOST_INCIDENCES.min(MOST_VALUES / basis.len());
        findings.extend(fill(&mut known, basis, symmetry, missing.as_deref(), most));
    }
    let (Some(lattice), Some(places)) = (lattice, places) else {
        findings.extend(incidence::sparse(&known.names, naming));
        return Ok((known.names, known.rows, None));
    };
    // Images of the symmetry stand behind the measured ones.
    let images = &known.names[list.len()..];
    let filled: Vec<Option<usize>> = lattice
        .cells()
        .zip(&places)
        .map(|(cell, place)| {
            let image = || images.iter().position(|name| incidence::chord(*name, cell.centre()) < SAME_DIRECTION);
            place.or_else(|| image().map(|k| list.len() + k))
        })
        .collect();
    let n = basis.len();
    let order: Vec<usize> = filled.iter().copied().flatten().collect();
    let names = order.iter().map(|&k| known.names[k]).collect();
    let in_order = order.iter().enumerate().all(|(k, place)| k == *place) && order.len() == known.names.len();
    let rows = if in_order {
        known.rows
    } else {
        order.iter().flat_map(|&k| known.rows[k * n..(k + 1) * n].iter().copied()).collect()
    };
    if order.len() == lattice.len() {
        return Ok((names, rows, Some(lattice)));
    }
    findings.push(incidence::incomplete(&gaps(&filled, &lattice), lattice.len(), header.incidence, naming));
    if header.incident_mean {
        findings.push(Finding::warning(
            "means-as-directions",
            "Without all cells the means over incident cells are taken as values at their centres.",
        ));
    }
    findings.extend(incidence::sparse(&names, naming));
    Ok((names, rows, None))
}
