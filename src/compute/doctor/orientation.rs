//! Check of the orientation by light from a sun at 45° altitude: the user knows the product and recognises whether up
//! and down are right.
//!
//! A dataset whose functions are all upside down, or whose sides are all exchanged, contradicts nothing. It can only be
//! unusual: devices are usually mounted so that they transmit less light from above than from below, and with the
//! brighter face outside. The user is asked about data that are not so.

use super::blocks::{Block, Blocks, Turn};
use super::{Diagnosis, Repair, RepairKind};
use crate::compute::btdf::{Btdf, Component, Dataset, Finding, Indicatrix};
use crate::compute::direction::{Dir, Emergent, Incident};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Relative difference from its own mirror image up to which a measured function counts as symmetric. Chosen: affects
/// reporting only.
const UNEVEN: f64 = 0.02;

/// Azimuth offset to either side of the vertical plane through the normal at which a function is evaluated for a sun in
/// that plane. \[rad\] Far above rounding, far below the width of cells.
const ASIDE: f64 = 1e-3;

/// Distribution of the transmitted light of one incident direction between up and down, right and left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ways {
    /// Direct-hemispherical transmittance for that incident direction.
    pub tau: f64,
    /// Share of the transmitted light that leaves upwards, 0 … 1; the rest leaves downwards.
    pub up: f64,
    /// Share of the transmitted light that leaves to the right, seen from the room, 0 … 1; the rest leaves to the left.
    pub right: f64,
}

impl Ways {
    /// Returns transmittance and shares for one incident direction; `None` when nothing is transmitted.
    pub fn of(btdf: &Btdf, incident: Incident) -> Option<Self> {
        let half = |value: f64| if value.abs() < 1e-9 { 0.5 } else { f64::from(u8::from(value > 0.0)) };
        let regular = btdf.regular.as_ref().map_or(0.0, |regular| regular.at(incident.0.theta()));
        let straight = Emergent::from_undeviated(incident.0).0.vector();
        // The façade frame's x runs right seen from outside.
        let (mut sum, mut up, mut right) = (regular, regular * half(straight.y), regular * half(-straight.x));
        if let Some(Indicatrix { basis, q }) = btdf.indicatrix(incident) {
            for (cell, q) in basis.cells().zip(q) {
                let flux = q * cell.projected_solid_angle();
                let way = Emergent::from_undeviated(cell.centre()).0.vector();
                // A cap about the normal is half above and half below.
                let (y, x) = if cell.is_cap() { (0.0, 0.0) } else { (way.y, way.x) };
                sum += flux;
                up += flux * half(y);
                right += flux * half(-x);
            }
        }
        (sum > 0.0).then(|| Self { tau: sum, up: up / sum, right: right / sum })
    }

    /// Returns transmittance and shares for a sun at 45° altitude, perpendicular to the façade in plan; `None` when
    /// nothing is transmitted.
    ///
    /// Values are means for two suns, a little to the right and to the left: the perpendicular plane is a border
    /// between cells of many functions, where the values would be those of one side.
    pub fn from_above(btdf: &Btdf) -> Option<Self> {
        let beside = |aside: f64| Self::of(btdf, Incident(Dir::from_theta_phi(FRAC_PI_4, FRAC_PI_2 + aside)));
        match (beside(ASIDE), beside(-ASIDE)) {
            (Some(a), Some(b)) => {
                let sum = a.tau + b.tau;
                let mean = |x: f64, y: f64| (x * a.tau + y * b.tau) / sum;
                Some(Self { tau: 0.5 * sum, up: mean(a.up, b.up), right: mean(a.right, b.right) })
            }
            (one, other) => one.or(other).map(|ways| Self { tau: 0.5 * ways.tau, ..ways }),
        }
    }
}

/// Returns a sentence for the user about the light that the data transmit from a sun at 45° altitude in front of the
/// façade; `None` when nothing is transmitted.
pub fn sun_from_above(btdf: &Btdf) -> Option<String> {
    let ways = Ways::from_above(btdf)?;
    let (up, down) = (100.0 * ways.up, 100.0 * (1.0 - ways.up));
    let mut text = if up > 55.0 {
        format!("{up:.0} % of the transmitted light goes up")
    } else if down > 55.0 {
        format!("{down:.0} % of the transmitted light goes down")
    } else {
        "the transmitted light goes up and down alike".to_owned()
    };
    let aside = 100.0 * ways.right.max(1.0 - ways.right);
    if aside > 60.0 {
        let side = if ways.right > 0.5 { "right" } else { "left" };
        text.push_str(&format!(", and {aside:.0} % to the {side} seen from the room"));
    }
    Some(format!("With the sun 45° above in front, {:.0} % passes; {text}.", 100.0 * ways.tau))
}

/// Returns the mean direct-hemispherical transmittance for light from 30° to 60° above (or below) the normal, at the
/// azimuth `phi` \[rad\].
fn from(btdf: &Btdf, phi: f64) -> f64 {
    let angles = [30.0_f64, 40.0, 50.0, 60.0];
    angles.iter().map(|theta| btdf.tau(Incident(Dir::from_theta_phi(theta.to_radians(), phi)))).sum::<f64>() / 4.0
}

