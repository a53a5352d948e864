//! How an aperture sees what stands outside, in words: what was split, and why.

use crate::texts::{fixed, words as texts};

/// How an aperture that something stands before was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideSeen {
    /// Which one, from 0.
    pub aperture: usize,
    /// Every sensor looks straight through it and past what stands outside.
    pub through: bool,
    /// Into how many parts it was split for the light that it scatters; 0 where its points see the outside alike; `None`
    /// where it scatters none.
    pub parts: Option<usize>,
    /// How much that light changes over a part, or over the whole of it. \[relative\]
    pub change: f64,
    /// Share of it that the sun reaches; `None` without a sun before it.
    pub sunlit: Option<f64>,
}

impl OutsideSeen {
    /// A sentence for each thing that there is to be said.
    pub fn sentences(&self) -> Vec<String> {
        let number = self.aperture + 1;
        let mut said = Vec::new();
        if self.through {
            said.push(texts::past_outside(number));
        }
        match self.parts {
            Some(0) => said.push(texts::outside_alike(number, fixed(100.0 * self.change, 1))),
            Some(1) => said.push(texts::outside_one_part(number, fixed(100.0 * self.change, 0))),
            Some(parts) => said.push(texts::outside_parts(number, parts, fixed(100.0 * self.change, 0))),
            None => {}
        }
        match self.sunlit {
            Some(share) if share >= 1.0 - 1e-9 => said.push(texts::sun_on_all(number)),
            Some(share) if share <= 1e-9 => said.push(texts::sun_on_none(number)),
            Some(share) => said.push(texts::sun_on_part(number, fixed(100.0 * share, 0))),
            None => {}
        }
        said
    }
}
