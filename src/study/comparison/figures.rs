//! Figures by which candidates are compared: definition, unit, error, and whether larger or smaller values are better.
//!
//! Errors of illuminances and flux are those that the study states. Figures of the BSDF data have the error that the
//! data state ([`stated_error`]); measured data state none, and none is invented for them.

use crate::catalogue::{light, stated_error};
use crate::compute::btdf::{Dataset, LightFigures};
use crate::compute::estimate::Estimate;
use crate::compute::lid::c_gamma::Peaks;
use crate::drawing::ticks::number;
use crate::texts::{Text, compare as texts, fixed};

/// Value of a figure with its absolute error, both in the figure's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    /// Value of the figure.
    pub value: f64,
    /// Absolute error; `None` if it is not stated.
    pub error: Option<f64>,
}

impl From<Estimate> for Value {
    fn from(Estimate { value, error }: Estimate) -> Self {
        Self { value, error: Some(error) }
    }
}

impl Value {
    /// Formats the value with its error; the error has two digits, and the value ends at the same digit.
    pub fn words(self) -> String {
        let Self { value, error } = self;
        match error.filter(|error| *error > 0.0 && error.is_finite()) {
            Some(error) => {
                let decimals = (1 - error.log10().floor() as i32).clamp(0, 6) as usize;
                format!("{} ± {}", fixed(value, decimals), fixed(error, decimals))
            }
            None => number(value, 4),
        }
    }
}

/// Whether larger or smaller values of a figure are better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// Larger values are better.
    More,
    /// Smaller values are better.
    Less,
    /// Neither is better by itself: it depends on the aim of the design.
    Aim,
}

impl Sense {
    /// Returns the key in files; it does not change with the label.
    pub const fn key(self) -> &'static str {
        match self {
            Self::More => "more is better",
            Self::Less => "less is better",
            Self::Aim => "a matter of aim",
        }
    }

    /// Returns the translated label.
    pub const fn words(self) -> Text {
        match self {
            Self::More => texts::MORE,
            Self::Less => texts::FEWER,
            Self::Aim => texts::AIM,
        }
    }
}

/// Figures of a system's BSDF data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DataFacts {
    /// Visible transmittance τ at normal incidence, 0 … 1.
    pub tau_normal: f64,
    /// Visible hemispherical transmittance τ, 0 … 1.
    pub tau_hemispherical: f64,
    /// Figures of the distribution of transmitted light: share to the ceiling, sun blocked, normal–normal
    /// transmittance.
    pub light: LightFigures,
    /// Absolute error of the transmittances; `None` if the data do not state it.
    pub error: Option<f64>,
}

impl DataFacts {
    /// Returns the figures of a dataset; `None` if it has no transmission.
    pub fn of(dataset: &Dataset) -> Option<Self> {
        let transmission = dataset.transmission()?;
        Some(Self {
            tau_normal: transmission.tau_normal(),
            tau_hemispherical: transmission.tau_hemispherical(),
            light: light(transmission, dataset.described.as_ref()),
            error: stated_error(dataset),
        })
    }
}

/// Luminous flux and intensities of an aperture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LidFacts {
    /// Luminous flux into the room. \[lm\]
    pub flux: Estimate,
    /// Largest luminous intensities of the distribution, with their directions; `None` if there are none.
    pub peaks: Option<Peaks>,
}

/// Computed results of a candidate; `None` for those that were not computed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facts {
    /// Figures of the BSDF data of the first aperture's system.
    pub data: Option<DataFacts>,
    /// Luminous flux and intensities of the first aperture.
    pub lid: Option<LidFacts>,
    /// Illuminances at the sensors. \[lx\]
    pub room: Option<Vec<Estimate>>,
}

/// Definition of a figure by which candidates are compared.
#[derive(Debug, Clone, Copy)]
pub struct Figure {
    /// Key of the figure in CSV files.
    pub key: &'static str,
    /// Label of the figure, in sentence case.
    pub name: Text,
    /// Unit; empty for shares of one.
    pub unit: &'static str,
    /// Whether larger or smaller values are better.
    pub sense: Sense,
    /// Definition of the figure, and why larger or smaller values are better.
    pub tip: Text,
    /// Function that computes the figure from a candidate's results; `None` if these are not sufficient.
    pub of: fn(&Facts) -> Option<Value>,
}

