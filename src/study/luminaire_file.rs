//! Luminaire file of an aperture: format by file extension, orientation and angular step as chosen or from the data,
//! and a header that names scene, sky and product.

use super::moment;
use super::scene_file::{IdealKind, RANKED, SceneFile, SkyModelKey, SystemKeys, TimeKey};
use super::sky::{Source, illuminances};
use crate::compute::estimate::Estimate;
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::{Aim, CGammaTable, Step};
use crate::formats::luminaire::{Description, Luminaire};
use crate::formats::{FileKind, LuminaireFormat, lid_tables};
use std::path::Path;

/// Format of a file with a luminous intensity distribution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LidFormat {
    /// Luminaire file, `.ldt` or `.ies`.
    Luminaire(LuminaireFormat),
    /// Table of C, γ and luminous intensity \[cd\], `.csv`.
    Csv,
    /// Polar diagram of the intensities, `.png`.
    Png,
    /// Polar diagram of the intensities, `.svg`.
    Svg,
}

/// Error when a luminaire file is made.
#[derive(Debug, thiserror::Error)]
pub enum LuminaireFileError {
    /// File extension that is not that of a supported format.
    #[error("extension \"{0}\" names no format for a luminous-intensity distribution (ldt, ies, csv, png or svg)")]
    Extension(String),
    /// Polar diagram that could not be encoded as an image.
    #[error("the diagram could not be encoded: {0}")]
    Image(#[from] png::EncodingError),
}

impl LidFormat {
    /// Returns the format for a file's extension.
    pub fn of(path: &Path) -> Result<Self, LuminaireFileError> {
        if let Some(format) = LuminaireFormat::from_name(&path.to_string_lossy()) {
            return Ok(Self::Luminaire(format));
        }
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match extension.as_str() {
            "csv" => Ok(Self::Csv),
            "png" => Ok(Self::Png),
            "svg" => Ok(Self::Svg),
            _ => Err(LuminaireFileError::Extension(extension)),
        }
    }

