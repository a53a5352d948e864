//! All commands of the window in one enum. Drawing functions return them, [`super::apply`] executes them, and
//! [`super::offer`] lists those in menus, command palette and keyboard shortcuts.

use super::compare::view::Act;
use super::goniophotometer::run::Setup;
use super::import::proposal::{ImportFields, StateWords};
use super::import::step::Step;
use super::rank::board::ChooseAct;
use super::state::{PathUse, Sheet, Tile};
use super::tour::step::TourAct;
use super::year::input::YearAct;
use crate::app::catalogue::command::CatalogueCommand;
use crate::app::catalogue::shelf::Query;
use crate::app::display::language::LanguageChoice;
use crate::app::display::text_size::TextSize;
use crate::app::display::theme::ThemeChoice;
use crate::app::export::choices::Choices;
use crate::app::scene::outside;
use crate::app::scene::room_look::{RoomLook, RoomView};
use crate::app::shell::jobs::Lane;
use crate::app::tiles::arrange::Arrange;
use crate::catalogue::Grouping;
use crate::compute::direction::Incident;
use crate::compute::doctor::Repair;
use crate::study::data_form::DataForm;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use std::path::PathBuf;

/// Name of the text field in which a system file is typed.
pub const SYSTEM_EDITOR: &str = "system file";

