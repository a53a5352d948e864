//! Table of the annual figures with labels: value, error, and compliance with limits.

use super::Annual;
use super::entries::{Entry, metrics};
use super::maps::states;
use super::metric::{Quantity, Section};
use crate::compute::estimate::Estimate;
use crate::texts::{Text, fixed, year as say};

/// Annual figure, as a row of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Section of the table to which the row belongs.
    pub section: Section,
    /// Label of the figure.
    pub name: String,
    /// Definition of the figure in one sentence, with its source.
    pub tip: &'static str,
    /// Value of the figure: a share 0 … 1, or a number in `unit`.
    pub value: f64,
    /// Uncertainty of the value by the errors of the hourly results, in the same unit.
    pub error: f64,
    /// Smallest and largest value of the sensors, if the figure is their mean.
    pub between: Option<[f64; 2]>,
    /// Unit of the figure; `%` for shares.
    pub unit: &'static str,
    /// Text on compliance with limits; empty without limits.
    pub compliance: String,
}

impl Row {
    /// Returns the row for a metric of a year; `None` if the table leaves it out.
    fn of(entry: &Entry) -> Option<Self> {
        let (section, tip) = entry.metric.row?;
        let Estimate { value, error } = entry.estimate()?;
        let between = match &entry.values[0] {
            Quantity::List(list) => Some(list.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], value| {
                [f64::min(lo, *value), f64::max(hi, *value)]
            })),
            _ => None,
        };
        Some(Self {
            section,
            name: entry.metric.name(entry.index),
            tip: tip.get(),
            value,
            error,
            between,
            unit: entry.metric.unit,
            compliance: entry.compliance(),
        })
    }

    fn written(&self, value: f64) -> String {
        match self.unit {
            "%" => fixed(100.0 * value, 1),
            "lx" | "h" | "" => fixed(value, 0),
            "kWh/m²" => fixed(value, 2),
            _ => fixed(value, 3),
        }
    }

    /// Formats value, error and unit, such as `80.6 ± 0.2 %`. Counted figures have no error.
    pub fn value_words(&self) -> String {
        let value = self.written(self.value);
        let error = self.written(self.error);
        let counted = self.section == Section::Control;
        let words = if counted { value } else { format!("{value} ± {error}") };
        format!("{words} {}", self.unit).trim_end().to_owned()
    }

    /// Formats smallest and largest value of the sensors.
    pub fn between_words(&self) -> String {
        self.between.map_or_else(String::new, |ends| ends.map(|end| self.written(end)).join(" – "))
    }
}

/// Returns all annual figures as rows, section by section.
pub fn table(annual: &Annual) -> Vec<Row> {
    let mut list: Vec<Row> = metrics(&annual.year, &annual.figures).iter().filter_map(Row::of).collect();
    list.extend(control(annual));
    list
}

/// Returns the rows on the operation of shading devices: number of state changes, and hours with light in each state.
/// They are counted, so that they have no error.
fn control(annual: &Annual) -> Vec<Row> {
    let year = &annual.year;
    let mut list = Vec::new();
    for (m, one) in year.moving.iter().enumerate() {
        let row = |name: String, tip: Text, unit: &'static str, value: f64| Row {
            section: Section::Control,
            name,
            tip: tip.get(),
            value,
            error: 0.0,
            between: None,
            unit,
            compliance: String::new(),
        };
        list.push(row(say::movements_of(one.aperture), say::MOVEMENTS_TIP, "", year.movements[m] as f64));
        let (ranks, names) = states(&one.device);
        let mut hours = vec![0.0; names.len()];
        for &k in year.chosen.iter().filter(|k| year.steps.list[**k].hour.is_lit()) {
            hours[ranks[year.states[k][m]]] += year.steps.length;
        }
        for (name, hours) in names.iter().zip(hours) {
            list.push(row(say::hours_in_state(one.aperture, name), say::HOURS_IN_STATE_TIP, "h", hours));
        }
    }
    list
}
