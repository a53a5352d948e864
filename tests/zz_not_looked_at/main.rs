//! Runs after all other tests and says in one line what they did not look at, for want of data or of a driver. The line
//! goes to the file `$CFS_TEST_SUMMARY` too, if that is set.

#[path = "../common/mod.rs"]
mod common;

use std::collections::{BTreeMap, BTreeSet};

fn main() {
    // Somebody asks for names of tests: here are none.
    if std::env::args().any(|argument| argument == "--list") {
        return;
    }
    let notes = common::notes();
    let line = sum(&std::fs::read_to_string(&notes).unwrap_or_default());
    // Nothing there is well.
    let _ = std::fs::remove_file(notes);
    println!("\n{line}\n");
    if let Some(file) = std::env::var_os("CFS_TEST_SUMMARY") {
        std::fs::write(file, line + "\n").unwrap();
    }
}

/// The line, from notes of a reason and a test each.
fn sum(notes: &str) -> String {
    let mut reasons = BTreeMap::<&str, BTreeSet<&str>>::new();
    for (why, test) in notes.lines().filter_map(|line| line.split_once('\t')) {
        reasons.entry(why).or_default().insert(test);
    }
    let tests: BTreeSet<&&str> = reasons.values().flatten().collect();
    let parts: Vec<String> = reasons.iter().map(|(why, tests)| format!("{why}: {}", tests.len())).collect();
    match tests.len() {
        0 => "not looked at: nothing; no test went without its data or driver".to_owned(),
        1 => format!("not looked at: 1 test; {}", parts.join(", ")),
        many => format!("not looked at: {many} tests; {}", parts.join(", ")),
    }
}
