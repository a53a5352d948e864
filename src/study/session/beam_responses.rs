//! Reflected light of beams at the sensors, by the patches of the room that beams light.
//!
//! The outlines of the areas that beams light are seen in closed form; light after two reflections or more is smooth
//! enough to be described by patches, so that a beam costs only the patches that it touches. Beams that many systems
//! send in the same direction are computed once, see [`super::unit_beams`].

use super::weights::{Response, by_walls};
use crate::compute::dot::{add_scaled, wide};
use crate::compute::room::gather::Reconstruction;
use crate::compute::room::radiosity::Radiosity;

/// Illuminances at the sensors per illuminance of each patch of the room by beams.
pub(crate) struct BeamResponses {
    sensors: usize,
    /// Index of the first column with the walls of each sensor; the last entry is the end.
    walls: Vec<usize>,
    /// Values patch by patch: illuminances after two reflections or more, their differences between the fine and the
    /// coarse mesh by wall, and illuminances after one reflection.
    rows: Vec<f32>,
}

/// Illuminances at the sensors by reflected light of one or more beams.
pub(crate) struct ReflectedBeamLight {
    /// Illuminance after two reflections or more, sensor by sensor. \[lx\]
    pub values: Vec<f64>,
    /// Uncertainty of `values`, because the position of a beam within a patch is not known. \[lx\]
    pub blur: Vec<f64>,
    /// Illuminance after one reflection, with beams taken as spread uniformly over each patch that they light. \[lx\]
    pub seen: Vec<f64>,
    /// Differences of the illuminances between the fine and the coarse mesh, sensor by sensor, wall by wall. \[lx\]
    pub(super) columns: Vec<f32>,
    walls: Vec<usize>,
}

impl ReflectedBeamLight {
    /// Returns the differences of the illuminance at a sensor between the fine and the coarse mesh, wall by wall.
    /// \[lx\]
    pub fn walls(&self, sensor: usize) -> impl Iterator<Item = f64> {
        let [from, to] = [sensor, sensor + 1].map(|s| self.walls[s] - self.walls[0]);
        self.columns[from..to].iter().map(|&e| f64::from(e))
    }
}

impl BeamResponses {
    /// Returns the memory that the responses take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.rows[..])
    }

    /// Returns the number of values of one beam.
    pub fn numbers(&self) -> usize {
        3 * self.sensors + self.walls[self.sensors] - self.walls[0]
    }

    /// Creates the responses to beams. `gather`: weights with which the sensors see the patches of the fine and the
    /// coarse mesh; `sensors`: responses of the sensors to the first illuminances of the patches.
    pub fn new(radiosity: &Radiosity, gather: &[[Reconstruction; 2]], sensors: &[Response]) -> Self {
        let count = sensors.len();
        let mut walls = vec![count];
        walls.extend(sensors.iter().scan(count, |end, sensor| {
            *end += sensor.walls.len();
            Some(*end)
        }));
        let width = walls[count] + count;
        let mut rows = vec![0.0_f32; width * radiosity.nested.fine.patches.len()];
        for (s, ([fine, coarse], sensor)) in gather.iter().zip(sensors).enumerate() {
            let mut put = |column: usize, k: usize, value: f64| rows[k * width + column] = value as f32;
            let mut later = sensor.value.clone();
            let mut seen = vec![0.0; later.len()];
            for (w, [fine, coarse]) in by_walls(radiosity, &fine.weights, &coarse.weights).into_iter().enumerate() {
                let (once, by_coarse) = (radiosity.once_fine(&fine), radiosity.once_coarse(&coarse));
                for (k, (f, c)) in once.iter().zip(&by_coarse).enumerate() {
                    later[k] -= f + (f - c) / 3.0;
                    seen[k] += f;
                    put(walls[s] + w, k, f64::from(sensor.walls[w][k]) - (f - c));
                }
            }
            for (k, (later, seen)) in later.iter().zip(&seen).enumerate() {
                put(s, k, *later);
                put(walls[count] + s, k, *seen);
            }
        }
        Self { sensors: count, walls, rows }
    }

    /// Returns illuminances of 0, for no beams.
    pub fn dark(&self) -> ReflectedBeamLight {
        let (count, walls) = (self.sensors, self.walls.clone());
        let dark = || vec![0.0; count];
        ReflectedBeamLight {
            values: dark(),
            blur: dark(),
            seen: dark(),
            columns: vec![0.0; walls[count] - count],
            walls,
        }
    }

    /// Returns the illuminances at the sensors after one reflection, with beams taken as spread uniformly over each
    /// patch. `direct`: illuminances of the patches by beams. \[lx\]
    pub fn seen(&self, direct: &[f64]) -> Vec<f64> {
        let (count, last) = (self.sensors, self.walls[self.sensors]);
        let mut seen = vec![0.0; count];
        let rows = self.rows.chunks_exact(last + count).zip(direct);
        rows.filter(|(_, e)| **e != 0.0).for_each(|(row, &e)| add_scaled(&mut seen, &row[last..], e));
        seen
    }

    /// Computes the illuminances at the sensors by reflected light of beams. `direct`: illuminances of the patches by
    /// the beams. \[lx\]
    pub fn of(&self, radiosity: &Radiosity, direct: &[f64]) -> ReflectedBeamLight {
        let (count, last) = (self.sensors, self.walls[self.sensors]);
        let rows = |light| self.rows.chunks_exact(last + count).zip(light).filter(|(_, e): &(_, &f64)| **e != 0.0);
        let (mut fine, mut seen) = (vec![0.0; count], vec![0.0; count]);
        // Only the uncertainty depends on these: single precision is enough.
        let mut columns = vec![0.0_f32; last - count];
        for (row, &e) in rows(direct) {
            add_scaled(&mut fine, row, e);
            wide(|| columns.iter_mut().zip(&row[count..]).for_each(|(sum, weight)| *sum += e as f32 * weight));
            add_scaled(&mut seen, &row[last..], e);
        }
        // Patches of twice the size place the beams four times as badly.
        let mut coarse = vec![0.0; count];
        rows(&radiosity.blurred(direct)).for_each(|(row, &e)| add_scaled(&mut coarse, row, e));
        let blur: Vec<f64> = fine.iter().zip(coarse).map(|(fine, coarse)| (fine - coarse) / 3.0).collect();
        let values = fine.iter().zip(&blur).map(|(e, gap)| e + gap).collect();
        ReflectedBeamLight { values, blur, seen, columns, walls: self.walls.clone() }
    }
}
