//! Commands that the user can choose: one table for menus, command palette, sheet of shortcuts and keyboard, with
//! labels, shortcuts and positions in the menus. A new command needs an entry here and its execution in
//! [`super::apply`].

use super::command::{Command, SYSTEM_EDITOR};
use super::compare::view::{Act, Look};
use super::goniophotometer::examples::EXAMPLES;
use super::rank::board::ChooseAct;
use super::state::{self, PathUse};
use super::tiles::TILES;
use super::tour::step::TourAct;
use super::views::btdf::form_words;
use super::year::input::YearAct;
use crate::app::catalogue::command::CatalogueCommand;
use crate::app::display::language::LanguageChoice;
use crate::app::display::text_size::TextSize as Size;
use crate::app::display::theme::ThemeChoice;
use crate::app::scene::control;
use crate::app::scene::outside;
use crate::app::scene::room_look::RoomView;
use crate::app::tiles::arrange::{self, Way};
use crate::study::data_form::DataForm as Form;
use crate::study::scene_file::ControlMode;
use crate::texts::commands::{self as words, COMPARE, EDIT, FILE, HELP, VIEW};
use crate::texts::tiles as tiles_say;
use crate::texts::{self, Language::English, Text, catalogue, choose, language, scene, shell, speak, year};
use egui::{Event, Key, KeyboardShortcut, Modifiers};
use std::sync::LazyLock;

/// Menus, in the order of the menu bar.
pub const MENUS: [Text; 5] = [FILE, EDIT, VIEW, COMPARE, HELP];

/// Position of a command in the menus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Menu, one of [`MENUS`].
    pub menu: Text,
    /// Order in the menu; commands with different tens digits are separated by a line.
    pub rank: u8,
    /// Name of the submenu that contains the command, if any.
    pub within: Option<&'static str>,
}

/// Command with its label, tooltip, shortcut and position in the menus.
#[derive(Debug, Clone, PartialEq)]
pub struct Offer {
    /// Command that is executed.
    pub command: Command,
    /// Label in menus and palette, in sentence case; ends with `…` if more input follows.
    pub text: String,
    /// Tooltip, one sentence.
    pub tip: &'static str,
    /// Keyboard shortcut, if there is one. Shortcuts without Ctrl work only while no widget has the keyboard focus.
    pub keys: Option<KeyboardShortcut>,
    /// Position in the menus; `None` if no menu contains the command.
    pub place: Option<Place>,
    /// Whether the command palette and the sheet of shortcuts list the command.
    pub listed: bool,
}

fn offer(command: Command, text: impl Into<String>, tip: impl Into<&'static str>) -> Offer {
    Offer { command, text: text.into(), tip: tip.into(), keys: None, place: None, listed: true }
}

impl Offer {
    fn keys(self, modifiers: Modifiers, key: Key) -> Self {
        Self { keys: Some(KeyboardShortcut::new(modifiers, key)), ..self }
    }

    fn menu(self, menu: Text, rank: u8) -> Self {
        Self { place: Some(Place { menu, rank, within: None }), ..self }
    }

    fn within(self, name: impl Into<&'static str>) -> Self {
        let name = name.into();
        Self { place: self.place.map(|place| Place { within: Some(name), ..place }), ..self }
    }

    fn unlisted(self) -> Self {
        Self { listed: false, ..self }
    }
}

const CTRL: Modifiers = Modifiers::COMMAND;
const PLAIN: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
// What is offered says their number.
const _: () = assert!(TILES.len() == 8);

/// Returns a word in the spelling after a colon: English ones begin in lower case there, German ones are unchanged.
fn behind_colon(word: impl std::fmt::Display) -> String {
    let word = word.to_string();
    if language() == English { word.to_lowercase() } else { word }
}

