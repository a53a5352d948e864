//! What can be typed.

use super::{
    accuracy::AccuracyArgs, catalogue::CatalogueArgs, compact::CompactArgs, compare::CompareArgs, control::ControlArgs,
    convert::ConvertArgs, goniophotometer::GoniophotometerArgs, info::InfoArgs, lid::LidArgs, picture::PictureArgs,
    rank::RankArgs, repair::RepairArgs, report::ReportArgs, room::RoomArgs, sky::SkyArgs, year::YearArgs,
};
use crate::compute::limits;
use clap::CommandFactory as _;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// What can be typed, below all help.
const EXAMPLES: &str = "Without a command the window opens.

Examples:
  cfs                                   the window
  cfs blind.xml office.toml             the window, with a dataset to import and a scene to show
  cfs info blind.xml                    what a dataset is, what it transmits, what is odd about it
  cfs room office.toml --out office.csv illuminance at every sensor
  cfs accuracy office.toml              error against run time of every method for this scene
  cfs compare office.toml               figures of what the scene compares, with errors
  cfs lid office.toml --out office.ldt  an aperture's light as a luminaire file
  cfs picture office.toml --tile room --out room.svg         a tile of the window as a picture
  cfs report office.toml --out office.pdf                    a study, or a product sheet, as PDF
  cfs control blind.toml --out year.csv a year of states of controlled systems
  cfs year office.toml --out hours.csv --json                a year of weather, hour by hour
  cfs rank rank.toml --out rank.csv     which product for this façade, with errors and reasons
  cfs sky office.toml                   luminances of the 145 sky patches
  cfs repair blind.xml --repair transpose --out mended.xml   what cfs info offers
  cfs convert blind.xml copy.xml        between dataset formats
  cfs compact blind.btdf.txt            the compact form: ratio, errors, effect in a room
  cfs goniophotometer blind.system.toml --out blind.cfsp   datasets from geometry and material
  cfs catalogue list --search blind     products, built in and your own

On bad input every command ends with status 2 and one line that says what would be right; at a fault of the program
itself with status 101 and one line that says where the report on it is.";

/// The same with the table of limits, for `--help`.
fn with_limits() -> String {
    let mut text = format!("{EXAMPLES}\n\nLimits, each told by name where something is over it:\n");
    for limit in limits::TABLE {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {limit}");
    }
    text
}

/// From a complex fenestration system's BTDF to the light in a room
#[derive(Debug, clap::Parser)]
#[command(
    name = "cfs",
    version,
    about,
    after_help = EXAMPLES,
    after_long_help = with_limits()
)]
pub struct Arguments {
    /// Catalogue file (default: the user's data folder, or CFS_CATALOGUE)
    #[arg(long, global = true, value_name = "FILE", env = "CFS_CATALOGUE")]
    pub catalogue: Option<PathBuf>,
    /// Open the window with these files, or with what a folder holds; the same as naming them without --open
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub open: Vec<PathBuf>,
    /// Open the window with these: datasets to import, a package, a system, a scene, a folder of datasets
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// What to do; nothing opens the window
    #[command(subcommand)]
    pub command: Option<Command>,
}

impl Arguments {
    /// The files that the window is to open, by their full paths.
    ///
    /// # Errors
    /// A word that is neither a command nor a file, with the command that may be meant.
    pub fn to_open(&self) -> anyhow::Result<Vec<PathBuf>> {
        let one = |path: &PathBuf| {
            if !path.exists() {
                return Err(not_there(path));
            }
            // Where the program was started is no place to read a scene's relative paths from later.
            std::path::absolute(path).map_err(|error| anyhow::anyhow!("{}: {error}", path.display()))
        };
        self.open.iter().chain(&self.files).map(one).collect()
    }

    /// A command takes its own files.
    ///
    /// # Errors
    /// Files for the window that were named before a command.
    pub fn no_files(&self) -> anyhow::Result<()> {
        match self.open.iter().chain(&self.files).next() {
            Some(file) => Err(anyhow::anyhow!(
                "{}: a file named before a command; files for the window and a command do not go together",
                file.display()
            )),
            None => Ok(()),
        }
    }
}

/// Why a word cannot be opened.
fn not_there(path: &Path) -> anyhow::Error {
    let text = path.display().to_string();
    let plain = !text.contains(['/', '\\', '.']);
    let names: Vec<String> = Arguments::command().get_subcommands().map(|one| one.get_name().to_owned()).collect();
    let near = names.iter().min_by_key(|name| distance(name, &text)).filter(|name| distance(name, &text) <= 2);
    match near {
        Some(name) if *name == text => {
            anyhow::anyhow!(
                "{text}: files were named before a command; files for the window and a command do not go together"
            )
        }
        Some(name) => anyhow::anyhow!("{text}: neither a command nor a file; did you mean \"cfs {name}\"?"),
        None if plain => {
            anyhow::anyhow!("{text}: neither a command nor a file; commands are {}", names.join(", "))
        }
        None => anyhow::anyhow!("{text}: no such file; expected a dataset, package, system, scene or folder"),
    }
}

/// How many letters have to be put in, left out or replaced to get from one word to another.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

/// Subcommands.
#[derive(Debug, clap::Subcommand)]
pub enum Command {
    /// Illuminance at every sensor of a scene
    Room(RoomArgs),
    /// Error against run time of a scene, by method and effort
    Accuracy(AccuracyArgs),
    /// Figures of scenes and products side by side, with errors
    Compare(CompareArgs),
    /// Luminous-intensity distribution of an aperture as a luminaire file
    Lid(LidArgs),
    /// A tile of the window as a picture (.svg or .png)
    Picture(PictureArgs),
    /// A report as PDF: on a scene, or a product sheet
    Report(ReportArgs),
    /// Luminances of the 145 Tregenza patches of the sky dome
    Sky(SkyArgs),
    /// Compute a system's scattering from its geometry and material
    Goniophotometer(GoniophotometerArgs),
    /// A year of states of a scene's controlled systems
    Control(ControlArgs),
    /// A year of weather in a room, hour by hour, and what it comes to
    Year(YearArgs),
    /// Products of the catalogue in a scene's year, put in order by its objectives
    Rank(RankArgs),
    /// What a dataset file is
    Info(InfoArgs),
    /// A dataset mended as its findings offer
    Repair(RepairArgs),
    /// A dataset in another format
    Convert(ConvertArgs),
    /// What the compact form of a dataset saves and costs
    Compact(CompactArgs),
    /// List, show, import, export, validate products
    Catalogue(CatalogueArgs),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_tells_every_limit() {
        let help = Arguments::command().render_long_help().to_string();
        for limit in limits::TABLE {
            assert!(help.contains(&limit.to_string()), "{limit}");
        }
    }

    #[test]
    fn words_that_are_nearly_commands_are_found() {
        assert_eq!(distance("room", "rom"), 1);
        assert_eq!(distance("catalogue", "catalog"), 2);
        assert!(not_there(Path::new("rooom")).to_string().contains("did you mean \"cfs room\""));
        assert!(not_there(Path::new("window")).to_string().contains("commands are room, "));
        assert!(not_there(Path::new("a/blind.xml")).to_string().contains("no such file"));
    }
}
