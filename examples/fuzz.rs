//! Looks for bytes that readers do not stand: `cargo run --example fuzz TARGET FILE…` reads files as that target does,
//! `cargo run --example fuzz TARGET --random RUNS [SEED]` makes files at random and damages them, `--seeds FOLDER COUNT`
//! writes inputs to begin with, `--list` tells the targets. Says how many were taken; a fault is a panic that tells the input.
//!
//! Built with `--cfg fuzzing` it is a program of libFuzzer instead, guided by coverage, as `.ci/fire-readers` does; the target
//! is named by `CFS_FUZZ`.

#![cfg_attr(fuzzing, no_main)]

#[path = "../tests/readers/mod.rs"]
mod readers;

#[cfg(fuzzing)]
mod guided {
    use super::readers::Target;
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

    static TARGET: OnceLock<Target> = OnceLock::new();
    static RUNS: AtomicU64 = AtomicU64::new(0);
    static TAKEN: AtomicU64 = AtomicU64::new(0);

    // libFuzzer's entry is exported by the macro, which is of another crate: nothing of this one is unsafe.
    libfuzzer_sys::fuzz_target!(|input: &[u8]| {
        let target = TARGET.get_or_init(|| {
            let name = std::env::var("CFS_FUZZ").unwrap_or_default();
            Target::named(&name).unwrap_or_else(|| panic!("CFS_FUZZ=\"{name}\" names no target"))
        });
        let taken = target.run(input);
        let (runs, taken) =
            (RUNS.fetch_add(1, Relaxed) + 1, TAKEN.fetch_add(u64::from(taken), Relaxed) + u64::from(taken));
        // Often enough that the last one is near the end.
        if runs.is_multiple_of(500) {
            eprintln!("TAKEN {taken} OF {runs}");
        }
    });
}

#[cfg(not(fuzzing))]
fn main() -> std::process::ExitCode {
    use readers::{TARGETS, Target, random_input};
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let number = |word: &str| word.parse::<u64>().unwrap_or_else(|_| panic!("\"{word}\" is no number"));
    let target = |name: &str| Target::named(name).unwrap_or_else(|| panic!("no target \"{name}\"; see --list"));
    match words[..] {
        ["--list"] => TARGETS.iter().for_each(|target| println!("{}", target.name)),
        [name, "--random", runs, ref seed @ ..] => {
            let (target, first) = (target(name), seed.first().map_or(0, |seed| number(seed)));
            let mut taken = 0;
            for seed in first..first + number(runs) {
                // Told before it is read: a fault ends the program.
                let input = random_input(seed);
                let read = std::panic::catch_unwind(|| target.run(&input));
                taken += u64::from(read.unwrap_or_else(|_| panic!("{name}: seed {seed}")));
            }
            println!("{name}: {taken} of {runs} taken");
        }
        [name, "--seeds", folder, count] => {
            std::fs::create_dir_all(folder).expect("a folder to write to");
            for seed in 0..number(count) {
                let path = std::path::Path::new(folder).join(format!("seed-{seed:04}"));
                std::fs::write(path, random_input(seed)).unwrap_or_else(|error| panic!("{name}: {error}"));
            }
        }
        [name, "--file", input, path] => {
            // The file that an input of decisions stands for.
            let bytes = std::fs::read(input).expect("an input");
            std::fs::write(path, target(name).file(&bytes)).expect("a file to write to");
        }
        [name, ref files @ ..] if !files.is_empty() => {
            for file in files {
                let taken = target(name).run(&std::fs::read(file).unwrap_or_else(|error| panic!("{file}: {error}")));
                println!("{file}: {}", if taken { "taken" } else { "refused" });
            }
        }
        _ => {
            eprintln!("usage: fuzz TARGET FILE… | TARGET --random RUNS [SEED] | TARGET --seeds FOLDER COUNT | --list");
            return std::process::ExitCode::from(2);
        }
    }
    std::process::ExitCode::SUCCESS
}
