//! The tiles on data of single directions: forms of the data, the map of schemes; what is copied; German.

use crate::driven::{apply, frames, services, settle};
use crate::legible::can_be_read;
use cfs::app::App;
use cfs::app::catalogue::shelf::Addition;
use cfs::app::command::Command;
use cfs::app::display::language::LanguageChoice;
use cfs::app::results::backend::ideals_shelf;
use cfs::app::results::data_looks::NoSchemes;
use cfs::app::shell::jobs::Lane;
use cfs::app::state::{Settings, Tile};
use cfs::app::tiles::TILES;
use cfs::app::tiles::arrange::{Arrange, Preset};
use cfs::catalogue::NewProduct;
use cfs::compute::angle::Bearing;
use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::{Btdf, Dataset, Indicatrices, Scattered};
use cfs::compute::direction::{Dir, Facade, Incident};
use cfs::study::data_form::{DataForm, How, NoForm};
use cfs::study::scene_file::{BoxKeys, OutsideKeys};
use egui::{OutputCommand, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

/// Data as a goniophotometer gives them: 145 directions, a lobe that follows the light over a little haze.
fn measured() -> Dataset {
    let (patches, cells) = (RingBasis::tregenza(), RingBasis::equal_area(24));
    let incident: Vec<Incident> = patches.cells().map(|cell| Incident(cell.centre())).collect();
    let lobe = |a: Dir<Facade>, b: Dir<Facade>| {
        0.03 + 12.0 * (-(a.vector().angle_between(b.vector()) / 0.1_f64).powi(2)).exp()
    };
    let row = |d: &Incident| cells.cells().map(|cell| lobe(d.0, cell.centre())).collect::<Vec<_>>();
    let values = incident.iter().flat_map(row).collect();
    let data = Indicatrices::new(incident, cells.clone(), values).expect("as many values as cells");
    let mut dataset = Dataset { name: "Measured".to_owned(), ..Dataset::default() };
    dataset.visible.transmission_front =
        Some(Btdf { regular: None, scattered: Some(Scattered::Directions(Arc::new(data))) });
    dataset
}

fn tile(title: &str) -> Tile {
    TILES.iter().find(|entry| entry.tile.title == title).expect("a tile of that name").tile
}

/// A window on the ideal systems and measured data, the latter chosen, one tile alone.
fn window(title: &str) -> Harness<'static, App> {
    let open = || {
        let shelf = ideals_shelf()?;
        shelf.add(&Addition {
            datasets: vec![Arc::new(measured())],
            product: NewProduct { name: "Measured".to_owned(), kind: "pane".to_owned(), ..NewProduct::default() },
        })?;
        Ok(shelf)
    };
    let mut harness = frames(App::new(services(open), Settings::default()), [1280.0, 720.0]);
    settle(&mut harness);
    crate::driven::coarsen(&mut harness, [3, 4]);
    crate::driven::select(&mut harness, |entry| entry.name == "Measured");
    apply(&mut harness, Command::Maximise(Some(tile(title))));
    harness
}

#[test]
fn the_btdf_tile_shows_data_filtered_and_compressed_and_tells_how_far_they_are_off() {
    let mut harness = window("BTDF");
    assert!(harness.state().shell.results.form.value.is_none(), "nothing is computed that nobody looks at");
    apply(&mut harness, Command::DataForm(DataForm::Filtered));
    let made = harness.state().shell.results.form.value.clone().expect("a form of the data");
    let filtered = made.made.as_ref().expect("a lattice of patches");
    assert!(matches!(filtered.how, How::Filter { in_force: false, .. }));
    harness.get_by_label_contains("% of the flux moved");
    // The same incidence is not filtered again.
    apply(&mut harness, Command::Hour(0));
    assert!(Arc::ptr_eq(&made, harness.state().shell.results.form.value.as_ref().unwrap()));
    apply(&mut harness, Command::DataForm(DataForm::Compact));
    harness.get_by_label_contains("compressed: ");
    let compact = harness.state().shell.results.form.value.clone().unwrap();
    assert!(matches!(compact.made.as_ref().unwrap().how, How::Wavelets { in_force: false, .. }));
    // Another incidence has data of its own.
    apply(&mut harness, Command::Incidence(Some(Incident(Dir::from_theta_phi(0.9, 0.3)))));
    assert!(!Arc::ptr_eq(&compact, harness.state().shell.results.form.value.as_ref().unwrap()));
    crate::driven::select(&mut harness, |entry| entry.name == "Ideal diffuser");
    assert_eq!(harness.state().shell.results.form.value.as_ref().unwrap().made, Err(NoForm::NoValues));
    assert!(harness.query_all_by_label_contains("Nothing to filter or compress").next().is_some());
    apply(&mut harness, Command::DataForm(DataForm::Measured));
    assert!(harness.query_all_by_label_contains("Nothing to filter or compress").next().is_none());
}