impl Figure {
    /// Returns the name of the figure in JSON files; it does not change with the label.
    pub fn json_name(&self) -> &'static str {
        match self.key {
            "tau_normal" => "τ normal",
            "tau_hemispherical" => "τ hemispherical",
            "to_ceiling" => "Light to the ceiling",
            "sun_blocked" => "Sun blocked",
            "view" => "View",
            "flux" => "Luminous flux",
            "peak_scattered" => "Scattered peak of the LID",
            "mean" => "Mean illuminance",
            "least" => "Darkest sensor",
            "greatest" => "Brightest sensor",
            "uniformity" => "Uniformity",
            "share_300" => "Sensors with 300 lx",
            key => key,
        }
    }
}

/// Target illuminance of EN 17037 that half of the room should reach. \[lx\]
const TARGET: f64 = 300.0;

fn data(facts: &Facts, of: impl FnOnce(&DataFacts) -> f64) -> Option<Value> {
    facts.data.as_ref().map(|data| Value { value: of(data), error: data.error })
}

fn ceiling(facts: &Facts) -> Option<Value> {
    let data = facts.data.as_ref()?;
    // The figure is a share of transmitted light: numerator and denominator may each have the error of a transmittance.
    let error = data.error.map(|error| 2.0 * error / data.tau_hemispherical.max(error));
    Some(Value { value: data.light.to_ceiling?, error: error.map(|error| if error.is_finite() { error } else { 0.0 }) })
}

fn room(facts: &Facts, of: impl FnOnce(&[Estimate]) -> Estimate) -> Option<Value> {
    facts.room.as_deref().filter(|room| !room.is_empty()).map(|room| of(room).into())
}

fn mean(room: &[Estimate]) -> Estimate {
    // Errors add: nothing is known of their independence.
    room.iter().copied().sum::<Estimate>() * (1.0 / room.len() as f64)
}

/// Returns the smallest of the illuminances (with `sign` −1 the largest), with its uncertainty. \[lx\]
fn least(room: &[Estimate], sign: f64) -> Estimate {
    let of = |shift: f64| room.iter().map(|one| sign * one.value + shift * one.error).fold(f64::INFINITY, f64::min);
    let (value, low, high) = (of(0.0), of(-1.0), of(1.0));
    Estimate::new(sign * value, (value - low).max(high - value))
}

fn uniformity(room: &[Estimate]) -> Estimate {
    let (least, mean) = (least(room, 1.0), mean(room));
    if mean.value <= 0.0 {
        return Estimate::exact(0.0);
    }
    let value = least.value / mean.value;
    Estimate::new(value, (least.error + value * mean.error) / mean.value)
}

fn lit(room: &[Estimate]) -> Estimate {
    let share = |shift: f64| {
        room.iter().filter(|one| one.value + shift * one.error >= TARGET).count() as f64 / room.len() as f64
    };
    let value = share(0.0);
    Estimate::new(value, (value - share(-1.0)).max(share(1.0) - value))
}

