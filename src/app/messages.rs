//! What the window says: shown for as long as it takes to read, then kept in a list.

use super::clock;
use crate::texts::{Text, shell, short_numbers, visible};
use std::collections::VecDeque;
use std::path::PathBuf;

/// Messages kept.
const MOST: usize = 200;
/// Seconds that a message stays at least, and at most.
const SECONDS: [f64; 2] = [4.0, 40.0];
/// Seconds per character on top: a slow reader's pace.
const PER_CHARACTER: f64 = 0.07;

/// A frame that took longer came late. \[s\]
const LATE: f64 = 0.5;

/// How much it matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// For knowing.
    Info,
    /// Something was done.
    Success,
    /// Worth a look.
    Warning,
    /// Something was not done.
    Error,
}

impl Weight {
    /// In words.
    pub const fn word(self) -> Text {
        match self {
            Self::Info => shell::NOTE,
            Self::Success => shell::DONE,
            Self::Warning => shell::WARNING,
            Self::Error => shell::ERROR,
        }
    }
}

/// One message.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// Its number, which no other has.
    pub id: u64,
    /// How much it matters.
    pub weight: Weight,
    /// What is said.
    pub text: String,
    /// Clock time at which it was said, e.g. `14:03`.
    pub at: String,
    /// Seconds that it is still shown. \[s\]
    pub left: f64,
    /// A report that goes with it.
    pub report: Option<PathBuf>,
}

/// All messages of a session, the newest last.
#[derive(Debug, Default)]
pub struct Messages {
    list: VecDeque<Message>,
    next: u64,
    /// When time was last let pass: the window's own clock. \[s\]
    clock: f64,
}

/// Seconds that a text is shown.
pub fn seconds(text: &str) -> f64 {
    let [least, most] = SECONDS;
    (least + PER_CHARACTER * text.chars().count() as f64).min(most)
}

impl Messages {
    fn say(&mut self, weight: Weight, text: String, report: Option<PathBuf>) {
        self.next += 1;
        // What it quotes may come from any file.
        let text = short_numbers(&visible(&text)).into_owned();
        let left = seconds(&text);
        // The same again is not said twice at a time.
        self.list.iter_mut().filter(|other| other.text == text).for_each(|other| other.left = 0.0);
        self.list.push_back(Message { id: self.next, weight, text, at: clock::now(), left, report });
        while self.list.len() > MOST {
            self.list.pop_front();
        }
    }

    /// Says something worth knowing.
    pub fn info(&mut self, text: impl Into<String>) {
        self.say(Weight::Info, text.into(), None);
    }

    /// Says that something was done.
    pub fn success(&mut self, text: impl Into<String>) {
        self.say(Weight::Success, text.into(), None);
    }

    /// Says something worth a look.
    pub fn warning(&mut self, text: impl Into<String>) {
        self.say(Weight::Warning, text.into(), None);
    }

    /// Says that something was not done.
    pub fn error(&mut self, text: impl Into<String>) {
        self.say(Weight::Error, text.into(), None);
    }

    /// Says a fault of the program, with the report on it.
    pub fn fault(&mut self, text: impl Into<String>, report: PathBuf) {
        self.say(Weight::Error, text.into(), Some(report));
    }

    /// All, the oldest first.
    pub fn all(&self) -> impl DoubleEndedIterator<Item = &Message> {
        self.list.iter()
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// None at all?
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Those that are shown now, the oldest first.
    pub fn shown(&self) -> impl DoubleEndedIterator<Item = &Message> {
        self.list.iter().filter(|message| message.left > 0.0)
    }

    /// Lets time pass up to a moment of the window's clock \[s\] for all that are shown, but for the one under the
    /// pointer. A frame that came late counts as a moment: what was not in sight was not read.
    pub fn pass_to(&mut self, now: f64, held: Option<u64>) {
        let passed = (now - self.clock).clamp(0.0, LATE);
        self.clock = now;
        self.pass(passed, held);
    }

    /// Lets time pass \[s\].
    fn pass(&mut self, seconds: f64, held: Option<u64>) {
        for message in self.list.iter_mut().filter(|message| Some(message.id) != held) {
            message.left = (message.left - seconds).max(0.0);
        }
    }

    /// Takes one, or all, out of the window; the list keeps them.
    pub fn dismiss(&mut self, id: Option<u64>) {
        self.list.iter_mut().filter(|one| id.is_none_or(|id| id == one.id)).for_each(|one| one.left = 0.0);
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.list.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_shown_as_long_as_it_takes_to_read_and_then_kept() {
        let mut messages = Messages::default();
        messages.info("short");
        messages.error("x".repeat(200));
        assert!(seconds("short") < 5.0 && seconds(&"x".repeat(200)) > 15.0 && seconds(&"x".repeat(9999)) == 40.0);
        messages.pass(6.0, None);
        let shown: Vec<Weight> = messages.shown().map(|message| message.weight).collect();
        assert_eq!(shown, [Weight::Error]);
        let id = messages.shown().next().unwrap().id;
        messages.pass(60.0, Some(id));
        assert_eq!(messages.shown().count(), 1, "under the pointer it stays");
        messages.pass(60.0, None);
        assert_eq!((messages.shown().count(), messages.len()), (0, 2));
    }

    #[test]
    fn what_is_said_again_is_shown_once_and_the_list_is_bounded() {
        let mut messages = Messages::default();
        for _ in 0..3 {
            messages.info("the same");
        }
        assert_eq!((messages.shown().count(), messages.len()), (1, 3));
        messages.dismiss(None);
        assert_eq!(messages.shown().count(), 0);
        (0..500).for_each(|number| messages.info(format!("{number}")));
        assert_eq!((messages.len(), messages.all().next().unwrap().text.as_str()), (MOST, "300"));
    }
}
