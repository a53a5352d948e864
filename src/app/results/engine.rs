//! Interface of the window to the computations of the study. A trait, so that tests can use a slow or failing
//! implementation.

use crate::app::catalogue::library::WindowLibrary;
use crate::app::catalogue::shelf::Shelf;
use crate::app::shell::error::AppError;
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
use crate::study::{Library, OutsideSeen, Session, Store, SurfaceLight};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Result of a room computation: illuminances at the sensor points with their components.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RoomFigures {
    /// Positions of the sensor points, in the room's axes. \[m\]
    pub positions: Vec<[f64; 3]>,
    /// Direct component of the illuminance at each sensor point, from the apertures. \[lx\]
    pub direct: Vec<Estimate>,
    /// Interreflected component of the illuminance at each sensor point. \[lx\]
    pub interreflected: Vec<Estimate>,
    /// Part of `direct` that is due to beams of direct sun, one value per sensor point; empty if there is none. \[lx\]
    pub beam: Vec<f64>,
    /// Uncertainty of the illuminance due to the optical data, beside the numerical one; one value per sensor point, or
    /// empty. \[lx\]
    pub data_error: Vec<f64>,
    /// Obstructions as seen by the apertures; empty if there are none.
    pub outside: Vec<OutsideSeen>,
    /// Numbers of columns and rows, if the sensor points form a grid.
    pub grid: Option<[usize; 2]>,
    /// Whether the result has fewer sensor points than the scene: a fast, preliminary result, followed by one with all
    /// of them.
    pub coarse: bool,
    /// Wall-clock time of the computation. \[s\]
    pub seconds: f64,
}

/// Result of a room computation for its surfaces: illuminances by patch.
#[derive(Debug, Clone)]
pub struct SurfaceFigures {
    /// Illuminances of the room's surfaces by patch, with direct sunbeams separately.
    pub light: SurfaceLight,
    /// Wall-clock time of the computation. \[s\]
    pub seconds: f64,
}

impl RoomFigures {
    /// Returns the total illuminance (direct and interreflected) at a sensor point, with its uncertainty. \[lx\]
    pub fn total(&self, sensor: usize) -> Estimate {
        self.direct[sensor] + self.interreflected[sensor] + Estimate::new(0.0, part(&self.data_error, sensor))
    }

    /// Returns the total illuminances at all sensor points, with their uncertainties. \[lx\]
    pub fn totals(&self) -> impl Iterator<Item = Estimate> + Clone + '_ {
        (0..self.positions.len()).map(|sensor| self.total(sensor))
    }
}

/// Returns the value of a sensor point from a list with one value per point; 0 if the list is empty.
pub fn part(list: &[f64], sensor: usize) -> f64 {
    list.get(sensor).copied().unwrap_or(0.0)
}

/// Result for the first aperture as a luminaire: luminous intensity distribution and flux.
#[derive(Debug, Clone)]
pub struct LidFigures {
    /// Luminous intensity distribution of the aperture.
    pub lid: Lid,
    /// Luminous flux of the aperture into the room. \[lm\]
    pub flux: Estimate,
    /// Illuminance on the outside of the aperture, including direct sun; `None` if it is not known. \[lx\]
    pub incident: Option<f64>,
    /// Texts for the header of a luminaire file.
    pub description: Description,
    /// Wall-clock time of the computation. \[s\]
    pub seconds: f64,
}

/// Input of a computation: a scene, its folder and the catalogue.
#[derive(Clone)]
pub struct Question {
    /// Scene as in its file or as edited in the window.
    pub scene: SceneFile,
    /// Folder to which the paths in the scene are relative.
    pub base: PathBuf,
    /// Catalogue from which the scene's products are read.
    pub shelf: Arc<dyn Shelf>,
}

/// Computations of the study that the window uses.
pub trait Engine: Send + Sync {
    /// Computes the illuminances at the sensor points of the room.
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError>;
    /// Computes the illuminances of the room's surfaces.
    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError>;
    /// Computes the LID of the first aperture.
    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError>;
    /// Computes all results that pictures and reports show, those that `wanted` selects; without cached results, unless
    /// an implementation has some.
    fn subject(
        &self,
        question: &Question,
        incident: Option<Incident>,
        wanted: Wanted,
        progress: &dyn Progress,
    ) -> Result<Subject, AppError> {
        subject(question, incident, wanted, (&Session::new(), &Library::default()), progress)
    }
    /// Returns the store of results; `None` if the engine has none.
    fn store(&self) -> Option<&Store> {
        None
    }
    /// Returns the interpolator between the incident directions of the data.
    fn interpolator(&self, data: &Arc<Indicatrices>) -> Arc<Interpolator> {
        Arc::new(Interpolator::new(Arc::clone(data)))
    }
    /// Computes the annual simulation of a scene with a `[year]` section. Engines without light computations return an
    /// error.
    fn year(&self, _: &Question, _: &dyn Progress) -> Result<Annual, AppError> {
        Err(AppError::NoNumbers)
    }
    /// Computes annual simulations of the products to rank, preliminary ones first; `_report` is called with every
    /// result as soon as it is available, from any thread. Engines without light computations return an error.
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
    /// Computes error against computing time for every method, by runs with rising effort.
    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError>;
    /// Returns the bytes of a luminaire file in the format that the extension of `path` states.
    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError>;
    /// Computes the requested luminaire files of the first aperture; a `Path` is that of the single file, from which
    /// the names of the files of a grid are derived. Engines without light computations return an error.
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

/// Computes all results of a scene that pictures and reports show, those that `wanted` selects.
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
