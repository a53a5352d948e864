//! All commands of the window in one enum. Drawing returns them, [`super::apply`] is the only place that acts on them,
//! and [`super::offer`] lists those that menu, palette and keys offer.

use super::arrange::Arrange;
use super::catalogue_command::CatalogueCommand;
use super::choose::ChooseAct;
use super::compare::Act;
use super::export_choices::Choices;
use super::goniophotometer::Setup;
use super::import::{ImportFields, StateWords};
use super::import_steps::Step;
use super::jobs::Lane;
use super::language::LanguageChoice;
use super::outside;
use super::room_look::{RoomLook, RoomView};
use super::shelf::Query;
use super::state::{PathUse, Sheet, Tile};
use super::text_size::TextSize;
use super::theme::ThemeChoice;
use super::tour::TourAct;
use super::year::YearAct;
use crate::catalogue::Grouping;
use crate::compute::direction::Incident;
use crate::compute::doctor::Repair;
use crate::study::data_form::DataForm;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use std::path::PathBuf;

/// Name of the field in which a system file is typed.
pub const SYSTEM_EDITOR: &str = "system file";

/// Command of the window.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Ask for files to open.
    Open,
    /// Ask where to save the scene.
    SaveScene,
    /// Export the LID.
    ExportLid,
    /// Export a tile, as a picture or as numbers.
    ExportTile(Tile),
    /// Set the choices of the export: content, format and options.
    ExportChoices(Box<Choices>),
    /// Ask for folder and name of the export.
    BrowseExport,
    /// Copy a tile's numbers to the clipboard.
    CopyTile(Tile),
    /// Copy a tile as a picture to the clipboard.
    CopyPicture(Tile),
    /// Copy the line under the tile that the pointer was on last to the clipboard.
    CopyValue,
    /// Set the incident direction that tiles draw for; `None`: that of the sun.
    Incidence(Option<Incident>),
    /// Set the form in which the BTDF tile shows the data.
    DataForm(DataForm),
    /// Show or hide the map of interpolation schemes between the directions of the data.
    SchemeMap,
    /// Set the control rule that picks the state.
    Control(ControlMode),
    /// Set the control rule with all its keys.
    ControlKeys(Box<ControlKeys>),
    /// Show and edit the control rule of one aperture (from 0), or of the scene if `None`.
    ControlOf(Option<usize>),
    /// Close the window.
    Quit,
    /// Undo one step.
    Undo,
    /// Redo one step.
    Redo,
    /// Put the cursor into the search field.
    Search,
    /// Note that the field of the opened sheet has the keyboard.
    KeyboardTaken,
    /// Open or close the command palette.
    Palette,
    /// Fill the tile area with a tile, or show all.
    Maximise(Option<Tile>),
    /// Arrange the tiles.
    Arrange(Arrange),
    /// Set how the room is drawn.
    RoomLook(RoomLook),
    /// Set the view of the room.
    RoomView(RoomView),
    /// Move the scene's clock. \[h\]
    Hour(i32),
    /// Move the scene's date. \[d\]
    Day(i32),
    /// Select the next (+1) or previous (−1) state.
    NextState(i32),
    /// Show or hide the left panel.
    ToggleCatalogue,
    /// Show or hide the right panel.
    ToggleScene,
    /// Set the theme: light, dark, or that of the desktop.
    Theme(ThemeChoice),
    /// Set larger or smaller text.
    TextSize(TextSize),
    /// Start or leave the tour.
    Tour(TourAct),
    /// Set the language.
    Language(LanguageChoice),
    /// Reset the scene to that of a first start.
    ResetScene,
    /// Open or close a sheet.
    Sheet(Option<Sheet>),
    /// Cancel the job of a lane.
    Cancel(Lane),
    /// Select a product, with its own control rule or in its representative state.
    Select(String),
    /// Select a state.
    SelectState(String),
    /// Move the keyboard's row in the list, and select its product.
    Row(i32),
    /// Replace the scene.
    Scene(Box<SceneFile>),
    /// Act on the annual simulation or the weather.
    Year(YearAct),
    /// Act on the ranking.
    Choose(ChooseAct),
    /// Add, duplicate or remove an obstruction.
    Outside(outside::Act),
    /// Compute the effect of every obstruction on the apertures' illuminance.
    WeighObstructions,
    /// Search the catalogue.
    Find(Query),
    /// Set or remove a star.
    Favourite(String, bool),
    /// Read files.
    OpenPaths(Vec<PathBuf>),
    /// Write to a path, and overwrite an existing file.
    Write(PathUse, PathBuf),
    /// Write to a path, but ask first if the file exists.
    WriteNew(PathUse, PathBuf),
    /// Keep the existing file, so that another name can be typed.
    KeepFile,
    /// Edit the path that is being typed.
    EditPath(String),
    /// Edit the text of the palette.
    EditPalette(String),
    /// Select the row of the palette that Enter activates.
    PaletteRow(usize),
    /// Fill in what a product of an import lacks (its number from 0).
    EditImport(usize, Box<ImportFields>),
    /// Group the imported files into products in another way.
    GroupImport(Grouping),
    /// Store a product of an import although it is in the catalogue, or not.
    AddAnyway(usize, bool),
    /// Try a repair on an imported product.
    Repair(usize, Repair),
    /// Undo the last repair of an imported product.
    UndoRepair(usize),
    /// Store the imported products.
    AddImport,
    /// Discard the import.
    DiscardImport,
    /// Discard a draft of an import.
    DiscardDraft(usize),
    /// Continue a draft of an import.
    OpenDraft(usize),
    /// Keep the import as a draft.
    KeepDraft,
    /// Act on the table of the import.
    Import(Step),
    /// Run the current scene with rising effort by every method.
    MeasureAccuracy,
    /// Fill the goniophotometer's sheet with an example.
    SystemExample(usize),
    /// Edit the text of the system file.
    EditSystem(String),
    /// Set the bases and the accuracy of the virtual goniophotometer.
    SystemSetup(Setup),
    /// Draw this state of the described system.
    DrawState(usize),
    /// Compute all states of the described system; a stopped run resumes.
    MeasureSystem,
    /// Store the computed states.
    AddMeasured,
    /// Ask where to write the computed states.
    ExportMeasured,
    /// Open the catalogue again after a failure.
    RetryCatalogue,
    /// Edit the texts of the product with this key; of the selected one if `None`.
    EditProduct(Option<String>),
    /// Set the texts of a product, as typed.
    EditWords(Box<ImportFields>),
    /// Set name and angle of a state of the product (its number from 0), as typed.
    EditState(usize, StateWords),
    /// Store the texts that were typed for the product.
    SaveWords,
    /// Ask for a file that replaces the data of a state of the product.
    ReplaceState(String),
    /// Read the files of the product again, and show what changed.
    Reread,
    /// Apply the changes found by reading the files again.
    TakeChanges,
    /// Read the folders of packages that are subscribed to.
    SyncSubscribed,
    /// Ask for a folder to open.
    OpenFolder,
    /// Delete the product with this key, restorable; the selected one if `None`.
    DeleteProduct(Option<String>),
    /// Restore a deleted product.
    RestoreProduct(String),
    /// Hide a message; all if `None`.
    Dismiss(Option<u64>),
    /// Remove all messages.
    ForgetMessages,
    /// Copy the report on a fault to the clipboard.
    CopyReport(PathBuf),
    /// Act on the product list.
    Catalogue(CatalogueCommand),
    /// Act on the comparison.
    Compare(Act),
    /// List products that are optically similar to this one; to the selected one if `None`.
    Like(Option<String>),
}

impl Command {
    /// Whether the change of the document is an undo step of its own. Changes by dragging, or by a key that is held,
    /// are not.
    pub const fn is_step(&self) -> bool {
        match self {
            Self::Year(act) => act.is_step(),
            Self::Choose(act) => act.is_step(),
            other => matches!(other, Self::ResetScene | Self::Compare(_) | Self::Outside(_)),
        }
    }
}
