//! The room tile: illuminances at the sensor points and, in the perspective, on the room's surfaces; apertures, sensor
//! points and obstructions can be moved.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::paint::tile::Status;
use crate::app::results::engine::{RoomFigures, part};
use crate::app::scene::outside;
use crate::app::scene::room_look::RoomView;
use crate::app::shell::jobs::Lane;
use crate::app::state::{Daylight, State, Tile};
use crate::app::views::{Cache, room};
use crate::compute::direction::Surface;
use crate::compute::sky::GroundShade;
use crate::study::scene::ground_shade;
use crate::study::scene_file::{SceneFile, SkyModelKey, SurfaceKey};
use crate::texts::{Text, tiles as say};
use egui::Ui;

/// The room tile.
pub const TILE: Tile = Tile { title: "Room", name: say::ROOM, help: say::ROOM_HELP };

/// Drawing of the room tile, with its caches between frames.
#[derive(Default)]
pub struct Drawing {
    view: room::State,
    shown: RoomView,
    /// Revision number of a result, and the horizontal illuminance outside under the unobstructed sky for it \[lx\].
    open_sky: Option<(u64, f64)>,
    cells: Cache<(u64, u64), Vec<room::CellValue>>,
    ground: Ground,
}

/// Cache of the shadow on the ground outside, for a scene and the revision number of its daylight; computed again when
/// one of them changes.
#[derive(Default)]
struct Ground(Option<(u64, SceneFile, Option<GroundShade>)>);

impl Ground {
    /// Returns the shadow on the ground outside; `None` if there is none to show, or before the sky is known.
    fn find(&mut self, state: &State) -> Option<&GroundShade> {
        let (scene, daylight) = (&state.document.scene, &state.daylight);
        if !self.0.as_ref().is_some_and(|(revision, file, _)| *revision == daylight.revision && file == scene) {
            let sky = daylight.value.as_deref();
            // Wrong keys are the room's own error.
            let shade = sky.and_then(|sky| ground_shade(scene, &sky.outside, sky.sun.as_ref()).ok().flatten());
            self.0 = Some((daylight.revision, scene.clone(), shade));
        }
        self.0.as_ref().and_then(|(.., shade)| shade.as_ref())
    }
}

/// CIE types of overcast skies, for which daylight factors are defined: the standard overcast sky 1 and the traditional
/// one 16 (ISO 15469).
const OVERCAST: [u8; 2] = [1, 16];

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

/// Returns the illuminances at the sensor points with their parts and errors, multiplied by a factor: 1 for values in
/// lx, 100 divided by the illuminance outside for daylight factors \[%\].
fn cells(figures: &RoomFigures, factor: f64) -> Vec<room::CellValue> {
    let cell = |i: usize| {
        let total = figures.total(i) * factor;
        room::CellValue {
            total: total.value,
            error: total.error,
            direct: factor * figures.direct[i].value,
            inter: factor * figures.interreflected[i].value,
            beam: factor * part(&figures.beam, i),
            data_error: factor * part(&figures.data_error, i),
        }
    };
    (0..figures.positions.len()).map(cell).collect()
}

/// Returns the reference of the daylight factor: the horizontal illuminance outside under the unobstructed overcast sky
/// \[lx\].
///
/// # Errors
/// Returns the reason why no daylight factor is defined.
fn open_sky(state: &State, daylight: Option<&Daylight>) -> Result<f64, Text> {
    let sky = &state.document.scene.sky;
    let daylight = daylight.ok_or(say::NO_FACTOR_SKY)?;
    if sky.model != SkyModelKey::Cie || !sky.cie_type.is_some_and(|number| OVERCAST.contains(&number)) {
        return Err(say::NO_FACTOR_TYPE);
    }
    if daylight.sun.is_some() {
        return Err(say::NO_FACTOR_SUN);
    }
    let horizontal = daylight.outside.diffuse_horizontal();
    if horizontal > 0.0 { Ok(horizontal) } else { Err(say::NO_FACTOR_DARK) }
}

