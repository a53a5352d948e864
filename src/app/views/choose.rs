//! Which system for this façade: products with their objectives and what they are worth, as a table with bars and as a plot
//! of two objectives against each other; in words why one is before another.
//!
//! A view of figures that others find: it ranks nothing itself.

mod input;
mod plot;
mod table;

pub use input::{Action, ChooseRow, ChooseRows, Input, Objective, rank_words};

use crate::app::paint::tile::{self, Words};
use crate::texts::choose as say;
use egui::{Checkbox, ComboBox, Slider, TextEdit, Ui};
use std::ops::RangeInclusive;

/// What the tile itself remembers.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Words that names have to hold.
    pub words: String,
    /// Show only what no other is better than in every objective?
    pub front_only: bool,
    /// Show what is excluded too?
    pub excluded: bool,
    /// The plot instead of the table?
    pub plot: bool,
    /// The two objectives of the plot.
    pub axes: [usize; 2],
    /// Key of the product whose why is told.
    pub chosen: Option<String>,
}

/// A weight is at most so much.
const WEIGHTS: RangeInclusive<f64> = 0.0..=5.0;

impl State {
    /// Does a row pass the filters?
    pub fn shows(&self, row: &ChooseRow) -> bool {
        let words = self.words.to_lowercase();
        let label = row.label.to_lowercase();
        (row.excluded.is_none() || self.excluded)
            && (row.front || !self.front_only)
            && words.split_whitespace().all(|word| label.contains(word))
    }
}

/// Draws the tile into all the space of `ui`.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = Vec::new();
    let mut weights = Vec::new();
    let rows = input.rows;
    let subtitle = say::done(rows.done.0, rows.done.1);
    let words = Words {
        title: say::CHOOSE.get(),
        subtitle: &subtitle,
        help: say::CHOOSE_ABOUT.get(),
        empty: rows.rows.is_empty().then_some(say::NOTHING_YET.get()),
        controls_width: 420.0,
    };
    let last = rows.objectives.len().saturating_sub(1);
    state.axes = state.axes.map(|axis| axis.min(last));
    if state.axes[0] == state.axes[1] && last > 0 {
        state.axes[1] = if state.axes[0] == 0 { 1 } else { 0 };
    }
    let axes = state.axes;
    let State { words: typed, front_only, excluded, plot: as_plot, axes: chosen_axes, .. } = state;
    let mut look = (typed.clone(), *front_only, *excluded, *as_plot, axes);
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.add(TextEdit::singleline(&mut look.0).hint_text(say::FILTER.get()).desired_width(90.0));
            ui.add(Checkbox::new(&mut look.1, say::FRONT_ONLY.get())).on_hover_text(say::FRONT_TIP);
            ui.add(Checkbox::new(&mut look.2, say::EXCLUDED_TOO.get())).on_hover_text(say::EXCLUDED_TIP);
            ui.toggle_value(&mut look.3, say::PLOT).on_hover_text(say::PLOT_TIP);
            ui.menu_button(say::WEIGHTS.get(), |ui| {
                for (k, one) in rows.objectives.iter().enumerate() {
                    let mut weight = one.weight;
                    if ui.add(Slider::new(&mut weight, WEIGHTS).text(&one.name).max_decimals(1)).changed() {
                        weights.push(Action::Weight(k, weight));
                    }
                }
            });
            if look.3 {
                axis(ui, rows, say::ACROSS, &mut look.4[0]);
                axis(ui, rows, say::UP, &mut look.4[1]);
            }
        },
        |ui, rect| {
            let filter =
                State { words: typed.clone(), front_only: *front_only, excluded: *excluded, ..State::default() };
            let shown: Vec<&ChooseRow> = rows.rows.iter().filter(|row| filter.shows(row)).collect();
            let place = (rect, &mut state.chosen);
            if *as_plot {
                plot::show(ui, place, rows, &shown, axes, input.in_room)
            } else {
                table::show(ui, place, rows, &shown, input.in_room, &mut actions)
            }
        },
    );
    (*typed, *front_only, *excluded, *as_plot, *chosen_axes) = look;
    actions.extend(weights);
    actions
}

