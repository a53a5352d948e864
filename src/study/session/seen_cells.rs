//! What sensors see straight of an aperture's cells: the same for all systems, and nothing of most cells.

use crate::compute::dot::add_scaled;

/// Rows of the cells of which any sensor sees anything.
pub(crate) struct SeenCells {
    sensors: usize,
    /// Where the row of a cell begins; `None` where no sensor sees it.
    first: Vec<Option<u32>>,
    /// Sensor by sensor what it sees per luminance of a cell. \[sr\]
    rows: Vec<f32>,
}

impl SeenCells {
    /// Of so many cells; `weights`: of every sensor the cells that it sees.
    pub fn new<I>(cells: usize, weights: impl ExactSizeIterator<Item = I> + Clone) -> Self
    where
        I: Iterator<Item = (usize, f64)>,
    {
        let sensors = weights.len();
        let mut seen = vec![false; cells];
        weights.clone().flatten().filter(|(_, weight)| *weight != 0.0).for_each(|(cell, _)| seen[cell] = true);
        let mut count = 0;
        let place = |seen: bool| {
            seen.then(|| {
                count += 1;
                (count - 1) * sensors as u32
            })
        };
        let first: Vec<Option<u32>> = seen.into_iter().map(place).collect();
        let mut rows = vec![0.0; count as usize * sensors];
        for (s, weights) in weights.enumerate() {
            for (cell, weight) in weights {
                if let Some(first) = first[cell] {
                    rows[first as usize + s] = weight as f32;
                }
            }
        }
        Self { sensors, first, rows }
    }

    /// Adds what the sensors see of a cell of some luminance.
    #[inline]
    pub fn add(&self, cell: usize, luminance: f64, out: &mut [f64]) {
        if let Some(first) = self.first[cell] {
            add_scaled(out, &self.rows[first as usize..][..self.sensors], luminance);
        }
    }
}
