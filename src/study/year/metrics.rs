//! Table of the annual metrics. Their keys are stable, shares are 0 … 1.
//!
//! A new metric is one entry here; its value comes from the figures in `compute::year`. Its row in the table of
//! figures, its key in JSON, its use as an objective and in accuracy series follow from the entry.

use super::metric::{
    Metric, Need,
    Quantity::{self, Counts, List, Met, Number, Word},
    Scale,
    Section::{self, Light, Lighting, Provision, Sun},
    Source,
    Subject::{Level, Observer},
    SumOver,
};
use super::{Solar, SolarFigures, Year};
use crate::compute::year::autonomy::{Autonomy, Exposure};
use crate::compute::year::blinds::Blinds;
use crate::compute::year::glare::{Glare, LIMITS};
use crate::compute::year::lighting::Energy;
use crate::compute::year::probability::Probability;
use crate::compute::year::provision::{self, LEVELS};
use crate::compute::year::solar::Transmitted;
use crate::texts::{Text, fixed, year as say};

/// Approximate number of hours per year at full power of electric lighting without daylight: ten hours on 250 days.
/// \[h\]
const FULL_HOURS: f64 = 2500.0;

/// All annual metrics, in the order of the table of figures.
pub(super) const METRICS: &[Metric] = &[
    Metric::new("hours", "h", |from, _| hours(from, from.figures.steps)),
    Metric::new("occupied_hours", "h", |from, _| hours(from, from.figures.occupied)),
    Metric::new("lit_hours", "h", |from, _| hours(from, from.figures.lit)),
    Metric::new("DA300", "%", |from, _| sensors(from, |one| &one.da_300))
        .label(say::DA_300)
        .row(Light, say::DA_TIP)
        .sum(occupied(|lux| one_if(lux >= 300.0)))
        .objective(|_| Some(Scale::more(0.2, 0.9)))
        .compared(),
    Metric::new("DA500", "%", |from, _| sensors(from, |one| &one.da_500))
        .label(say::DA_500)
        .row(Light, say::DA_TIP)
        .sum(occupied(|lux| one_if(lux >= 500.0)))
        .objective(|_| Some(Scale::more(0.1, 0.8))),
    Metric::new("cDA300", "%", |from, _| sensors(from, |one| &one.cda_300))
        .label(say::CDA_300)
        .row(Light, say::CDA_TIP)
        .sum(occupied(|lux| (lux / 300.0).min(1.0)))
        .objective(|_| Some(Scale::more(0.3, 0.95))),
    Metric::new("sDA300_50", "%", |from, _| Some(Number(from.figures.autonomy.sda_300_50)))
        .label(say::SDA)
        .row(Light, say::SDA_TIP)
        .compliance(|values| say::sda_limit(verdict(values, |value| value >= 0.55)))
        .objective(|_| Some(Scale::more(0.0, 1.0)))
        .compared(),
    Metric::new("sDA300_50_LM83_12", "%", |from, _| blinds(from, |one| Number(one.sda_300_50)))
        .label(say::SDA_LM83)
        .row(Light, say::SDA_LM83_TIP)
        .compliance(|values| say::sda_limit(verdict(values, |value| value >= 0.55)))
        .needs(&[Need::Lm83])
        .compared(),
    Metric::new("blinds_closed_hours", "h", |from, _| blinds(from, |one| List(one.closed_hours.clone())))
        .needs(&[Need::Lm83]),
    Metric::new("UDI_n", "%", |from, _| sensors(from, |one| &one.udi_n))
        .label(say::UDI_N)
        .row(Light, say::UDI_TIP)
        .sum(occupied(|lux| one_if(lux < 100.0)))
        .objective(|_| Some(Scale::less(0.4, 0.0))),
    Metric::new("UDI_s", "%", |from, _| sensors(from, |one| &one.udi_s))
        .label(say::UDI_S)
        .row(Light, say::UDI_TIP)
        .sum(occupied(|lux| one_if((100.0..300.0).contains(&lux)))),
    Metric::new("UDI_a", "%", |from, _| sensors(from, |one| &one.udi_a))
        .label(say::UDI_A)
        .row(Light, say::UDI_TIP)
        .sum(occupied(|lux| one_if((300.0..=3000.0).contains(&lux))))
        .objective(|_| Some(Scale::more(0.2, 0.9)))
        .compared(),
    Metric::new("UDI_x", "%", |from, _| sensors(from, |one| &one.udi_x))
        .label(say::UDI_X)
        .row(Light, say::UDI_TIP)
        .sum(occupied(|lux| one_if(lux > 3000.0)))
        .objective(|_| Some(Scale::less(0.4, 0.0))),
    Metric::new("annual_mean_lx", "lx", |from, _| {
        sensors(from, |one| &one.mean).filter(|_| from.year.settings.unoccupied)
    })
    .label(say::ANNUAL_MEAN)
    .row(Light, say::ANNUAL_MEAN_TIP)
    .sum(SumOver::Sensors { occupied: false, of: |lux| lux })
    .needs(&[Need::Unoccupied])
    .compared(),
    Metric::new("ASE1000_250", "%", |from, _| exposure(from, |one| Number(one.ase_1000_250)))
        .label(say::ASE)
        .row(Sun, say::ASE_TIP)
        .compliance(|values| say::ase_limit(verdict(values, |value| value <= 0.1)))
        .objective(|_| Some(Scale::less(0.5, 0.0).on_request()))
        .needs(&[Need::DirectSun])
        .zero_where(without_direct_sun),
    Metric::new("ASE_hours_1000", "h", |from, _| exposure(from, |one| List(one.ase_hours_1000.clone())))
        .needs(&[Need::DirectSun])
        .zero_where(without_direct_sun),
    Metric::new("sun_hours_1000", "h", |from, _| exposure(from, |one| List(one.hours_1000.clone())))
        .label(say::SUN_HOURS)
        .row(Sun, say::SUN_HOURS_TIP)
        .objective(|_| Some(Scale::less(600.0, 0.0).on_request()))
        .needs(&[Need::DirectSun])
        .zero_where(without_direct_sun),
    Metric::new("EN17037/#/target/area_by_point", "%", |from, k| level(from, k, |one| one.target.area_by_point))
        .of_each(Level)
        .numbered(|k| say::by_point(level_name(k), target(k)))
        .row(Provision, say::BY_POINT_TIP)
        .compliance(|values| at_least(values, 0.5))
        .needs(&[Need::Unoccupied]),
    Metric::new("EN17037/#/minimum/area_by_point", "%", |from, k| level(from, k, |one| one.minimum.area_by_point))
        .of_each(Level)
        .numbered(|k| say::by_point(level_name(k), minimum(k)))
        .row(Provision, say::BY_POINT_TIP)
        .compliance(|values| at_least(values, 0.95))
        .needs(&[Need::Unoccupied]),
    Metric::new("EN17037/#/target/time_by_hour", "%", |from, k| level(from, k, |one| one.target.time_by_hour))
        .of_each(Level)
        .numbered(|k| say::by_hour(level_name(k), target(k), 50))
        .row(Provision, say::BY_HOUR_TIP)
        .compliance(|values| at_least(values, 0.5))
        .needs(&[Need::Unoccupied]),
    Metric::new("EN17037/#/minimum/time_by_hour", "%", |from, k| level(from, k, |one| one.minimum.time_by_hour))
        .of_each(Level)
        .numbered(|k| say::by_hour(level_name(k), minimum(k), 95))
        .row(Provision, say::BY_HOUR_TIP)
        .compliance(|values| at_least(values, 0.5))
        .needs(&[Need::Unoccupied]),
    Metric::new("EN17037/#/met_by_point", "", |from, k| Some(Met(provision(from)?.levels[k].met_by_point())))
        .of_each(Level)
        .needs(&[Need::Unoccupied]),
    Metric::new("EN17037/#/met_by_hour", "", |from, k| Some(Met(provision(from)?.levels[k].met_by_hour())))
        .of_each(Level)
        .needs(&[Need::Unoccupied]),
    Metric::new("EN17037/median_diffuse_lx", "lx", |from, _| Some(Number(provision(from)?.median_diffuse)))
        .label(say::MEDIAN_DIFFUSE)
        .row(Provision, say::MEDIAN_DIFFUSE_TIP)
        .needs(&[Need::Unoccupied]),
    Metric::new("glare/Ev_#/DGPs_5pct", "DGPs", |from, eye| glare(from, eye, |one| one.dgps_5_percent))
        .of_each(Observer)
        .numbered(|eye| say::dgps_5(eye + 1))
        .row(Section::Glare, say::DGPS_TIP)
        .compliance(glare_class)
        .needs(&[Need::DirectSun]),
    Metric::new("glare/Ev_#/share_above_0.35", "%", |from, eye| glare(from, eye, |one| one.above[0]))
        .of_each(Observer)
        .numbered(|eye| say::dgps_above(eye + 1, fixed(LIMITS[0], 2)))
        .row(Section::Glare, say::DGPS_ABOVE_TIP)
        .needs(&[Need::DirectSun]),
    Metric::new("glare/Ev_#/share_above_0.40", "%", |from, eye| glare(from, eye, |one| one.above[1]))
        .of_each(Observer)
        .numbered(|eye| say::dgps_above(eye + 1, fixed(LIMITS[1], 2)))
        .row(Section::Glare, say::DGPS_ABOVE_TIP)
        .objective(|_| Some(Scale::less(0.3, 0.0)))
        .needs(&[Need::DirectSun]),
    Metric::new("glare/Ev_#/share_above_0.45", "%", |from, eye| glare(from, eye, |one| one.above[2]))
        .of_each(Observer)
        .numbered(|eye| say::dgps_above(eye + 1, fixed(LIMITS[2], 2)))
        .row(Section::Glare, say::DGPS_ABOVE_TIP)
        .needs(&[Need::DirectSun]),
    Metric::new("glare/Ev_#/sun_at_eye_hours", "h", |from, eye| hours(from, from.figures.glare[eye].sun_at_eye))
        .of_each(Observer)
        .numbered(|eye| say::sun_at_eye(eye + 1))
        .row(Section::Glare, say::SUN_AT_EYE_TIP)
        .needs(&[Need::DirectSun]),
    Metric::new("glare/Ev_#/DGP_5pct", "DGP", |from, eye| probability(from, eye, |one| Number(one.dgp_5_percent)))
        .of_each(Observer)
        .numbered(|eye| say::dgp_5(eye + 1))
        .row(Section::Glare, say::DGP_TIP)
        .compliance(glare_class)
        .needs(&[Need::DirectSun, Need::Dgp]),
    Metric::new("glare/Ev_#/DGP_class", "", |from, eye| {
        probability(from, eye, |one| Word(one.class().unwrap_or("none")))
    })
    .of_each(Observer)
    .needs(&[Need::DirectSun, Need::Dgp]),
    Metric::new("glare/Ev_#/DGP_share_above_0.35", "%", |from, eye| probability(from, eye, |one| Number(one.above[0])))
        .of_each(Observer)
        .numbered(|eye| say::dgp_above(eye + 1, fixed(LIMITS[0], 2)))
        .row(Section::Glare, say::DGP_ABOVE_TIP)
        .needs(&[Need::DirectSun, Need::Dgp]),
    Metric::new("glare/Ev_#/DGP_share_above_0.40", "%", |from, eye| probability(from, eye, |one| Number(one.above[1])))
        .of_each(Observer)
        .numbered(|eye| say::dgp_above(eye + 1, fixed(LIMITS[1], 2)))
        .row(Section::Glare, say::DGP_ABOVE_TIP)
        .objective(|year| year.dgp.then(|| Scale::less(0.3, 0.0).on_request()))
        .needs(&[Need::DirectSun, Need::Dgp]),
    Metric::new("glare/Ev_#/DGP_share_above_0.45", "%", |from, eye| probability(from, eye, |one| Number(one.above[2])))
        .of_each(Observer)
        .numbered(|eye| say::dgp_above(eye + 1, fixed(LIMITS[2], 2)))
        .row(Section::Glare, say::DGP_ABOVE_TIP)
        .needs(&[Need::DirectSun, Need::Dgp]),
    Metric::new("movements", "", |from, _| (!from.year.moving.is_empty()).then(|| Counts(from.year.movements.clone())))
        .label(say::MOVEMENTS)
        .objective(|_| Some(Scale::less(1500.0, 0.0)))
        .zero_where(|year| year.moving.is_empty()),
    // The unit LENI is that of a whole year.
    Metric::new("lighting/LENI_kWh_m2", "kWh/m²", |from, _| {
        lighting(from, |one| Number(one.total())).filter(|_| whole(from.year))
    })
    .label(say::LENI)
    .row(Lighting, say::LIGHTING_TIP)
    .sum(SumOver::Lighting { floor: false })
    .objective(|year| {
        let full = year.lighting.as_ref()?.power * FULL_HOURS / 1000.0;
        Some(Scale::less(full.max(1.0), 0.0))
    })
    .compared(),
    Metric::new("lighting/kWh_m2", "kWh/m²", |from, _| {
        lighting(from, |one| Number(one.total())).filter(|_| !whole(from.year))
    })
    .label(say::LIGHTING_ENERGY)
    .row(Lighting, say::LIGHTING_TIP)
    .sum(SumOver::Lighting { floor: false })
    .compared(),
    Metric::new("lighting/kWh", "kWh", |from, _| {
        Some(Number(from.figures.lighting.as_ref()?.total() * from.year.settings.floor))
    })
    .sum(SumOver::Lighting { floor: true }),
    Metric::new("lighting/full_kWh_m2", "kWh/m²", |from, _| lighting(from, |one| Number(one.full)))
        .label(say::LIGHTING_FULL)
        .row(Lighting, say::LIGHTING_FULL_TIP),
    Metric::new("lighting/month_kWh_m2", "kWh/m²", |from, _| lighting(from, |one| List(one.months.to_vec()))),
    Metric::new("solar/kWh", "kWh", |from, _| Some(Number(solar(from)?.1.energy.total()))).needs(&[Need::Solar]),
    Metric::new("solar/kWh_m2", "kWh/m²", |from, _| by_area(from, |one| Number(one.total()))).needs(&[Need::Solar]),
    Metric::new("solar/kWh_m2_floor", "kWh/m²", |from, _| {
        let (solar, figures) = solar(from)?;
        Some(Number(figures.energy.total() / solar.floor))
    })
    .needs(&[Need::Solar]),
    Metric::new("solar/month_kWh_m2", "kWh/m²", |from, _| by_area(from, |one| List(one.months.to_vec())))
        .needs(&[Need::Solar]),
    Metric::new("solar/hour_kWh_m2", "kWh/m²", |from, _| by_area(from, |one| List(one.hours.to_vec())))
        .needs(&[Need::Solar]),
    Metric::new("solar/summer_kWh_m2", "kWh/m²", |from, _| by_area(from, |one| Number(one.summer())))
        .label(say::SUMMER_SOLAR)
        .objective(|year| year.solar.then(|| Scale::less(200.0, 0.0).on_request()))
        .needs(&[Need::Solar]),
    Metric::new("solar/winter_kWh_m2", "kWh/m²", |from, _| by_area(from, |one| Number(one.winter())))
        .needs(&[Need::Solar]),
    Metric::new("solar/source", "", |from, _| Some(Word(solar(from)?.0.source().words()))).needs(&[Need::Solar]),
    Metric::new("solar/meaning", "", |from, _| {
        solar(from).map(|_| Word("directly transmitted, secondary heat left out"))
    })
    .needs(&[Need::Solar]),
];

