//! Notes on how apertures with obstructions in front of them were computed: into how many parts they were divided, and
//! why.

use crate::texts::{fixed, words as texts};

/// Method by which an aperture with obstructions in front of it was computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideSeen {
    /// Index of the aperture, from 0.
    pub aperture: usize,
    /// Whether the system has regular transmission, through which every sensor sees the outside past the obstructions.
    pub through: bool,
    /// Number of parts into which the aperture was divided for scattered light; 0 if all its points see the same
    /// outside; `None` if it does not scatter.
    pub parts: Option<usize>,
    /// Largest relative change of the scattered flux per area over a part, or over the whole aperture.
    pub change: f64,
    /// Sunlit share of the aperture; `None` if the sun is not in front of it.
    pub sunlit: Option<f64>,
}

impl OutsideSeen {
    /// Returns the notes for the user, one sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let number = self.aperture + 1;
        let mut notes = Vec::new();
        if self.through {
            notes.push(texts::past_outside(number));
        }
        match self.parts {
            Some(0) => notes.push(texts::outside_alike(number, fixed(100.0 * self.change, 1))),
            Some(1) => notes.push(texts::outside_one_part(number, fixed(100.0 * self.change, 0))),
            Some(parts) => notes.push(texts::outside_parts(number, parts, fixed(100.0 * self.change, 0))),
            None => {}
        }
        match self.sunlit {
            Some(share) if share >= 1.0 - 1e-9 => notes.push(texts::sun_on_all(number)),
            Some(share) if share <= 1e-9 => notes.push(texts::sun_on_none(number)),
            Some(share) => notes.push(texts::sun_on_part(number, fixed(100.0 * share, 0))),
            None => {}
        }
        notes
    }
}
