//! Steps by which objects of the room are moved with pointer or keys.

/// Step of a movement, without and with Shift held. \[m\]
pub(super) const STEPS: [f64; 2] = [0.05, 0.01];

/// Returns a length \[m\] rounded to the nearest multiple of `step` \[m\], and to the millimetre so that the value
/// shown is exact; for a step of 0 only to the millimetre.
pub(super) fn snapped(value: f64, step: f64) -> f64 {
    let value = if step > 0.0 { (value / step).round() * step } else { value };
    // Nothing is at −0 m.
    (value * 1000.0).round() / 1000.0 + 0.0
}
