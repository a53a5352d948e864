//! Helper functions of the search index: words of texts, numbers for texts, positions in an order, weights.

use super::rows::Sought;
use super::words::{self, parts, runs};
use crate::texts::folded;
use std::collections::HashMap;

/// Weights of a match in a search, by the field of the product in which the word occurs.
pub(super) mod place {
    pub const NAME: f32 = 10.0;
    pub const KIND: f32 = 6.0;
    pub const MAKER: f32 = 5.0;
    pub const TAG: f32 = 4.0;
    pub const KEY: f32 = 4.0;
    pub const GERMAN: f32 = 3.0;
    pub const DESCRIPTION: f32 = 1.0;
}

/// Numbering of texts: each different text gets the next number, in the order of first use.
#[derive(Default)]
pub(super) struct Numbered {
    pub(super) texts: Vec<String>,
    numbers: HashMap<String, usize>,
}

impl Numbered {
    /// Returns the number of a text, and assigns the next one to a new text.
    pub(super) fn of(&mut self, text: &str) -> usize {
        if let Some(number) = self.numbers.get(text) {
            return *number;
        }
        self.texts.push(text.to_owned());
        self.numbers.insert(text.to_owned(), self.texts.len() - 1);
        self.texts.len() - 1
    }
}

/// Returns a sorting key of a text by which numbers are sorted by their size: "blind 80" before "blind 100".
fn by_numbers(text: &str) -> String {
    let mut key = String::with_capacity(text.len() + 8);
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let digits = rest[start..].bytes().take_while(u8::is_ascii_digit).count();
        let number = &rest[start..start + digits];
        key.push_str(&rest[..start]);
        key.push_str(&format!("{number:0>12}"));
        rest = &rest[start + digits..];
    }
    key.push_str(rest);
    key
}

/// Returns the position of every product when all are sorted by the text that `of` returns; equal texts have equal
/// positions.
pub(super) fn places(products: &[Sought], of: impl Fn(&Sought) -> String) -> Vec<usize> {
    let texts: Vec<String> = products.iter().map(|product| by_numbers(&of(product))).collect();
    let mut order: Vec<usize> = (0..products.len()).collect();
    order.sort_by(|a, b| texts[*a].cmp(&texts[*b]));
    let mut places = vec![0; products.len()];
    let mut place = 0;
    for (at, number) in order.iter().enumerate() {
        // Equal texts have equal places: what is asked next decides.
        if at > 0 && texts[order[at - 1]] != texts[*number] {
            place = at;
        }
        places[*number] = place;
    }
    places
}

/// Calls `put` for each word of a text and each part of a word between letters and digits (with `false`) and, if
/// `join`, for two or three neighbours written together (with `true`).
pub(super) fn words_of(text: &str, join: bool, put: &mut dyn FnMut(&str, bool)) {
    let folded = folded(text);
    let short = |word: &str| word.chars().count() <= words::LONGEST;
    let list: Vec<&str> = runs(&folded).filter(|run| short(run)).collect();
    for (at, run) in list.iter().enumerate() {
        put(run, false);
        parts(run).into_iter().for_each(|part| put(part, false));
        if join {
            let mut joined = (*run).to_owned();
            for next in list[at + 1..].iter().take(2) {
                joined.push_str(next);
                put(&joined, true);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_sort_by_their_size() {
        let mut names = ["blind 100", "blind 80", "blind 80 b", "blind", "2 panes", "10 panes"];
        names.sort_by_key(|name| by_numbers(name));
        assert_eq!(names, ["2 panes", "10 panes", "blind", "blind 80", "blind 80 b", "blind 100"]);
    }
}