/// Returns the scene after the user moved a sensor point, the sensor plane, an aperture or an obstruction.
fn moved(scene: &SceneFile, action: room::Action) -> SceneFile {
    let mut scene = scene.clone();
    match action {
        room::Action::PlaneMoved(z) => {
            if let Some(plane) = &mut scene.sensors.plane {
                plane.z = z;
            }
        }
        room::Action::OpeningMoved(number, to) => {
            if let Some(aperture) = scene.aperture.get_mut(number) {
                (aperture.origin, aperture.size) = (to.origin, to.size);
            }
        }
        room::Action::PointMoved(number, to) => {
            if let Some(point) = scene.sensors.points.get_mut(number) {
                *point = to;
            }
        }
        room::Action::BoxMoved(number, to) => {
            if let Some(one) = scene.outside.get_mut(number) {
                one.solid = to;
            }
        }
        room::Action::Look(_) | room::Action::BoxGone(_) => {}
    }
    scene
}

impl Drawn for Drawing {
    fn lanes(&self) -> &'static [Lane] {
        if self.shown == RoomView::Perspective { &[Lane::Room, Lane::Surfaces] } else { &[Lane::Room] }
    }

    fn log(&mut self) -> Option<&mut bool> {
        Some(&mut self.view.log)
    }

    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.results.room.value.is_some() || seen.results.room.error.is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let state = seen.state;
        let scene = &state.document.scene;
        let look = state.settings.room;
        if self.shown != look.view {
            // The tile area knows with the next frame what is to be computed for it.
            self.shown = look.view;
            ui.ctx().request_repaint();
        }
        let (shown, surfaces) = (&seen.results.room, &seen.results.surfaces);
        let factor = open_sky(state, state.daylight.value.as_deref());
        if let Ok(horizontal) = factor
            && !(shown.stale || state.daylight.stale)
        {
            self.open_sky = Some((shown.revision, horizontal));
        }
        // A result of an earlier sky is a share of that one.
        let known = self.open_sky.filter(|(of, _)| *of == shown.revision && look.daylight_factor && factor.is_ok());
        let (quantity, times) = match known {
            Some((_, horizontal)) => (room::Quantity::DaylightFactor, 100.0 / horizontal),
            None => (room::Quantity::Illuminance, 1.0),
        };
        let listed = scene.sensors.plane.is_none();
        let figures = shown.value.as_deref();
        let [nx, ny] = figures.and_then(|figures| figures.grid).filter(|_| !listed).unwrap_or([0, 0]);
        let fits = figures.filter(|figures| {
            figures.grid.is_none() == listed && (!listed || figures.positions.len() == scene.sensors.points.len())
        });
        let openings = openings(scene);
        let named = scene.outside.iter().enumerate().map(|(number, one)| (one.solid, outside::name(number, one)));
        let boxes: Vec<_> = named.collect();
        let name = seen.caption();
        let status = match look.view {
            RoomView::Perspective => seen.status_of(surfaces, Lane::Surfaces),
            _ => {
                let coarse = figures.is_some_and(|figures| figures.coarse);
                Status { coarse, ..seen.status_of(shown, Lane::Room) }
            }
        };
        let light = surfaces.value.as_deref().map(|figures| &figures.light);
        let input = room::Input {
            room: [scene.room.width, scene.room.depth, scene.room.height],
            apertures: &openings,
            outside: &boxes,
            ground: if look.view == RoomView::Plan { None } else { self.ground.find(state) },
            nx,
            ny,
            cells: self
                .cells
                .get((shown.revision, times.to_bits()), || fits.map_or_else(Vec::new, |one| cells(one, times))),
            points: if listed { &scene.sensors.points } else { &[] },
            plane_z: scene.sensors.plane.map(|plane| plane.z),
            quantity,
            no_factor: factor.err(),
            look,
            surfaces: light.zip(Some(surfaces.revision)),
            name: &name,
            range: seen.scale.map(|range| range.map(|end| end * times)),
            revision: shown.revision << 1 | u64::from(quantity == room::Quantity::DaylightFactor),
            status,
        };
        for action in room::show(ui, &input, &mut self.view) {
            commands.push(match action {
                room::Action::Look(look) => Command::RoomLook(look),
                room::Action::BoxGone(number) => Command::Outside(outside::Act::Remove(Some(number))),
                action => Command::Scene(Box::new(moved(scene, action))),
            });
        }
        seen.numbers.then(|| room::csv(&input))
    }
}