fn hours(from: &Source<'_>, steps: usize) -> Option<Quantity> {
    Some(Number(steps as f64 * from.year.steps.length))
}

fn sensors(from: &Source<'_>, of: fn(&Autonomy) -> &Vec<f64>) -> Option<Quantity> {
    Some(List(of(&from.figures.autonomy).clone()))
}

fn blinds(from: &Source<'_>, of: fn(&Blinds) -> Quantity) -> Option<Quantity> {
    from.figures.blinds.as_ref().map(of)
}

fn exposure(from: &Source<'_>, of: fn(&Exposure) -> Quantity) -> Option<Quantity> {
    from.figures.exposure.as_ref().map(of)
}

fn provision<'a>(from: &Source<'a>) -> Option<&'a provision::Provision> {
    from.figures.provision.as_ref()
}

fn level(from: &Source<'_>, level: usize, of: fn(&provision::Level) -> f64) -> Option<Quantity> {
    Some(Number(of(&provision(from)?.levels[level])))
}

fn glare(from: &Source<'_>, eye: usize, of: fn(&Glare) -> f64) -> Option<Quantity> {
    Some(Number(of(from.figures.glare.get(eye)?)))
}

fn probability(from: &Source<'_>, eye: usize, of: fn(&Probability) -> Quantity) -> Option<Quantity> {
    from.figures.probability.get(eye).map(of)
}

