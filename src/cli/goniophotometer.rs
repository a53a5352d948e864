//! `cfs goniophotometer`: virtual goniophotometer, which computes datasets from a description of geometry and material.

use super::writing::{Over, StreamFormat, refuse_stream};
use super::{output, progress::TerminalProgress};
use crate::catalogue::Catalogue;
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::{BandName, Btdf, Component, Dataset, Scattered, SolarSource, matrix_on};
use crate::formats::{FileKind, Format, Written, btdf_text, format_to_write, write_dataset};
use crate::study::goniophotometer::{Computed, Described, Request};
use crate::study::{Library, StudyError, files};
use anyhow::{anyhow, bail};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Basis of the incident directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Incidence {
    /// Klems basis (LBNL/Klems Full)
    #[value(name = "klems-145")]
    Klems,
    /// Tregenza patches about the normal of the façade
    #[value(name = "tregenza-145")]
    Tregenza,
}

/// Arguments of `cfs goniophotometer`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples (descriptions are in assets/systems):
  cfs goniophotometer opal-light.system.toml
                           print the summary
  cfs goniophotometer venetian-80-72.system.toml --out blind.cfsp
                           write all states to a package
  cfs goniophotometer venetian-80-72.system.toml --state 45 --out blind.xml
                           write one state

Files written:
  .cfsp      package with all states
  .xml       BSDF XML, one file per state
  .btdf.txt  text, four files per state: transmission and reflection of both
             sides
The key of the state is added to the file name if there are several states: blind_45.xml. Finished states are saved \
in the folder FILE.part; if a run is interrupted, the same command continues from there.

Columns of the summary:
  τ normal     transmittance at normal incidence
  τ hemi.      hemispherical transmittance
  τ+ρ+α−1      error of the energy balance
  reciprocity  error of reciprocity
  error        estimated error of τ and ρ at the worst incident direction
  seconds      run time [s]")]
pub struct GoniophotometerArgs {
    /// System description (.system.toml)
    pub system: PathBuf,
    /// File to write: .xml, .btdf.txt or .cfsp (default: print the summary only)
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Option for the format of output to a stream, whose name has no extension.
    #[command(flatten)]
    pub stream: StreamFormat,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
    /// Basis of the incident directions
    #[arg(long, value_enum, default_value = "klems-145")]
    pub incidence: Incidence,
    /// Basis of the emergent directions: klems-145, or patches of about this size in degrees, 1 to 30
    #[arg(long, value_name = "klems-145|DEGREES", default_value = "klems-145")]
    pub emergent: String,
    /// Key of the state to compute (default: all states)
    #[arg(long, allow_hyphen_values = true)]
    pub state: Option<String>,
    /// Absolute error allowed in τ and ρ for every incident direction, 0.000001 to 0.5
    #[arg(long, default_value = "0.01")]
    pub error: f64,
    /// Seed of the random numbers
    #[arg(long, default_value = "1")]
    pub seed: u64,
    /// Print the summary as JSON
    #[arg(long)]
    pub json: bool,
}

impl GoniophotometerArgs {
    fn request(&self) -> anyhow::Result<Request> {
        if !(1e-6..=0.5).contains(&self.error) {
            bail!("--error {}: out of range; expected 0.000001 to 0.5", self.error);
        }
        let klems = || RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let emergent = match self.emergent.as_str() {
            "klems-145" => klems(),
            text => match text.parse::<f64>() {
                Ok(degrees) if (1.0..=30.0).contains(&degrees) => RingBasis::even(degrees.to_radians()),
                _ => bail!("--emergent {text}: expected klems-145, or degrees from 1 to 30"),
            },
        };
        let incident = match self.incidence {
            Incidence::Klems => klems(),
            Incidence::Tregenza => RingBasis::tregenza(),
        };
        Ok(Request { incident, emergent, error: self.error, seed: self.seed })
    }
}

/// Maximum number of values of all functions and states of a run, which stay in memory until all are written: 4 GB.
const MOST_VALUES: f64 = 5e8;

