//! What every sensor's interreflected light hangs on: weights of the first illuminance of every patch, from the room's
//! balance read backwards. One set serves every sky, sun and system of a room.

use super::interreflected::{mirrors, room_key, spans};
use super::{Session, check};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Progress;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::back_reflection::{BackReflection, Settled, gathered, settled_weights};
use crate::compute::room::first_bounce::{BeamLanding, PatchWeights};
use crate::compute::room::radiosity::{Radiosity, dot};
use crate::study::cache::Key;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use rayon::prelude::*;
use std::sync::Arc;

/// Weights of one sensor, by fine patch.
pub(in crate::study) struct Response {
    /// Of all first illuminance. \[lx per lx\]
    pub value: Vec<f64>,
    /// The difference of the two densities, wall by wall.
    pub walls: Vec<Vec<f64>>,
    /// Of what comes back from apertures that reflect by direction; empty without such.
    pub thrown_back: Vec<f64>,
    /// Of what beams light, as far as these apertures alone throw it back; empty without such.
    pub lit: Vec<f64>,
}

/// Weights of all sensors.
pub(in crate::study) struct Responses {
    /// The balance.
    pub radiosity: Arc<Radiosity>,
    /// In the order of the scene.
    pub sensors: Vec<Response>,
    key: Key,
    geometry: Vec<Aperture>,
}

impl Responses {
    /// What the patches receive from an aperture by the cells of a basis.
    pub fn weights(&self, session: &Session, index: usize, basis: &Arc<RingBasis>) -> Arc<PatchWeights> {
        session.patch_weights(&self.key, &self.radiosity.nested.fine, index, &self.geometry, basis)
    }
}

impl Session {
    /// For a room of about so many fine patches.
    pub(in crate::study) fn responses(
        &self,
        scene: &Scene,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<Responses, StudyError> {
        let radiosity = self.radiosity(scene, count)?;
        check(progress)?;
        let gather = self.gathering(scene, count, &radiosity)?;
        let sensors = gather
            .par_iter()
            .map(|[fine, coarse]| {
                check(progress)?;
                Ok(response(&radiosity, &fine.weights, &coarse.weights))
            })
            .collect::<Result<_, StudyError>>()?;
        let key = room_key(scene, count);
        let geometry = scene.apertures.iter().map(|a| a.aperture).collect();
        let mut responses = Responses { radiosity, sensors, key, geometry };
        self.add_mirrors(scene, &mut responses, progress)?;
        Ok(responses)
    }

    /// What goes to and fro between the room and apertures that reflect by direction: with the symbols of
    /// [`settled_weights`], every sensor's weights a become a + (a W + r) (1 − Q W)⁻¹ Q, r what it sees of l itself.
    fn add_mirrors(&self, scene: &Scene, responses: &mut Responses, progress: &dyn Progress) -> Result<(), StudyError> {
        let mirrors = mirrors(scene, |index, basis| responses.weights(self, index, basis));
        if mirrors.is_empty() {
            return Ok(());
        }
        check(progress)?;
        // Solved once for all sensors and lights: the matrix is only as large as the mirroring cells are many.
        let settled = settled_weights(&responses.radiosity, &responses.geometry, &mirrors);
        let mut seen = vec![Vec::with_capacity(settled.by_first.len()); scene.sensors.len()];
        for (index, mirror) in &mirrors {
            // Straight to the sensor as well: a mirror is seen, and not only what it lights.
            let receptions = self.receptions(scene, *index, Some(&mirror.weights().basis), progress)?;
            seen.iter_mut().zip(receptions.iter()).for_each(|(list, reception)| list.extend(&reception.cells));
        }
        check(progress)?;
        let sensors = responses.sensors.par_iter_mut().zip(seen);
        sensors.for_each(|(sensor, seen)| sensor.add_thrown_back(&mirrors, &settled, &seen));
        Ok(())
    }
}

/// Weights of the mirroring cells' settled luminances as weights of the first illuminance.
fn through(settled: &[Vec<f64>], weights: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; settled.first().map_or(0, Vec::len)];
    for (w, row) in weights.iter().zip(settled).filter(|(w, _)| **w != 0.0) {
        sums.iter_mut().zip(row).for_each(|(sum, q)| *sum += w * q);
    }
    sums
}

/// Without mirrors.
fn response(radiosity: &Radiosity, fine: &[f64], coarse: &[f64]) -> Response {
    let (mesh, coarser) = (&radiosity.nested.fine, &radiosity.nested.coarse);
    let mut response = Response {
        value: vec![0.0; fine.len()],
        walls: Vec::with_capacity(6),
        thrown_back: Vec::new(),
        lit: Vec::new(),
    };
    for (a, b) in spans(mesh).into_iter().zip(spans(coarser)) {
        if fine[a.clone()].iter().chain(&coarse[b.clone()]).all(|w| *w == 0.0) {
            continue;
        }
        let only = |weights: &[f64], range: std::ops::Range<usize>| -> Vec<f64> {
            let mut own = vec![0.0; weights.len()];
            own[range.clone()].copy_from_slice(&weights[range]);
            own
        };
        let by_fine = radiosity.adjoint_fine(&only(fine, a));
        let by_coarse = radiosity.adjoint_coarse(&only(coarse, b));
        // As the extrapolation of the two densities: fine + (fine − coarse)/3.
        let difference: Vec<f64> = by_fine.iter().zip(&by_coarse).map(|(f, c)| f - c).collect();
        for (sum, (f, d)) in response.value.iter_mut().zip(by_fine.iter().zip(&difference)) {
            *sum += f + d / 3.0;
        }
        response.walls.push(difference);
    }
    response
}

impl Response {
    /// The step of [`Session::add_mirrors`] at one sensor; `seen`: what it sees of every mirroring cell itself.
    fn add_thrown_back(&mut self, mirrors: &[(usize, BackReflection<'_>)], settled: &Settled, seen: &[f64]) {
        let add = |to: &mut Vec<f64>, part: &[f64]| to.iter_mut().zip(part).for_each(|(sum, x)| *sum += x);
        let own = gathered(mirrors, &self.value);
        let back = through(&settled.by_first, &own);
        add(&mut self.value, &back);
        // Kept by itself too: that an aperture is not evenly lit puts this part in doubt, and no other.
        self.thrown_back = through(&settled.by_first, seen);
        add(&mut self.value, &self.thrown_back);
        let all: Vec<f64> = own.iter().zip(seen).map(|(a, r)| a + r).collect();
        self.lit = through(&settled.by_lit, &all);
        for wall in &mut self.walls {
            let back = through(&settled.by_first, &gathered(mirrors, wall));
            add(wall, &back);
        }
    }

    /// Of a first illuminance: value, what the two densities differ by, and what comes back from apertures.
    pub fn of(&self, first: &[f64]) -> (f64, f64, f64) {
        let squares: f64 = self.walls.iter().map(|wall| dot(wall, first).powi(2)).sum();
        let thrown_back = if self.thrown_back.is_empty() { 0.0 } else { dot(&self.thrown_back, first) };
        (dot(&self.value, first), squares.sqrt(), thrown_back)
    }

    /// What beams give after they were reflected: through patches, and by way of apertures that reflect by direction. The
    /// outlines that they light are left to the caller.
    pub fn of_beams(&self, landing: &BeamLanding) -> f64 {
        let back = if self.lit.is_empty() { 0.0 } else { dot(&self.lit, &landing.direct) };
        dot(&self.value, &landing.thrown) + back
    }
}
