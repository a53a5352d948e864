//! The menu bar, made from the table of commands.

use super::fields::button;
use crate::app::command::Command;
use crate::app::offer::{MENUS, Offer, Place, offers};
use crate::app::state::State;
use crate::texts::Text;
use egui::{MenuBar, Rect, Ui};

/// Draws one menu entry with keyboard shortcut and tooltip.
fn entry(ui: &mut Ui, offer: &Offer, commands: &mut Vec<Command>) {
    if ui.add(button(offer)).on_hover_text(offer.tip).clicked() {
        commands.push(offer.command.clone());
        ui.close();
    }
}

/// Returns the entries of a menu in their order, each with its position.
fn entries(menu: Text) -> Vec<(Place, &'static Offer)> {
    let placed = offers().iter().filter_map(|offer| Some((offer.place?, offer)));
    let mut list: Vec<_> = placed.filter(|(place, _)| place.menu == menu).collect();
    list.sort_by_key(|(place, _)| place.rank);
    list
}

/// Draws one menu with its submenus.
fn show_menu(ui: &mut Ui, menu: Text, commands: &mut Vec<Command>) {
    let list = entries(menu);
    let mut section = 0;
    for group in list.chunk_by(|a, b| a.0 == b.0) {
        let place = group[0].0;
        if place.rank / 10 != section {
            section = place.rank / 10;
            ui.separator();
        }
        let mut all = |ui: &mut Ui| group.iter().for_each(|(_, offer)| entry(ui, offer, commands));
        match place.within {
            Some(name) => drop(ui.menu_button(name, all)),
            None => all(ui),
        }
    }
}

/// Draws the menu bar. Returns the rectangle of each menu's title on the screen.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Vec<(Text, Rect)> {
    let bar = MenuBar::new().ui(ui, |ui| {
        let menus = MENUS.map(|menu| (menu, ui.menu_button(menu, |ui| show_menu(ui, menu, commands)).response.rect));
        ui.separator();
        // The selection in words: also where the window has no title bar.
        let words = crate::app::title::title(state);
        ui.add(egui::Label::new(words.trim_start_matches("cfs – ")).truncate());
        menus.to_vec()
    });
    bar.inner
}
