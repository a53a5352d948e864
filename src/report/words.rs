//! Labels in reports for keys of data and computations that files write in English.

use crate::catalogue::Origin;
use crate::compute::btdf::{Severity, ThermalKey};
use crate::compute::lid::BeamSource;
use crate::texts::{Text, words as texts};

/// Returns the label of an origin of data.
pub const fn origin_words(origin: Origin) -> Text {
    match origin {
        Origin::Measured => texts::MEASURED,
        Origin::Computed => texts::COMPUTED,
        Origin::Unknown => texts::UNKNOWN,
    }
}

/// Returns the label of a severity.
pub const fn severity_words(severity: Severity) -> Text {
    match severity {
        Severity::Info => texts::INFO,
        Severity::Warning => texts::WARNING,
        Severity::Error => texts::ERROR,
    }
}

/// Returns the label of a thermal figure or an extent.
pub const fn thermal_words(key: ThermalKey) -> Text {
    match key {
        ThermalKey::Conductivity => texts::CONDUCTIVITY,
        ThermalKey::AirPermeability => texts::AIR_PERMEABILITY,
        ThermalKey::EmissivityFront => texts::EMISSIVITY_FRONT,
        ThermalKey::EmissivityBack => texts::EMISSIVITY_BACK,
        ThermalKey::InfraredTransmittance => texts::INFRARED_TRANSMITTANCE,
        ThermalKey::EffectiveOpenness => texts::EFFECTIVE_OPENNESS,
        ThermalKey::Permeability => texts::PERMEABILITY,
        ThermalKey::Width => texts::WIDTH,
        ThermalKey::Height => texts::HEIGHT,
    }
}

/// Returns the label of the source of sharp beams.
pub const fn beam_words(source: BeamSource) -> Text {
    match source {
        BeamSource::None => texts::BEAM_NONE,
        BeamSource::Described => texts::BEAM_DESCRIBED,
        BeamSource::Extracted => texts::BEAM_EXTRACTED,
        BeamSource::Cells => texts::BEAM_CELLS,
    }
}

/// Returns the label of a stage of a computation, from its stable name; other names unchanged.
pub fn stage_words(name: &str) -> String {
    const STAGES: [Text; 16] = [
        texts::STAGE_SUN,
        texts::STAGE_GROUND,
        texts::STAGE_CELLS,
        texts::STAGE_DESCRIPTION,
        texts::STAGE_SEEN_THROUGH,
        texts::STAGE_SKY_AT_SENSORS,
        texts::STAGE_OTHER_STATES,
        texts::STAGE_NEAR_FIELD,
        texts::STAGE_INTERREFLECTION,
        texts::STAGE_BACK_REFLECTION,
        texts::STAGE_EMISSION,
        texts::STAGE_INTERPOLATION,
        texts::STAGE_DIRECT,
        texts::STAGE_RECEPTIONS,
        texts::STAGE_ROOM_FACTORS,
        texts::STAGE_UNSEEN_CELLS,
    ];
    STAGES.into_iter().find(|text| text.english() == name).map_or_else(|| name.to_owned(), String::from)
}
