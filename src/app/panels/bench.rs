//! The tile area: tiles arranged by its layout, or one tile that fills it.
//!
//! Dragging the head of a tile docks it elsewhere or makes it a tab; a double click on the head lets the tile fill the
//! tile area. While the head has the keyboard focus, arrow keys move the focus to the tile on that side, with Shift
//! they exchange the two tiles, with Alt they make the tile wider, narrower, higher or lower; Enter lets it fill the
//! tile area.

use crate::app::command::Command;
use crate::app::display::theme::{self, TILE_GAP};
use crate::app::offer;
use crate::app::state::Tile;
use crate::app::tiles::arrange::{Arrange, Way};
use crate::app::tiles::{TILES, TileInput};
use crate::app::window::App;
use crate::texts::tiles as say;
use egui::{Color32, EventFilter, Key, Modifiers, Rect, Response, Sense, Stroke, Ui, UiBuilder, Visuals, vec2};
use egui_tiles::{Behavior, EditAction, ResizeState, TabState, TileId, Tiles, Tree, UiResponse};

/// Minimum width and height to which a tile can be resized. \[points\]
const LEAST: f32 = 120.0;

/// Draws the tile area.
pub fn show(ui: &mut Ui, app: &mut App, commands: &mut Vec<Command>) {
    if let Err(problem) = app.shell.bench.follow(app.shell.state.settings.layout.as_ref()) {
        app.shell.state.settings.layout = None;
        app.shell.toasts.warning(say::layout_unreadable(problem));
    }
    let mut tree = app.shell.bench.begin_frame();
    let whole = ui.available_rect_before_wrap();
    if let Some(tile) = app.shell.state.maximised {
        frame(ui, whole, tile, app, commands);
        app.shell.bench.end_frame(tree, false);
        return;
    }
    let spacing = tab_spacing(ui, &tree);
    let mut behaviour = Docking { app, commands, edited: false, spacing };
    tree.ui(&mut behaviour, ui);
    let edited = behaviour.edited;
    if let Some(text) = app.shell.bench.end_frame(tree, edited) {
        app.shell.state.settings.layout = Some(text);
    }
}

/// Returns the free space on each side of a tab's name \[points\]: less if not all names of a tab bar would fit.
fn tab_spacing(ui: &Ui, tree: &Tree<Tile>) -> f32 {
    const SPACING: std::ops::RangeInclusive<f32> = 2.0..=10.0;
    let name = |id: &TileId| match tree.tiles.get(*id) {
        Some(egui_tiles::Tile::Pane(tile)) => tile.name.get(),
        _ => "",
    };
    let width = |text: &str| {
        ui.painter().layout_no_wrap(text.to_owned(), egui::FontId::proportional(13.0), Color32::WHITE).size().x
    };
    let bars = tree.tiles.iter().filter_map(|(id, tile)| match tile {
        egui_tiles::Tile::Container(egui_tiles::Container::Tabs(tabs)) => Some((tree.tiles.rect(*id)?, tabs)),
        _ => None,
    });
    let room = bars.map(|(rect, tabs)| {
        let names: f32 = tabs.children.iter().map(|id| width(name(id))).sum();
        (rect.width() - names - 2.0) / (2.0 * tabs.children.len().max(1) as f32)
    });
    room.fold(*SPACING.end(), f32::min).max(*SPACING.start())
}

/// Drawing and behaviour of docked tiles for egui_tiles.
struct Docking<'a> {
    app: &'a mut App,
    commands: &'a mut Vec<Command>,
    edited: bool,
    /// Free space on each side of a tab's name. \[points\]
    spacing: f32,
}

impl Behavior<Tile> for Docking<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _id: TileId, tile: &mut Tile) -> UiResponse {
        let rect = ui.max_rect();
        let dragged = frame(ui, rect, *tile, self.app, self.commands);
        if dragged { UiResponse::DragStarted } else { UiResponse::None }
    }

    fn tab_title_for_pane(&mut self, tile: &Tile) -> egui::WidgetText {
        egui::RichText::new(tile.name.get()).size(13.0).into()
    }

    fn gap_width(&self, _style: &egui::Style) -> f32 {
        TILE_GAP
    }

    fn min_size(&self) -> f32 {
        LEAST
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        26.0
    }

    fn tab_title_spacing(&self, _visuals: &Visuals) -> f32 {
        self.spacing
    }

    fn resize_stroke(&self, style: &egui::Style, state: ResizeState) -> Stroke {
        let palette = theme::palette_of(&style.visuals);
        match state {
            ResizeState::Idle => Stroke::NONE,
            ResizeState::Hovering => Stroke::new(2.0, palette.weak),
            ResizeState::Dragging => Stroke::new(2.0, palette.accent),
        }
    }

    fn tab_bar_color(&self, visuals: &Visuals) -> Color32 {
        theme::palette_of(visuals).ground
    }

    fn tab_bg_color(&self, visuals: &Visuals, _: &Tiles<Tile>, _: TileId, state: &TabState) -> Color32 {
        let palette = theme::palette_of(visuals);
        if state.active { palette.surface } else { palette.raised }
    }

    fn tab_outline_stroke(&self, visuals: &Visuals, _: &Tiles<Tile>, _: TileId, _: &TabState) -> Stroke {
        Stroke::new(1.0, theme::palette_of(visuals).line)
    }

    fn tab_text_color(&self, visuals: &Visuals, _: &Tiles<Tile>, _: TileId, state: &TabState) -> Color32 {
        let palette = theme::palette_of(visuals);
        if state.active { palette.text } else { palette.weak }
    }

    fn on_edit(&mut self, _action: EditAction) {
        self.edited = true;
    }
}

