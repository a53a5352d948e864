//! Fields of the skyline: its altitude, uniform or at compass bearings.

use crate::app::panels::fields::number;
use crate::app::shell::typing::read_number;
use crate::study::scene_file::{ObstructionKeys, SceneFile, SkylineKeys};
use crate::texts::scene as texts;
use egui::{DragValue, Ui};

/// Maximum number of points of the skyline that can be added in the panel.
const MOST: usize = 72;

/// Draws the fields of the skyline.
pub fn show(ui: &mut Ui, scene: &mut SceneFile) {
    let sky = &mut scene.sky;
    let mut even = sky.skyline.is_none();
    let choice = ui.checkbox(&mut even, texts::SKYLINE_EVEN).on_hover_text(texts::SKYLINE_EVEN_TIP);
    if choice.changed() {
        if even {
            let old = sky.skyline.take().unwrap_or(SkylineKeys { altitudes: vec![], luminance: 0.0 });
            let highest = old.altitudes.iter().map(|knot| knot[1]).fold(0.0, f64::max);
            sky.obstruction = Some(ObstructionKeys { altitude: highest, luminance: old.luminance });
        } else {
            let old = sky.obstruction.take().unwrap_or(ObstructionKeys { altitude: 0.0, luminance: 0.0 });
            // Four corners of the compass, at the height that it had.
            let altitudes = [0.0, 90.0, 180.0, 270.0].map(|bearing| [bearing, old.altitude]).to_vec();
            sky.skyline = Some(SkylineKeys { altitudes, luminance: old.luminance });
        }
    }
    match &mut sky.skyline {
        Some(keys) => by_bearing(ui, keys),
        None => {
            let mut flat = sky.obstruction.unwrap_or(ObstructionKeys { altitude: 0.0, luminance: 0.0 });
            let before = flat;
            number(ui, texts::SKYLINE_ALTITUDE, "°", &mut flat.altitude, 0.0..=60.0, 1);
            number(ui, texts::SKYLINE_LUMINANCE, " cd/m²", &mut flat.luminance, 0.0..=20_000.0, 0);
            if flat != before {
                sky.obstruction = Some(flat);
            }
        }
    }
}

/// Draws a line for each point of the skyline: compass bearing and altitude.
fn by_bearing(ui: &mut Ui, keys: &mut SkylineKeys) {
    let several = keys.altitudes.len() > 1;
    let mut gone = None;
    for (place, knot) in keys.altitudes.iter_mut().enumerate() {
        ui.horizontal(|ui| {
            let fields =
                [(texts::skyline_bearing(place + 1), 360.0, 1.0), (texts::skyline_altitude(place + 1), 89.0, 0.2)];
            for ((name, most, speed), value) in fields.into_iter().zip(knot) {
                let drag = DragValue::new(value).range(0.0..=most).clamp_existing_to_range(false).speed(speed);
                let drag = drag.max_decimals(1).suffix("°").custom_parser(|text| read_number(text, "°"));
                ui.add(drag).accessible_name(&name).on_hover_text(name);
            }
            if several {
                let words = texts::remove_knot(place + 1);
                if ui.small_button("×").accessible_name(&words).on_hover_text(words).clicked() {
                    gone = Some(place);
                }
            }
        });
    }
    if let Some(place) = gone {
        keys.altitudes.remove(place);
    }
    if keys.altitudes.len() < MOST && ui.button(texts::ADD_KNOT).clicked() {
        keys.altitudes.push(between(&keys.altitudes));
    }
    number(ui, texts::SKYLINE_LUMINANCE, " cd/m²", &mut keys.luminance, 0.0..=20_000.0, 0);
}

/// Returns a new point (bearing, altitude) \[°\] in the middle of the widest gap between the points of a skyline,
/// interpolated between its neighbours.
fn between(knots: &[[f64; 2]]) -> [f64; 2] {
    let mut sorted = knots.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let ends = sorted.iter().zip(sorted.iter().cycle().skip(1));
    // Of one point alone the gap goes all round.
    let gap = |a: &[f64; 2], b: &[f64; 2]| if a[0] == b[0] { 360.0 } else { (b[0] - a[0]).rem_euclid(360.0) };
    let widest = ends.max_by(|one, other| gap(one.0, one.1).total_cmp(&gap(other.0, other.1)));
    widest.map_or([0.0, 0.0], |(a, b)| [(a[0] + 0.5 * gap(a, b)).round().rem_euclid(360.0), 0.5 * (a[1] + b[1])])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_point_lies_on_the_line_in_the_widest_gap() {
        assert_eq!(between(&[[0.0, 10.0], [90.0, 20.0]]), [225.0, 15.0]);
        assert_eq!(between(&[[300.0, 4.0], [80.0, 8.0], [190.0, 6.0]]), [10.0, 6.0]);
        assert_eq!(between(&[[100.0, 5.0]]), [280.0, 5.0]);
        assert_eq!(between(&[]), [0.0, 0.0]);
    }
}
