//! What is offered: one table of the commands that menus, palette, keys sheet and keyboard know, with their words, keys
//! and places. A new one is an entry here and its effect in [`super::apply`].

use super::arrange::{self, Way};
use super::command::{Command, SYSTEM_EDITOR};
use super::compare::{Act, Look};
use super::control;
use super::examples::EXAMPLES;
use super::language::LanguageChoice;
use super::room_look::RoomView;
use super::state::{self, PathUse};
use super::theme::ThemeChoice;
use super::tiles::TILES;
use super::views::btdf::form_words;
use crate::study::data_form::DataForm as Form;
use crate::study::scene_file::ControlMode;
use crate::texts::tiles as tiles_say;
use crate::texts::{self, language, shell, speak};
use egui::{Key, KeyboardShortcut, Modifiers};
use std::sync::LazyLock;

const FILE: &str = "File";
const EDIT: &str = "Edit";
const VIEW: &str = "View";
const COMPARE: &str = "Compare";
const HELP: &str = "Help";
/// The menus, in the order of the bar.
pub const MENUS: [&str; 5] = [FILE, EDIT, VIEW, COMPARE, HELP];

/// Where the menus have a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Which of [`MENUS`].
    pub menu: &'static str,
    /// Order in the menu; a line separates one ten from the next.
    pub rank: u8,
    /// Name of the menu in the menu that gathers it with its like.
    pub within: Option<&'static str>,
}

/// A command as it is offered.
#[derive(Debug, Clone, PartialEq)]
pub struct Offer {
    /// What is done.
    pub command: Command,
    /// Menu entry, sentence case; `…` when more is asked.
    pub text: String,
    /// One sentence.
    pub tip: &'static str,
    /// Keys. Those without Ctrl act only while nothing has the keyboard.
    pub keys: Option<KeyboardShortcut>,
    /// Where the menus have it.
    pub place: Option<Place>,
    /// Do palette and keys sheet list it?
    pub listed: bool,
}

fn offer(command: Command, text: impl Into<String>, tip: &'static str) -> Offer {
    Offer { command, text: text.into(), tip, keys: None, place: None, listed: true }
}

impl Offer {
    fn keys(self, modifiers: Modifiers, key: Key) -> Self {
        Self { keys: Some(KeyboardShortcut::new(modifiers, key)), ..self }
    }

    fn menu(self, menu: &'static str, rank: u8) -> Self {
        Self { place: Some(Place { menu, rank, within: None }), ..self }
    }

    fn within(self, name: &'static str) -> Self {
        Self { place: self.place.map(|place| Place { within: Some(name), ..place }), ..self }
    }

    fn unlisted(self) -> Self {
        Self { listed: false, ..self }
    }
}

const CTRL: Modifiers = Modifiers::COMMAND;
const PLAIN: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
/// Numbers of tiles in words.
const COUNTS: [&str; 10] = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];

/// What arranges the tiles. Arrow keys do the same at a tile's head, see the bench.
fn arrangement() -> Vec<Offer> {
    use arrange::Arrange::*;
    let plain = |what, text: &str, tip| offer(Command::Arrange(what), text, tip).menu(VIEW, 3).within("Arrange tiles");
    let mut list: Vec<Offer> = arrange::Preset::ALL
        .map(|ready| {
            offer(Command::Arrange(Preset(ready)), ready.word(), ready.tip().get()).menu(VIEW, 2).within("Layout")
        })
        .into();
    list.extend([
        plain(Focus(1), "Next tile", "The keyboard goes to the next tile in sight").keys(PLAIN, Key::F6),
        plain(Focus(-1), "Previous tile", "The keyboard goes to the tile before").keys(SHIFT, Key::F6),
        plain(Tab(1), "Next tab", "The next of the tabs that the tile in hand is one of").keys(CTRL, Key::PageDown),
        plain(Tab(-1), "Previous tab", "The tab before").keys(CTRL, Key::PageUp),
    ]);
    list.extend(RoomView::ALL.map(|view| {
        let text = format!("Room: {}", view.word().get().to_lowercase());
        offer(Command::RoomView(view), text, view.tip().get()).menu(VIEW, 4).within("Room")
    }));
    list.extend(Way::ALL.map(|way| {
        let text = format!("Move tile {}", way.word());
        plain(Move(way), &text, "The tile in hand changes places with the one on that side")
    }));
    list.extend([
        plain(Join, "Join tabs", "The tile in hand becomes a tab of the next one"),
        plain(Split, "Split from tabs", "The tile in hand leaves its tabs and stands beside them"),
        plain(Width(true), "Wider tile", "More width for the tile in hand"),
        plain(Width(false), "Narrower tile", "Less width for the tile in hand"),
        plain(Height(true), "Higher tile", "More height for the tile in hand"),
        plain(Height(false), "Lower tile", "Less height for the tile in hand"),
    ]);
    list
}

