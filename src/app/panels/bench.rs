//! The bench: six tiles in three columns and two rows, or one that fills it.

use crate::app::App;
use crate::app::command::Command;
use crate::app::moment;
use crate::app::paint::tile::Status;
use crate::app::state::{State, Tile};
use crate::app::theme::{self, TILE_GAP};
use crate::app::title;
use crate::app::views::{btdf, control, lid, room, sky, transmittance};
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Facade, Incident, Orientation, Surface, World};
use crate::study::scene_file::{SceneFile, SurfaceKey};
use crate::study::sun_position::sun_path;
use egui::{Rect, Sense, Ui, UiBuilder, vec2};
use std::sync::Arc;

/// What the tiles remember, and what is derived for them once per change.
#[derive(Default)]
pub struct BenchState {
    btdf: btdf::State,
    transmittance: transmittance::State,
    sky: sky::State,
    lid: lid::State,
    room: room::State,
    control: control::State,
    /// The incidence that the user chose; the sun's while `None` and the sun is before the façade.
    incident: Option<Incident>,
    paths: Option<(PathKey, SunPaths)>,
    today: Option<(TodayKey, Vec<control::TracePoint>)>,
    cells: Option<(usize, Vec<room::CellValue>)>,
    revisions: Revisions,
}

/// Hour and direction along each path.
type SunPaths = Vec<Vec<(f64, Incident)>>;
/// Place and bearing that sun paths hang on.
type PathKey = (i16, [u64; 4]);
/// … and the day and state that today's trace hangs on.
type TodayKey = (PathKey, i16, usize);

/// Counts changes of results by the address of what is shown.
#[derive(Default)]
struct Revisions {
    seen: [usize; 3],
    count: [u64; 3],
}

impl Revisions {
    fn of<T>(&mut self, slot: usize, value: Option<&Arc<T>>) -> u64 {
        let address = value.map_or(0, |value| Arc::as_ptr(value).addr());
        if self.seen[slot] != address {
            self.seen[slot] = address;
            self.count[slot] += 1;
        }
        self.count[slot]
    }
}

/// Draws the bench.
pub fn show(ui: &mut Ui, app: &mut App, commands: &mut Vec<Command>) {
    let whole = ui.available_rect_before_wrap();
    if let Some(tile) = app.state.maximised {
        frame(ui, whole, tile, app, commands);
        return;
    }
    let size = vec2((whole.width() - 2.0 * TILE_GAP) / 3.0, (whole.height() - TILE_GAP) / 2.0);
    for (i, tile) in Tile::ALL.into_iter().enumerate() {
        let (column, row) = ((i % 3) as f32, (i / 3) as f32);
        let min = whole.min + vec2(column * (size.x + TILE_GAP), row * (size.y + TILE_GAP));
        frame(ui, Rect::from_min_size(min, size), tile, app, commands);
    }
}

/// A tile's ground; a double click on its head fills the bench with it, or shows all again.
fn frame(ui: &mut Ui, rect: Rect, tile: Tile, app: &mut App, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    ui.painter().rect(rect, 6, palette.surface, egui::Stroke::new(1.0, palette.line), egui::StrokeKind::Inside);
    let head = Rect::from_min_size(rect.min, vec2((rect.width() * 0.5).min(120.0), 26.0));
    let response = ui.interact(head, ui.scope_id().with(("tile", tile)), Sense::click());
    let response = response.on_hover_text("Double click: fill the bench, or show all tiles (keys 1–6 and 0)");
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, format!("Tile {}", tile.title()))
    });
    if response.double_clicked() {
        commands.push(Command::Maximise(if app.state.maximised.is_some() { None } else { Some(tile) }));
    }
    let builder = UiBuilder::new().max_rect(rect.shrink(2.0)).id_salt(tile.title());
    ui.scope_builder(builder, |ui| content(ui, tile, app, commands));
}

fn content(ui: &mut Ui, tile: Tile, app: &mut App, commands: &mut Vec<Command>) {
    let held = ui.input(|input| input.pointer.any_down());
    match tile {
        Tile::Btdf => btdf_tile(ui, app, held),
        Tile::Transmittance => transmittance_tile(ui, app, held),
        Tile::Sky => sky_tile(ui, app, held, commands),
        Tile::Lid => lid_tile(ui, app, held),
        Tile::Room => room_tile(ui, app, held, commands),
        Tile::Control => control_tile(ui, app, held, commands),
    }
}

