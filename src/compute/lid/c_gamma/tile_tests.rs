//! Tables of tiles: what a reader makes of them lights the room's surfaces as the tile itself does.

use super::*;
use crate::compute::lid::SunBeam;
use crate::compute::lid::tiling::WORK_PLANE;
use glam::DVec3;
use std::f64::consts::FRAC_PI_4;
use std::sync::Arc;

/// Width, depth and height of the room. \[m\]
const ROOM: DVec3 = DVec3::new(4.0, 6.0, 3.0);

fn lid(panel: &Panel, parts: Vec<EmergentLuminance>, beams: Vec<SunBeam>) -> Lid {
    Lid { surface: panel.surface, size: panel.size, parts, beams }
}

fn panel(surface: Surface, centre: [f64; 3], size: [f64; 2]) -> Panel {
    Panel { centre: DVec3::from_array(centre), size, surface, room: ROOM, rim: [[true; 2]; 2] }
}

fn averaged(lid: &Lid, aim: Aim, step: Step) -> Averaged {
    Averaged::new(lid, aim, step, &Silent).unwrap()
}

/// Horizontal illuminance that a reader of the table finds on the work plane. [lx]
fn on_work_plane(table: &CGammaTable, panel: &Panel, x: f64, y: f64) -> f64 {
    let ray = DVec3::new(x, y, WORK_PLANE) - panel.centre;
    let way = Dir::<Facade>::new(panel.surface.facade_from_room(ray)).unwrap();
    let (c, gamma) = table.aim.angles(Emergent(way));
    table.intensities().at(c, gamma) * -ray.z / ray.length().powi(3)
}

#[test]
fn a_beam_through_a_tile_lights_its_outline_evenly_and_nothing_beside() {
    // Down and to the side; from the roof also straight down, where all planes meet.
    let facade = (Surface::Facade, [2.0, 0.0, 2.2], DVec3::new(0.2, 0.7, -0.6));
    let roof = (Surface::Roof, [2.0, 3.0, 3.0], DVec3::new(0.3, -0.2, -0.9));
    let overhead = (Surface::Roof, [2.0, 3.0, 3.0], DVec3::new(0.02, 0.01, -1.0));
    for (surface, centre, way) in [facade, roof, overhead] {
        let panel = panel(surface, centre, [0.3, 0.2]);
        let way = way.normalize();
        let direction = Emergent(Dir::new(surface.facade_from_room(way)).unwrap());
        let beam = SunBeam { direction, flux: 600.0, straight: true };
        let table =
            averaged(&lid(&panel, Vec::new(), vec![beam]), Aim::of(surface), Step::NORMAL).tile(&panel, 1.0, true);
        assert!((table.zonal_flux() / 600.0 - 1.0).abs() < 1e-9 && table.flux.value == 600.0);
        let landing = |x: f64, y: f64| {
            let from = panel.centre + surface.room_from_facade(DVec3::new(x, y, 0.0));
            from + (from.z - WORK_PLANE) / -way.z * way
        };
        // E = Φ |b·n|/(A |b·n_A|) on the plane.
        let inward = -surface.room_from_facade(DVec3::Z);
        let even = 600.0 * -way.z / (0.06 * way.dot(inward));
        let lit = |x: f64, y: f64| {
            let at = landing(x, y);
            on_work_plane(&table, &panel, at.x, at.y) / even
        };
        for (u, v) in [(0.0, 0.0), (0.7, 0.0), (-0.6, 0.6), (0.5, -0.7), (0.6, 0.6)] {
            let e = lit(0.15 * u, 0.1 * v);
            assert!((e - 1.0).abs() < 0.02, "{surface:?} {u} {v}: {e}");
        }
        for (u, v) in [(1.2, 0.0), (-1.25, 0.5), (0.0, 1.25), (0.3, -1.25), (3.0, 0.0)] {
            let e = lit(0.15 * u, 0.1 * v);
            let least = if u > 2.0 { 1e-9 } else { 0.02 };
            assert!(e < least, "{surface:?} {u} {v}: {e}");
        }
        // Half of it at the edges: they are where they belong.
        for (u, v) in [(1.0, 0.0), (-1.0, 0.3), (0.2, 1.0), (0.0, -1.0)] {
            let e = lit(0.15 * u, 0.1 * v);
            assert!((e - 0.5).abs() < 0.3, "{surface:?} {u} {v}: {e}");
        }
    }
}

