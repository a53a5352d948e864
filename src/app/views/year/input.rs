//! What the year tile draws, and what it is asked for.

use crate::app::paint::tile::Status;
use crate::drawing::hour_map::HourMap;
use crate::study::year::{Day, Look, Row, Year};
use std::path::{Path, PathBuf};

/// What the user did.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Compute the year, or compute it anew.
    Compute,
    /// Stop computing it.
    Stop,
    /// Look at something else of it.
    Look(Look),
    /// Show a step everywhere; `true`: on a walk by keys.
    Show(usize, bool),
    /// Take another year of weather.
    Weather(PathBuf),
    /// Ask for a weather file.
    Open,
}

/// A year, as it is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// Hour by hour.
    pub year: &'a Year,
    /// Its hours as they are looked at.
    pub map: &'a HourMap,
    /// Its figures.
    pub rows: &'a [Row],
    /// The lamps on the day that is looked at; `None` without lamps.
    pub day: Option<&'a Day>,
    /// Energy by month and its error; `None` without lamps. \[kWh/m²\]
    pub months: Option<&'a [(f64, f64); 12]>,
    /// The step of the scene's moment.
    pub now: Option<usize>,
    /// Remark on the state of that step, or nothing.
    pub remark: &'a str,
}

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The year; `None` before it was computed.
    pub shown: Option<Shown<'a>>,
    /// How it is looked at.
    pub look: Look,
    /// The scene's month, 1 … 12.
    pub month: u8,
    /// What lights the room.
    pub name: &'a str,
    /// The weather that the year is of, or would be of.
    pub weather: &'a Path,
    /// Share done of the year that is being computed; `None` while none is.
    pub running: Option<f32>,
    /// Why there is no year, or no newer one.
    pub error: Option<&'a str>,
    /// Changes with year and map.
    pub revision: u64,
    /// How far it is to be trusted.
    pub status: Status<'a>,
}
