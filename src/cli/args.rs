//! What can be typed.

use super::{
    accuracy::AccuracyArgs, catalogue::CatalogueArgs, compact::CompactArgs, control::ControlArgs, convert::ConvertArgs,
    goniophotometer::GoniophotometerArgs, info::InfoArgs, lid::LidArgs, repair::RepairArgs, room::RoomArgs,
    sky::SkyArgs,
};
use std::path::PathBuf;

/// From a complex fenestration system's BTDF to the light in a room
#[derive(Debug, clap::Parser)]
#[command(
    name = "cfs",
    version,
    about,
    after_help = "Without a command the window opens.

Examples:
  cfs                                   the window
  cfs --open blind.xml                  the window, with a dataset to import or a scene to show
  cfs info blind.xml                    what a dataset is, what it transmits, what is odd about it
  cfs room office.toml --out office.csv illuminance at every sensor
  cfs accuracy office.toml              error against run time of every method for this scene
  cfs lid office.toml --out office.ldt  an aperture's light as a luminaire file
  cfs control blind.toml --out year.csv a year of states of controlled systems
  cfs sky office.toml                   luminances of the 145 sky patches
  cfs repair blind.xml --repair transpose --out mended.xml   what cfs info offers
  cfs convert blind.xml copy.xml        between dataset formats
  cfs compact blind.btdf.txt            the compact form: ratio, errors, effect in a room
  cfs goniophotometer blind.system.toml --out blind.cfsp   datasets from geometry and material
  cfs catalogue list --search blind     products, built in and your own

On bad input every command ends with status 2 and one line that says what would be right."
)]
pub struct Arguments {
    /// Catalogue file (default: the user's data folder, or CFS_CATALOGUE)
    #[arg(long, global = true, value_name = "FILE", env = "CFS_CATALOGUE")]
    pub catalogue: Option<PathBuf>,
    /// Open the window with these datasets or this scene
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub open: Vec<PathBuf>,
    /// What to do; nothing opens the window
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// Subcommands.
#[derive(Debug, clap::Subcommand)]
pub enum Command {
    /// Illuminance at every sensor of a scene
    Room(RoomArgs),
    /// Error against run time of a scene, by method and effort
    Accuracy(AccuracyArgs),
    /// Luminous-intensity distribution of an aperture as a luminaire file
    Lid(LidArgs),
    /// Luminances of the 145 Tregenza patches of the sky dome
    Sky(SkyArgs),
    /// Compute a system's scattering from its geometry and material
    Goniophotometer(GoniophotometerArgs),
    /// A year of states of a scene's controlled systems
    Control(ControlArgs),
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
