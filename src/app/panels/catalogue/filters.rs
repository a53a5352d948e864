//! Filters of the catalogue: facets as menus, chosen values as chips, the order of the list; and suggestions of filters
//! to remove if nothing is found.

use crate::app::catalogue::shelf::{Found, Query};
use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::state::State;
use crate::catalogue::{Facet, Figure, Filter, Origin, Sort};
use crate::drawing::ticks::number;
use crate::texts::{Text, catalogue as text};
use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{ComboBox, PopupCloseBehavior, RichText, ScrollArea, Ui, vec2};

/// Draws the menu of a facet, which stays open while its values are chosen. `chosen`: whether a value of the facet is
/// chosen.
fn menu(ui: &mut Ui, [title, facet]: [Text; 2], chosen: bool, values: impl FnOnce(&mut Ui)) {
    let title =
        if chosen { RichText::new(title.get()).color(theme::palette(ui).accent) } else { RichText::new(title.get()) };
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) = MenuButton::new(title).config(config).ui(ui, |ui| {
        ui.set_min_width(170.0);
        ScrollArea::vertical().max_height(380.0).show(ui, values);
    });
    button.accessible_name(text::filter_by(facet));
}

/// Draws a value of a facet with the number of products that would be found if it were chosen. Returns whether it was
/// clicked.
fn value(ui: &mut Ui, chosen: bool, words: &str, count: usize) -> bool {
    // A value that would find nothing is shown, unlike one that is missing, and can be unchosen while it is chosen.
    ui.add_enabled(chosen || count > 0, egui::Button::selectable(chosen, format!("{words}  {count}"))).clicked()
}

fn in_or_out(list: &mut Vec<String>, value: &str) {
    if list.iter().any(|one| one == value) {
        list.retain(|one| one != value);
    } else {
        list.push(value.to_owned());
    }
}

fn list(ui: &mut Ui, facets: &[Facet], chosen: &mut Vec<String>, words: fn(&str) -> String) {
    if facets.is_empty() {
        ui.weak(text::NONE_SPECIFIED.get());
    }
    for facet in facets {
        let words = if facet.value.is_empty() { text::NOT_SPECIFIED.into() } else { words(&facet.value) };
        if value(ui, chosen.contains(&facet.value), &words, facet.count) {
            in_or_out(chosen, &facet.value);
        }
    }
}

/// Draws two opposite values of a facet, of which at most one may be chosen (`Some(true)`: the first); `None`: products
/// with either value are listed.
fn either(ui: &mut Ui, words: [Text; 2], counts: [usize; 2], chosen: &mut Option<bool>) {
    for (yes, (words, count)) in [true, false].into_iter().zip(words.into_iter().zip(counts)) {
        if value(ui, *chosen == Some(yes), words.get(), count) {
            *chosen = (*chosen != Some(yes)).then_some(yes);
        }
    }
}

fn figures(ui: &mut Ui, found: &Found, query: &mut Query) {
    for (figure, counts) in &found.facets.ranges {
        ui.label(RichText::new(figure.words()).strong());
        for (place, count) in counts.iter().enumerate() {
            let range = figure.range(place);
            let chosen = query.ranges.contains(&range);
            if value(ui, chosen, &range.words(), *count) {
                if chosen {
                    query.ranges.retain(|one| *one != range);
                } else {
                    query.ranges.push(range);
                }
            }
        }
        ui.add_space(4.0);
    }
}

/// Draws the facets as one or two lines of menus.
pub(super) fn facets(ui: &mut Ui, state: &State, query: &mut Query) {
    let found = &*state.found;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        let starred = query.favourite == Some(true);
        let star = ui.selectable_label(starred, format!("★ {}", found.facets.favourites));
        if star.on_hover_text(text::STARRED_ALONE).accessible_name(text::STARRED_ALONE).clicked() {
            query.favourite = (!starred).then_some(true);
        }
        let recent = ui.selectable_label(query.recent, format!("{}  {}", text::RECENT, found.facets.recent));
        if recent.on_hover_text(text::RECENT_ALONE).accessible_name(text::RECENT_ALONE).clicked() {
            query.recent = !query.recent;
        }
        menu(ui, [text::KIND, text::KIND_FACET], query.has(Filter::Kinds), |ui| {
            list(ui, &found.facets.kinds, &mut query.kinds, |kind| kind.replace('-', " "));
        });
        menu(ui, [text::MAKER, text::MAKER_FACET], query.has(Filter::Manufacturers), |ui| {
            list(ui, &found.facets.manufacturers, &mut query.manufacturers, str::to_owned);
        });
        menu(ui, [text::MOVES, text::MOVES_FACET], query.has(Filter::Moving), |ui| {
            either(ui, [text::MOVING, text::FIXED], found.facets.moving, &mut query.moving);
        });
        menu(ui, [text::DATA, text::DATA_FACET], query.has(Filter::Origin) || query.has(Filter::Builtin), |ui| {
            for facet in &found.facets.origins {
                let origin = Origin::from_word(&facet.value);
                let words = if origin == Origin::Unknown { text::NOT_SPECIFIED } else { origin.words() };
                if value(ui, query.origin == Some(origin), words.get(), facet.count) {
                    query.origin = (query.origin != Some(origin)).then_some(origin);
                }
            }
            ui.separator();
            either(ui, [text::BUILT_IN, text::YOUR_OWN], [found.facets.builtin, found.facets.own], &mut query.builtin);
        });
        let ranges = Figure::ALL.into_iter().any(|figure| query.has(Filter::Range(figure)));
        menu(ui, [text::FIGURES, text::FIGURES_FACET], ranges, |ui| figures(ui, found, query));
        if !found.facets.collections.is_empty() {
            menu(ui, [text::COLLECTIONS, text::COLLECTIONS_FACET], query.has(Filter::Collections), |ui| {
                list(ui, &found.facets.collections, &mut query.collections, str::to_owned);
            });
        }
        menu(ui, [text::TAGS, text::TAGS_FACET], query.has(Filter::Tags), |ui| {
            list(ui, &found.facets.tags, &mut query.tags, str::to_owned);
        });
    });
    chosen(ui, query);
}

