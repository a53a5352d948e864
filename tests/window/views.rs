//! The tiles with synthetic but physically real inputs: found by name, operated by mouse and keyboard, and looked at.
//!
//! Pictures are made with a software Vulkan driver (lavapipe; `WGPU_BACKEND=vulkan`). Without it the picture tests are
//! noted as not looked at and pass: what the tiles do is tested by the others.

use crate::common::compares_pictures;
use crate::legible::inspect::words_within;
use cfs::app::paint::hemisphere::{Projection, incident_disk};
use cfs::app::paint::tile::Status;
use cfs::app::scene::incidence::{Incidence, Source};
use cfs::app::views::{btdf, control, lid, room, sky, transmittance};
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{AngularTransmittance, Btdf, CellMatrix};
use cfs::compute::direction::{Dir, Emergent, Facade, Incident, Surface};
use cfs::compute::estimate::Silent;
use cfs::compute::lid::c_gamma::Peaks;
use cfs::compute::lid::{EmergentLuminance, Lid, SunBeam};
use egui::accesskit::Toggled;
use egui::{Theme, Ui, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::{Harness, SnapshotResults};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Deflection share of a laser-cut panel (Edmonds 1993), depth/width 0.7, n = 1.5.
fn deflected_share(d: Dir<Facade>) -> f64 {
    let v = d.vector();
    let inside = (1.0 - (v.x * v.x + v.y * v.y) / 2.25).sqrt();
    let t = 0.7 * (v.y / 1.5).abs() / inside;
    1.0 - (1.0 - t.rem_euclid(2.0)).abs()
}

/// A laser-cut panel with a little haze on Klems cells, and 10 % that go straight on unscattered.
fn laser_cut() -> Btdf {
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let weight = basis.projected_solid_angles();
    let n = basis.len();
    let mut values = vec![0.02 / PI; n * n];
    for i in 0..n {
        let d = basis.cell(i).centre();
        let tau = 0.8 * (1.0 - (1.0 - d.theta().cos()).powi(5));
        let share = deflected_share(d);
        let flipped = Dir::new(d.vector() * DVec3::new(1.0, -1.0, 1.0)).unwrap();
        let j = basis.index(flipped).unwrap();
        values[i * n + i] += (1.0 - share) * tau / weight[i];
        values[i * n + j] += share * tau / weight[j];
    }
    let mut btdf = Btdf::from_cells(CellMatrix::new(basis.clone(), basis, values).unwrap());
    btdf.regular = Some(AngularTransmittance::Constant(0.1));
    btdf
}

fn from(theta: f64, phi: f64) -> Incident {
    Incident(Dir::from_theta_phi(theta.to_radians(), phi.to_radians()))
}

fn chosen(direction: Incident) -> Incidence {
    Incidence { direction, source: Source::Chosen }
}

/// CIE type 12 with a zenith of 4000 cd/m² (ISO 15469).
fn clear_sky(altitude: f64, bearing: f64) -> f64 {
    let (sun_altitude, sun_bearing) = (0.62, 2.9);
    let chi = (altitude.sin() * f64::sin(sun_altitude)
        + altitude.cos() * f64::cos(sun_altitude) * (bearing - sun_bearing).cos())
    .clamp(-1.0, 1.0)
    .acos();
    let gradation = |sin: f64| if sin > 1e-6 { 1.0 - (-0.32 / sin).exp() } else { 1.0 };
    let f = |chi: f64| 1.0 + 10.0 * ((-3.0 * chi).exp() - (-1.5 * PI).exp()) + 0.45 * chi.cos().powi(2);
    let zenith_angle = 0.5 * PI - sun_altitude;
    4000.0 * gradation(altitude.sin()) * f(chi) / (gradation(1.0) * f(zenith_angle))
}

/// Sun paths of the 21st of each month before a south façade at 48.8° north (declination after Cooper).
fn sun_paths() -> Vec<Vec<(f64, Incident)>> {
    let latitude = 48.8_f64.to_radians();
    (0..12)
        .map(|month| {
            let day = 21.0 + 30.4 * f64::from(month);
            let declination = 23.45_f64.to_radians() * (2.0 * PI * (284.0 + day) / 365.0).sin();
            (16..=80)
                .filter_map(|quarter| {
                    let hour = f64::from(quarter) / 4.0;
                    let turn = (hour - 12.0) * 15_f64.to_radians();
                    // (east, north, up); before a south façade x = east, y = up, z = south.
                    let east = -declination.cos() * turn.sin();
                    let up = latitude.sin() * declination.sin() + latitude.cos() * declination.cos() * turn.cos();
                    let north = latitude.cos() * declination.sin() - latitude.sin() * declination.cos() * turn.cos();
                    (up > 0.0).then(|| (hour, Incident(Dir::new(DVec3::new(east, up, -north)).unwrap())))
                })
                .collect()
        })
        .collect()
}

/// Illuminance of a diffuse window 4 × 2 m over a plane, by 40 × 20 point sources: enough for a picture.
fn grid(nx: usize, ny: usize) -> Vec<room::CellValue> {
    (0..nx * ny)
        .map(|k| {
            let x = (k % nx) as f64 / nx as f64 * 4.0 + 2.0 / nx as f64;
            let y = (k / nx) as f64 / ny as f64 * 6.0 + 3.0 / ny as f64;
            let mut direct = 0.0;
            for a in 0..40 {
                for b in 0..20 {
                    let r = DVec3::new(0.05 + 0.1 * f64::from(a) - x, -y, 0.2 + 0.1 * f64::from(b));
                    let d2 = r.length_squared();
                    direct += 1500.0 * 0.01 * r.z * y / (d2 * d2);
                }
            }
            let inter = 90.0 - 6.0 * y;
            room::CellValue {
                total: direct + inter,
                error: 0.004 * (direct + inter),
                direct,
                inter,
                ..room::CellValue::default()
            }
        })
        .collect()
}

fn redirecting_lid() -> Lid {
    let basis = Arc::new(RingBasis::klems_full(AzimuthMap::KLEMS_FRONT));
    // More light upwards: through-names with y < 0 leave with y > 0.
    let luminance = basis.cells().map(|c| 900.0 + 2600.0 * (-c.centre().vector().y).max(0.0)).collect();
    Lid {
        surface: Surface::Facade,
        size: [2.0, 1.5],
        parts: vec![EmergentLuminance::Cells { basis, luminance }],
        beams: vec![SunBeam { direction: Emergent::from_undeviated(from(42.0, 75.0).0), flux: 2400.0, straight: true }],
    }
}

fn flux(lid: &Lid) -> f64 {
    let EmergentLuminance::Cells { basis, luminance } = &lid.parts[0] else { return 0.0 };
    lid.area() * basis.cells().zip(luminance).map(|(c, l)| c.projected_solid_angle() * l).sum::<f64>()
}

fn slats() -> Slats {
    let states: Vec<_> = (0..=9)
        .map(|k| control::StatePoint { key: format!("{}", 10 * k - 10), value: f64::from(10 * k - 10) })
        .collect();
    // Cut-off of flat slats 80 mm wide, 72 mm apart: β = asin(0.9 cosψ) − ψ, at least horizontal.
    let cut_off = |psi: f64| (0.9 * psi.to_radians().cos()).asin().to_degrees() - psi;
    let curve = (0..=90).map(|psi| [f64::from(psi), cut_off(f64::from(psi)).max(0.0)]).collect();
    let chosen = |psi: f64| ((cut_off(psi).max(0.0) / 10.0).ceil() as usize + 1).min(9);
    let psi_of = |d: &Incident| {
        let v = d.0.vector();
        (v.z > 0.0).then(|| v.y.atan2(v.z).to_degrees())
    };
    let paths = sun_paths();
    let today = paths[4]
        .iter()
        .map(|(hour, d)| control::TracePoint {
            hour: *hour,
            profile_angle: psi_of(d),
            state: psi_of(d).map_or(1, chosen),
        })
        .collect();
    let mut year = vec![None; 365 * 24];
    for day in 0..365 {
        let path = &paths[((day + 9) / 31) % 12];
        for (hour, d) in path.iter().filter(|(hour, _)| hour.fract() == 0.0) {
            year[day * 24 + *hour as usize] = Some(psi_of(d).map_or(1, chosen) as u16);
        }
    }
    (states, curve, today, year)
}

const FINE: Status<'static> =
    Status { coarse: false, stale: false, idle: true, hold_scale: false, doing: None, error: None };

fn btdf_input(btdf: &Btdf, incident: Incident) -> btdf::Input<'_> {
    btdf::Input {
        btdf: Some(btdf),
        name: "Laser-cut panel",
        incidence: chosen(incident),
        sun: Some(from(42.0, 75.0)),
        range: None,
        form: None,
        schemes: None,
        revision: 1,
        status: FINE,
    }
}

