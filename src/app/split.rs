//! Where the light of one direction goes, for the transmittance tile.

use super::views::transmittance::FluxSplit;
use crate::compute::btdf::{Btdf, zone_shares};
use crate::compute::direction::{Incident, Surface};
use glam::DVec3;

/// The zones by the elevation at which light leaves, in words.
pub const ZONES: &str = "Shares of the light that arrives, by the elevation at which it leaves: ceiling above +10°, \
eye zone −10…+10°, work zone −45…−10°, floor below −45°.";

/// Elevations between the zones from top to bottom. \[°\]
const LIMITS: [f64; 3] = [10.0, -10.0, -45.0];

/// Shares of the light from one direction that go to the [`ZONES`]; their sum is τ.
pub fn split(btdf: &Btdf, incident: Incident, surface: Surface) -> FluxSplit {
    let up = surface.facade_from_room(DVec3::Z);
    let shares = zone_shares(btdf, incident, up, LIMITS.map(f64::to_radians));
    FluxSplit { ceiling: shares[0], eye_zone: shares[1], work_zone: shares[2], floor: shares[3] }
}