#[test]
fn what_was_stopped_says_so_and_is_asked_for_again() {
    let mut harness = window("BTDF");
    harness.state_mut().apply(Command::DataForm(DataForm::Filtered));
    harness.state_mut().apply(Command::Cancel(Lane::DataForm));
    harness.state_mut().apply(Command::SchemeMap);
    harness.state_mut().apply(Command::Cancel(Lane::Schemes));
    // Before the first frame nothing has begun: they are asked for all the same.
    settle(&mut harness);
    assert!(
        harness.state().shell.results.form.value.is_some() && harness.state().shell.results.schemes.value.is_some()
    );
    let before = harness.state().shell.results.form.value.clone().unwrap();
    // Stopped while it is made.
    harness.state_mut().apply(Command::Incidence(Some(Incident(Dir::from_theta_phi(0.7, 0.2)))));
    while !harness.state().works_in(Lane::DataForm) {
        harness.step();
    }
    harness.state_mut().apply(Command::Cancel(Lane::DataForm));
    settle(&mut harness);
    let form = &harness.state().shell.results.form;
    assert!(form.error.is_some() && Arc::ptr_eq(&before, form.value.as_ref().unwrap()));
    apply(&mut harness, Command::DataForm(DataForm::Filtered));
    let form = &harness.state().shell.results.form;
    assert!(form.error.is_none() && !Arc::ptr_eq(&before, form.value.as_ref().unwrap()));
}

#[test]
fn the_map_of_schemes_says_why_under_the_cursor() {
    let mut harness = window("BTDF");
    apply(&mut harness, Command::SchemeMap);
    let map = harness.state().shell.results.schemes.value.clone().expect("a map");
    assert!(map.made.as_ref().expect("triangles").len() > 200);
    let disk = harness.get_by_label("Incident hemisphere").rect();
    harness.hover_at(disk.center() + vec2(0.2, -0.3) * disk.width());
    harness.run_steps(3);
    let told = cfs::app::paint::tile::pointed_foot(&harness.ctx).expect("a line under the tile");
    assert!(told.contains("misplaces about") && told.contains('%'), "{told}");
    crate::driven::select(&mut harness, |entry| entry.name == "Ideal diffuser");
    assert_eq!(harness.state().shell.results.schemes.value.as_ref().unwrap().made, Err(NoSchemes::ClosedForm));
    harness.get_by_label_contains("No map of schemes");
}

#[test]
fn the_dome_shows_boxes_as_the_first_aperture_sees_them() {
    let mut harness = window("Sky");
    assert!(harness.state().shell.state.daylight.value.as_ref().unwrap().seen.is_none());
    let solid = BoxKeys { from: [-50.0, -30.0, 0.0], to: [50.0, -20.0, 40.0], turn: 0.0 };
    let scene = &mut harness.state_mut().shell.state.document.scene;
    scene.outside = vec![OutsideKeys { name: String::new(), solid, reflectance: None, luminance: Some(500.0) }];
    let bearing = Bearing::from_degrees(scene.site.azimuth);
    settle(&mut harness);
    let daylight = harness.state().shell.state.daylight.value.as_ref().unwrap();
    let seen = daylight.seen.as_ref().expect("a box before the sky");
    let at = |altitude: f64| Dir::from_altitude_bearing(altitude.to_radians(), bearing);
    // From 1.8 m above the ground its top, 20 m away, is 62° high.
    assert_eq!(seen.luminance(at(61.0)), 500.0);
    assert_eq!(seen.luminance(at(63.5)), daylight.outside.luminance(at(63.5)));
}

/// What was put into the clipboard by the last step.
fn clipboard(harness: &Harness<'_, App>) -> Vec<OutputCommand> {
    harness.output().platform_output.commands.clone()
}

