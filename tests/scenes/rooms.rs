//! Helpers of the tests that compute whole scenes: scene texts, systems made in code, dense sensors on all surfaces.

#![allow(dead_code, reason = "every test crate uses its own part")]

use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset};
use cfs::compute::direction::{Dir, Facade};
use cfs::compute::estimate::Silent;
use cfs::compute::room::direct::Sensor;
use cfs::study::control::ControlQuestion;
use cfs::study::scene_file::SystemKeys;
use cfs::study::system::{Need, ideal};
use cfs::study::{RoomResult, Scene, SceneFile, Session, StudyError, System, SystemLibrary};
use glam::DVec3;
use std::path::Path;
use std::sync::{Arc, LazyLock};

/// The parts of a scene's text that tests vary; the rest is the ordinary room.
#[derive(Clone)]
pub struct Text {
    pub room: [f64; 3],
    pub reflectance: [f64; 3],
    /// Bodies of the `[[aperture]]` sections.
    pub apertures: Vec<String>,
    pub azimuth: f64,
    pub ground: f64,
    pub sky: String,
    pub sensors: String,
    pub compute: String,
}

impl Default for Text {
    fn default() -> Self {
        Self {
            room: [4.0, 6.0, 3.0],
            reflectance: [0.0; 3],
            apertures: vec![facade([0.5, 1.0], [3.0, 1.5], TRANSPARENT)],
            azimuth: 180.0,
            ground: 0.0,
            sky: OVERCAST.into(),
            sensors: "plane = { z = 0.85, nx = 4, ny = 6 }".into(),
            compute: String::new(),
        }
    }
}

pub const TRANSPARENT: &str = "{ ideal = \"transparent\", transmittance = 1.0 }";
pub const DIFFUSE: &str = "{ ideal = \"diffuse\", transmittance = 1.0 }";
/// Stands for the dataset given to [`Made`].
pub const MADE: &str = "{ catalogue = \"made\" }";
pub const OVERCAST: &str = "model = \"cie\"\ntype = 16\ndiffuse_horizontal = 10000.0";
pub const UNIFORM: &str = "model = \"uniform\"\ndiffuse_horizontal = 10000.0";

/// A clear sky with its sun.
pub fn clear(altitude: f64, azimuth: f64, direct_normal: f64) -> String {
    format!(
        "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 12000.0\n\
         sun = {{ altitude = {altitude:?}, azimuth = {azimuth:?}, direct_normal = {direct_normal:?} }}"
    )
}

/// Nothing but a sun.
pub fn sun_alone(altitude: f64, azimuth: f64) -> String {
    format!(
        "model = \"uniform\"\ndiffuse_horizontal = 0.0\n\
         sun = {{ altitude = {altitude:?}, azimuth = {azimuth:?}, direct_normal = 80000.0 }}"
    )
}

/// Body of an aperture in the façade.
pub fn facade(origin: [f64; 2], size: [f64; 2], system: &str) -> String {
    format!("surface = \"facade\"\norigin = {origin:?}\nsize = {size:?}\nsystem = {system}")
}

/// Body of an aperture in the roof.
pub fn roof(origin: [f64; 2], size: [f64; 2], system: &str) -> String {
    format!("surface = \"roof\"\norigin = {origin:?}\nsize = {size:?}\nsystem = {system}")
}

/// `[sensors]` from points with one normal.
pub fn points(list: &[[f64; 3]], normal: [f64; 3]) -> String {
    format!("points = {list:?}\nnormal = {normal:?}")
}

impl Text {
    pub fn toml(&self) -> String {
        let ([w, d, h], [floor, walls, ceiling]) = (self.room, self.reflectance);
        let apertures: String = self.apertures.iter().map(|body| format!("[[aperture]]\n{body}\n")).collect();
        format!(
            "[room]\nwidth = {w:?}\ndepth = {d:?}\nheight = {h:?}\n\
             reflectance = {{ floor = {floor:?}, walls = {walls:?}, ceiling = {ceiling:?} }}\n{apertures}\
             [site]\nazimuth = {:?}\nground_reflectance = {:?}\n[sky]\n{}\n[sensors]\n{}\n[compute]\n{}\n",
            self.azimuth, self.ground, self.sky, self.sensors, self.compute
        )
    }

    /// Resolved with ideal systems alone.
    pub fn scene(&self) -> Scene {
        self.resolve(&Made(None)).unwrap_or_else(|e| panic!("{e}\n{}", self.toml()))
    }

