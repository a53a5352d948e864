//! Figures of a year as rows with labels: value, error, and compliance with limits.

use super::maps::states;
use super::{Annual, Figures};
use crate::compute::year::glare::LIMITS;
use crate::compute::year::provision::{LEVELS, Level};
use crate::texts::{Text, fixed, year as say};

/// Section of the table that a row belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// Autonomy and useful illuminances.
    Light,
    /// Direct sun on the sensors.
    Sun,
    /// Daylight provision of EN 17037.
    Provision,
    /// Glare at the observers.
    Glare,
    /// Electric lighting.
    Lighting,
    /// Shading operation.
    Control,
}

impl Section {
    /// Returns the label of the section.
    pub const fn words(self) -> Text {
        match self {
            Self::Light => say::SECTION_LIGHT,
            Self::Sun => say::SECTION_SUN,
            Self::Provision => say::SECTION_PROVISION,
            Self::Glare => say::SECTION_GLARE,
            Self::Lighting => say::SECTION_LIGHTING,
            Self::Control => say::SECTION_CONTROL,
        }
    }
}

/// One figure of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Section of the row.
    pub section: Section,
    /// Label of the figure.
    pub name: String,
    /// Definition of the figure in one sentence, with its source.
    pub tip: &'static str,
    /// Value of the figure: shares 0 … 1, else in `unit`.
    pub value: f64,
    /// Uncertainty of the value by the errors of the hours, in the same unit.
    pub error: f64,
    /// Minimum and maximum of the sensors, if the figure is their mean.
    pub between: Option<[f64; 2]>,
    /// Unit of the figure; `%` for shares.
    pub unit: &'static str,
    /// Compliance with limits; empty without limits.
    pub compliance: String,
}

impl Row {
    fn written(&self, value: f64) -> String {
        match self.unit {
            "%" => fixed(100.0 * value, 1),
            "lx" | "h" | "" => fixed(value, 0),
            "kWh/m²" => fixed(value, 2),
            _ => fixed(value, 3),
        }
    }

    /// Formats value, error and unit: `80.6 ± 0.2 %`. Counted figures have no error.
    pub fn value_words(&self) -> String {
        let value = self.written(self.value);
        let error = self.written(self.error);
        let counted = self.section == Section::Control;
        let words = if counted { value } else { format!("{value} ± {error}") };
        format!("{words} {}", self.unit).trim_end().to_owned()
    }

    /// Formats minimum and maximum of the sensors.
    pub fn between_words(&self) -> String {
        self.between.map_or_else(String::new, |ends| ends.map(|end| self.written(end)).join(" – "))
    }
}

/// Returns the larger difference between a value and those with less and with more light.
fn max_difference([own, less, more]: [f64; 3]) -> f64 {
    (less - own).abs().max((more - own).abs())
}

/// Returns whether a limit is met, or that the uncertainty does not decide it.
fn verdict(values: [f64; 3], met: impl Fn(f64) -> bool) -> Text {
    let outcomes = values.map(met);
    match outcomes {
        [true, true, true] => say::MET,
        [false, false, false] => say::NOT_MET,
        _ => say::OPEN,
    }
}

struct Rows<'a> {
    figures: &'a [Figures; 3],
    list: Vec<Row>,
}

impl Rows<'_> {
    fn add(&mut self, section: Section, (name, tip): (impl Into<String>, Text), unit: &'static str, values: [f64; 3]) {
        let (name, tip) = (name.into(), tip.get());
        let row = Row {
            section,
            name,
            tip,
            value: values[0],
            error: max_difference(values),
            between: None,
            unit,
            compliance: String::new(),
        };
        self.list.push(row);
    }

    /// Adds a figure that is the mean of the sensors.
    fn mean(&mut self, section: Section, words: (Text, Text), unit: &'static str, of: impl Fn(&Figures) -> &[f64]) {
        let figures = self.figures;
        let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len().max(1) as f64;
        self.add(section, (words.0, words.1), unit, figures.each_ref().map(|one| mean(of(one))));
        let ends = of(&figures[0])
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], value| [f64::min(lo, *value), f64::max(hi, *value)]);
        if let Some(row) = self.list.last_mut().filter(|_| ends[0] <= ends[1]) {
            row.between = Some(ends);
        }
    }

    fn set_compliance(&mut self, words: impl Into<String>) {
        if let Some(row) = self.list.last_mut() {
            row.compliance = words.into();
        }
    }
}

