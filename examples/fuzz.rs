//! Searches for input on which a reader panics.
//!
//! - `cargo run --example fuzz -- --list` prints the targets, which are the readers.
//! - `cargo run --example fuzz -- TARGET --random RUNS [SEED]` makes random files, damages them and reads them.
//! - `cargo run --example fuzz -- TARGET FILE…` reads files.
//! - `cargo run --example fuzz -- TARGET --seeds FOLDER COUNT` writes inputs to start from.
//! - `cargo run --example fuzz -- TARGET --file INPUT PATH` writes the file that an input of decisions produces.
//!
//! Look at the number of inputs that were read ("taken"). A failure is a panic that names the seed or the file.
//!
//! Built with `--cfg fuzzing`, as by `.ci/fire-readers`, this is a program of libFuzzer, guided by coverage. The
//! environment variable `CFS_FUZZ` then names the target.

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

    // The macro exports the unsafe entry point of libFuzzer from its own crate; this crate has no unsafe code.
    libfuzzer_sys::fuzz_target!(|input: &[u8]| {
        let target = TARGET.get_or_init(|| {
            let name = std::env::var("CFS_FUZZ").unwrap_or_default();
            Target::named(&name).unwrap_or_else(|| panic!("CFS_FUZZ=\"{name}\" names no target"))
        });
        let taken = target.run(input);
        let (runs, taken) =
            (RUNS.fetch_add(1, Relaxed) + 1, TAKEN.fetch_add(u64::from(taken), Relaxed) + u64::from(taken));
        // Often enough that the last line is close to the final counts.
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
    let number = |word: &str| word.parse::<u64>().unwrap_or_else(|_| panic!("\"{word}\" is not a number"));
    let target = |name: &str| Target::named(name).unwrap_or_else(|| panic!("no target \"{name}\"; see --list"));
    match words[..] {
        ["--list"] => TARGETS.iter().for_each(|target| println!("{}", target.name)),
        [name, "--random", runs, ref seed @ ..] => {
            let (target, first) = (target(name), seed.first().map_or(0, |seed| number(seed)));
            let mut taken = 0;
            for seed in first..first + number(runs) {
                // The seed is named if reading panics, which ends the program.
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
            // Writes the file that is made from an input of decisions.
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