fn lighting(from: &Source<'_>, of: fn(&Energy) -> Quantity) -> Option<Quantity> {
    from.figures.lighting.as_ref().map(of)
}

fn solar<'a>(from: &Source<'a>) -> Option<(&'a Solar, &'a SolarFigures)> {
    from.year.solar.as_ref().zip(from.figures.solar.as_ref())
}

/// Returns a figure of the transmitted solar energy, which `of` selects, per area of all apertures. \[kWh/m²\]
fn by_area(from: &Source<'_>, of: fn(&Transmitted) -> Quantity) -> Option<Quantity> {
    let (solar, figures) = solar(from)?;
    Some(of(&figures.energy.scaled(1.0 / solar.area())))
}

/// Whether all steps of a whole year were computed.
fn whole(year: &Year) -> bool {
    year.steps.whole && year.chosen.len() == year.steps.list.len()
}

/// Whether a whole year was computed in which nothing transmits direct sun unscattered.
fn without_direct_sun(year: &Year) -> bool {
    year.steps.whole && !year.direct_sun
}

fn one_if(yes: bool) -> f64 {
    f64::from(u8::from(yes))
}

/// Returns the mean of a function of the illuminance \[lx\] over sensors and occupied steps.
const fn occupied(of: fn(f64) -> f64) -> SumOver {
    SumOver::Sensors { occupied: true, of }
}

