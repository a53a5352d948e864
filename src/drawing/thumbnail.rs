//! Small picture of the light that a product transmits for one incident direction, for lists and galleries.

use super::colours::{ColourMap, ColourScale};
use super::hemisphere::{Projection, Side, emergent_disk};
use crate::compute::btdf::Btdf;
use crate::compute::direction::{Emergent, Incident};

/// Width and height of the picture. \[pixels\]
pub const SIDE: usize = 72;
/// Number of decades that the logarithmic colour scale reaches below the largest value.
const DECADES: i32 = 3;
/// Radius of the dot that marks regular transmission, as a fraction of the disk's radius.
const DOT: f64 = 0.1;

/// Returns a picture of the luminance coefficients of the light that a system transmits from one incident direction:
/// the hemisphere of emergent directions as a disk seen from inside the room, up is up, regular transmission as a white
/// dot. Red, green, blue and opacity of [`SIDE`]² pixels, row by row from the top.
///
/// Every picture has a colour scale of its own: logarithmic, three decades up to its largest value.
pub fn indicatrix(btdf: &Btdf, incident: Incident) -> Vec<[u8; 4]> {
    const PROJECTION: Projection = Projection::ProjectedSolidAngle;
    let scattered = btdf.indicatrix(incident);
    let max = scattered.iter().flat_map(|one| &one.q).copied().fold(0.0, f64::max);
    let scale = ColourScale::up_to(max.max(f64::MIN_POSITIVE), true, DECADES, ColourMap::Sequential);
    let regular = btdf.regular.as_ref().map_or(0.0, |regular| regular.at(incident.0.theta()));
    let dot = emergent_disk(PROJECTION, Emergent::from_undeviated(incident.0));
    let half = 0.5 * SIDE as f64;
    let pixel = |at: usize| {
        let (column, row) = ((at % SIDE) as f64 + 0.5, (at / SIDE) as f64 + 0.5);
        let (right, up) = ((column - half) / half, (half - row) / half);
        let radius = right.hypot(up);
        let inside = 1.0 / radius.max(1.0 + 1e-9);
        let q = scattered.as_ref().zip(Side::Emergent.direction_at(PROJECTION, [right * inside, up * inside]));
        let value = q.and_then(|(one, through)| Some(one.q[one.basis.index(through)?])).unwrap_or(0.0);
        let beam = (right - dot[0]).hypot(up - dot[1]);
        let [r, g, b] = match beam {
            beam if regular > 0.0 && beam < DOT => [255; 3],
            beam if regular > 0.0 && beam < 1.5 * DOT => [0; 3],
            _ => scale.rgb(if max > 0.0 { value } else { 0.0 }),
        };
        // The rim fades within a pixel.
        let cover = ((1.0 - radius) * half + 0.5).clamp(0.0, 1.0);
        [r, g, b, (255.0 * cover).round() as u8]
    };
    (0..SIDE * SIDE).map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Dir;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    fn at(picture: &[[u8; 4]], right: f64, up: f64) -> [u8; 4] {
        let place = |value: f64| (0.5 * SIDE as f64 * (1.0 + value)) as usize;
        picture[place(-up) * SIDE + place(right)]
    }

    #[test]
    fn a_pane_sends_a_high_sun_down_and_a_diffuser_sends_it_everywhere() {
        let sun = Incident(Dir::from_theta_phi(FRAC_PI_4, FRAC_PI_2));
        let low = -FRAC_PI_4.sin();
        let pane = indicatrix(&Btdf::ideal_transparent(0.8), sun);
        assert_eq!(at(&pane, 0.0, low), [255; 4]);
        assert_ne!(at(&pane, 0.0, -low), [255; 4]);
        let diffuser = indicatrix(&Btdf::ideal_diffuse(0.6), sun);
        assert_eq!(at(&diffuser, 0.0, low), at(&diffuser, 0.0, -low));
        assert_ne!(at(&diffuser, 0.0, 0.5)[..3], at(&pane, 0.0, 0.5)[..3]);
        // Nothing beyond the rim.
        assert_eq!(at(&diffuser, 0.95, 0.95)[3], 0);
    }
}
