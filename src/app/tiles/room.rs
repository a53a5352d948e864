//! The room tile: illuminances on the sensor plane; the plane can be moved.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::engine::{RoomFigures, part};
use crate::app::jobs::Lane;
use crate::app::state::Tile;
use crate::app::views::{Cache, room};
use crate::compute::direction::Surface;
use crate::study::scene_file::{SceneFile, SurfaceKey};
use egui::Ui;

/// The tile.
pub const TILE: Tile =
    Tile { title: "Room", help: "Illuminance on the sensor plane, direct and interreflected. Task 31, eq 17." };

/// Its drawing.
#[derive(Default)]
pub struct Drawing {
    view: room::State,
    cells: Cache<u64, Vec<room::CellValue>>,
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

fn cells(figures: &RoomFigures) -> Vec<room::CellValue> {
    let cell = |i: usize| {
        let total = figures.total(i);
        room::CellValue {
            total: total.value,
            error: total.error,
            direct: figures.direct[i].value,
            inter: figures.interreflected[i].value,
            beam: part(&figures.beam, i),
            data_error: part(&figures.data_error, i),
        }
    };
    (0..figures.positions.len()).map(cell).collect()
}

impl Drawn for Drawing {
    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.results.room.value.is_some() || seen.results.room.error.is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let shown = &seen.results.room;
        let figures = shown.value.as_deref().filter(|figures| figures.grid.is_some());
        let scene = &seen.state.document.scene;
        let [nx, ny] = figures.and_then(|figures| figures.grid).unwrap_or([0, 0]);
        let openings = openings(scene);
        let name = seen.caption();
        let input = room::Input {
            room: [scene.room.width, scene.room.depth, scene.room.height],
            apertures: &openings,
            nx,
            ny,
            cells: self.cells.get(shown.revision, || figures.map_or_else(Vec::new, cells)),
            listed: shown.value.is_some() && figures.is_none(),
            plane_z: scene.sensors.plane.map_or(0.0, |plane| plane.z),
            name: &name,
            range: seen.scale,
            revision: shown.revision,
            status: seen.status_of(shown, Lane::Room),
        };
        for action in room::show(ui, &input, &mut self.view) {
            let room::Action::PlaneMoved(z) = action;
            let mut scene = scene.clone();
            if let Some(plane) = &mut scene.sensors.plane {
                plane.z = z;
            }
            commands.push(Command::Scene(Box::new(scene)));
        }
        seen.numbers.then(|| room::csv(&input))
    }
}
