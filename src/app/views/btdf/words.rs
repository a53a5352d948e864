//! Texts of the line under the hemispheres: the incident direction shown and its transmittance τ, or values under the
//! pointer.

use crate::app::paint::tile::Foot;
use crate::app::scene::incidence::{Incidence, direction_text};
use crate::compute::basis::Cell;
use crate::compute::btdf::{Btdf, Scattered};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::drawing::ticks::{degrees, number};
use crate::texts::tiles as say;

/// Returns the text for the incident direction under the pointer, which a click would choose, and its transmittance
/// `tau`.
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

/// Returns the incident direction of the data shown as text, if it differs by more than 0.5° from the chosen one
/// because the data are available for single directions only; otherwise an empty text.
fn measured_at(btdf: &Btdf, incident: Incident) -> String {
    let Some(Scattered::Directions(data)) = &btdf.scattered else { return String::new() };
    let Some(own) = data.standing_for(incident.0).map(|index| data.incident()[index].0) else { return String::new() };
    if own.dot(incident.0) > 0.5_f64.to_radians().cos() {
        return String::new();
    }
    say::data_of(direction_text(own))
}

/// Returns the value drawn for an emergent cell: q, or if `weighted` q times the mean cosine of the cell. \[1/sr\]
pub(super) fn drawn(q: f64, cell: &Cell, weighted: bool) -> f64 {
    if weighted { q * cell.projected_solid_angle() / cell.solid_angle() } else { q }
}

/// Returns the text for an emergent direction and its value q or q·cosθ (if `weighted`) \[1/sr\]. `through`: the
/// direction of undeviated light that emerges in this direction.
pub(super) fn leaving_text(through: Dir<Facade>, value: f64, weighted: bool) -> Foot {
    let leaving = Emergent::from_undeviated(through);
    let (theta, phi) = (degrees(through.theta()), degrees(leaving.0.phi()));
    let value = number(value, 3);
    let what = if weighted { "q·cosθ" } else { "q" };
    Foot::from([
        say::leaving(&theta, &phi, what, &value),
        say::leaving_short(&theta, &phi, what, &value),
        format!("{what} {value} 1/sr"),
    ])
}
