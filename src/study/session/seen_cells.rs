//! Direct illuminances at the sensors per luminance of an aperture's emergent cells: the same for all systems, and zero
//! for most cells.

use crate::compute::dot::add_scaled;

/// Direct illuminances at the sensors per luminance of each emergent cell, with rows only for cells that any sensor
/// sees.
pub(crate) struct SeenCells {
    sensors: usize,
    /// Start of the row of each cell; `None` for cells that no sensor sees.
    first: Vec<Option<u32>>,
    /// Illuminance per luminance of the cell, sensor by sensor. \[sr\]
    rows: Vec<f32>,
}

impl SeenCells {
    /// Creates the rows for a basis of `cells` cells. `weights`: for every sensor the cells that it sees, with their
    /// weights \[sr\].
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

    /// Returns the memory that the rows take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.first[..]) + size_of_val(&self.rows[..])
    }

    /// Adds the direct illuminances at the sensors by an emergent cell of the given luminance \[cd/m²\] to `out`.
    /// \[lx\]
    #[inline]
    pub fn add(&self, cell: usize, luminance: f64, out: &mut [f64]) {
        if let Some(first) = self.first[cell] {
            add_scaled(out, &self.rows[first as usize..][..self.sensors], luminance);
        }
    }
}