/// A world direction as the façade sees it.
fn incident(scene: &SceneFile, altitude: f64, bearing: Bearing) -> Dir<Facade> {
    let orientation = Orientation::new(Bearing::from_degrees(scene.site.azimuth));
    Surface::Facade.facade_dir(orientation.room_from_world(Dir::<World>::from_altitude_bearing(altitude, bearing)))
}

/// The sun, if it is up and before the façade.
fn sun_incident(scene: &SceneFile) -> Option<Incident> {
    let (altitude, bearing) = moment::sun(scene)?;
    let direction = incident(scene, altitude, Bearing::from_degrees(bearing));
    (altitude > 0.0 && direction.vector().z > 0.0).then_some(Incident(direction))
}

fn status<'a>(stale: bool, held: bool, error: Option<&'a str>) -> Status<'a> {
    Status { coarse: false, stale, hold_scale: held, error }
}

fn normal() -> Incident {
    Incident(Dir::from_unit(glam::DVec3::Z))
}

fn btdf_tile(ui: &mut Ui, app: &mut App, held: bool) {
    let state = &app.state;
    let sun = sun_incident(&state.document.scene);
    let dataset = &state.dataset;
    let name = title::selection(state);
    let input = btdf::Input {
        btdf: dataset.value.as_deref().and_then(|dataset| dataset.transmission()),
        name: &name,
        incident: app.bench.incident.or(sun).unwrap_or_else(normal),
        sun,
        follow_sun: app.bench.incident.is_none(),
        range: None,
        revision: app.bench.revisions.of(0, dataset.value.as_ref()),
        status: status(dataset.stale, held, dataset.error.as_deref()),
    };
    for action in btdf::show(ui, &input, &mut app.bench.btdf) {
        app.bench.incident = match action {
            btdf::Action::ChooseIncidence(chosen) => Some(chosen),
            btdf::Action::FollowSun(true) => None,
            btdf::Action::FollowSun(false) => Some(input.incident),
        };
    }
}

fn path_key(scene: &SceneFile) -> PathKey {
    let site = &scene.site;
    let numbers = [site.latitude, site.longitude, site.utc_offset, Some(site.azimuth)];
    let year = moment::of(scene).map_or(2026, |time| time.year());
    (year, numbers.map(|number| number.unwrap_or(f64::NAN).to_bits()))
}

/// The sun before the façade on the 21st of each month, by hours.
fn sun_paths(scene: &SceneFile) -> Vec<Vec<(f64, Incident)>> {
    let Some(place) = moment::place(scene) else { return Vec::new() };
    let year = path_key(scene).0;
    (1..=12)
        .map(|month| {
            let points = sun_path(&place, year, month, 21, 0.25).unwrap_or_default();
            points
                .into_iter()
                .filter(|point| point.altitude > 0.0)
                .map(|point| (point.hour, Incident(incident(scene, point.altitude, point.bearing))))
                .filter(|(_, incident)| incident.0.vector().z > 0.0)
                .collect()
        })
        .collect()
}

fn transmittance_tile(ui: &mut Ui, app: &mut App, held: bool) {
    let state = &app.state;
    let scene = &state.document.scene;
    let key = path_key(scene);
    if app.bench.paths.as_ref().is_none_or(|(old, _)| *old != key) {
        app.bench.paths = Some((key, sun_paths(scene)));
    }
    let dataset = &state.dataset;
    let name = title::selection(state);
    let input = transmittance::Input {
        btdf: dataset.value.as_deref().and_then(|dataset| dataset.transmission()),
        name: &name,
        sun_paths: app.bench.paths.as_ref().map_or(&[], |(_, paths)| paths.as_slice()),
        moment: sun_incident(scene),
        split: None,
        revision: app.bench.revisions.of(0, dataset.value.as_ref()).wrapping_add(key.1[3]),
        status: status(dataset.stale, held, dataset.error.as_deref()),
    };
    for action in transmittance::show(ui, &input, &mut app.bench.transmittance) {
        match action {
            transmittance::Action::ChooseIncidence(chosen) => app.bench.incident = Some(chosen),
        }
    }
}