/// Command of the window.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Ask for files to open.
    Open,
    /// Ask where to save the scene.
    SaveScene,
    /// Export the LID of the first aperture as a luminaire file.
    ExportLid,
    /// Export a tile, as a picture or as numbers.
    ExportTile(Tile),
    /// Set the choices of the export dialog: content, format and options.
    ExportChoices(Box<Choices>),
    /// Ask for folder and name of the export.
    BrowseExport,
    /// Copy the numbers of a tile to the clipboard as a table.
    CopyTile(Tile),
    /// Copy a tile as a picture to the clipboard.
    CopyPicture(Tile),
    /// Copy the value line under the tile that was last under the pointer to the clipboard.
    CopyValue,
    /// Set the incident direction for which tiles show the light distribution; `None`: that of the sun.
    Incidence(Option<Incident>),
    /// Set which data the BTDF tile shows: original, filtered or compressed.
    DataForm(DataForm),
    /// Show or hide the map of interpolation schemes between the incident directions of the data.
    SchemeMap,
    /// Set the mode of shading control, by which the state is chosen.
    Control(ControlMode),
    /// Set the shading control with all its parameters.
    ControlKeys(Box<ControlKeys>),
    /// Show and edit the shading control of one aperture (counted from 0), or that of the scene if `None`.
    ControlOf(Option<usize>),
    /// Close the window.
    Quit,
    /// Undo one step.
    Undo,
    /// Redo one step.
    Redo,
    /// Put the cursor into the search field.
    Search,
    /// Record that the text field of the opened sheet has received the keyboard focus.
    KeyboardTaken,
    /// Open or close the command palette.
    Palette,
    /// Maximise a tile over the tile area, or show all tiles if `None`.
    Maximise(Option<Tile>),
    /// Arrange the tiles.
    Arrange(Arrange),
    /// Set the display settings of the room tile.
    RoomLook(RoomLook),
    /// Set the view of the room tile: plan, section or perspective.
    RoomView(RoomView),
    /// Change the time of the scene by this number of hours. \[h\]
    Hour(i32),
    /// Change the date of the scene by this number of days. \[d\]
    Day(i32),
    /// Select the next (+1) or previous (−1) state of the product.
    NextState(i32),
    /// Show or hide the catalogue panel at the left.
    ToggleCatalogue,
    /// Show or hide the scene panel at the right.
    ToggleScene,
    /// Set the theme: light, dark, or that of the desktop.
    Theme(ThemeChoice),
    /// Set a larger or smaller text size.
    TextSize(TextSize),
    /// Set the maximum memory of stored results. \[MB\]
    StoreLimit(usize),
    /// Remove all stored results; they are computed again when they are needed.
    ClearStore,
    /// Start or leave the tour.
    Tour(TourAct),
    /// Set the language.
    Language(LanguageChoice),
    /// Reset the scene to that of the first start.
    ResetScene,
    /// Open a sheet (side panel), or close it if `None`.
    Sheet(Option<Sheet>),
    /// Cancel the running job of a lane.
    Cancel(Lane),
    /// Select the product with this key, with the control rule that it defines or in its representative state.
    Select(String),
    /// Select the state with this key.
    SelectState(String),
    /// Move the keyboard focus in the product list by this number of rows, and select the product there.
    Row(i32),
    /// Replace the scene.
    Scene(Box<SceneFile>),
    /// Command about the annual simulation or the weather.
    Year(YearAct),
    /// Command about the ranking.
    Choose(ChooseAct),
    /// Add, duplicate or remove an obstruction.
    Outside(outside::Act),
    /// Compute the effect of every obstruction on the illuminance of the apertures.
    WeighObstructions,
    /// Search the catalogue.
    Find(Query),
    /// Set (`true`) or remove the star of the product with this key.
    Favourite(String, bool),
    /// Read these files and folders.
    OpenPaths(Vec<PathBuf>),
    /// Write to a path, and overwrite an existing file.
    Write(PathUse, PathBuf),
    /// Write to a path, but ask the user first if the file exists.
    WriteNew(PathUse, PathBuf),
    /// Leave the existing file unchanged, so that another name can be typed.
    KeepFile,
    /// Set the text of the path field.
    EditPath(String),
    /// Set the text of the command palette.
    EditPalette(String),
    /// Select the row of the command palette that Enter activates, counted from 0.
    PaletteRow(usize),
    /// Set the texts of a product of the import, given by its number (from 0).
    EditImport(usize, Box<ImportFields>),
    /// Change the grouping of the imported files into products.
    GroupImport(Grouping),
    /// Set whether a product of the import (number from 0) is stored although its data are in the catalogue already.
    AddAnyway(usize, bool),
    /// Apply a repair to a product of the import (number from 0), undoable.
    Repair(usize, Repair),
    /// Undo the last repair of a product of the import (number from 0).
    UndoRepair(usize),
    /// Store the products of the import in the catalogue.
    AddImport,
    /// Discard the open import.
    DiscardImport,
    /// Discard a draft of an import, given by its number (from 0).
    DiscardDraft(usize),
    /// Continue a draft of an import, given by its number (from 0).
    OpenDraft(usize),
    /// Store the open import as a draft.
    KeepDraft,
    /// Command about the table of the import.
    Import(Step),
    /// Compute error against computing time: run the current scene with rising effort by every method.
    MeasureAccuracy,
    /// Load an example, given by its number (from 0), into the sheet of the virtual goniophotometer.
    SystemExample(usize),
    /// Set the text of the system file in the sheet of the virtual goniophotometer.
    EditSystem(String),
    /// Set the bases and the accuracy of the virtual goniophotometer.
    SystemSetup(Setup),
    /// Draw the section of this state (number from 0) of the described system.
    DrawState(usize),
    /// Compute all states of the described system; a stopped run resumes.
    MeasureSystem,
    /// Store the states computed by the virtual goniophotometer in the catalogue.
    AddMeasured,
    /// Ask for a path to which the states computed by the virtual goniophotometer are written.
    ExportMeasured,
    /// Open the catalogue again after a failure.
    RetryCatalogue,
    /// Open the sheet for editing the product with this key, or the selected one if `None`.
    EditProduct(Option<String>),
    /// Set the texts of the edited product, as typed.
    EditWords(Box<ImportFields>),
    /// Set name and angle of a state (number from 0) of the edited product, as typed.
    EditState(usize, StateWords),
    /// Store the typed texts of the edited product in the catalogue.
    SaveWords,
    /// Ask for a file that replaces the data of the state with this key of the edited product.
    ReplaceState(String),
    /// Read the files of the edited product again, and show the differences.
    Reread,
    /// Apply the differences found by reading the files again.
    TakeChanges,
    /// Read the subscribed folders of packages again.
    SyncSubscribed,
    /// Ask for a folder to open.
    OpenFolder,
    /// Delete the product with this key, restorable; the selected one if `None`.
    DeleteProduct(Option<String>),
    /// Restore a deleted product.
    RestoreProduct(String),
    /// Hide the message with this number; all messages if `None`.
    Dismiss(Option<u64>),
    /// Remove all messages.
    ForgetMessages,
    /// Copy the report on an internal error, stored at this path, to the clipboard.
    CopyReport(PathBuf),
    /// Command about the product list.
    Catalogue(CatalogueCommand),
    /// Command about the comparison.
    Compare(Act),
    /// List products that are optically similar to the product with this key, or to the selected one if `None`.
    Like(Option<String>),
}

impl Command {
    /// Whether the command's change of the document is a separate undo step. Changes by dragging, or by a key that is
    /// held down, are not.
    pub const fn is_step(&self) -> bool {
        match self {
            Self::Year(act) => act.is_step(),
            Self::Choose(act) => act.is_step(),
            other => matches!(other, Self::ResetScene | Self::Compare(_) | Self::Outside(_)),
        }
    }
}