fn sky_input<'a>() -> sky::Input<'a> {
    sky::Input {
        luminance: Some(&clear_sky),
        name: "CIE type 12, clear",
        sun: Some(sky::Place { altitude: 0.62, bearing: 2.9 }),
        facade_bearing: PI,
        behind_boxes: false,
        skyline: 0.0,
        diffuse_horizontal: Some(12_400.0),
        direct_horizontal: Some(38_200.0),
        facade_vertical: Some(51_700.0),
        facade_stale: false,
        range: None,
        revision: 1,
        status: FINE,
    }
}

const WINDOW: [room::Opening; 1] = [room::Opening { surface: Surface::Facade, origin: [0.5, 1.0], size: [3.0, 1.8] }];

fn room_input(cells: &[room::CellValue], nx: usize, ny: usize) -> room::Input<'_> {
    room::Input {
        room: [4.0, 6.0, 3.0],
        apertures: &WINDOW,
        nx,
        ny,
        cells,
        plane_z: Some(0.85),
        name: "sensor plane 0.85 m",
        revision: 1,
        status: FINE,
        ..room::Input::nothing()
    }
}

struct Bench {
    btdf: (btdf::State, Vec<btdf::Action>),
    transmittance: transmittance::State,
    sky: (sky::State, Vec<sky::Action>),
    lid: lid::State,
    room: room::State,
    control: (control::State, Vec<control::Action>),
    incident: Incident,
}