fn sky_tile(ui: &mut Ui, app: &mut App, held: bool, commands: &mut Vec<Command>) {
    let state = &app.state;
    let scene = &state.document.scene;
    let daylight = state.daylight.value.as_deref();
    let luminance = daylight.map(|daylight| {
        move |altitude: f64, bearing: f64| {
            daylight.outside.luminance(Dir::from_altitude_bearing(altitude, Bearing::from_radians(bearing)))
        }
    });
    let name = title::sky(scene);
    let place = |(altitude, bearing): (f64, f64)| sky::Place { altitude, bearing: bearing.to_radians() };
    let input = sky::Input {
        luminance: luminance.as_ref().map(|function| function as &dyn Fn(f64, f64) -> f64),
        name: &name,
        sun: moment::sun(scene).map(place),
        facade_bearing: scene.site.azimuth.to_radians(),
        skyline: daylight.map_or(0.0, |daylight| daylight.outside.skyline_altitude()),
        diffuse_horizontal: daylight.map(|daylight| daylight.outside.diffuse_horizontal()),
        direct_horizontal: daylight.map(|daylight| daylight.sun.map_or(0.0, |sun| sun.horizontal())),
        facade_vertical: app.results.lid.value.as_ref().and_then(|lid| lid.incident),
        revision: app.bench.revisions.of(1, state.daylight.value.as_ref()),
        status: status(state.daylight.stale, held, state.daylight.error.as_deref()),
    };
    let actions = sky::show(ui, &input, &mut app.bench.sky);
    for action in actions {
        if let sky::Action::SunDragged { place, free } = action {
            let mut scene = app.state.document.scene.clone();
            if free || !moment::towards(&mut scene, place.altitude, place.bearing) {
                scene.sky.time = None;
                scene.sky.sun.altitude = Some(place.altitude.to_degrees());
                scene.sky.sun.azimuth = Some(place.bearing.to_degrees());
            }
            commands.push(Command::Scene(Box::new(scene)));
        }
    }
}

/// Product and moment in words.
fn caption(state: &State) -> String {
    format!("{} · {}", title::selection(state), title::time(&state.document.scene))
}

fn lid_tile(ui: &mut Ui, app: &mut App, held: bool) {
    let shown = &app.results.lid;
    let name = caption(&app.state);
    let error = shown.error.as_deref().filter(|_| shown.value.is_none() || !app.jobs.busy(crate::app::jobs::Lane::Lid));
    let input = lid::Input {
        lid: shown.value.as_deref().map(|figures| &figures.lid),
        name: &name,
        flux: shown.value.as_deref().map(|figures| figures.flux.value - figures.lid.beam.map_or(0.0, |beam| beam.flux)),
        max: None,
        revision: app.bench.revisions.of(2, shown.value.as_ref()),
        status: status(shown.stale, held, error),
    };
    lid::show(ui, &input, &mut app.bench.lid);
}

fn openings(scene: &SceneFile) -> Vec<room::Opening> {
    let surface = |key| match key {
        SurfaceKey::Facade => Surface::Facade,
        SurfaceKey::Roof => Surface::Roof,
    };
    scene
        .aperture
        .iter()
        .map(|a| room::Opening { surface: surface(a.surface), origin: a.origin, size: a.size })
        .collect()
}

fn room_tile(ui: &mut Ui, app: &mut App, held: bool, commands: &mut Vec<Command>) {
    let shown = &app.results.room;
    let address = shown.value.as_ref().map_or(0, |value| Arc::as_ptr(value).addr());
    if app.bench.cells.as_ref().is_none_or(|(old, _)| *old != address) {
        let cells = shown.value.as_deref().filter(|figures| figures.grid.is_some()).map_or_else(Vec::new, |figures| {
            (0..figures.positions.len())
                .map(|i| room::CellValue {
                    total: figures.total(i).value,
                    error: figures.total(i).error,
                    direct: figures.direct[i].value,
                    inter: figures.interreflected[i].value,
                })
                .collect()
        });
        app.bench.cells = Some((address, cells));
    }
    let scene = &app.state.document.scene;
    let [nx, ny] = shown.value.as_deref().and_then(|figures| figures.grid).unwrap_or([0, 0]);
    let openings = openings(scene);
    let name = caption(&app.state);
    let error =
        shown.error.as_deref().filter(|_| shown.value.is_none() || !app.jobs.busy(crate::app::jobs::Lane::Room));
    let input = room::Input {
        room: [scene.room.width, scene.room.depth, scene.room.height],
        apertures: &openings,
        nx,
        ny,
        cells: app.bench.cells.as_ref().map_or(&[], |(_, cells)| cells.as_slice()),
        plane_z: scene.sensors.plane.map_or(0.0, |plane| plane.z),
        name: &name,
        range: None,
        revision: address as u64,
        status: status(shown.stale, held, error),
    };
    for action in room::show(ui, &input, &mut app.bench.room) {
        let room::Action::PlaneMoved(z) = action;
        let mut scene = app.state.document.scene.clone();
        if let Some(plane) = &mut scene.sensors.plane {
            plane.z = z;
        }
        commands.push(Command::Scene(Box::new(scene)));
    }
}

