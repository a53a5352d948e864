//! The window of the program, composed of its features.

use super::catalogue::Products;
use super::catalogue::built_in::BuiltIn;
use super::catalogue::gallery::Gallery;
use super::compare::columns::Columns;
use super::export::Export;
use super::goniophotometer::Goniophotometer;
use super::import::Imports;
use super::palette::Palette;
use super::rank::Ranking;
use super::results::{Computations, DataForms, Examined};
use super::session::Session;
use super::shell::Shell;
use super::state::{Sheet, State};
use super::tour::Tour;
use super::views::{accuracy, calendar, section, states};
use super::year::CalendarRequest;
use crate::app::display::font_search::FontSearch;

/// Window of the program. Each feature owns its state; all work on the shell.
pub struct App {
    /// State and services that all features share.
    pub shell: Shell,
    /// Products of the catalogue as this session changes them.
    pub products: Products,
    /// Data of built-in products, computed in advance.
    pub(super) built_in: BuiltIn,
    /// Pictures of products for the gallery.
    pub gallery: Gallery,
    /// Imports of files.
    pub imports: Imports,
    /// Virtual goniophotometer.
    pub goniophotometer: Goniophotometer,
    /// Computations that are due or were requested.
    pub(super) computations: Computations,
    /// Data that the BTDF tile shows.
    pub(super) forms: DataForms,
    /// Cache of findings of the data check, by content of the dataset.
    pub(super) examined: Examined,
    /// Annual simulation, except its result.
    pub(super) year: CalendarRequest,
    /// Rankings, except the results shown.
    pub(super) ranking: Ranking,
    /// Candidates of the comparison, with their results.
    pub compare: Columns,
    /// Exports.
    pub export: Export,
    /// Session on disk, and reports on internal errors.
    pub(super) session: Session,
    /// Rows of the command palette.
    pub palette: Palette,
    /// Tour.
    pub tour: Tour,
    /// Search for fonts.
    pub fonts: FontSearch,
    /// State of the plot of error against computing time.
    pub(super) accuracy_view: accuracy::State,
    /// State of the section through a described system.
    pub(super) section_view: section::State,
    /// State of the strip of a product's states.
    pub(super) states_view: states::State,
    /// State of the calendar of weather data.
    pub(super) weather_view: calendar::State,
    /// Whether a widget had the keyboard focus at the end of the last frame.
    pub(super) in_field: bool,
    /// Whether fonts and themes have been set in egui.
    pub(super) installed: bool,
    /// Title that the window currently has.
    pub(super) shown_title: String,
    /// Side panel and command palette that are open, with their first frames.
    pub(super) opened: Opened,
}

/// Side panel and command palette, with the number of the frame in which each was opened or closed: keys of that frame
/// must not be executed by it.
#[derive(Default)]
pub(super) struct Opened {
    sheet: (Option<Sheet>, u64),
    palette: (bool, u64),
}

impl Opened {
    /// Records the state of a frame, given by its number. Returns whether the side panel has changed.
    pub(super) fn take(&mut self, state: &State, frame: u64) -> bool {
        let palette = state.palette.is_some();
        if self.palette.0 != palette {
            self.palette = (palette, frame);
        }
        let another = self.sheet.0 != state.sheet;
        if another {
            self.sheet = (state.sheet, frame);
        }
        another
    }

    /// Whether the side panel has not changed in this frame.
    pub(super) const fn sheet_before(&self, frame: u64) -> bool {
        self.sheet.1 < frame
    }

    /// Whether the command palette has not changed in this frame.
    pub(super) const fn palette_before(&self, frame: u64) -> bool {
        self.palette.1 < frame
    }
}