/// Returns the commands that arrange the tiles, which arrow keys on a tile's head execute, too.
fn arrangement() -> Vec<Offer> {
    use arrange::Arrange::*;
    let plain = |what, text: String, tip: Text| {
        offer(Command::Arrange(what), text, tip).menu(VIEW, 3).within(words::ARRANGE_TILES)
    };
    let mut list: Vec<Offer> = arrange::Preset::ALL
        .map(|ready| {
            offer(Command::Arrange(Preset(ready)), ready.word(), ready.tip()).menu(VIEW, 2).within(words::LAYOUT)
        })
        .into();
    list.extend([
        plain(Focus(1), words::NEXT_TILE.into(), words::NEXT_TILE_TIP).keys(PLAIN, Key::F6),
        plain(Focus(-1), words::PREVIOUS_TILE.into(), words::PREVIOUS_TILE_TIP).keys(SHIFT, Key::F6),
        plain(Tab(1), words::NEXT_TAB.into(), words::NEXT_TAB_TIP).keys(CTRL, Key::PageDown),
        plain(Tab(-1), words::PREVIOUS_TAB.into(), words::PREVIOUS_TAB_TIP).keys(CTRL, Key::PageUp),
    ]);
    list.extend(RoomView::ALL.map(|view| {
        let text = words::room_view(behind_colon(view.word()));
        offer(Command::RoomView(view), text, view.tip()).menu(VIEW, 4).within(words::ROOM)
    }));
    list.extend(Way::ALL.map(|way| {
        let text = words::move_tile(way.word());
        plain(Move(way), text, words::MOVE_TILE_TIP)
    }));
    list.extend([
        plain(Join, words::JOIN_TABS.into(), words::JOIN_TABS_TIP),
        plain(Split, words::SPLIT.into(), words::SPLIT_TIP),
        plain(Width(true), words::WIDER.into(), words::WIDER_TIP),
        plain(Width(false), words::NARROWER.into(), words::NARROWER_TIP),
        plain(Height(true), words::HIGHER.into(), words::HIGHER_TIP),
        plain(Height(false), words::LOWER.into(), words::LOWER_TIP),
    ]);
    list
}