impl Default for Bench {
    fn default() -> Self {
        Self {
            btdf: Default::default(),
            transmittance: Default::default(),
            sky: Default::default(),
            lid: Default::default(),
            room: Default::default(),
            control: Default::default(),
            incident: from(40.0, 90.0),
        }
    }
}

fn place(ui: &mut Ui, rect: egui::Rect, salt: &str, add: impl FnOnce(&mut Ui)) {
    ui.scope_builder(egui::UiBuilder::new().max_rect(rect).id_salt(salt), |ui| {
        ui.painter().rect_filled(rect, 4, ui.visuals().panel_fill);
        add(ui);
    });
}

/// One tile over the whole window.
fn tile<'a>(size: [f32; 2], theme: Theme, app: impl FnMut(&mut Ui, &mut Bench) + 'a) -> Harness<'a, Bench> {
    Harness::builder().with_size(size).with_theme(theme).build_ui_state(app, Bench::default())
}

#[test]
fn a_click_on_the_incident_hemisphere_chooses_that_cell() {
    let btdf = laser_cut();
    let mut h = tile([700.0, 420.0], Theme::Light, |ui, bench| {
        let input = btdf_input(&btdf, bench.incident);
        let actions = btdf::show(ui, &input, &mut bench.btdf.0);
        for action in &actions {
            if let btdf::Action::ChooseIncidence(d) = action {
                bench.incident = *d;
            }
        }
        bench.btdf.1.extend(actions);
    });
    h.run();
    let rect = h.get_by_label("Incident hemisphere").rect();
    assert!(h.get_by_label("Incident hemisphere").value().unwrap().contains("θ 40°, φ 90°"));
    // A source at the upper left of the viewer inside: façade x > 0, y > 0.
    let wanted = from(50.0, 45.0);
    let [right, up] = incident_disk(Projection::default(), wanted);
    assert!(right < 0.0 && up > 0.0);
    let at = rect.center() + 0.5 * rect.width() * vec2(right as f32, -up as f32);
    h.hover_at(at);
    h.run();
    h.drag_at(at);
    h.run();
    h.drop_at(at);
    h.run();
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let cell = |d: Incident| basis.index(d.0);
    let [btdf::Action::ChooseIncidence(chosen)] = h.state().btdf.1[..] else {
        panic!("one choice expected: {:?}", h.state().btdf.1)
    };
    assert_eq!(cell(chosen), cell(wanted));
    // The arrow keys now walk on: up from there raises the source.
    h.key_press(egui::Key::ArrowUp);
    h.run();
    let btdf::Action::ChooseIncidence(next) = *h.state().btdf.1.last().unwrap() else { panic!("no choice") };
    assert!(next.0.vector().y > chosen.0.vector().y + 0.05);
    assert_eq!(cell(h.state().incident), cell(next));
    // And the toggle asks, but does not do.
    if h.query_by_label("Follow sun").is_none() {
        h.query_all_by_label("View").last().expect("the tile's menu").click();
        h.run();
    }
    h.get_by_label("Follow sun").click();
    h.run();
    assert_eq!(h.state().btdf.1.last(), Some(&btdf::Action::FollowSun(true)));
}

