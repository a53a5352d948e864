//! Notes on how the obstructions in front of an aperture were treated: what was split, and why.

use crate::texts::{fixed, words as texts};

/// Treatment of an aperture with obstructions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideSeen {
    /// Number of the aperture, from 0.
    pub aperture: usize,
    /// Whether every sensor sees the outside past the obstructions through the aperture's regular transmission.
    pub through: bool,
    /// Number of parts into which it was split for scattered light; 0 where its points see the outside alike; `None`
    /// where it scatters none.
    pub parts: Option<usize>,
    /// Change of that light over a part, or over the whole aperture. \[relative\]
    pub change: f64,
    /// Sunlit share of the aperture; `None` without a sun in front of it.
    pub sunlit: Option<f64>,
}

impl OutsideSeen {
    /// Returns a sentence for each note.
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
