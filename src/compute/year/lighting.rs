//! Energy for electric lighting that supplements daylight, by steps of a year. The result has the unit of EN 15193-1's
//! LENI, kWh/(m² a), and is not that standard's tabulated method.

use super::hours::{Light, Step};

/// Daylight-linked control of the electric lighting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Control {
    /// No control: full power while the room is occupied.
    None,
    /// Switching control (on–off): full power while daylight alone does not reach the target illuminance.
    OnOff,
    /// Switching in the given number of equal steps of power.
    Stepped(u32),
    /// Dimming to the illuminance that daylight lacks.
    Dimming {
        /// Minimum luminous flux, as a share of the full flux; below 1.
        min_light: f64,
        /// Power at the minimum flux, as a share of the installed power.
        min_power: f64,
        /// Whether the lighting is switched off when daylight alone reaches the target illuminance.
        off: bool,
    },
}

impl Control {
    /// Returns the share of the installed power, 0 … 1, when daylight lacks the share `open` (0 … 1) of the target
    /// illuminance. 0 is off.
    pub fn power(self, open: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::OnOff => f64::from(u8::from(open > 0.0)),
            // A hair above a step is a step.
            Self::Stepped(steps) => (open * f64::from(steps) - 1e-12).ceil().max(0.0) / f64::from(steps),
            Self::Dimming { off: true, .. } if open <= 0.0 => 0.0,
            Self::Dimming { min_light, min_power, .. } => {
                min_power + (1.0 - min_power) * (open.max(min_light) - min_light) / (1.0 - min_light)
            }
        }
    }
}

/// Zone of a room whose electric lighting is controlled by the mean daylight illuminance of some calculation points.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Indices of the calculation points.
    pub places: Vec<usize>,
    /// Share of the room's installed power in this zone, 0 … 1.
    pub share: f64,
}

/// Electric lighting of a room: installed power, target illuminance, control and zones.
#[derive(Debug, Clone, PartialEq)]
pub struct Lamps {
    /// Installed power per floor area. \[W/m²\]
    pub power: f64,
    /// Target illuminance of daylight and electric light together. \[lx\]
    pub target: f64,
    /// Control of the lighting by daylight.
    pub control: Control,
    /// Standby power per floor area while the lighting is switched off, nights included. \[W/m²\]
    pub standby: f64,
    /// Zones of the room, each with a sensor; at least one.
    pub zones: Vec<Zone>,
}

/// Energy of the electric lighting of a year, per floor area. \[kWh/m²\]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Energy {
    /// Energy per floor area of each month. \[kWh/m²\]
    pub months: [f64; 12],
    /// Energy per floor area without control: full power in all occupied steps. \[kWh/m²\]
    pub full: f64,
}

impl Energy {
    /// Returns the energy per floor area of all months together. \[kWh/m²\]
    pub fn total(&self) -> f64 {
        self.months.iter().sum()
    }
}

impl Lamps {
    /// Computes the power per floor area in one step; `light`: daylight illuminance of every calculation point \[lx\].
    /// \[W/m²\]
    pub fn watts<T: Copy + Into<f64>>(&self, occupied: bool, light: &[T]) -> f64 {
        let zone = |zone: &Zone| {
            let reading =
                zone.places.iter().map(|&place| light[place].into()).sum::<f64>() / zone.places.len().max(1) as f64;
            let open = (1.0 - reading / self.target).max(0.0);
            let part = if occupied { self.control.power(open) } else { 0.0 };
            zone.share * (part * self.power + if part == 0.0 { self.standby } else { 0.0 })
        };
        self.zones.iter().map(zone).sum()
    }

    /// Computes the energy from the daylight illuminances `light` \[lx\] of all `steps`, each `length` hours long.
    pub fn energy(&self, steps: &[Step], light: Light<'_>, length: f64) -> Energy {
        let mut energy = Energy::default();
        for (k, step) in steps.iter().enumerate() {
            let month = usize::from(step.month.clamp(1, 12)) - 1;
            energy.months[month] += self.watts(step.occupied, light.row(k)) * length / 1000.0;
            energy.full += f64::from(u8::from(step.occupied)) * self.power * length / 1000.0;
        }
        energy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::year::StepTable;

    #[test]
    fn lamps_follow_what_daylight_leaves_open() {
        let dimming = |off| Control::Dimming { min_light: 0.1, min_power: 0.2, off };
        assert_eq!((Control::OnOff.power(0.0), Control::OnOff.power(0.01)), (0.0, 1.0));
        assert_eq!(
            [0.0, 0.01, 1.0 / 3.0, 0.34, 1.0].map(|o| Control::Stepped(3).power(o)),
            [0.0, 1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]
        );
        assert_eq!((dimming(true).power(0.0), dimming(false).power(0.0), dimming(true).power(0.05)), (0.0, 0.2, 0.2));
        assert!((dimming(true).power(0.55) - 0.6).abs() < 1e-15 && (dimming(true).power(1.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn nights_cost_what_stands_by() {
        let lamps = Lamps {
            power: 10.0,
            target: 500.0,
            control: Control::OnOff,
            standby: 0.5,
            zones: vec![Zone { places: vec![0], share: 0.6 }, Zone { places: vec![1], share: 0.4 }],
        };
        let step = |month, occupied| Step { month, occupied, diffuse_horizontal: 0.0 };
        let light = [600.0, 100.0, 0.0, 0.0];
        let energy = lamps.energy(
            &[step(1, true), step(12, false)],
            StepTable::of_rows(2, &light).unwrap().columns(0..2).unwrap(),
            0.5,
        );
        assert!((energy.months[0] - 0.5e-3 * (0.6 * 0.5 + 0.4 * 10.0)).abs() < 1e-15);
        assert!((energy.months[11] - 0.5e-3 * 0.5).abs() < 1e-15);
        assert_eq!((energy.full, energy.total()), (5e-3, energy.months[0] + energy.months[11]));
    }
}
