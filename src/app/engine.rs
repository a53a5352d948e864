//! What the window asks of the study. A trait, so that tests can put a slow or failing one in its place.

use super::error::AppError;
use super::shelf::Shelf;
use super::shelf_library::WindowLibrary;
use crate::compute::btdf::Indicatrices;
use crate::compute::direction::Incident;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::{Interpolator, Lid};
use crate::formats::luminaire::Description;
use crate::study::accuracy::Accuracy;
use crate::study::luminaire_set::{LuminaireSet, Wish};
use crate::study::rank::{Answer, Group, Item};
use crate::study::scene_file::SceneFile;
use crate::study::subject::{Asked, Subject, Wanted};
use crate::study::year::Annual;
use crate::study::{Library, OutsideSeen, Session, SurfaceLight};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Illuminances in the room.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RoomFigures {
    /// Positions of the sensors. \[m\]
    pub positions: Vec<[f64; 3]>,
    /// Straight from the apertures. \[lx\]
    pub direct: Vec<Estimate>,
    /// From the room's surfaces. \[lx\]
    pub interreflected: Vec<Estimate>,
    /// The part of `direct` that is the sun's beams; as long as the sensors are many, or empty without any. \[lx\]
    pub beam: Vec<f64>,
    /// What the data leave open besides the errors of the computation; likewise. \[lx\]
    pub data_error: Vec<f64>,
    /// How the apertures saw what stands outside; empty where nothing does.
    pub outside: Vec<OutsideSeen>,
    /// Columns and rows when the sensors are a grid.
    pub grid: Option<[usize; 2]>,
    /// Of fewer sensors than the scene has, for a picture at once; all of them follow.
    pub coarse: bool,
    /// Wall-clock time that it took. \[s\]
    pub seconds: f64,
}

/// Illuminances of the room's surfaces.
#[derive(Debug, Clone)]
pub struct SurfaceFigures {
    /// Patch by patch.
    pub light: SurfaceLight,
    /// Wall-clock time that it took. \[s\]
    pub seconds: f64,
}

impl RoomFigures {
    /// Illuminance at a sensor. \[lx\]
    pub fn total(&self, sensor: usize) -> Estimate {
        self.direct[sensor] + self.interreflected[sensor] + Estimate::new(0.0, part(&self.data_error, sensor))
    }

    /// Illuminances at all sensors. \[lx\]
    pub fn totals(&self) -> impl Iterator<Item = Estimate> + Clone + '_ {
        (0..self.positions.len()).map(|sensor| self.total(sensor))
    }
}

/// A value of a list that may be left out.
pub fn part(list: &[f64], sensor: usize) -> f64 {
    list.get(sensor).copied().unwrap_or(0.0)
}

/// The light of the first aperture as a luminaire.
#[derive(Debug, Clone)]
pub struct LidFigures {
    /// The distribution.
    pub lid: Lid,
    /// All its flux. \[lm\]
    pub flux: Estimate,
    /// Illuminance of the aperture's outside face, sun included. \[lx\]
    pub incident: Option<f64>,
    /// Header of a luminaire file.
    pub description: Description,
    /// Wall-clock time that it took. \[s\]
    pub seconds: f64,
}

/// A scene on its way into a job.
#[derive(Clone)]
pub struct Question {
    /// As typed.
    pub scene: SceneFile,
    /// What relative paths start from.
    pub base: PathBuf,
    /// Where products come from.
    pub shelf: Arc<dyn Shelf>,
}

/// Computes.
pub trait Engine: Send + Sync {
    /// Illuminances in the room.
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError>;
    /// Illuminances of the room's surfaces.
    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError>;
    /// The light of the first aperture.
    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError>;
    /// All that pictures and reports show; without caches of one's own everything is computed anew.
    fn subject(
        &self,
        question: &Question,
        incident: Option<Incident>,
        wanted: Wanted,
        progress: &dyn Progress,
    ) -> Result<Subject, AppError> {
        subject(question, incident, wanted, (&Session::new(), &Library::default()), progress)
    }
    /// What interpolation between the directions of data needs.
    fn interpolator(&self, data: &Arc<Indicatrices>) -> Arc<Interpolator> {
        Arc::new(Interpolator::new(Arc::clone(data)))
    }
    /// The year of a scene that has one. Engines that compute no light have none.
    fn year(&self, _: &Question, _: &dyn Progress) -> Result<Annual, AppError> {
        Err(AppError::NoNumbers)
    }
    /// Years of the products of lists, coarse ones first; `told` hears of every result when it is there, from any thread.
    /// Engines that compute no light have none.
    fn rank(
        &self,
        _groups: &[Group],
        _items: &[Item],
        _shelf: &dyn Shelf,
        _told: &(dyn Fn(Answer<'_>) + Sync),
        _: &dyn Progress,
    ) -> Result<(), AppError> {
        Err(AppError::NoNumbers)
    }
    /// Error against run time of every method.
    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError>;
    /// The bytes of a luminaire file, its format by the path's extension.
    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError>;
    /// The first aperture as the luminaire files that are wished for; `path`: of the one file, from which tiles have their
    /// names. Engines that compute no light have none.
    fn luminaires(&self, _: &Question, _: &Wish, _: &Path, _: &dyn Progress) -> Result<LuminaireSet, AppError> {
        Err(AppError::NoLid)
    }
}

/// All that pictures and reports show of a question.
///
/// # Errors
/// What the scene or its systems lack.
pub fn subject(
    question: &Question,
    incident: Option<Incident>,
    wanted: Wanted,
    (session, files): (&Session, &Library),
    progress: &dyn Progress,
) -> Result<Subject, AppError> {
    let library = WindowLibrary { files, shelf: &*question.shelf, progress };
    let asked = Asked { file: &question.scene, base: &question.base, incident, wanted };
    Ok(Subject::of(&asked, session, &library, &|key| library.product(key), progress)?)
}
