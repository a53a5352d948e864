//! Light that reaches the sensors after reflection by the room side of apertures that reflect by direction.
//!
//! V = V₀ + V₀b (1 − R G)⁻¹ R Gₜ: all but the system's reflection R depends on the room alone and is stored, so that
//! another system or state costs one small matrix. Apertures that reflect diffusely are a single cell.

use super::through_room::ThroughRoom;
use super::weights::ByCells;
use super::{Session, basis_key, check};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::CellMatrix;
use crate::compute::estimate::Progress;
use crate::compute::room::back_reflection::{BackReflection, RoomSide, settled};
use crate::compute::room::direct::Reception;
use crate::study::cache::Key;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use faer::Mat;
use std::f64::consts::PI;
use std::sync::Arc;

/// Reflection by the room sides of all apertures of a scene.
pub(crate) struct RoomSideReflection {
    sides: Vec<Side>,
    /// Luminances of all reflecting cells per incident illuminance of each cell, after all interreflections: (1 − R
    /// G)⁻¹ R.
    settled: Mat<f32>,
    /// Illuminances at the sensors per luminance of each reflecting cell, in the rows of [`Rows`]. Single precision is
    /// 10⁻⁷ of them.
    seen: Mat<f32>,
    rows: Rows,
}

/// Room side of one aperture that reflects.
struct Side {
    index: usize,
    basis: Arc<RingBasis>,
    room: Arc<RoomSide>,
}

/// Positions of a sensor's rows in the matrix: all light, its part directly from the aperture, then one row for each
/// wall.
struct Rows {
    first: Vec<usize>,
    walls: Vec<usize>,
}

/// Light that reaches the sensors after reflection by apertures, for several lights.
pub(super) struct Added<'a> {
    rows: &'a Rows,
    /// Illuminances, or illuminances per luminance, in the rows of [`Rows`], light by light.
    values: Mat<f32>,
}

/// Light that reaches one sensor after reflection by apertures, for one light.
#[derive(Clone, Copy)]
pub(super) struct AddedAt<'a>(&'a [f32]);

impl Added<'_> {
    /// Returns the light at a sensor for the light of an index.
    pub fn at(&self, sensor: usize, light: usize) -> AddedAt<'_> {
        let Rows { first, walls } = self.rows;
        AddedAt(&self.values.col_as_slice(light)[first[sensor]..][..2 + walls[sensor]])
    }
}

impl AddedAt<'_> {
    /// Returns the illuminance, or illuminance per luminance, by all light that apertures reflect.
    pub fn value(self) -> f64 {
        self.0[0].into()
    }

    /// Returns the contribution to the value that comes directly from the apertures.
    pub fn straight(self) -> f64 {
        self.0[1].into()
    }

    /// Returns the difference between the fine and the coarse mesh by the light of a wall.
    pub fn wall(self, wall: usize) -> f64 {
        self.0[2 + wall].into()
    }
}

