//! Rows of the command palette that match its text: commands, states of the selected product, products of the
//! catalogue, the best match first.

use super::command::Command;
use super::offer::{key_words, listed};
use super::shell::Shell;
use super::state::State;
use super::title;
use crate::app::catalogue::shelf::{Found, Hit, Query};
use crate::app::results::work::Outcome;
use crate::app::scene::control::state_words;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::texts::shell;

/// Maximum number of rows that the command palette shows.
pub const ROWS: usize = 12;

/// Maximum number of products that the command palette takes from a search of the catalogue.
const PRODUCTS: usize = 50;

/// Row of the command palette.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Command that the row executes.
    pub command: Command,
    /// Label of the row.
    pub text: String,
    /// Additional sentence about the command or product; may be empty.
    pub tip: String,
    /// Keyboard shortcut as text, if the command has one.
    pub keys: Option<String>,
}

/// Returns the misfit of a name (and the text about it) to searched words, which are in lower case: a number that is
/// lower for a better match; `None` if a word is missing. Whole words of the name count as the best match, then
/// beginnings of words, then parts of words, and last words in the text about the name.
fn misfit(name: &str, about: &str, wanted: &[String]) -> Option<usize> {
    let name = name.to_lowercase();
    let about = about.to_lowercase();
    let words = || name.split(|c: char| !c.is_alphanumeric());
    let one = |wanted: &String| {
        if words().any(|word| word == wanted) {
            Some(0)
        } else if words().any(|word| word.starts_with(wanted.as_str())) {
            Some(1)
        } else if name.contains(wanted.as_str()) {
            Some(3)
        } else {
            about.contains(wanted.as_str()).then_some(20)
        }
    };
    let sum: Option<usize> = wanted.iter().map(one).sum();
    let begins = wanted.first().is_some_and(|word| name.starts_with(word.as_str()));
    sum.map(|sum| 2 * sum + usize::from(!begins))
}

/// Returns the products that a search of the catalogue found; none if the search had replaced the words typed by
/// similar ones.
fn hits(found: Found) -> Vec<Hit> {
    if !found.read_as.is_empty() {
        return Vec::new();
    }
    let hit = |entry: &std::sync::Arc<crate::app::catalogue::shelf::Entry>| {
        let about: Vec<&str> =
            [entry.manufacturer.as_str(), entry.kind.as_str()].into_iter().filter(|words| !words.is_empty()).collect();
        Hit { key: entry.key.clone(), name: entry.name.clone(), about: about.join(", ") }
    };
    found.entries.iter().take(PRODUCTS).map(hit).collect()
}

/// Rows of the command palette: which one is chosen, and the products that the catalogue found.
#[derive(Default)]
pub struct Palette {
    /// Index of the row that Enter executes.
    row: usize,
    /// Products of the catalogue that match the text of the palette.
    hits: Vec<Hit>,
    /// Text of the palette for which `hits` were found.
    hits_of: String,
}

impl Palette {
    /// Returns the index of the row that Enter executes.
    pub const fn row(&self) -> usize {
        self.row
    }

    /// Chooses the row that Enter executes, by its index.
    pub const fn choose(&mut self, row: usize) {
        self.row = row;
    }

    /// Returns the rows of the command palette that match a text, the best match first; in case of equal matches, commands
    /// before states and states before products.
    pub fn rows(&self, state: &State, text: &str) -> Vec<Row> {
        let wanted: Vec<String> = text.split_whitespace().map(str::to_lowercase).collect();
        // The palette itself is left out: it would only close.
        let commands = listed().filter(|offer| offer.command != Command::Palette).map(|offer| {
            let keys = offer.keys.as_ref().map(key_words);
            (Row { command: offer.command.clone(), text: offer.text.clone(), tip: offer.tip.to_owned(), keys }, "")
        });
        let product = title::selected(state).filter(|product| !wanted.is_empty() && product.states.len() > 1);
        let states = product.into_iter().flat_map(|product| {
            product.states.iter().map(|one| {
                let text = shell::state_of(&product.name, state_words(one));
                let command = Command::SelectState(one.key.clone());
                (Row { command, text, tip: shell::SHOW_STATE.into(), keys: None }, "")
            })
        });
        let hits = self.hits.iter().filter(|_| !wanted.is_empty()).map(|hit| {
            let row = Row {
                command: Command::Select(hit.key.clone()),
                text: shell::product_named(&hit.name),
                tip: hit.about.clone(),
                keys: None,
            };
            (row, hit.name.as_str())
        });
        let mut list: Vec<(usize, Row)> = commands
            .chain(states)
            .chain(hits)
            .filter_map(|(row, name)| {
                // A product is known by its name, not by what stands before it.
                let fit = if name.is_empty() {
                    misfit(&row.text, &row.tip, &wanted)
                } else {
                    // The catalogue knows more words than are shown: what it found of these words fits in any case.
                    misfit(name, &row.tip, &wanted).or((self.hits_of == text).then_some(100))
                };
                Some((fit?, row))
            })
            .collect();
        if !wanted.is_empty() {
            list.sort_by_key(|(fit, _)| *fit);
        }
        list.truncate(ROWS);
        list.into_iter().map(|(_, row)| row).collect()
    }

