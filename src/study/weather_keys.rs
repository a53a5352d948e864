//! Keys in `[sky]` and `[year]` that say how a weather file is read.

use crate::compute::weather::{LightSource, Reading, SunOffset, WIDEST_OFFSET};
use serde::{Deserialize, Serialize};

/// Value of the key `light`: source of the illuminances in a weather file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LightKey {
    /// Illuminances from the irradiances by luminous efficacies (Perez 1990).
    #[default]
    Efficacy,
    /// Illuminances of the file, where they exist and are plausible.
    File,
}

impl LightKey {
    /// Whether the key has its default value, which is not written to the file.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Value of the key `sun_offset_minutes`: time by which the intervals of a weather file lie later than the file says,
/// or "auto".
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OffsetKey {
    /// Given offset. \[min\]
    Minutes(f64),
    /// Offset at which the irradiances of the file (direct, diffuse, global) agree best.
    Auto,
}

impl Default for OffsetKey {
    fn default() -> Self {
        Self::Minutes(0.0)
    }
}

impl OffsetKey {
    /// Whether the key has its default value, which is not written to the file.
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

/// Returns the settings for reading a weather file that both keys give.
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
