//! What is to be said of a comparison in words: what was measured, where it tells nothing, and where effort does not help.
//! The command line and the window say the same.

use super::{Accuracy, Errors, Origin, Quantity, Reference, Rung, Series};
use crate::texts::{decimal, words as texts};

/// A relative error in per cent, three digits behind the point where there are that many.
pub fn percent(relative: f64) -> String {
    let percent = 100.0 * relative;
    decimal(if percent == 0.0 || percent >= 1e-3 { format!("{percent:.3} %") } else { format!("{percent:.0e} %") })
}

/// A relative error in per cent, two significant digits.
fn short(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent > 0.0 && percent < 1e-2 {
        return decimal(format!("{percent:.1e} %"));
    }
    let digits = if percent > 0.0 { (1.0 - percent.log10().floor()).max(0.0) as usize } else { 0 };
    decimal(format!("{percent:.digits$} %"))
}

/// The word for a quantity in tables.
pub fn quantity(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Direct => texts::DIRECT.get(),
        Quantity::Total => texts::TOTAL.get(),
    }
}

/// What kind of error a reference tells.
pub fn kind(reference: &Reference) -> String {
    match &reference.origin {
        Origin::FinestRun { .. } => texts::KIND_FINEST.into(),
        Origin::Given(name) => texts::kind_given(name),
    }
}

/// The same for an axis that shows all series.
pub fn axis(accuracy: &Accuracy) -> &'static str {
    let given = |reference: &Reference| matches!(reference.origin, Origin::Given(_));
    match accuracy.references.iter().filter(|reference| given(reference)).count() {
        0 => texts::AXIS_FINEST,
        n if n == accuracy.references.len() => texts::AXIS_TRUE,
        _ => texts::AXIS_REFERENCE,
    }
    .get()
}

/// What a reference is, and how good.
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

/// Why a computation has no error beside this reference; `None` where it has one.
pub fn untold(rung: &Rung, reference: &Reference) -> Option<String> {
    if rung.is_told() {
        return None;
    }
    let Errors { stated, real, open } = rung.typical();
    let [open, stated, apart] = [open, stated, real].map(short);
    Some(match &reference.origin {
        Origin::FinestRun { .. } => texts::untold_finest(open, stated, apart),
        Origin::Given(name) => texts::untold_given(name, open, stated, apart),
    })
}

/// From which effort on more does not help, since the data leave more open than the computation.
pub fn data_limit(series: &Series) -> Option<String> {
    let first = series.rungs.iter().position(Rung::is_limited_by_data)?;
    let rung = &series.rungs[first];
    let (data, own) = (short(rung.data), short(rung.numerical));
    Some(match first {
        0 => texts::effort_enough(data, own),
        _ => texts::effort_enough_from(&rung.setting, data, own),
    })
}