#[test]
fn the_sun_is_dragged_to_where_the_pointer_is() {
    let mut h = tile([420.0, 520.0], Theme::Dark, |ui, bench| {
        let actions = sky::show(ui, &sky_input(), &mut bench.sky.0);
        bench.sky.1.extend(actions);
    });
    h.run();
    let rect = h.get_by_label("Sky dome").rect();
    let radius = 0.5 * rect.width() - 8.0;
    // North up, east left: (−sin β, cos β).
    let screen = |altitude: f64, bearing: f64| {
        let r = (1.0 - altitude / (0.5 * PI)) as f32 * radius;
        rect.center() + r * vec2(-bearing.sin() as f32, -bearing.cos() as f32)
    };
    let start = screen(0.62, 2.9);
    h.hover_at(start);
    h.run();
    h.drag_at(start);
    h.run();
    // East at 30°.
    let end = screen(PI / 6.0, 0.5 * PI);
    h.hover_at(end);
    h.run();
    h.drop_at(end);
    h.run();
    let places: Vec<_> = h
        .state()
        .sky
        .1
        .iter()
        .filter_map(|a| match a {
            sky::Action::SunDragged { place, free, date } => Some((*place, *free || *date)),
            sky::Action::SunReleased => None,
        })
        .collect();
    let (last, free) = *places.last().expect("the sun moved");
    assert!(!free && (last.altitude - PI / 6.0).abs() < 0.02 && (last.bearing - 0.5 * PI).abs() < 0.02, "{last:?}");
    assert_eq!(h.state().sky.1.last(), Some(&sky::Action::SunReleased));
}

#[test]
fn tiles_without_data_say_what_is_missing() {
    let mut h = tile([800.0, 500.0], Theme::Light, |ui, bench| {
        let [left, right] =
            [0, 1].map(|k| egui::Rect::from_min_size(egui::pos2(8.0 + 390.0 * k as f32, 8.0), vec2(380.0, 230.0)));
        place(ui, left, "btdf", |ui| {
            let btdf = laser_cut();
            let input = btdf::Input { btdf: None, ..btdf_input(&btdf, bench.incident) };
            btdf::show(ui, &input, &mut bench.btdf.0);
        });
        place(ui, right, "room", |ui| {
            room::show(ui, &room_input(&[], 8, 12), &mut bench.room);
        });
        place(ui, left.translate(vec2(0.0, 240.0)), "control", |ui| {
            let input = control::Input {
                states: &[],
                still: "This pane has one state.",
                quantity: "slat angle / °",
                curve: &[],
                editable: false,
                name: "Glazing",
                today: &[],
                profile_angle: None,
                current: 0,
                year: &[],
                remark: "",
                moment: None,
                revision: 0,
                status: FINE,
            };
            control::show(ui, &input, &mut bench.control.0);
        });
        place(ui, right.translate(vec2(0.0, 240.0)), "sky", |ui| {
            let status = Status { error: Some("The sky needs a diffuse illuminance above 0 lx."), ..FINE };
            sky::show(ui, &sky::Input { status, ..sky_input() }, &mut bench.sky.0);
        });
    });
    h.run();
    for part in ["Select a product", "No illuminances yet", "one state", "diffuse illuminance above 0 lx"] {
        assert!(h.query_by_label_contains(part).is_some(), "{part}");
    }
    assert!(h.query_by_label("Floor plan of the room").is_none());
}

#[test]
fn tiles_whose_first_result_is_being_computed_do_not_say_that_there_is_none() {
    for (computed, doing, expected) in [
        (false, None, ["No sky", "the scene has no aperture", "No illuminances yet"]),
        (true, None, ["Computing…"; 3]),
        (true, Some("reading the weather"), ["reading the weather"; 3]),
    ] {
        let status = Status { stale: true, idle: !computed, doing, ..FINE };
        for (k, expected) in expected.into_iter().enumerate() {
            let mut h = tile([400.0, 250.0], Theme::Light, |ui, bench| match k {
                0 => _ = sky::show(ui, &sky::Input { luminance: None, status, ..sky_input() }, &mut bench.sky.0),
                1 => {
                    let (name, peaks, flux, max) = ("", None, None, None);
                    let input = lid::Input { lid: None, name, peaks, flux, max, revision: 1, status };
                    _ = lid::show(ui, &input, &mut bench.lid);
                }
                _ => _ = room::show(ui, &room::Input { status, ..room_input(&[], 8, 12) }, &mut bench.room),
            });
            h.run();
            assert!(h.query_by_label_contains(expected).is_some(), "{k} {status:?}");
        }
    }
}

