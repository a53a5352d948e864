//! The bench: six tiles in three columns and two rows, or one that fills it.

mod control_tile;

use crate::app::App;
use crate::app::command::Command;
use crate::app::control as rules;
use crate::app::moment;
use crate::app::paint::tile::Status;
use crate::app::split;
use crate::app::state::{State, Tile};
use crate::app::theme::{self, TILE_GAP};
use crate::app::title;
use crate::app::views::{btdf, control, lid, room, sky, transmittance};
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Facade, Incident, Orientation, Surface, World};
use crate::study::scene_file::{ControlKeys, SceneFile, SurfaceKey};
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
    paths: Option<(PathKey, Vec<SunPath>)>,
    today: Option<(TodayKey, Vec<control::TracePoint>)>,
    curve: Option<(CurveKey, Vec<[f64; 2]>)>,
    split: Option<(SplitKey, transmittance::FluxSplit)>,
    cells: Option<(usize, Vec<room::CellValue>)>,
    revisions: Revisions,
}

/// Hours of a day and where the sun is.
type SunPath = Vec<(f64, Incident)>;
/// Place and bearing that sun paths hang on.
type PathKey = (i16, [u64; 4]);
/// Rule and day that today's trace hangs on.
type TodayKey = (rules::YearKey, i16);
/// Product and rule that its curve hangs on.
type CurveKey = (String, ControlKeys);
/// Dataset, direction and surface that the flux split hangs on.
type SplitKey = (u64, Incident, bool);

/// Counts changes of results by the address of what is shown.
#[derive(Default)]
struct Revisions {
    seen: [usize; 4],
    count: [u64; 4],
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
    let response = response
        .on_hover_text("Double click: fill the bench, or show all tiles (keys 1–6 and 0). Right click: export, copy");
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, format!("Tile {}", tile.title()))
    });
    response.context_menu(|ui| {
        for command in [Command::ExportTile(tile), Command::CopyTile(tile)] {
            let info = command.info();
            if ui.button(info.text).on_hover_text(info.tip).clicked() {
                commands.push(command);
                ui.close();
            }
        }
    });
    app.export.picture(ui.ctx(), tile, rect);
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
        Tile::Control => control_tile::show(ui, app, held, commands),
    }
}

/// A world direction as the façade sees it.
fn incident(scene: &SceneFile, altitude: f64, bearing: Bearing) -> Dir<Facade> {
    let orientation = Orientation::new(Bearing::from_degrees(scene.site.azimuth));
    rules::surface(scene)
        .facade_dir(orientation.room_from_world(Dir::<World>::from_altitude_bearing(altitude, bearing)))
}

/// The sun, if it is up and before the façade.
pub(super) fn sun_incident(scene: &SceneFile) -> Option<Incident> {
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
    if app.export.wants_numbers(Tile::Btdf) {
        app.export.numbers(ui.ctx(), btdf::csv(&input));
    }
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

/// The sun on the 21st of each month while it is up, by hours; places behind the façade part a path in two.
fn sun_paths(scene: &SceneFile) -> Vec<SunPath> {
    let Some(place) = moment::place(scene) else { return Vec::new() };
    let year = path_key(scene).0;
    (1..=12)
        .map(|month| {
            let points = sun_path(&place, year, month, 21, 0.25).unwrap_or_default();
            points
                .into_iter()
                .filter(|point| point.altitude > 0.0)
                .map(|point| (point.hour, Incident(incident(scene, point.altitude, point.bearing))))
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
    let revision = app.bench.revisions.of(0, dataset.value.as_ref());
    let surface = rules::surface(scene);
    // The light that the BTDF tile shows: the sun's, unless another direction was chosen.
    let incident = app.bench.incident.or(sun_incident(scene));
    let btdf = dataset.value.as_deref().and_then(|dataset| dataset.transmission());
    let split = btdf.zip(incident).map(|(btdf, incident)| {
        let key = (revision, incident, surface == Surface::Roof);
        match &app.bench.split {
            Some((old, split)) if *old == key => *split,
            _ => {
                let split = split::split(btdf, incident, surface);
                app.bench.split = Some((key, split));
                split
            }
        }
    });
    let mut name = title::selection(state);
    if app.bench.incident.is_some() {
        name.push_str(" · flux split for the chosen direction");
    }
    let input = transmittance::Input {
        btdf: dataset.value.as_deref().and_then(|dataset| dataset.transmission()),
        name: &name,
        sun_paths: app.bench.paths.as_ref().map_or(&[], |(_, paths)| paths.as_slice()),
        moment: sun_incident(scene),
        split,
        revision: revision.wrapping_add(key.1[3]),
        status: status(dataset.stale, held, dataset.error.as_deref()),
    };
    if app.export.wants_numbers(Tile::Transmittance) {
        app.export.numbers(ui.ctx(), transmittance::csv(&input));
    }
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
    if app.export.wants_numbers(Tile::Sky) {
        app.export.numbers(ui.ctx(), sky::csv(&input));
    }
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
    if app.export.wants_numbers(Tile::Lid) {
        app.export.numbers(ui.ctx(), lid::csv(&input));
    }
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
    if app.export.wants_numbers(Tile::Room) {
        app.export.numbers(ui.ctx(), room::csv(&input));
    }
    for action in room::show(ui, &input, &mut app.bench.room) {
        let room::Action::PlaneMoved(z) = action;
        let mut scene = app.state.document.scene.clone();
        if let Some(plane) = &mut scene.sensors.plane {
            plane.z = z;
        }
        commands.push(Command::Scene(Box::new(scene)));
    }
}
