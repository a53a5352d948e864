//! Cache of the illuminances from cells by the unobstructed sky, which are the same at every point of an aperture.

use super::region::Frame;
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Estimate;
use std::sync::{Arc, Mutex, PoisonError};

/// Cached illuminances from cells by the unobstructed sky and ground of one outside.
#[derive(Debug, Default)]
pub(super) struct OpenCells(Mutex<Vec<Kept>>);

/// Illuminances of a plane from the cells of a basis.
#[derive(Debug)]
struct Kept {
    basis: RingBasis,
    frame: Frame,
    relative: f64,
    light: Arc<Vec<Estimate>>,
}

impl OpenCells {
    /// Returns the illuminances from the cells of a basis \[lx\], computed if they are not in the cache yet.
    pub fn get(
        &self,
        basis: &RingBasis,
        frame: &Frame,
        relative: f64,
        compute: impl FnOnce() -> Vec<Estimate>,
    ) -> Arc<Vec<Estimate>> {
        // The cache is valid even if another thread panicked while it held the lock.
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
