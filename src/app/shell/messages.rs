//! Messages of the window: shown as long as it takes to read them, then listed in a sheet.

use crate::app::shell::clock;
use crate::texts::{Text, shell, short_numbers, visible};
use std::collections::VecDeque;
use std::path::PathBuf;

/// Maximum number of messages in the list; older ones are removed.
const MOST: usize = 200;
/// Minimum and maximum time that a message is shown. \[s\]
const SECONDS: [f64; 2] = [4.0, 40.0];
/// Time that a message is shown per character, for slow readers. \[s\]
const PER_CHARACTER: f64 = 0.07;

/// Maximum time by which one frame reduces the remaining time of messages; a longer frame was delayed. \[s\]
const LATE: f64 = 0.5;

/// Severity of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// Note, for information.
    Info,
    /// Confirmation of a successful action.
    Success,
    /// Warning.
    Warning,
    /// Error: an action failed.
    Error,
}

impl Weight {
    /// Returns the label of the severity.
    pub const fn word(self) -> Text {
        match self {
            Self::Info => shell::NOTE,
            Self::Success => shell::DONE,
            Self::Warning => shell::WARNING,
            Self::Error => shell::ERROR,
        }
    }
}

/// Message of the window to the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// Unique number of the message.
    pub id: u64,
    /// Severity of the message.
    pub weight: Weight,
    /// Text of the message.
    pub text: String,
    /// Clock time of the message, e.g. `14:03`.
    pub at: String,
    /// Remaining time for which the message is shown. \[s\]
    pub left: f64,
    /// Path of the report on an internal error that belongs to the message, if there is one.
    pub report: Option<PathBuf>,
}

/// All messages of a session, newest last.
#[derive(Debug, Default)]
pub struct Messages {
    list: VecDeque<Message>,
    next: u64,
    /// Time of the last update, by the window's own clock. \[s\]
    clock: f64,
}

/// Returns the time for which a message with this text is shown. \[s\]
pub fn seconds(text: &str) -> f64 {
    let [least, most] = SECONDS;
    (least + PER_CHARACTER * text.chars().count() as f64).min(most)
}

impl Messages {
    /// Shows a message, and returns its number.
    fn say(&mut self, weight: Weight, text: String, report: Option<PathBuf>) -> u64 {
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
        self.next
    }

    /// Shows a note.
    pub fn info(&mut self, text: impl Into<String>) {
        self.say(Weight::Info, text.into(), None);
    }

    /// Shows the confirmation of a successful action, and returns its number.
    pub fn success(&mut self, text: impl Into<String>) -> u64 {
        self.say(Weight::Success, text.into(), None)
    }

    /// Shows a warning.
    pub fn warning(&mut self, text: impl Into<String>) {
        self.say(Weight::Warning, text.into(), None);
    }

    /// Shows an error.
    pub fn error(&mut self, text: impl Into<String>) {
        self.say(Weight::Error, text.into(), None);
    }

    /// Shows an internal error, with its report.
    pub fn fault(&mut self, text: impl Into<String>, report: PathBuf) {
        self.say(Weight::Error, text.into(), Some(report));
    }

    /// Returns all messages, oldest first.
    pub fn all(&self) -> impl DoubleEndedIterator<Item = &Message> {
        self.list.iter()
    }

    /// Returns the number of messages.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are no messages.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Returns the messages that are shown now, oldest first.
    pub fn shown(&self) -> impl DoubleEndedIterator<Item = &Message> {
        self.list.iter().filter(|message| message.left > 0.0)
    }

    /// Reduces the remaining time of all visible messages up to the time `now` of the window's clock \[s\], except of
    /// the message `held` under the pointer. A delayed frame counts only in part, since its messages were not visible.
    pub fn pass_to(&mut self, now: f64, held: Option<u64>) {
        let passed = (now - self.clock).clamp(0.0, LATE);
        self.clock = now;
        self.pass(passed, held);
    }

    /// Reduces the remaining time of all messages but `held` by `seconds`.
    fn pass(&mut self, seconds: f64, held: Option<u64>) {
        for message in self.list.iter_mut().filter(|message| Some(message.id) != held) {
            message.left = (message.left - seconds).max(0.0);
        }
    }

    /// Hides the message with this number, or all; they remain in the list.
    pub fn dismiss(&mut self, id: Option<u64>) {
        self.list.iter_mut().filter(|one| id.is_none_or(|id| id == one.id)).for_each(|one| one.left = 0.0);
    }

    /// Removes all messages from the list.
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
