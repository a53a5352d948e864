//! Reflected light of beams at the sensors, by the patches of the room that beams light.
//!
//! The outlines of the areas that beams light are seen in closed form; light after two reflections or more is smooth
//! enough to be described by patches, so that a beam costs only the patches that it touches. Beams that many systems
//! send in the same direction are computed once, see [`super::unit_beams`].

use super::weights::{Response, by_walls};
use crate::compute::dot::{add_scaled, wide};
use crate::compute::room::gather::Reconstruction;
use crate::compute::room::radiosity::Radiosity;
use half::bf16;

/// Illuminances at the sensors per illuminance of each patch of the room by beams.
pub(crate) struct BeamResponses {
    sensors: usize,
    /// Index of the first difference of each sensor in a row of `walls`; the last entry is the end.
    first: Vec<usize>,
    /// Illuminances patch by patch: after two reflections or more, then after one.
    rows: Vec<f32>,
    /// Differences of the former between the fine and the coarse mesh, patch by patch, wall by wall; only the
    /// uncertainty depends on them, so that two digits are enough.
    walls: Vec<bf16>,
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
    pub(super) walls: Vec<f32>,
    first: Vec<usize>,
}

impl ReflectedBeamLight {
    /// Returns the differences of the illuminance at a sensor between the fine and the coarse mesh, wall by wall.
    /// \[lx\]
    pub fn walls(&self, sensor: usize) -> impl Iterator<Item = f64> {
        self.walls[self.first[sensor]..self.first[sensor + 1]].iter().map(|&e| f64::from(e))
    }
}

impl BeamResponses {
    /// Returns the memory that the responses take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.rows[..]) + size_of_val(&self.walls[..])
    }

    /// Returns the number of differences of one beam.
    fn differences(&self) -> usize {
        self.first[self.sensors]
    }

    /// Creates the responses to beams. `gather`: weights with which the sensors see the patches of the fine and the
    /// coarse mesh; `sensors`: responses of the sensors to the first illuminances of the patches.
    pub fn new(radiosity: &Radiosity, gather: &[[Reconstruction; 2]], sensors: &[Response]) -> Self {
        let (count, patches) = (sensors.len(), radiosity.nested.fine.patches.len());
        let mut first = vec![0];
        first.extend(sensors.iter().scan(0, |end, sensor| {
            *end += sensor.walls.len();
            Some(*end)
        }));
        let width = first[count];
        let mut rows = vec![0.0_f32; 2 * count * patches];
        let mut walls = vec![bf16::ZERO; width * patches];
        for (s, ([fine, coarse], sensor)) in gather.iter().zip(sensors).enumerate() {
            let mut later = sensor.value.clone();
            let mut seen = vec![0.0; later.len()];
            for (w, [fine, coarse]) in by_walls(radiosity, &fine.weights, &coarse.weights).into_iter().enumerate() {
                let (once, by_coarse) = (radiosity.once_fine(&fine), radiosity.once_coarse(&coarse));
                for (k, (f, c)) in once.iter().zip(&by_coarse).enumerate() {
                    later[k] -= f + (f - c) / 3.0;
                    seen[k] += f;
                    walls[k * width + first[s] + w] = bf16::from_f64(f64::from(sensor.walls[w][k]) - (f - c));
                }
            }
            for (k, (later, seen)) in later.iter().zip(&seen).enumerate() {
                let row = &mut rows[2 * count * k..];
                (row[s], row[count + s]) = (*later as f32, *seen as f32);
            }
        }
        Self { sensors: count, first, rows, walls }
    }

    /// Returns illuminances of 0, for no beams.
    pub fn dark(&self) -> ReflectedBeamLight {
        let dark = || vec![0.0; self.sensors];
        ReflectedBeamLight {
            values: dark(),
            blur: dark(),
            seen: dark(),
            walls: vec![0.0; self.differences()],
            first: self.first.clone(),
        }
    }

    /// Returns the illuminances of the patches that are lit, each with its row of illuminances at the sensors: after two
    /// reflections or more, and after one.
    fn lit<'a>(&'a self, light: &'a [f64]) -> impl Iterator<Item = (f64, [&'a [f32]; 2])> {
        let rows = self.rows.chunks_exact((2 * self.sensors).max(1)).zip(light).filter(|(_, e)| **e != 0.0);
        rows.map(|(row, &e)| (e, row.split_at(self.sensors).into()))
    }

    /// Returns the illuminances at the sensors after one reflection, with beams taken as spread uniformly over each
    /// patch. `direct`: illuminances of the patches by beams. \[lx\]
    pub fn seen(&self, direct: &[f64]) -> Vec<f64> {
        let mut seen = vec![0.0; self.sensors];
        self.lit(direct).for_each(|(e, [_, once])| add_scaled(&mut seen, once, e));
        seen
    }

    /// Computes the illuminances at the sensors by reflected light of beams. `direct`: illuminances of the patches by
    /// the beams. \[lx\]
    pub fn of(&self, radiosity: &Radiosity, direct: &[f64]) -> ReflectedBeamLight {
        let ReflectedBeamLight { values: mut fine, mut seen, mut walls, first, .. } = self.dark();
        for (e, [later, once]) in self.lit(direct) {
            add_scaled(&mut fine, later, e);
            add_scaled(&mut seen, once, e);
        }
        let differences = self.walls.chunks_exact(self.differences().max(1)).zip(direct).filter(|(_, e)| **e != 0.0);
        for (row, &e) in differences {
            wide(|| walls.iter_mut().zip(row).for_each(|(sum, weight)| *sum += e as f32 * f32::from(*weight)));
        }
        // Patches of twice the size place the beams four times as badly.
        let mut coarse = vec![0.0; self.sensors];
        self.lit(&radiosity.blurred(direct)).for_each(|(e, [later, _])| add_scaled(&mut coarse, later, e));
        let blur: Vec<f64> = fine.iter().zip(coarse).map(|(fine, coarse)| (fine - coarse) / 3.0).collect();
        let values = fine.iter().zip(&blur).map(|(e, gap)| e + gap).collect();
        ReflectedBeamLight { values, blur, seen, walls, first }
    }
}