/// The table, in the order of palette and keys sheet.
fn table() -> Vec<Offer> {
    use Command::*;
    let sheet = |sheet| Command::Sheet(Some(sheet));
    let tiles = || TILES.iter().map(|entry| entry.tile);
    let mut list = vec![
        offer(Open, "Open…", "Read datasets, a system or a scene; or drop files on the window")
            .keys(CTRL, Key::O)
            .menu(FILE, 0),
        offer(sheet(state::Sheet::Path(PathUse::Open)), "Type a path", "Give a path instead of choosing a file")
            .menu(FILE, 1)
            .unlisted(),
        offer(OpenFolder, "Open folder…", "Read all datasets of a folder, with those in it")
            .keys(CTRL.plus(SHIFT), Key::O)
            .menu(FILE, 0),
        offer(
            SyncSubscribed,
            "Read subscribed folders",
            "Folders of packages that the catalogue is subscribed to, where they have changed",
        )
        .menu(FILE, 3),
        offer(
            sheet(state::Sheet::Import),
            "Import",
            "What was read and is not stored yet, and drafts of earlier imports",
        )
        .keys(PLAIN, Key::I)
        .menu(FILE, 2),
        offer(PutAside, "Keep the import as a draft", "Leave what was read for later; the import sheet lists it"),
        offer(SaveScene, "Save scene…", "Write everything this study needs as a text file")
            .keys(CTRL, Key::S)
            .menu(FILE, 10),
        offer(
            sheet(state::Sheet::HandOn),
            "Hand on…",
            "Pictures, reports (PDF), luminaire files, tables, datasets, packages, with a preview",
        )
        .keys(CTRL, Key::E)
        .menu(FILE, 11),
        offer(ExportLid, "Export LID…", "Write the window as a luminaire (.ldt, .ies) for other programs")
            .menu(FILE, 12),
        offer(Undo, "Undo", "Take the last change back").keys(CTRL, Key::Z).menu(EDIT, 0),
        offer(Redo, "Redo", "Make the change again").keys(CTRL.plus(SHIFT), Key::Z).menu(EDIT, 1),
        offer(EditProduct(None), "Edit product…", "Words, states, files and history of the selected product")
            .keys(PLAIN, Key::F2)
            .menu(EDIT, 10),
        offer(DeleteProduct(None), "Delete product", "Take the selected product out of sight; undo brings it back")
            .menu(EDIT, 11),
        offer(sheet(state::Sheet::Deleted), "Recently deleted", "Products out of sight, and back").menu(EDIT, 12),
        offer(AddImport, "Add what was read to the catalogue", "Store the products of the import sheet"),
        offer(sheet(state::Sheet::Messages), "Messages", "What the window said, also what is gone from sight")
            .menu(HELP, 3),
        offer(Search, "Search the catalogue", "Put the cursor into the search field").keys(CTRL, Key::F),
        offer(Palette, "Command palette", "Find a command by its words").keys(CTRL, Key::K).menu(HELP, 0),
    ];
    for (number, tile) in tiles().enumerate() {
        let one = offer(Maximise(Some(tile)), format!("Maximise {}", tile.name), tile.help.get()).menu(VIEW, 0);
        // The first nine by their number.
        let key = Key::from_name(&(number + 1).to_string());
        list.push(Offer { keys: key.map(|key| KeyboardShortcut::new(PLAIN, key)), ..one });
    }
    let all = format!("All {} tiles", COUNTS.get(TILES.len()).unwrap_or(&"the"));
    list.extend(arrangement());
    list.extend([
        offer(Maximise(None), all, "Back from one tile to all").keys(PLAIN, Key::Num0).menu(VIEW, 1),
        offer(Hour(1), "One hour later", "Move the clock").keys(PLAIN, Key::ArrowRight),
        offer(Hour(-1), "One hour earlier", "Move the clock").keys(PLAIN, Key::ArrowLeft),
        offer(Hour(3), "Three hours later", "Move the clock").keys(SHIFT, Key::ArrowRight),
        offer(Hour(-3), "Three hours earlier", "Move the clock").keys(SHIFT, Key::ArrowLeft),
        offer(Day(1), "One day later", "Move the date").keys(PLAIN, Key::ArrowUp),
        offer(Day(-1), "One day earlier", "Move the date").keys(PLAIN, Key::ArrowDown),
        offer(Day(30), "30 days later", "Move the date").keys(SHIFT, Key::ArrowUp),
        offer(Day(-30), "30 days earlier", "Move the date").keys(SHIFT, Key::ArrowDown),
        offer(NextState(1), "Next state", "The next state of the product").keys(PLAIN, Key::CloseBracket),
        offer(NextState(-1), "Previous state", "The previous state of the product").keys(PLAIN, Key::OpenBracket),
    ]);
    list.extend(ControlMode::ALL.map(|mode| {
        let words = control::words(mode);
        offer(Control(mode), format!("State: {}", words.order), words.tip)
    }));
    list.extend([
        offer(ToggleCatalogue, "Catalogue panel", "Show or hide the list of products")
            .keys(CTRL, Key::B)
            .menu(VIEW, 20),
        offer(ToggleScene, "Scene panel", "Show or hide place, time, sky and room").keys(CTRL, Key::J).menu(VIEW, 21),
    ]);
    list.extend(Form::ALL.map(|form| {
        let [word, tip] = form_words(form);
        offer(Command::DataForm(form), tiles_say::data_offer(word), tip.get()).menu(VIEW, 4).within("BTDF")
    }));
    list.push(offer(SchemeMap, tiles_say::SCHEMES_OFFER, tiles_say::SCHEMES_TIP.get()).menu(VIEW, 4).within("BTDF"));
    list.extend(tiles().map(|tile| {
        let tip = "Hand this tile on as a picture (.svg, .png) or as numbers (.csv)";
        offer(ExportTile(tile), format!("Export tile {}…", tile.name), tip).menu(FILE, 12).within("Export tile")
    }));
    list.extend(tiles().map(|tile| {
        offer(CopyTile(tile), format!("Copy tile {} as CSV", tile.name), "This tile's numbers into the clipboard")
    }));
    list.extend(tiles().map(|tile| {
        let text = tiles_say::copy_picture(tile.name);
        offer(CopyPicture(tile), text, tiles_say::COPY_PICTURE_TIP.get())
            .menu(EDIT, 20)
            .within(tiles_say::COPY_AS_PICTURE.get())
    }));
    list.push(
        offer(CopyValue, tiles_say::COPY_VALUE, tiles_say::COPY_VALUE_TIP.get())
            .keys(CTRL.plus(SHIFT), Key::C)
            .menu(EDIT, 21),
    );
    list.extend(ThemeChoice::ALL.map(|choice| {
        offer(Theme(choice), format!("Theme: {}", choice.word()), "Colours of the window").menu(VIEW, 30)
    }));
    list.extend(LanguageChoice::ALL.map(|choice| {
        offer(Language(choice), shell::language_is(choice.word()), shell::LANGUAGE_TIP.get()).menu(VIEW, 31)
    }));
    let act = |act: Act| Compare(act);
    list.extend([
        offer(act(Act::Add), "Add to compare", "What is shown into the tray: product and state, or rule")
            .keys(PLAIN, Key::C)
            .menu(COMPARE, 0),
        offer(
            act(Act::AddMoment),
            "Add to compare with this moment",
            "The same under the sky and sun of now, for good",
        )
        .keys(SHIFT, Key::C)
        .menu(COMPARE, 1),
        offer(act(Act::AddScene), "Add the whole scene to compare", "Room, apertures, sensors, place and sky with it")
            .menu(COMPARE, 2),
        offer(act(Act::Show), "Compare the tray", "All of the tray in the tiles' place, or back to the tiles")
            .keys(SHIFT, Key::X)
            .menu(COMPARE, 10),
        offer(act(Act::Swap), "Swap with the other one", "All tiles show the other one of the tray, and go back")
            .keys(PLAIN, Key::X)
            .menu(COMPARE, 11),
    ]);
    list.extend(Look::ALL.map(|look| {
        offer(act(Act::Look(look)), format!("Compare: {}", look.words().to_lowercase()), look.tip()).menu(COMPARE, 20)
    }));
    list.extend([
        offer(act(Act::Copy), "Copy the compared figures", "The table with errors as CSV into the clipboard")
            .menu(COMPARE, 30),
        offer(act(Act::Clear), "Empty the tray", "Nothing is compared any more; undo brings it back").menu(COMPARE, 31),
        offer(Like(None), "Products like this one", "By what they do to light, not by name: nearest first")
            .menu(COMPARE, 40),
    ]);
    list.extend([
        offer(ResetScene, "Reset the scene", "Stuttgart, south, 21 March 12:00, clear sky").menu(EDIT, 2),
        offer(
            sheet(state::Sheet::Findings),
            "Findings of the dataset",
            "What the checks say about the selected dataset",
        )
        .menu(HELP, 2),
        offer(
            sheet(state::Sheet::Accuracy),
            "Accuracy",
            "Error against run time of every method for this scene, and what stated errors are worth",
        )
        .keys(PLAIN, Key::A)
        .menu(VIEW, 11),
        offer(
            MeasureAccuracy,
            "Measure error against run time",
            "Compute the scene with rising effort by every method: some seconds to a minute",
        ),
        offer(
            sheet(state::Sheet::Goniophotometer),
            "Goniophotometer",
            "Compute a system's data from its geometry and material, with a drawing of its section",
        )
        .keys(PLAIN, Key::G)
        .menu(VIEW, 10),
        offer(
            MeasureSystem,
            "Compute the described system",
            "All states, on as many threads as there are; a run that was stopped goes on",
        )
        .keys(CTRL, Key::Enter),
        offer(
            AddMeasured,
            "Add the computed system to the catalogue",
            "Store all its states as a product; undo takes it out again",
        ),
        offer(
            ExportMeasured,
            "Export the computed system…",
            "All states as a package (.cfsp), or a file a state (.xml, .btdf.txt)",
        ),
    ]);
    list.extend(EXAMPLES.iter().enumerate().map(|(number, example)| {
        let text = format!("System example: {}", example.name);
        offer(SystemExample(number), text, "Fill the goniophotometer's sheet with this system")
    }));
    list.extend([
        offer(sheet(state::Sheet::Keys), "Keys", "All keyboard shortcuts").keys(PLAIN, Key::Questionmark).menu(HELP, 1),
        offer(Quit, "Quit", "Close the window").keys(CTRL, Key::Q).menu(FILE, 20),
    ]);
    list
}

