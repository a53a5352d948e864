//! Keys `compute.near_field` and `compute.near_field_samples` of a scene: method of integrating the light of an
//! aperture at a sensor (eq 17), for comparison with the default method.

use super::error::StudyError;
use crate::compute::room::near_field::NearField;
use serde::{Deserialize, Serialize};

/// Value of the key `compute.near_field`: method of integrating the light of an aperture at a sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(try_from = "String", into = "&'static str")]
pub enum NearFieldKey {
    /// Default method: closed forms, and error-controlled cubature over the solid angle.
    #[default]
    SolidAngle,
    /// Subdivision of the aperture into point luminaires.
    Subdivision,
    /// Monte Carlo integration over random points on the aperture.
    MonteCarlo,
    /// Summed-area tables over two profile angles.
    ProfileTable,
}

const WORDS: [(&str, NearFieldKey); 4] = [
    ("solid-angle", NearFieldKey::SolidAngle),
    ("subdivision", NearFieldKey::Subdivision),
    ("monte-carlo", NearFieldKey::MonteCarlo),
    ("profile-table", NearFieldKey::ProfileTable),
];

impl TryFrom<String> for NearFieldKey {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        WORDS.iter().find(|(word, _)| *word == text).map(|(_, key)| *key).ok_or_else(|| {
            let words = WORDS.map(|(word, _)| format!("\"{word}\"")).join(", ");
            format!("compute.near_field: \"{text}\" is unknown (allowed: {words})")
        })
    }
}

impl From<NearFieldKey> for &'static str {
    fn from(key: NearFieldKey) -> Self {
        WORDS.iter().find(|(_, other)| *other == key).map_or("", |(word, _)| word)
    }
}

/// Default number of random points per sensor.
const POINTS: usize = 1024;
/// Default number of cells along each profile angle.
const CELLS: usize = 180;

/// Checks both keys together, and returns the method. `samples`: effort, the number of all point luminaires, of random
/// points per sensor, or of cells along each profile angle.
pub fn near_field(key: NearFieldKey, samples: Option<usize>) -> Result<NearField, StudyError> {
    let within = |least: usize, most: usize, what: &str| match samples {
        Some(samples) if !(least..=most).contains(&samples) => {
            Err(StudyError::key("compute.near_field_samples", format!("{samples} {what} (allowed: {least} to {most})")))
        }
        other => Ok(other),
    };
    Ok(match key {
        NearFieldKey::SolidAngle if samples.is_some() => {
            return Err(StudyError::key(
                "compute.near_field_samples",
                "the solid-angle method has no samples; remove the key, or set compute.near_field to another method",
            ));
        }
        NearFieldKey::SolidAngle => NearField::SolidAngle,
        NearFieldKey::Subdivision => NearField::Subdivision(within(1, 1 << 20, "point luminaires")?.map(|samples| {
            let side = (samples as f64).sqrt().round() as usize;
            [side, side]
        })),
        NearFieldKey::MonteCarlo => NearField::MonteCarlo(within(2, 1 << 22, "random points")?.unwrap_or(POINTS)),
        NearFieldKey::ProfileTable => NearField::ProfileTable(within(4, 1440, "cells")?.unwrap_or(CELLS)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_judged_together() {
        assert_eq!(near_field(NearFieldKey::Subdivision, Some(256)), Ok(NearField::Subdivision(Some([16, 16]))));
        assert_eq!(near_field(NearFieldKey::Subdivision, None), Ok(NearField::Subdivision(None)));
        for (key, samples) in [
            (NearFieldKey::SolidAngle, 5),
            (NearFieldKey::MonteCarlo, 1),
            (NearFieldKey::MonteCarlo, usize::MAX),
            (NearFieldKey::ProfileTable, 0),
            (NearFieldKey::Subdivision, 0),
        ] {
            let error = near_field(key, Some(samples)).unwrap_err().to_string();
            assert!(error.starts_with("compute.near_field_samples: "), "{error}");
        }
        let error = NearFieldKey::try_from(String::from("guess")).unwrap_err();
        assert!(error.contains("compute.near_field") && error.contains("\"monte-carlo\""), "{error}");
    }
}
