//! What is to be said of a comparison in words: what was measured, where it tells nothing, and where effort does not help.
//! The command line and the window say the same.

use super::{Accuracy, Errors, Origin, Quantity, Reference, Rung, Series};

/// A relative error in per cent, three digits behind the point where there are that many.
pub fn percent(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent == 0.0 || percent >= 1e-3 { format!("{percent:.3} %") } else { format!("{percent:.0e} %") }
}

/// A relative error in per cent, two significant digits.
fn short(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent > 0.0 && percent < 1e-2 {
        return format!("{percent:.1e} %");
    }
    let digits = if percent > 0.0 { (1.0 - percent.log10().floor()).max(0.0) as usize } else { 0 };
    format!("{percent:.digits$} %")
}

/// The word for a quantity in tables.
pub fn quantity(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Direct => "direct",
        Quantity::Total => "total",
    }
}

/// What kind of error a reference tells.
pub fn kind(reference: &Reference) -> String {
    match &reference.origin {
        Origin::FinestRun { .. } => "numerical error against this method's finest run".to_owned(),
        Origin::Given(name) => format!("true error against {name}"),
    }
}

/// The same for an axis that shows all series.
pub fn axis(accuracy: &Accuracy) -> &'static str {
    let given = |reference: &Reference| matches!(reference.origin, Origin::Given(_));
    match accuracy.references.iter().filter(|reference| given(reference)).count() {
        0 => "error to finest run",
        n if n == accuracy.references.len() => "true error",
        _ => "error to reference",
    }
}

/// What a reference is, and how good.
pub fn reference(reference: &Reference) -> String {
    let (what, stated) = (quantity(reference.quantity), percent(reference.stated));
    match &reference.origin {
        Origin::FinestRun { target, rms, max } => format!(
            "Reference of the {what} illuminance: the ordinary method's finest run, error target {}, states {stated}; from \
             the second finest it lies {} RMS, {} at most. What the method or the data leave out is not seen so.",
            percent(*target),
            percent(*rms),
            percent(*max),
        ),
        Origin::Given(name) => {
            format!("Reference of the {what} illuminance: {name}, by its own statement good to {stated} or better.")
        }
    }
}

/// Why a computation has no error beside this reference; `None` where it has one.
pub fn untold(rung: &Rung, reference: &Reference) -> Option<String> {
    if rung.is_told() {
        return None;
    }
    let Errors { stated, real, open } = rung.typical();
    let [open, stated, apart] = [open, stated, real].map(short);
    Some(match &reference.origin {
        Origin::FinestRun { .. } => format!(
            "no error told: the finest run hardly refines this one (it states {open}, this one {stated}, they differ by {apart})"
        ),
        Origin::Given(name) => {
            format!("no error told: {name} is itself open by {open}, this run states {stated}, they differ by {apart}")
        }
    })
}

/// From which effort on more does not help, since the data leave more open than the computation.
pub fn data_limit(series: &Series) -> Option<String> {
    let first = series.rungs.iter().position(Rung::is_limited_by_data)?;
    let rung = &series.rungs[first];
    let from = if first == 0 { String::new() } else { format!(" than {}", rung.setting) };
    Some(format!(
        "more effort{from} does not help: the data leave ± {} open, the computation ± {}",
        short(rung.data),
        short(rung.numerical)
    ))
}
