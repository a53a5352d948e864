//! History for reports on internal errors: the last commands by name, without the paths in them, and the errors already
//! reported.

use crate::app::command::Command;
use crate::app::shell::clock;
use crate::study::fault::Fault;
use std::collections::VecDeque;
use std::fmt::{self, Write};
use std::path::PathBuf;

/// Maximum number of steps stored.
const MOST: usize = 40;
/// Maximum length of the text of a step. \[characters\]
const LONGEST: usize = 80;

/// Command in the history, with the number of times it was repeated in succession by dragging or by a held key.
#[derive(Debug)]
struct Step {
    at: String,
    what: String,
    times: usize,
}

/// Reports on internal errors of the program.
#[derive(Debug, Default)]
pub struct Faults {
    /// Folder to which reports are written.
    pub folder: Option<PathBuf>,
    /// Errors already reported, with the paths of their reports: a repeated error needs no second report.
    pub reported: Vec<(Fault, PathBuf)>,
}

/// History of the last commands, newest last.
#[derive(Debug, Default)]
pub struct Steps(VecDeque<Step>);

/// Writer for the debug text of a command, which stops at the maximum length or, if only the name is wanted, where the
/// content begins, because this may be a whole scene.
struct Short {
    text: String,
    name_alone: bool,
}

impl Write for Short {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for c in text.chars() {
            if self.text.len() >= LONGEST || (self.name_alone && c == '(') {
                return Err(fmt::Error);
            }
            self.text.push(c);
        }
        Ok(())
    }
}

/// Whether the content of a command is short and contains no path, so that it may be in the history.
const fn is_short(command: &Command) -> bool {
    use Command::{
        Arrange, Cancel, Control, DataForm, Day, Hour, Incidence, Language, NextState, Outside, Repair, RoomView, Row,
        Select, SelectState, Sheet, SystemExample, Theme, Tour,
    };
    matches!(
        command,
        Arrange(_)
            | Cancel(_)
            | Control(_)
            | DataForm(_)
            | Day(_)
            | Hour(_)
            | Incidence(_)
            | Language(_)
            | NextState(_)
            | Outside(_)
            | Repair(..)
            | RoomView(_)
            | Row(_)
            | Select(_)
            | SelectState(_)
            | Sheet(_)
            | SystemExample(_)
            | Theme(_)
            | Tour(_)
    )
}

impl Steps {
    /// Adds a command that is about to be executed to the history.
    pub fn keep(&mut self, command: &Command) {
        let mut short = Short { text: String::new(), name_alone: !is_short(command) };
        // It stops where there is enough.
        let _ = write!(short, "{command:?}");
        match self.0.back_mut() {
            Some(last) if last.what == short.text => last.times += 1,
            _ => {
                if self.0.len() >= MOST {
                    self.0.pop_front();
                }
                self.0.push_back(Step { at: clock::now(), what: short.text, times: 1 });
            }
        }
    }

    /// Returns the history as text, one line for each step, newest last.
    pub fn lines(&self) -> Vec<String> {
        let line = |step: &Step| match step.times {
            1 => format!("{} {}", step.at, step.what),
            times => format!("{} {} ×{times}", step.at, step.what),
        };
        self.0.iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::first_scene;

    #[test]
    fn steps_are_named_counted_and_bounded_and_carry_no_paths() {
        let mut steps = Steps::default();
        (0..100).for_each(|hour| steps.keep(&Command::Hour(hour)));
        steps.keep(&Command::OpenPaths(vec!["/somewhere/secret.xml".into()]));
        (0..3).for_each(|_| steps.keep(&Command::Scene(Box::new(first_scene()))));
        steps.keep(&Command::Select("x".repeat(999)));
        let lines = steps.lines();
        assert_eq!(lines.len(), MOST);
        let ends = ["Hour(99)", "OpenPaths", "Scene ×3"];
        for (line, end) in lines[MOST - 4..].iter().zip(ends) {
            assert!(line.ends_with(end), "{line}");
        }
        assert!(lines.iter().all(|line| line.chars().count() < LONGEST + 20));
    }
}
