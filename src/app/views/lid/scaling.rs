//! How intensities of an aperture's light are told.

use crate::compute::direction::{Emergent, Surface};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::Aim;
use crate::drawing::ticks::si;
use crate::texts::tiles as say;

/// In what intensities are told: the whole aperture's, or those of a square metre of it.
#[derive(Debug, Clone, Copy)]
pub struct Scaling {
    /// Times candela.
    pub factor: f64,
    /// Of a square metre.
    pub per_area: bool,
}

impl Scaling {
    /// Of an aperture's light.
    pub fn of(lid: &Lid, per_area: bool) -> Self {
        Self { factor: if per_area { 1.0 / lid.area() } else { 1.0 }, per_area }
    }

    /// Their unit.
    pub fn unit(self) -> &'static str {
        if self.per_area { say::CANDELA_PER_AREA.get() } else { "cd" }
    }

    /// The same in few letters.
    pub fn short_unit(self) -> &'static str {
        if self.per_area { say::CANDELA_PER_AREA_SHORT.get() } else { "cd" }
    }

    /// "11.5 Mcd", "2.1 kcd per m²".
    pub fn text(self, intensity: f64) -> String {
        let value = si(intensity * self.factor, "cd");
        if self.per_area { say::per_square_metre(value) } else { value }
    }
}

/// "C 12°, γ 80°": where a direction lies for the aperture's luminaire file.
pub(super) fn towards(surface: Surface, d: Emergent) -> String {
    let (c, gamma) = Aim::of(surface).angles(d);
    format!("C {:.0}°, γ {:.0}°", c.to_degrees().round() % 360.0, gamma.to_degrees())
}
