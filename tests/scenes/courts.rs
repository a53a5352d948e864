//! Light wells and courts whose walls belong to the building: its faces are not seen by the apertures, and yet light them.

use crate::exchange::{Patch, building, close, compare_hall, factor, factors, file, room, solved};
use crate::outside::a_box;
use crate::rooms;
use glam::DVec3;
use std::f64::consts::PI;

const DARK: &str = "model = \"uniform\"\ndiffuse_horizontal = 0.0";

#[test]
fn in_a_white_well_on_a_wide_roof_everything_is_as_bright_as_its_lid() {
    // All surfaces reflect all light and the lid has one luminance: so has everything, whatever the roof outside the well.
    let text = rooms::Text {
        apertures: vec![rooms::roof([1.2, 1.5], [2.0, 2.4], rooms::DIFFUSE) + "\nreflectance = 0.0"],
        sky: DARK.into(),
        ..rooms::Text::default()
    };
    for height in [2.0, 5.0] {
        let top = 3.0 + height;
        let walls = [
            ([0.2, 0.5, 3.0], [1.0, 4.9, top]),
            ([3.4, 0.5, 3.0], [4.0, 4.9, top]),
            ([1.0, 0.5, 3.0], [3.4, 1.3, top]),
            ([1.0, 4.1, 3.0], [3.4, 4.9, top]),
        ];
        let walls = walls.map(|(from, to)| a_box(from, to, "reflectance = 1.0")).concat();
        let lid = a_box([0.2, 0.5, top], [4.0, 4.9, top + 0.5], "luminance = 1000.0");
        let outside = walls + &lid + &building([-2.0, 0.0, 0.0], [6.0, 7.0, 3.0], 1.0);
        close(&format!("white well {height} m high"), room(&file(&text, 0.0, &outside)).flux, 4800.0 * PI, 0.0);
    }
}

#[test]
fn a_window_at_the_foot_of_a_deep_court_gets_what_small_patches_say() {
    // 4 m wide, 4 m deep, 12 m high under uniform sky.
    let ([side, height], reflectance) = ([4.0, 12.0], 0.5);
    let (right, out, up) = (side * DVec3::X, -side * DVec3::Y, height * DVec3::Z);
    // Finest on the façade, whose borders between patches are those of the window, too.
    let mut patches = Patch::cut(DVec3::ZERO, right, up, [16, 48]);
    patches.extend(Patch::cut(right + out, -right, up, [8, 24]));
    patches.extend(Patch::cut(out, -out, up, [8, 24]));
    patches.extend(Patch::cut(right, out, up, [8, 24]));
    patches.extend(Patch::cut(out, right, -out, [8, 8]));
    let lid = [up, up + right, up + right + out, up + out];
    let sky = |patch: &Patch| patch.places().map(|at| 2500.0 * factor(at, patch.normal, &lid)).iter().sum::<f64>();
    let falling: Vec<f64> = patches.iter().map(sky).collect();
    let e = solved(&factors(&patches), &vec![reflectance; patches.len()], &falling);
    let within = |at: DVec3| at.y == 0.0 && (0.5..3.5).contains(&at.x) && (1.0..2.5).contains(&at.z);
    let exact = patches.iter().zip(&e).filter(|(patch, _)| within(patch.centre())).map(|(p, e)| p.area() * e).sum();
    let text = rooms::Text {
        apertures: vec![rooms::facade([0.5, 1.0], [3.0, 1.5], rooms::DIFFUSE) + "\nreflectance = 0.0"],
        ground: reflectance,
        sky: rooms::UNIFORM.into(),
        ..rooms::Text::default()
    };
    let walls = [
        ([-1.0, -5.0, 0.0], [0.0, 0.0, 12.0]),
        ([4.0, -5.0, 0.0], [5.0, 0.0, 12.0]),
        ([0.0, -5.0, 0.0], [4.0, -4.0, 12.0]),
    ];
    let walls = walls.map(|(from, to)| a_box(from, to, &format!("reflectance = {reflectance:?}"))).concat();
    for beside in [0.0, 10.0] {
        let house = building([-beside, 0.0, 0.0], [4.0 + beside, 7.0, height], reflectance);
        let what = format!("deep court of a façade {beside} m wider");
        close(&what, room(&file(&text, 0.0, &(walls.clone() + &house))).flux, exact, 5e-3);
    }
}

#[test]
fn a_bright_closed_hall_states_its_error() {
    compare_hall(&[0.9, 0.99]);
}