/// Draws the chosen values of facets as chips; a click on a chip removes its value.
fn chosen(ui: &mut Ui, query: &mut Query) {
    let filters: Vec<Filter> = query.filters().collect();
    if filters.is_empty() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        for filter in &filters {
            let words = query.words_of(*filter);
            let chip = egui::Button::new(format!("{words} ×")).fill(theme::palette(ui).chosen).truncate();
            let chip = ui.add(chip).on_hover_text(text::takes_out(&words));
            if chip.accessible_name(text::without(&words)).clicked() {
                *query = query.without(*filter);
            }
        }
        if filters.len() > 1 && ui.button(text::CLEAR).on_hover_text(text::CLEAR_ALL).clicked() {
            *query = query.words_alone();
        }
    });
}

/// Draws the number of products found, and the choice of their order.
pub(super) fn order(ui: &mut Ui, state: &State, query: &mut Query) {
    let found = &*state.found;
    ui.horizontal(|ui| {
        let (shown, total) = (found.entries.len(), found.total);
        // Large numbers have no room beside the order.
        let count =
            if total < 1000 { text::count_of(shown, total) } else { number(shown as f64, shown.to_string().len()) };
        ui.weak(count).on_hover_text(text::products_fit(shown, total));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let (arrow, name) = if query.descending { ("↓", text::FALLING) } else { ("↑", text::RISING) };
            let tip = text::turn_round(name);
            // The best match first is neither.
            let by_match = query.sort == Sort::Match;
            let turn = ui.add_enabled(!by_match, egui::Button::new(arrow)).on_hover_text(tip).accessible_name(name);
            if turn.clicked() {
                query.descending = !query.descending;
            }
            let known = |sort: &Sort| match sort {
                Sort::By(figure) => found.facets.ranges.iter().any(|(one, _)| one == figure),
                _ => true,
            };
            let combo = ComboBox::from_id_salt("order").width(118.0).selected_text(query.sort.words());
            let combo = combo.show_ui(ui, |ui| {
                for sort in Sort::all().filter(known) {
                    if ui.selectable_label(query.sort == sort, sort.words()).clicked() {
                        query.sort = sort;
                        // Who orders by a number looks for the greatest first.
                        query.descending = matches!(sort, Sort::By(_) | Sort::States);
                    }
                }
            });
            combo.response.on_hover_text(text::ORDER_TIP).accessible_name(text::ORDER);
        });
    });
}

/// Draws notes on the search: products that were restored or are not listed, and searched words that were replaced by
/// similar ones.
pub(super) fn notes(ui: &mut Ui, found: &Found) {
    if !found.restored.is_empty() {
        ui.colored_label(theme::palette(ui).warning, text::restored(found.restored.join(", ")));
    }
    if !found.damaged.is_empty() {
        ui.colored_label(theme::palette(ui).error, text::not_listed(found.damaged.join(", ")));
    }
    for (typed, read_as) in &found.read_as {
        ui.weak(text::read_as(typed, read_as));
    }
}

/// Draws a chip with the name of the product whose similar products are listed; a click on it returns to the ordinary
/// search.
pub(super) fn like(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(key) = &state.query.like else { return };
    let found = state.found.like.as_ref().filter(|like| like.key == *key);
    let name = found.map_or(key, |like| &like.name);
    let chip = egui::Button::new(text::like(name)).fill(theme::palette(ui).chosen).truncate();
    let tip = text::like_tip(name);
    if ui.add(chip).on_hover_text(tip).accessible_name(text::no_longer_like(name)).clicked() {
        commands.push(Command::Find(Query { like: None, ..state.query.clone() }));
    }
}

/// Draws buttons that each remove a filter, if no product was found.
pub(super) fn nothing(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let (found, query) = (&*state.found, &state.query);
    ui.add_space(16.0);
    ui.vertical_centered(|ui| {
        if found.total == 0 {
            ui.label(text::NO_PRODUCT_YET);
            return;
        }
        let filtered = query.filters().next().is_some();
        let words = query.has(Filter::Words);
        ui.label(match (words, filtered) {
            (true, false) => text::NOT_ALL_WORDS,
            (true, true) => text::NOT_WORDS_AND_FILTERS,
            (false, _) => text::NOT_ALL_FILTERS,
        });
        let mut offered = found.without.iter().filter(|(filter, _)| query.has(*filter)).peekable();
        // One by one where that helps; else all filters at once.
        if offered.peek().is_none() && filtered && words && ui.button(text::CLEAR_ALL).clicked() {
            commands.push(Command::Find(query.words_alone()));
        }
        for (filter, count) in offered.take(6) {
            let what = query.words_of(*filter);
            let words = if *count == 1 { text::one_without(&what) } else { text::more_without(count, &what) };
            if ui.add(egui::Button::new(&words).truncate()).on_hover_text(&words).clicked() {
                commands.push(Command::Find(query.without(*filter)));
            }
        }
        if ui.button(text::SHOW_ALL).clicked() {
            commands.push(Command::Find(Query::default()));
        }
    });
}
