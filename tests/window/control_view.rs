//! Controls in the window: a curve edited by pointer and by keys, rules of the scene and of single apertures, undo.

use crate::driven::{apply, coarsen, frames, settle};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::paint::tile::Status;
use cfs::app::results::backend::{StudyEngine, memory_shelf};
use cfs::app::views::control::{self, Action, StatePoint};
use cfs::study::scene_file::{ControlKeys, ControlMode};
use egui::{Key, PointerButton, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

type Curve = Vec<[f64; 2]>;

/// The tile alone, with a curve that follows what is done to it.
fn tile() -> Harness<'static, (control::State, Curve)> {
    let states: Vec<StatePoint> =
        (0..=8).map(|k| StatePoint { key: format!("{}", 10 * k), value: f64::from(10 * k) }).collect();
    Harness::builder().with_size([600.0, 400.0]).build_ui_state(
        move |ui, (state, curve): &mut (control::State, Curve)| {
            let input = control::Input {
                states: &states,
                still: "",
                quantity: "slat angle / °",
                curve,
                editable: true,
                name: "blind",
                today: &[],
                profile_angle: None,
                current: 0,
                year: &[],
                remark: "",
                moment: None,
                revision: 0,
                status: Status::default(),
            };
            for action in control::show(ui, &input, state) {
                if let Action::EditCurve(new) = action {
                    *curve = new;
                }
            }
        },
        (control::State::default(), vec![[0.0, 60.0], [45.0, 40.0], [90.0, 0.0]]),
    )
}

/// Where a point of the curve stands: the axis of values has a margin of 8 % on either side.
fn place(h: &Harness<'_, (control::State, Curve)>, [psi, value]: [f64; 2]) -> egui::Pos2 {
    let area = h.get_by_label("Control curve").rect();
    let share = (value + 6.4) / (80.0 + 2.0 * 6.4);
    pos2(area.left() + area.width() * (psi / 90.0) as f32, area.bottom() - area.height() * share as f32)
}

fn curve(h: &Harness<'_, (control::State, Curve)>) -> Curve {
    h.state().1.clone()
}

#[test]
fn points_are_dragged_to_states_and_added_and_taken_out() {
    let mut h = tile();
    h.run();
    let (from, to) = (place(&h, [45.0, 40.0]), place(&h, [60.2, 22.0]));
    h.hover_at(from);
    h.run();
    h.drag_at(from);
    h.run();
    for k in 1..=4 {
        h.hover_at(from + (to - from) * (k as f32 / 4.0));
        h.run();
    }
    h.drop_at(to);
    h.run();
    assert_eq!(curve(&h), [[0.0, 60.0], [60.0, 20.0], [90.0, 0.0]]);
    // A right click on it takes it out.
    let here = place(&h, [60.0, 20.0]);
    h.hover_at(here);
    h.run();
    for pressed in [true, false] {
        let button = PointerButton::Secondary;
        h.event(egui::Event::PointerButton { pos: here, button, pressed, modifiers: egui::Modifiers::NONE });
    }
    h.run();
    assert_eq!(curve(&h), [[0.0, 60.0], [90.0, 0.0]]);
}

/// Two clicks, quicker than a frame of these tests.
fn double_click(h: &mut Harness<'_, (control::State, Curve)>, at: egui::Pos2) {
    h.hover_at(at);
    h.run();
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (PointerButton::Primary, egui::Modifiers::NONE);
        h.input_mut().events.push(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    h.run();
}

#[test]
fn the_wheel_zooms_and_a_double_click_beside_the_line_shows_all_again() {
    let mut h = tile();
    h.run();
    let (corner, on_line) = (place(&h, [2.0, 4.0]), place(&h, [60.0, 26.7]));
    let reads = |h: &mut Harness<'_, _>, text: &str| {
        h.hover_at(on_line);
        h.run();
        assert!(h.query_by_label_contains(text).is_some(), "{text}");
    };
    reads(&mut h, "profile angle 60°");
    h.hover_at(corner);
    h.run();
    h.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: egui::vec2(0.0, 140.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: egui::Modifiers::NONE,
    });
    h.run();
    // Twice as large about the corner: 2° + 58° / 2.01.
    reads(&mut h, "profile angle 31°");
    double_click(&mut h, corner);
    reads(&mut h, "profile angle 60°");
    assert_eq!(curve(&h).len(), 3);
    // On the line it adds a point.
    double_click(&mut h, on_line);
    assert_eq!(curve(&h).len(), 4);
    // A drag of the ground moves the view and nothing else.
    let before = curve(&h);
    h.hover_at(corner);
    h.run();
    h.drag_at(corner);
    h.run();
    h.hover_at(corner + egui::vec2(60.0, 0.0));
    h.run();
    h.drop_at(corner + egui::vec2(60.0, 0.0));
    h.run();
    assert!(place(&h, [60.0, 26.7]) == on_line && curve(&h) == before);
    h.hover_at(on_line);
    h.run();
    assert!(h.query_by_label_contains("profile angle 60°").is_none());
}

