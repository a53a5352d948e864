//! Keys for reading a weather file, in `[sky]` and `[year]`.

use crate::compute::weather::{LightSource, Reading, SunOffset, WIDEST_OFFSET};
use serde::{Deserialize, Serialize};

/// Values of `light`: source of the illuminances.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LightKey {
    /// Irradiances times luminous efficacies (Perez 1990).
    #[default]
    Efficacy,
    /// Illuminances of the file where they exist and are plausible.
    File,
}

impl LightKey {
    /// Whether the key has its default value, which is not written.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Values of `sun_offset_minutes`: offset by which the file's intervals lie later than it says, or "auto".
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OffsetKey {
    /// Given offset. \[min\]
    Minutes(f64),
    /// Offset at which the file's irradiances close best.
    Auto,
}

impl Default for OffsetKey {
    fn default() -> Self {
        Self::Minutes(0.0)
    }
}

impl OffsetKey {
    /// Whether the key has its default value, which is not written.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

impl Serialize for OffsetKey {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Auto => serializer.serialize_str("auto"),
            Self::Minutes(minutes) => serializer.serialize_f64(*minutes),
        }
    }
}

impl<'de> Deserialize<'de> for OffsetKey {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl serde::de::Visitor<'_> for Visitor {
            type Value = OffsetKey;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, "minutes from −{WIDEST_OFFSET} to {WIDEST_OFFSET} or the word \"auto\"")
            }
            fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<OffsetKey, E> {
                if value.abs() <= WIDEST_OFFSET {
                    Ok(OffsetKey::Minutes(value))
                } else {
                    Err(E::invalid_value(serde::de::Unexpected::Float(value), &self))
                }
            }
            fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<OffsetKey, E> {
                self.visit_f64(value as f64)
            }
            fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<OffsetKey, E> {
                self.visit_f64(value as f64)
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<OffsetKey, E> {
                if text == "auto" {
                    Ok(OffsetKey::Auto)
                } else {
                    Err(E::invalid_value(serde::de::Unexpected::Str(text), &self))
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// Returns how a weather file is read with both keys.
pub fn reading(light: LightKey, offset: OffsetKey) -> Reading {
    Reading {
        light: match light {
            LightKey::Efficacy => LightSource::Efficacy,
            LightKey::File => LightSource::File,
        },
        offset: match offset {
            OffsetKey::Minutes(minutes) => SunOffset::Minutes(minutes),
            OffsetKey::Auto => SunOffset::Auto,
        },
    }
}
