//! Choices of the export dialog: content, format, options and name. They are stored from one start of the program to
//! the next.

use crate::app::scene::Selection;
use crate::app::scene::moment;
use crate::app::shell::safe_name::safe;
use crate::catalogue::Product;
use crate::formats::{Format, LuminaireFormat};
use crate::report::{Size, TileKind, tender};
use crate::study::control::year::CONTROLLED;
use crate::study::rank::Look as Choosing;
use crate::study::scene_file::{SceneFile, SystemKeys};
use crate::study::year::Look;
use crate::texts::{Language, Text, export as texts};
use jiff::civil::{Date, DateTime};
use std::path::Path;

/// Kind of content of an export.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum What {
    /// Picture of a tile.
    #[default]
    Picture,
    /// Report as PDF.
    Report,
    /// Luminaire file of the aperture at the scene's date and time.
    Luminaire,
    /// Luminaire files for several dates, times and states.
    Series,
    /// Numbers of a tile.
    Table,
    /// Dataset of the current state.
    Dataset,
    /// Product with all its states.
    Package,
    /// Scene file (TOML).
    Scene,
}

impl What {
    /// All kinds of content, in the order of the dialog.
    pub const ALL: [Self; 8] = [
        Self::Picture,
        Self::Report,
        Self::Luminaire,
        Self::Series,
        Self::Table,
        Self::Dataset,
        Self::Package,
        Self::Scene,
    ];

    /// Returns label and tooltip of the kind of content.
    pub const fn words(self) -> [Text; 2] {
        match self {
            Self::Picture => [texts::PICTURE, texts::PICTURE_TIP],
            Self::Report => [texts::REPORT, texts::REPORT_TIP],
            Self::Luminaire => [texts::LUMINAIRE, texts::LUMINAIRE_TIP],
            Self::Series => [texts::SERIES, texts::SERIES_TIP],
            Self::Table => [texts::TABLE, texts::TABLE_TIP],
            Self::Dataset => [texts::DATASET, texts::DATASET_TIP],
            Self::Package => [texts::PACKAGE, texts::PACKAGE_TIP],
            Self::Scene => [texts::SCENE, texts::SCENE_TIP],
        }
    }
}

/// Kind of report in an export.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum ReportKind {
    /// Report on the scene.
    #[default]
    Study,
    /// Product sheet.
    Sheet,
}

/// Months, hours and states of a series of luminaire files.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Series {
    /// Months that are included, January first, each with its 21st day.
    pub months: [bool; 12],
    /// First and last hour of the day. \[h\]
    pub hours: [u8; 2],
    /// Step between the hours, at least 1. \[h\]
    pub step: u8,
    /// Whether all states of the product are included; otherwise only the current one.
    pub all_states: bool,
}

impl Default for Series {
    fn default() -> Self {
        // The solstices and an equinox say most.
        let months = std::array::from_fn(|month| [2, 5, 11].contains(&month));
        Self { months, hours: [9, 17], step: 2, all_states: false }
    }
}

/// All choices of the export dialog.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Choices {
    /// Kind of content of the export.
    pub what: What,
    /// Tile that is exported as a picture or as numbers.
    pub tile: TileKind,
    /// Size of exported pictures.
    pub size: Size,
    /// Whether pictures are written as vectors (.svg) instead of pixels (.png).
    pub vector: bool,
    /// Whether pictures have colours and lines for black-and-white print.
    pub print: bool,
    /// Whether a picture has header and footer with product, location, time, uncertainty and origin.
    pub caption: bool,
    /// Kind of the exported report.
    pub report: ReportKind,
    /// Title of a study report; empty: the product's name.
    pub title: String,
    /// Question that a study report answers.
    pub question: String,
    /// Whether a study report includes the candidates of the comparison.
    pub comparison: bool,
    /// Template of the tender text of a product sheet.
    pub tender: String,
    /// Format of luminaire files.
    #[serde(alias = "ies", with = "format_key")]
    pub luminaire: LuminaireFormat,
    /// Whether the aperture is split into a grid of luminaires that light a room within 1 %, with an index of the
    /// files.
    pub tiles: bool,
    /// Whether undeviated direct sun is left out of the luminaire files, because the reading program computes it
    /// itself.
    pub without_beam: bool,
    /// Dates, times and states of a series of luminaire files.
    pub series: Series,
    /// Whether datasets are written as `.btdf.txt` instead of BSDF XML.
    pub text: bool,
    /// Whether CSV tables have decimal commas, and semicolons between columns.
    pub decimal_comma: bool,
}

