//! Accuracy targets for the parts of a room's light.

/// Returns the relative accuracy target of the cubature at every sensor: half of the scene's error target, the rest is
/// for the light itself and for interreflection. Never looser than [`SEEN`]: a rule that is content with per cents has
/// errors a thousand times below what it can state of them, so that a loose target would enlarge the stated errors and
/// hardly save any time.
pub(super) fn cubature(error_target: Option<f64>) -> f64 {
    error_target.map_or(SEEN, |target| (0.5 * target).clamp(1e-10, SEEN))
}

/// Relative error of direct light that changes no digit that is shown. Its table is printed by
/// `examples/stated_errors.rs` (rows "made, direct").
const SEEN: f64 = 5e-5;