#[test]
fn exports_hold_the_numbers() {
    let btdf = laser_cut();
    let text = btdf::csv(&btdf_input(&btdf, from(40.0, 90.0)));
    // ∑ q·PΩ of the export is the scattered transmittance.
    let sum: f64 = text
        .lines()
        .skip(4)
        .map(|line| {
            let f: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
            f[2] * f[3]
        })
        .sum();
    assert!((sum + 0.1 - btdf.tau(from(40.0, 90.0))).abs() < 1e-6, "{sum}");
    let cells = grid(4, 6);
    assert_eq!(room::csv(&room_input(&cells, 4, 6)).lines().count(), 25);
    assert_eq!(sky::csv(&sky_input()).lines().count(), 1 + 19 * 36);
}

/// States, rule, today and the year of a blind.
type Slats = (Vec<control::StatePoint>, Vec<[f64; 2]>, Vec<control::TracePoint>, Vec<Option<u16>>);

/// All six tiles as the window shows them.
fn bench(size: [f32; 2], theme: Theme) -> Harness<'static, Bench> {
    let (product, body, cells, paths) = (laser_cut(), redirecting_lid(), grid(16, 24), sun_paths());
    let peaks = Peaks::of(&body, &Silent).unwrap();
    let (states, curve, today, year) = slats();
    let app = move |ui: &mut Ui, bench: &mut Bench| {
        let full = ui.available_rect_before_wrap();
        let rect = |column: usize, row: usize| {
            let size = vec2(full.width() / 3.0, full.height() / 2.0);
            egui::Rect::from_min_size(full.min + vec2(column as f32 * size.x, row as f32 * size.y), size).shrink(3.0)
        };
        let split = transmittance::FluxSplit { ceiling: 0.28, eye_zone: 0.05, work_zone: 0.09, floor: 0.03 };
        place(ui, rect(0, 0), "1", |ui| {
            btdf::show(ui, &btdf_input(&product, bench.incident), &mut bench.btdf.0);
        });
        place(ui, rect(1, 0), "2", |ui| {
            let input = transmittance::Input {
                btdf: Some(&product),
                name: "Laser-cut panel",
                sun_paths: &paths,
                moment: Some(from(42.0, 75.0)),
                incidence: Incidence { direction: from(42.0, 75.0), source: Source::Sun },
                split: Some(split),
                range: None,
                revision: 1,
                status: FINE,
            };
            transmittance::show(ui, &input, &mut bench.transmittance);
        });
        place(ui, rect(2, 0), "3", |ui| {
            sky::show(ui, &sky_input(), &mut bench.sky.0);
        });
        place(ui, rect(0, 1), "4", |ui| {
            let input = lid::Input {
                lid: Some(&body),
                name: "Laser-cut panel",
                peaks: Some(&peaks),
                flux: Some(flux(&body)),
                max: None,
                revision: 1,
                status: FINE,
            };
            lid::show(ui, &input, &mut bench.lid);
        });
        place(ui, rect(1, 1), "5", |ui| {
            room::show(ui, &room_input(&cells, 16, 24), &mut bench.room);
        });
        place(ui, rect(2, 1), "6", |ui| {
            let input = control::Input {
                states: &states,
                still: "",
                quantity: "slat angle / °",
                curve: &curve,
                editable: false,
                name: "Venetian blind, cut-off",
                today: &today,
                profile_angle: Some(64.0),
                current: 1,
                year: &year,
                remark: "",
                moment: Some((140, 14.0)),
                revision: 1,
                status: FINE,
            };
            let actions = control::show(ui, &input, &mut bench.control.0);
            bench.control.1.extend(actions);
        });
    };
    Harness::builder().with_size(size).with_theme(theme).build_ui_state(app, Bench::default())
}

