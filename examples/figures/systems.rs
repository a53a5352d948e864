//! Analytic systems, sampled as by a goniophotometer, and the scenes that contain them. Used by the pictures and by the
//! test of their numbers.

#![allow(dead_code, reason = "the pictures and the test each use their own part")]

use anyhow::Result;
use cfs::compute::basis::{AzimuthMap, Ring, RingBasis};
use cfs::compute::btdf::{AngularTransmittance, Btdf, CellMatrix, Dataset, Indicatrices, Scattered};
use cfs::compute::direction::{Dir, Facade, Incident, Surface};
use cfs::compute::estimate::Silent;
use cfs::compute::system::laser_cut::deflected_share;
use cfs::study::control::ControlQuestion;
use cfs::study::scene_file::SystemKeys;
use cfs::study::system::Need;
use cfs::study::{LidResult, RoomResult, Scene, SceneFile, Session, StudyError, System, SystemLibrary};
use glam::DVec3;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::{Arc, LazyLock};

/// Light that leaves around a through direction `centre`, with standard deviation `sigma` \[rad\] and a share `flux`.
#[derive(Debug, Clone, Copy)]
pub struct Lobe {
    pub flux: f64,
    pub centre: DVec3,
    pub sigma: f64,
}

/// Law of scattering: returns the lobes for an incident direction, and the share that is scattered uniformly.
pub type Law = fn(Dir<Facade>) -> (Vec<Lobe>, f64);

/// Returns the light of an open aperture as measured by an instrument with a beam of 1° (standard deviation).
pub fn clear(d: Dir<Facade>) -> (Vec<Lobe>, f64) {
    (vec![Lobe { flux: 1.0, centre: d.vector(), sigma: 1_f64.to_radians() }], 0.0)
}

/// Returns the light of an open aperture as measured by an instrument with a beam of 2° (standard deviation).
pub fn clear_2(d: Dir<Facade>) -> (Vec<Lobe>, f64) {
    (vec![Lobe { flux: 1.0, centre: d.vector(), sigma: 2_f64.to_radians() }], 0.0)
}

/// Returns the light of a pane that scatters around the undeviated direction with a standard deviation of 10°.
pub fn scattering(d: Dir<Facade>) -> (Vec<Lobe>, f64) {
    (vec![Lobe { flux: 0.9, centre: d.vector(), sigma: 10_f64.to_radians() }], 0.0)
}

/// Returns the light of a diffuser without a preferred direction.
pub fn opal(_: Dir<Facade>) -> (Vec<Lobe>, f64) {
    (Vec::new(), 0.5)
}

/// Returns the light of a light-redirecting glass: of light from above, a share after Edmonds is redirected upwards and
/// spread, the rest is undeviated; a tenth of all light is haze.
pub fn redirecting(d: Dir<Facade>) -> (Vec<Lobe>, f64) {
    let v = d.vector();
    let inner = (1.0 - v.truncate().length_squared() / 2.25).sqrt();
    let turned = if v.y > 0.0 { deflected_share(0.9 * (v.y / 1.5) / inner) } else { 0.0 };
    let y = -0.75 * v.y;
    let up = DVec3::new(v.x, y, (1.0 - v.x * v.x - y * y).max(0.0).sqrt());
    let tau = 0.85 * (1.0 - (1.0 - v.z).powi(4));
    let lobes = vec![
        Lobe { flux: 0.9 * tau * (1.0 - turned), centre: v, sigma: 2.5_f64.to_radians() },
        Lobe { flux: 0.9 * tau * turned, centre: up, sigma: 4_f64.to_radians() },
    ];
    (lobes.into_iter().filter(|lobe| lobe.flux > 0.0).collect(), 0.1 * tau)
}

/// Returns the luminance coefficients q of one incident direction as cell means; the flux of every lobe is exact.
/// \[1/sr\]
pub fn indicatrix(basis: &RingBasis, law: Law, d: Dir<Facade>) -> Vec<f64> {
    let (lobes, even) = law(d);
    let mut q = vec![even / PI; basis.len()];
    for lobe in lobes {
        let own: Vec<f64> = basis.cells().map(|cell| mean_of(&lobe, &cell)).collect();
        let flux: f64 = own.iter().zip(basis.projected_solid_angles()).map(|(q, w)| q * w).sum();
        q.iter_mut().zip(own).for_each(|(q, own)| *q += lobe.flux * own / flux);
    }
    q
}

/// Returns the mean of a lobe (not normalised) over a cell.
fn mean_of(lobe: &Lobe, cell: &cfs::compute::basis::Cell) -> f64 {
    let reach = 6.0 * lobe.sigma + 2.0 * cell.solid_angle().sqrt();
    if (cell.centre().vector() - lobe.centre).length() > reach {
        return 0.0;
    }
    cfs::compute::basis::cell_mean(cell, 4, |w| ((w.vector().dot(lobe.centre) - 1.0) / lobe.sigma.powi(2)).exp())
}