fn table_in(language: texts::Language) -> Vec<Offer> {
    let _speaking = speak(language);
    table()
}

/// All that is offered, in the language that is spoken.
pub fn offers() -> &'static [Offer] {
    static ENGLISH: LazyLock<Vec<Offer>> = LazyLock::new(|| table_in(texts::Language::English));
    static GERMAN: LazyLock<Vec<Offer>> = LazyLock::new(|| table_in(texts::Language::German));
    match language() {
        texts::Language::English => &ENGLISH,
        texts::Language::German => &GERMAN,
    }
}

/// What palette and keys sheet list.
pub fn listed() -> impl Iterator<Item = &'static Offer> {
    offers().iter().filter(|offer| offer.listed)
}

/// Keys as they are written on a keyboard: `Ctrl+Shift+Z`, `]`, `→`.
pub fn key_words(keys: &KeyboardShortcut) -> String {
    let key = match keys.logical_key {
        Key::ArrowLeft => "←",
        Key::ArrowRight => "→",
        Key::ArrowUp => "↑",
        Key::ArrowDown => "↓",
        key => key.symbol_or_name(),
    };
    let modifiers = keys.modifiers;
    let held = [(modifiers.command || modifiers.ctrl, "Ctrl+"), (modifiers.alt, "Alt+"), (modifiers.shift, "Shift+")];
    let held: String = held.into_iter().filter(|(held, _)| *held).map(|(_, word)| word).collect();
    format!("{held}{key}")
}

