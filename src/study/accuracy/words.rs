//! Texts about a comparison of methods: what was compared, where the reference cannot determine errors, and where more
//! effort does not help. Command line and window use the same texts.

use super::{Accuracy, Errors, Origin, Quantity, Reference, Rung, Series};
use crate::texts::{decimal, words as texts};

/// Formats a relative error in per cent, with up to three decimals.
pub fn percent(relative: f64) -> String {
    let percent = 100.0 * relative;
    decimal(if percent == 0.0 || percent >= 1e-3 { format!("{percent:.3} %") } else { format!("{percent:.0e} %") })
}

/// Formats a relative error in per cent, with two significant digits.
fn short(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent > 0.0 && percent < 1e-2 {
        return decimal(format!("{percent:.1e} %"));
    }
    let digits = if percent > 0.0 { (1.0 - percent.log10().floor()).max(0.0) as usize } else { 0 };
    decimal(format!("{percent:.digits$} %"))
}

/// Returns the label of a component of the illuminance in tables.
pub fn quantity(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Direct => texts::DIRECT.get(),
        Quantity::Total => texts::TOTAL.get(),
    }
}

/// Returns the kind of error that a reference determines: against the finest run, or against an external file.
pub fn kind(reference: &Reference) -> String {
    match &reference.origin {
        Origin::FinestRun { .. } => texts::KIND_FINEST.into(),
        Origin::Given(name) => texts::kind_given(name),
    }
}

/// Returns the label of an axis for the errors of all series.
pub fn axis(accuracy: &Accuracy) -> &'static str {
    let given = |reference: &Reference| matches!(reference.origin, Origin::Given(_));
    match accuracy.references.iter().filter(|reference| given(reference)).count() {
        0 => texts::AXIS_FINEST,
        n if n == accuracy.references.len() => texts::AXIS_TRUE,
        _ => texts::AXIS_REFERENCE,
    }
    .get()
}

/// Returns a sentence on a reference and its accuracy.
pub fn reference(reference: &Reference) -> String {
    let stated = percent(reference.stated);
    match (&reference.origin, reference.quantity) {
        (Origin::FinestRun { target, rms, max }, quantity) => {
            let [target, rms, max] = [target, rms, max].map(|share| percent(*share));
            match quantity {
                Quantity::Direct => texts::finest_direct(target, stated, rms, max),
                Quantity::Total => texts::finest_total(target, stated, rms, max),
            }
        }
        (Origin::Given(name), Quantity::Direct) => texts::given_direct(name, stated),
        (Origin::Given(name), Quantity::Total) => texts::given_total(name, stated),
    }
}

/// Returns the reason why this reference cannot determine the error of a computation; `None` if it can.
pub fn undetermined_reason(rung: &Rung, reference: &Reference) -> Option<String> {
    if rung.is_determined() {
        return None;
    }
    let Errors { stated, real, open } = rung.typical();
    let [open, stated, difference] = [open, stated, real].map(short);
    Some(match &reference.origin {
        Origin::FinestRun { .. } => texts::undetermined_finest(open, stated, difference),
        Origin::Given(name) => texts::undetermined_given(name, open, stated, difference),
    })
}

/// Returns a sentence that names the effort above which more does not help, because the uncertainty by the BSDF data
/// exceeds the numerical error; `None` if there is none.
pub fn data_limit(series: &Series) -> Option<String> {
    let first = series.rungs.iter().position(Rung::is_limited_by_data)?;
    let rung = &series.rungs[first];
    let (data, own) = (short(rung.data), short(rung.numerical));
    Some(match first {
        0 => texts::effort_enough(data, own),
        _ => texts::effort_enough_from(&rung.setting, data, own),
    })
}
