//! Luminous intensity distribution of a luminaire as a polar diagram and as a CSV table of C-γ values.

use super::luminaire::Luminaire;
use super::luminaire_text::number;
use crate::drawing::{Align, Drawing, Rgb, Shape, TEXT};

const GRID: Rgb = [205, 205, 205];
const INK: Rgb = [60, 60, 60];
const C0: Rgb = [196, 58, 40];
const C90: Rgb = [38, 96, 168];

/// Returns the polar diagram of a luminaire's intensities in the planes C0–C180 (red) and C90–C270 (blue), with the
/// nadir at the bottom and C0 and C90 to the right.
pub fn polar_diagram(luminaire: &Luminaire) -> Drawing {
    const SIZE: f64 = 640.0;
    let centre = 0.5 * SIZE;
    let radius = 250.0;
    let drawn = [0.0, 90.0, 180.0, 270.0].map(|c| luminaire.plane(nearest_plane(luminaire, c)));
    // One scale for all four half planes: their sizes are to be compared.
    let full = round_up(drawn.into_iter().flatten().copied().fold(0.0, f64::max));
    // Nadir is down and pixels count downwards: γ = 0 goes to +y, and `side` tells the half plane.
    let at = |gamma_deg: f64, r: f64, side: f64| {
        let (sin, cos) = gamma_deg.to_radians().sin_cos();
        [centre + side * r * sin, centre + r * cos]
    };
    let mut shapes = Vec::new();
    for ring in 1..=4 {
        let r = radius * f64::from(ring) / 4.0;
        shapes.push(Shape::ring([centre; 2], r, GRID, 1.0));
    }
    for k in 0..12 {
        let gamma = f64::from(k) * 30.0;
        shapes.push(Shape::line([[centre, centre], at(gamma, radius, 1.0)], GRID, 1.0));
        // The circle is drawn once all round; γ runs from nadir to zenith on both sides.
        let shown = if gamma > 180.0 { 360.0 - gamma } else { gamma };
        shapes.push(Shape::text(at(gamma, radius + 22.0, 1.0), format!("{shown}°"), INK));
    }
    for (c, colour) in [(0.0, C0), (90.0, C90)] {
        // The two half planes of a colour make one section through the luminaire.
        for (plane_c, side) in [(c, 1.0), (c + 180.0, -1.0)] {
            let plane = luminaire.plane(nearest_plane(luminaire, plane_c));
            let points: Vec<_> =
                luminaire.gamma_deg.iter().zip(plane).map(|(&g, &i)| at(g, radius * i.max(0.0) / full, side)).collect();
            shapes.push(Shape::line(points, colour, 2.0));
        }
    }
    // Beside the zenith, between two rays, curves seldom reach; two of the four rings are enough to read the scale.
    for ring in [2.0, 4.0] {
        let text = format!("{} cd", number(full * ring / 4.0, 3));
        shapes.push(Shape::text(at(165.0, radius * ring / 4.0, 1.0), text, INK));
    }
    let mut words = |at, text: String, colour, align| shapes.push(Shape::words(at, text, colour, TEXT, align));
    words([16.0, 20.0], "C0–C180".to_owned(), C0, Align::Start);
    words([16.0, 42.0], "C90–C270".to_owned(), C90, Align::Start);
    words([SIZE - 16.0, 20.0], format!("{} lm", number(luminaire.flux(), 1)), INK, Align::End);
    Drawing { width: SIZE, height: SIZE, shapes }
}

/// Returns the index of the plane whose angle C is closest to `c_deg` \[°\], modulo 360°.
fn nearest_plane(luminaire: &Luminaire, c_deg: f64) -> usize {
    let away = |c: f64| ((c - c_deg + 180.0).rem_euclid(360.0) - 180.0).abs();
    (0..luminaire.c_deg.len())
        .min_by(|&a, &b| away(luminaire.c_deg[a]).total_cmp(&away(luminaire.c_deg[b])))
        .unwrap_or(0)
}

/// Returns the smallest number not below `value` that is 1, 1.2, 1.6, 2, 2.4, 3.2, 4, 5, 6, 8 or 10 times a power of
/// ten, so that halves and quarters of it have few digits.
fn round_up(value: f64) -> f64 {
    if value <= 0.0 {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    [1.0, 1.2, 1.6, 2.0, 2.4, 3.2, 4.0, 5.0, 6.0, 8.0, 10.0]
        .map(|step| step * decade)
        .into_iter()
        .find(|&step| step >= value * (1.0 - 1e-12))
        .unwrap_or(10.0 * decade)
}

/// Returns the intensity table of a luminaire as CSV with the columns `c_deg`, `gamma_deg` \[°\] and `intensity_cd`
/// \[cd\], plane by plane.
pub fn to_csv(luminaire: &Luminaire) -> String {
    let mut csv = String::from("c_deg,gamma_deg,intensity_cd\n");
    for (plane, c) in luminaire.c_deg.iter().enumerate() {
        for (gamma, intensity) in luminaire.gamma_deg.iter().zip(luminaire.plane(plane)) {
            csv.push_str(&format!("{},{},{intensity:.6e}\n", number(*c, 4), number(*gamma, 4)));
        }
    }
    csv
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::{Dir, Facade, Surface};
    use crate::compute::lid::c_gamma::{Aim, CGammaTable, Step};
    use crate::compute::lid::{EmergentLuminance, Lid};
    use crate::formats::luminaire::Description;
    use std::sync::Arc;

    /// Light that goes up only, into the room: C0 above the horizontal.
    fn upwards() -> Luminaire {
        let up = |twin: Dir<Facade>| if twin.vector().y < 0.0 { 1000.0 } else { 0.0 };
        let parts = vec![EmergentLuminance::Function(Arc::new(up))];
        let lid = Lid { surface: Surface::Facade, size: [1.0, 1.0], parts, beams: Vec::new() };
        let table = CGammaTable::new(&lid, Aim::Mounted, Step::from_degrees(5.0).unwrap());
        Luminaire::from_table(&table, lid.size, Description::default())
    }

    #[test]
    fn light_into_the_room_and_up_is_drawn_right_and_up() {
        let drawing = polar_diagram(&upwards());
        let red = drawing.shapes.iter().find_map(|shape| match shape {
            Shape::Line { points, colour, width, .. } if *colour == C0 && *width == 2.0 => Some(points),
            _ => None,
        });
        let far = red.unwrap().iter().filter(|p| (p[0] - 320.0).hypot(p[1] - 320.0) > 130.0);
        let mut count = 0;
        for point in far {
            count += 1;
            assert!(point[0] > 320.0 && point[1] < 320.0, "{point:?}");
        }
        assert!(count > 5);
        assert!(drawing.to_png().is_ok());
    }

    #[test]
    fn csv_has_every_node() {
        let csv = to_csv(&upwards());
        assert_eq!(csv.lines().count(), 1 + 72 * 37);
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        let sum: f64 = reader.records().map(|r| r.unwrap()[2].parse::<f64>().unwrap()).sum();
        let table: f64 = upwards().intensity.iter().sum();
        assert!((sum / table - 1.0).abs() < 1e-6);
    }

    #[test]
    fn scales_end_at_round_numbers() {
        for (value, expected) in [(0.0, 1.0), (3.3, 4.0), (860.0, 1000.0), (1000.0, 1000.0), (0.013, 0.016)] {
            assert!((round_up(value) / expected - 1.0).abs() < 1e-12, "{value}");
        }
    }
}
