//! `cfs report`: report on a scene, or product sheet, as PDF.

use super::language::ReportLanguage;
use super::picture::subject;
use super::progress::TerminalProgress;
use super::writing::{Over, warn_of_missing_characters};
use crate::drawing::colours::Inks;
use crate::formats::FileKind;
use crate::formats::encoding::decode;
use crate::report::comparison::Comparison;
use crate::report::product::{Sheet, pages as sheet_pages};
use crate::report::study_report::{Study, pages as study_pages};
use crate::report::{TileKind, pdf, tender};
use crate::study::example::scene_of;
use crate::study::goniophotometer::LayerLibrary as _;
use crate::study::subject::{Asked, Subject, Wanted};
use crate::study::{Library, Session, files, read_scene_file};
use crate::texts::{Language, speak};
use anyhow::{Context as _, bail};
use std::path::{Path, PathBuf};

/// Arguments of `cfs report`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs report office.toml --title Office --language de --out office.pdf
  cfs report blind.toml --sheet --out blind.pdf
  cfs report venetian-80-72 --state 45 --out venetian.pdf

The report on a scene has a chapter on its candidates if the scene has [[compare]]. A product sheet ends with a \
tender text. To change it, save the output of 'cfs report --template', which explains its {fields}, edit it, and \
name it with --tender.")]
pub struct ReportArgs {
    /// Scene file (.toml) or key of a product
    #[arg(required_unless_present = "template")]
    pub what: Option<String>,
    /// State of the product (default: its representative state)
    #[arg(long)]
    pub state: Option<String>,
    /// Write the product sheet of the scene's first aperture instead of the report
    #[arg(long)]
    pub sheet: bool,
    /// Title of the report
    #[arg(long, default_value = "")]
    pub title: String,
    /// Question that the report answers
    #[arg(long, default_value = "")]
    pub question: String,
    /// Template file of the tender text (default: the one that --template prints)
    #[arg(long, value_name = "FILE")]
    pub tender: Option<PathBuf>,
    /// Print the default template of the tender text and exit
    #[arg(long)]
    pub template: bool,
    /// Draw for black-and-white print, with lines that differ without colours
    #[arg(long)]
    pub print: bool,
    /// Language of the report, en or de
    #[arg(long, default_value = "en", value_name = "en|de")]
    pub language: ReportLanguage,
    /// Tile drawn for every candidate of `[[compare]]`: btdf, transmittance, sky, lid, room or control
    #[arg(long, value_name = "TILE", default_value = "room")]
    pub compared: TileKind,
    /// Number of the reference, the candidate from which differences are taken, from 1
    #[arg(long, value_name = "NUMBER", default_value = "1")]
    pub base: usize,
    /// PDF file to write
    #[arg(long, value_name = "FILE.pdf", required_unless_present = "template")]
    pub out: Option<PathBuf>,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
}

/// Runs `cfs report`.
pub fn run(args: &ReportArgs, library: &Library) -> anyhow::Result<()> {
    if args.template {
        return super::output::print(match args.language.0 {
            Language::English => tender::TEMPLATE,
            Language::German => tender::TEMPLATE_GERMAN,
        });
    }
    let (Some(what), Some(out)) = (&args.what, &args.out) else { bail!("a scene or product, and --out, are needed") };
    if !files::is_stream(out) && !out.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pdf")) {
        bail!("--out {}: a report is written as .pdf", out.display());
    }
    let template = match &args.tender {
        Some(path) => decode(&files::read(path)?).with_context(|| path.display().to_string())?.into_owned(),
        None => tender::TEMPLATE.to_owned(),
    };
    args.over.check([Path::new(what)], Some(out), FileKind::Pdf)?;
    let spoken = speak(args.language.0);
    let inks = if args.print { &Inks::PRINT } else { &Inks::LIGHT };
    let is_scene = what.ends_with(".toml") || Path::new(what).is_file() || files::is_stream(Path::new(what));
    let (subject, sheet) = if is_scene {
        if args.state.is_some() {
            bail!("--state is for a product; the scene {what} names its own");
        }
        (subject(Path::new(what), Wanted::ALL, library)?, args.sheet)
    } else {
        (of_product(what, args.state.as_deref(), library)?, true)
    };
    let comparison = if is_scene && !sheet { compared(Path::new(what), args, library)? } else { None };
    let pages = if sheet {
        sheet_pages(&Sheet { subject: &subject, tender: &template, inks })
    } else {
        let (title, question) = (&*args.title, &*args.question);
        study_pages(&Study { subject: &subject, title, question, comparison: comparison.as_ref(), inks })
    };
    let pages = pages.with_context(|| what.clone())?;
    args.over.write(out, FileKind::Pdf, &pdf::write(&pages, &subject.name)?)?;
    drop(spoken);
    warn_of_missing_characters(&pages);
    Ok(())
}

/// Computes the comparison of the candidates that a scene lists under `[[compare]]`; `None` if it lists none.
fn compared(path: &Path, args: &ReportArgs, library: &Library) -> anyhow::Result<Option<Comparison>> {
    let scene = read_scene_file(path)?;
    let count = scene.compare.len();
    if count > 0 && !(1..=count).contains(&args.base) {
        bail!("--base {}: expected a number from 1 to {count}, one of the scene's candidates", args.base);
    }
    let base = files::folder(path);
    let (session, progress) = (Session::new(), TerminalProgress::new());
    let wanted = Wanted { lid: true, room: true, control: args.compared == TileKind::Control, year: false };
    Comparison::of(&scene, (args.compared, args.base.saturating_sub(1)), |file, name| {
        let asked = Asked { file, base, incident: None, wanted };
        Subject::of(&asked, &session, library, &|key| library.product(key), &progress)
            .with_context(|| format!("{}, candidate {name}", path.display()))
    })
}

/// Computes the results of a product in the example scene, the one that the window opens at its first start.
fn of_product(key: &str, state: Option<&str>, library: &Library) -> anyhow::Result<Subject> {
    let product = library.product(key).with_context(|| key.to_owned())?;
    let own = product.states.get(product.representative().1).map(|state| state.key.clone());
    let state = state.map(str::to_owned).or(own);
    let file = scene_of(key, state.as_deref());
    let asked = Asked { file: &file, base: Path::new("."), incident: None, wanted: Wanted::ALL };
    let progress = TerminalProgress::new();
    Subject::of(&asked, &Session::new(), library, &|key| library.product(key), &progress)
        .with_context(|| key.to_owned())
}
