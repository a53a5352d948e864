//! The steps in which things are moved by hand.

/// Steps of what is moved, and with Shift. \[m\]
pub(super) const STEPS: [f64; 2] = [0.05, 0.01];

/// The nearest step, to the millimetre so that what is shown is what is meant.
pub(super) fn snapped(value: f64, step: f64) -> f64 {
    let value = if step > 0.0 { (value / step).round() * step } else { value };
    // Nothing is at −0 m.
    (value * 1000.0).round() / 1000.0 + 0.0
}
