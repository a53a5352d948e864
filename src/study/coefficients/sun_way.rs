//! Transmission of direct sunlight through a system: by its description, by beams extracted from patch-averaged data,
//! or by the data's own cells and directions.

use super::described::{ByAngle, DescribedViews, Lattice, relative_error};
use super::views::{Opening, Views, Want};
use crate::compute::btdf::{Btdf, CellMatrix, Scattered};
use crate::compute::lid::peaks::{MOST_CELLS, Peaks};
use crate::compute::lid::{BeamLight, Facing, SunThrough};
use crate::study::error::StudyError;
use crate::study::scene_file::Interpolation;
use crate::study::system::SystemModel;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of sun positions from which on scattered sunlight is interpolated between directions, which are then fewer
/// than the sun positions.
const MANY: usize = 120;

/// Method for the transmission of direct sunlight through the system of one aperture.
pub(super) enum SunWay {
    /// Cells or directions of the data as given, with regular transmission as far as the data separate it.
    Data,
    /// Description of the system, evaluated for the direction of the sun.
    Described(Box<ByDescription>),
    /// Beams extracted from patch-averaged data; the remaining light is emitted by the data's cells.
    Peaks(Box<InCells>),
}

/// Description of a system, with the method for its scattered light under many suns: by the profile angle, where the
/// scattering depends on nothing else, or else interpolated between directions.
pub(super) struct ByDescription {
    model: SystemModel,
    views: Arc<DescribedViews>,
    by_angle: Option<Arc<ByAngle>>,
    lattice: Lattice,
}

/// Patch-averaged data from which beams are extracted.
pub(super) struct InCells {
    matrix: CellMatrix,
    views: Views,
    /// Extracted beams, by incident cell of the sun where there are too many cells to examine all of them; otherwise
    /// all under key 0.
    known: Mutex<BTreeMap<usize, Arc<Peaks>>>,
}

/// Direct sunlight behind a system: as beams, and as scattered light at the sensors.
pub(super) struct SunLight {
    /// Beams in which sunlight leaves the system.
    pub beams: Vec<BeamLight>,
    /// Luminances of the data's emergent cells by scattered sunlight, where they were computed for the actual sun
    /// position; else empty. \[cd/m²\]
    pub cells: Vec<f64>,
    /// Illuminances at the sensors by scattered sunlight: three rows as in [`Views`], for all light, its interreflected
    /// part and the uncertainty of that part. \[lx\]
    pub light: Vec<f64>,
    /// Errors of the illuminances at the sensors by scattered sunlight. \[lx\]
    pub errors: Vec<f64>,
}

impl SunWay {
    /// Whether regular transmission that the data separate is not among the computed beams and has to be added.
    pub const fn leaves_regular(&self) -> bool {
        matches!(self, Self::Peaks(_))
    }

    /// Chooses the method for one aperture. `described`: optical model of a described system, responses of the sensors
    /// to its light, and its scattered light by profile angle where it depends on that angle alone.
    pub fn new(
        opening: &Opening<'_>,
        btdf: &Btdf,
        described: Option<(SystemModel, Arc<DescribedViews>, Option<Arc<ByAngle>>)>,
    ) -> Result<Self, StudyError> {
        let scene = opening.scene;
        if let Some((model, views, by_angle)) = described {
            let lattice = Lattice::of(model.0.as_ref());
            return Ok(Self::Described(Box::new(ByDescription { model, views, by_angle, lattice })));
        }
        match &btdf.scattered {
            Some(Scattered::Cells(matrix)) if scene.beams && scene.interpolation != Interpolation::Patch => {
                let basis = Arc::new(matrix.emergent().clone());
                let views = Views::new(opening, basis, Want::All)?;
                let matrix: &CellMatrix = matrix;
                Ok(Self::Peaks(Box::new(InCells { matrix: matrix.clone(), views, known: Mutex::default() })))
            }
            _ => Ok(Self::Data),
        }
    }