/// Samples a law at the incident directions of a lattice.
pub fn measured(lattice: &RingBasis, emergent: &RingBasis, law: Law) -> Indicatrices {
    let incident: Vec<Incident> = lattice.cells().map(|cell| Incident(cell.centre())).collect();
    let values = incident.iter().flat_map(|d| indicatrix(emergent, law, d.0)).collect();
    Indicatrices::new(incident, emergent.clone(), values).expect("one row a direction, all directions differ")
}

/// Creates a dataset from front transmission data.
pub fn dataset(name: &str, transmission: Btdf) -> Dataset {
    let mut dataset = Dataset { name: name.to_owned(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(transmission);
    dataset
}

/// Creates a dataset from indicatrices.
pub fn of_directions(name: &str, data: Indicatrices) -> Dataset {
    dataset(name, Btdf { regular: None, scattered: Some(Scattered::Directions(Arc::new(data))) })
}

/// Returns the open aperture: regular transmission of 1.
pub fn open() -> Dataset {
    dataset("open", Btdf { regular: Some(AngularTransmittance::Constant(1.0)), scattered: None })
}

/// Returns the ideal diffuser.
pub fn diffuser() -> Dataset {
    dataset(
        "diffuser",
        Btdf { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(1.0))) },
    )
}

/// Returns the open aperture as patch-averaged data: light of every cell stays in that cell.
pub fn open_cells(basis: &RingBasis) -> Dataset {
    let n = basis.len();
    let mut values = vec![0.0; n * n];
    for (k, weight) in basis.projected_solid_angles().into_iter().enumerate() {
        values[k * n + k] = 1.0 / weight;
    }
    let matrix = CellMatrix::new(basis.clone(), basis.clone(), values).expect("n² values for n cells");
    dataset("open, by cells", Btdf::from_cells(matrix))
}

/// Returns an aperture measured at a lattice of incident directions, on emergent cells in `rings` rings.
pub fn open_measured(lattice: &RingBasis, rings: usize, law: Law) -> Dataset {
    of_directions("open, measured", measured(lattice, &RingBasis::equal_area(rings), law))
}

/// Returns a system that spreads a beam at `altitude`, perpendicular to the façade in plan, in altitude alone, as a
/// normal distribution with standard deviation `sigma`. \[rad\]
pub fn spread_beam(altitude: f64, sigma: f64) -> Dataset {
    let steps = 160;
    let edge = |k: i32| (altitude + sigma * f64::from(k) / 20.0).clamp(1e-3, 0.5 * PI - 1e-3);
    let rings: Vec<Ring> = (-steps / 2..steps / 2)
        .map(|k| Ring { theta_min: edge(k), theta_max: edge(k + 1), sectors: 180, first_phi: 0.5 * PI })
        .filter(|ring| ring.theta_max > ring.theta_min)
        .collect();
    let basis = RingBasis::new("beam", rings, AzimuthMap::FACADE).expect("rings rise");
    let share = |cell: &cfs::compute::basis::Cell| {
        let middle = 0.5 * (cell.theta_min + cell.theta_max);
        (-0.5 * ((middle - altitude) / sigma).powi(2)).exp() * (cell.theta_max - cell.theta_min)
    };
    let up = |cell: &cfs::compute::basis::Cell| (cell.phi - 0.5 * PI).abs() < 1e-9;
    let total: f64 = basis.cells().filter(up).map(|cell| share(&cell)).sum();
    let values =
        basis.cells().map(|cell| if up(&cell) { share(&cell) / total / cell.projected_solid_angle() } else { 0.0 });
    let values = values.collect();
    let towards = Incident(Dir::from_theta_phi(altitude, 0.5 * PI));
    let data = Indicatrices::new(vec![towards], basis, values).expect("one row");
    of_directions("beam", data)
}

/// Room whose apertures all have the same system.
#[derive(Debug, Clone)]
pub struct Place {
    pub size: [f64; 3],
    /// Surface, origin and size of every aperture.
    pub apertures: Vec<(Surface, [f64; 2], [f64; 2])>,
    pub ground: f64,
    pub sky: String,
    pub points: Vec<[f64; 3]>,
    pub reflectance: [f64; 3],
    /// Additional keys of `[compute]`.
    pub compute: &'static str,
}

/// Returns the side-lit model room: 4 × 6 × 3 m, aperture of 4 × 2 m from 1 m height to the ceiling.
pub fn side_lit(sky: &str, points: Vec<[f64; 3]>) -> Place {
    Place {
        size: [4.0, 6.0, 3.0],
        apertures: vec![(Surface::Facade, [0.0, 1.0], [4.0, 2.0])],
        ground: 0.2,
        sky: sky.to_owned(),
        points,
        reflectance: [0.0; 3],
        compute: "",
    }
}

