//! Every reader, on the stored corpus and on files made and damaged at random: see `tests/readers`.

use crate::readers::{TARGETS, Target, random_input};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What one file may take; a hundred times what any does.
const LONGEST: Duration = Duration::from_secs(10);
/// Random runs a target.
const RUNS: u64 = 250;
/// The whole corpus. \[bytes\]
const MOST_BYTES: u64 = 5 << 20;

fn corpus(target: &Target) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(target.name);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn run(target: &Target, input: &[u8], what: &dyn std::fmt::Display) -> bool {
    let begun = Instant::now();
    let taken = std::panic::catch_unwind(|| target.run(input));
    let took = begun.elapsed();
    assert!(took < LONGEST, "{}: {what} takes {took:?}", target.name);
    taken.unwrap_or_else(|_| panic!("{}: {what} is neither read nor refused", target.name))
}

#[test]
fn every_stored_input_is_read_or_refused() {
    let mut bytes = 0;
    for target in &TARGETS {
        let files = corpus(target);
        assert!(!files.is_empty(), "{}: no stored inputs", target.name);
        for file in files {
            let input = std::fs::read(&file).unwrap();
            bytes += input.len() as u64;
            run(target, &input, &file.display());
        }
    }
    assert!(bytes <= MOST_BYTES, "a corpus of {bytes} bytes");
}

#[test]
fn files_made_at_random_are_read_or_refused_and_most_are_read() {
    for target in &TARGETS {
        let taken = (0..RUNS).filter(|seed| run(target, &random_input(*seed), &format!("seed {seed}"))).count();
        println!("{}: {taken} of {RUNS} taken", target.name);
        assert!(2 * taken as u64 >= RUNS, "{}: only {taken} of {RUNS} get past the reader", target.name);
    }
}
