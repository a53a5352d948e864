//! How a year is looked at: which of its quantities as a map of hours.

use serde::{Deserialize, Serialize};

/// What a map of hours shows. Sensors, eyes and moving apertures are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shows {
    /// Mean illuminance of the sensors.
    #[default]
    Mean,
    /// Illuminance of one sensor.
    Sensor(usize),
    /// State of a moving aperture.
    State(usize),
    /// Simplified daylight glare probability of an eye.
    Dgps(usize),
    /// Power of the lamps.
    Lighting,
    /// Direct normal illuminance outside.
    DirectNormal,
    /// Diffuse horizontal illuminance outside.
    DiffuseHorizontal,
}

/// What of a year is in sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Page {
    /// Hours of the year.
    #[default]
    Map,
    /// Figures with their errors.
    Figures,
    /// Power of the lamps over a day and by month.
    Lighting,
}

/// How a year is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Look {
    /// Which page.
    pub page: Page,
    /// What the map shows.
    pub shows: Shows,
    /// Illuminances on a logarithmic scale.
    pub log: bool,
    /// The month whose sunniest day is looked at, 1 … 12; `None`: the scene's.
    pub month: Option<u8>,
}
