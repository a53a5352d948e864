//! Interreflected light of beams of 1 lm whose direction is that of undeviated sunlight, or its mirror image at planes
//! along the aperture's axes.
//!
//! Panes, holes and gaps between slats transmit sunlight undeviated, laser-cut panels redirect it upwards. Every system
//! meets the same sun positions, so that such a beam is computed once for all systems.

use super::beam_responses::{BeamResponses, ReflectedBeamLight};
use crate::compute::direction::{Dir, Facade};
use crate::compute::dot::wide;
use crate::compute::lid::{BeamLight, Facing};
use crate::compute::room::beam::Beam;
use crate::compute::room::radiosity::Radiosity;
use crate::study::scene::Scene;
use glam::DVec3;
use half::bf16;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Maximum distance between the direction of a beam and one of these directions at which the latter is used: a
/// millimetre on the floor of a room. The solar disc itself is seen in the direction of the beam. \[rad\]
const SAME: f64 = 3e-4;
/// Maximum memory of the beams that are stored. \[bytes\] Chosen: cost only; others are computed again.
const MAX_BEAM_BYTES: usize = 10_000_000;
/// Factors that mirror a direction at the planes along the aperture's axes.
const IMAGES: [DVec3; 4] =
    [DVec3::ONE, DVec3::new(1.0, -1.0, 1.0), DVec3::new(-1.0, 1.0, 1.0), DVec3::new(-1.0, -1.0, 1.0)];

/// Index of the aperture through which a beam enters, and the bits of the beam's direction.
type Key = (usize, [u64; 3]);

/// Responses of a room to beams, with the beams of 1 lm that were computed so far.
pub(crate) struct UnitBeams {
    responses: BeamResponses,
    known: Mutex<Known>,
}

/// Stored beams of 1 lm.
#[derive(Default)]
struct Known {
    beams: HashMap<Key, Arc<UnitBeam>>,
    /// Memory of all of them. \[bytes\]
    bytes: usize,
}

/// Interreflected light of a beam of 1 lm at the sensors.
pub(crate) struct UnitBeam {
    /// Illuminances sensor by sensor: after two reflections or more, their uncertainty by the position of the beam
    /// within a patch, after one reflection with the beam's sharp outline. \[lx/lm\]
    numbers: Vec<f32>,
    /// Differences between the fine and the coarse mesh, sensor by sensor, wall by wall. \[lx/lm\]
    walls: Vec<bf16>,
    /// Patches of the room that the beam lights, with their illuminances. \[lx/lm\]
    patches: Vec<(u32, f32)>,
}

/// Sum of the reflected light of several beams.
pub(crate) struct Together {
    /// Illuminances at the sensors after two reflections or more.
    pub light: ReflectedBeamLight,
    /// Illuminances after one reflection with the sharp outlines of the beams, sensor by sensor. \[lx\]
    pub sharp: Vec<f64>,
    /// Direct illuminances of the patches of the room by the beams. \[lx\]
    pub direct: Vec<f64>,
}

/// Returns the direction of undeviated sunlight, or its mirror image, that can represent the direction of a beam;
/// `None` if none is near enough.
fn standing_for(beam: &BeamLight, facing: &Facing<'_>) -> Option<Dir<Facade>> {
    let to = beam.entering(facing)?.vector();
    let sun = if beam.straight { facing.sun_entering()? } else { facing.sun_direction()? }.vector();
    let image = |image: &DVec3| Some(Dir::from_unit(sun * *image)).filter(|one| one.vector().distance(to) <= SAME);
    IMAGES.iter().find_map(image)
}

impl UnitBeams {
    /// Creates an empty store of beams of 1 lm.
    pub fn new(responses: BeamResponses) -> Self {
        Self { responses, known: Mutex::default() }
    }

