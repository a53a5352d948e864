//! `cfs lid`: the luminous-intensity distribution of an aperture as a luminaire file, table or diagram.

use super::output::print;
use super::progress::TerminalProgress;
use super::weather_info::weather_notes;
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::{Aim, Step};
use crate::formats::ies::IesEdition;
use crate::formats::luminaire::Description;
use crate::study::luminaire_file::{LidFormat, describe, encode};
use crate::study::{Session, files, load_scene, read_scene_file, system::SystemLibrary};
use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Write an aperture's luminous-intensity distribution; the format follows the extension of --out
#[derive(Debug, Clone, Args)]
pub struct LidArgs {
    /// Scene file
    pub scene: PathBuf,
    /// Number of the aperture in the scene file, counted from 1
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub aperture: u32,
    /// File to write: .ldt (EULUMDAT), .ies (LM-63), .csv (table), .png or .svg (polar diagram)
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Edition of LM-63 for .ies
    #[arg(long, value_enum, default_value_t = EditionArg::Y2002)]
    pub edition: EditionArg,
    /// How the aperture stands in the file; without it as it really is (a roof aperture shines down)
    #[arg(long, value_enum)]
    pub aim: Option<AimArg>,
    /// Step of C and gamma in degrees, a divisor of 90 from 1 to 15; without it chosen from the data
    #[arg(long, value_name = "DEGREES")]
    pub step: Option<f64>,
    /// Print a summary as JSON
    #[arg(long)]
    pub json: bool,
}

/// Edition of LM-63.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum EditionArg {
    /// LM-63-2002, which most programs read
    #[value(name = "2002")]
    Y2002,
    /// LM-63-2019
    #[value(name = "2019")]
    Y2019,
}

/// Orientation in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AimArg {
    /// Façade as built: nadir down, C0 into the room
    Mounted,
    /// Outward normal up, light goes down; tilt by 90° in the host
    Down,
}

/// Runs the command.
pub fn run(args: &LidArgs, library: &dyn SystemLibrary) -> Result<()> {
    write_distribution(args, |path, index| {
        let scene = load_scene(path, library)?;
        let count = scene.apertures.len();
        if index >= count {
            bail!("{}: --aperture {}: the scene has apertures 1 to {count}", path.display(), index + 1);
        }
        weather_notes(scene.weather.as_ref());
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if let Some(note) = scene.illuminances.and_then(|light| light.note()) {
            eprintln!("note: {note}");
        }
        let date = jiff::Zoned::now().date().to_string();
        let text = describe(&name, &read_scene_file(path)?, index, &date);
        Ok((Session::new().lid(&scene, index, &TerminalProgress::new())?.lid, text))
    })
}

/// The command with `distribution` to compute the aperture's light and the file's header from the scene's path and the
/// aperture's index, counted from 0.
///
/// Options are checked before anything is computed; the file appears whole or not at all.
fn write_distribution(
    args: &LidArgs,
    distribution: impl FnOnce(&Path, usize) -> Result<(Lid, Description)>,
) -> Result<()> {
    let edition = match args.edition {
        EditionArg::Y2002 => IesEdition::Lm63_2002,
        EditionArg::Y2019 => IesEdition::Lm63_2019,
    };
    let shown = args.out.display();
    let format = LidFormat::of(&args.out, edition).with_context(|| format!("--out {shown}"))?;
    let step = args.step.map(Step::from_degrees).transpose().context("--step")?;
    let aim = args.aim.map(|aim| match aim {
        AimArg::Mounted => Aim::Mounted,
        AimArg::Down => Aim::Down,
    });
    let (lid, text) = distribution(&args.scene, args.aperture as usize - 1)?;
    let file = encode(&lid, text, format, aim, step).with_context(|| format!("{shown}"))?;
    files::write(&args.out, &file.bytes)?;
    if args.json {
        let summary = serde_json::json!({
            "out": args.out.to_string_lossy(),
            "aperture": args.aperture,
            "flux_lm": file.flux.value,
            "flux_error_lm": file.flux.error,
            "peak_cd": file.peak,
            "scaled_by": file.scaled_by,
            "step_deg": file.step.degrees(),
            "aim": match file.aim { Aim::Mounted => "mounted", Aim::Down => "down" },
        });
        print(&format!("{summary:#}\n"))?;
    } else {
        eprintln!(
            "{shown}: {:.1} lm, peak {:.1} cd, step {}°, table scaled by {:+.3} %",
            file.flux.value,
            file.peak,
            file.step.degrees(),
            100.0 * (file.scaled_by - 1.0)
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::lid::EmergentLuminance;
    use crate::formats::{eulumdat, ies};
    use clap::Parser;

    #[derive(Parser)]
    struct Command {
        #[command(flatten)]
        lid: LidArgs,
    }

    fn run_on(words: &[&str], surface: Surface) -> Result<()> {
        let command = Command::try_parse_from(["lid"].iter().chain(words))?;
        write_distribution(&command.lid, |_, _| {
            let parts = vec![EmergentLuminance::Uniform(100.0)];
            Ok((Lid { surface, size: [2.0, 1.0], parts, beams: Vec::new() }, Description::default()))
        })
    }

    #[test]
    fn extension_and_options_decide_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
        let flux = std::f64::consts::PI * 200.0;
        run_on(&["s.toml", "--out", &path("a.ldt")], Surface::Facade).unwrap();
        let mounted = eulumdat::read(&std::fs::read(path("a.ldt")).unwrap()).unwrap();
        assert!((mounted.flux_within(90.0) / flux - 0.5).abs() < 0.01);
        run_on(&["s.toml", "--out", &path("b.ies"), "--edition", "2019"], Surface::Roof).unwrap();
        let down = ies::read(&std::fs::read(path("b.ies")).unwrap()).unwrap();
        assert_eq!(down.format, "IES:LM-63-2019");
        assert!((down.flux_within(90.0) / flux - 1.0).abs() < 0.01);
        for name in ["c.csv", "d.png", "e.svg"] {
            run_on(&["s.toml", "--out", &path(name), "--step", "5", "--aim", "down"], Surface::Facade).unwrap();
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 5);
    }

    #[test]
    fn wrong_options_are_told_and_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("a.xyz").to_string_lossy().into_owned();
        let error = format!("{:#}", run_on(&["s.toml", "--out", &out], Surface::Facade).unwrap_err());
        assert!(error.contains("xyz") && error.contains("ldt, ies, csv"), "{error}");
        let out = folder.path().join("a.ldt").to_string_lossy().into_owned();
        let error = format!("{:#}", run_on(&["s.toml", "--out", &out, "--step", "7"], Surface::Facade).unwrap_err());
        assert!(error.contains("does not divide 90"), "{error}");
        assert!(run_on(&["s.toml", "--out", &out, "--aperture", "0"], Surface::Facade).is_err());
        assert!(run_on(&["s.toml", "--out", "/nonexistent/a.ldt"], Surface::Facade).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