    /// Computes the light behind the system for a sun in front of the aperture; `None` if the data's own cells are to
    /// be used. `suns`: total number of sun positions.
    pub fn light(&self, facing: &Facing<'_>, suns: usize, sensors: usize) -> Option<SunLight> {
        match self {
            Self::Data => None,
            Self::Described(own) if own.by_angle.is_none() && suns < MANY => Some(own.exact_sun(facing, sensors)),
            Self::Described(own) => Some(own.between(facing, sensors)),
            Self::Peaks(cells) => Some(cells.light(facing, sensors)),
        }
    }
}

impl ByDescription {
    /// Computes beams and scattered light for the actual sun position, without interpolation.
    fn exact_sun(&self, facing: &Facing<'_>, sensors: usize) -> SunLight {
        let through = SunThrough::new(self.model.0.as_ref(), facing);
        let mut sum = SunLight::of(&through, sensors);
        let mut add = |part: Vec<f64>, relative: f64| {
            sum.errors.iter_mut().zip(&part).for_each(|(error, e)| *error += relative * e);
            sum.light.iter_mut().zip(&part).for_each(|(sum, e)| *sum += e);
        };
        if let Some(bands) = through.bands() {
            let mut part = vec![0.0; 3 * sensors];
            self.views.add_bands(bands, 1.0, &mut part);
            add(part, relative_error(&bands.light));
        }
        if let Some(cells) = through.cells() {
            let mut part = vec![0.0; 3 * sensors];
            self.views.cells.add_all(&cells.sun, &mut part);
            add(part, cells.relative_error);
        }
        sum
    }

    /// Computes beams for the actual sun position, and scattered light by interpolation between incident directions.
    fn between(&self, facing: &Facing<'_>, sensors: usize) -> SunLight {
        let model = self.model.0.as_ref();
        let mut sum = SunLight::of(&SunThrough::beams_alone(model, facing), sensors);
        let SunLight { light, errors, .. } = &mut sum;
        for (direction, share) in SunThrough::standing_for(facing) {
            let e = share * facing.sun_illuminance();
            match &self.by_angle {
                Some(by_angle) => by_angle.add(direction, e, light, errors),
                None => self.lattice.add(model, &self.views.cells, direction, e, light, errors),
            }
        }
        let averaging = SunThrough::averaging_error(facing);
        errors.iter_mut().zip(light).for_each(|(error, e)| *error += averaging * e.abs());
        sum
    }
}

impl SunLight {
    fn dark(sensors: usize) -> Self {
        Self { beams: Vec::new(), cells: Vec::new(), light: vec![0.0; 3 * sensors], errors: vec![0.0; sensors] }
    }

    /// Creates direct sunlight with the beams of a described system and without scattered light.
    fn of(through: &SunThrough, sensors: usize) -> Self {
        Self { beams: through.beams().to_vec(), ..Self::dark(sensors) }
    }
}

impl InCells {
    fn peaks(&self, facing: &Facing<'_>) -> Option<Arc<Peaks>> {
        let sun = facing.sun_entering()?;
        let cell = self.matrix.incident().index(sun)?;
        let key = if self.matrix.incident().len() > MOST_CELLS { cell } else { 0 };
        // What is kept is whole even if another thread has failed while it held the lock.
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(peaks) = known().get(&key) {
            return Some(Arc::clone(peaks));
        }
        let peaks = Arc::new(Peaks::new(&self.matrix, sun));
        known().insert(key, Arc::clone(&peaks));
        Some(peaks)
    }

    /// Computes extracted beams and the remaining scattered light, with its errors.
    fn light(&self, facing: &Facing<'_>, sensors: usize) -> SunLight {
        let mut sum = SunLight::dark(sensors);
        let Some(sun) = self.peaks(facing).and_then(|peaks| peaks.sun(facing)) else { return sum };
        self.views.add_all(&sun.luminance, &mut sum.light);
        let mut squares = vec![0.0; sensors];
        let mut part = vec![0.0; 3 * sensors];
        for uncertainty in &sun.uncertainties {
            part.fill(0.0);
            self.views.add_all(uncertainty, &mut part);
            squares.iter_mut().zip(&part).for_each(|(sum, e)| *sum += e * e);
        }
        sum.errors.iter_mut().zip(squares).for_each(|(error, square)| *error = square.sqrt());
        (sum.beams, sum.cells) = (sun.beams, sun.luminance);
        sum
    }
}
