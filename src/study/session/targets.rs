//! Accuracy targets for the components of a room's light.

/// Returns the relative accuracy target of the cubature at every sensor: half of the scene's error target; the rest is
/// for the light itself and for interreflection. It is never larger than [`SEEN`]: the errors of a rule with a target
/// of per cents are a thousand times below what it can state, so that a larger target would increase the stated errors
/// and hardly save any time.
pub(super) fn cubature(error_target: Option<f64>) -> f64 {
    error_target.map_or(SEEN, |target| (0.5 * target).clamp(1e-10, SEEN))
}

/// Relative error of the direct illuminance that changes no digit that is shown. Its table is printed by
/// `examples/stated_errors.rs` (rows "made, direct").
const SEEN: f64 = 5e-5;
