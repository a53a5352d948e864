//! Responses of the sensors to the first illuminance of every patch of the room, by solving the interreflection
//! backwards (adjoint).
//!
//! One set of responses serves every sky, sun and system in a room; light that apertures reflect by direction is added
//! by cells, see [`super::room_side_reflection`].

use super::beam_responses::{BeamResponses, ReflectedBeamLight};
use super::interreflected::{DIFFERENCE_ALONE, UNEVEN, mesh_key, room_key};
use super::room_side_reflection::{AddedAt, RoomSideReflection};
use super::seen::within_budget;
use super::through_room::ThroughRoom;
use super::unit_beams::UnitBeams;
use super::weights::{ByCells, Response, TOGETHER, by_walls};
use super::{Session, check, sensor_key};
use crate::compute::basis::RingBasis;
use crate::compute::dot::dot;
use crate::compute::estimate::Progress;
use crate::compute::room::gather::Reconstruction;
use crate::compute::room::mesh::Patch;
use crate::compute::room::nodes::Nodes;
use crate::compute::room::patch_weights::PatchWeights;
use crate::compute::room::radiosity::{Radiosity, enough_is_absorbed};
use crate::study::cache::Key;
use crate::study::error::StudyError;
use crate::study::scene::{Scene, SceneAperture};
use half::bf16;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Responses of all sensors in a room to light on its patches, for computing interreflected light.
pub(crate) struct Responses {
    /// Room with its interreflection solved (factored).
    pub radiosity: Arc<Radiosity>,
    room: ThroughRoom,
    /// Reflection of apertures that reflect by direction; `None` if none does.
    mirrors: Option<RoomSideReflection>,
    /// Requested number of fine patches.
    count: usize,
}

/// Interreflected illuminance at a sensor, or its value per unit of a source.
#[derive(Clone, Copy, Default)]
pub(crate) struct Reflected {
    /// Interreflected illuminance, or its value per unit of a source.
    pub value: f64,
    /// Difference between the fine and the coarse mesh, in the same unit.
    pub difference: f64,
    /// Contribution that comes directly from apertures that reflect by direction, in the same unit.
    pub room_side_reflection: f64,
}

impl Reflected {
    /// Returns the estimated absolute error of the value, in the same unit.
    pub fn uncertainty(&self) -> f64 {
        DIFFERENCE_ALONE * self.difference + UNEVEN * self.room_side_reflection
    }
}

impl Session {
    /// Computes the responses of the sensors for a room with about `count` fine patches.
    pub(crate) fn responses(
        &self,
        scene: &Scene,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<Responses, StudyError> {
        // Where products follow each other, apertures that reflect without direction are followed like those that
        // reflect by cells, as one cell of uniform luminance: the room is black to all of them, and the same whatever
        // the product. Not where light may fall directly from one on another.
        let surface = |one: &SceneAperture| one.aperture.surface;
        let black =
            self.reflects_uniformly && scene.apertures.windows(2).all(|pair| surface(&pair[0]) == surface(&pair[1]));
        let lambertian: Vec<f64> =
            scene.apertures.iter().map(|one| if black { one.diffuse_reflectance() } else { 0.0 }).collect();
        let own = scene;
        let mut scene = Cow::Borrowed(own);
        if lambertian.iter().any(|rho| *rho > 0.0) {
            scene.to_mut().apertures.iter_mut().for_each(|one| one.directional = true);
        }
        let scene = &*scene;
        let radiosity = self.radiosity(scene, count)?;
        let reflectance =
            |patch: &Patch| patch.aperture.map_or(patch.reflectance, |index| patch.reflectance.max(lambertian[index]));
        enough_is_absorbed(&radiosity.nested.fine, reflectance)?;
        check(progress)?;
        // A value and its uncertainty, by walls, for every patch and sensor.
        let fine = &radiosity.nested.fine;
        let each = fine.patches.len() * (size_of::<f64>() + fine.walls.len() * size_of::<bf16>());
        within_budget(scene, each)?;
        let key = room_key(scene, count);
        let sensor_key: Key = sensor_key(scene).collect();
        let of_sensors = [key.clone(), sensor_key.clone()].concat();
        let sensors = self.responses.get(of_sensors, || {
            let gather = self.gathering(scene, count, &radiosity)?;
            weights_of(&radiosity, &gather, progress)
        })?;
        let geometry = scene.apertures.iter().map(|a| a.aperture).collect();
        let mesh_key = mesh_key(scene, count);
        let room = ThroughRoom { radiosity: Arc::clone(&radiosity), sensors, key, mesh_key, geometry, sensor_key };
        let mirrors = RoomSideReflection::new(self, own, &lambertian, &room, progress)?;
        Ok(Responses { radiosity, room, mirrors, count })
    }

    /// Returns the responses to beams of the sensors of [`Self::responses`]; computed or stored.
    pub(crate) fn unit_beams(&self, scene: &Scene, room: &Responses) -> Result<Arc<UnitBeams>, StudyError> {
        let key = [&room.room.key[..], &room.room.sensor_key].concat();
        self.unit_beams.get(key, || {
            let gather = self.gathering(scene, room.count, &room.radiosity)?;
            Ok(UnitBeams::new(BeamResponses::new(&room.radiosity, &gather, &room.room.sensors)))
        })
    }
}

/// Computes the responses of all sensors. `gather`: weights with which they see the patches of the fine and the coarse
/// mesh.
fn weights_of(
    radiosity: &Radiosity,
    gather: &[[Reconstruction; 2]],
    progress: &dyn Progress,
) -> Result<Vec<Response>, StudyError> {
    let block = |sensors: &[[Reconstruction; 2]]| {
        check(progress)?;
        let walls: Vec<Vec<[Vec<f64>; 2]>> =
            sensors.iter().map(|[fine, coarse]| by_walls(radiosity, &fine.weights, &coarse.weights)).collect();
        let [fine, coarse] = [0, 1].map(|k| walls.iter().flatten().map(|wall| &wall[k][..]).collect::<Vec<_>>());
        let mut found = radiosity.adjoint_fine(&fine).into_iter().zip(radiosity.adjoint_coarse(&coarse));
        let response = |walls: &Vec<[Vec<f64>; 2]>| {
            let mut response = Response { value: vec![0.0; radiosity.nested.fine.patches.len()], walls: Vec::new() };
            for (by_fine, by_coarse) in found.by_ref().take(walls.len()) {
                // As the extrapolation of the two densities: fine + (fine − coarse)/3.
                let difference: Vec<f64> = by_fine.iter().zip(&by_coarse).map(|(f, c)| f - c).collect();
                for (sum, (f, d)) in response.value.iter_mut().zip(by_fine.iter().zip(&difference)) {
                    *sum += f + d / 3.0;
                }
                response.walls.push(difference.into_iter().map(bf16::from_f64).collect());
            }
            response
        };
        Ok(walls.iter().map(response).collect::<Vec<_>>())
    };
    let found = gather.par_chunks(TOGETHER).map(block).collect::<Result<Vec<_>, StudyError>>()?;
    Ok(found.into_iter().flatten().collect())
}

impl Responses {
    /// Returns the weights with which the patches of the room receive light from an aperture by the cells of a basis.
    pub fn weights(&self, session: &Session, index: usize, basis: &Arc<RingBasis>) -> Arc<PatchWeights> {
        self.room.weights(session, index, basis)
    }

