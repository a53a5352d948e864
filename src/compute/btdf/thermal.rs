//! Data of makers' files on a product besides its light: for heat balances and frames of other programs.
//!
//! Nothing here takes part in a computation of light. It is kept so that a file that is read and written again still
//! says what was measured.

/// Key of a thermal value or extent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ThermalKey {
    /// Thermal conductivity across the product. \[W/(m K)\]
    Conductivity,
    /// Volume of air that passes, in the unit of the source file.
    AirPermeability,
    /// Hemispherical emissivity towards outside at long wavelengths.
    EmissivityFront,
    /// Hemispherical emissivity towards the room at long wavelengths.
    EmissivityBack,
    /// Transmittance at long wavelengths.
    InfraredTransmittance,
    /// Share of the area that is open to air, as effective for the flow through it.
    EffectiveOpenness,
    /// Share of the area that is open, as measured; WINDOW's permeability factor.
    Permeability,
    /// Extent of the specimen to the side. \[m\]
    Width,
    /// Extent of the specimen upwards. \[m\]
    Height,
}

impl ThermalKey {
    /// All keys, in the order of files and listings.
    pub const ALL: [Self; 9] = [
        Self::Conductivity,
        Self::AirPermeability,
        Self::EmissivityFront,
        Self::EmissivityBack,
        Self::InfraredTransmittance,
        Self::EffectiveOpenness,
        Self::Permeability,
        Self::Width,
        Self::Height,
    ];

    /// Returns the name in sentences.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Conductivity => "conductivity",
            Self::AirPermeability => "air permeability",
            Self::EmissivityFront => "front emissivity",
            Self::EmissivityBack => "back emissivity",
            Self::InfraredTransmittance => "infrared transmittance",
            Self::EffectiveOpenness => "effective openness",
            Self::Permeability => "permeability factor",
            Self::Width => "width",
            Self::Height => "height",
        }
    }

    /// Returns the key in JSON, with the unit where there is one.
    pub const fn json(self) -> &'static str {
        match self {
            Self::Conductivity => "conductivity_w_mk",
            Self::AirPermeability => "air_permeability",
            Self::EmissivityFront => "emissivity_front",
            Self::EmissivityBack => "emissivity_back",
            Self::InfraredTransmittance => "infrared_transmittance",
            Self::EffectiveOpenness => "effective_openness",
            Self::Permeability => "permeability_factor",
            Self::Width => "width_m",
            Self::Height => "height_m",
        }
    }

    /// Returns the largest valid value: 1 for shares.
    pub const fn most(self) -> f64 {
        match self {
            Self::EmissivityFront
            | Self::EmissivityBack
            | Self::InfraredTransmittance
            | Self::EffectiveOpenness
            | Self::Permeability => 1.0,
            Self::Conductivity | Self::AirPermeability | Self::Width | Self::Height => f64::MAX,
        }
    }
}

/// Thermal data and extents, as far as a source gives them. The thickness stands in
/// [`Dataset::thickness`](super::Dataset::thickness), since light needs it too.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Thermal {
    /// Kind of device in the words of LBNL's schema, e.g. `Woven shade`; empty where none is given.
    pub device: String,
    values: [Option<f64>; ThermalKey::ALL.len()],
}

impl Thermal {
    /// Returns one of the values.
    pub const fn get(&self, key: ThermalKey) -> Option<f64> {
        self.values[key as usize]
    }

    /// Sets one of the values; what is negative, not finite or above [`ThermalKey::most`] is not stored and gives
    /// `false`.
    pub fn set(&mut self, key: ThermalKey, value: f64) -> bool {
        let sound = value.is_finite() && value >= 0.0 && value <= key.most();
        if sound {
            self.values[key as usize] = Some(value);
        }
        sound
    }

    /// Whether no value is known.
    pub fn is_empty(&self) -> bool {
        self.device.is_empty() && self.values.iter().all(Option::is_none)
    }

    /// Returns the known values, in the order of [`ThermalKey::ALL`].
    pub fn known(&self) -> impl Iterator<Item = (ThermalKey, f64)> {
        ThermalKey::ALL.into_iter().filter_map(|key| Some((key, self.get(key)?)))
    }

    /// Returns the data of the product seen from the other side.
    #[must_use]
    pub fn swapped(mut self) -> Self {
        self.values.swap(ThermalKey::EmissivityFront as usize, ThermalKey::EmissivityBack as usize);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_above_one_and_negative_numbers_are_not_taken() {
        let mut thermal = Thermal::default();
        assert!(thermal.is_empty());
        assert!(!thermal.set(ThermalKey::EmissivityFront, 1.2) && !thermal.set(ThermalKey::Width, -1.0));
        assert!(!thermal.set(ThermalKey::Conductivity, f64::NAN) && thermal.is_empty());
        assert!(thermal.set(ThermalKey::EmissivityFront, 0.9) && thermal.set(ThermalKey::Width, 3.0));
        assert_eq!(thermal.known().collect::<Vec<_>>(), [(ThermalKey::EmissivityFront, 0.9), (ThermalKey::Width, 3.0)]);
        assert_eq!(thermal.swapped().get(ThermalKey::EmissivityBack), Some(0.9));
    }
}