/// Returns the table of all commands, in the order of command palette and sheet of shortcuts.
fn table() -> Vec<Offer> {
    use Command::*;
    let sheet = |sheet| Command::Sheet(Some(sheet));
    let tiles = || TILES.iter().map(|entry| entry.tile);
    let mut list = vec![
        offer(Open, words::OPEN, words::OPEN_TIP).keys(CTRL, Key::O).menu(FILE, 0),
        offer(sheet(state::Sheet::Path(PathUse::Open)), words::TYPE_PATH, words::TYPE_PATH_TIP)
            .menu(FILE, 1)
            .unlisted(),
        offer(OpenFolder, words::OPEN_FOLDER, words::OPEN_FOLDER_TIP).keys(CTRL.plus(SHIFT), Key::O).menu(FILE, 0),
        offer(SyncSubscribed, words::READ_SUBSCRIBED, words::READ_SUBSCRIBED_TIP).menu(FILE, 3),
        offer(Catalogue(CatalogueCommand::Subscribe), catalogue::SUBSCRIBE_MENU, catalogue::SUBSCRIBE_TIP)
            .menu(FILE, 3),
        offer(sheet(state::Sheet::Subscriptions), catalogue::SUBSCRIPTIONS_MENU, catalogue::SUBSCRIPTIONS_TIP)
            .menu(FILE, 3),
        offer(sheet(state::Sheet::Import), words::IMPORT, words::IMPORT_TIP).keys(PLAIN, Key::I).menu(FILE, 2),
        offer(KeepDraft, words::KEEP_DRAFT, words::KEEP_DRAFT_TIP),
        offer(SaveScene, words::SAVE_SCENE, words::SAVE_SCENE_TIP).keys(CTRL, Key::S).menu(FILE, 10),
        offer(sheet(state::Sheet::Export), words::EXPORT, words::EXPORT_TIP).keys(CTRL, Key::E).menu(FILE, 11),
        offer(ExportLid, words::EXPORT_LID, words::EXPORT_LID_TIP).menu(FILE, 12),
        offer(Undo, words::UNDO, words::UNDO_TIP).keys(CTRL, Key::Z).menu(EDIT, 0),
        offer(Redo, words::REDO, words::REDO_TIP).keys(CTRL.plus(SHIFT), Key::Z).menu(EDIT, 1),
        offer(EditProduct(None), words::EDIT_PRODUCT, words::EDIT_PRODUCT_TIP).keys(PLAIN, Key::F2).menu(EDIT, 10),
        offer(sheet(state::Sheet::Collections), catalogue::COLLECTIONS_MENU, catalogue::COLLECTIONS_TIP).menu(EDIT, 10),
        offer(Catalogue(CatalogueCommand::Star), catalogue::STAR_MENU, catalogue::STAR_MENU_TIP).menu(EDIT, 10),
        offer(DeleteProduct(None), words::DELETE_PRODUCT, words::DELETE_PRODUCT_TIP).menu(EDIT, 11),
        offer(sheet(state::Sheet::Deleted), words::DELETED, words::DELETED_TIP).menu(EDIT, 12),
        offer(AddImport, words::ADD_IMPORT, words::ADD_IMPORT_TIP),
        offer(sheet(state::Sheet::Messages), words::MESSAGES, words::MESSAGES_TIP).menu(HELP, 3),
        offer(Catalogue(CatalogueCommand::Gallery), catalogue::GALLERY_MENU, catalogue::GALLERY_TIP)
            .keys(CTRL, Key::G)
            .menu(VIEW, 22),
        offer(Catalogue(CatalogueCommand::Recent), catalogue::RECENT_MENU, catalogue::RECENT_ALONE).menu(VIEW, 22),
        offer(Catalogue(CatalogueCommand::First), catalogue::FIRST_MENU, catalogue::FIRST_MENU_TIP),
        offer(Search, words::SEARCH, words::SEARCH_TIP).keys(CTRL, Key::F),
        offer(Palette, words::PALETTE, words::PALETTE_TIP).keys(CTRL, Key::K).menu(HELP, 0),
    ];
    for (number, tile) in tiles().enumerate() {
        let one = offer(Maximise(Some(tile)), words::maximise(tile.name), tile.help).menu(VIEW, 0);
        // The first nine by their number.
        let key = Key::from_name(&(number + 1).to_string());
        list.push(Offer { keys: key.map(|key| KeyboardShortcut::new(PLAIN, key)), ..one });
    }
    list.extend(arrangement());
    list.extend([
        offer(Maximise(None), words::ALL_TILES, words::ALL_TILES_TIP).keys(PLAIN, Key::Num0).menu(VIEW, 1),
        offer(Hour(1), words::HOUR_LATER, words::CLOCK_TIP).keys(PLAIN, Key::ArrowRight),
        offer(Hour(-1), words::HOUR_EARLIER, words::CLOCK_TIP).keys(PLAIN, Key::ArrowLeft),
        offer(Hour(3), words::HOURS_LATER, words::CLOCK_TIP).keys(SHIFT, Key::ArrowRight),
        offer(Hour(-3), words::HOURS_EARLIER, words::CLOCK_TIP).keys(SHIFT, Key::ArrowLeft),
        offer(Day(1), words::DAY_LATER, words::DATE_TIP).keys(PLAIN, Key::ArrowUp),
        offer(Day(-1), words::DAY_EARLIER, words::DATE_TIP).keys(PLAIN, Key::ArrowDown),
        offer(Day(30), words::DAYS_LATER, words::DATE_TIP).keys(SHIFT, Key::ArrowUp),
        offer(Day(-30), words::DAYS_EARLIER, words::DATE_TIP).keys(SHIFT, Key::ArrowDown),
        offer(NextState(1), words::NEXT_STATE, words::NEXT_STATE_TIP).keys(PLAIN, Key::CloseBracket),
        offer(NextState(-1), words::PREVIOUS_STATE, words::PREVIOUS_STATE_TIP).keys(PLAIN, Key::OpenBracket),
    ]);
    list.extend(ControlMode::ALL.map(|mode| {
        let rule = control::words(mode);
        offer(Control(mode), words::state_is(rule.order), rule.tip)
    }));
    list.extend([
        offer(ToggleCatalogue, words::CATALOGUE_PANEL, words::CATALOGUE_PANEL_TIP).keys(CTRL, Key::B).menu(VIEW, 20),
        offer(ToggleScene, words::SCENE_PANEL, words::SCENE_PANEL_TIP).keys(CTRL, Key::J).menu(VIEW, 21),
    ]);
    list.extend(Form::ALL.map(|form| {
        let [word, tip] = form_words(form);
        offer(Command::DataForm(form), tiles_say::data_offer(word), tip).menu(VIEW, 4).within(Text::new("BTDF", "BTDF"))
    }));
    list.push(
        offer(SchemeMap, tiles_say::SCHEMES_OFFER, tiles_say::SCHEMES_TIP)
            .menu(VIEW, 4)
            .within(Text::new("BTDF", "BTDF")),
    );
    list.extend(tiles().map(|tile| {
        offer(ExportTile(tile), words::export_tile(tile.name), words::EXPORT_TILE_TIP)
            .menu(FILE, 12)
            .within(words::EXPORT_TILE)
    }));
    list.extend(tiles().map(|tile| {
        let text = tiles_say::copy_picture(tile.name);
        offer(CopyPicture(tile), text, tiles_say::COPY_PICTURE_TIP).menu(EDIT, 20).within(tiles_say::COPY_AS_PICTURE)
    }));
    list.push(
        offer(CopyValue, tiles_say::COPY_VALUE, tiles_say::COPY_VALUE_TIP)
            .keys(CTRL.plus(SHIFT), Key::C)
            .menu(EDIT, 21),
    );
    list.extend(tiles().map(|tile| offer(CopyTile(tile), words::copy_tile(tile.name), words::COPY_TILE_TIP)));
    list.extend(ThemeChoice::ALL.map(|choice| {
        offer(Theme(choice), words::theme_is(choice.word()), words::THEME_TIP).menu(VIEW, 30).within(words::THEME)
    }));
    list.extend(LanguageChoice::ALL.map(|choice| {
        offer(Language(choice), shell::language_is(choice.word()), shell::LANGUAGE_TIP)
            .menu(VIEW, 31)
            .within(shell::LANGUAGE)
    }));
    list.extend([
        offer(TextSize(Size::Larger), words::LARGER, words::LARGER_TIP)
            .keys(CTRL, Key::Plus)
            .menu(VIEW, 32)
            .within(words::TEXT_SIZE),
        offer(TextSize(Size::Smaller), words::SMALLER, words::SMALLER_TIP)
            .keys(CTRL, Key::Minus)
            .menu(VIEW, 32)
            .within(words::TEXT_SIZE),
        offer(TextSize(Size::Normal), words::NORMAL, words::NORMAL_TIP)
            .keys(CTRL, Key::Num0)
            .menu(VIEW, 32)
            .within(words::TEXT_SIZE),
        offer(Tour(TourAct::Start), words::TOUR, words::TOUR_TIP).menu(HELP, 4),
    ]);
    let act = |act: Act| Compare(act);
    list.extend([
        offer(act(Act::Add), words::ADD_COMPARE, words::ADD_COMPARE_TIP).keys(PLAIN, Key::C).menu(COMPARE, 0),
        offer(act(Act::AddMoment), words::ADD_MOMENT, words::ADD_MOMENT_TIP).keys(SHIFT, Key::C).menu(COMPARE, 1),
        offer(act(Act::AddScene), words::ADD_SCENE, words::ADD_SCENE_TIP).menu(COMPARE, 2),
        offer(act(Act::Show), words::SHOW_COMPARE, words::SHOW_COMPARE_TIP).keys(SHIFT, Key::X).menu(COMPARE, 10),
        offer(act(Act::Swap), words::SWAP, words::SWAP_TIP).keys(PLAIN, Key::X).menu(COMPARE, 11),
    ]);
    list.extend(Look::ALL.map(|look| {
        offer(act(Act::Look(look)), words::compare_look(behind_colon(look.words())), look.tip()).menu(COMPARE, 20)
    }));
    list.extend([
        offer(act(Act::Copy), words::COPY_COMPARED, words::COPY_COMPARED_TIP).menu(COMPARE, 30),
        offer(act(Act::Clear), words::CLEAR_COMPARISON, words::CLEAR_COMPARISON_TIP).menu(COMPARE, 31),
        offer(Like(None), words::LIKE, words::LIKE_TIP).menu(COMPARE, 40),
    ]);
    let outdoors =
        |act: outside::Act, text: Text, tip: Text| offer(Outside(act), text, tip).menu(EDIT, 3).within(scene::OUTSIDE);
    list.extend(outside::Kind::ALL.map(|kind| outdoors(outside::Act::Add(kind), kind.order(), scene::ADD_OUTSIDE_TIP)));
    list.extend([
        outdoors(outside::Act::Duplicate(None), scene::DUPLICATE_LAST, scene::DUPLICATE_TIP),
        outdoors(outside::Act::Remove(None), scene::REMOVE_LAST, scene::REMOVE_TIP),
    ]);
    list.extend([
        offer(ResetScene, words::RESET_SCENE, words::RESET_SCENE_TIP).menu(EDIT, 2),
        offer(sheet(state::Sheet::Findings), words::FINDINGS, words::FINDINGS_TIP).menu(HELP, 2),
        offer(sheet(state::Sheet::Accuracy), words::ACCURACY, words::ACCURACY_TIP).keys(PLAIN, Key::A).menu(VIEW, 11),
        offer(Year(YearAct::Compute), year::COMPUTE, year::COMPUTE_OFFER_TIP).keys(PLAIN, Key::Y).menu(VIEW, 11),
        offer(Choose(ChooseAct::Rank), choose::RANK_CATALOGUE, choose::RANK_TIP).menu(VIEW, 11),
        offer(MeasureAccuracy, words::MEASURE, words::MEASURE_TIP),
        offer(sheet(state::Sheet::Goniophotometer), words::GONIOPHOTOMETER, words::GONIOPHOTOMETER_TIP)
            .keys(PLAIN, Key::G)
            .menu(VIEW, 10),
        offer(MeasureSystem, words::COMPUTE_SYSTEM, words::COMPUTE_SYSTEM_TIP).keys(CTRL, Key::Enter),
        offer(AddMeasured, words::ADD_SYSTEM, words::ADD_SYSTEM_TIP),
        offer(ExportMeasured, words::EXPORT_SYSTEM, words::EXPORT_SYSTEM_TIP),
    ]);
    list.extend(EXAMPLES.iter().enumerate().map(|(number, example)| {
        let text = words::system_example(example.name);
        offer(SystemExample(number), text, words::SYSTEM_EXAMPLE_TIP)
    }));
    list.extend([
        offer(sheet(state::Sheet::Keys), words::KEYS, words::KEYS_TIP).keys(PLAIN, Key::Questionmark).menu(HELP, 1),
        offer(sheet(state::Sheet::About), words::ABOUT, words::ABOUT_TIP).menu(HELP, 5),
        offer(ClearStore, words::CLEAR_STORE, words::CLEAR_STORE_TIP),
        offer(Quit, words::QUIT, words::QUIT_TIP).keys(CTRL, Key::Q).menu(FILE, 20),
    ]);
    list
}

