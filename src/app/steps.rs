//! What the window remembers for the report on a fault: what was done last – commands by their names, without the paths in
//! them –, and which faults were reported.

use super::clock;
use super::command::Command;
use crate::study::fault::Fault;
use std::collections::VecDeque;
use std::fmt::{self, Write};
use std::path::PathBuf;

/// Steps kept.
const MOST: usize = 40;
/// Longest text of a step. \[letters\]
const LONGEST: usize = 80;

/// One step, perhaps repeated: something was dragged, or a key held.
#[derive(Debug)]
struct Step {
    at: String,
    what: String,
    times: usize,
}

/// What the window knows of faults.
#[derive(Debug, Default)]
pub struct Faults {
    /// Where reports are written.
    pub folder: Option<PathBuf>,
    /// Those that were reported, with their reports: the same again needs no second one.
    pub reported: Vec<(Fault, PathBuf)>,
}

/// The last steps, the newest last.
#[derive(Debug, Default)]
pub struct Steps(VecDeque<Step>);

/// Takes letters until there are enough, or until what a command carries begins: a whole scene may follow.
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

/// Does it carry a few words alone, and none of a person's folders?
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
    /// Keeps a command that is about to be done.
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

    /// One line a step, the newest last.
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
