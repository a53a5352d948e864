//! The report's Figures 7–9, 11, 12, 14, 19–21 and 23–25 as this program computes them, each with the numbers behind it.
//!
//! `cargo run --release --example figures [-- FOLDER]` writes pictures, tables (CSV) and a list into `screenshots/figures`
//! or the folder given. Nothing is read: all systems are closed forms.

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

/// One figure, ready to be written.
pub struct Figure {
    /// Name of its files.
    pub file: &'static str,
    /// Number in the report.
    pub number: &'static str,
    /// What it shows.
    pub shows: &'static str,
    /// The numbers to remember.
    pub key: String,
    /// Ending and bytes of the picture.
    pub picture: (&'static str, Vec<u8>),
    /// The numbers behind it.
    pub table: String,
}

const HEAD: &str = "# The report's figures, computed\n\n\
    Written by `cargo run --release --example figures`; every number comes from that run. Figures are numbered as in the \
    IEA SHC Task 31 report of 2005. Systems are closed forms, sampled where data are asked for. *Misplaced flux* is half \
    the flux of the difference of two distributions over the flux of one. The tables (`.csv`) hold the numbers behind each \
    picture. Claims are held by `tests/compute/figures.rs`.\n\n\
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