impl RoomSideReflection {
    /// Creates the reflection by the room sides of a scene's apertures; `None` if none reflects. `lambertian`:
    /// reflectance of every aperture that reflects diffusely, 0 for others.
    pub fn new(
        session: &Session,
        scene: &Scene,
        lambertian: &[f64],
        responses: &ThroughRoom,
        progress: &dyn Progress,
    ) -> Result<Option<Self>, StudyError> {
        let all = RingBasis::hemisphere();
        let even = |rho: &f64| (*rho > 0.0).then(|| CellMatrix::new(all.clone(), all.clone(), vec![rho / PI]));
        let even: Vec<Option<CellMatrix>> = lambertian.iter().map(|rho| even(rho).flatten()).collect();
        let mut mirrors = Vec::new();
        for (index, (one, even)) in scene.apertures.iter().zip(&even).enumerate() {
            if let Some(matrix) = one.back_reflection().or(even.as_ref()) {
                let weights = responses.weights(session, index, &Arc::new(matrix.incident().clone()));
                mirrors.push((index, BackReflection::new(matrix, weights)));
            }
        }
        if mirrors.is_empty() {
            return Ok(None);
        }
        check(progress)?;
        let sides: Vec<Side> = mirrors
            .iter()
            .map(|(index, mirror)| {
                let basis = Arc::clone(&mirror.weights().basis);
                let room = session.room_side(responses, *index, &basis);
                Side { index: *index, basis, room }
            })
            .collect();
        check(progress)?;
        let again: Vec<Vec<_>> = sides
            .iter()
            .map(|to| sides.iter().map(|from| session.falling_in(responses, to, from.index, &from.basis)).collect())
            .collect();
        let settled = half(&settled(&mirrors, &again));
        // Light of the reflecting apertures at the sensors, by way of the room and direct.
        let by_room: Vec<Arc<ByCells>> =
            sides.iter().map(|side| responses.through_room(session, side.index, &side.basis, true)).collect();
        let straight: Vec<Arc<Vec<Reception>>> = sides
            .iter()
            .map(|side| session.receptions(scene, side.index, Some(&side.basis), progress))
            .collect::<Result<_, _>>()?;
        let cells: Vec<(usize, usize)> =
            sides.iter().enumerate().flat_map(|(k, side)| (0..side.basis.len()).map(move |cell| (k, cell))).collect();
        let walls: Vec<usize> =
            (0..scene.sensors.len()).map(|s| by_room.first().map_or(0, |by_room| by_room.walls[s].len())).collect();
        let mut rows = Rows { first: Vec::with_capacity(walls.len()), walls };
        let mut list: Vec<(usize, usize)> = Vec::new();
        for (s, walls) in rows.walls.iter().enumerate() {
            rows.first.push(list.len());
            list.extend((0..2 + walls).map(|part| (s, part)));
        }
        let seen = Mat::from_fn(list.len(), cells.len(), |row, column| {
            let ((s, part), (k, cell)) = (list[row], cells[column]);
            let weight = match part {
                0 => by_room[k].value[s][cell] + straight[k][s].cells[cell],
                1 => straight[k][s].cells[cell],
                wall => f64::from(by_room[k].walls[s][wall - 2][cell]),
            };
            weight as f32
        });
        Ok(Some(Self { sides, settled, seen, rows }))
    }

    /// Returns the illuminance after reflection by apertures per luminance of each cell of an aperture.
    pub fn of_cells(
        &self,
        session: &Session,
        responses: &ThroughRoom,
        index: usize,
        basis: &Arc<RingBasis>,
    ) -> Added<'_> {
        let falling: Vec<_> = self.sides.iter().map(|side| session.falling_in(responses, side, index, basis)).collect();
        let rows: Vec<&Vec<f64>> = falling.iter().flat_map(|rows| rows.iter()).collect();
        self.reflected(&Mat::from_fn(rows.len(), basis.len(), |i, cell| rows[i][cell] as f32))
    }

    /// Returns the illuminance after reflection by apertures of one light. `first`: illuminances of the patches of the
    /// room before interreflection. \[lx\]
    pub fn of(&self, first: &[f64]) -> Added<'_> {
        let incident: Vec<f64> = self.sides.iter().flat_map(|side| side.room.incident(first)).collect();
        self.reflected(&Mat::from_fn(incident.len(), 1, |i, _| incident[i] as f32))
    }

    /// Computes the light at all sensors from the illuminances of the reflecting cells, light by light.
    fn reflected(&self, incident: &Mat<f32>) -> Added<'_> {
        // One thread: the result must not depend on their number.
        faer::set_global_parallelism(faer::Par::Seq);
        Added { rows: &self.rows, values: &self.seen * (&self.settled * incident) }
    }
}

/// Returns a matrix in single precision.
fn half(matrix: &Mat<f64>) -> Mat<f32> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] as f32)
}

impl Session {
    fn room_side(&self, responses: &ThroughRoom, index: usize, basis: &Arc<RingBasis>) -> Arc<RoomSide> {
        let compute = || {
            let weights = responses.weights(self, index, basis);
            RoomSide::new(&responses.radiosity, &responses.geometry[index], &weights)
        };
        self.sides.find(cells_key(&responses.key, index, basis), compute)
    }

    /// Returns the illuminance of a reflecting aperture by incident cell, per luminance of the cells of another
    /// aperture or the same; computed or stored. `to`: reflecting aperture; `from`: index of the emitting one.
    fn falling_in(
        &self,
        responses: &ThroughRoom,
        to: &Side,
        from: usize,
        basis: &Arc<RingBasis>,
    ) -> Arc<Vec<Vec<f64>>> {
        let key = cells_key(&cells_key(&responses.key, to.index, &to.basis), from, basis);
        self.falling.find(key, || to.room.by_cells(&responses.weights(self, from, basis)))
    }
}

fn cells_key(key: &Key, index: usize, basis: &RingBasis) -> Key {
    let mut key = key.clone();
    key.push(index as u64);
    key.extend(basis_key(Some(basis)));
    key
}
