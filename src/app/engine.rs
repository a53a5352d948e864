//! Interface from the window to the study. A trait, so that tests can use a slow or failing implementation.

use super::error::AppError;
use super::shelf::Shelf;
use super::shelf_library::WindowLibrary;
use crate::compute::btdf::Indicatrices;
use crate::compute::direction::Incident;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::{Interpolator, Lid};
use crate::formats::luminaire::Description;
use crate::study::accuracy::Accuracy;
use crate::study::luminaire_set::{LuminaireOptions, LuminaireSet};
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
    /// Positions of the sensor points. \[m\]
    pub positions: Vec<[f64; 3]>,
    /// Direct component from the apertures. \[lx\]
    pub direct: Vec<Estimate>,
    /// Interreflected component. \[lx\]
    pub interreflected: Vec<Estimate>,
    /// Part of `direct` that is due to beams of direct sun, one value per sensor point; empty if there is none. \[lx\]
    pub beam: Vec<f64>,
    /// Uncertainty due to the data, beside the numerical one; one value per sensor point, or empty. \[lx\]
    pub data_error: Vec<f64>,
    /// Obstructions as seen by the apertures; empty if there are none.
    pub outside: Vec<OutsideSeen>,
    /// Columns and rows, if the sensor points form a grid.
    pub grid: Option<[usize; 2]>,
    /// Whether there are fewer sensor points than in the scene, for a fast first result; all of them follow.
    pub coarse: bool,
    /// Wall-clock time of the computation. \[s\]
    pub seconds: f64,
}

/// Illuminances of the room's surfaces.
#[derive(Debug, Clone)]
pub struct SurfaceFigures {
    /// Illuminances by patch.
    pub light: SurfaceLight,
    /// Wall-clock time of the computation. \[s\]
    pub seconds: f64,
}

impl RoomFigures {
    /// Returns the illuminance at a sensor point, with its uncertainty. \[lx\]
    pub fn total(&self, sensor: usize) -> Estimate {
        self.direct[sensor] + self.interreflected[sensor] + Estimate::new(0.0, part(&self.data_error, sensor))
    }

    /// Returns the illuminances at all sensor points. \[lx\]
    pub fn totals(&self) -> impl Iterator<Item = Estimate> + Clone + '_ {
        (0..self.positions.len()).map(|sensor| self.total(sensor))
    }
}

/// Returns the value of a sensor point from a list that may be empty, else 0.
pub fn part(list: &[f64], sensor: usize) -> f64 {
    list.get(sensor).copied().unwrap_or(0.0)
}

/// Luminous intensity distribution of the first aperture.
#[derive(Debug, Clone)]
pub struct LidFigures {
    /// Luminous intensity distribution.
    pub lid: Lid,
    /// Luminous flux. \[lm\]
    pub flux: Estimate,
    /// Illuminance of the aperture's outside, including direct sun. \[lx\]
    pub incident: Option<f64>,
    /// Header of a luminaire file.
    pub description: Description,
    /// Wall-clock time of the computation. \[s\]
    pub seconds: f64,
}

/// Input of a job: a scene and its catalogue.
#[derive(Clone)]
pub struct Question {
    /// Scene as typed.
    pub scene: SceneFile,
    /// Folder that relative paths start from.
    pub base: PathBuf,
    /// Source of the products.
    pub shelf: Arc<dyn Shelf>,
}

/// Computations of the study.
pub trait Engine: Send + Sync {
    /// Computes the illuminances in the room.
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError>;
    /// Computes the illuminances of the room's surfaces.
    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError>;
    /// Computes the LID of the first aperture.
    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError>;
    /// Computes everything that pictures and reports show; an implementation without caches computes it from scratch.
    fn subject(
        &self,
        question: &Question,
        incident: Option<Incident>,
        wanted: Wanted,
        progress: &dyn Progress,
    ) -> Result<Subject, AppError> {
        subject(question, incident, wanted, (&Session::new(), &Library::default()), progress)
    }
    /// Returns the interpolator between the directions of the data.
    fn interpolator(&self, data: &Arc<Indicatrices>) -> Arc<Interpolator> {
        Arc::new(Interpolator::new(Arc::clone(data)))
    }
    /// Computes the year of a scene that has one. Engines that compute no light return an error.
    fn year(&self, _: &Question, _: &dyn Progress) -> Result<Annual, AppError> {
        Err(AppError::NoNumbers)
    }
    /// Computes years of the products of lists, preliminary ones first; the callback gets every result as soon as it is
    /// available, from any thread. Engines that compute no light return an error.
    fn rank(
        &self,
        _groups: &[Group],
        _items: &[Item],
        _shelf: &dyn Shelf,
        _report: &(dyn Fn(Answer<'_>) + Sync),
        _: &dyn Progress,
    ) -> Result<(), AppError> {
        Err(AppError::NoNumbers)
    }
    /// Computes error against run time of every method.
    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError>;
    /// Returns the bytes of a luminaire file; the path's extension gives its format.
    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError>;
    /// Computes the requested luminaire files of the first aperture; `path`: that of the single file, from which the
    /// files of a grid get their names. Engines that compute no light return an error.
    fn luminaires(
        &self,
        _: &Question,
        _: &LuminaireOptions,
        _: &Path,
        _: &dyn Progress,
    ) -> Result<LuminaireSet, AppError> {
        Err(AppError::NoLid)
    }
}

/// Computes everything that pictures and reports show of a scene.
///
/// # Errors
/// Returns an error if the scene or one of its systems is incomplete.
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
