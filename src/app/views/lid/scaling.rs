//! Statement of an aperture's luminous intensities: for the whole aperture, or per square metre of it.

use crate::compute::direction::{Emergent, Surface};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::Aim;
use crate::drawing::ticks::si;
use crate::texts::tiles as say;

/// Statement of an aperture's luminous intensities: for the whole aperture \[cd\], or per square metre of it \[cd/m²\].
#[derive(Debug, Clone, Copy)]
pub struct Scaling {
    /// Factor on intensities of the whole aperture: 1, or 1 divided by the area of the aperture in m².
    pub factor: f64,
    /// Whether intensities are stated per square metre of aperture.
    pub per_area: bool,
}

impl Scaling {
    /// Creates the scaling for the luminous intensity distribution of an aperture. `per_area`: see the field.
    pub fn of(lid: &Lid, per_area: bool) -> Self {
        Self { factor: if per_area { 1.0 / lid.area() } else { 1.0 }, per_area }
    }

    /// Returns the unit of the stated intensities, as text.
    pub fn unit(self) -> &'static str {
        if self.per_area { say::CANDELA_PER_AREA.get() } else { "cd" }
    }

    /// Returns the abbreviated unit of the stated intensities, as text.
    pub fn short_unit(self) -> &'static str {
        if self.per_area { say::CANDELA_PER_AREA_SHORT.get() } else { "cd" }
    }

    /// Returns an intensity of the whole aperture \[cd\] as text in the stated form: "11.5 Mcd", "2.1 kcd per m²".
    pub fn text(self, intensity: f64) -> String {
        let value = si(intensity * self.factor, "cd");
        if self.per_area { say::per_square_metre(value) } else { value }
    }
}

/// Returns an emergent direction of an aperture as text in the C and γ angles of its luminaire file: "C 12°, γ 80°".
pub(super) fn towards(surface: Surface, d: Emergent) -> String {
    let (c, gamma) = Aim::of(surface).angles(d);
    format!("C {:.0}°, γ {:.0}°", c.to_degrees().round() % 360.0, gamma.to_degrees())
}