/// Profile angle of a direction before the façade. \[°\]
fn profile_angle(incident: Incident) -> f64 {
    let v = incident.0.vector();
    v.y.atan2(v.z).to_degrees()
}

/// Today's sun against the façade; the state stays where it is set.
fn trace(scene: &SceneFile, state: usize) -> Vec<control::TracePoint> {
    let (Some(place), Some(time)) = (moment::place(scene), moment::of(scene)) else { return Vec::new() };
    let points = sun_path(&place, time.year(), time.month(), time.day(), 0.5).unwrap_or_default();
    points
        .into_iter()
        .map(|point| {
            let direction = incident(scene, point.altitude, point.bearing);
            let before = point.altitude > 0.0 && direction.vector().z > 0.0;
            let angle = before.then(|| profile_angle(Incident(direction)));
            control::TracePoint { hour: point.hour, profile_angle: angle, state }
        })
        .collect()
}

fn control_tile(ui: &mut Ui, app: &mut App, held: bool, commands: &mut Vec<Command>) {
    let state = &app.state;
    let scene = &state.document.scene;
    let selection = &state.document.selection;
    let entry = state.found.entries.iter().find(|entry| entry.key == selection.product);
    let mut states: Vec<control::StatePoint> = entry.map_or_else(Vec::new, |entry| {
        entry
            .states
            .iter()
            .enumerate()
            .map(|(i, key)| control::StatePoint { key: key.clone(), value: key.parse().unwrap_or(i as f64) })
            .collect()
    });
    states.sort_by(|a, b| a.value.total_cmp(&b.value));
    let first = entry.and_then(|entry| entry.states.first()).map_or("", String::as_str);
    let wanted = if selection.state.is_empty() { first } else { &selection.state };
    let current = states.iter().position(|state| state.key == wanted).unwrap_or(0);
    let day = moment::of(scene).map_or(0, |time| time.day_of_year());
    let key = (path_key(scene), day, current);
    if app.bench.today.as_ref().is_none_or(|(old, _)| *old != key) {
        app.bench.today = Some((key, trace(scene, current)));
    }
    let name = format!("{} · fixed by hand", title::selection(state));
    let numeric = entry.is_some_and(|entry| entry.states.iter().all(|key| key.parse::<f64>().is_ok()));
    let input = control::Input {
        states: &states,
        quantity: if numeric { "state / °" } else { "state" },
        curve: &[],
        name: &name,
        today: app.bench.today.as_ref().map_or(&[], |(_, today)| today.as_slice()),
        profile_angle: sun_incident(scene).map(profile_angle),
        current,
        year: &[],
        moment: moment::of(scene).map(|time| {
            (
                usize::try_from(time.day_of_year() - 1).unwrap_or(0),
                f64::from(time.hour()) + f64::from(time.minute()) / 60.0,
            )
        }),
        revision: u64::from(day.unsigned_abs()) ^ key.0.1[3] ^ (current as u64) << 32,
        status: status(false, held, None),
    };
    for action in control::show(ui, &input, &mut app.bench.control) {
        match action {
            control::Action::ChooseState(index) => {
                if let Some(state) = states.get(index) {
                    commands.push(Command::SelectState(state.key.clone()));
                }
            }
            control::Action::ChooseMoment { day, hour } => {
                let mut scene = app.state.document.scene.clone();
                if let Some(time) = moment::of(&scene) {
                    let days = day as i32 + 1 - i32::from(time.day_of_year());
                    let minutes = (hour * 60.0) as i32 - 60 * i32::from(time.hour()) - i32::from(time.minute());
                    moment::step(&mut scene, days, minutes);
                    commands.push(Command::Scene(Box::new(scene)));
                }
            }
        }
    }
}
