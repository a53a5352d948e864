//! `cfs info`: contents of data files of every kind that the program reads, and the findings about them.

use crate::cli::output::{Content, print, print_text, report_error};
use crate::cli::{dataset_file, luminaire_info, system_info, weather_info};
use crate::compute::btdf::{
    BandName, Btdf, Component, Dataset, Scattered, Severity, SolarSource, Thermal, ThermalKey, TreeRank,
    reciprocity_error,
};
use crate::compute::direction::Incident;
use crate::compute::doctor::{Diagnosis, examine_all};
use crate::formats::system_toml::is_system_file;
use crate::study::{Library, files};
use crate::texts::findings::meaning;
use crate::texts::one_line;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs info`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  cfs info blind.xml
  cfs info slat_*.xml --json
  cfs info venetian.system.toml
  cfs info builtin:new-york

Files:
  .xml, .btdf.txt, .cfsd, .cfsp   datasets
  .system.toml                    system descriptions
  .ldt, .ies, .index.csv          luminaire files, indices of luminaire files
  .epw, .wea, builtin:NAME        weather files, built-in years

A file that cannot be read is reported on standard error, the others are described, and the exit status is 2.")]
pub struct InfoArgs {
    /// Files to describe
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Print JSON: an object per file or state, in an array if there are several
    #[arg(long)]
    pub json: bool,
}

/// Prints a description of every file that can be read, and reports the others on standard error.
///
/// # Errors
/// Returns the error of the last file that cannot be read, one line with the file's name and the position in it.
pub fn run(args: &InfoArgs, library: &Library) -> anyhow::Result<()> {
    let several = args.files.len() > 1;
    let mut values = Vec::new();
    let mut failed = None;
    for (number, file) in args.files.iter().enumerate() {
        match describe(file, args.json, library) {
            Ok(Content::Text(text)) if several => {
                let gap = if number > 0 { "\n" } else { "" };
                print_text(&format!("{gap}{:<22}{}\n{text}", "File", file.display()))?;
            }
            Ok(Content::Text(text)) => print_text(&text)?,
            Ok(Content::Json(mut list)) => {
                let objects = list.iter_mut().filter_map(Value::as_object_mut).filter(|_| several);
                objects.for_each(|object| drop(object.insert("file".into(), file.to_string_lossy().into())));
                values.append(&mut list);
            }
            Err(error) => {
                if let Some(earlier) = failed.replace(error) {
                    report_error(&earlier);
                }
            }
        }
    }
    if !values.is_empty() {
        let value = if several || values.len() > 1 { Value::Array(values) } else { values.remove(0) };
        print(&(serde_json::to_string_pretty(&value)? + "\n"))?;
    }
    failed.map_or(Ok(()), Err)
}

/// Reads one file, whose kind is recognised by its name or its bytes, and returns its description.
fn describe(file: &Path, as_json: bool, library: &Library) -> anyhow::Result<Content> {
    if let Some(content) = luminaire_info::describe(file, as_json)? {
        return Ok(content);
    }
    if let Some(content) = weather_info::describe(file, as_json)? {
        return Ok(content);
    }
    if is_system_file(&files::name_with_extension(file)?) {
        return system_info::describe(file, as_json, library);
    }
    let datasets = dataset_file::read(file)?;
    Ok(if as_json {
        Content::Json(once_each(&datasets, |dataset, found| to_json(dataset, &datasets, found)))
    } else {
        Content::Text(once_each(&datasets, to_text).join("\n"))
    })
}

/// Returns the description of each dataset, made by `say`, which is called once for equal datasets (several states may
/// have the same data).
fn once_each<T: Clone>(datasets: &[Dataset], say: impl Fn(&Dataset, &[Diagnosis]) -> T) -> Vec<T> {
    let mut descriptions: Vec<(&Dataset, T)> = Vec::new();
    let mut description_of =
        |(dataset, found): (_, Vec<Diagnosis>)| match descriptions.iter().find(|(other, _)| *other == dataset) {
            Some((_, text)) => text.clone(),
            None => {
                let text = say(dataset, &found);
                descriptions.push((dataset, text.clone()));
                text
            }
        };
    datasets.iter().zip(examine_all(datasets)).map(&mut description_of).collect()
}

/// Returns a dataset as JSON, with the keys that the documentation of the scene file lists.
fn to_json(dataset: &Dataset, all: &[Dataset], found: &[Diagnosis]) -> Value {
    let key = |component: &Component| Value::from(component.key());
    let transmission = dataset.transmission();
    let mut object = Map::new();
    object.insert("format".into(), dataset.format.clone().into());
    object.insert("name".into(), dataset.name.clone().into());
    object.insert("manufacturer".into(), dataset.manufacturer.clone().into());
    object.insert("description".into(), dataset.description.clone().into());
    object.insert("state".into(), dataset.state.clone().into());
    // A value that a file does not state is null and not left out, so that readers need not test for keys.
    object.insert("thickness_m".into(), dataset.thickness.into());
    // Few files state thermal data; without any, the object is left out, since its keys vary anyway.
    if !dataset.thermal.is_empty() {
        object.insert("thermal".into(), thermal_json(&dataset.thermal));
    }
    object.insert("incident_basis".into(), dataset.incident_basis.clone().into());
    object.insert("emergent_basis".into(), dataset.emergent_basis.clone().into());
    object.insert("resolution".into(), transmission.map(resolution).into());
    object.insert(
        "states".into(),
        // A single state may be nameless: nothing that `--state` could choose.
        all.iter().map(|one| one.state.clone()).filter(|key| !key.is_empty()).collect::<Vec<_>>().into(),
    );
    object.insert("components".into(), dataset.visible.components().iter().map(key).collect::<Vec<_>>().into());
    // Derived from other components by reciprocity: marked for readers who want measured values alone.
    object.insert("derived".into(), dataset.derived.iter().map(key).collect::<Vec<_>>().into());
    // Beams are known for every direction, computed from the description when needed.
    object.insert("described".into(), dataset.described.is_some().into());
    object.insert("solar".into(), dataset.solar.is_some().into());
    let solar = dataset.transmission_of(BandName::Solar).filter(|_| dataset.solar.is_some());
    object.insert("solar_source".into(), dataset.solar_source().words().into());
    object.insert("solar_tau_normal_hemispherical".into(), solar.map(Btdf::tau_normal).into());
    object.insert("solar_tau_hemispherical_hemispherical".into(), solar.map(Btdf::tau_hemispherical).into());
    object.insert("tau_normal_hemispherical".into(), transmission.map(Btdf::tau_normal).into());
    object.insert("tau_hemispherical_hemispherical".into(), transmission.map(Btdf::tau_hemispherical).into());
    object.insert("hemispherical_hemispherical".into(), hemispherical(dataset));
    // An empty list, so that loops over it need no exception.
    object.insert("tau_dir_hem".into(), transmission.map_or_else(|| json!([]), tau_dir_hem));
    object.insert("reciprocity_error".into(), reciprocity(dataset).into());
    object.insert("findings".into(), found.iter().map(finding_json).collect::<Vec<_>>().into());
    Value::Object(object)
}

/// Returns the thermal data that the source states as JSON, with units in the keys.
fn thermal_json(thermal: &Thermal) -> Value {
    let mut object: Map<String, Value> =
        thermal.known().map(|(key, value)| (key.json().to_owned(), value.into())).collect();
    if !thermal.device.is_empty() {
        object.insert("device".into(), thermal.device.clone().into());
    }
    Value::Object(object)
}

/// Returns a finding as JSON: what was found, its meaning, and the repair that it proposes for `cfs repair` (null:
/// none). The key `sure` states whether the repair is certain, so that `auto` makes it.
pub(super) fn finding_json(one: &Diagnosis) -> Value {
    json!({
        "severity": one.finding.severity.word(), "code": one.finding.code, "message": one.finding.message,
        "meaning": meaning(one.finding.code), "repair": one.repair.map(|repair| repair.to_string()), "sure": one.sure,
    })
}

fn hemispherical(dataset: &Dataset) -> Value {
    let components = dataset.visible.components().into_iter();
    let pairs =
        components.filter_map(|c| Some((c.key().to_owned(), dataset.visible.get(c)?.tau_hemispherical().into())));
    Value::Object(pairs.collect())
}

/// Returns the direct-hemispherical transmittance τ of every incident direction as JSON: for the cells of a basis in
/// its order, with the angles of their centres and azimuths as the basis counts them; for a list of directions in its
/// order, with angles in the façade frame. \[°\]
fn tau_dir_hem(btdf: &Btdf) -> Value {
    if let Some(Scattered::Directions(data)) = &btdf.scattered {
        let rows = data.incident().iter().map(|direction| {
            let (theta, phi) = (direction.0.theta().to_degrees(), direction.0.phi().to_degrees());
            json!({"theta_deg": tidy(theta), "phi_deg": tidy(phi), "tau": btdf.tau(*direction)})
        });
        return rows.collect::<Vec<_>>().into();
    }
    let own = match &btdf.scattered {
        Some(Scattered::Cells(matrix)) => Some(matrix.tau_by_cell()),
        _ => None,
    };
    let basis = btdf.incident_basis();
    let rows = basis.cells().enumerate().map(|(k, cell)| {
        let tau = match (own, &btdf.regular) {
            (Some(own), None) => own[k],
            _ => btdf.tau(Incident(cell.centre())),
        };
        json!({"theta_deg": tidy(cell.theta().to_degrees()), "phi_deg": tidy(cell.phi_own.to_degrees()), "tau": tau})
    });
    rows.collect::<Vec<_>>().into()
}

/// Rounds an angle to 1e-9°, which removes the rounding errors of the conversion from radians.
fn tidy(degrees: f64) -> f64 {
    (degrees * 1e9).round() / 1e9
}

/// Returns the reciprocity error between the transmissions of both sides; `None` unless the file contains both.
fn reciprocity(dataset: &Dataset) -> Option<f64> {
    if !dataset.derived.is_empty() {
        return None;
    }
    reciprocity_error(dataset.visible.transmission_front.as_ref()?, dataset.visible.transmission_back.as_ref()?)
}

fn resolution(btdf: &Btdf) -> String {
    match &btdf.scattered {
        None => "no scattering".into(),
        Some(Scattered::Lambert(_)) => "diffuse".into(),
        Some(Scattered::Cells(matrix)) => {
            format!("{} incident × {} emergent directions", matrix.incident().len(), matrix.emergent().len())
        }
        Some(Scattered::Directions(data)) => {
            format!("{} incident directions × {} emergent cells", data.incident().len(), data.emergent().len())
        }
        Some(Scattered::Tree(tree)) => {
            let n = tree.incident_resolution();
            let incident = match tree.rank() {
                TreeRank::Three => format!("{} rings of incidence", n / 2),
                TreeRank::Four => format!("{n} × {n} incident cells"),
            };
            format!("{incident}, {n} × {n} emergent cells, {} leaves", tree.leaves())
        }
    }
}

/// Returns the source of the solar properties, and the solar transmittances, as text.
fn solar(dataset: &Dataset) -> String {
    let source = dataset.solar_source();
    match dataset.transmission_of(BandName::Solar) {
        Some(btdf) if source != SolarSource::Visible => format!(
            "{}: τ normal {:.5}, τ hemispherical {:.5}",
            source.words(),
            btdf.tau_normal(),
            btdf.tau_hemispherical()
        ),
        _ => format!("none: {}", SolarSource::Visible.words()),
    }
}

const fn unit(key: ThermalKey) -> &'static str {
    match key {
        ThermalKey::Conductivity => " W/mK",
        ThermalKey::Width | ThermalKey::Height => " m",
        _ => "",
    }
}

fn to_text(dataset: &Dataset, found: &[Diagnosis]) -> String {
    let mut text = String::new();
    let mut line = |label: &str, value: &str| {
        if !value.is_empty() {
            let _ = writeln!(text, "{label:<22}{}", one_line(value));
        }
    };
    line("Name", &dataset.name);
    line("Manufacturer", &dataset.manufacturer);
    line("Description", &dataset.description.replace('\n', "; "));
    line("State", &dataset.state);
    line("Format", &dataset.format);
    line("Incident basis", &dataset.incident_basis);
    line("Emergent basis", &dataset.emergent_basis);
    line("Resolution", &dataset.transmission().map(resolution).unwrap_or_default());
    line("Thickness", &dataset.thickness.map(|t| format!("{:.3} mm", 1000.0 * t)).unwrap_or_default());
    line("Device", &dataset.thermal.device);
    let thermal = dataset.thermal.known().map(|(key, value)| format!("{} {value}{}", key.word(), unit(key)));
    line("Thermal data", &thermal.collect::<Vec<_>>().join(", "));
    let components = dataset.visible.components().into_iter().map(|component| {
        let derived = if dataset.derived.contains(&component) { " (derived)" } else { "" };
        format!("{}{derived}", component.key().replace('_', " "))
    });
    line("Visible", &components.collect::<Vec<_>>().join(", "));
    line("Solar", &solar(dataset));
    // Other datasets have beams as their cells or their regular part state them.
    let beams = dataset.described.as_ref().map(|_| "by direction, computed again from the description");
    line("Beams", beams.unwrap_or_default());
    if let Some(transmission) = dataset.transmission() {
        line("τ normal", &format!("{:.5}", transmission.tau_normal()));
        line("τ hemispherical", &format!("{:.5}", transmission.tau_hemispherical()));
    }
    if let Some(error) = reciprocity(dataset) {
        line("Reciprocity error", &format!("{:.2} % on average", 100.0 * error));
    }
    if let Some(transmission) = dataset.transmission() {
        let _ = write!(text, "\n{}", tau_table(transmission));
    }
    let _ = writeln!(text, "\nFindings");
    if found.is_empty() {
        let _ = writeln!(text, "  none");
    }
    let mut last = None;
    for Diagnosis { finding, repair, sure } in found {
        // A finding that asks for several repairs is said once.
        if last.replace(finding) != Some(finding) {
            let _ =
                writeln!(text, "  {:<8} {:<22} {}", finding.severity.word(), finding.code, one_line(&finding.message));
            let meaning = meaning(finding.code);
            if finding.severity != Severity::Info && !meaning.is_empty() {
                let _ = writeln!(text, "{:34}{meaning}", "");
            }
        }
        if let Some(repair) = repair {
            let auto = if *sure { " (beyond doubt: auto)" } else { "" };
            let _ = writeln!(text, "{:34}offers: --repair {repair}{auto}", "");
        }
    }
    text
}

/// Returns a table, as text, of the direct-hemispherical transmittance τ at incidences of 0°, 30° and 60° from the
/// right, from above, from the left and from below.
fn tau_table(btdf: &Btdf) -> String {
    let mut text = String::from("τ, light from            right      above      left       below\n");
    for theta in [0.0_f64, 30.0, 60.0] {
        let _ = write!(text, "  θ = {theta:>2}°              ");
        let azimuths: &[f64] = if theta == 0.0 { &[0.0] } else { &[0.0, 90.0, 180.0, 270.0] };
        for phi in azimuths {
            let direction = crate::compute::direction::Dir::from_theta_phi(theta.to_radians(), phi.to_radians());
            let _ = write!(text, " {:<10.5}", btdf.tau(Incident(direction)));
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    text
}
