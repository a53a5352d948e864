//! Venetian blinds and louvres as described: slats that rotate, one state per angle.

use super::array::{SlatArray, Surface};
use super::model::SlatModel;
use super::profile::SlatProfile;
use crate::compute::system::family::{Family, OpticalModelError, Polygons, state_key};
use crate::compute::system::measure::OpticalModel;

/// Venetian blind or louvres: equal horizontal slats, repeated upwards, which rotate about the middle of their chord.
#[derive(Debug, Clone, PartialEq)]
pub struct Venetian {
    /// Profile of a slat's section at tilt 0.
    pub profile: SlatProfile,
    /// Vertical pitch of the slats. \[m\]
    pub spacing: f64,
    /// Thickness of a slat; 0 for a thin sheet. \[m\]
    pub thickness: f64,
    /// Tilt of the slats in each state: positive with the outer edge lowered, π/2 closed. \[rad\]
    pub angles: Vec<f64>,
    /// Finish of the face of a slat that looks upwards at tilt 0.
    pub upper: Surface,
    /// Finish of the face of a slat that looks downwards at tilt 0.
    pub lower: Surface,
}

impl Venetian {
    /// Creates the array of slats of the state with key `state`; `None` if there is no such state.
    fn slats(&self, state: &str) -> Option<Result<SlatArray, super::SlatError>> {
        let angle = *self.angles.iter().find(|angle| state_key(**angle) == state)?;
        Some(SlatArray::new(self.profile.clone(), self.thickness, self.spacing, angle, [self.upper, self.lower]))
    }
}

impl Family for Venetian {
    fn word(&self) -> &'static str {
        "venetian"
    }

    fn method(&self) -> &'static str {
        "section of endless slats, direct share in closed form, strip radiosity, mirror chains as bundles of lines"
    }

    fn inside_face(&self) -> &'static str {
        "room side of the description: outer edges lowered at positive angles"
    }

    fn states(&self) -> Vec<String> {
        self.angles.iter().map(|&angle| state_key(angle)).collect()
    }

    fn structure(&self) -> Option<f64> {
        Some(self.spacing)
    }

    fn drawing(&self, state: &str) -> Polygons {
        let Some(Ok(array)) = self.slats(state) else { return vec![] };
        let mut outlines = array.outline();
        if self.thickness == 0.0 {
            for line in &mut outlines {
                let back: Vec<_> = line.iter().rev().skip(1).copied().collect();
                line.extend(back.iter().take(back.len().saturating_sub(1)));
            }
        }
        outlines
    }

    fn optical_model(&self, state: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        let slats = self.slats(state).ok_or_else(|| OpticalModelError(format!("no state \"{state}\"")))?;
        Ok(Box::new(SlatModel::new(slats.map_err(OpticalModelError::because)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(polygon: &[[f64; 2]]) -> f64 {
        let next = polygon.iter().cycle().skip(1);
        0.5 * polygon.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs()
    }

    fn blind(thickness: f64, degrees: f64) -> Venetian {
        Venetian {
            profile: SlatProfile::Flat { width: 0.08 },
            spacing: 0.072,
            thickness,
            angles: vec![degrees.to_radians()],
            upper: Surface::matt(0.5),
            lower: Surface::matt(0.5),
        }
    }

    #[test]
    fn a_slat_turns_its_outer_edge_down() {
        let drawing = blind(0.0, 30.0).drawing("30");
        let outermost = drawing[0].iter().copied().fold([f64::NEG_INFINITY; 2], |a, b| if b[0] > a[0] { b } else { a });
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        assert!((outermost[0] - 0.04 * cos).abs() < 1e-12 && (outermost[1] + 0.04 * sin).abs() < 1e-12);
        assert!(area(&drawing[0]) < 1e-15, "a sheet encloses nothing");
        let solid = blind(0.002, 30.0).drawing("30");
        assert!((area(&solid[0]) - 0.08 * 0.002).abs() < 1e-12);
        assert!(blind(0.0, 30.0).drawing("45").is_empty());
    }
}