fn level_name(level: usize) -> Text {
    [say::LEVEL_MINIMUM, say::LEVEL_MEDIUM, say::LEVEL_HIGH][level]
}

fn target(level: usize) -> String {
    fixed(LEVELS[level].1, 0)
}

fn minimum(level: usize) -> String {
    fixed(LEVELS[level].2, 0)
}

/// Returns a text that says whether a requirement is met, or that the uncertainty does not decide it. `values`: value
/// as computed, with less and with more light; `met`: whether a value meets the requirement.
fn verdict(values: [f64; 3], met: impl Fn(f64) -> bool) -> Text {
    match values.map(met) {
        [true, true, true] => say::MET,
        [false, false, false] => say::NOT_MET,
        _ => say::OPEN,
    }
}

fn at_least(values: [f64; 3], least: f64) -> String {
    say::at_least(fixed(100.0 * least, 0), verdict(values, |value| value >= least))
}

/// Returns the level of glare protection of EN 17037 as text. `values`: DGP exceeded in 5 % of the time, as computed,
/// with less and with more light.
fn glare_class(values: [f64; 3]) -> String {
    let words = [say::CLASS_HIGH, say::CLASS_MEDIUM, say::CLASS_MINIMUM, say::CLASS_NONE];
    let [own, less, more] = values.map(|value| LIMITS.iter().filter(|limit| value > **limit).count());
    if less == more { words[own].to_string() } else { say::OPEN.to_string() }
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
        assert_eq!(glare_class([0.36, 0.355, 0.40]), say::CLASS_MEDIUM.to_string());
        assert_eq!(glare_class([0.36, 0.34, 0.37]), say::OPEN.to_string());
    }

    #[test]
    fn keys_name_the_limits_of_glare() {
        for limit in LIMITS {
            for key in [format!("glare.Ev_1.share_above_{limit:.2}"), format!("glare.Ev_1.DGP_share_above_{limit:.2}")]
            {
                assert!(super::super::metric(&key).is_some(), "{key}");
            }
        }
    }
}
