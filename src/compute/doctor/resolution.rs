//! Angular resolution of a dataset, and the calculations that it is sufficient for.

use super::Diagnosis;
use crate::compute::btdf::{Dataset, Finding, Scattered};

/// Width of emergent cells up to which the sun's image, and thus the luminance that causes glare, is resolved: 1.5°,
/// some three diameters of the sun. \[rad\] Chosen: affects wording only.
const GLARE: f64 = 0.026;
/// Width of emergent cells up to which patches of redirected sunlight in the room have their right position, with soft
/// edges: 4°. \[rad\] Chosen: affects wording only.
const PATCHES: f64 = 0.07;

/// Returns a finding that states the angular resolution and the calculations that it suffices for.
pub(super) fn check(dataset: &Dataset) -> Option<Diagnosis> {
    let btdf = dataset.transmission_of_either_side()?;
    let side = |count: usize| (2.0 * std::f64::consts::PI / count as f64).sqrt();
    let (what, width) = match btdf.scattered.as_ref() {
        None => ("Regular transmission only".to_owned(), 0.0),
        Some(Scattered::Lambert(_)) => ("Ideally diffuse, a function of the angle of incidence".to_owned(), 0.0),
        Some(Scattered::Cells(matrix)) => {
            let (i, o) = (matrix.incident().len(), matrix.emergent().len());
            (format!("{i} × {o} directions"), side(i.min(o)))
        }
        Some(Scattered::Directions(data)) => {
            let (i, o) = (data.incident().len(), data.emergent().len());
            (format!("{i} incident directions × {o} emergent cells"), side(o))
        }
        Some(Scattered::Tree(tree)) => {
            let n = tree.incident_resolution();
            (format!("a tensor tree of {n} × {n} emergent cells at its finest"), side(n * n))
        }
    };
    let fit = if width <= GLARE {
        "daylight amounts: yes; patches of direct sun: yes; glare: yes"
    } else if width <= PATCHES {
        "daylight amounts: yes; patches of direct sun: roughly; glare: no"
    } else {
        "daylight amounts: yes; patches of direct sun: no (their light is spread over whole cells); glare: no"
    };
    let size = if width > 0.0 { format!(", about {:.0}° each", width.to_degrees()) } else { String::new() };
    Some(Finding::info("resolution", format!("{what}{size}. Fit for {fit}.")).into())
}
