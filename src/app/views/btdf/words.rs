//! The line under the hemispheres: which incident direction is shown, and its transmittance.

use crate::app::incidence::{Incidence, direction_text};
use crate::app::paint::tile::Foot;
use crate::compute::basis::Cell;
use crate::compute::btdf::{Btdf, Scattered};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::drawing::ticks::{degrees, number};
use crate::texts::tiles as say;

/// Returns the text for the incident direction under the pointer, which a click would choose.
pub(super) fn pointed_text(d: Incident, tau: f64) -> Foot {
    let (angles, tau) = (direction_text(d.0), number(tau, 3));
    Foot::from([say::incidence_tau(&angles, &tau), format!("{angles} · τ {tau}"), format!("τ {tau}")])
}

/// Returns "sun at θ 49°, φ 98°, profile angle 49° · τ 0.41 (scattered 0.35, regular 0.06)", and shorter wordings.
pub(super) fn selection_text(btdf: &Btdf, incidence: &Incidence) -> Foot {
    let incident = incidence.direction;
    let tau = btdf.tau(incident);
    let regular = btdf.regular.as_ref().map_or(0.0, |r| r.at(incident.0.theta()));
    let parts = if regular > 0.0 && btdf.scattered.is_some() {
        say::scattered_regular(number(tau - regular, 3), number(regular, 3))
    } else {
        String::new()
    };
    let [full, middle, short] = incidence.texts();
    let (tau, of) = (format!("τ {}", number(tau, 3)), measured_at(btdf, incident));
    let shortest = format!("{} {tau}", short.replace(',', ""));
    Foot::from([
        format!("{full} · {tau}{parts}{of}"),
        format!("{middle} · {tau}{parts}{of}"),
        format!("{middle} · {tau}{of}"),
        format!("{short} · {tau}"),
        shortest,
    ])
}

/// Returns the direction that the data shown belong to, if the data are of single directions and another one is chosen;
/// else an empty text.
fn measured_at(btdf: &Btdf, incident: Incident) -> String {
    let Some(Scattered::Directions(data)) = &btdf.scattered else { return String::new() };
    let Some(own) = data.standing_for(incident.0).map(|index| data.incident()[index].0) else { return String::new() };
    if own.dot(incident.0) > 0.5_f64.to_radians().cos() {
        return String::new();
    }
    say::data_of(direction_text(own))
}

/// Returns the value drawn for a cell: q, or q times the cell's mean cosine.
pub(super) fn drawn(q: f64, cell: &Cell, weighted: bool) -> f64 {
    if weighted { q * cell.projected_solid_angle() / cell.solid_angle() } else { q }
}

/// Returns the text for an emergent direction, given by its through direction, and its value.
pub(super) fn leaving_text(through: Dir<Facade>, value: f64, weighted: bool) -> Foot {
    let leaving = Emergent::from_through_name(through);
    let (theta, phi) = (degrees(through.theta()), degrees(leaving.0.phi()));
    let value = number(value, 3);
    let what = if weighted { "q·cosθ" } else { "q" };
    Foot::from([
        say::leaving(&theta, &phi, what, &value),
        say::leaving_short(&theta, &phi, what, &value),
        format!("{what} {value} 1/sr"),
    ])
}
