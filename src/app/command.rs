//! Everything that the window can do: one enum. Menu, palette, shortcuts and tests read it; drawing returns it;
//! [`super::apply`] is the only place that acts on it.

use super::examples::EXAMPLES;
use super::goniophotometer::Setup;
use super::jobs::Lane;
use super::shelf::Query;
use super::state::{PathUse, Sheet, Tile};
use super::theme::ThemeChoice;
use crate::compute::doctor::Repair;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use egui::{Key, KeyboardShortcut, Modifiers};
use std::path::PathBuf;

/// Name of the field in which a system file is typed.
pub const SYSTEM_EDITOR: &str = "system file";

/// The fields of an import sheet, as edited.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportFields {
    /// Product name.
    pub name: String,
    /// Maker.
    pub manufacturer: String,
    /// Kind of system.
    pub kind: String,
    /// Words to find it by, separated by commas.
    pub tags: String,
}

/// One thing to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Ask for files to open.
    Open,
    /// Ask where to save the scene.
    SaveScene,
    /// Ask where to write the LID.
    ExportLid,
    /// Ask where to write a tile, as numbers or as a picture.
    ExportTile(Tile),
    /// A tile's numbers into the clipboard.
    CopyTile(Tile),
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
    /// Open or close the command palette.
    Palette,
    /// Fill the bench with a tile, or show all.
    Maximise(Option<Tile>),
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
    /// Back to the scene of a first start.
    ResetScene,
    /// Open or close a sheet.
    Sheet(Option<Sheet>),
    /// Withdraw a job.
    Cancel(Lane),
    /// Choose a product, in its first state.
    Select(String),
    /// Choose a state.
    SelectState(String),
    /// Move the keyboard's row in the list, and choose it.
    Row(i32),
    /// Change the scene.
    Scene(Box<SceneFile>),
    /// Illuminances follow the sun's altitude, or are typed.
    DaylightFollows(bool),
    /// Search for something else.
    Find(Query),
    /// Set or take a star.
    Favourite(String, bool),
    /// Read these files.
    OpenPaths(Vec<PathBuf>),
    /// Write something to a path.
    Write(PathUse, PathBuf),
    /// Type a path.
    EditPath(String),
    /// Words of the palette.
    EditPalette(String),
    /// Fill in what an import lacks.
    EditImport(Box<ImportFields>),
    /// Try a repair on what was read.
    Repair(Repair),
    /// Take the last repair back.
    UndoRepair,
    /// Store what was read.
    AddImport,
    /// Forget what was read.
    DiscardImport,
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
}

/// How a command is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Info {
    /// Menu entry, sentence case; `…` when more is asked.
    pub text: String,
    /// One sentence.
    pub tip: &'static str,
    /// Keys. Those without Ctrl act only while nothing has the keyboard.
    pub shortcut: Option<KeyboardShortcut>,
}

const fn ctrl(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND, key))
}

const fn plain(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::NONE, key))
}

const fn shift(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::SHIFT, key))
}

impl Command {
    /// Commands that need nothing more to be said: what palette and keys sheet list.
    pub fn listed() -> Vec<Self> {
        use Command::*;
        let mut list = vec![Open, SaveScene, ExportLid, Undo, Redo, Search, Palette];
        list.extend(Tile::ALL.map(|tile| Maximise(Some(tile))));
        list.extend([Maximise(None), Hour(1), Hour(-1), Hour(3), Hour(-3)]);
        list.extend([Day(1), Day(-1), Day(30), Day(-30), NextState(1), NextState(-1)]);
        list.extend(ControlMode::ALL.map(Control));
        list.extend([ToggleCatalogue, ToggleScene]);
        list.extend(Tile::ALL.map(ExportTile));
        list.extend(Tile::ALL.map(CopyTile));
        list.extend(ThemeChoice::ALL.map(Theme));
        list.extend([ResetScene, Sheet(Some(super::state::Sheet::Findings))]);
        list.extend([Sheet(Some(super::state::Sheet::Accuracy)), MeasureAccuracy]);
        list.extend([Sheet(Some(super::state::Sheet::Goniophotometer)), MeasureSystem, AddMeasured, ExportMeasured]);
        list.extend((0..EXAMPLES.len()).map(SystemExample));
        list.extend([Sheet(Some(super::state::Sheet::Keys)), Quit]);
        list
    }