fn table_in(language: texts::Language) -> Vec<Offer> {
    let _speaking = speak(language);
    table()
}

/// Returns the table of all commands, in the current language.
pub fn offers() -> &'static [Offer] {
    static ENGLISH: LazyLock<Vec<Offer>> = LazyLock::new(|| table_in(texts::Language::English));
    static GERMAN: LazyLock<Vec<Offer>> = LazyLock::new(|| table_in(texts::Language::German));
    match language() {
        texts::Language::English => &ENGLISH,
        texts::Language::German => &GERMAN,
    }
}

/// Returns the commands that the command palette and the sheet of shortcuts list.
pub fn listed() -> impl Iterator<Item = &'static Offer> {
    offers().iter().filter(|offer| offer.listed)
}

/// Returns a shortcut as text: `Ctrl+Shift+Z`, `]`, `→`.
pub fn key_words(keys: &KeyboardShortcut) -> String {
    let key = match keys.logical_key {
        Key::ArrowLeft => "←",
        Key::ArrowRight => "→",
        Key::ArrowUp => "↑",
        Key::ArrowDown => "↓",
        Key::Enter => words::KEY_ENTER.get(),
        Key::Escape => words::KEY_ESCAPE.get(),
        Key::Delete => words::KEY_DELETE.get(),
        Key::PageUp => words::KEY_PAGE_UP.get(),
        Key::PageDown => words::KEY_PAGE_DOWN.get(),
        key => key.symbol_or_name(),
    };
    let modifiers = keys.modifiers;
    let held = [
        (modifiers.command || modifiers.ctrl, words::CTRL),
        (modifiers.alt, words::ALT),
        (modifiers.shift, words::SHIFT),
    ];
    let held: String = held.into_iter().filter(|(held, _)| *held).map(|(_, word)| word.get()).collect();
    format!("{held}{key}")
}

