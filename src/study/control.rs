//! The state that a control picks for a product of the catalogue.

use super::error::StudyError;
use super::scene_file::ControlMode;
use crate::catalogue::Product;
use crate::compute::control::{curve_value, most_open, profile_angle, towards_closed};
use crate::compute::lid::Facing;

/// The key of the state that `mode` picks under the given outside.
///
/// * `cut-off`, `curve`: the product's curve over the sun's profile angle, rounded towards closed; most open without
///   direct sun on the façade. Built-in blinds carry their cut-off curve.
/// * `din-5034`: the most closed state while the façade gets direct sun, else the most open.
/// * `fixed`: the product's first state.
///
/// # Errors
/// A product whose states have no numbers, or no curve where the mode needs one.
pub fn pick_state(product: &Product, mode: ControlMode, facing: &Facing<'_>) -> Result<String, StudyError> {
    let states = &product.states;
    let first = states.first().ok_or_else(|| StudyError::Catalogue(format!("'{}' has no states", product.key)))?;
    if mode == ControlMode::Fixed || states.len() == 1 {
        return Ok(first.key.clone());
    }
    let values: Vec<f64> = states.iter().map(|state| state.value).collect::<Option<_>>().ok_or_else(|| {
        StudyError::key(
            "system.state",
            format!("'{}' has states without numbers; name one of them instead", product.key),
        )
    })?;
    let lit = facing.sun_illuminance() > 0.0;
    let sun = facing.sun_direction().filter(|_| lit).and_then(profile_angle);
    let index = match (mode, sun) {
        (_, None) => most_open(&values),
        (ControlMode::Din5034, Some(_)) => towards_closed(&values, f64::INFINITY),
        (_, Some(psi)) => {
            let curve: Vec<(f64, f64)> =
                product.control_curve.iter().map(|point| (point.profile_angle, point.value)).collect();
            let demanded = curve_value(&curve, psi.to_degrees()).ok_or_else(|| {
                StudyError::key(
                    "control.mode",
                    format!("'{}' has no control curve; use \"din-5034\" or \"fixed\"", product.key),
                )
            })?;
            towards_closed(&values, demanded)
        }
    };
    Ok(states[index.unwrap_or(0)].key.clone())
}
