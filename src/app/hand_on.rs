//! Handing on: what, in which form, and under which name. The choices are kept from one start to the next.

use super::moment;
use super::safe_name::safe;
use super::scene::Selection;
use crate::catalogue::Product;
use crate::formats::Format;
use crate::report::{Size, TileKind, tender};
use crate::study::control::year::CONTROLLED;
use crate::study::rank::Look as Choosing;
use crate::study::scene_file::{SceneFile, SystemKeys};
use crate::study::year::Look;
use crate::texts::{Language, Text, hand_on as texts};
use jiff::civil::{Date, DateTime};
use std::path::Path;

/// What is handed on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum What {
    /// A tile as a picture.
    #[default]
    Picture,
    /// A PDF.
    Report,
    /// The window as a luminaire at the scene's moment.
    Luminaire,
    /// The same for many moments and states.
    Series,
    /// A tile's numbers.
    Table,
    /// The data of the state that is shown.
    Dataset,
    /// The product with all its states.
    Package,
    /// Everything that this study needs, as text.
    Scene,
}

impl What {
    /// All, as they are offered.
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

    /// Its name, and one sentence.
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

/// Which report.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum ReportKind {
    /// On the scene.
    #[default]
    Study,
    /// On its product.
    Sheet,
}

/// Months, hours and states of a series.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Series {
    /// Which months, on their 21st.
    pub months: [bool; 12],
    /// First and last hour of the day.
    pub hours: [u8; 2],
    /// Hours from one to the next, at least 1.
    pub step: u8,
    /// All states of the product, else the one that is shown.
    pub all_states: bool,
}

impl Default for Series {
    fn default() -> Self {
        // The solstices and an equinox say most.
        let months = std::array::from_fn(|month| [2, 5, 11].contains(&month));
        Self { months, hours: [9, 17], step: 2, all_states: false }
    }
}

/// All choices.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Choices {
    /// What.
    pub what: What,
    /// Of pictures and tables: which tile.
    pub tile: TileKind,
    /// Of pictures: their size.
    pub size: Size,
    /// Vectors (.svg) instead of pixels (.png).
    pub vector: bool,
    /// For printers.
    pub print: bool,
    /// Words round a picture.
    pub caption: bool,
    /// Of reports: which.
    pub report: ReportKind,
    /// Title of a study; empty: the product's name.
    pub title: String,
    /// What it is to answer.
    pub question: String,
    /// Of a study: with the candidates of the tray.
    pub comparison: bool,
    /// Template of a product sheet's tender text.
    pub tender: String,
    /// Luminaires as LM-63 (.ies) instead of EULUMDAT (.ldt).
    pub ies: bool,
    /// The aperture cut into as many luminaires as light a room rightly, with an index.
    pub tiles: bool,
    /// The straight sunbeam is left to the other program.
    pub without_beam: bool,
    /// Of a series.
    pub series: Series,
    /// Datasets as text (.btdf.txt) instead of BSDF XML.
    pub text: bool,
    /// Tables with decimal commas and semicolons.
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
            ies: false,
            tiles: false,
            without_beam: false,
            series: Series::default(),
            text: false,
            decimal_comma: false,
        }
    }
}

/// Most files of a series: more are a mistake of the choice.
pub const MOST_FILES: usize = 600;

impl Choices {
    /// Ending of the file, with its point.
    pub const fn ending(&self) -> &'static str {
        match self.what {
            What::Picture if self.vector => ".svg",
            What::Picture => ".png",
            What::Report => ".pdf",
            What::Luminaire if self.ies => ".ies",
            What::Luminaire => ".ldt",
            What::Series | What::Table => ".csv",
            What::Dataset if self.text => ".btdf.txt",
            What::Dataset => ".xml",
            What::Package => ".cfsp",
            What::Scene => ".toml",
        }
    }

    /// Format of a dataset.
    pub const fn format(&self) -> Format {
        if self.text { Format::BtdfText } else { Format::BsdfXml }
    }
}

/// What is seen of what would be written.
pub enum Preview {
    /// A picture: width, height, and pixels row by row; and what is to be said of it.
    Picture([usize; 2], Vec<u8>, String),
    /// The first lines of a text, and its length in bytes.
    Text(String, usize),
    /// Files that will be written, and what is known of each.
    Files(Vec<(String, String)>),
}

/// The dialog.
#[derive(Default)]
pub struct HandOn {
    /// What the preview is of; `None`: none was asked for.
    pub asked: Option<Key>,
    /// The last preview, or why there is none.
    pub shown: Option<Result<Preview, String>>,
    /// Counts the previews, for the texture.
    pub revision: u64,
    /// A tile's numbers, and of which choices they are.
    pub numbers: Option<(Key, String)>,
    /// The name that was offered; another in the field is the user's own.
    pub offered: String,
}

/// All that a preview hangs on.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// What is asked.
    pub choices: Choices,
    /// Of which scene.
    pub scene: SceneFile,
    /// Of which product.
    pub selection: Selection,
    /// For which incidence, to the bit.
    pub incident: Option<[u64; 3]>,
    /// Which tile of the candidates, and which of them the others are less.
    pub compared: (TileKind, usize),
    /// Which year was computed, and how it is looked at.
    pub year: (u64, Look),
    /// Which ranking is known, and how it is looked at.
    pub ranking: (u64, Choosing),
    /// In which language.
    pub language: Language,
}

/// One file of a series.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// Its name.
    pub name: String,
    /// Its scene.
    pub scene: SceneFile,
    /// When.
    pub time: DateTime,
    /// Key of the state; empty: as the scene has it.
    pub state: String,
}

/// The files of a series beside an index at `path`. Moments with the sun below the horizon are left out.
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
    let ending = if choices.ies { "ies" } else { "ldt" };
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
                list.push(Moment { name: format!("{stem}_{when}{of}.{ending}"), scene, time, state: state.clone() });
            }
        }
    }
    list
}

/// Puts every aperture from the catalogue into a state.
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
    fn endings_follow_the_choices() {
        let mut choices = Choices::default();
        let mut seen = Vec::new();
        for what in What::ALL {
            choices.what = what;
            for (vector, text) in [(false, false), (true, true)] {
                (choices.vector, choices.text, choices.ies) = (vector, text, text);
                seen.push(choices.ending());
            }
        }
        seen.dedup();
        let wanted = [".png", ".svg", ".pdf", ".ldt", ".ies", ".csv", ".xml", ".btdf.txt", ".cfsp", ".toml"];
        assert_eq!(seen, wanted);
    }
}
