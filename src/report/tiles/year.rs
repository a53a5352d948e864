//! Year tile: map of the hours of a year, or energy for electric lighting over a sunny day and by month.

use crate::drawing::chart;
use crate::drawing::colours::Inks;
use crate::drawing::plot::{Axis, Plot, Unit};
use crate::drawing::{Align, Drawing, Frame, Shape, TEXT};
use crate::study::moment;
use crate::study::scene_words;
use crate::study::subject::Subject;
use crate::study::year::{Annual, Look, Page, day, day_plot, day_words, map, months, sunniest, title};
use crate::texts::{fixed, year as texts};

pub(super) fn year(drawing: &mut Drawing, frame: Frame, subject: &Subject, inks: &Inks) -> Result<String, String> {
    let (annual, look) = subject.year.as_ref().ok_or(texts::NO_YEAR)?;
    if look.page == Page::Lighting {
        return lamps(drawing, frame, subject, (annual, look), inks);
    }
    let map = map(&annual.year, look);
    let mark = annual.now(&subject.file).and_then(|step| {
        let step = &annual.year.steps.list[step];
        let minute = 60 * u16::from(step.time.hour().unsigned_abs()) + u16::from(step.time.minute().unsigned_abs());
        map.cell(step.month, step.time.day().unsigned_abs(), minute)
    });
    map.draw(drawing, frame, mark, inks);
    let mut parts = vec![title(look.shows), scene_words::station(&annual.year.steps.station)];
    parts.extend(mark.map(|cell| texts::cell_is(map.when(cell), map.words(cell))));
    Ok(parts.join(" · "))
}

fn lamps(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    (annual, look): (&Annual, &Look),
    inks: &Inks,
) -> Result<String, String> {
    let energies = months(annual).ok_or(texts::NO_LAMPS)?;
    let month = look.month.or_else(|| moment::of(&subject.file).map(|time| time.month().unsigned_abs())).unwrap_or(6);
    let date = sunniest(&annual.year, month).ok_or(texts::NO_SUCH_DAY)?;
    let day = day(&annual.year, date).ok_or(texts::NO_SUCH_DAY)?;
    let installed = annual.year.settings.lamps.as_ref().map_or(0.0, |lamps| lamps.power);
    let [left, right] = frame.split(0.55);
    let head = |drawing: &mut Drawing, frame: Frame, text: String| {
        let at = [frame.left + 40.0, frame.top + 8.0];
        drawing.add(Shape::words(at, text, inks.weak, TEXT, Align::Start));
    };
    head(drawing, left, day_words(&day));
    let plot = day_plot(&day, installed);
    chart::panel(drawing, left.inside([0.0, 18.0, 8.0, 0.0]), &plot, inks);
    let most = energies.iter().map(|(energy, error)| energy + error).fold(1e-6, f64::max);
    let plot = Plot {
        x: Axis::linear([0.0, 365.0], "", Unit::Days),
        y: Axis::linear([0.0, 1.08 * most], texts::LIGHTING_ENERGY, Unit::Named("kWh/m²")),
        series: Vec::new(),
        guides: Vec::new(),
    };
    let panel = chart::panel(drawing, right.inside([0.0, 18.0, 8.0, 0.0]), &plot, inks);
    for (k, (energy, error)) in energies.iter().enumerate() {
        let month = 365.0 / 12.0;
        let (from, to) = (k as f64 * month + 3.0, (k + 1) as f64 * month - 3.0);
        let [[x, top], [end, bottom]] = [panel.place([from, *energy]), panel.place([to, 0.0])];
        drawing.add(Shape::area(Frame::new(x, top, end - x, bottom - top).corners(), inks.series[0]));
        let middle = 0.5 * (x + end);
        let ends = [energy - error, energy + error].map(|value| panel.place([0.0, value.max(0.0)])[1]);
        drawing.add(Shape::line([[middle, ends[0]], [middle, ends[1]]], inks.ink, 1.0));
    }
    let sum = |of: fn(&(f64, f64)) -> f64| energies.iter().map(of).sum::<f64>();
    Ok(texts::lighting_summary(day_words(&day), fixed(sum(|one| one.0), 2), fixed(sum(|one| one.1), 2)))
}
