//! Responses of the sensors to apertures and surfaces: stored for as many sensors as a study uses repeatedly; for more
//! they are computed again sensor by sensor, so that memory does not grow with their number.

use crate::compute::basis::RingBasis;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::limits;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::band_weights::BandWeights;
use crate::compute::room::direct::{Reception, Sensor};
use crate::compute::room::gather::{Reconstruction, reconstruct};
use crate::compute::room::mesh::Mesh;
use crate::study::error::StudyError;
use crate::study::scene::{Scene, SceneAperture};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Returns an error if the computation was cancelled.
pub(crate) fn check(progress: &dyn Progress) -> Result<(), Cancelled> {
    if progress.cancelled() { Err(Cancelled) } else { Ok(()) }
}

/// Number of sensors that are computed between two reports of progress.
const BLOCK: usize = 4096;

/// Whether a table of `numbers` values per sensor is small enough to be stored.
pub(crate) fn keeps(scene: &Scene, numbers: usize) -> bool {
    scene.sensors.len().saturating_mul(numbers).saturating_mul(size_of::<f64>()) <= limits::KEPT_BYTES
}

/// Checks that tables of `each` bytes per sensor, which an annual simulation needs as a whole, fit into memory.
///
/// # Errors
/// Returns an error if the scene has more sensors than fit.
pub(crate) fn within_budget(scene: &Scene, each: usize) -> Result<(), StudyError> {
    let (count, most) = (scene.sensors.len(), limits::RESPONSE_BYTES / each.max(1));
    if count > most {
        let message = format!("{count} sensors (through a year, in this room and with this system, at most {most})");
        return Err(StudyError::key("sensors", message));
    }
    Ok(())
}

/// Returns a sensor at the position for which its illuminance is computed: one that lies in an aperture is shifted just
/// inside the room.
pub(crate) fn inside(scene: &Scene, sensor: &Sensor) -> Sensor {
    let enter = |position, one: &SceneAperture| one.aperture.entered(position, sensor.normal);
    Sensor { position: scene.apertures.iter().fold(sensor.position, enter), ..*sensor }
}

/// Computes a value for every sensor in parallel, in the order of the scene. `work` gets the index of the sensor, and
/// the sensor as returned by [`inside`].
///
/// # Errors
/// Returns the first error of `work`, or an error if cancelled.
pub(super) fn in_blocks<T: Send>(
    scene: &Scene,
    stage: &'static str,
    progress: &dyn Progress,
    work: impl Fn(usize, &Sensor) -> Result<T, StudyError> + Sync,
) -> Result<Vec<T>, StudyError> {
    let count = scene.sensors.len();
    let mut all = Vec::with_capacity(count);
    for (block, sensors) in scene.sensors.chunks(BLOCK).enumerate() {
        check(progress)?;
        if count > BLOCK {
            progress.advance(stage, block * BLOCK, count);
        }
        let one = |(s, sensor): (usize, &Sensor)| {
            check(progress)?;
            work(block * BLOCK + s, &inside(scene, sensor))
        };
        all.extend(sensors.par_iter().enumerate().map(one).collect::<Result<Vec<T>, StudyError>>()?);
    }
    Ok(all)
}

/// Illuminance of every sensor per luminance of one aperture, by emergent cells: stored or to be computed. \[sr\]
pub(super) enum Seen<'a> {
    Kept(Arc<Vec<Reception>>),
    Recomputed(&'a Aperture, Option<&'a RingBasis>),
}

impl Seen<'_> {
    /// Returns the response of one sensor. `s`: index of the sensor in the scene.
    pub fn of(&self, s: usize, sensor: &Sensor) -> Cow<'_, Reception> {
        match self {
            Self::Kept(all) => Cow::Borrowed(&all[s]),
            Self::Recomputed(aperture, basis) => Cow::Owned(Reception::new(sensor, aperture, *basis)),
        }
    }
}

/// Illuminance of every sensor per luminance of one aperture, by bands of the profile angle: stored or to be computed.
/// \[sr\]
pub(super) enum SeenBands<'a> {
    Kept(Arc<Vec<BandWeights>>),
    /// Aperture for which the response is computed sensor by sensor; then whether the profile angle is in the
    /// horizontal plane (vertical structures), and number of bands.
    Recomputed(&'a Aperture, bool, usize),
}

impl SeenBands<'_> {
    /// Returns the response of one sensor. `s`: index of the sensor in the scene.
    pub fn of(&self, s: usize, sensor: &Sensor) -> Cow<'_, BandWeights> {
        match self {
            Self::Kept(all) => Cow::Borrowed(&all[s]),
            Self::Recomputed(aperture, upright, count) => Cow::Owned(bands_of(sensor, aperture, *upright, *count)),
        }
    }
}

/// Computes the illuminance at one sensor per luminance of an aperture in bands of the profile angle \[sr\]. `upright`:
/// whether the profile angle is in the horizontal plane (vertical structures); `count`: number of bands.
pub(crate) fn bands_of(sensor: &Sensor, aperture: &Aperture, upright: bool, count: usize) -> BandWeights {
    let view = aperture.view(sensor.position, sensor.normal);
    view.map_or_else(BandWeights::default, |view| BandWeights::new(&view, upright, count))
}

/// Weights with which every sensor sees the patches of the room, in the fine and the coarse mesh: stored or to be
/// computed.
pub(super) enum Gathered<'a> {
    Kept(Arc<Vec<[Reconstruction; 2]>>),
    Recomputed([&'a Mesh; 2]),
}

impl Gathered<'_> {
    /// Returns the weights of one sensor. `s`: index of the sensor in the scene.
    pub fn of(&self, s: usize, sensor: &Sensor) -> Cow<'_, [Reconstruction; 2]> {
        match self {
            Self::Kept(all) => Cow::Borrowed(&all[s]),
            Self::Recomputed(meshes) => Cow::Owned(gathered(meshes, sensor)),
        }
    }
}

/// Computes the weights with which one sensor sees the patches of the fine and the coarse mesh.
pub(super) fn gathered(meshes: &[&Mesh; 2], sensor: &Sensor) -> [Reconstruction; 2] {
    meshes.map(|mesh| reconstruct(mesh, sensor.position, sensor.normal))
}

/// Whether the responses of all sensors of a scene to the emergent cells of a basis are stored.
pub(super) fn keeps_receptions(scene: &Scene, basis: Option<&RingBasis>) -> bool {
    keeps(scene, RECEPTION + basis.map_or(0, RingBasis::len))
}

/// Size of a sensor's response without its cells. \[numbers\]
const RECEPTION: usize = size_of::<Reception>() / size_of::<f64>();
