//! Steps in which things are moved with pointer or keys.

/// Step of a movement, and the step with Shift held. \[m\]
pub(super) const STEPS: [f64; 2] = [0.05, 0.01];

/// Returns the nearest multiple of a step, rounded to the millimetre so that the value shown is exact. \[m\]
pub(super) fn snapped(value: f64, step: f64) -> f64 {
    let value = if step > 0.0 { (value / step).round() * step } else { value };
    // Nothing is at −0 m.
    (value * 1000.0).round() / 1000.0 + 0.0
}