/// All figures, in the order of tables.
pub const FIGURES: &[Figure] = &[
    Figure {
        key: "tau_normal",
        name: texts::TAU_NORMAL,
        unit: "",
        sense: Sense::Aim,
        tip: texts::TAU_NORMAL_TIP,
        of: |facts| data(facts, |data| data.tau_normal),
    },
    Figure {
        key: "tau_hemispherical",
        name: texts::TAU_HEMISPHERICAL,
        unit: "",
        sense: Sense::Aim,
        tip: texts::TAU_HEMISPHERICAL_TIP,
        of: |facts| data(facts, |data| data.tau_hemispherical),
    },
    Figure {
        key: "to_ceiling",
        name: texts::TO_CEILING,
        unit: "",
        sense: Sense::More,
        tip: texts::TO_CEILING_TIP,
        of: ceiling,
    },
    Figure {
        key: "sun_blocked",
        name: texts::SUN_BLOCKED,
        unit: "",
        sense: Sense::More,
        tip: texts::SUN_BLOCKED_TIP,
        of: |facts| data(facts, |data| data.light.sun_blocked),
    },
    Figure {
        key: "view",
        name: texts::VIEW,
        unit: "",
        sense: Sense::More,
        tip: texts::VIEW_TIP,
        of: |facts| data(facts, |data| data.light.view),
    },
    Figure {
        key: "flux",
        name: texts::FLUX,
        unit: "lm",
        sense: Sense::Aim,
        tip: texts::FLUX_TIP,
        of: |facts| facts.lid.as_ref().map(|lid| lid.flux.into()),
    },
    Figure {
        key: "peak_scattered",
        name: texts::PEAK,
        unit: "cd",
        sense: Sense::Aim,
        tip: texts::PEAK_TIP,
        of: |facts| {
            let peak = facts.lid.as_ref()?.peaks?.scattered?;
            Some(Value { value: peak.intensity, error: None })
        },
    },
    Figure {
        key: "mean",
        name: texts::MEAN,
        unit: "lx",
        sense: Sense::Aim,
        tip: texts::MEAN_TIP,
        of: |facts| room(facts, mean),
    },
    Figure {
        key: "least",
        name: texts::LEAST,
        unit: "lx",
        sense: Sense::More,
        tip: texts::LEAST_TIP,
        of: |facts| room(facts, |room| least(room, 1.0)),
    },
    Figure {
        key: "greatest",
        name: texts::GREATEST,
        unit: "lx",
        sense: Sense::Aim,
        tip: texts::GREATEST_TIP,
        of: |facts| room(facts, |room| least(room, -1.0)),
    },
    Figure {
        key: "uniformity",
        name: texts::UNIFORMITY,
        unit: "",
        sense: Sense::More,
        tip: texts::UNIFORMITY_TIP,
        of: |facts| room(facts, uniformity),
    },
    Figure {
        key: "share_300",
        name: texts::SHARE_300,
        unit: "",
        sense: Sense::More,
        tip: texts::SHARE_300_TIP,
        of: |facts| room(facts, lit),
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::Btdf;

    fn of(key: &str, facts: &Facts) -> Option<Value> {
        (FIGURES.iter().find(|figure| figure.key == key).unwrap().of)(facts)
    }

    #[test]
    fn figures_of_a_room_reach_as_far_as_their_sensors() {
        let room =
            [(500.0, 5.0), (302.0, 4.0), (290.0, 1.0), (305.0, 1.0)].map(|(value, error)| Estimate::new(value, error));
        let facts = Facts { room: Some(room.to_vec()), ..Facts::default() };
        let is = |key: &str, value: f64, error: f64| {
            let found = of(key, &facts).unwrap();
            assert!(
                (found.value - value).abs() < 1e-9 && (found.error.unwrap() - error).abs() < 1e-9,
                "{key}: {found:?}"
            );
        };
        is("mean", 349.25, 2.75);
        is("least", 290.0, 1.0);
        is("greatest", 500.0, 5.0);
        // One of four may be on either side of 300 lx.
        is("share_300", 0.75, 0.25);
        is("uniformity", 290.0 / 349.25, (1.0 + 290.0 / 349.25 * 2.75) / 349.25);
        assert_eq!(of("flux", &facts), None);
    }

    #[test]
    fn values_are_told_as_far_as_their_errors_reach() {
        let of = |value, error| Value { value, error }.words();
        assert_eq!(
            (of(0.41234, Some(0.003)), of(12_345.6, Some(123.0))),
            ("0.4123 ± 0.0030".into(), "12346 ± 123".into())
        );
        assert_eq!((of(0.5, None), of(0.5, Some(0.0))), ("0.5000".to_owned(), "0.5000".to_owned()));
    }

    #[test]
    fn definitions_are_exact_and_measured_data_state_no_error() {
        let mut dataset = Dataset::default();
        assert_eq!(DataFacts::of(&dataset), None);
        dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(0.6));
        let facts = |dataset: &Dataset| Facts { data: DataFacts::of(dataset), ..Facts::default() };
        let value = of("tau_normal", &facts(&dataset)).unwrap();
        assert!((value.value - 0.6).abs() < 1e-12 && value.error == Some(0.0));
        let ceiling = of("to_ceiling", &facts(&dataset)).unwrap();
        assert!((ceiling.value - 0.5).abs() < 1e-9 && ceiling.error == Some(0.0), "{ceiling:?}");
        let basis = crate::compute::basis::RingBasis::klems_full(crate::compute::basis::AzimuthMap::KLEMS_FRONT);
        let cells = basis.len();
        let matrix = crate::compute::btdf::CellMatrix::new(basis.clone(), basis, vec![0.1; cells * cells]).unwrap();
        dataset.visible.transmission_front = Some(Btdf::from_cells(matrix));
        assert_eq!(of("tau_normal", &facts(&dataset)).unwrap().error, None);
    }
}