/// How a command is offered.
pub fn of(command: &Command) -> Option<&'static Offer> {
    offers().iter().find(|offer| offer.command == *command)
}

/// The commands whose keys were pressed in this frame. Keys without Ctrl are left to whatever has the keyboard, an open
/// list among others: its arrow keys do not move the clock.
pub fn pressed(ctx: &egui::Context) -> Vec<Command> {
    let typing = ctx.memory(|memory| memory.focused().is_some()) || egui::Popup::is_any_open(ctx);
    // The editor of system files has a history of its own.
    let editing = ctx.memory(|memory| memory.focused()) == Some(egui::Id::unique(SYSTEM_EDITOR));
    let mut list: Vec<(KeyboardShortcut, &Command)> = offers()
        .iter()
        .filter_map(|offer| Some((offer.keys?, &offer.command)))
        .filter(|(keys, _)| !typing || keys.modifiers.command)
        .filter(|(_, command)| !(editing && matches!(command, Command::Undo | Command::Redo)))
        .collect();
    // Egui matches Ctrl+Z also while Shift is down: ask for the longer combination first.
    list.sort_by_key(|(keys, _)| std::cmp::Reverse((keys.modifiers.command, keys.modifiers.shift)));
    ctx.input_mut(|input| {
        list.into_iter().filter(|(keys, _)| input.consume_shortcut(keys)).map(|(_, command)| command.clone()).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_written_as_on_the_keyboard() {
        let words = |command: Command| key_words(&of(&command).unwrap().keys.unwrap());
        assert_eq!(words(Command::NextState(1)), "]");
        assert_eq!(words(Command::NextState(-1)), "[");
        assert_eq!(words(Command::Hour(-3)), "Shift+←");
        assert_eq!(words(Command::Redo), "Ctrl+Shift+Z");
        assert_eq!(words(Command::Sheet(Some(state::Sheet::Keys))), "?");
        assert_eq!(words(Command::MeasureSystem), "Ctrl+Enter");
        // No name of a key that is a sign on the keyboard.
        for keys in offers().iter().filter_map(|offer| offer.keys) {
            let last = key_words(&keys);
            let last = last.rsplit('+').next().unwrap();
            let printed = |key: &str| ["Enter", "Escape", "Delete", "F2", "F6", "PageUp", "PageDown"].contains(&key);
            assert!(last.chars().count() == 1 || printed(last), "{last}");
        }
    }

    #[test]
    fn no_two_commands_share_their_keys_or_words() {
        let mut keys = Vec::new();
        let mut texts = Vec::new();
        for offer in offers() {
            assert!(!offer.text.is_empty() && !offer.tip.is_empty());
            assert!(!texts.contains(&&offer.text), "{}", offer.text);
            texts.push(&offer.text);
            if let Some(shortcut) = offer.keys {
                assert!(!keys.contains(&shortcut), "{shortcut:?}");
                keys.push(shortcut);
            }
        }
    }
}
