//! What narrows the list: facets folded into menus, what is chosen as chips, the order; and what to give up where nothing
//! is found.

use crate::app::command::Command;
use crate::app::shelf::{Found, Query};
use crate::app::state::State;
use crate::app::theme;
use crate::catalogue::{Facet, Figure, Filter, Origin, Sort};
use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{ComboBox, PopupCloseBehavior, RichText, ScrollArea, Ui, vec2};

/// What a facet calls an empty value.
const NOT_TOLD: &str = "not told";

/// A menu of values that stays open while they are chosen.
fn menu(ui: &mut Ui, title: &str, chosen: bool, values: impl FnOnce(&mut Ui)) {
    let text = if chosen { RichText::new(title).color(theme::palette(ui).accent) } else { RichText::new(title) };
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) = MenuButton::new(text).config(config).ui(ui, |ui| {
        ui.set_min_width(170.0);
        ScrollArea::vertical().max_height(380.0).show(ui, values);
    });
    button.accessible_name(format!("Filter by {}", title.to_lowercase()));
}

/// A value with what choosing it would find; was it clicked?
fn value(ui: &mut Ui, chosen: bool, words: &str, count: usize) -> bool {
    // One that would find nothing can be told from one that is missing, and taken back when it is chosen.
    ui.add_enabled(chosen || count > 0, egui::Button::selectable(chosen, format!("{words}  {count}"))).clicked()
}

fn in_or_out(list: &mut Vec<String>, value: &str) {
    if list.iter().any(|one| one == value) {
        list.retain(|one| one != value);
    } else {
        list.push(value.to_owned());
    }
}

fn list(ui: &mut Ui, facets: &[Facet], chosen: &mut Vec<String>) {
    if facets.is_empty() {
        ui.weak("No product tells it");
    }
    for facet in facets {
        let words = if facet.value.is_empty() { NOT_TOLD.to_owned() } else { facet.value.replace('-', " ") };
        if value(ui, chosen.contains(&facet.value), &words, facet.count) {
            in_or_out(chosen, &facet.value);
        }
    }
}

/// A pair of which one, the other or both may be asked for.
fn either(ui: &mut Ui, words: [&str; 2], counts: [usize; 2], chosen: &mut Option<bool>) {
    for (yes, (words, count)) in [true, false].into_iter().zip(words.into_iter().zip(counts)) {
        if value(ui, *chosen == Some(yes), words, count) {
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

/// The facets, folded: a line or two of menus.
pub(super) fn facets(ui: &mut Ui, state: &State, query: &mut Query) {
    let found = &*state.found;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        let starred = query.favourite == Some(true);
        let star = ui.selectable_label(starred, format!("★ {}", found.facets.favourites));
        if star.on_hover_text("Starred products alone").accessible_name("Starred products alone").clicked() {
            query.favourite = (!starred).then_some(true);
        }
        menu(ui, "Kind", query.has(Filter::Kinds), |ui| list(ui, &found.facets.kinds, &mut query.kinds));
        menu(ui, "Maker", query.has(Filter::Manufacturers), |ui| {
            list(ui, &found.facets.manufacturers, &mut query.manufacturers);
        });
        menu(ui, "Moves", query.has(Filter::Moving), |ui| {
            either(ui, ["moving", "fixed"], found.facets.moving, &mut query.moving);
        });
        menu(ui, "Data", query.has(Filter::Origin) || query.has(Filter::Builtin), |ui| {
            for facet in &found.facets.origins {
                let origin = Origin::from_word(&facet.value);
                let words = if origin == Origin::Unknown { NOT_TOLD } else { facet.value.as_str() };
                if value(ui, query.origin == Some(origin), words, facet.count) {
                    query.origin = (query.origin != Some(origin)).then_some(origin);
                }
            }
            ui.separator();
            either(ui, ["built in", "your own"], [found.facets.builtin, found.facets.own], &mut query.builtin);
        });
        let ranges = Figure::ALL.into_iter().any(|figure| query.has(Filter::Range(figure)));
        menu(ui, "Figures", ranges, |ui| figures(ui, found, query));
        menu(ui, "Tags", query.has(Filter::Tags), |ui| list(ui, &found.facets.tags, &mut query.tags));
    });
    chosen(ui, query);
}

/// What is chosen: each goes by a click.
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
            let chip = ui.add(chip).on_hover_text(format!("{words}: a click takes this filter out"));
            if chip.accessible_name(format!("Without {words}")).clicked() {
                *query = query.without(*filter);
            }
        }
        if filters.len() > 1 && ui.button("Clear").on_hover_text("Take all filters out").clicked() {
            *query = query.words_alone();
        }
    });
}

/// How many there are, and their order.
pub(super) fn order(ui: &mut Ui, state: &State, query: &mut Query) {
    let found = &*state.found;
    ui.horizontal(|ui| {
        ui.weak(format!("{} of {}", found.entries.len(), found.total)).on_hover_text(format!(
            "{} of {} products fit",
            found.entries.len(),
            found.total
        ));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let (arrow, name) = if query.descending { ("↓", "Falling order") } else { ("↑", "Rising order") };
            let tip = format!("{name}; a click turns it round");
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
            combo.response.on_hover_text("Order of the list").accessible_name("Order");
        });
    });
}

/// Words that were read as others.
pub(super) fn read_as(ui: &mut Ui, found: &Found) {
    for (typed, read_as) in &found.read_as {
        ui.weak(format!("No product has “{typed}”: read as “{read_as}”"));
    }
}

/// What the list is like, until a click.
pub(super) fn like(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(key) = &state.query.like else { return };
    let found = state.found.like.as_ref().filter(|like| like.key == *key);
    let name = found.map_or(key, |like| &like.name);
    let chip = egui::Button::new(format!("Like {name} ×")).fill(theme::palette(ui).chosen).truncate();
    let tip = format!(
        "Products by what they do to light, nearest to {name} first: differences of τ, its profile, light to the ceiling, \
         sun blocked and view, all as shares of the light that arrives. A click goes back to the list"
    );
    if ui.add(chip).on_hover_text(tip).accessible_name(format!("No longer like {name}")).clicked() {
        commands.push(Command::Find(Query { like: None, ..state.query.clone() }));
    }
}

/// Nothing was found: what to give up, one click each.
pub(super) fn nothing(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let (found, query) = (&*state.found, &state.query);
    ui.add_space(16.0);
    ui.vertical_centered(|ui| {
        if found.total == 0 {
            ui.label("The catalogue holds no product yet: open a file to put one in.");
            return;
        }
        let filtered = query.filters().next().is_some();
        let words = query.has(Filter::Words);
        ui.label(match (words, filtered) {
            (true, false) => "Nothing has all these words.",
            (true, true) => "Nothing has all these words and passes the filters.",
            (false, _) => "Nothing passes all the filters.",
        });
        let mut offered = found.without.iter().filter(|(filter, _)| query.has(*filter)).peekable();
        // One by one where that helps; else all filters at once.
        if offered.peek().is_none() && filtered && words && ui.button("Take all filters out").clicked() {
            commands.push(Command::Find(query.words_alone()));
        }
        for (filter, count) in offered.take(6) {
            let products = if *count == 1 { "1 product".to_owned() } else { format!("{count} products") };
            let what = query.words_of(*filter);
            let text = format!("{products} without “{what}”");
            if ui.add(egui::Button::new(&text).truncate()).on_hover_text(&text).clicked() {
                commands.push(Command::Find(query.without(*filter)));
            }
        }
        if ui.button("Show all").clicked() {
            commands.push(Command::Find(Query::default()));
        }
    });
}