/// Returns all figures of a year.
pub fn table(annual: &Annual) -> Vec<Row> {
    let mut rows = Rows { figures: &annual.figures, list: Vec::new() };
    light(&mut rows);
    sun(&mut rows);
    provision(&mut rows);
    glare(&mut rows, annual.year.steps.length);
    lighting(&mut rows);
    let mut list = rows.list;
    list.extend(control(annual));
    list
}

fn light(rows: &mut Rows<'_>) {
    let section = Section::Light;
    rows.mean(section, (say::DA_300, say::DA_TIP), "%", |one| &one.autonomy.da_300);
    rows.mean(section, (say::DA_500, say::DA_TIP), "%", |one| &one.autonomy.da_500);
    rows.mean(section, (say::CDA_300, say::CDA_TIP), "%", |one| &one.autonomy.cda_300);
    let values = rows.figures.each_ref().map(|one| one.autonomy.sda_300_50);
    rows.add(section, (say::SDA, say::SDA_TIP), "%", values);
    rows.set_compliance(say::sda_limit(verdict(values, |value| value >= 0.55)));
    if let [Some(own), Some(less), Some(more)] = rows.figures.each_ref().map(|one| one.blinds.as_ref()) {
        let values = [own, less, more].map(|one| one.sda_300_50);
        rows.add(section, (say::SDA_LM83, say::SDA_LM83_TIP), "%", values);
        rows.set_compliance(say::sda_limit(verdict(values, |value| value >= 0.55)));
    }
    rows.mean(section, (say::UDI_N, say::UDI_TIP), "%", |one| &one.autonomy.udi_n);
    rows.mean(section, (say::UDI_S, say::UDI_TIP), "%", |one| &one.autonomy.udi_s);
    rows.mean(section, (say::UDI_A, say::UDI_TIP), "%", |one| &one.autonomy.udi_a);
    rows.mean(section, (say::UDI_X, say::UDI_TIP), "%", |one| &one.autonomy.udi_x);
    rows.mean(section, (say::ANNUAL_MEAN, say::ANNUAL_MEAN_TIP), "lx", |one| &one.autonomy.mean);
}

fn sun(rows: &mut Rows<'_>) {
    let [Some(own), Some(less), Some(more)] = rows.figures.each_ref().map(|one| one.exposure.as_ref()) else { return };
    let values = [own, less, more].map(|one| one.ase_1000_250);
    rows.add(Section::Sun, (say::ASE, say::ASE_TIP), "%", values);
    rows.set_compliance(say::ase_limit(verdict(values, |value| value <= 0.1)));
    rows.mean(Section::Sun, (say::SUN_HOURS, say::SUN_HOURS_TIP), "h", |one| {
        one.exposure.as_ref().map_or(&[][..], |one| &one.hours_1000)
    });
}

