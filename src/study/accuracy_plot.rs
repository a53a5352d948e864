//! Plots of [`accuracy`](super::accuracy): error against computing time of every method, and stated against actual
//! error of every sensor. Window, SVG and PNG draw the same numbers, and name the reference. Computations whose errors
//! the reference cannot determine are left out.

use super::accuracy::{Accuracy, Quantity, Rung, Series, words};
use crate::drawing::plot::{Axis, Form, Guide, Plot, Series as Points, Unit};
use crate::texts::words as texts;

/// Maximum number of dots of one series in the plot of stated against actual errors.
const MOST_DOTS: usize = 400;

/// Returns the name of a series for the legend.
pub fn name(series: &Series) -> String {
    match series.quantity {
        Quantity::Direct => series.method.to_owned(),
        Quantity::Total => texts::WITH_INTERREFLECTION.into(),
    }
}

/// Returns both plots: RMS error against computing time of a new sky, and stated against actual error of each sensor.
pub fn plots(accuracy: &Accuracy) -> [Plot; 2] {
    let rungs = || accuracy.series.iter().flat_map(determined);
    let found = words::axis(accuracy);
    let both = || rungs().flat_map(|rung| rung.errors.iter().flat_map(|e| [e.stated, e.real]));
    let stated = Axis::decades(both(), 9, texts::AXIS_STATED.get(), Unit::Share);
    let [first, last] = stated.range;
    let front = Plot {
        x: Axis::decades(rungs().map(|rung| rung.sky), 9, texts::AXIS_TIME.get(), Unit::Seconds),
        y: Axis::decades(rungs().map(Rung::rms), 9, &texts::rms(found), Unit::Share),
        series: accuracy.series.iter().map(front).collect(),
        guides: Vec::new(),
    };
    let honesty = Plot {
        x: Axis { name: found.to_owned(), ..stated.clone() },
        y: stated,
        series: accuracy.series.iter().map(dots).collect(),
        // The statement holds above this line.
        guides: vec![Guide { name: String::new(), ends: [[first; 2], [last; 2]] }],
    };
    [front, honesty]
}

/// Returns the computations whose errors the reference can determine.
fn determined(series: &Series) -> impl Iterator<Item = &Rung> {
    series.rungs.iter().filter(|rung| rung.is_determined())
}

/// Returns a mark for each effort: computing time of a new sky \[s\], and RMS of the actual relative errors.
fn front(series: &Series) -> Points {
    let points = determined(series).map(|rung| [rung.sky, rung.rms()]);
    Points { form: Form::Marked, ..Points::line(name(series), points) }
}

/// Returns a dot for each sensor and effort, thinned at regular intervals: actual relative error along x, stated one
/// along y.
fn dots(series: &Series) -> Points {
    let count: usize = determined(series).map(|rung| rung.errors.len()).sum();
    let every = count.div_ceil(MOST_DOTS).max(1);
    let errors = determined(series).flat_map(|rung| &rung.errors).step_by(every);
    Points { form: Form::Dots, ..Points::line(name(series), errors.map(|e| [e.real, e.stated])) }
}