#[test]
fn beams_of_tiles_side_by_side_leave_no_ridge_between_them() {
    // From so near to the work plane that their edges are bent in C and γ, and no host cuts them further.
    let way = DVec3::new(0.1, 0.75, -0.6).normalize();
    let beam = SunBeam {
        direction: Emergent(Dir::new(Surface::Facade.facade_from_room(way)).unwrap()),
        flux: 600.0,
        straight: true,
    };
    let tile = |column: usize, row: usize| {
        let centre = [1.9 + 0.2 * column as f64, 0.0, 1.5 + 0.2 * row as f64];
        let rim = [[column == 0, column == 1], [row == 0, row == 1]];
        let panel = Panel { rim, ..panel(Surface::Facade, centre, [0.2, 0.2]) };
        let lid = lid(&panel, Vec::new(), vec![beam]);
        (averaged(&lid, Aim::Mounted, Step::FINE).tile(&panel, 1.0, true), panel)
    };
    let tiles: Vec<_> = (0..4).map(|k| tile(k % 2, k / 2)).collect();
    let alike = 600.0 * -way.z / (0.04 * way.y);
    let corner = DVec3::new(2.0, 0.0, 1.6);
    let mut sum = 0.0;
    for (i, k) in (-16..=16).flat_map(|i| (-16..=16).map(move |k| (i, k))) {
        let from = corner + DVec3::new(0.01 * f64::from(i), 0.0, 0.01 * f64::from(k));
        let at = from + (from.z - WORK_PLANE) / -way.z * way;
        let e: f64 = tiles.iter().map(|(table, panel)| on_work_plane(table, panel, at.x, at.y)).sum();
        assert!((e / alike - 1.0).abs() < 0.1, "{i} {k}: {}", e / alike);
        sum += e / alike / 1089.0;
    }
    assert!((sum - 1.0).abs() < 4e-3, "{sum}");
}

#[test]
fn narrow_scattered_light_is_as_wide_as_the_tile_and_what_it_lights() {
    // A lobe of 2° behind a tile that is seen 5° wide.
    let panel = panel(Surface::Facade, [2.0, 0.0, 2.35], [0.2, 0.2]);
    let to = Emergent(Dir::new(DVec3::new(0.1, -FRAC_PI_4.sin(), -FRAC_PI_4.cos())).unwrap());
    let spot = to.undeviated_incident();
    let light = move |undeviated: Dir<Facade>| 40.0 + 1e6 * ((undeviated.dot(spot) - 1.0) / 3e-4).exp();
    let lid = lid(&panel, vec![EmergentLuminance::Function(Arc::new(light))], Vec::new());
    let averaged = averaged(&lid, Aim::Mounted, Step::FINE);
    assert!(averaged.same_for_all(false) && !averaged.same_for_all(true));
    // What the tile itself does: a sum over it.
    let own = |x: f64, y: f64| {
        let mut sum = 0.0;
        for i in 0..40 {
            for j in 0..40 {
                let beside = DVec3::new((f64::from(i) - 19.5) / 200.0, 0.0, (f64::from(j) - 19.5) / 200.0);
                let ray = DVec3::new(x, y, WORK_PLANE) - panel.centre - beside;
                let way = Emergent(Dir::new(Surface::Facade.facade_from_room(ray)).unwrap());
                sum += lid.luminance(way) * ray.y * -ray.z / ray.length().powi(4) * 2.5e-5;
            }
        }
        sum
    };
    let middle = panel.centre + 1.5 / FRAC_PI_4.sin() * Surface::Facade.room_from_facade(to.0.vector());
    let off = |narrow: bool| {
        let table = averaged.tile(&panel, 1.0, narrow);
        assert!((table.zonal_flux() / table.flux.value - 1.0).abs() < 1e-6);
        let mut worst: f64 = 0.0;
        for k in -6..=6 {
            let (x, y) = (middle.x + 0.025 * f64::from(k), middle.y + 0.03 * f64::from(k));
            worst = worst.max((on_work_plane(&table, &panel, x, y) - own(x, y)).abs());
        }
        worst / own(middle.x, middle.y)
    };
    let (with, without) = (off(true), off(false));
    assert!(with < 0.06 && without > 0.5, "{with} {without}");
}