/// Returns the entry of a command in the table; `None` if it has none.
pub fn of(command: &Command) -> Option<&'static Offer> {
    offers().iter().find(|offer| offer.command == *command)
}

/// Whether a command opens a text field.
const fn opens_field(command: &Command) -> bool {
    use Command::{Open, OpenFolder, Palette, SaveScene, Search, Sheet};
    matches!(command, Open | OpenFolder | Palette | SaveScene | Search | Sheet(Some(state::Sheet::Export)))
}

/// Returns the commands whose keys were pressed in this frame. Shortcuts without Ctrl are ignored while a widget has
/// the keyboard focus, e.g. the arrow keys in an open list.
pub fn pressed(ctx: &egui::Context) -> Vec<Command> {
    let typing = ctx.memory(|memory| memory.focused().is_some()) || egui::Popup::is_any_open(ctx);
    // The editor of system files has a history of its own.
    let editing = ctx.memory(|memory| memory.focused()) == Some(egui::Id::unique(SYSTEM_EDITOR));
    let mut list: Vec<(KeyboardShortcut, &Command)> = offers()
        .iter()
        .filter_map(|offer| Some((offer.keys?, &offer.command)))
        // Half of the desktops know it by this key.
        .chain([(KeyboardShortcut::new(CTRL, Key::Y), &Command::Redo)])
        .filter(|(keys, _)| !typing || keys.modifiers.command)
        .filter(|(_, command)| !(editing && matches!(command, Command::Undo | Command::Redo)))
        .collect();
    // Egui matches Ctrl+Z also while Shift is down: ask for the longer combination first.
    list.sort_by_key(|(keys, _)| std::cmp::Reverse((keys.modifiers.command, keys.modifiers.shift)));
    ctx.input_mut(|input| {
        let offered = |key, held: Modifiers| {
            list.iter().any(|(keys, _)| keys.logical_key == key && held.matches_logically(keys.modifiers))
        };
        input.events.iter_mut().for_each(|event| digit_by_place(event, offered));
        let mut pressed: Vec<(KeyboardShortcut, &Command)> =
            list.into_iter().filter(|(keys, _)| input.consume_shortcut(keys)).collect();
        // What is typed after it, in a frame that takes its time, is meant for the field that it opens.
        if pressed.iter().any(|(_, command)| opens_field(command)) {
            pressed.retain(|(keys, _)| keys.modifiers.command);
        }
        let mut commands: Vec<Command> = pressed.into_iter().map(|(_, command)| command.clone()).collect();
        // Where the plus is above the equals sign, nobody holds Shift for it.
        if input.consume_key(CTRL, Key::Equals) {
            commands.push(Command::TextSize(Size::Larger));
        }
        commands
    })
}