/// Draws a tile with its background and head. Returns `true` in the frame in which a drag of the tile starts.
fn frame(ui: &mut Ui, rect: Rect, tile: Tile, app: &mut App, commands: &mut Vec<Command>) -> bool {
    let palette = theme::palette(ui);
    app.shell.bench.place(tile, rect);
    let head = Rect::from_min_size(rect.min, vec2((rect.width() * 0.5).min(120.0), 26.0));
    let response = ui.interact(head, egui::Id::unique(("tile", tile.title)), Sense::click_and_drag());
    let line = if response.has_focus() { Stroke::new(2.0, palette.accent) } else { Stroke::new(1.0, palette.line) };
    ui.painter().rect(rect, 6, palette.surface, line, egui::StrokeKind::Inside);
    let response = response.on_hover_text(say::head_tip(TILES.len()));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, say::tile_named(tile.name)));
    response.context_menu(|ui| menu(ui, tile, commands));
    app.shell.bench.follow_head(tile, &response);
    let fill = Command::Maximise(if app.shell.state.maximised.is_some() { None } else { Some(tile) });
    if response.double_clicked() {
        commands.push(fill.clone());
    }
    keys(ui, &response, &fill, commands);
    // Numbers wait for what is being computed: what is written is of what its name says.
    let mut numbers = app.export.requests().wants(tile) && app.is_complete();
    let (state, results) = app.compare.shown(&app.shell.state, &app.shell.results);
    if numbers && app.shell.bench.is_old(tile, state, results) {
        numbers = false;
        app.export.requests().refuse();
        app.shell.toasts.error(say::not_written(tile.name));
    }
    let (state, results) = app.compare.shown(&app.shell.state, &app.shell.results);
    let seen = TileInput {
        state,
        results,
        busy: &|lane| app.shell.jobs.busy(lane),
        done: &|lane| app.shell.jobs.fraction(lane),
        // The other one is drawn on the scales of the first: equal colours stay equal values.
        held: app.shell.state.compare.swapped.is_some() || ui.input(|input| input.pointer.any_down()),
        numbers,
        scale: None,
    };
    let builder = UiBuilder::new().max_rect(rect.shrink(2.0)).id_salt(tile.title);
    let numbers = ui.scope_builder(builder, |ui| app.shell.bench.show(ui, tile, &seen, commands)).inner;
    if let Some(text) = numbers {
        app.export.requests().take(ui.ctx(), text);
    }
    response.drag_started() && app.shell.state.maximised.is_none()
}

/// Draws the menu of a tile.
fn menu(ui: &mut Ui, tile: Tile, commands: &mut Vec<Command>) {
    let list = [Command::ExportTile(tile), Command::CopyTile(tile), Command::CopyPicture(tile), Command::CopyValue];
    for command in list {
        let Some(offer) = offer::of(&command) else { continue };
        if ui.button(&offer.text).on_hover_text(offer.tip).clicked() {
            commands.push(command);
            ui.close();
        }
    }
    ui.separator();
    for what in [Arrange::Join, Arrange::Split] {
        let Some(offer) = offer::of(&Command::Arrange(what)) else { continue };
        if ui.button(&offer.text).on_hover_text(offer.tip).clicked() {
            commands.push(Command::Arrange(what));
            ui.close();
        }
    }
}

/// Executes the keys of this frame if the head of a tile has the keyboard focus.
fn keys(ui: &Ui, head: &Response, fill: &Command, commands: &mut Vec<Command>) {
    if !head.has_focus() {
        return;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(head.id, arrows));
    let ways = [
        (Key::ArrowLeft, Way::Left, Arrange::Width(false)),
        (Key::ArrowRight, Way::Right, Arrange::Width(true)),
        (Key::ArrowUp, Way::Up, Arrange::Height(true)),
        (Key::ArrowDown, Way::Down, Arrange::Height(false)),
    ];
    ui.input_mut(|input| {
        for (key, way, size) in ways {
            // The longer combinations first: egui matches a plain key also while Shift is down.
            let asked = [
                (Modifiers::ALT, size),
                (Modifiers::SHIFT, Arrange::Move(way)),
                (Modifiers::NONE, Arrange::FocusOn(way)),
            ];
            let what = asked.into_iter().find(|(modifiers, _)| input.consume_key(*modifiers, key));
            commands.extend(what.map(|(_, what)| Command::Arrange(what)));
        }
        for (modifiers, step) in [(Modifiers::SHIFT, -1), (Modifiers::NONE, 1)] {
            if input.consume_key(modifiers, Key::F6) {
                commands.push(Command::Arrange(Arrange::Focus(step)));
            }
        }
        if input.consume_key(Modifiers::NONE, Key::Enter) {
            commands.push(fill.clone());
        }
    });
}