#[test]
fn the_keyboard_alone_makes_a_curve() {
    let mut h = tile();
    h.run();
    h.get_by_label("Control curve").focus();
    h.run();
    let mut press = |key: Key| {
        h.key_press(key);
        h.run();
        curve(&h)
    };
    // The first point, two states down, ten degrees right.
    press(Key::Period);
    press(Key::ArrowDown);
    assert_eq!(press(Key::ArrowDown)[0], [0.0, 40.0]);
    for _ in 0..10 {
        press(Key::ArrowRight);
    }
    assert_eq!(curve(&h)[0], [10.0, 40.0]);
    let mut press = |key: Key| {
        h.key_press(key);
        h.run();
        curve(&h)
    };
    // One more after it, half way to the next: 27.5° is 28°, and the line there is level.
    assert_eq!(press(Key::Insert), [[10.0, 40.0], [28.0, 40.0], [45.0, 40.0], [90.0, 0.0]]);
    assert_eq!(press(Key::ArrowUp)[1], [28.0, 50.0]);
    assert_eq!(press(Key::Delete), [[10.0, 40.0], [45.0, 40.0], [90.0, 0.0]]);
    press(Key::Delete);
    press(Key::Delete);
    // A curve keeps one point.
    assert_eq!(press(Key::Delete).len(), 1);
}

fn window() -> Harness<'static, App> {
    let app = App::with_shelf(Arc::new(StudyEngine::default()), memory_shelf);
    let mut harness = frames(app, [1600.0, 900.0]);
    coarsen(&mut harness, [1, 2]);
    let scene = &mut harness.state_mut().shell.state.document.scene;
    // A lower and an upper part.
    scene.aperture[0].size[1] = 1.0;
    let mut upper = scene.aperture[0].clone();
    upper.origin[1] = 2.0;
    upper.size[1] = 0.6;
    scene.aperture.push(upper);
    settle(&mut harness);
    harness
}

#[test]
fn parts_of_a_window_follow_rules_of_their_own_and_undo_takes_them_back() {
    let mut h = window();
    apply(&mut h, Command::Select("venetian-80-72".into()));
    apply(&mut h, Command::Control(ControlMode::CutOff));
    let rules = |h: &Harness<'_, App>| {
        let scene = &h.state().shell.state.document.scene;
        [0, 1].map(|k| scene.aperture[k].control.as_ref().or(scene.control.as_ref()).map(|keys| keys.mode))
    };
    assert_eq!(rules(&h), [Some(ControlMode::CutOff); 2]);
    // Noon of the equinox at 41°: 2° of tilt by the closed form, up to the next state.
    assert_eq!(h.state().shell.state.shown_state, "5");
    apply(&mut h, Command::ControlOf(Some(1)));
    apply(&mut h, Command::Control(ControlMode::RetroReflect));
    assert_eq!(rules(&h), [Some(ControlMode::CutOff), Some(ControlMode::RetroReflect)]);
    assert_eq!(h.state().shell.state.shown_state, "50");
    // Hysteresis and dwell time are part of the year, which moves less often with them.
    let free = h.state().shell.results.year.value.as_ref().unwrap().movements;
    let keys = ControlKeys { dwell: Some(180.0), ..ControlKeys::of(ControlMode::RetroReflect) };
    apply(&mut h, Command::ControlKeys(Box::new(keys)));
    assert!(h.state().shell.results.year.value.as_ref().unwrap().movements < free);
    apply(&mut h, Command::Control(ControlMode::Redirect));
    apply(&mut h, Command::Undo);
    assert_eq!(rules(&h)[1], Some(ControlMode::RetroReflect));
    let again = toml::to_string(&h.state().shell.state.document.scene).unwrap();
    assert_eq!(cfs::study::SceneFile::parse(&again).unwrap(), h.state().shell.state.document.scene);
    // By hand for this part alone; then one rule for all again.
    apply(&mut h, Command::Control(ControlMode::Fixed));
    assert_eq!(rules(&h), [Some(ControlMode::CutOff), Some(ControlMode::Fixed)]);
    apply(&mut h, Command::ControlOf(None));
    apply(&mut h, Command::Control(ControlMode::Din5034));
    assert_eq!(rules(&h), [Some(ControlMode::Din5034); 2]);
}

#[test]
fn a_curve_of_a_file_becomes_the_rule_and_a_wrong_one_is_told() {
    let mut h = window();
    apply(&mut h, Command::Select("venetian-80-72".into()));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("retro.csv");
    std::fs::write(&path, "profile_angle_deg,value_deg\n0,70\n50,30\n90,0\n").unwrap();
    apply(&mut h, Command::OpenPaths(vec![path.clone()]));
    let state = &h.state().shell.state;
    assert_eq!(state.control_mode(), ControlMode::Curve);
    assert_eq!(state.control_keys().curve, [[0.0, 70.0], [50.0, 30.0], [90.0, 0.0]]);
    // 70° − 0.8 ψ at about 41° and a little less: 37.7°.
    assert_eq!(state.shown_state, "40");
    std::fs::write(&path, "profile_angle_deg,value_deg\n50,70\n20,30\n").unwrap();
    apply(&mut h, Command::OpenPaths(vec![path]));
    assert_eq!(h.state().shell.state.control_keys().curve.len(), 3);
}

#[test]
fn a_reset_scene_keeps_the_rule_of_what_stays_in_it() {
    let mut h = window();
    apply(&mut h, Command::Select("venetian-80-72".into()));
    apply(&mut h, Command::Control(ControlMode::CutOff));
    apply(&mut h, Command::ResetScene);
    settle(&mut h);
    let app = h.state();
    let control = app.shell.state.document.scene.control.as_ref();
    assert_eq!(control.map(|keys| keys.mode), Some(ControlMode::CutOff));
    assert!(
        app.shell.results.room.value.is_some() && !app.shell.results.room.stale,
        "{:?}",
        app.shell.results.room.error
    );
}
