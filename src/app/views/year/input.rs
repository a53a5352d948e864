//! Input and actions of the year tile.

use crate::app::paint::tile::Status;
use crate::drawing::hour_map::HourMap;
use crate::study::year::{Day, Look, Row, Year};
use std::path::{Path, PathBuf};

/// Action of the user.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Request to compute the year, or to compute it again.
    Compute,
    /// Request to stop computing the year.
    Stop,
    /// New settings of the view.
    Look(Look),
    /// Choice of a step that all tiles show; `true`: it was reached by arrow keys.
    Show(usize, bool),
    /// Choice of another year of weather.
    Weather(PathBuf),
    /// Request to choose a weather file.
    Open,
}

/// Year as it is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// Result of the annual simulation, hour by hour.
    pub year: &'a Year,
    /// Map of the hours, by the settings of the view.
    pub map: &'a HourMap,
    /// Figures of the year.
    pub rows: &'a [Row],
    /// Electric lighting on the day that is shown; `None` without electric lighting.
    pub day: Option<&'a Day>,
    /// Lighting energy by month and its error; `None` without electric lighting. \[kWh/m²\]
    pub months: Option<&'a [(f64, f64); 12]>,
    /// Step of the scene's moment.
    pub now: Option<usize>,
    /// Remark on the state of that step; empty without one.
    pub remark: &'a str,
}

/// Input of the tile.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Year; `None` before it was computed.
    pub shown: Option<Shown<'a>>,
    /// Settings of the view.
    pub look: Look,
    /// Month of the scene, 1 … 12.
    pub month: u8,
    /// Name of the system that lights the room.
    pub name: &'a str,
    /// Weather that the year is of, or would be of.
    pub weather: &'a Path,
    /// Share done of the year that is being computed; `None` while none is.
    pub running: Option<f32>,
    /// Error because of which there is no year, or no newer one.
    pub error: Option<&'a str>,
    /// Number that changes with year and map.
    pub revision: u64,
    /// Status of the content: preliminary, outdated or complete.
    pub status: Status<'a>,
}
