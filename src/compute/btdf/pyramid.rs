//! Pyramid of square grids, with which a tensor tree is summed in one walk over its leaves.

/// Values on square grids of every resolution from 1 to the finest, by powers of two.
pub(super) struct Pyramid {
    levels: Vec<Vec<f64>>,
}

impl Pyramid {
    pub(super) fn new(finest: u32) -> Self {
        Self { levels: (0..=finest).map(|level| vec![0.0; 1 << (2 * level)]).collect() }
    }

    /// Creates a pyramid from totals of the finest cells: the value of every coarser cell is the sum of its four parts.
    pub(super) fn gather(finest: u32, totals: Vec<f64>) -> Self {
        let mut pyramid = Self::new(finest);
        pyramid.levels[finest as usize] = totals;
        for level in (0..finest as usize).rev() {
            let side = 1 << level;
            let (coarse, fine) = pyramid.levels.split_at_mut(level + 1);
            for iy in 0..side {
                for ix in 0..side {
                    let k = 4 * iy * side + 2 * ix;
                    let fine = &fine[0];
                    coarse[level][iy * side + ix] = fine[k] + fine[k + 1] + fine[k + 2 * side] + fine[k + 2 * side + 1];
                }
            }
        }
        pyramid
    }

    pub(super) fn at(&mut self, level: u32, ix: usize, iy: usize) -> &mut f64 {
        &mut self.levels[level as usize][(iy << level) + ix]
    }

    pub(super) fn get(&self, level: u32, ix: usize, iy: usize) -> f64 {
        self.levels[level as usize][(iy << level) + ix]
    }

    /// Returns the finest grid with the value of every coarser cell added to all finest cells in it.
    pub(super) fn spread(mut self) -> Vec<f64> {
        for level in 1..self.levels.len() {
            let side = 1 << level;
            let (coarse, fine) = self.levels.split_at_mut(level);
            for iy in 0..side {
                for ix in 0..side {
                    fine[0][iy * side + ix] += coarse[level - 1][(iy / 2) * (side / 2) + ix / 2];
                }
            }
        }
        self.levels.pop().unwrap_or_default()
    }
}
