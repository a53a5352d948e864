//! Texts and tables of the results at the sensor points, for the room tile.

use super::input::{CellValue, Input, Quantity};
use crate::app::paint::tile::Foot;
use crate::compute::estimate::Estimate;
use crate::drawing::ticks::number;
pub use crate::study::scene_words::error_words;
use crate::texts::tiles as say;

/// Returns the mean of the results at all sensor points and the uniformity U_o (minimum / mean), with the errors that
/// result if all values deviate by their errors at once; `None` without light.
pub fn uniformity(cells: &[CellValue]) -> Option<(Estimate, Estimate)> {
    let least = cells.iter().min_by(|a, b| a.total.total_cmp(&b.total))?;
    let sum: Estimate = cells.iter().map(|cell| Estimate::new(cell.total, cell.error)).sum();
    let mean = sum * (1.0 / cells.len() as f64);
    if mean.value <= 0.0 {
        return None;
    }
    let ratio = least.total / mean.value;
    Some((mean, Estimate::new(ratio, ratio * mean.error / mean.value + least.error / mean.value)))
}

/// Returns result, error and components at one sensor point as text.
pub(super) fn value_text(v: &CellValue, quantity: Quantity) -> Foot {
    let unit = quantity.unit();
    let error = match (v.error, v.data_error) {
        (0.0, _) => String::new(),
        (all, 0.0) => format!(" ± {}", number(all, 2)),
        (all, data) => say::error_parts(number(all, 2), number((all - data).max(0.0), 2), number(data, 2)),
    };
    let sun = if v.beam > 0.0 { say::sun_beam(quantity.format(v.beam)) } else { String::new() };
    let (direct, inter) = (quantity.format(v.direct), quantity.format(v.inter));
    let total = number(v.total, 4);
    let short =
        if v.error > 0.0 { format!("{total} ± {} {unit}", number(v.error, 2)) } else { format!("{total} {unit}") };
    Foot::from([
        say::room_value(format!("{total}{error} {unit}"), &direct, sun, inter),
        say::room_value_direct(format!("{total}{error} {unit}"), direct),
        short,
        format!("{total} {unit}"),
    ])
}

fn dark() -> Foot {
    Foot::from([say::NO_LIGHT_AT_SENSORS, say::NO_LIGHT].map(String::from))
}

/// Returns a summary of the results at all sensor points as text: mean, uniformity, range.
pub(super) fn summary(input: &Input<'_>) -> Foot {
    let formatted = |value| input.quantity.format(value);
    let totals = || input.cells.iter().map(|c| c.total);
    let Some((mean, ratio)) = uniformity(input.cells) else { return dark() };
    let (min, max) = (totals().fold(f64::INFINITY, f64::min), totals().fold(0.0, f64::max));
    let error = error_words(input.cells.iter().map(|c| Estimate::new(c.total, c.error)));
    let [mean_text, u0] = [formatted(mean.value), number(ratio.value, 2)];
    let [mean_error, ratio_error] = [mean.error, ratio.error]
        .map(|error| if error > 0.0 { format!(" ± {}", number(error, 2)) } else { String::new() });
    let why = if input.look.daylight_factor { input.no_factor } else { None };
    let why = why.map_or_else(String::new, |why| format!("{why} · "));
    Foot::from([
        say::room_summary(
            &why,
            format!("{mean_text}{mean_error}"),
            format!("{u0}{ratio_error}"),
            formatted(min),
            formatted(max),
            error,
        ),
        say::room_summary_range(why, &mean_text, &u0, number(min, 3), formatted(max)),
        say::room_summary_ratio(&mean_text, u0),
        say::range(number(min, 3), formatted(max)),
        say::mean(mean_text),
    ])
}

/// Returns the results at all sensor points as CSV, with position \[m\], components and errors.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let names = "x_m,y_m,z_m,total_lx,error_lx,direct_lx,interreflected_lx,error_data_lx,beam_lx\n";
    let mut out = match input.quantity {
        Quantity::Illuminance => names.to_owned(),
        Quantity::DaylightFactor => names.replace("_lx", "_percent"),
    };
    for (k, c) in input.cells.iter().enumerate() {
        let [x, y, z] = input.position(k);
        let _ = writeln!(
            out,
            "{x:.4},{y:.4},{z:.4},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4}",
            c.total, c.error, c.direct, c.inter, c.data_error, c.beam
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniformity_is_least_over_mean_with_both_errors() {
        let cell = |total, error| CellValue { total, error, ..CellValue::default() };
        let (mean, ratio) = uniformity(&[cell(100.0, 2.0), cell(300.0, 6.0)]).unwrap();
        assert_eq!((mean.value, mean.error), (200.0, 4.0));
        assert!((ratio.value - 0.5).abs() < 1e-12 && (ratio.error - (0.5 * 0.02 + 0.01)).abs() < 1e-12);
        assert!(uniformity(&[]).is_none() && uniformity(&[cell(0.0, 0.0)]).is_none());
    }
}
