//! View of a year: page and quantity that a map of hours displays.

use serde::{Deserialize, Serialize};

/// Quantity of a map of hours. Sensors, observers and moving apertures are counted from 0.
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
    /// Simplified daylight glare probability (DGPs) of an observer.
    Dgps(usize),
    /// Power of the electric lighting.
    Lighting,
    /// Direct normal illuminance outside.
    DirectNormal,
    /// Diffuse horizontal illuminance outside.
    DiffuseHorizontal,
}

/// Displayed part of a year.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Page {
    /// Hours of the year.
    #[default]
    Map,
    /// Figures with their errors.
    Figures,
    /// Power of the electric lighting over a day and by month.
    Lighting,
}

/// View of a year.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Look {
    /// Displayed page.
    pub page: Page,
    /// Quantity of the map.
    pub shows: Shows,
    /// Whether illuminances have a logarithmic scale.
    pub log: bool,
    /// Month whose sunniest day is displayed, 1 … 12; `None`: the scene's month.
    pub month: Option<u8>,
}
