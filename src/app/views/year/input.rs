//! Input of the year tile, and the requests of its user.

use crate::app::paint::tile::Status;
use crate::drawing::hour_map::HourMap;
use crate::study::year::{Day, Look, Row, Year};
use std::path::{Path, PathBuf};

/// Request of the user of the year tile.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Request to compute the annual simulation, or to compute it again.
    Compute,
    /// Request to stop the computation.
    Stop,
    /// New display settings of the annual simulation.
    Look(Look),
    /// Choice of a step of the year, by its index, that all tiles are to show, and whether it was reached by arrow keys
    /// (`true`) or a click.
    Show(usize, bool),
    /// Choice of other weather data, by name or path.
    Weather(PathBuf),
    /// Request for the dialog that chooses a weather file.
    Open,
}

/// Annual simulation with everything that the tile draws of it.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// Result of the annual simulation for every step.
    pub year: &'a Year,
    /// Map of hours of the quantity in the display settings.
    pub map: &'a HourMap,
    /// Annual figures.
    pub rows: &'a [Row],
    /// Electric lighting on the day shown; `None` without electric lighting or such a day.
    pub day: Option<&'a Day>,
    /// Energy of electric lighting in each month, and its error \[kWh/m²\]; `None` without electric lighting.
    pub months: Option<&'a [(f64, f64); 12]>,
    /// Index of the step at the scene's date and time; `None` if there is none.
    pub now: Option<usize>,
    /// Remark on weather file and state at that step; empty without one.
    pub remark: &'a str,
}

/// Input of the year tile in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Annual simulation; `None` before it has been computed.
    pub shown: Option<Shown<'a>>,
    /// Display settings of the annual simulation.
    pub look: Look,
    /// Month of the scene, 1 … 12.
    pub month: u8,
    /// Name of the system in the apertures.
    pub name: &'a str,
    /// Name or path of the weather data of the annual simulation, or of the one to be computed.
    pub weather: &'a Path,
    /// Progress of a running annual simulation, 0 … 1; `None` if none is running.
    pub running: Option<f32>,
    /// Error that prevented an annual simulation, or a newer one, as text.
    pub error: Option<&'a str>,
    /// Revision number, which changes whenever result or map do.
    pub revision: u64,
    /// Status of the results shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}