    /// Opens or closes the command palette.
    pub fn toggle(&mut self, shell: &mut Shell) {
        let state = &mut shell.state;
        state.palette = if state.palette.is_some() { None } else { Some(String::new()) };
        self.row = 0;
        self.hits.clear();
        shell.jobs.cancel(Lane::Palette);
    }

    /// Sets the text of the command palette, and starts searching the catalogue for it.
    pub fn edit(&mut self, shell: &mut Shell, text: String) {
        let words = text.trim().to_owned();
        shell.state.palette = Some(text);
        self.row = 0;
        if words.is_empty() {
            self.hits.clear();
            shell.jobs.cancel(Lane::Palette);
        } else if let Some(shelf) = shell.state.shelf() {
            let query = Query { text: words, ..Query::default() };
            shell.start(Lane::Palette, move |_| Outcome::Hits(shelf.search(&query)));
        }
    }

    /// Takes over the products that the catalogue search found for the command palette, or reports its error; a chosen
    /// row stays chosen.
    pub fn take(&mut self, shell: &mut Shell, found: Result<Found, AppError>) {
        match found {
            Ok(found) => {
                let text = shell.state.palette.clone().unwrap_or_default();
                let chosen = self.rows(&shell.state, &text).into_iter().nth(self.row).filter(|_| self.row > 0);
                self.hits = hits(found);
                self.hits_of.clone_from(&text);
                // What was gone to with the arrow keys stays chosen, wherever it stands now.
                if let Some(chosen) = chosen {
                    self.row = self.rows(&shell.state, &text).iter().position(|row| *row == chosen).unwrap_or(0);
                }
            }
            Err(error) => {
                self.hits.clear();
                shell.report_error(&error);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::state::Settings;
    use crate::texts::{Language, speak};

    fn texts(words: &str, hits: &[&str]) -> Vec<String> {
        let hit =
            |name: &&str| Hit { key: (*name).to_owned(), name: (*name).to_owned(), about: "Maker, blind".to_owned() };
        let palette = Palette { row: 0, hits: hits.iter().map(hit).collect(), hits_of: words.to_owned() };
        palette.rows(&State::new(Settings::default()), words).into_iter().map(|row| row.text).collect()
    }

    #[test]
    fn whole_words_go_before_beginnings_and_names_before_tips() {
        let wanted = |words: &str| words.split(' ').map(str::to_owned).collect::<Vec<_>>();
        let fit = |name: &str, words: &str| misfit(name, "what it does", &wanted(words));
        assert!(fit("Undo", "undo") < fit("Undone things", "undo"));
        assert!(fit("The undone", "undo") < fit("Fundous", "undo"));
        assert!(fit("Fundous", "undo") < misfit("Delete", "undo brings it back", &wanted("undo")));
        assert_eq!(fit("Undo", "undo twice"), None);
        assert_eq!(texts("undo", &[])[0], "Undo");
        assert_eq!(texts("maximise lid", &[])[0], "Maximise LID");
    }

    #[test]
    fn products_stand_between_commands_by_how_well_they_fit() {
        let list = texts("room", &["Roomy blind", "Bath room panel"]);
        assert!(list[0].starts_with("Room"), "{list:?}");
        let panel = list.iter().position(|text| text.contains("Bath room panel"));
        let roomy = list.iter().position(|text| text.contains("Roomy blind"));
        assert!(panel.is_some() && roomy.is_none_or(|roomy| panel < Some(roomy)), "{list:?}");
        // What only the catalogue's own words fit is listed too.
        assert!(texts("xyz", &["Blind 80"]).iter().any(|text| text.contains("Blind 80")));
        assert!(texts("", &["Blind 80"]).iter().all(|text| !text.contains("Blind 80")));
    }

    #[test]
    fn what_was_found_of_other_words_has_to_fit_by_itself() {
        let hit = Hit { key: "k".to_owned(), name: "Blind 80".to_owned(), about: "Maker, blind".to_owned() };
        let palette = Palette { row: 0, hits: vec![hit], hits_of: "xyz".to_owned() };
        let state = State::new(Settings::default());
        let listed = |words: &str| palette.rows(&state, words).iter().any(|row| row.text.contains("Blind 80"));
        assert!(listed("xyz") && listed("blind") && !listed("xyzz"));
    }

    #[test]
    fn words_are_those_of_the_language() {
        let _german = speak(Language::German);
        assert_eq!(texts("rückgängig", &[])[0], "Rückgängig");
        assert!(texts("undo", &[]).is_empty());
    }
}