/// Destination of the results: files of single states, or a package.
enum Target<'a> {
    None,
    States(&'a Path, Format),
    Package(&'a Path),
}

/// Runs `cfs goniophotometer`: reads a description, computes its states, writes them and prints a summary.
///
/// # Errors
/// Returns an error if the description cannot be read or computed, the state does not exist, or the format is unknown.
/// Finished states of an interrupted run are stored beside the output and reused by the next run; no other files are
/// written.
pub fn run(args: &GoniophotometerArgs, library: &Library) -> anyhow::Result<()> {
    let name = args.system.display().to_string();
    let request = args.request()?;
    let target =
        match args.out.as_deref().map(|path| Ok::<_, anyhow::Error>((path, args.stream.name(path)?))).transpose()? {
            None => Target::None,
            Some((path, name)) if name.extension().is_some_and(|e| e.eq_ignore_ascii_case("cfsp")) => {
                Target::Package(path)
            }
            Some((path, name)) => {
                let format = format_to_write(&name.to_string_lossy());
                let format = format.map_err(|error| anyhow!("{}: {error}, or a package (.cfsp)", path.display()))?;
                Target::States(path, format)
            }
        };
    match &target {
        Target::Package(path) => args.over.check([&*args.system], Some(path), FileKind::Package)?,
        Target::States(path, format) => args.over.check([&*args.system], Some(path), FileKind::Dataset(*format))?,
        Target::None => {}
    }
    let described = Described::read(&args.system)?;
    let all = described.states(library).map_err(|error| anyhow!("{name}: {error}"))?;
    let states = match &args.state {
        None => all,
        Some(state) if all.contains(state) => vec![state.clone()],
        Some(state) => {
            let keys: Vec<String> = all.iter().map(|key| format!("'{key}'")).collect();
            bail!("{name}: no state '{state}'; expected one of {}", keys.join(", "));
        }
    };
    let values = 4.0 * (states.len() * request.incident.len() * request.emergent.len()) as f64;
    if values > MOST_VALUES {
        let gigabytes = 8e-9 * values;
        bail!(
            "{name}: {} states on these cells need {gigabytes:.0} GB; coarser --emergent cells, or single states by --state",
            states.len()
        );
    }
    // Before anything is computed: no state is written if another cannot be.
    if let Target::States(path, format) = &target {
        if states.len() > 1 || *format == Format::BtdfText {
            refuse_stream(path)?;
        }
        for state in &states {
            let path = path_of_state(path, state, states.len() > 1);
            let components = if *format == Format::BtdfText { &Component::ALL[..] } else { &Component::ALL[..1] };
            for component in components {
                let path = path_of_component(&path, *component);
                args.over.check([], Some(&path), FileKind::Dataset(*format))?;
            }
        }
    }
    let keep = args.out.as_deref().filter(|path| !files::is_stream(path)).map(|path| {
        let mut folder = path.as_os_str().to_owned();
        folder.push(".part");
        PathBuf::from(folder)
    });
    if let (Some(folder), true) = (&keep, states.len() > 1) {
        // Without the folder, an interrupted run starts from scratch, no more.
        drop(std::fs::create_dir_all(folder));
    }
    let kept = keep.as_deref().filter(|_| states.len() > 1);
    let summary = results(args, library, &target, &described, &request, &states, kept);
    // A refused description would be refused again; if only the files could not be written, the next run resumes.
    let is_resumable = summary.as_ref().is_err_and(|error| error.is::<StudyError>());
    if let Some(folder) = keep.filter(|_| !is_resumable) {
        // A folder of kept states that cannot be removed costs disk space only.
        drop(std::fs::remove_dir_all(folder));
    }
    output::print(&summary?)
}

/// Computes the requested states, writes them, and returns the summary as text.
fn results(
    args: &GoniophotometerArgs,
    library: &Library,
    target: &Target<'_>,
    described: &Described,
    request: &Request,
    states: &[String],
    kept: Option<&Path>,
) -> anyhow::Result<String> {
    let name = args.system.display();
    let progress = TerminalProgress::new();
    let computed = described.measure_all(states, request, library, kept, &progress);
    let computed = computed.map_err(|error| anyhow!("{name}: {error}"))?;
    drop(progress);
    for one in &computed {
        if let Some(quality) = one.quality.filter(|quality| quality.error > request.error) {
            let of =
                if one.dataset.state.is_empty() { String::new() } else { format!("state {}: ", one.dataset.state) };
            let Request { error, .. } = request;
            report!("note: {of}error target {error} missed: {:.1e} at the worst incidence", quality.error);
        }
    }
    let summary = if args.json {
        let value = json!({
            "system": described.file.system.name,
            "kind": described.file.system.family().word(),
            "method": described.method(request),
            "states": computed.iter().map(to_json).collect::<Vec<_>>(),
        });
        serde_json::to_string_pretty(&value)? + "\n"
    } else {
        to_text(described, request, &computed)?
    };
    write_results(args.over, target, described, request, computed.into_iter().map(|one| one.dataset).collect())?;
    Ok(summary)
}

fn write_results(
    over: Over,
    target: &Target<'_>,
    described: &Described,
    request: &Request,
    datasets: Vec<Dataset>,
) -> anyhow::Result<()> {
    match target {
        Target::None => Ok(()),
        Target::Package(path) => {
            let shown = path.display();
            let mut catalogue = Catalogue::empty_in_memory().map_err(|error| anyhow!("{shown}: {error}"))?;
            let imported = catalogue.import(&datasets, described.product(request, &datasets));
            let key = imported.map_err(|error| anyhow!("{shown}: {error}"))?.key;
            let bytes = catalogue.export_package(&[key]).map_err(|error| anyhow!("{shown}: {error}"))?;
            Ok(over.write(path, FileKind::Package, &bytes)?)
        }
        Target::States(path, format) => {
            let several = datasets.len() > 1;
            let mut reported = BTreeSet::new();
            let mut files = Vec::new();
            for mut dataset in datasets {
                let path = path_of_state(path, &dataset.state, several);
                if *format == Format::BtdfText {
                    on_cells(&mut dataset, request);
                }
                for (path, written) in written_state(&path, *format, &dataset)? {
                    for finding in written.findings {
                        if reported.insert(finding.message.clone()) {
                            report!("note: {}: {}", path.display(), finding.message);
                        }
                    }
                    files.push((path, written.bytes));
                }
            }
            let kind = FileKind::Dataset(*format);
            let outputs: Vec<(&Path, FileKind, &[u8])> =
                files.iter().map(|(path, bytes)| (&**path, kind, &**bytes)).collect();
            Ok(over.write_all(&outputs)?)
        }
    }
}

/// Converts functions that are stored as closed forms to values on the requested cells, since text files contain
/// values.
fn on_cells(dataset: &mut Dataset, request: &Request) {
    for component in dataset.visible.components() {
        let Some(btdf) = dataset.visible.get(component) else { continue };
        let listed = matches!(btdf.scattered, Some(Scattered::Cells(_) | Scattered::Directions(_)));
        if btdf.regular.is_some() || !listed {
            let cells = Btdf::from_cells(matrix_on(btdf, &request.incident, &request.emergent));
            dataset.visible.set(component, cells);
        }
    }
}

/// Returns the path of a state's file: `blind.xml`, or `blind_45.xml` if several states are written.
fn path_of_state(path: &Path, state: &str, several: bool) -> PathBuf {
    if several { path_with(path, state) } else { path.to_owned() }
}

/// Returns the path of a function's file: that of the state for the front transmission, else with the function in its
/// name.
fn path_of_component(path: &Path, component: Component) -> PathBuf {
    match component {
        Component::TransmissionFront => path.to_owned(),
        other => path_with(path, &other.key().replace('_', "-")),
    }
}

/// Returns `blind_45.xml` for `blind.xml` and `45`. The name need not be UTF-8.
fn path_with(path: &Path, word: &str) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let extension = &name[Format::stem(&name).len()..];
    let mut stem = path.file_name().unwrap_or_default();
    for _ in extension.matches('.') {
        stem = Path::new(stem).file_stem().unwrap_or_default();
    }
    let mut name = stem.to_owned();
    name.push(format!("_{word}{extension}"));
    path.with_file_name(name)
}