    /// Returns the memory that responses and beams take at most. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.responses.bytes() + MAX_BEAM_BYTES
    }

    /// Returns the responses of the sensors to beams of any direction.
    pub fn responses(&self) -> &BeamResponses {
        &self.responses
    }

    /// Returns the light of a beam of 1 lm through an aperture of the scene, computed or stored; `None` if the beam has
    /// another direction and has to be computed separately.
    pub fn of(
        &self,
        scene: &Scene,
        index: usize,
        beam: &BeamLight,
        facing: &Facing<'_>,
        radiosity: &Radiosity,
    ) -> Option<Arc<UnitBeam>> {
        let to = standing_for(beam, facing)?;
        let key = (index, to.vector().to_array().map(f64::to_bits));
        // What is kept is whole even if another thread has failed while it held the lock.
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(unit) = known().beams.get(&key) {
            return Some(Arc::clone(unit));
        }
        let unit = Arc::new(UnitBeam::new(scene, index, to, radiosity, &self.responses));
        let mut known = known();
        let bytes = known.bytes + unit.bytes();
        if bytes <= MAX_BEAM_BYTES && known.beams.insert(key, Arc::clone(&unit)).is_none() {
            known.bytes = bytes;
        }
        Some(unit)
    }
}

impl UnitBeam {
    /// Computes the light of a beam of 1 lm. `to`: direction from which undeviated light would leave like the beam.
    fn new(scene: &Scene, index: usize, to: Dir<Facade>, radiosity: &Radiosity, responses: &BeamResponses) -> Self {
        let aperture = &scene.apertures[index].aperture;
        let mesh = &radiosity.nested.fine;
        let from = aperture.surface.room_dir(to).vector();
        let beam = Beam { opening: aperture.corners().to_vec(), from, flux: 1.0 };
        let mut direct = vec![0.0; mesh.patches.len()];
        beam.add_to(mesh, &mut direct);
        let light = responses.of(radiosity, &direct);
        let mut sharp = vec![0.0; scene.sensors.len()];
        beam.outlines(mesh).iter().for_each(|outline| outline.add_light(mesh, &scene.sensors, &mut sharp));
        let numbers = light.values.iter().copied().chain(light.blur.iter().copied()).chain(sharp).map(|e| e as f32);
        let walls = light.walls.iter().map(|&e| bf16::from_f32(e)).collect();
        let lit = direct.iter().enumerate().filter(|(_, e)| **e != 0.0);
        let patches = lit.map(|(k, e)| (u32::try_from(k).unwrap_or(u32::MAX), *e as f32)).collect();
        Self { numbers: numbers.collect(), walls, patches }
    }

    /// Returns the memory of the beam's light and of its entry in the store. \[bytes\]
    fn bytes(&self) -> usize {
        let lists = size_of_val(&self.numbers[..]) + size_of_val(&self.walls[..]) + size_of_val(&self.patches[..]);
        lists + size_of::<Self>() + size_of::<Key>()
    }
}

impl Together {
    /// Returns the sum of no beams, with illuminances of 0.
    pub fn dark(radiosity: &Radiosity, responses: &BeamResponses) -> Self {
        let light = responses.dark();
        let sharp = vec![0.0; light.values.len()];
        Self { light, sharp, direct: vec![0.0; radiosity.nested.fine.patches.len()] }
    }

    /// Adds the light of a beam of 1 lm, times its flux. \[lm\]
    pub fn add(&mut self, unit: &UnitBeam, flux: f64) {
        let add = |sums: &mut [f64], numbers: &[f32]| {
            wide(|| sums.iter_mut().zip(numbers).for_each(|(sum, e)| *sum += flux * f64::from(*e)));
        };
        let count = self.sharp.len();
        add(&mut self.light.values, &unit.numbers[..count]);
        add(&mut self.light.blur, &unit.numbers[count..2 * count]);
        add(&mut self.sharp, &unit.numbers[2 * count..3 * count]);
        let (walls, flux) = (&mut self.light.walls, flux as f32);
        wide(|| walls.iter_mut().zip(&unit.walls).for_each(|(sum, e)| *sum += flux * f32::from(*e)));
        for &(k, e) in &unit.patches {
            self.direct[k as usize] += f64::from(flux * e);
        }
    }

    /// Adds the light of beams that were computed separately, and the direct illuminances of the patches by them.
    /// \[lx\]
    pub fn add_others(&mut self, light: &ReflectedBeamLight, direct: &[f64]) {
        let add = |sums: &mut [f64], more: &[f64]| sums.iter_mut().zip(more).for_each(|(sum, e)| *sum += e);
        add(&mut self.light.values, &light.values);
        add(&mut self.light.blur, &light.blur);
        add(&mut self.direct, direct);
        self.light.walls.iter_mut().zip(&light.walls).for_each(|(sum, e)| *sum += e);
    }
}