fn provision(rows: &mut Rows<'_>) {
    let [Some(own), Some(less), Some(more)] = rows.figures.each_ref().map(|one| one.provision) else { return };
    let all = [own, less, more];
    for (k, (name, target, minimum)) in LEVELS.into_iter().enumerate() {
        let level = |of: fn(&Level) -> f64| all.map(|one| of(&one.levels[k]));
        let name = match name {
            "minimum" => say::LEVEL_MINIMUM,
            "medium" => say::LEVEL_MEDIUM,
            _ => say::LEVEL_HIGH,
        };
        let mut add = |words: String, tip: Text, values: [f64; 3], least: f64| {
            rows.add(Section::Provision, (words, tip), "%", values);
            rows.set_compliance(say::at_least(fixed(100.0 * least, 0), verdict(values, |value| value >= least)));
        };
        let [target, minimum] = [target, minimum].map(|lux| fixed(lux, 0));
        add(say::by_point(name, &target), say::BY_POINT_TIP, level(|one| one.target.area_by_point), 0.5);
        add(say::by_point(name, &minimum), say::BY_POINT_TIP, level(|one| one.minimum.area_by_point), 0.95);
        add(say::by_hour(name, &target, 50), say::BY_HOUR_TIP, level(|one| one.target.time_by_hour), 0.5);
        add(say::by_hour(name, &minimum, 95), say::BY_HOUR_TIP, level(|one| one.minimum.time_by_hour), 0.5);
    }
    rows.add(
        Section::Provision,
        (say::MEDIAN_DIFFUSE, say::MEDIAN_DIFFUSE_TIP),
        "lx",
        all.map(|one| one.median_diffuse),
    );
}

fn glare(rows: &mut Rows<'_>, length: f64) {
    let [own, less, more] = rows.figures.each_ref().map(|one| one.glare.clone());
    for eye in 0..own.len() {
        let of = |value: fn(&crate::compute::year::glare::Glare) -> f64| [&own[eye], &less[eye], &more[eye]].map(value);
        let values = of(|one| one.dgps_5_percent);
        rows.add(Section::Glare, (say::dgps_5(eye + 1), say::DGPS_TIP), "DGPs", values);
        let class = |value: f64| LIMITS.iter().filter(|limit| value > **limit).count();
        let classes = values.map(class);
        let words = [say::CLASS_HIGH, say::CLASS_MEDIUM, say::CLASS_MINIMUM, say::CLASS_NONE];
        rows.set_compliance(if classes[1] == classes[2] {
            words[classes[0]].to_string()
        } else {
            say::OPEN.to_string()
        });
        let above: [fn(&crate::compute::year::glare::Glare) -> f64; 3] =
            [|one| one.above[0], |one| one.above[1], |one| one.above[2]];
        for (limit, share) in LIMITS.into_iter().zip(above) {
            rows.add(Section::Glare, (say::dgps_above(eye + 1, fixed(limit, 2)), say::DGPS_ABOVE_TIP), "%", of(share));
        }
        if own[eye].sun_at_eye > 0 {
            let hours = of(|one| one.sun_at_eye as f64).map(|steps| steps * length);
            rows.add(Section::Glare, (say::sun_at_eye(eye + 1), say::SUN_AT_EYE_TIP), "h", hours);
        }
    }
}

fn lighting(rows: &mut Rows<'_>) {
    let [Some(own), Some(less), Some(more)] = rows.figures.each_ref().map(|one| one.lighting.as_ref()) else { return };
    let unit = "kWh/m²";
    rows.add(
        Section::Lighting,
        (say::LIGHTING_ENERGY, say::LIGHTING_TIP),
        unit,
        [own, less, more].map(|one| one.total()),
    );
    rows.add(Section::Lighting, (say::LIGHTING_FULL, say::LIGHTING_FULL_TIP), unit, [own.full; 3]);
}

/// Returns state changes, and hours with light in each state; they are counted, so without an error.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_within_the_error_is_left_open() {
        let met = |value: f64| value >= 0.55;
        assert_eq!(verdict([0.56, 0.55, 0.6], met), say::MET);
        assert_eq!(verdict([0.56, 0.54, 0.6], met), say::OPEN);
        assert_eq!(verdict([0.5, 0.4, 0.549], met), say::NOT_MET);
        assert!((max_difference([0.5, 0.4, 0.55]) - 0.1).abs() < 1e-15);
    }
}