/// Returns the files of one state, with their paths, bytes and findings.
fn written_state(path: &Path, format: Format, dataset: &Dataset) -> anyhow::Result<Vec<(PathBuf, Written)>> {
    let located = |error| anyhow!("{}: {error}", path.display());
    match format {
        Format::BsdfXml => {
            let written = write_dataset(format, std::slice::from_ref(dataset)).map_err(located)?;
            Ok(vec![(path.to_owned(), written)])
        }
        Format::BtdfText => {
            let mut files = Vec::new();
            for component in Component::ALL {
                let path = path_of_component(path, component);
                let written = btdf_text::write_component(dataset, component).map_err(located)?;
                files.push((path, written));
            }
            Ok(files)
        }
    }
}

fn to_json(one: &Computed) -> Value {
    let quality = one.quality.map(|quality| {
        json!({
            "energy_balance_error": quality.balance,
            "reciprocity_error": quality.reciprocity,
            "estimated_error": quality.error,
        })
    });
    let t = one.dataset.visible.transmission_front.as_ref();
    let solar = solar_of(&one.dataset);
    json!({
        "state": one.dataset.state,
        "seconds": one.seconds,
        "kept": one.quality.is_none(),
        "tau_normal_hemispherical": t.map(Btdf::tau_normal),
        "tau_hemispherical_hemispherical": t.map(Btdf::tau_hemispherical),
        "solar": {
            "source": one.dataset.solar_source().words(),
            "tau_normal_hemispherical": solar.map(Btdf::tau_normal),
            "tau_hemispherical_hemispherical": solar.map(Btdf::tau_hemispherical),
        },
        "quality": quality,
    })
}