#[test]
fn a_tile_is_copied_as_a_picture_and_the_line_under_it_as_text() {
    let mut harness = window("Room");
    harness.state_mut().apply(Command::CopyPicture(tile("Room")));
    let mut picture = None;
    for _ in 0..20_000 {
        harness.step();
        picture = clipboard(&harness).into_iter().find_map(|command| match command {
            OutputCommand::CopyImage(image) => Some(image),
            _ => None,
        });
        if picture.is_some() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let picture = picture.expect("a picture in the clipboard");
    let colours: std::collections::BTreeSet<[u8; 4]> = picture.pixels.iter().map(|pixel| pixel.to_array()).collect();
    assert!(picture.size[0] > 300 && picture.size[1] > 200 && colours.len() > 50, "{:?}", picture.size);
    let plan = harness.get_by_label("Floor plan of the room").rect();
    harness.hover_at(plan.center());
    harness.run_steps(3);
    harness.state_mut().apply(Command::CopyValue);
    harness.step();
    let text = clipboard(&harness).into_iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text),
        _ => None,
    });
    let text = text.expect("a text in the clipboard");
    assert!(text.contains("direct") && text.contains("interreflected") && text.contains("lx"), "{text}");
}

#[test]
fn scales_that_are_held_stay_when_the_light_changes() {
    let mut harness = window("Sky");
    let marks = |harness: &Harness<'_, App>| {
        // The scale under the dome: its marks are painted words.
        let dome = harness.get_by_label("Sky dome").rect();
        let legend =
            egui::Rect::from_x_y_ranges(dome.x_range().expand(60.0), dome.bottom() + 20.0..=dome.bottom() + 110.0);
        crate::legible::inspect::words_within(harness, legend)
    };
    harness.get_by_label("Lock").click();
    harness.run_steps(3);
    let before = marks(&harness);
    apply(&mut harness, Command::Hour(5));
    assert_eq!(marks(&harness), before);
    harness.get_by_label("Lock").click();
    harness.run_steps(3);
    assert_ne!(marks(&harness), before);
}

#[test]
fn the_tiles_speak_german_and_write_numbers_as_germans_do() {
    let mut harness = window("Room");
    apply(&mut harness, Command::Language(LanguageChoice::German));
    harness.get_by_label("Kachel Raum");
    let summary = harness.get_by_label("Grundriss des Raums").value().unwrap_or_default();
    assert!(summary.contains("Mittel") && summary.contains("U_o 0,"), "{summary}");
    apply(&mut harness, Command::Maximise(None));
    for label in ["Kachel BTDF", "Kachel τ-Verlauf", "Kachel Himmel", "Kachel LVK", "Kachel Steuerung"] {
        harness.get_by_label(label);
    }
    for label in ["Einfallsseite", "Karte des Transmissionsgrads", "Himmelskuppel", "LVK, Polardiagramm"] {
        assert!(!harness.get_by_label(label).value().unwrap_or_default().is_empty(), "{label}");
    }
    apply(&mut harness, Command::Language(LanguageChoice::English));
    harness.get_by_label("Tile Room");
}

#[test]
fn german_tiles_can_be_read_at_all_sizes() {
    let mut harness = crate::driven::window();
    apply(&mut harness, Command::Language(LanguageChoice::German));
    for ready in Preset::ALL {
        apply(&mut harness, Command::Arrange(Arrange::Preset(ready)));
        can_be_read(&mut harness, ready.word().get());
    }
    apply(&mut harness, Command::Arrange(Arrange::Preset(Preset::All)));
    for entry in TILES {
        apply(&mut harness, Command::Maximise(Some(entry.tile)));
        can_be_read(&mut harness, entry.tile.title);
    }
}

#[test]
fn a_map_of_schemes_and_other_forms_can_be_read() {
    let mut harness = window("BTDF");
    apply(&mut harness, Command::Maximise(None));
    apply(&mut harness, Command::SchemeMap);
    for form in DataForm::ALL {
        apply(&mut harness, Command::DataForm(form));
        for language in [LanguageChoice::English, LanguageChoice::German] {
            apply(&mut harness, Command::Language(language));
            can_be_read(&mut harness, &format!("{form:?} {language:?}"));
        }
    }
}