/// Returns the top-lit model room: 4 × 6 × 3 m, aperture of 2 × 2 m in the middle of the roof.
pub fn top_lit(sky: &str, points: Vec<[f64; 3]>) -> Place {
    Place { apertures: vec![(Surface::Roof, [1.0, 2.0], [2.0, 2.0])], ..side_lit(sky, points) }
}

/// CIE overcast sky, 10 klx.
pub const OVERCAST: &str = "model = \"cie\"\ntype = 16\ndiffuse_horizontal = 10000.0";
/// CIE clear sky without solar disc, the sun at 20°, perpendicular to the façade in plan.
pub const CLEAR: &str = "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 10000.0\n\
                         sun = { altitude = 20.0, azimuth = 180.0, direct_normal = 0.0 }";
/// Uniform sky; with a ground that reflects everything, the luminance is the same in all directions.
pub const UNIFORM: &str = "model = \"uniform\"\ndiffuse_horizontal = 10000.0";

/// Returns a sky of direct sun alone, perpendicular to the façade in plan, with 80 klx direct normal illuminance.
pub fn sun_alone(altitude: f64) -> String {
    format!(
        "model = \"uniform\"\ndiffuse_horizontal = 0.0\n\
         sun = {{ altitude = {altitude:?}, azimuth = 180.0, direct_normal = 80000.0 }}"
    )
}

struct Only(Arc<Dataset>);

impl SystemLibrary for Only {
    fn load(&self, _: &SystemKeys, _: &Path, _: Need) -> Result<Arc<System>, StudyError> {
        Ok(Arc::new(System {
            label: self.0.name.clone(),
            state: String::new(),
            dataset: Arc::clone(&self.0),
            model: None,
        }))
    }

    fn controlled_state(&self, _: &str, _: &ControlQuestion<'_>) -> Result<String, StudyError> {
        Err(StudyError::key("system", "no states here"))
    }
}

impl Place {
    /// Creates the scene with a system in all apertures.
    pub fn scene(&self, system: &Arc<Dataset>) -> Result<Scene> {
        let ([w, d, h], [floor, walls, ceiling]) = (self.size, self.reflectance);
        let openings: String = self
            .apertures
            .iter()
            .map(|(surface, origin, size)| {
                let surface = if *surface == Surface::Facade { "facade" } else { "roof" };
                format!(
                    "[[aperture]]\nsurface = \"{surface}\"\norigin = {origin:?}\nsize = {size:?}\n\
                     system = {{ catalogue = \"made\" }}\n"
                )
            })
            .collect();
        let bounce = self.reflectance != [0.0; 3];
        let text = format!(
            "[room]\nwidth = {w:?}\ndepth = {d:?}\nheight = {h:?}\n\
             reflectance = {{ floor = {floor:?}, walls = {walls:?}, ceiling = {ceiling:?} }}\n{openings}\
             [site]\nazimuth = 180.0\nground_reflectance = {:?}\n[sky]\n{}\n\
             [sensors]\npoints = {:?}\nnormal = [0.0, 0.0, 1.0]\n[compute]\ninterreflection = {bounce}\n{}\n",
            self.ground, self.sky, self.points, self.compute
        );
        Ok(Scene::resolve(&SceneFile::parse(&text)?, Path::new("."), &Only(Arc::clone(system)))?)
    }

    /// Computes the illuminances of the points. \[lx\]
    pub fn room(&self, system: &Arc<Dataset>) -> Result<RoomResult> {
        Ok(SESSION.room(&self.scene(system)?, &Silent)?)
    }

    /// Computes the luminous intensity distribution of the first aperture. Patch-averaged data are used as given:
    /// regular transmission is not recognised in them.
    pub fn lid(&self, system: &Arc<Dataset>) -> Result<(Scene, LidResult)> {
        let scattered = system.visible.transmission_front.as_ref().and_then(|btdf| btdf.scattered.as_ref());
        let compute = match scattered {
            Some(Scattered::Cells(_)) => "interpolation = \"patch\"",
            _ => self.compute,
        };
        let scene = Self { compute, ..self.clone() }.scene(system)?;
        let light = SESSION.lid(&scene, 0, &Silent)?;
        Ok((scene, light))
    }
}

static SESSION: LazyLock<Session> = LazyLock::new(Session::new);

/// Returns the total illuminances. \[lx\]
pub fn totals(result: &RoomResult) -> Vec<f64> {
    result.sensors.iter().map(|sensor| sensor.total().value).collect()
}

/// Returns points at the given depths. \[m\]
pub fn along(x: f64, z: f64, depths: impl IntoIterator<Item = f64>) -> Vec<[f64; 3]> {
    depths.into_iter().map(|y| [x, y, z]).collect()
}
