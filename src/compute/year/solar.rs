//! Solar energy transmitted directly through apertures, by month and by hour of the day.
//!
//! Power through an aperture is Σᵢ τₛ(i) Eᵢ + τₛ(sun) E_sun, with the directional-hemispherical solar transmittance τₛ,
//! and irradiances by cell of the aperture's outer hemisphere. It is *directly transmitted*: secondary heat, absorbed
//! by glass and slats and emitted to the room, is left out, so that this is not a solar factor (EN 410, ISO 9050, EN
//! ISO 52022-3 add that secondary part).

/// Month and hour of the day of a time step, by which energy is summed up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct When {
    /// Month, 1 … 12.
    pub month: u8,
    /// Hour of the day in local standard time that holds the step's middle, 0 … 23.
    pub hour: u8,
}

/// Solar energy transmitted directly through apertures, without secondary heat, by month and by hour of the day.
/// \[kWh\]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Transmitted {
    /// Energy of each month. \[kWh\]
    pub months: [f64; 12],
    /// Energy of each hour of the day, summed over all days. \[kWh\]
    pub hours: [f64; 24],
}

/// Months of the summer half-year, April to September, counted from 0: from equinox to equinox in whole months.
const SUMMER: std::ops::Range<usize> = 3..9;

impl Transmitted {
    /// Sums up the energy of the transmitted power `watts` \[W\], one value per step; `length`: duration of a step
    /// \[h\].
    pub fn of(steps: &[When], watts: &[f64], length: f64) -> Self {
        let mut energy = Self::default();
        for (when, watts) in steps.iter().zip(watts) {
            let kilowatt_hours = watts * length / 1000.0;
            energy.months[usize::from(when.month.clamp(1, 12)) - 1] += kilowatt_hours;
            energy.hours[usize::from(when.hour.min(23))] += kilowatt_hours;
        }
        energy
    }

    /// Returns the transmitted energy of all steps. \[kWh\]
    pub fn total(&self) -> f64 {
        self.months.iter().sum()
    }

    /// Returns the transmitted energy from April to September. \[kWh\]
    pub fn summer(&self) -> f64 {
        self.months[SUMMER].iter().sum()
    }

    /// Returns the transmitted energy from October to March. \[kWh\]
    pub fn winter(&self) -> f64 {
        self.total() - self.summer()
    }

    /// Returns the energy multiplied by `factor`, e.g. by 1 / area \[1/m²\] for the energy per area. \[kWh/m²\]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.months.iter_mut().chain(&mut self.hours).for_each(|energy| *energy *= factor);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn months_hours_and_half_years_add_up() {
        let steps: Vec<When> = (1..=12).flat_map(|month| (0..24).map(move |hour| When { month, hour })).collect();
        let watts: Vec<f64> = (0..steps.len()).map(|k| (k % 37) as f64).collect();
        let energy = Transmitted::of(&steps, &watts, 0.5);
        let all = watts.iter().sum::<f64>() * 0.5 / 1000.0;
        assert!((energy.total() - all).abs() < 1e-12 * all);
        assert!((energy.hours.iter().sum::<f64>() - all).abs() < 1e-12 * all);
        assert!((energy.summer() + energy.winter() - all).abs() < 1e-12 * all);
        let summer: f64 =
            steps.iter().zip(&watts).filter(|(when, _)| (4..=9).contains(&when.month)).map(|(_, w)| w).sum();
        assert!((energy.summer() - summer * 0.5e-3).abs() < 1e-12 * all);
        assert!((energy.scaled(2.0).hours[7] - 2.0 * energy.hours[7]).abs() < 1e-15);
    }
}