impl Default for Choices {
    fn default() -> Self {
        Self {
            what: What::default(),
            tile: TileKind::Room,
            size: Size::default(),
            vector: false,
            print: false,
            caption: true,
            report: ReportKind::default(),
            title: String::new(),
            question: String::new(),
            comparison: true,
            tender: tender::TEMPLATE.to_owned(),
            luminaire: LuminaireFormat::Eulumdat,
            tiles: false,
            without_beam: false,
            series: Series::default(),
            text: false,
            decimal_comma: false,
        }
    }
}

/// Format of luminaire files in stored choices, as its extension.
mod format_key {
    use crate::formats::LuminaireFormat;
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(format: &LuminaireFormat, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(format.extension())
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<LuminaireFormat, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Stored {
            Extension(String),
            /// Whether it is IES LM-63, stored by earlier versions.
            IsIes(bool),
        }
        let extension = match Stored::deserialize(from)? {
            Stored::Extension(extension) => extension,
            Stored::IsIes(ies) => if ies { ".ies" } else { ".ldt" }.to_owned(),
        };
        // A format of a later version is no reason to refuse all choices.
        Ok(LuminaireFormat::from_name(&extension).unwrap_or(LuminaireFormat::Eulumdat))
    }
}

/// Maximum number of files of a series; a larger number is refused as a probable mistake.
pub const MOST_FILES: usize = 600;

impl Choices {
    /// Returns the extension of the exported file, with its dot.
    pub const fn ending(&self) -> &'static str {
        match self.what {
            What::Picture if self.vector => ".svg",
            What::Picture => ".png",
            What::Report => ".pdf",
            What::Luminaire => self.luminaire.extension(),
            What::Series | What::Table => ".csv",
            What::Dataset if self.text => ".btdf.txt",
            What::Dataset => ".xml",
            What::Package => ".cfsp",
            What::Scene => ".toml",
        }
    }

    /// Returns the format in which a dataset is exported.
    pub const fn format(&self) -> Format {
        if self.text { Format::BtdfText } else { Format::BsdfXml }
    }
}

/// Preview of an export in the dialog.
pub enum Preview {
    /// Picture: width and height \[px\], pixel colours (RGBA) row by row, and a note.
    Picture([usize; 2], Vec<u8>, String),
    /// First lines of a text file, and its length. \[bytes\]
    Text(String, usize),
    /// Names of the files that will be written, each with a description.
    Files(Vec<(String, String)>),
}

/// Key of a preview: everything that it depends on.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// Choices of the dialog.
    pub choices: Choices,
    /// Current scene.
    pub scene: SceneFile,
    /// Selected product and state.
    pub selection: Selection,
    /// Incident direction that the user chose, as the bits of its vector.
    pub incident: Option<[u64; 3]>,
    /// Tile of the comparison, and position of the reference candidate.
    pub compared: (TileKind, usize),
    /// Revision of the annual simulation, and its display settings.
    pub year: (u64, Look),
    /// Revision of the ranking, and its display settings.
    pub ranking: (u64, Choosing),
    /// Language of the texts.
    pub language: Language,
}

/// Member of a series: one luminaire file for a date, time and state.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// Name of the file.
    pub name: String,
    /// Scene of the file.
    pub scene: SceneFile,
    /// Date and time of the member, in the scene's local time.
    pub time: DateTime,
    /// Key of the state; empty: as in the scene.
    pub state: String,
}

