//! Figures 7–9, 11, 12, 14, 19–21 and 23–25 of the IEA SHC Task 31 report of 2005, computed by this program.
//!
//! `cargo run --release --example figures [-- FOLDER]` writes a picture and a table (CSV) for each figure, and
//! `README.md` with their key numbers, into `screenshots/figures` or the given folder. It reads no files: all systems
//! are closed forms. Look at the column "key numbers" of `README.md`.

mod chart;
mod curves;
mod indicatrices;
mod outlines;
mod pages;
mod rooms;
mod systems;

use anyhow::{Context as _, Result};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Figure, ready to be written.
pub struct Figure {
    /// Name of its files, without ending.
    pub file: &'static str,
    /// Number in the report.
    pub number: &'static str,
    /// Content of the figure, for the list.
    pub shows: &'static str,
    /// Key numbers, for the list.
    pub key: String,
    /// File name ending and bytes of the picture.
    pub picture: (&'static str, Vec<u8>),
    /// CSV table of the numbers behind the picture.
    pub table: String,
}

const HEAD: &str = "# Figures of the report, computed by the program\n\n\
    Written by `cargo run --release --example figures`; all numbers are results of that run. Figures and equations \
    have the numbers of the IEA SHC Task 31 report of 2005: eq 19 is the luminous intensity of an ideal diffuser, eq \
    20 that of an open aperture, which has the luminance of the outside seen through it. Systems are closed forms, \
    sampled where data are needed. *Misplaced flux* is half the flux of the absolute difference of two \
    distributions, relative to the flux of the exact one. The tables (`.csv`) hold the numbers behind each picture. \
    `tests/compute/figures.rs` checks the main statements.\n\n\
    | figure | what it shows | key numbers | files |\n| --- | --- | --- | --- |\n";

fn main() -> Result<()> {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("screenshots/figures"), PathBuf::from);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let mut list = HEAD.to_owned();
    for make in pages::ALL {
        let figure = make()?;
        let (ending, bytes) = &figure.picture;
        let picture = format!("{}.{ending}", figure.file);
        let table = format!("{}.csv", figure.file);
        for (name, bytes) in [(&picture, bytes.as_slice()), (&table, figure.table.as_bytes())] {
            let path = folder.join(name);
            std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
        }
        println!("Figure {}: {}\n  {}\n  {picture}, {table}", figure.number, figure.shows, figure.key);
        writeln!(
            list,
            "| {} | {} | {} | [picture]({picture}), [table]({table}) |",
            figure.number, figure.shows, figure.key
        )?;
    }
    let path = folder.join("README.md");
    std::fs::write(&path, list).with_context(|| format!("cannot write {}", path.display()))
}
