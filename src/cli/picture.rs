//! `cfs picture`: picture of a tile of the window, drawn without the window.

use super::language::ReportLanguage;
use super::progress::TerminalProgress;
use super::writing::{Over, StreamFormat, warn_of_missing_characters};
use crate::formats::FileKind;
use crate::report::{Look, Size, TileKind, picture};
use crate::study::goniophotometer::LayerLibrary as _;
use crate::study::subject::{Asked, Subject, Wanted};
use crate::study::{Library, Session, files, read_scene_file};
use crate::texts::speak;
use anyhow::{Context as _, bail};
use std::path::{Path, PathBuf};

/// Arguments of `cfs picture`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs picture office.toml --tile room --out room.svg
  cfs picture office.toml --tile lid --size 160x120mm --out lid.png
  cfs picture office.toml --tile btdf --print --plain --out btdf.svg

A size in millimetres gives 300 pixels per inch in .png. Each side must have 240 to 8000 pixels.")]
pub struct PictureArgs {
    /// Scene file (.toml)
    pub scene: PathBuf,
    /// Tile to draw: btdf, transmittance, sky, lid, room, control, or year (needs `[year]`)
    #[arg(long)]
    pub tile: TileKind,
    /// Width and height in pixels, or in millimetres as in 160x120mm
    #[arg(long, default_value = "1600x1200")]
    pub size: Size,
    /// Draw for black-and-white print, with lines that differ without colours
    #[arg(long)]
    pub print: bool,
    /// Leave out the caption: product, place, date and time, uncertainty, origin of the data
    #[arg(long)]
    pub plain: bool,
    /// Language of the labels, en or de
    #[arg(long, default_value = "en", value_name = "en|de")]
    pub language: ReportLanguage,
    /// File to write: .svg or .png
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Option for the format of output to a stream, whose name has no extension.
    #[command(flatten)]
    pub stream: StreamFormat,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
}

/// Reads a scene file and computes the results that `wanted` selects, for a picture or report.
pub(super) fn subject(path: &Path, wanted: Wanted, library: &Library) -> anyhow::Result<Subject> {
    let file = read_scene_file(path)?;
    let base = files::folder(path);
    let asked = Asked { file: &file, base, incident: None, wanted };
    let progress = TerminalProgress::new();
    Subject::of(&asked, &Session::new(), library, &|key| library.product(key), &progress)
        .with_context(|| path.display().to_string())
}

/// Runs `cfs picture`.
pub fn run(args: &PictureArgs, library: &Library) -> anyhow::Result<()> {
    let shown = args.out.display();
    let ending = args.stream.name(&args.out)?.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    if !["svg", "png"].contains(&&*ending) {
        bail!("--out {shown}: a picture is written as .svg or .png");
    }
    let kind = if ending == "svg" { FileKind::Svg } else { FileKind::Png };
    args.over.check([&*args.scene], Some(&args.out), kind)?;
    let subject = subject(&args.scene, args.tile.needs(), library)?;
    let spoken = speak(args.language.0);
    let look = Look { size: args.size, print: args.print, caption: !args.plain };
    let drawing = picture(&subject, args.tile, &look).with_context(|| args.scene.display().to_string())?;
    let bytes = if ending == "svg" {
        args.size.svg(&drawing).into_bytes()
    } else {
        args.size.png(&drawing).with_context(|| format!("--out {shown}"))?
    };
    args.over.write(&args.out, kind, &bytes)?;
    drop(spoken);
    if kind == FileKind::Png {
        warn_of_missing_characters(&[drawing]);
    }
    Ok(())
}