    /// Returns the kind of the file.
    pub const fn kind(self) -> FileKind {
        match self {
            Self::Luminaire(format) => FileKind::Luminaire(format),
            Self::Csv => FileKind::Csv,
            Self::Png => FileKind::Png,
            Self::Svg => FileKind::Svg,
        }
    }
}

/// Luminaire file in memory, with its properties.
#[derive(Debug, Clone, PartialEq)]
pub struct LuminaireFile {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Luminous flux of the aperture into the room. \[lm\]
    pub flux: Estimate,
    /// Factor by which the intensities of the table were multiplied so that its zonal sum is the flux of the aperture.
    pub scaled_by: f64,
    /// Largest luminous intensity in the table. \[cd\]
    pub peak: f64,
    /// Orientation of the luminaire: directions of C = 0 and γ = 0 in the room.
    pub aim: Aim,
    /// Step of the table in C and γ.
    pub step: Step,
}

/// Tabulates a luminous intensity distribution and encodes it as a luminaire file. `text`: header; `aim`: orientation,
/// `None` for that of the aperture; `step`: angular step, `None` for one that suits the data.
pub fn encode(
    lid: &Lid,
    text: Description,
    format: LidFormat,
    aim: Option<Aim>,
    step: Option<Step>,
) -> Result<LuminaireFile, LuminaireFileError> {
    let aim = aim.unwrap_or_else(|| Aim::of(lid.surface));
    let step = step.unwrap_or_else(|| Step::for_lid(lid));
    let table = CGammaTable::new(lid, aim, step);
    let luminaire = Luminaire::from_table(&table, lid.size, text);
    let bytes = bytes_of(&luminaire, format)?;
    Ok(LuminaireFile { bytes, flux: table.flux, scaled_by: table.scaled_by, peak: luminaire.peak(), aim, step })
}

/// Encodes the table of a luminaire in one of the formats.
pub(super) fn bytes_of(luminaire: &Luminaire, format: LidFormat) -> Result<Vec<u8>, LuminaireFileError> {
    Ok(match format {
        LidFormat::Luminaire(format) => format.write(luminaire),
        LidFormat::Csv => lid_tables::to_csv(luminaire).into_bytes(),
        LidFormat::Png => lid_tables::polar_diagram(luminaire).to_png()?,
        LidFormat::Svg => lid_tables::polar_diagram(luminaire).to_svg().into_bytes(),
    })
}

/// Returns the header of a luminaire file, in English, from the keys of the scene file: scene, product, sky, sun and
/// time. `base`: folder of the scene.
///
/// `aperture` counts from 0 and must exist; `date` is the day of issue.
pub fn describe(scene_name: &str, scene: &SceneFile, base: &Path, aperture: usize, date: &str) -> Description {
    let keys = &scene.aperture[aperture];
    let system = match &keys.system {
        SystemKeys::Ideal { kind, transmittance } => {
            let kind = match kind {
                IdealKind::Transparent => "transparent",
                IdealKind::Diffuse => "diffuse",
            };
            format!("ideal {kind}, transmittance {transmittance}")
        }
        SystemKeys::File { path, state } => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            with_state(format!("file {name}"), state.as_deref())
        }
        SystemKeys::Catalogue { key, state } => with_state(key.clone(), state.as_deref()),
        SystemKeys::Family { states, state } => {
            let files = states.iter().map(|one| one.file.file_name().unwrap_or_default().to_string_lossy());
            with_state(format!("files {}", files.collect::<Vec<_>>().join(", ")), state.as_deref())
        }
        SystemKeys::Ranked => RANKED.to_owned(),
        SystemKeys::Luminaires { index, set } => {
            let name = index.file_name().unwrap_or_default().to_string_lossy();
            set.as_ref().map_or_else(|| format!("files of {name}"), |set| format!("files of {name}, {set}"))
        }
    };
    let program = concat!("cfs ", env!("CARGO_PKG_VERSION"));
    Description {
        report: format!("{scene_name}, aperture {}", aperture + 1),
        laboratory: format!("computed by {program}"),
        date: date.to_owned(),
        manufacturer: program.to_owned(),
        number: format!("aperture {}; {}", aperture + 1, situation(scene, base)),
        name: format!("Daylight aperture, {system}"),
        lamp: "daylight".to_owned(),
        remarks: vec![
            format!("Daylight through one aperture of the scene {scene_name}, not an electric luminaire."),
            format!(
                "Place, time, sun (altitude/bearing in degrees), facade (bearing), sky: {}.",
                situation(scene, base)
            ),
            sky_remark(scene),
            "Light that the host's own room sends to the aperture is not reflected: give the window a reflectance."
                .to_owned(),
        ],
    }
}

/// Returns place, time, sky, sun and façade of a scene in short form, for one line of EULUMDAT.
fn situation(scene: &SceneFile, base: &Path) -> String {
    let SceneFile { site, sky, .. } = scene;
    let mut parts = Vec::new();
    if let (Some(latitude), Some(longitude)) = (site.latitude, site.longitude) {
        let [north, east] = [if latitude < 0.0 { 'S' } else { 'N' }, if longitude < 0.0 { 'W' } else { 'E' }];
        parts.push(format!("{:.1}{north} {:.1}{east}", latitude.abs(), longitude.abs()));
    }
    parts.extend(sky.time.as_ref().map(TimeKey::text));
    parts.extend(
        moment::sun(scene, base).map(|(altitude, azimuth)| format!("sun {:.1}/{azimuth:.1}", altitude.to_degrees())),
    );
    parts.push(format!("facade {:.0}", site.azimuth));
    parts.push(match sky.model {
        SkyModelKey::Cie => format!("CIE {}", sky.cie_type.unwrap_or_default()),
        model => model.words()[1].to_owned(),
    });
    parts.join("; ")
}

fn with_state(name: String, state: Option<&str>) -> String {
    state.map_or_else(|| name.clone(), |state| format!("{name}, state {state}"))
}

