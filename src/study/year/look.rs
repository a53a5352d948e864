//! Settings with which a year is displayed: page, and quantity of the map of hours.

use serde::{Deserialize, Serialize};

/// Quantity that a map of hours displays. Sensors, observers and moving apertures are given by index, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shows {
    /// Mean illuminance of all sensors.
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

/// Page of a year that is displayed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Page {
    /// Map of the hours of the year.
    #[default]
    Map,
    /// Annual figures with their errors.
    Figures,
    /// Power of the electric lighting over a day and by month.
    Lighting,
}

/// Settings with which a year is displayed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Look {
    /// Displayed page.
    pub page: Page,
    /// Quantity that the map of hours displays.
    pub shows: Shows,
    /// Whether the colour scale of illuminances is logarithmic.
    pub log: bool,
    /// Month whose sunniest day is displayed, 1 … 12; `None`: month of the scene's date.
    pub month: Option<u8>,
}
