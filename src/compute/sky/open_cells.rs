//! Cache of the open sky on cells: it is the same from every point of an aperture.

use super::region::Frame;
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Estimate;
use std::sync::{Arc, Mutex, PoisonError};

/// Cached illuminances by the open sky of one outside.
#[derive(Debug, Default)]
pub(super) struct OpenCells(Mutex<Vec<Kept>>);

/// Illuminances by the cells of a basis in a frame.
#[derive(Debug)]
struct Kept {
    basis: RingBasis,
    frame: Frame,
    relative: f64,
    light: Arc<Vec<Estimate>>,
}

impl OpenCells {
    /// Returns the illuminances by the cells of a basis, computed if they are not there yet.
    pub fn get(
        &self,
        basis: &RingBasis,
        frame: &Frame,
        relative: f64,
        compute: impl FnOnce() -> Vec<Estimate>,
    ) -> Arc<Vec<Estimate>> {
        // What is kept is whole even if another thread has failed while it held the lock.
        let find = || {
            let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            let same = |one: &&Kept| one.relative == relative && one.frame == *frame && one.basis == *basis;
            kept.iter().find(same).map(|one| Arc::clone(&one.light))
        };
        if let Some(light) = find() {
            return light;
        }
        let light = Arc::new(compute());
        let kept = Kept { basis: basis.clone(), frame: *frame, relative, light: Arc::clone(&light) };
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(kept);
        light
    }
}
