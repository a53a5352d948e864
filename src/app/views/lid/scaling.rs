//! Form in which intensities of an aperture are stated: of the whole aperture or per square metre.

use crate::compute::direction::{Emergent, Surface};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::Aim;
use crate::drawing::ticks::si;
use crate::texts::tiles as say;

/// Form in which intensities are stated: of the whole aperture or per square metre of it.
#[derive(Debug, Clone, Copy)]
pub struct Scaling {
    /// Factor on intensities in candela.
    pub factor: f64,
    /// Whether intensities are per square metre.
    pub per_area: bool,
}

impl Scaling {
    /// Creates the scaling for the distribution of an aperture.
    pub fn of(lid: &Lid, per_area: bool) -> Self {
        Self { factor: if per_area { 1.0 / lid.area() } else { 1.0 }, per_area }
    }

    /// Returns the unit of the intensities.
    pub fn unit(self) -> &'static str {
        if self.per_area { say::CANDELA_PER_AREA.get() } else { "cd" }
    }

    /// Returns the unit of the intensities in its short form.
    pub fn short_unit(self) -> &'static str {
        if self.per_area { say::CANDELA_PER_AREA_SHORT.get() } else { "cd" }
    }

    /// Returns an intensity \[cd\] as text: "11.5 Mcd", "2.1 kcd per m²".
    pub fn text(self, intensity: f64) -> String {
        let value = si(intensity * self.factor, "cd");
        if self.per_area { say::per_square_metre(value) } else { value }
    }
}

/// Returns a direction in the angles of the aperture's luminaire file, as text: "C 12°, γ 80°".
pub(super) fn towards(surface: Surface, d: Emergent) -> String {
    let (c, gamma) = Aim::of(surface).angles(d);
    format!("C {:.0}°, γ {:.0}°", c.to_degrees().round() % 360.0, gamma.to_degrees())
}