#[test]
fn six_tiles_are_named_and_fit_from_small_to_large() {
    for size in [[774.0, 424.0], [1350.0, 860.0], [2400.0, 1400.0]] {
        let mut h = bench(size, Theme::Light);
        h.run();
        for name in [
            "Incident hemisphere",
            "Emergent hemisphere",
            "Transmittance map",
            "Flux split",
            "Sky dome",
            "LID polar diagram",
            "Floor plan of the room",
            "Control curve",
        ] {
            let node = h.get_by_label(name);
            let rect = node.rect();
            let window = egui::Rect::from_min_size(egui::Pos2::ZERO, size.into());
            assert!(window.contains_rect(rect) && rect.width() > 50.0 && rect.height() > 30.0, "{name}: {rect:?}");
            assert!(node.value().is_some_and(|v| !v.is_empty()), "{name} has a value");
        }
        assert_eq!(h.query_all_by_label("?").count() + h.query_all_by_label_contains("About").count(), 6);
    }
}

#[test]
fn a_state_is_chosen_in_the_control_curve() {
    let mut h = bench([1350.0, 860.0], Theme::Light);
    h.run();
    let rect = h.get_by_label("Control curve").rect();
    // The lowest state lies at the foot of the chart.
    let at = rect.left_bottom() + vec2(60.0, -6.0);
    h.hover_at(at);
    h.run();
    h.drag_at(at);
    h.run();
    h.drop_at(at);
    h.run();
    assert_eq!(h.state().control.1, vec![control::Action::ChooseState(0)]);
}

#[test]
fn the_plan_has_a_scale_and_names_the_lines_that_are_asked_for() {
    let cells = grid(16, 24);
    let [least, most] = cells.iter().fold([f64::INFINITY, 0.0], |[a, b], c| [a.min(c.total), b.max(c.total)]);
    assert!(least < 300.0 && most > 500.0, "{least} {most}");
    for size in [[150.0, 265.0], [250.0, 320.0], [760.0, 560.0]] {
        let cells = cells.clone();
        let mut h = tile(size, Theme::Light, move |ui, bench| {
            room::show(ui, &room_input(&cells, 16, 24), &mut bench.room);
        });
        h.run();
        // On the plan itself: the scale of colours may have the same numbers.
        let words = words_within(&h, h.get_by_label("Floor plan of the room").rect());
        for wanted in ["300", "500"] {
            assert!(words.iter().any(|text| text == wanted), "{wanted} at {size:?}: {words:?}");
        }
        assert!(words.iter().any(|text| text == "1 m" || text == "2 m"), "{size:?}: {words:?}");
    }
}

#[test]
fn a_legend_hides_and_shows_a_series() {
    let mut h = bench([1350.0, 860.0], Theme::Light);
    h.run();
    for name in ["total", "direct", "curve", "today"] {
        let shown = |h: &Harness<'_, Bench>| h.get_by_label(name).accesskit_node().toggled();
        let rect = h.get_by_label(name).rect();
        // Above its plot, not on it.
        for plot in ["Illuminance profile", "Control curve"] {
            assert!(!h.get_by_label(plot).rect().intersects(rect), "{name}");
        }
        assert_eq!(shown(&h), Some(Toggled::True), "{name}");
        h.get_by_label(name).click();
        h.run();
        assert_eq!(shown(&h), Some(Toggled::False), "{name}");
        h.get_by_label(name).click();
        h.run();
        assert_eq!(shown(&h), Some(Toggled::True), "{name}");
    }
}

/// Pictures are compared where a software Vulkan driver was asked for: other drivers draw other pixels.
#[test]
fn pictures_of_the_bench() {
    if !compares_pictures() {
        return;
    }
    let mut results = SnapshotResults::new();
    for (theme, name) in [(Theme::Light, "bench_light"), (Theme::Dark, "bench_dark")] {
        let mut h = bench([760.0, 410.0], theme);
        h.run();
        results.add(h.try_snapshot(name));
    }
    let (product, body) = (laser_cut(), redirecting_lid());
    let peaks = Peaks::of(&body, &Silent).unwrap();
    let mut wide = tile([760.0, 400.0], Theme::Dark, |ui, bench| {
        btdf::show(ui, &btdf_input(&product, bench.incident), &mut bench.btdf.0);
    });
    wide.run();
    results.add(wide.try_snapshot("btdf_wide"));
    let mut wide = tile([640.0, 400.0], Theme::Light, |ui, bench| {
        let flux = Some(flux(&body));
        let input = lid::Input {
            lid: Some(&body),
            name: "Laser-cut panel",
            peaks: Some(&peaks),
            flux,
            max: None,
            revision: 1,
            status: FINE,
        };
        lid::show(ui, &input, &mut bench.lid);
    });
    wide.run();
    results.add(wide.try_snapshot("lid_wide"));
    results.unwrap();
}
