//! Everything that the window can do: one enum. Drawing returns it, [`super::apply`] is the only place that acts on it,
//! and [`super::offer`] says which of it menu, palette and keys offer.

use super::arrange::Arrange;
use super::choose::ChooseAct;
use super::compare::Act;
use super::goniophotometer::Setup;
use super::hand_on::Choices;
use super::import::{ImportFields, StateWords};
use super::import_steps::Step;
use super::jobs::Lane;
use super::language::LanguageChoice;
use super::outside;
use super::room_look::{RoomLook, RoomView};
use super::shelf::Query;
use super::shelving::Shelving;
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

/// One thing to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Ask for files to open.
    Open,
    /// Ask where to save the scene.
    SaveScene,
    /// Hand the LID on.
    ExportLid,
    /// Hand a tile on, as a picture or as numbers.
    ExportTile(Tile),
    /// What is handed on, and in which form.
    HandOn(Box<Choices>),
    /// Ask for folder and name of what is handed on.
    BrowseHandOn,
    /// A tile's numbers into the clipboard.
    CopyTile(Tile),
    /// A tile as a picture into the clipboard.
    CopyPicture(Tile),
    /// What the line under the tile says that the pointer was on last, into the clipboard.
    CopyValue,
    /// The incidence that tiles draw for; the sun's while `None`.
    Incidence(Option<Incident>),
    /// In which form the BTDF tile shows the data.
    DataForm(DataForm),
    /// Shows or hides how light is interpolated between the directions of the data.
    SchemeMap,
    /// The rule that picks the state.
    Control(ControlMode),
    /// The rule with all its keys.
    ControlKeys(Box<ControlKeys>),
    /// Whose rule is shown and edited: one aperture's (from 0), or the scene's.
    ControlOf(Option<usize>),
    /// Close the window.
    Quit,
    /// Back one step.
    Undo,
    /// Forth one step.
    Redo,
    /// Put the cursor into the search field.
    Search,
    /// The field of the sheet that was opened has the keyboard.
    KeyboardTaken,
    /// Open or close the command palette.
    Palette,
    /// Fill the bench with a tile, or show all.
    Maximise(Option<Tile>),
    /// Arrange the tiles.
    Arrange(Arrange),
    /// How the room is drawn.
    RoomLook(RoomLook),
    /// From where the room is looked at.
    RoomView(RoomView),
    /// Move the scene's clock. \[h\]
    Hour(i32),
    /// Move the scene's date. \[d\]
    Day(i32),
    /// To the next (+1) or previous (−1) state.
    NextState(i32),
    /// Fold the left panel in or out.
    ToggleCatalogue,
    /// Fold the right panel in or out.
    ToggleScene,
    /// Light, dark, or as the desktop.
    Theme(ThemeChoice),
    /// Larger or smaller text.
    TextSize(TextSize),
    /// Begin or leave the tour.
    Tour(TourAct),
    /// Sets the language.
    Language(LanguageChoice),
    /// Back to the scene of a first start.
    ResetScene,
    /// Open or close a sheet.
    Sheet(Option<Sheet>),
    /// Withdraw a job.
    Cancel(Lane),
    /// Choose a product: moved by its own rule, or in the state that stands for it.
    Select(String),
    /// Choose a state.
    SelectState(String),
    /// Move the keyboard's row in the list, and choose it.
    Row(i32),
    /// Change the scene.
    Scene(Box<SceneFile>),
    /// Something about the year, or about the weather.
    Year(YearAct),
    /// Something about which system to choose.
    Choose(ChooseAct),
    /// Put a box outside, double one, or take one away.
    Outside(outside::Act),
    /// Find the effect of every obstruction on the apertures' illuminance.
    WeighObstructions,
    /// Search for something else.
    Find(Query),
    /// Set or take a star.
    Favourite(String, bool),
    /// Read these files.
    OpenPaths(Vec<PathBuf>),
    /// Write something to a path, whatever is there.
    Write(PathUse, PathBuf),
    /// Write something to a path; where a file is there already, ask first.
    WriteNew(PathUse, PathBuf),
    /// Another name than that of the file that exists.
    KeepFile,
    /// Type a path.
    EditPath(String),
    /// Words of the palette.
    EditPalette(String),
    /// The row of the palette that Enter takes.
    PaletteRow(usize),
    /// Fill in what a product of an import lacks (its number from 0).
    EditImport(usize, Box<ImportFields>),
    /// Take the files that were read for other products.
    GroupImport(Grouping),
    /// Store a product of an import although it is in the catalogue, or not.
    AddAnyway(usize, bool),
    /// Try a repair on a product that was read.
    Repair(usize, Repair),
    /// Take the last repair of a product back.
    UndoRepair(usize),
    /// Store what was read.
    AddImport,
    /// Forget what was read.
    DiscardImport,
    /// Forget a draft of an import.
    DiscardDraft(usize),
    /// Go on with a draft of an import.
    OpenDraft(usize),
    /// Leave what was read as a draft.
    PutAside,
    /// Do something in the table of what was read.
    Import(Step),
    /// Run the present scene with rising effort by every method.
    MeasureAccuracy,
    /// Fill the goniophotometer's sheet with an example.
    SystemExample(usize),
    /// Type a system file.
    EditSystem(String),
    /// On which cells the goniophotometer measures, and how exactly.
    SystemSetup(Setup),
    /// Draw this state of the described system.
    DrawState(usize),
    /// Compute all states of the described system; a stopped run goes on.
    MeasureSystem,
    /// Store what was computed.
    AddMeasured,
    /// Ask where to write what was computed.
    ExportMeasured,
    /// Open the catalogue once more after a failure.
    RetryCatalogue,
    /// Edit the words about a product of this key; of the selected one where it is `None`.
    EditProduct(Option<String>),
    /// Words about a product, as typed.
    EditWords(Box<ImportFields>),
    /// What a state of the product (its number from 0) is called, as typed.
    EditState(usize, StateWords),
    /// Store what was typed about the product.
    SaveWords,
    /// Ask for a file in place of that of a state of the product.
    ReplaceState(String),
    /// Read the files of the product again, and show what changed.
    Reread,
    /// Take what was read again.
    TakeChanges,
    /// Read the folders of packages that are subscribed to.
    SyncSubscribed,
    /// Ask for a folder to open.
    OpenFolder,
    /// Take a product of this key out of sight; the selected one where it is `None`.
    DeleteProduct(Option<String>),
    /// Bring a product back into sight.
    RestoreProduct(String),
    /// Take a message from the window; all where it is `None`.
    Dismiss(Option<u64>),
    /// Forget all messages.
    ForgetMessages,
    /// The report on a fault into the clipboard.
    CopyReport(PathBuf),
    /// Something with the list of products.
    Shelve(Shelving),
    /// Something about what is compared.
    Compare(Act),
    /// List products like this one by what they do to light; like the selected one where it is `None`.
    Like(Option<String>),
}

impl Command {
    /// Is what this changes in the document a step of its own for undo? Not what is dragged, or repeated by a key that is held.
    pub const fn is_step(&self) -> bool {
        match self {
            Self::Year(act) => act.is_step(),
            Self::Choose(act) => act.is_step(),
            other => matches!(other, Self::ResetScene | Self::Compare(_) | Self::Outside(_)),
        }
    }
}
