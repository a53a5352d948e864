//! What every dataset is asked before it is stored: is light lost or won, does it go both ways alike?

use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Band, Btdf, Component, Dataset, Finding, Scattered, reciprocity_error};
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::system::cell_mean;
use glam::DVec3;

/// Findings about energy and reciprocity of a dataset's bands. Tolerances: 0.1 % of the light (rounding of files),
/// 5 % is not fit for use; 5 % of reciprocity is worth a warning, since measured data rarely do better.
pub fn check(dataset: &Dataset) -> Vec<Finding> {
    let mut findings = Vec::new();
    if dataset.visible.transmission_front.is_none() && dataset.visible.transmission_back.is_none() {
        findings.push(Finding::error("no-transmission", "No visible transmission: the system cannot be used."));
    }
    let bands = std::iter::once(("visible", &dataset.visible)).chain(dataset.solar.iter().map(|band| ("solar", band)));
    for (name, band) in bands {
        negative(name, band, &mut findings);
        energy(name, band, Component::TransmissionFront, Component::ReflectionFront, &mut findings);
        energy(name, band, Component::TransmissionBack, Component::ReflectionBack, &mut findings);
        if let (Some(front), Some(back)) = (&band.transmission_front, &band.transmission_back)
            && let Some(error) = reciprocity_error(front, back)
            && error > 0.05
        {
            findings.push(Finding::warning(
                "not-reciprocal",
                format!(
                    "Transmission from outside and from inside ({name}) differ by {:.0} % on average.",
                    100.0 * error
                ),
            ));
        }
    }
    findings
}

/// Values below zero in matrices.
fn negative(name: &str, band: &Band, findings: &mut Vec<Finding>) {
    for component in band.components() {
        let below = |values: &[f64]| values.iter().filter(|value| **value < 0.0).count();
        let count = match band.get(component).and_then(|btdf| btdf.scattered.as_ref()) {
            Some(Scattered::Cells(matrix)) => below(&matrix.values()),
            Some(Scattered::Directions(data)) => (0..data.incident().len()).map(|k| below(&data.row(k))).sum(),
            Some(Scattered::Lambert(_) | Scattered::Tree(_)) | None => 0,
        };
        if count > 0 {
            let what = component.key();
            let message = format!("{count} values of {what} ({name}) are below zero; light cannot be.");
            findings.push(Finding::warning("negative-values", message));
        }
    }
}

/// More light leaves than arrives?
fn energy(name: &str, band: &Band, through: Component, back: Component, findings: &mut Vec<Finding>) {
    let Some(transmission) = band.get(through) else { return };
    let mut worst = (0.0, Dir::from_unit(DVec3::Z));
    let mut ask = |total: f64, direction: Dir<Facade>| {
        if total > worst.0 {
            worst = (total, direction);
        }
    };
    let reflected = band.get(back);
    match &transmission.scattered {
        // Where the data lie, in cells of whatever list.
        Some(Scattered::Directions(data)) => {
            for direction in data.incident() {
                ask(transmission.tau(*direction) + reflected.map_or(0.0, |btdf| btdf.tau(*direction)), direction.0);
            }
        }
        _ => {
            let basis = transmission.incident_basis();
            for index in 0..basis.len() {
                let back = reflected.map_or(0.0, |btdf| tau_of_cell(btdf, &basis, index));
                ask(tau_of_cell(transmission, &basis, index) + back, basis.cell(index).centre());
            }
        }
    }
    let (total, direction) = worst;
    if total > 1.001 {
        let side = if through == Component::TransmissionFront { "outside" } else { "inside" };
        let message = format!(
            "{:.1} % of the {name} light from {side} at θ {:.0}°, φ {:.0}° leaves again; more than 100 % is impossible.",
            100.0 * total,
            direction.theta().to_degrees(),
            direction.phi().to_degrees()
        );
        findings.push(if total > 1.05 {
            Finding::error("energy-above-one", message)
        } else {
            Finding::warning("energy-above-one", message)
        });
    }
}

/// Directional-hemispherical value of an incident cell: means over the cell for functions of θ, the stored mean for
/// matrices on the same cells, the centre's value for all else.
fn tau_of_cell(btdf: &Btdf, basis: &RingBasis, index: usize) -> f64 {
    let cell = basis.cell(index);
    let regular = btdf.regular.as_ref().map_or(0.0, |tau| cell_mean(&cell, 6, |d| tau.at(d.theta())));
    let scattered = match &btdf.scattered {
        None => 0.0,
        Some(Scattered::Lambert(tau)) => cell_mean(&cell, 6, |d| tau.at(d.theta())),
        Some(Scattered::Cells(matrix)) if matrix.incident() == basis => matrix.tau_by_cell()[index],
        Some(Scattered::Cells(matrix)) => matrix.tau(Incident(cell.centre())),
        Some(Scattered::Directions(data)) => data.tau(Incident(cell.centre())),
        Some(Scattered::Tree(tree)) => tree.tau(Incident(cell.centre())),
    };
    regular + scattered
}
