//! Glare of an observer through the occupied steps by the daylight glare probability, and its class by EN 17037, Annex
//! E: DGP that is exceeded in no more than 5 % of the usage time. Dark steps are usage time, too, and have no glare.

use super::glare::{LIMITS, exceeded};

/// Levels of glare protection of EN 17037, Annex E, in the order of the rising [`LIMITS`] of DGP.
pub const CLASSES: [&str; 3] = ["high", "medium", "minimum"];

/// Annual DGP figures of one observer.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Probability {
    /// DGP that is exceeded in at most 5 % of the occupied steps.
    pub dgp_5_percent: f64,
    /// Shares of the occupied steps in which DGP exceeds each of [`LIMITS`].
    pub above: [f64; 3],
}

impl Probability {
    /// Computes the annual figures from `values`, the DGP in every occupied step, 0 in dark ones.
    pub fn of(values: Vec<f64>) -> Self {
        let (dgp_5_percent, above) = exceeded(values);
        Self { dgp_5_percent, above }
    }

    /// Returns the best of [`CLASSES`], the levels of glare protection, that the DGP exceeded in 5 % of the occupied
    /// steps allows; `None` if it is above all [`LIMITS`].
    pub fn class(&self) -> Option<&'static str> {
        LIMITS.iter().zip(CLASSES).find(|(limit, _)| self.dgp_5_percent <= **limit).map(|(_, class)| class)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_is_kept_while_its_limit_is_exceeded_in_a_twentieth_at_most() {
        // 5 of 100 steps above .35 are a twentieth, 6 are more.
        let with = |count: usize, value: f64| {
            let mut values = vec![0.3; 100];
            values[..count].fill(value);
            Probability::of(values)
        };
        assert_eq!(with(5, 0.36).class(), Some("high"));
        assert_eq!(with(6, 0.36).class(), Some("medium"));
        assert_eq!(with(6, 0.40).class(), Some("medium"));
        assert_eq!(with(6, 0.41).class(), Some("minimum"));
        assert_eq!(with(6, 0.45).class(), Some("minimum"));
        assert_eq!(with(6, 0.46).class(), None);
        assert_eq!(with(6, 0.46).above, [0.06; 3]);
        assert_eq!(with(6, 0.35).above, [0.0; 3]);
        assert_eq!(Probability::of(Vec::new()), Probability::default());
    }
}
