//! Creation of exported files and of their previews, in jobs.

use crate::app::export::choices::{Choices, MOST_FILES, Moment, Preview, ReportKind, What, moments};
use crate::app::results::engine::{Engine, Question};
use crate::app::shell::disk::{create_folder, write_several};
use crate::app::shell::error::AppError;
use crate::catalogue::{Catalogue, NewProduct, Product, StateName};
use crate::compute::btdf::Dataset;
use crate::compute::direction::Incident;
use crate::compute::estimate::{Cancelled, Progress};
use crate::drawing::colours::Inks;
use crate::drawing::{Drawing, missing_characters};
use crate::formats::decimal_comma::with_decimal_commas;
use crate::formats::luminaire_index::{self, Row};
use crate::formats::write_dataset;
use crate::report::comparison::Comparison;
use crate::report::product::{Sheet, pages as sheet_pages};
use crate::report::study_report::{Study, pages as study_pages};
use crate::report::{Look as PictureLook, Size, TileKind, pdf, picture};
use crate::study::StudyError;
use crate::study::inputs::inputs_of;
use crate::study::luminaire_file::LidFormat;
use crate::study::luminaire_set::{LuminaireOptions, LuminaireSet, TileFile, Tiles, tile_name};
use crate::study::moment;
use crate::study::rank::{Look as Choosing, Shortlist};
use crate::study::scene_file::SceneFile;
use crate::study::subject::Wanted;
use crate::study::year::{Annual, Look};
use crate::texts::export as texts;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Input of an export job: choices, scene, and results that exist already.
pub struct Order {
    /// Choices of the export dialog.
    pub choices: Choices,
    /// Scene, its folder and the catalogue.
    pub question: Question,
    /// Incident direction that the user chose; `None`: that of the sun.
    pub incident: Option<Incident>,
    /// Selected product, if there is one.
    pub product: Option<Arc<Product>>,
    /// Dataset of the current state, if there is one.
    pub dataset: Option<Arc<Dataset>>,
    /// Tile of the comparison in a study report, and position of the reference candidate.
    pub compared: (TileKind, usize),
    /// Path of the scene's file, if it has one.
    pub scene_path: Option<PathBuf>,
    /// Annual simulation of the scene, if it was computed, with its display settings.
    pub year: Option<(Arc<Annual>, Look)>,
    /// Ranking of the scene, if there is one, with its display settings.
    pub ranking: Option<(Arc<Shortlist>, Choosing)>,
    /// Numbers of the exported tile as CSV, if they are requested.
    pub numbers: Option<String>,
    /// Engine for the computations.
    pub engine: Arc<dyn Engine>,
}

/// Paths of files with their bytes.
type Files = Vec<(PathBuf, Vec<u8>)>;

/// Maximum width and height of a preview's picture. \[px\]
const PREVIEW: f64 = 900.0;
/// Number of lines of a text file that a preview shows.
const LINES: usize = 40;

fn check(progress: &dyn Progress) -> Result<(), AppError> {
    if progress.cancelled() { Err(AppError::Study(StudyError::Cancelled(Cancelled))) } else { Ok(()) }
}