/// Returns the front transmission in the solar band, if it was computed.
fn solar_of(dataset: &Dataset) -> Option<&Btdf> {
    dataset.transmission_of(BandName::Solar).filter(|_| dataset.solar.is_some())
}

fn to_text(described: &Described, request: &Request, computed: &[Computed]) -> anyhow::Result<String> {
    let mut text = String::new();
    writeln!(text, "{} ({})", described.file.system.name, described.file.system.family().word())?;
    writeln!(text, "{}", described.method(request))?;
    writeln!(text, "state      τ normal  τ hemi.  τ+ρ+α−1   reciprocity  error    seconds")?;
    for one in computed {
        let t = one.dataset.visible.transmission_front.as_ref();
        let normal = t.map_or(0.0, Btdf::tau_normal);
        let hemispherical = t.map_or(0.0, Btdf::tau_hemispherical);
        let state = if one.dataset.state.is_empty() { "-" } else { &one.dataset.state };
        write!(text, "{state:<10} {normal:<9.4} {hemispherical:<8.4} ")?;
        match one.quality {
            None => writeln!(text, "kept from an earlier run")?,
            Some(quality) => {
                let reciprocity = quality.reciprocity.map_or_else(|| "-".to_owned(), |e| format!("{:.3} %", 100.0 * e));
                writeln!(
                    text,
                    "{:<9.1e} {reciprocity:<12} {:<8.1e} {:.2}",
                    quality.balance, quality.error, one.seconds
                )?;
            }
        }
    }
    let solar = |one: &&Computed| one.dataset.solar.is_some();
    if computed.iter().any(|one| solar(&one)) {
        writeln!(text, "solar band τ normal  τ hemi.  properties")?;
    } else {
        writeln!(text, "no solar properties in the description: {}", SolarSource::Visible.words())?;
    }
    for one in computed.iter().filter(solar) {
        let state = if one.dataset.state.is_empty() { "-" } else { &one.dataset.state };
        if let Some(t) = solar_of(&one.dataset) {
            let (normal, hemispherical) = (t.tau_normal(), t.tau_hemispherical());
            let source = one.dataset.solar_source().words();
            writeln!(text, "{state:<10} {normal:<9.4} {hemispherical:<8.4} {source}")?;
        }
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_have_their_own_files() {
        assert_eq!(path_with(Path::new("a/b.btdf.txt"), "-30"), Path::new("a/b_-30.btdf.txt"));
        assert_eq!(path_with(Path::new("b.xml"), "22.5"), Path::new("b_22.5.xml"));
    }
}
