//! Incident directions of a file: which are expected, which are missing, and whether any occurs twice.

use super::SAME_DIRECTION;
use super::frame::Naming;
use super::header::IncidenceChoice;
use super::records::Incidence;
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::{Component, Finding};
use crate::compute::direction::{Dir, Facade};
use crate::formats::location::{FormatError, Location};

/// Returns the cells at whose centres the incident directions should lie; `None` if the file lists its directions
/// freely.
pub(super) fn lattice(choice: IncidenceChoice, component: Component, mean: bool) -> Option<RingBasis> {
    let inside = !component.is_front();
    match choice {
        IncidenceChoice::Tregenza => Some(RingBasis::tregenza()),
        // Lists of directions are recognised in the order of the front.
        IncidenceChoice::Klems if inside && mean => Some(RingBasis::klems_full(AzimuthMap::KLEMS_BACK)),
        IncidenceChoice::Klems => Some(RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)),
        IncidenceChoice::Listed => None,
    }
}

/// Returns the chord between two directions, which equals their angle while it is small. \[rad\]
pub(super) fn chord(a: Dir<Facade>, b: Dir<Facade>) -> f64 {
    (a.vector() - b.vector()).length()
}

fn repeated(again: &Incidence, before: &Incidence) -> FormatError {
    FormatError::new(
        Location::line(again.line),
        format!("the incidence θ {}° φ {}° again (first in line {})", again.theta, again.phi, before.line),
        "every incident direction once, its records together (directions within 0.1° count as one)",
    )
}

/// Returns for every cell of a lattice the index in `list` of the incident direction at its centre; `None` where it is
/// missing.
pub(super) fn place_on(
    list: &[Incidence],
    basis: &RingBasis,
    choice: IncidenceChoice,
    naming: Naming,
) -> Result<Vec<Option<usize>>, FormatError> {
    let mut places = vec![None; basis.len()];
    for (k, incidence) in list.iter().enumerate() {
        let cell = basis.index(incidence.name).map(|index| (index, basis.cell(index).centre()));
        let Some((index, _)) = cell.filter(|(_, centre)| chord(*centre, incidence.name) < SAME_DIRECTION) else {
            let near = cell.map(|(_, centre)| naming.file_angles(centre));
            let near = near.map(|[theta, phi]| format!(" (nearest: θ {theta}° φ {phi}°)")).unwrap_or_default();
            return Err(FormatError::new(
                Location::line(incidence.line),
                format!("the incidence θ {}° φ {}°, none of {}{near}", incidence.theta, incidence.phi, choice.word()),
                "directions of that lattice, or incidence = \"listed\"",
            ));
        };
        if let Some(before) = places[index] {
            return Err(repeated(incidence, &list[before]));
        }
        places[index] = Some(k);
    }
    Ok(places)
}

/// Checks that no incident direction is listed twice; returns an error otherwise.
pub(super) fn distinct(list: &[Incidence]) -> Result<(), FormatError> {
    for (k, incidence) in list.iter().enumerate() {
        if let Some(before) = list[..k].iter().find(|other| chord(other.name, incidence.name) < SAME_DIRECTION) {
            return Err(repeated(incidence, before));
        }
    }
    Ok(())
}

/// Returns the finding that lists the incident directions of a lattice that a file lacks.
pub(super) fn incomplete(missing: &[Dir<Facade>], total: usize, choice: IncidenceChoice, naming: Naming) -> Finding {
    const NAMED: usize = 6;
    let mut names: Vec<String> = missing
        .iter()
        .take(NAMED)
        .map(|name| {
            let [theta, phi] = naming.file_angles(*name);
            format!("θ {theta}° φ {phi}°")
        })
        .collect();
    if missing.len() > NAMED {
        names.push("…".to_owned());
    }
    Finding::warning(
        "incomplete-incidence",
        format!(
            "{} of the {total} directions of {} are missing ({}); the dataset is kept as a list of the {} others.",
            missing.len(),
            choice.word(),
            names.join(", "),
            total - missing.len()
        ),
    )
}

/// Returns a finding if parts of the hemisphere are far from any incident direction of a list.
pub(super) fn sparse(list: &[Dir<Facade>], naming: Naming) -> Option<Finding> {
    const FAR: f64 = 20.0;
    let nearest = |d: Dir<Facade>| list.iter().map(|other| chord(*other, d)).fold(f64::INFINITY, f64::min);
    let (distance, direction) = RingBasis::equal_area(8)
        .cells()
        .map(|cell| (2.0 * (0.5 * nearest(cell.centre())).min(1.0).asin(), cell.centre()))
        .fold((0.0, None), |worst, (distance, d)| if distance > worst.0 { (distance, Some(d)) } else { worst });
    let direction = direction.filter(|_| distance.to_degrees() > FAR)?;
    let [theta, phi] = naming.file_angles(direction);
    Some(Finding::warning(
        "sparse-incidence",
        format!(
            "Some incidences are {:.0}° away from any listed one (near θ {theta:.0}° φ {phi:.0}°): what happens there is \
             not known from these data.",
            distance.to_degrees()
        ),
    ))
}
