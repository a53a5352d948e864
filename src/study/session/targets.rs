//! How exactly the parts of a room's light are found.

/// Relative accuracy asked of the cubature at every sensor: half of what the scene asks for, the rest is for the light
/// itself and for interreflection. Never looser than [`SEEN`]: a rule that is content with per cents has errors a thousand
/// times below what it can state of them, so that a loose target would buy padding and hardly any time.
pub(super) fn cubature(error_target: Option<f64>) -> f64 {
    error_target.map_or(SEEN, |target| (0.5 * target).clamp(1e-10, SEEN))
}

/// Relative error of direct light that costs no digit that anyone sees. Its table is printed by
/// `examples/stated_errors.rs` (rows "made, direct").
const SEEN: f64 = 5e-5;
