//! Key `aperture.system` in a scene file: an ideal system, a dataset file, a family of files, a product, luminaire
//! files, or the word "ranked".

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error as _, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::path::PathBuf;

/// Value of `aperture.system` for an aperture into which a ranking inserts every product in turn.
pub const RANKED: &str = "ranked";

/// Key `aperture.system`: system that fills an aperture.
#[derive(Debug, Clone, PartialEq)]
pub enum SystemKeys {
    /// Ideal system: `{ ideal = "transparent", transmittance = 1.0 }`
    Ideal {
        /// Kind of the ideal system: transparent or diffuse.
        kind: IdealKind,
        /// Visible transmittance, 0 … 1.
        transmittance: f64,
    },
    /// Dataset file: `{ file = "system.xml" }`
    File {
        /// Path of the dataset file, relative to the scene file.
        path: PathBuf,
        /// Key of the state, if the file has several.
        state: Option<String>,
    },
    /// Product of the catalogue: `{ catalogue = "product-key", state = "45" }`
    Catalogue {
        /// Key of the product in the catalogue.
        key: String,
        /// Key of the state, or "controlled" if a control chooses it.
        state: Option<String>,
    },
    /// Family of dataset files, one per state: `{ states = [{ state = "0", value = 0.0, file = "a.xml" }, …], state =
    /// "controlled" }`
    Family {
        /// States of the family, at least one.
        states: Vec<FamilyState>,
        /// Key of the state, or "controlled" if a control chooses it.
        state: Option<String>,
    },
    /// Luminaire files that this program has exported, in place of a system: `{ luminaires = "x.index.csv" }`
    Luminaires {
        /// Path of the index of the luminaire files, relative to the scene file.
        index: PathBuf,
        /// Name of the member to be used, if the index lists a series.
        set: Option<String>,
    },
    /// All products of a ranking in turn: `"ranked"`
    Ranked,
}

impl Serialize for SystemKeys {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match SystemAsTyped::of(self) {
            Some(typed) => typed.serialize(serializer),
            None => serializer.serialize_str(RANKED),
        }
    }
}

impl<'de> Deserialize<'de> for SystemKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> serde::de::Visitor<'de> for Visitor {
            type Value = SystemKeys;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a table, e.g. { file = \"system.xml\" }, or the word \"ranked\"")
            }
            fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<SystemKeys, E> {
                if word == RANKED {
                    Ok(SystemKeys::Ranked)
                } else {
                    Err(E::invalid_value(Unexpected::Str(word), &self))
                }
            }
            fn visit_map<A: serde::de::MapAccess<'de>>(self, map: A) -> Result<SystemKeys, A::Error> {
                let typed = SystemAsTyped::deserialize(MapAccessDeserializer::new(map))?;
                SystemKeys::try_from(typed).map_err(A::Error::custom)
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// Entry of `aperture.system.states`: state of a family of dataset files.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FamilyState {
    /// Key of the state.
    pub state: String,
    /// Number of the state: slat angle \[°\], or any number by which a control distinguishes states.
    pub value: f64,
    /// Path of the dataset file of the state, relative to the scene file.
    pub file: PathBuf,
}

/// All keys that `aperture.system` may have; which of them may be given together is checked afterwards, so that a
/// message can say so.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct SystemAsTyped {
    #[serde(skip_serializing_if = "Option::is_none")]
    ideal: Option<IdealKind>,
    #[serde(skip_serializing_if = "Option::is_none")]
    transmittance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    catalogue: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    state: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    states: Option<Vec<FamilyState>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    luminaires: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    set: Option<String>,
}

impl TryFrom<SystemAsTyped> for SystemKeys {
    type Error = String;

    /// Checks which keys are given together, and returns the system; an error message says what belongs together.
    fn try_from(typed: SystemAsTyped) -> Result<Self, String> {
        if let SystemAsTyped { luminaires: Some(index), set, .. } = &typed {
            let keys = Self::Luminaires { index: index.clone(), set: set.clone() };
            if SystemAsTyped::of(&keys).as_ref() == Some(&typed) {
                return Ok(keys);
            }
        }
        if let SystemAsTyped { states: Some(states), state, .. } = &typed {
            let keys = Self::Family { states: states.clone(), state: state.clone() };
            if SystemAsTyped::of(&keys).as_ref() == Some(&typed) {
                return family(states).map(|()| keys);
            }
        }
        match typed {
            SystemAsTyped {
                ideal: Some(kind),
                transmittance: Some(transmittance),
                file: None,
                catalogue: None,
                state: None,
                states: None,
                luminaires: None,
                set: None,
            } => Ok(Self::Ideal { kind, transmittance }),
            SystemAsTyped {
                ideal: None,
                transmittance: None,
                file: Some(path),
                catalogue: None,
                state,
                states: None,
                luminaires: None,
                set: None,
            } => Ok(Self::File { path, state }),
            SystemAsTyped {
                ideal: None,
                transmittance: None,
                file: None,
                catalogue: Some(key),
                state,
                states: None,
                luminaires: None,
                set: None,
            } => Ok(Self::Catalogue { key, state }),
            _ => Err(
                "system needs exactly one of: ideal and transmittance; file; catalogue; states; luminaires (state goes with \
                      file, catalogue and states, set with luminaires)"
                    .into(),
            ),
        }
    }
}

/// Checks that a family has at least one state, and that every state has a unique key and a finite number.
fn family(states: &[FamilyState]) -> Result<(), String> {
    if states.is_empty() {
        return Err("states: none; expected at least one".into());
    }
    for (place, one) in states.iter().enumerate() {
        if states[..place].iter().any(|other| other.state == one.state) {
            return Err(format!("states: two are called '{}'; expected a key for each", one.state));
        }
        if !one.value.is_finite() {
            return Err(format!("states: the value of '{}' is not a number", one.state));
        }
    }
    Ok(())
}

impl SystemAsTyped {
    /// Returns the keys of a system that is written as a table; `None` for others.
    fn of(keys: &SystemKeys) -> Option<Self> {
        Some(match keys.clone() {
            SystemKeys::Ideal { kind, transmittance } => {
                Self { ideal: Some(kind), transmittance: Some(transmittance), ..Self::default() }
            }
            SystemKeys::File { path, state } => Self { file: Some(path), state, ..Self::default() },
            SystemKeys::Catalogue { key, state } => Self { catalogue: Some(key), state, ..Self::default() },
            SystemKeys::Family { states, state } => Self { states: Some(states), state, ..Self::default() },
            SystemKeys::Luminaires { index, set } => Self { luminaires: Some(index), set, ..Self::default() },
            SystemKeys::Ranked => return None,
        })
    }
}

/// Key `aperture.system.ideal`: kind of an ideal system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum IdealKind {
    /// Ideal clear system: regular transmission alone.
    Transparent,
    /// Ideal diffuser: Lambertian emission, τ independent of the incident direction.
    Diffuse,
}