/// Replaces a key of the digit row by its digit if the keyboard layout has a sign there without Shift (e.g. in France)
/// that is not itself a shortcut (`offered`). Other keys with digits are unchanged, since the number pad also moves the
/// cursor.
fn digit_by_place(event: &mut Event, offered: impl Fn(Key, Modifiers) -> bool) {
    let Event::Key { key, physical_key: Some(place), modifiers, .. } = event else { return };
    let sign = matches!(key, Key::Quote | Key::Minus | Key::Plus | Key::Exclamationmark);
    let digit = (Key::Num0..=Key::Num9).contains(place);
    if sign && digit && !modifiers.shift && !offered(*key, *modifiers) {
        *key = *place;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_where_they_stand_on_the_keyboard() {
        let pressed_at = |key: Key, place: Key, modifiers: Modifiers| {
            let ctx = egui::Context::default();
            let event = Event::Key { key, physical_key: Some(place), pressed: true, repeat: false, modifiers };
            let input = egui::RawInput { events: vec![event], ..Default::default() };
            let mut commands = Vec::new();
            // Nothing is painted here.
            ctx.run_ui(input, |ui| commands = pressed(ui.ctx())).textures_delta.clear();
            commands
        };
        let fourth = pressed_at(Key::Num4, Key::Num4, Modifiers::NONE);
        assert!(matches!(fourth[..], [Command::Maximise(Some(_))]), "{fourth:?}");
        // France, where ' is on the key of the 4; with Shift it is a 4 itself.
        assert_eq!(pressed_at(Key::Quote, Key::Num4, Modifiers::NONE), fourth);
        // A minus with Ctrl is something else wherever it stands, and the number pad's 4 moves to the left.
        let smaller = pressed_at(Key::Minus, Key::Minus, Modifiers::COMMAND);
        assert_eq!(pressed_at(Key::Minus, Key::Num6, Modifiers::COMMAND), smaller);
        assert_ne!(pressed_at(Key::ArrowLeft, Key::Num4, Modifiers::NONE), fourth);
    }

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
            let last = if last.ends_with('+') { "+" } else { last.rsplit('+').next().unwrap() };
            let printed = |key: &str| ["Enter", "Escape", "Delete", "F2", "F6", "PageUp", "PageDown"].contains(&key);
            assert!(last.chars().count() == 1 || printed(last), "{last}");
        }
    }

    #[test]
    fn no_two_commands_share_their_keys_or_words() {
        for spoken in texts::Language::ALL {
            let _speaking = speak(spoken);
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

    #[test]
    fn keys_are_named_as_on_a_german_keyboard() {
        let _german = speak(texts::Language::German);
        let words = |command: Command| key_words(&of(&command).unwrap().keys.unwrap());
        assert_eq!(words(Command::Redo), "Strg+Umsch+Z");
        assert_eq!(words(Command::MeasureSystem), "Strg+Eingabe");
    }
}
