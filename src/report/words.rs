//! Translated labels in reports for values that files state as English keys.

use crate::catalogue::Origin;
use crate::compute::btdf::{Severity, ThermalKey};
use crate::compute::lid::BeamSource;
use crate::texts::{Text, words as texts};

/// Returns the label of an origin of data (measured, computed, unknown).
pub const fn origin_words(origin: Origin) -> Text {
    match origin {
        Origin::Measured => texts::MEASURED,
        Origin::Computed => texts::COMPUTED,
        Origin::Unknown => texts::UNKNOWN,
    }
}

/// Returns the label of a finding's severity.
pub const fn severity_words(severity: Severity) -> Text {
    match severity {
        Severity::Info => texts::INFO,
        Severity::Warning => texts::WARNING,
        Severity::Error => texts::ERROR,
    }
}

/// Returns the label of a thermal quantity or dimension of a product.
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

/// Returns the label of the source from which sharp beams are taken (description, extraction, …).
pub const fn beam_words(source: BeamSource) -> Text {
    match source {
        BeamSource::None => texts::BEAM_NONE,
        BeamSource::Described => texts::BEAM_DESCRIBED,
        BeamSource::Extracted => texts::BEAM_EXTRACTED,
        BeamSource::Cells => texts::BEAM_CELLS,
    }
}

/// Returns the label of a stage of a computation, from its stable key; unknown keys unchanged.
pub fn stage_words(name: &str) -> String {
    const STAGES: [(&str, Text); 16] = [
        ("sun", texts::STAGE_SUN),
        ("ground", texts::STAGE_GROUND),
        ("cells", texts::STAGE_CELLS),
        ("description", texts::STAGE_DESCRIPTION),
        ("seen through", texts::STAGE_SEEN_THROUGH),
        ("sky at sensors", texts::STAGE_SKY_AT_SENSORS),
        ("other states", texts::STAGE_OTHER_STATES),
        ("near field", texts::STAGE_NEAR_FIELD),
        ("interreflection", texts::STAGE_INTERREFLECTION),
        ("back reflection", texts::STAGE_BACK_REFLECTION),
        ("emission", texts::STAGE_EMISSION),
        ("interpolation", texts::STAGE_INTERPOLATION),
        ("direct", texts::STAGE_DIRECT),
        ("receptions", texts::STAGE_RECEPTIONS),
        ("room factors", texts::STAGE_ROOM_FACTORS),
        ("unseen cells", texts::STAGE_UNSEEN_CELLS),
    ];
    STAGES.into_iter().find(|(key, _)| *key == name).map_or_else(|| name.to_owned(), |(_, text)| text.into())
}
