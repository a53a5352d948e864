//! Thermal data of a product and size of its sample, for other programs.
//!
//! Computations of light do not use these data. They are stored so that a file that is read and written again still
//! contains them.

/// Key of a thermal property, or of a dimension of the sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ThermalKey {
    /// Thermal conductivity across the product. \[W/(m K)\]
    Conductivity,
    /// Air permeability of the product, in the unit of the source file.
    AirPermeability,
    /// Hemispherical emissivity of the outside at long wavelengths, 0 … 1.
    EmissivityFront,
    /// Hemispherical emissivity of the room side at long wavelengths, 0 … 1.
    EmissivityBack,
    /// Transmittance at long wavelengths, 0 … 1.
    InfraredTransmittance,
    /// Effective openness: share of the area that is open to the flow of air, 0 … 1.
    EffectiveOpenness,
    /// Measured share of the area that is open, 0 … 1; WINDOW's permeability factor.
    Permeability,
    /// Width of the sample. \[m\]
    Width,
    /// Height of the sample. \[m\]
    Height,
}

impl ThermalKey {
    /// Keys of all properties, in the order of files and listings.
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

    /// Returns the English name of the property in sentences.
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

    /// Returns the key of the property in JSON, with its unit if it has one.
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

    /// Returns the maximum valid value of the property: 1 for shares.
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

/// Thermal data of a product and size of its sample, as far as the source specifies them. The thickness is in
/// [`Dataset::thickness`](super::Dataset::thickness).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Thermal {
    /// Device type in the terms of LBNL's schema, e.g. `Woven shade`; empty if not specified.
    pub device: String,
    values: [Option<f64>; ThermalKey::ALL.len()],
}

impl Thermal {
    /// Returns the value of a property; `None` if not specified.
    pub const fn get(&self, key: ThermalKey) -> Option<f64> {
        self.values[key as usize]
    }

    /// Sets the value of a property. Returns `false` without storing it if it is negative, not finite or above
    /// [`ThermalKey::most`].
    pub fn set(&mut self, key: ThermalKey, value: f64) -> bool {
        let sound = value.is_finite() && value >= 0.0 && value <= key.most();
        if sound {
            self.values[key as usize] = Some(value);
        }
        sound
    }

    /// Whether neither a device type nor any value is specified.
    pub fn is_empty(&self) -> bool {
        self.device.is_empty() && self.values.iter().all(Option::is_none)
    }

    /// Returns the specified properties with their values, in the order of [`ThermalKey::ALL`].
    pub fn known(&self) -> impl Iterator<Item = (ThermalKey, f64)> {
        ThermalKey::ALL.into_iter().filter_map(|key| Some((key, self.get(key)?)))
    }

    /// Returns the data of the product mounted the other way round: front and back emissivity exchanged.
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
