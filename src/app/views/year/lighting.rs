//! Plots of the electric lighting: its power over the sunniest day of a month, and its energy by month, as in IEA SHC
//! Task 31 report (2005), figure 18.

use super::input::Shown;
use super::parts::weak;
use crate::app::paint::palette::Palette;
use crate::app::paint::plot::{self, Look};
use crate::app::paint::tile;
use crate::drawing::plot::{Axis, Plot, Unit};
use crate::drawing::ticks::number;
use crate::study::year::{Day, Year, day_plot, day_words};
use crate::texts::{fixed, words::MONTHS, year as say};
use egui::{Align2, Rect, Ui, vec2};
use egui_plot::{Bar, BarChart};
use std::fmt::Write as _;

/// First days of the months of a common year, counted from 0, and the end of the year. \[d\]
const FIRST: [f64; 13] = [0.0, 31.0, 59.0, 90.0, 120.0, 151.0, 181.0, 212.0, 243.0, 273.0, 304.0, 334.0, 365.0];

/// Draws the plots of the electric lighting over a day and by month. Returns the line under them.
pub(super) fn show(ui: &mut Ui, rect: Rect, shown: &Shown<'_>) -> String {
    let Some(months) = shown.months else {
        weak(ui, say::NO_LAMPS.get());
        return String::new();
    };
    let Some(day) = shown.day else {
        by_month(ui, rect, months, shown.year);
        return say::NO_SUCH_DAY.into();
    };
    let (left, right) = if rect.width() > 1.2 * rect.height() {
        rect.split_left_right_at_fraction(0.55)
    } else {
        rect.split_top_bottom_at_fraction(0.55)
    };
    let installed = shown.year.settings.lamps.as_ref().map_or(0.0, |lamps| lamps.power);
    let text = over_day(ui, left, day, installed);
    by_month(ui, right, months, shown.year);
    text.unwrap_or_else(|| {
        let total: f64 = months.iter().map(|(energy, _)| energy).sum();
        let error: f64 = months.iter().map(|(_, error)| error).sum();
        say::lighting_summary(day_words(day), fixed(total, 2), fixed(error, 2))
    })
}

fn clock(hour: f64) -> String {
    let minutes = (60.0 * hour).round() as u32;
    format!("{:02}:{:02}", minutes / 60, minutes % 60)
}

/// Draws the power of the electric lighting over a day; `installed`: installed power \[W/m²\]. Returns the line for the
/// time under the pointer.
fn over_day(ui: &mut Ui, rect: Rect, day: &Day, installed: f64) -> Option<String> {
    let palette = Palette::of(ui.visuals());
    let (head, body) = rect.split_top_bottom_at_y(rect.top() + 18.0);
    tile::caption(ui, head.left_top() + vec2(4.0, 1.0), Align2::LEFT_TOP, &day_words(day));
    // Half of the last hour's name stands beside the plot.
    let body = body.with_max_x(body.right() - 8.0);
    let plot = day_plot(day, installed);
    let colours = [palette.first];
    let drawn = plot::show(ui, body, &plot, &Look::tile(ui.scope_id().with("day"), &colours, palette.sun), |_| {});
    let sum: f64 = day.spans.iter().zip(&day.watts).map(|([begin, end], watts)| (end - begin) * watts).sum();
    tile::name(ui, &drawn.response, say::DAY_PLOT, &say::day_energy(day_words(day), fixed(sum, 1)));
    let [hour, _] = drawn.pointed()?;
    let step = day.spans.iter().position(|[begin, end]| (*begin..*end).contains(&hour))?;
    let [begin, end] = day.spans[step].map(clock);
    let [low, high] = day.between[step].map(|watts| number(watts, 3));
    Some(say::power_at(begin, end, number(day.watts[step], 3), low, high))
}

/// Draws the energy of the electric lighting by month as bars, from values and errors \[kWh/m²\].
fn by_month(ui: &mut Ui, rect: Rect, months: &[(f64, f64); 12], year: &Year) {
    let palette = Palette::of(ui.visuals());
    let most = months.iter().map(|(energy, error)| energy + error).fold(1e-6, f64::max);
    let plot = Plot {
        x: Axis::linear([0.0, 365.0], "", Unit::Days),
        y: Axis::linear([0.0, 1.08 * most], say::LIGHTING_ENERGY, Unit::Named("kWh/m²")),
        series: Vec::new(),
        guides: Vec::new(),
    };
    let total: f64 = months.iter().map(|(energy, _)| energy).sum();
    let bars = months.iter().enumerate().map(|(k, (energy, error))| {
        let words = say::month_energy(MONTHS[k], fixed(*energy, 3), fixed(*error, 3));
        Bar::new(0.5 * (FIRST[k] + FIRST[k + 1]), *energy).width(24.0).name(words)
    });
    let chart = BarChart::new(say::LIGHTING_ENERGY.get(), bars.collect()).color(palette.first);
    let colours = [palette.first];
    let look = Look::tile(ui.scope_id().with("months"), &colours, palette.sun);
    let drawn = plot::show(ui, rect, &plot, &look, |plot_ui| plot_ui.bar_chart(chart));
    let whole = if year.steps.whole { say::OF_YEAR } else { say::OF_PART };
    tile::name(ui, &drawn.response, say::MONTH_PLOT, &say::energy_of(fixed(total, 2), whole));
}

/// Returns the power of the electric lighting for every step of the day \[W/m²\], then the energy of every month
/// \[kWh/m²\], as CSV.
pub(super) fn csv(shown: &Shown<'_>) -> String {
    let mut out = String::from("from,to,value,low,high,unit\n");
    // Writing to a String cannot fail.
    if let Some(day) = shown.day {
        for (([begin, end], watts), [low, high]) in day.spans.iter().zip(&day.watts).zip(&day.between) {
            let at = |hour: f64| format!("{}T{}", day.date, clock(hour));
            let _ = writeln!(out, "{},{},{watts},{low},{high},W/m²", at(*begin), at(*end));
        }
    }
    for (k, (energy, error)) in shown.months.into_iter().flatten().enumerate() {
        let _ = writeln!(out, "{0},{0},{energy},{1},{2},kWh/m²", k + 1, (energy - error).max(0.0), energy + error);
    }
    out
}