/// Returns a remark on the sky model and the illuminances of a scene, for the header of a luminaire file.
fn sky_remark(scene: &SceneFile) -> String {
    let sky = &scene.sky;
    let model = match sky.model {
        SkyModelKey::Cie => {
            format!("CIE type {}", sky.cie_type.map_or_else(|| "unstated".to_owned(), |t| t.to_string()))
        }
        model => model.words()[2].to_owned(),
    };
    let mut parts = vec![format!("Sky {model}")];
    if let Some(weather) = &sky.weather {
        parts.push(format!("weather {}", weather.file_name().unwrap_or_default().to_string_lossy()));
    }
    let mut add = |name: &str, value: Option<f64>, unit: &str| {
        if let Some(value) = value {
            parts.push(format!("{name} {value} {unit}"));
        }
    };
    // Stated because it is used, also if the file does not contain it.
    let followed = illuminances(sky, &scene.site).ok().flatten().filter(|light| light.source != Source::Stated);
    add("E_dh", followed.map_or(sky.diffuse_horizontal, |light| Some(light.diffuse_horizontal.round())), "lx");
    add("E_dn", followed.map_or(sky.sun.direct_normal, |light| Some(light.direct_normal.round())), "lx");
    add("diffuse horizontal irradiance", sky.diffuse_horizontal_irradiance, "W/m2");
    add("direct horizontal irradiance", sky.direct_horizontal_irradiance, "W/m2");
    add("sun altitude", sky.sun.altitude, "deg");
    add("sun azimuth", sky.sun.azimuth, "deg");
    add("facade azimuth", Some(scene.site.azimuth), "deg");
    parts.push(format!("ground reflectance {}", scene.site.ground_reflectance));
    if scene.has_outside() {
        let building = if scene.building.is_some() { " and the building" } else { "" };
        let (boxes, height) = (scene.outside.len(), scene.site.ground_height);
        parts.push(format!("{boxes} boxes{building} outside, ground at {height} m"));
    }
    if let Some(light) = followed {
        parts.push(format!("illuminances of a {}", light.origin()));
    }
    if let Some(time) = &sky.time {
        parts.push(format!("time {}", time.text()));
    }
    format!("{}.", parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::lid::EmergentLuminance;

    const SCENE: &str = r#"
[room]
width = 4.0
depth = 6.0
height = 3.0
reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }
[[aperture]]
surface = "facade"
origin = [0.0, 1.0]
size = [4.0, 1.5]
system = { file = "systems/blind.xml", state = "45" }
[site]
azimuth = 170.0
latitude = 48.8
longitude = 9.2
ground_reflectance = 0.2
[sky]
model = "cie"
type = 12
diffuse_horizontal = 12000.0
sun = { altitude = 20.0, azimuth = 180.0, direct_normal = 65000.0 }
[sensors]
points = [[2.0, 2.0, 0.85]]
normal = [0.0, 0.0, 1.0]
"#;

    #[test]
    fn header_names_scene_product_sky_and_opening() {
        let scene: SceneFile = toml::from_str(SCENE).unwrap();
        let text = describe("office.toml", &scene, Path::new(""), 0, "2026-03-21");
        let parts = vec![EmergentLuminance::Uniform(500.0)];
        let lid = Lid { surface: Surface::Facade, size: [4.0, 1.5], parts, beams: Vec::new() };
        let format = LidFormat::of(Path::new("a.IES")).unwrap();
        // EULUMDAT has a line of 78 characters for it.
        let ldt = encode(&lid, text.clone(), LidFormat::Luminaire(LuminaireFormat::Eulumdat), None, None).unwrap();
        let ldt = String::from_utf8(ldt.bytes).unwrap();
        assert!(ldt.contains("\r\naperture 1; 48.8N 9.2E; sun 20.0/180.0; facade 170; CIE 12\r\n"), "{}", &ldt[..400]);
        assert!(ldt.contains("blind.xml, state 45"));
        let file = encode(&lid, text, format, None, None).unwrap();
        // Continuation lines cut sentences anywhere.
        let file = String::from_utf8(file.bytes).unwrap().replace("\r\n[MORE]", "");
        for piece in [
            "office.toml, aperture 1",
            "[ISSUEDATE] 2026-03-21",
            "blind.xml, state 45",
            "CIE type 12",
            "E_dh 12000 lx",
            "E_dn 65000 lx",
            "48.8N 9.2E; sun 20.0/180.0; facade 170; CIE 12",
            "4.0000 m x 1.5000 m",
            "must subdivide",
            env!("CARGO_PKG_VERSION"),
        ] {
            assert!(file.contains(piece), "{piece}\n{}", &file[..2000]);
        }
    }

    #[test]
    fn unknown_extension_lists_the_known_ones() {
        let error = LidFormat::of(Path::new("a.dwg")).unwrap_err().to_string();
        assert!(error.contains("dwg") && error.contains("ldt"), "{error}");
    }
}