    /// Resolved; the catalogue key `made` is the given system.
    pub fn scene_with(&self, dataset: Dataset) -> Scene {
        self.resolve(&Made(Some(dataset))).unwrap_or_else(|e| panic!("{e}\n{}", self.toml()))
    }

    pub fn resolve(&self, library: &dyn SystemLibrary) -> Result<Scene, StudyError> {
        Scene::resolve(&SceneFile::parse(&self.toml())?, Path::new("."), library)
    }

    pub fn result(&self) -> RoomResult {
        compute(&self.scene())
    }
}

/// Ideal systems, and one made in code.
pub struct Made(pub Option<Dataset>);

impl SystemLibrary for Made {
    fn load(&self, keys: &SystemKeys, _base: &Path, _: Need) -> Result<Arc<System>, StudyError> {
        match (keys, &self.0) {
            (SystemKeys::Ideal { kind, transmittance }, _) => ideal(*kind, *transmittance),
            (_, Some(dataset)) => Ok(Arc::new(System {
                label: "made".into(),
                state: String::new(),
                dataset: Arc::new(dataset.clone()),
                model: None,
            })),
            _ => Err(StudyError::key("system", "this test has no such system")),
        }
    }

    fn controlled_state(&self, _: &str, _: &ControlQuestion<'_>) -> Result<String, StudyError> {
        Err(StudyError::key("system", "this test has no catalogue"))
    }
}

/// With a session that has seen all scenes of the test program before, as the window's has.
pub fn compute(scene: &Scene) -> RoomResult {
    static SESSION: LazyLock<Session> = LazyLock::new(Session::new);
    SESSION.room(scene, &Silent).unwrap_or_else(|e| panic!("{e}"))
}

/// Illuminances alone. [lx]
pub fn totals(result: &RoomResult) -> Vec<f64> {
    result.sensors.iter().map(|sensor| sensor.total().value).collect()
}

/// A dataset on a Klems basis, both sides counted as files count light from outside.
pub fn klems(q: impl Fn(Dir<Facade>, Dir<Facade>) -> f64) -> Dataset {
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let centres: Vec<Dir<Facade>> = basis.cells().map(|cell| cell.centre()).collect();
    let values = centres.iter().flat_map(|&i| centres.iter().map(move |&o| (i, o))).map(|(i, o)| q(i, o)).collect();
    from_matrix(CellMatrix::new(basis.clone(), basis, values).unwrap())
}

pub fn from_matrix(matrix: CellMatrix) -> Dataset {
    let mut dataset = Dataset { name: "made".into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::from_cells(matrix));
    dataset
}

/// Values without any symmetry, τ about 0.5, the same on every run.
pub fn rough(i: Dir<Facade>, o: Dir<Facade>) -> f64 {
    let (i, o) = (i.vector(), o.vector());
    let wave = (7.3 * i.x + 11.9 * i.y + 5.1 * o.x - 8.7 * o.y + 3.3 * i.x * o.y).sin();
    0.16 * (1.0 + 0.9 * wave)
}

/// The system that sends the light of every cell straight on, spread over the cell.
pub fn straight_cells() -> Dataset {
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let n = basis.len();
    let mut values = vec![0.0; n * n];
    for (k, weight) in basis.projected_solid_angles().into_iter().enumerate() {
        values[k * n + k] = 1.0 / weight;
    }
    from_matrix(CellMatrix::new(basis.clone(), basis, values).unwrap())
}

/// Sensors at the midpoints of n × n cells on all six sides, facing the room; with the area of each. [m²]
pub fn on_all_sides(size: DVec3, n: usize) -> Vec<(Sensor, f64)> {
    let mut list = Vec::with_capacity(6 * n * n);
    for axis in 0..3 {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        for high in [false, true] {
            let mut normal = DVec3::ZERO;
            normal[axis] = if high { -1.0 } else { 1.0 };
            for i in 0..n * n {
                let mut position = DVec3::ZERO;
                position[axis] = if high { size[axis] } else { 0.0 };
                position[a] = size[a] * ((i % n) as f64 + 0.5) / n as f64;
                position[b] = size[b] * ((i / n) as f64 + 0.5) / n as f64;
                list.push((Sensor { position, normal }, size[a] * size[b] / (n * n) as f64));
            }
        }
    }
    list
}