    /// Returns the interreflected illuminance per luminance of an aperture's cells, sensor by sensor and cell by cell.
    /// With `nodes` it is computed for each node of the aperture, node by node, for light that is 1 at that node and 0
    /// at the others.
    pub fn of_cells(
        &self,
        session: &Session,
        index: usize,
        basis: &Arc<RingBasis>,
        with_uncertainty: bool,
        nodes: Option<&Nodes>,
    ) -> Vec<Vec<Reflected>> {
        let mirrored = self.mirrors.as_ref().map(|mirrors| mirrors.of_cells(session, &self.room, index, basis));
        let sensor = |room: &ByCells, share: f64, s: usize| {
            let cell = |c: usize| {
                let added = mirrored.as_ref().map(|all| all.at(s, c));
                let value = room.value[s][c] + added.map_or(0.0, |added| share * added.value());
                let gap = |(w, wall): (usize, &Vec<bf16>)| {
                    f64::from(wall[c]) + added.map_or(0.0, |added| share * added.wall(w))
                };
                let squares: f64 = room.walls[s].iter().enumerate().map(gap).map(|x| x * x).sum();
                let room_side_reflection = added.map_or(0.0, |added| share * added.straight());
                Reflected { value, difference: squares.sqrt(), room_side_reflection }
            };
            (0..basis.len()).map(cell).collect()
        };
        let all = |room: &ByCells, share: f64| -> Vec<Vec<Reflected>> {
            (0..self.room.sensors.len()).into_par_iter().map(|s| sensor(room, share, s)).collect()
        };
        let Some(nodes) = nodes else {
            return all(&self.room.through_room(session, index, basis, with_uncertainty), 1.0);
        };
        // Light that apertures reflect hardly depends on where in one of them it entered.
        let by_node = self.room.through_room_by_node(session, index, basis, with_uncertainty, nodes);
        by_node.iter().zip(nodes.parts()).flat_map(|(room, part)| all(room, part)).collect()
    }

    /// Returns the interreflected illuminance at every sensor. `first`: illuminances of the patches before
    /// interreflection. \[lx\]
    pub fn of(&self, first: &[f64]) -> Vec<Reflected> {
        let mirrored = self.mirrors.as_ref().map(|mirrors| mirrors.of(first));
        let one = |(s, sensor): (usize, &Response)| {
            let added = mirrored.as_ref().map(|all| all.at(s, 0));
            let value = dot(&sensor.value, first) + added.map_or(0.0, AddedAt::value);
            let gap = |(w, wall): (usize, &Vec<bf16>)| dot(wall, first) + added.map_or(0.0, |added| added.wall(w));
            let squares: f64 = sensor.walls.iter().enumerate().map(gap).map(|x| x * x).sum();
            Reflected { value, difference: squares.sqrt(), room_side_reflection: added.map_or(0.0, AddedAt::straight) }
        };
        self.room.sensors.iter().enumerate().map(one).collect()
    }

    /// Returns the illuminance at every sensor by beams, after two reflections in the room, or one by an aperture.
    /// `sums`: reflected light of the beams; `direct`: illuminances of the patches by the beams. \[lx\]
    pub fn of_beams(&self, sums: &ReflectedBeamLight, direct: &[f64]) -> Vec<Reflected> {
        let mirrored = self.mirrors.as_ref().map(|mirrors| mirrors.of(direct));
        let one = |s: usize| {
            let added = mirrored.as_ref().map(|all| all.at(s, 0));
            let value = sums.values[s] + added.map_or(0.0, AddedAt::value);
            let gap = |(w, wall): (usize, f64)| wall + added.map_or(0.0, |added| added.wall(w));
            let squares: f64 = sums.walls(s).enumerate().map(gap).map(|x| x * x).sum();
            let difference = (squares + sums.blur[s].powi(2)).sqrt();
            Reflected { value, difference, room_side_reflection: added.map_or(0.0, AddedAt::straight) }
        };
        (0..self.room.sensors.len()).map(one).collect()
    }
}