/// Returns the members of a series, with their file names beside an index at `path`. Times with the sun below the
/// horizon are left out.
pub fn moments(
    choices: &Choices,
    scene: &SceneFile,
    base: &Path,
    product: Option<&Product>,
    path: &Path,
) -> Vec<Moment> {
    let Some(now) = moment::of(scene) else { return Vec::new() };
    let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let stem = name.strip_suffix("_index").unwrap_or(&name).to_owned();
    let states: Vec<String> = match product {
        Some(product) if choices.series.all_states => product.states.iter().map(|state| state.key.clone()).collect(),
        _ => vec![String::new()],
    };
    let Series { months, hours: [first, last], step, .. } = &choices.series;
    let mut list = Vec::new();
    for month in (1..=12_i8).zip(months).filter(|(_, wanted)| **wanted).map(|(month, _)| month) {
        let Ok(date) = Date::new(now.year(), month, 21) else { continue };
        for hour in (*first..=*last).step_by(usize::from((*step).max(1))) {
            let Ok(time) = jiff::civil::Time::new(hour.min(23).cast_signed(), 0, 0, 0) else { continue };
            let time = date.to_datetime(time);
            let mut at = scene.clone();
            moment::set(&mut at, time);
            if moment::sun(&at, base).is_none_or(|(altitude, _)| altitude <= 0.0) {
                continue;
            }
            for state in &states {
                let mut scene = at.clone();
                if !state.is_empty() {
                    in_state(&mut scene, state);
                }
                let of = if state.is_empty() { String::new() } else { format!("_{}", safe(state)) };
                let when = time.strftime("%m-%dT%H%M");
                list.push(Moment {
                    name: format!("{stem}_{when}{of}{}", choices.luminaire.extension()),
                    scene,
                    time,
                    state: state.clone(),
                });
            }
        }
    }
    list
}

/// Sets the state of every aperture of a scene that contains a product of the catalogue.
fn in_state(scene: &mut SceneFile, key: &str) {
    scene.control = None;
    for aperture in &mut scene.aperture {
        aperture.control = None;
        if let SystemKeys::Catalogue { state, .. } = &mut aperture.system
            && (state.as_deref() != Some(key) || state.as_deref() == Some(CONTROLLED))
        {
            *state = Some(key.to_owned());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::first_scene;

    #[test]
    fn a_series_has_a_file_for_each_hour_with_sun() {
        let choices = Choices::default();
        let list = moments(&choices, &first_scene(), Path::new(""), None, Path::new("/x/blind_index.csv"));
        let names: Vec<&str> = list.iter().map(|moment| &*moment.name).collect();
        // In December the sun is down at 17 h.
        assert_eq!(list.len(), 5 + 5 + 4);
        assert_eq!((names[0], names[13]), ("blind_03-21T0900.ldt", "blind_12-21T1500.ldt"));
        let mut dark = first_scene();
        dark.sky.time = None;
        assert!(moments(&choices, &dark, Path::new(""), None, Path::new("a.csv")).is_empty());
    }

    #[test]
    fn stored_choices_are_read_those_of_earlier_versions_too() {
        let choices = Choices { luminaire: LuminaireFormat::ALL[1], ..Choices::default() };
        let stored = serde_json::to_string(&choices).unwrap();
        for stored in [stored.as_str(), r#"{"ies": true}"#] {
            assert_eq!(serde_json::from_str::<Choices>(stored).unwrap(), choices);
        }
        assert_eq!(serde_json::from_str::<Choices>(r#"{"ies": false}"#).unwrap(), Choices::default());
    }

    #[test]
    fn endings_follow_the_choices() {
        let mut choices = Choices::default();
        let mut seen = Vec::new();
        for what in What::ALL {
            choices.what = what;
            for (vector, text) in [(false, false), (true, true)] {
                (choices.vector, choices.text) = (vector, text);
                choices.luminaire = LuminaireFormat::ALL[usize::from(text)];
                seen.push(choices.ending());
            }
        }
        seen.dedup();
        let wanted = [".png", ".svg", ".pdf", ".ldt", ".ies", ".csv", ".xml", ".btdf.txt", ".cfsp", ".toml"];
        assert_eq!(seen, wanted);
    }
}