impl Order {
    const fn inks(&self) -> &'static Inks {
        if self.choices.print { &Inks::PRINT } else { &Inks::LIGHT }
    }

    /// Draws the chosen tile as an exported picture.
    pub(super) fn picture(&self, progress: &dyn Progress) -> Result<Drawing, AppError> {
        let choices = &self.choices;
        // Before anything is computed: settings of another day may hold any number.
        let Size { width, height, unit } = choices.size;
        let look =
            PictureLook { size: Size::new(width, height, unit)?, print: choices.print, caption: choices.caption };
        // The year is the one that the window has: it is not computed again for a picture.
        let wanted = Wanted { year: false, ..choices.tile.needs() };
        let mut subject = self.engine.subject(&self.question, self.incident, wanted, progress)?;
        subject.year.clone_from(&self.year);
        subject.ranking.clone_from(&self.ranking);
        Ok(picture(&subject, choices.tile, &look)?)
    }

    /// Returns title and pages of a report.
    fn report(&self, progress: &dyn Progress) -> Result<(String, Vec<Drawing>), AppError> {
        let choices = &self.choices;
        let subject = self.engine.subject(&self.question, self.incident, Wanted::ALL, progress)?;
        let pages = match choices.report {
            ReportKind::Sheet => sheet_pages(&Sheet { subject: &subject, tender: &choices.tender, inks: self.inks() })?,
            ReportKind::Study => {
                let scene = &self.question.scene;
                let asked = SceneFile { year: None, rank: None, compare: Vec::new(), ..scene.clone() };
                let scene = if choices.comparison { scene } else { &asked };
                let wanted =
                    Wanted { lid: true, room: true, control: self.compared.0 == TileKind::Control, year: false };
                let comparison = Comparison::of(scene, self.compared, |scene, name| {
                    check(progress)?;
                    let question = Question { scene: scene.clone(), ..self.question.clone() };
                    self.engine.subject(&question, self.incident, wanted, progress).map_err(|error| error.about(name))
                })?;
                study_pages(&Study {
                    subject: &subject,
                    title: choices.title.trim(),
                    question: choices.question.trim(),
                    comparison: comparison.as_ref(),
                    inks: self.inks(),
                })?
            }
        };
        Ok((subject.name, pages))
    }

    /// Returns the bytes of an export that is a single file. `warning` is set if the file cannot show something
    /// unchanged, e.g. characters.
    fn bytes(&self, path: &Path, warning: &mut Option<String>, progress: &dyn Progress) -> Result<Vec<u8>, AppError> {
        let choices = &self.choices;
        Ok(match choices.what {
            What::Picture => {
                let drawing = self.picture(progress)?;
                if choices.vector {
                    choices.size.svg(&drawing).into_bytes()
                } else {
                    let bytes = choices.size.png(&drawing)?;
                    *warning = missing_characters(&[drawing]);
                    bytes
                }
            }
            What::Report => {
                let (title, pages) = self.report(progress)?;
                *warning = missing_characters(&pages);
                pdf::write(&pages, &title)?
            }
            What::Luminaire if self.choices.without_beam => {
                self.luminaires(&self.question.scene, path, progress)?.files.swap_remove(0).bytes
            }
            What::Luminaire => {
                let lid = self.engine.lid(&self.question, progress)?;
                self.engine.luminaire(&lid, path)?
            }
            What::Table => {
                let table = self.numbers.as_deref().ok_or(AppError::NoNumbers)?;
                if choices.decimal_comma { with_decimal_commas(table) } else { table.as_bytes().to_vec() }
            }
            What::Dataset => {
                let dataset = self.dataset.as_deref().ok_or(AppError::NoProduct)?;
                let written = write_dataset(choices.format(), std::slice::from_ref(dataset));
                written.map_err(|error| AppError::from(error).about(path.display()))?.bytes
            }
            What::Package => self.package(progress)?,
            What::Scene => toml::to_string_pretty(&self.question.scene)?.into_bytes(),
            What::Series => Vec::new(),
        })
    }

    /// Returns the package of the product with all its states as bytes; the data of missing states are computed first.
    fn package(&self, progress: &dyn Progress) -> Result<Vec<u8>, AppError> {
        let product = self.product.as_deref().ok_or(AppError::NoProduct)?;
        let count = product.states.len();
        let mut datasets = Vec::with_capacity(count);
        for (k, state) in product.states.iter().enumerate() {
            progress.advance("states", k, count);
            check(progress)?;
            self.question.shelf.provide(&product.key, Some(&state.key), progress)?;
            datasets.push((*self.question.shelf.load(&product.key, Some(&state.key))?).clone());
        }
        let name = |state: &crate::catalogue::State| StateName { label: state.label.clone(), value: state.value };
        let product = NewProduct {
            key: Some(product.key.clone()),
            name: product.name.clone(),
            manufacturer: product.manufacturer.clone(),
            kind: product.kind.clone(),
            description: product.description.clone(),
            provenance: product.provenance.clone(),
            license: product.license.clone(),
            tags: product.tags.clone(),
            states: product.states.iter().map(name).collect(),
            control_curve: product.control_curve.clone(),
            system: product.system.clone(),
            ..NewProduct::default()
        };
        let mut catalogue = Catalogue::empty_in_memory()?;
        let imported = catalogue.import(&datasets, product)?;
        Ok(catalogue.export_package(&[imported.key])?)
    }

    fn moments(&self, path: &Path) -> Result<Vec<Moment>, AppError> {
        let list = moments(&self.choices, &self.question.scene, &self.question.base, self.product.as_deref(), path);
        match list.len() {
            0 => Err(AppError::NoMoments),
            count if count > MOST_FILES => Err(AppError::ManyFiles(count, MOST_FILES)),
            _ => Ok(list),
        }
    }

    /// Computes the luminaire files of the scene's aperture; `path`: that of the single file, from which the names of
    /// the files of a grid are derived.
    fn luminaires(&self, scene: &SceneFile, path: &Path, progress: &dyn Progress) -> Result<LuminaireSet, AppError> {
        let Choices { tiles, without_beam, .. } = self.choices;
        let format = LidFormat::of(path).map_err(|error| AppError::from(error).about(path.display()))?;
        let tiles = if tiles { Tiles::Auto } else { Tiles::None };
        let options = LuminaireOptions { format, aim: None, step: None, tiles, without_beam };
        let question = Question { scene: scene.clone(), ..self.question.clone() };
        self.engine.luminaires(&question, &options, path, progress)
    }

    /// Returns the files of a grid of luminaires, in a separate folder, with the index last, so that it never names a
    /// missing file.
    fn tiles(&self, path: &Path, progress: &dyn Progress) -> Result<Files, AppError> {
        let path = in_own_folder(path);
        let set = self.luminaires(&self.question.scene, &path, progress)?;
        let of = |file: &TileFile| (path.with_file_name(&file.row.file), file.bytes.clone());
        let mut files: Vec<_> = set.files.iter().map(of).collect();
        files.push((index_of(&path), set.index()));
        Ok(files)
    }

    /// Returns the luminaire files of all members of a series, with the index last, so that it never names a missing
    /// file.
    fn series(&self, path: &Path, progress: &dyn Progress) -> Result<Files, AppError> {
        let moments = self.moments(path)?;
        let (mut rows, mut files) = (Vec::new(), Vec::with_capacity(moments.len() + 1));
        for (k, one) in moments.iter().enumerate() {
            progress.advance("moments", k, moments.len());
            check(progress)?;
            let time = one.time.strftime("%Y-%m-%dT%H:%M");
            let of = if one.state.is_empty() { String::new() } else { format!(" state {}", one.state) };
            for file in self.luminaires(&one.scene, &path.with_file_name(&one.name), progress)?.files {
                files.push((path.with_file_name(&file.row.file), file.bytes));
                rows.push(Row { set: format!("{time}{of}"), ..file.row });
            }
        }
        files.push((path.to_owned(), luminaire_index::write(&rows)));
        Ok(files)
    }

    /// Computes all files, then writes them: all, or none after an error. Returns the path, and a warning if a file
    /// cannot show something unchanged.
    ///
    /// # Errors
    /// Returns an error if a file cannot be computed or written; then no new file remains.
    pub fn write(&self, path: &Path, progress: &dyn Progress) -> Result<(PathBuf, Option<String>), AppError> {
        if !path.to_string_lossy().to_lowercase().ends_with(self.choices.ending()) {
            return Err(AppError::ExportEnding(self.choices.ending()).about(path.display()));
        }
        let mut warning = None;
        let files = match self.choices.what {
            What::Series => self.series(path, progress)?,
            What::Luminaire if self.choices.tiles => self.tiles(path, progress)?,
            _ => vec![(path.to_owned(), self.bytes(path, &mut warning, progress)?)],
        };
        // Withdrawn after the last computation: nothing is written either.
        check(progress)?;
        let mut made_from = inputs_of(&self.question.scene, &self.question.base);
        // A scene may take its own place.
        made_from.extend(self.scene_path.clone().filter(|_| self.choices.what != What::Scene));
        let in_tiles = self.choices.what == What::Luminaire && self.choices.tiles;
        if !in_tiles {
            write_several(&files, &made_from)?;
            return Ok((path.to_owned(), warning));
        }
        let index = index_of(&in_own_folder(path));
        let folder = path.with_extension("");
        create_folder(&folder)?;
        write_several(&files, &made_from).inspect_err(|_| {
            // Only where nothing is in it: what was there before stays.
            let _ = std::fs::remove_dir(&folder);
        })?;
        Ok((index, warning))
    }

    /// Returns a preview of the files that an export to `path` would write.
    ///
    /// # Errors
    /// Returns an error if the content cannot be computed.
    pub fn preview(&self, path: &Path, progress: &dyn Progress) -> Result<Preview, AppError> {
        let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        Ok(match self.choices.what {
            What::Picture => {
                let drawing = self.picture(progress)?;
                let [width, height] = self.choices.size.pixels();
                let scale = (PREVIEW / drawing.width.max(drawing.height)).min(width / drawing.width);
                let note = if self.choices.vector {
                    texts::vectors(self.choices.size)
                } else {
                    texts::pixels(format!("{width:.0}"), format!("{height:.0}"))
                };
                shown(&drawing, scale, note)
            }
            What::Report => {
                let (_, pages) = self.report(progress)?;
                let first = pages.first().ok_or(AppError::NoProduct)?;
                let count = pages.len();
                let note = if count == 1 { texts::ONE_PAGE.into() } else { texts::page_one_of(count) };
                shown(first, PREVIEW / first.height, note)
            }
            What::Series => {
                let moments = self.moments(path)?;
                let mut list = vec![(name(path), texts::INDEX.into())];
                let words = |one: &Moment| match &*one.state {
                    "" => moment::words(one.time),
                    state => texts::moment_state(moment::words(one.time), state),
                };
                list.extend(moments.into_iter().map(|one| (one.name.clone(), words(&one))));
                Preview::Files(list)
            }
            // Minutes of work: only when they are asked for.
            What::Luminaire if self.choices.tiles => {
                let path = in_own_folder(path);
                let first = path.with_file_name(tile_name(&path, Some(0)));
                Preview::Files(vec![
                    (name(&index_of(&path)), texts::TILES_LATER.into()),
                    (name(&first), texts::FIRST_TILE.into()),
                ])
            }
            What::Package => {
                let product = self.product.as_deref().ok_or(AppError::NoProduct)?;
                let states = product.states.len();
                let waiting = product.states.iter().filter(|state| state.dataset.is_none()).count();
                let mut words = if states == 1 { texts::ONE_STATE.into() } else { texts::states_are(states) };
                if waiting > 0 {
                    words = texts::to_be_computed(words, waiting);
                }
                Preview::Files(vec![(name(path), words)])
            }
            What::Luminaire | What::Table | What::Dataset | What::Scene => {
                let bytes = self.bytes(path, &mut None, progress)?;
                let text = String::from_utf8_lossy(&bytes);
                Preview::Text(text.lines().take(LINES).collect::<Vec<_>>().join("\n"), bytes.len())
            }
        })
    }
}

/// Returns the path of a file inside a folder of the same name.
pub(super) fn in_own_folder(path: &Path) -> PathBuf {
    path.with_extension("").join(path.file_name().unwrap_or_default())
}

/// Returns the path of the index beside the files of a grid.
pub(super) fn index_of(path: &Path) -> PathBuf {
    path.with_extension("index.csv")
}

fn shown(drawing: &Drawing, scale: f64, note: String) -> Preview {
    let (width, height, pixels) = drawing.to_pixels(scale);
    Preview::Picture([width, height], pixels, note)
}