    /// Text, tip and keys.
    pub fn info(&self) -> Info {
        let (text, tip, shortcut): (String, &'static str, _) = match self {
            Self::Open => {
                ("Open…".into(), "Read datasets, a system or a scene; or drop files on the window", ctrl(Key::O))
            }
            Self::SaveScene => ("Save scene…".into(), "Write everything this study needs as a text file", ctrl(Key::S)),
            Self::ExportLid => {
                ("Export LID…".into(), "Write the window as a luminaire (.ldt, .ies) for other programs", ctrl(Key::E))
            }
            Self::ExportTile(tile) => (
                format!("Export tile {}…", tile.title()),
                "Write this tile as numbers (.csv) or as a picture (.png)",
                None,
            ),
            Self::CopyTile(tile) => {
                (format!("Copy tile {} as CSV", tile.title()), "This tile's numbers into the clipboard", None)
            }
            Self::Control(ControlMode::Fixed) => {
                ("State: by hand".into(), "The state stays where [ and ] put it", None)
            }
            Self::Control(ControlMode::Din5034) => (
                "State: closed in sun (DIN 5034)".into(),
                "The most closed state while the sun is on the façade, else the most open",
                None,
            ),
            Self::Control(ControlMode::CutOff) => (
                "State: keep the sun just out (cut-off)".into(),
                "The most open state that lets no direct sun through, the whole disc counted",
                None,
            ),
            Self::Control(ControlMode::Curve) => (
                "State: follow the curve".into(),
                "The state that a curve asks for at the sun's profile angle: the product's, or one edited in the tile",
                None,
            ),
            Self::Control(ControlMode::RetroReflect) => (
                "State: throw the sun back".into(),
                "Mirror slats stand across the beam: 90° − ψ, for the lower part of a window",
                None,
            ),
            Self::Control(ControlMode::Redirect) => (
                "State: redirect the sun".into(),
                "Mirror slats send the sun to the ceiling: half of (elevation − ψ), for the upper part of a window",
                None,
            ),
            Self::Control(ControlMode::User) => (
                "State: by the user's clock".into(),
                "A state by hours of the day; the hours are set in the scene file",
                None,
            ),
            Self::ControlKeys(_) => ("Change the control".into(), "Curve, thresholds, hysteresis, dwell time", None),
            Self::ControlOf(None) => ("Control of all apertures".into(), "One rule for the whole scene", None),
            Self::ControlOf(Some(index)) => {
                (format!("Control of aperture {}", index + 1), "A rule for this aperture alone", None)
            }
            Self::Quit => ("Quit".into(), "Close the window", ctrl(Key::Q)),
            Self::Undo => ("Undo".into(), "Take the last change back", ctrl(Key::Z)),
            Self::Redo => (
                "Redo".into(),
                "Make the change again",
                Some(KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z)),
            ),
            Self::Search => ("Search the catalogue".into(), "Put the cursor into the search field", ctrl(Key::F)),
            Self::Palette => ("Command palette".into(), "Find a command by its words", ctrl(Key::K)),
            Self::Maximise(Some(tile)) => {
                const KEYS: [Key; 6] = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6];
                (format!("Maximise {}", tile.title()), tile.help(), plain(KEYS[*tile as usize]))
            }
            Self::Maximise(None) => ("All six tiles".into(), "Back from one tile to all", plain(Key::Num0)),
            Self::Hour(1) => ("One hour later".into(), "Move the clock", plain(Key::ArrowRight)),
            Self::Hour(-1) => ("One hour earlier".into(), "Move the clock", plain(Key::ArrowLeft)),
            Self::Hour(3) => ("Three hours later".into(), "Move the clock", shift(Key::ArrowRight)),
            Self::Hour(-3) => ("Three hours earlier".into(), "Move the clock", shift(Key::ArrowLeft)),
            Self::Hour(n) => (format!("Move the clock by {n} h"), "Move the clock", None),
            Self::Day(1) => ("One day later".into(), "Move the date", plain(Key::ArrowUp)),
            Self::Day(-1) => ("One day earlier".into(), "Move the date", plain(Key::ArrowDown)),
            Self::Day(30) => ("30 days later".into(), "Move the date", shift(Key::ArrowUp)),
            Self::Day(-30) => ("30 days earlier".into(), "Move the date", shift(Key::ArrowDown)),
            Self::Day(n) => (format!("Move the date by {n} d"), "Move the date", None),
            Self::NextState(n) if *n > 0 => {
                ("Next state".into(), "The next state of the product", plain(Key::CloseBracket))
            }
            Self::NextState(_) => {
                ("Previous state".into(), "The previous state of the product", plain(Key::OpenBracket))
            }
            Self::ToggleCatalogue => ("Catalogue panel".into(), "Show or hide the list of products", ctrl(Key::B)),
            Self::ToggleScene => ("Scene panel".into(), "Show or hide place, time, sky and room", ctrl(Key::J)),
            Self::Theme(choice) => (format!("Theme: {}", choice.word()), "Colours of the window", None),
            Self::ResetScene => ("Reset the scene".into(), "Stuttgart, south, 21 March 12:00, clear sky", None),
            Self::Sheet(Some(Sheet::Findings)) => {
                ("Findings of the dataset".into(), "What the checks say about the selected dataset", None)
            }
            Self::Sheet(Some(Sheet::Keys)) => ("Keys".into(), "All keyboard shortcuts", plain(Key::Questionmark)),
            Self::Sheet(Some(Sheet::Accuracy)) => (
                "Accuracy".into(),
                "Error against run time of every method for this scene, and what stated errors are worth",
                plain(Key::A),
            ),
            Self::MeasureAccuracy => (
                "Measure error against run time".into(),
                "Compute the scene with rising effort by every method: some seconds to a minute",
                None,
            ),
            Self::Sheet(Some(Sheet::Goniophotometer)) => (
                "Goniophotometer".into(),
                "Compute a system's data from its geometry and material, with a drawing of its section",
                plain(Key::G),
            ),
            Self::SystemExample(number) => (
                format!("System example: {}", EXAMPLES.get(*number).map_or("none", |example| example.name)),
                "Fill the goniophotometer's sheet with this system",
                None,
            ),
            Self::MeasureSystem => (
                "Compute the described system".into(),
                "All states, on as many threads as there are; a run that was stopped goes on",
                ctrl(Key::Enter),
            ),
            Self::AddMeasured => (
                "Add the computed system to the catalogue".into(),
                "Store all its states as a product; undo takes it out again",
                None,
            ),
            Self::ExportMeasured => (
                "Export the computed system…".into(),
                "All states as a package (.cfsp), or a file a state (.xml, .btdf.txt)",
                None,
            ),
            Self::EditSystem(_) => ("Type a system file".into(), "Geometry and material as text", None),
            Self::SystemSetup(_) => ("Change the cells".into(), "Incident and emergent cells, error target", None),
            Self::DrawState(_) => ("Draw another state".into(), "The section of this state", None),
            Self::Sheet(Some(Sheet::Import)) => ("Import sheet".into(), "Files that were read", None),
            Self::Sheet(Some(Sheet::Path(_))) => ("Type a path".into(), "Give a path instead of choosing a file", None),
            Self::Sheet(None) => ("Close the sheet".into(), "Close the sheet at the side", None),
            Self::Cancel(lane) => (format!("Cancel {}", lane.word()), "Stop this computation", None),
            Self::Select(key) => (format!("Select {key}"), "Show this product", None),
            Self::SelectState(key) => (format!("State {key}"), "Show this state", None),
            Self::Row(_) => ("Move in the list".into(), "Choose the row above or below", None),
            Self::Scene(_) => ("Change the scene".into(), "Place, time, sky, room", None),
            Self::DaylightFollows(_) => {
                ("Illuminances follow the sun".into(), "Typical values for the sun's altitude", None)
            }
            Self::Find(_) => ("Search".into(), "Narrow the list", None),
            Self::Favourite(_, true) => ("Set a star".into(), "Mark this product", None),
            Self::Favourite(_, false) => ("Take the star".into(), "Unmark this product", None),
            Self::OpenPaths(_) => ("Read files".into(), "Datasets or a scene", None),
            Self::Write(..) => ("Write a file".into(), "To the path given", None),
            Self::EditPath(_) | Self::EditPalette(_) | Self::EditImport(_) => ("Type".into(), "Edit a field", None),
            Self::Repair(repair) => (repair.label(), "Try this repair on what was read", None),
            Self::UndoRepair => ("Undo the repair".into(), "Take the last repair back", None),
            Self::AddImport => ("Add to catalogue".into(), "Store what was read; undo takes it out again", None),
            Self::DiscardImport => ("Discard".into(), "Forget what was read; nothing was stored", None),
            Self::RetryCatalogue => ("Try again".into(), "Open the catalogue once more", None),
        };
        Info { text, tip, shortcut }
    }
}