fn axis(ui: &mut Ui, rows: &ChooseRows, name: crate::texts::Text, chosen: &mut usize) {
    let text = rows.objectives.get(*chosen).map_or("", |one| one.name.as_str());
    let combo = ComboBox::from_id_salt(name.english()).width(80.0).truncate().selected_text(text);
    let combo = combo.show_ui(ui, |ui| {
        for (k, one) in rows.objectives.iter().enumerate() {
            ui.selectable_value(chosen, k, &one.name);
        }
    });
    combo.response.on_hover_text(name).accessible_name(name.get());
}

/// The table as numbers, in the order of ranks.
pub fn csv(rows: &ChooseRows) -> String {
    use std::fmt::Write as _;
    let quoted = tile::csv_field;
    let mut out = String::from("product,name");
    // Writing to a String cannot fail.
    for one in &rows.objectives {
        let _ = write!(out, ",{},{}", quoted(&one.name), quoted(&format!("{} error", one.name)));
    }
    out.push_str(",utility,utility_error,rank_first,rank_last,front,approximate,excluded,why\n");
    for row in &rows.rows {
        let _ = write!(out, "{},{}", quoted(&row.product), quoted(&row.label));
        for k in 0..rows.objectives.len() {
            match row.values.get(k) {
                Some((value, error)) => {
                    let _ = write!(out, ",{value},{error}");
                }
                None => out.push_str(",,"),
            }
        }
        let excluded = row.excluded.as_deref().unwrap_or("");
        let _ = if excluded.is_empty() {
            let ((utility, error), (first, last)) = (row.utility, row.ranks);
            write!(out, ",{utility},{error},{first},{last},{},{}", row.front, row.approximate)
        } else {
            write!(out, ",,,,,,")
        };
        let _ = writeln!(out, ",{},{}", quoted(excluded), quoted(&row.why));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(label: &str, front: bool, excluded: Option<&str>) -> ChooseRow {
        let excluded = excluded.map(str::to_owned);
        ChooseRow { label: label.to_owned(), product: label.to_owned(), front, excluded, ..ChooseRow::default() }
    }

    #[test]
    fn filters_are_all_to_be_passed() {
        let rows = [
            row("Clear glass", false, None),
            row("Laser cut panel", true, None),
            row("Broken", false, Some("no data")),
        ];
        let passing = |state: &State| rows.iter().filter(|row| state.shows(row)).count();
        let plain = State::default();
        assert_eq!(passing(&plain), 2);
        assert_eq!(passing(&State { excluded: true, ..plain.clone() }), 3);
        assert_eq!(passing(&State { front_only: true, ..plain.clone() }), 1);
        assert_eq!(passing(&State { words: "PANEL laser".to_owned(), ..plain.clone() }), 1);
        assert_eq!(passing(&State { words: "glass panel".to_owned(), ..plain }), 0);
        assert_eq!((rank_words((3, 3)), rank_words((2, 5))), ("3".to_owned(), "2–5".to_owned()));
    }

    #[test]
    fn the_table_has_as_many_fields_in_every_row() {
        let objectives =
            vec![Objective { name: "Lamps, all".to_owned(), unit: "kWh/m²", less_is_better: true, weight: 1.0 }];
        let mut first = row("A", true, None);
        (first.values, first.utility, first.ranks) = (vec![(3.5, 0.1)], (0.8, 0.01), (1, 2));
        let rows = ChooseRows { objectives, rows: vec![first, row("B", false, Some("no data"))], done: (2, 2) };
        let csv = csv(&rows);
        let lines: Vec<&str> = csv.lines().collect();
        assert_eq!(lines[0].matches(',').count(), 13, "two of them in quoted names");
        assert_eq!(lines[1], "A,A,3.5,0.1,0.8,0.01,1,2,true,false,,");
        assert_eq!(lines[2], "B,B,,,,,,,,,no data,");
    }
}
