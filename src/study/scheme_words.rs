//! Serialisation of the interpolation schemes in scene files by their keys: `compute` defines the schemes, serde is
//! used here only.

use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
use serde::{Deserialize, Deserializer, Serializer, de::Error};

/// Returns the message about an unknown scheme. `key`: name of the key; `word`: given value; `allowed`: allowed values.
fn unknown<'a>(key: &str, word: &str, allowed: impl Iterator<Item = &'a str>) -> String {
    let list: Vec<String> = allowed.map(|word| format!("\"{word}\"")).collect();
    format!("compute.{key}: \"{word}\" is not known (allowed: {})", list.join(", "))
}

/// Serialisation of `compute.sun_interpolation`.
pub mod sun {
    use super::*;

    /// Writes the key of a scheme; the default is written as the program's choice.
    pub fn serialize<S: Serializer>(scheme: &SunScheme, serializer: S) -> Result<S::Ok, S::Error> {
        let auto = *scheme == SunScheme::default();
        serializer.serialize_str(if auto { SunScheme::AUTO } else { scheme.key() })
    }

    /// Reads a scheme from its key; an error lists the allowed keys.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<SunScheme, D::Error> {
        let word = String::deserialize(deserializer)?;
        let allowed = [SunScheme::AUTO].into_iter().chain(SunScheme::ALL.map(SunScheme::key));
        SunScheme::from_key(&word).ok_or_else(|| D::Error::custom(unknown("sun_interpolation", &word, allowed)))
    }
}

/// Serialisation of `compute.diffuse_interpolation`.
pub mod diffuse {
    use super::*;

    /// Writes the key of a scheme.
    pub fn serialize<S: Serializer>(scheme: &DiffuseScheme, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(scheme.key())
    }

    /// Reads a scheme from its key; an error lists the allowed keys.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<DiffuseScheme, D::Error> {
        let word = String::deserialize(deserializer)?;
        let allowed = DiffuseScheme::ALL.into_iter().map(DiffuseScheme::key);
        DiffuseScheme::from_key(&word).ok_or_else(|| D::Error::custom(unknown("diffuse_interpolation", &word, allowed)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::scene_file::ComputeKeys;

    #[test]
    fn words_are_read_and_written_back() {
        let keys: ComputeKeys =
            toml::from_str("sun_interpolation = \"superposed\"\ndiffuse_interpolation = \"filter-wide\"").unwrap();
        assert_eq!(keys.sun_interpolation, SunScheme::Superposed);
        assert_eq!(keys.diffuse_interpolation, DiffuseScheme::FilterWide);
        let text = toml::to_string(&keys).unwrap();
        assert_eq!(toml::from_str::<ComputeKeys>(&text).unwrap(), keys);
        let default: ComputeKeys = toml::from_str("").unwrap();
        assert_eq!(default, toml::from_str("sun_interpolation = \"auto\"").unwrap());
        assert_eq!(default.sun_interpolation, SunScheme::Responses);
        assert_eq!(default.diffuse_interpolation, DiffuseScheme::Auto);
    }

    #[test]
    fn an_unknown_word_is_answered_with_the_key_and_all_words() {
        // Two words of earlier versions are gone: taking them for another would change results in silence.
        for word in ["closest", "transport", "matched-lobes"] {
            let text = format!("sun_interpolation = \"{word}\"");
            let error = toml::from_str::<ComputeKeys>(&text).unwrap_err().to_string();
            assert!(error.contains("compute.sun_interpolation") && error.contains(&format!("{word:?}")), "{error}");
            SunScheme::ALL.iter().for_each(|s| assert!(error.contains(s.key()), "{error}"));
            assert!(error.contains("\"auto\""), "{error}");
        }
        let error = toml::from_str::<ComputeKeys>("diffuse_interpolation = \"\"").unwrap_err().to_string();
        assert!(error.contains("compute.diffuse_interpolation"), "{error}");
        DiffuseScheme::ALL.iter().for_each(|s| assert!(error.contains(s.key()), "{error}"));
    }
}