/// The commands whose keys were pressed in this frame. Keys without Ctrl are left to whatever has the keyboard, an open
/// list among others: its arrow keys do not move the clock.
pub fn pressed(ctx: &egui::Context) -> Vec<Command> {
    let typing = ctx.memory(|memory| memory.focused().is_some()) || egui::Popup::is_any_open(ctx);
    // The editor of system files has a history of its own.
    let editing = ctx.memory(|memory| memory.focused()) == Some(egui::Id::unique(SYSTEM_EDITOR));
    let mut list: Vec<(KeyboardShortcut, Command)> = Command::listed()
        .into_iter()
        .filter_map(|command| Some((command.info().shortcut?, command)))
        .filter(|(keys, _)| !typing || keys.modifiers.command)
        .filter(|(_, command)| !(editing && matches!(command, Command::Undo | Command::Redo)))
        .collect();
    // Egui matches Ctrl+Z also while Shift is down: ask for the longer combination first.
    list.sort_by_key(|(keys, _)| std::cmp::Reverse((keys.modifiers.command, keys.modifiers.shift)));
    ctx.input_mut(|input| {
        list.into_iter().filter(|(keys, _)| input.consume_shortcut(keys)).map(|(_, command)| command).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_commands_share_their_keys_or_words() {
        let mut keys = Vec::new();
        let mut texts = Vec::new();
        for command in Command::listed() {
            let info = command.info();
            assert!(!info.text.is_empty() && !info.tip.is_empty());
            assert!(!texts.contains(&info.text), "{}", info.text);
            texts.push(info.text);
            if let Some(shortcut) = info.shortcut {
                assert!(!keys.contains(&shortcut), "{shortcut:?}");
                keys.push(shortcut);
            }
        }
    }
}
