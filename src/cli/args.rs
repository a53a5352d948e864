//! Arguments of the command line.

use super::{
    accuracy::AccuracyArgs, catalogue::CatalogueArgs, compact::CompactArgs, compare::CompareArgs, control::ControlArgs,
    convert::ConvertArgs, goniophotometer::GoniophotometerArgs, info::InfoArgs, lid::LidArgs, picture::PictureArgs,
    rank::RankArgs, repair::RepairArgs, report::ReportArgs, room::RoomArgs, sky::SkyArgs, year::YearArgs,
};
use clap::CommandFactory as _;
use std::path::{Path, PathBuf};

/// Text of `cfs --help` below the options: examples, streams and exit status.
const EXAMPLES: &str = "\
Without a command the window opens.

Examples:
  cfs                                       open the window
  cfs blind.xml office.toml                 open the window with files
  cfs info blind.xml                        inspect a data file
  cfs room office.toml --out office.csv     compute illuminances in a room
  cfs lid office.toml --out office.ldt      write a luminaire file
  cfs year year.toml --out hours.csv        simulate a year of weather
  cfs rank rank.toml --out rank.csv         rank products for a façade
  cfs report office.toml --out office.pdf   write a report
  cfs goniophotometer blind.system.toml     compute data from geometry
  cfs catalogue list --search blind         search the catalogue

The name - stands for standard input and, with --out, for standard output; all else then goes to standard error. \
Pipes are read as well; what comes without a name is recognised by its content.

Exit status:
  0    success
  1    data that are not fit for use, packages that differ, a damaged catalogue
  2    invalid input; one line says where, what was found and what was expected
  101  internal error; one line names the file with a report on it

'cfs limits' prints the limits of files and scenes.";

/// Compute what complex fenestration systems do to daylight in rooms, and compare and rank them
#[derive(Debug, clap::Parser)]
#[command(
    name = "cfs",
    version,
    after_help = EXAMPLES
)]
pub struct Arguments {
    /// Catalogue file (default: catalogue.sqlite in the user's data folder)
    #[arg(long, global = true, value_name = "FILE", env = "CFS_CATALOGUE")]
    pub catalogue: Option<PathBuf>,
    /// Open the window with these files or folders
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub open: Vec<PathBuf>,
    /// Open the window with these datasets, packages, system descriptions, scenes or folders
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Command to run
    #[command(subcommand)]
    pub command: Option<Command>,
}

impl Arguments {
    /// Returns the full paths of the files that the window is to open.
    ///
    /// # Errors
    /// Returns an error for a word that is neither a command nor a file; it names the command that may be meant.
    pub fn to_open(&self) -> anyhow::Result<Vec<PathBuf>> {
        let one = |path: &PathBuf| {
            if !path.exists() {
                return Err(not_there(path));
            }
            // Full paths, so that a scene's relative paths do not depend on the folder where the program was started.
            std::path::absolute(path).map_err(|error| anyhow::anyhow!("{}: {error}", path.display()))
        };
        self.open.iter().chain(&self.files).map(one).collect()
    }

    /// Checks that no files for the window are named before a subcommand, which names files separately.
    ///
    /// # Errors
    /// Returns an error if files for the window were named before a command.
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

/// Returns the error for an argument that is neither a command nor a file, with the command that may be meant, or with
/// the list of commands.
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

/// Returns the number of letters to insert, delete or replace to turn one word into the other (Levenshtein distance).
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

/// Subcommand with its arguments.
#[derive(Debug, clap::Subcommand)]
pub enum Command {
    /// Compute the illuminance at every sensor point of a scene
    Room(RoomArgs),
    /// Simulate a year of weather in a room: illuminances, glare, lighting energy, daylight metrics
    Year(YearArgs),
    /// Rank the products of the catalogue for a façade
    Rank(RankArgs),
    /// Compare scenes and products by their figures, with uncertainties
    Compare(CompareArgs),
    /// Compute the states of controlled systems for every hour of a year
    Control(ControlArgs),
    /// Compute the luminances of the 145 Tregenza patches of a scene's sky
    Sky(SkyArgs),
    /// Measure run time and error of every method and effort for a scene
    Accuracy(AccuracyArgs),
    /// Write the light of an aperture as a luminaire file
    Lid(LidArgs),
    /// Draw a tile of the window as a picture
    Picture(PictureArgs),
    /// Write a report on a scene or a product sheet as PDF
    Report(ReportArgs),
    /// Inspect dataset, luminaire, weather and system description files
    Info(InfoArgs),
    /// Repair a dataset as its findings propose
    Repair(RepairArgs),
    /// Convert a dataset to another format
    Convert(ConvertArgs),
    /// Report size and error of a dataset compressed by wavelets
    Compact(CompactArgs),
    /// Compute a dataset from a description of geometry and material
    Goniophotometer(GoniophotometerArgs),
    /// Search, import, export, edit and verify the catalogue of products
    Catalogue(CatalogueArgs),
    /// Print the limits of files, scenes and computations
    Limits,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_are_nearly_commands_are_found() {
        assert_eq!(distance("room", "rom"), 1);
        assert_eq!(distance("catalogue", "catalog"), 2);
        assert!(not_there(Path::new("rooom")).to_string().contains("did you mean \"cfs room\""));
        assert!(not_there(Path::new("window")).to_string().contains("commands are room, "));
        assert!(not_there(Path::new("a/blind.xml")).to_string().contains("no such file"));
    }
}