/// Returns a finding that states the reflectance of each side if they differ, so that the user can check which side is
/// outside.
fn sides(dataset: &Dataset, blocks: &Blocks) -> Option<Diagnosis> {
    let n = blocks.weight.len();
    let turned = |k| blocks.turned(Turn::HalfRound, k);
    // Sides exchanged, a system is turned by 180° about the vertical.
    let differ = |front: Option<&Block>, back: Option<&Block>| {
        let (Some(front), Some(back)) = (front, back) else { return 0.0 };
        blocks.difference(|i, o| front.q[i * n + o], |i, o| back.q[turned(i) * n + turned(o)])
    };
    let transmission = differ(blocks.get(Component::TransmissionFront), blocks.get(Component::TransmissionBack));
    let reflection = differ(blocks.get(Component::ReflectionFront), blocks.get(Component::ReflectionBack));
    if transmission.max(reflection) < UNEVEN {
        return None;
    }
    let mut parts = Vec::new();
    if reflection >= UNEVEN {
        let rho = |component| dataset.visible.get(component).map_or(0.0, |btdf| 100.0 * btdf.tau_hemispherical());
        let (front, back) = (rho(Component::ReflectionFront), rho(Component::ReflectionBack));
        let ways = 100.0 * reflection;
        parts.push(format!(
            "the outside reflects {front:.1} % and the inside {back:.1} % of uniform light (values differ by {ways:.0} %)"
        ));
    }
    if transmission >= UNEVEN {
        parts.push(format!("the transmissions of the sides differ by {:.0} %", 100.0 * transmission));
    }
    let message = format!(
        "Outside and inside are not alike: {}. Which is which, the numbers alone cannot tell; if it is the other way \
         round, exchange the sides.",
        parts.join("; ")
    );
    Some(Diagnosis::from(Finding::info("sides", message)).with(Repair::whole(RepairKind::SwapSides)))
}

/// Returns the sentence about the sun as a finding, and findings about an unusual orientation with their repairs.
pub(super) fn check(dataset: &Dataset, blocks: Option<&Blocks>) -> Vec<Diagnosis> {
    let mut list = Vec::new();
    let Some(btdf) = dataset.transmission() else { return list };
    let turn = Repair::whole(RepairKind::TurnUpsideDown);
    let unevenness = blocks.map_or(0.0, |blocks| {
        let own = Component::ALL.iter().filter_map(|c| blocks.get(*c));
        own.map(|block| blocks.asymmetry(block, Turn::UpDown)).fold(0.0, f64::max)
    });
    let uneven = unevenness > UNEVEN;
    if let Some(sentence) = sun_from_above(btdf) {
        list.push(if uneven {
            let ask = "If that is not so, the data are upside down, or outside and inside are exchanged: the numbers alone cannot tell.";
            Diagnosis::from(Finding::info("orientation", format!("{sentence} {ask}"))).with(turn)
        } else {
            let alike = "Above and below are alike, so that it cannot be upside down.";
            Finding::info("orientation", format!("{sentence} {alike}")).into()
        });
    }
    list.extend(blocks.and_then(|blocks| sides(dataset, blocks)));
    // Closed forms of this program know their orientation.
    if dataset.format.is_empty() {
        return list;
    }
    let (above, below) = (from(btdf, FRAC_PI_2), from(btdf, -FRAC_PI_2));
    if above > 1.25 * below + 0.02 {
        let message = format!(
            "Sun from above passes better ({:.0} %) than light from below ({:.0} %), against the purpose of most devices: \
             possibly upside down, or outside and inside swapped, or slats tilted the other way.",
            100.0 * above,
            100.0 * below
        );
        list.push(Diagnosis::from(Finding::warning("maybe-upside-down", message)).with(turn));
    }
    let reflectance = |component| dataset.visible.get(component).map(Btdf::tau_hemispherical);
    if let (Some(front), Some(back)) = (reflectance(Component::ReflectionFront), reflectance(Component::ReflectionBack))
        // A slat's two faces show in proportions that depend on its tilt.
        && unevenness < 0.1
        && back > 0.2
        && front < 0.6 * back
    {
        let message = format!(
            "The inside is much brighter (reflectance {back:.2}) than the outside ({front:.2}); most devices have the \
             brighter face out: possibly outside and inside are swapped."
        );
        let swap = Repair::whole(RepairKind::SwapSides);
        list.push(Diagnosis::from(Finding::warning("maybe-sides-swapped", message)).with(swap));
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::{AngularTransmittance, Scattered};

    #[test]
    fn orientation_of_what_is_known() {
        let opal = Btdf { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(0.5))) };
        assert!(sun_from_above(&opal).is_some_and(|text| text.contains("up and down alike")));
        let clear = Btdf { regular: Some(AngularTransmittance::Constant(0.8)), scattered: None };
        assert!(sun_from_above(&clear).is_some_and(|text| text.contains("100 % of the transmitted light goes down")));
        // A sun straight ahead shines on neither side, whichever side of a border it is counted to.
        assert!(sun_from_above(&clear).is_some_and(|text| !text.contains("seen from the room")));
        // A sun on the right seen from outside shines to the left seen from outside, which is right from the room.
        let right = Ways::of(&clear, Incident(Dir::from_theta_phi(0.5, 0.0))).unwrap();
        assert_eq!((right.right, right.up), (1.0, 0.5));
    }
}
