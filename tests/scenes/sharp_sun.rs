//! The sun's beams in the room: closed forms, states that shut the sun out, every way to the same system, and the public
//! cases of real geometry.

use crate::common::data;
use crate::rooms::compute;
use cfs::compute::system::panes::glazing::{Pane, stack};
use cfs::compute::system::slats::{SlatArray, SlatProfile, Surface};
use cfs::study::{Library, RoomResult, Scene, SceneFile, load_scene};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// A folder of its own for a test's files, removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let folder = std::env::temp_dir().join(format!("cfs-sharp-sun-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for (file, text) in files {
            std::fs::write(folder.join(file), text).unwrap();
        }
        Self(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        drop(std::fs::remove_dir_all(&self.0));
    }
}

const PANE: &str = "name = \"Pane\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\nabsorption = 0.0\n";
const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\n\
    angles = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0]\nupper = { reflectance = 0.7 }\nlower = { reflectance = 0.7 }\n";

/// Sun alone, black room, a line of sensors on the work plane.
fn text(system: &str, sun: [f64; 2], more: &str) -> String {
    format!(
        "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\nreflectance = {{ floor = 0.0, walls = 0.0, ceiling = 0.0 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 1.0]\nsize = [3.0, 1.6]\nsystem = {system}\n\
         [site]\nazimuth = 180.0\n[sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 0.0\n\
         sun = {{ altitude = {}, azimuth = {}, direct_normal = 70000.0 }}\n\
         [sensors]\npoints = [[2.0, 0.4, 0.85], [2.0, 1.0, 0.85], [2.0, 3.0, 0.85], [2.0, 5.5, 0.85]]\n\
         normal = [0.0, 0.0, 1.0]\n{more}",
        sun[0], sun[1]
    )
}

fn room(text: &str, base: &Path) -> RoomResult {
    let file = SceneFile::parse(text).unwrap();
    compute(&Scene::resolve(&file, base, &Library::default()).unwrap())
}

#[test]
fn a_pane_lets_its_sharp_share_through() {
    let folder = Folder::new("pane", &[("pane.system.toml", PANE)]);
    let result = room(&text("{ file = \"pane.system.toml\" }", [40.0, 180.0], ""), &folder.0);
    // tan 40° = 0.839: the patch on a plane 0.15 … 1.75 m below the opening's edges lies 0.18 … 2.09 m deep.
    let tau = stack(&[Pane { index: 1.52, thickness: 0.004, absorption: 0.0 }], 40_f64.to_radians()).transmitted;
    let lit = 70_000.0 * tau * 40_f64.to_radians().sin();
    for (sensor, expected) in result.sensors.iter().zip([lit, lit, 0.0, 0.0]) {
        assert!((sensor.beam - expected).abs() <= 1e-5 * lit, "{} {expected}", sensor.beam);
        assert!((sensor.total().value - expected).abs() <= sensor.total().error + 1e-5 * lit);
        assert_eq!(sensor.data_error, 0.0);
    }
}

#[test]
fn slats_that_cover_the_disc_leave_no_beam_at_any_hour() {
    let folder = Folder::new("cut-off", &[("blind.system.toml", BLIND)]);
    let flat = SlatProfile::Flat { width: 0.08 };
    let control = "[control]\nmode = \"cut-off\"\n";
    let system = "{ file = \"blind.system.toml\", state = \"controlled\" }";
    let suns: Vec<[f64; 2]> =
        (1..17).flat_map(|h| (0..9).map(move |a| [f64::from(4 * h), f64::from(100 + 20 * a)])).collect();
    let library = Library::default();
    let shut = suns
        .par_iter()
        .filter(|&&sun| {
            let file = SceneFile::parse(&text(system, sun, control)).unwrap();
            let scene = Scene::resolve(&file, &folder.0, &library).unwrap();
            let angle: f64 = scene.apertures[0].controlled.as_ref().unwrap().parse().unwrap();
            let matt = [Surface::matt(0.7); 2];
            let slats = SlatArray::new(flat.clone(), 0.0, 0.072, angle.to_radians(), matt).unwrap();
            let direction = scene.facing(0).sun_direction().unwrap().vector();
            // Over the disc, which is a little larger in the profile angle than the sun is.
            let covered = (0..64).all(|k| {
                let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 64.0).sin_cos();
                let (u, v) = direction.any_orthonormal_pair();
                let d = (direction + 0.0047 * (cos * u + sin * v)).normalize();
                d.z <= 0.0 || slats.direct_share(d.y.atan2(d.z)) == 0.0
            });
            let result = compute(&scene);
            let beam: f64 = result.sensors.iter().map(|sensor| sensor.beam).sum();
            assert!(!covered || beam == 0.0, "{sun:?} at {angle}°: {beam} lx");
            covered
        })
        .count();
    assert!(shut > suns.len() / 2, "the control shuts the sun out in {shut} of {} positions", suns.len());
}

#[test]
fn every_way_to_a_described_system_gives_the_same_light() {
    use cfs::study::goniophotometer::Described;
    let folder = Folder::new("ways", &[("blind.system.toml", BLIND)]);
    let sun = [31.0, 195.0];
    let direct = room(&text("{ file = \"blind.system.toml\", state = \"15\" }", sun, ""), &folder.0);
    let described = Described::read(&folder.0.join("blind.system.toml")).unwrap();
    let request = cfs::study::by_description::request();
    let made = described.measure("15", &request, &Library::default(), None, &cfs::compute::estimate::Silent).unwrap();
    let xml = cfs::formats::write_dataset(cfs::formats::Format::BsdfXml, std::slice::from_ref(&made.dataset)).unwrap();
    std::fs::write(folder.0.join("blind.xml"), &xml.bytes).unwrap();
    let by_xml = room(&text("{ file = \"blind.xml\" }", sun, ""), &folder.0);
    for (a, b) in direct.sensors.iter().zip(&by_xml.sensors) {
        assert!((a.direct.value - b.direct.value).abs() <= 1e-9 * a.direct.value, "{a:?} {b:?}");
        assert!((a.beam - b.beam).abs() <= 1e-9 * a.beam);
    }
    // Taken at its word the file smears the beam over its cell, and says nothing else.
    let patch = room(&text("{ file = \"blind.xml\" }", sun, "[compute]\ninterpolation = \"patch\"\n"), &folder.0);
    assert!(patch.sensors.iter().all(|sensor| sensor.beam == 0.0 && sensor.data_error == 0.0));
    assert!(direct.sensors[0].beam > 0.0);
}

#[test]
fn a_state_that_is_not_there_is_told() {
    let folder = Folder::new("state", &[("blind.system.toml", BLIND), ("pane.system.toml", PANE)]);
    let told = |system: &str| {
        let file = SceneFile::parse(&text(system, [30.0, 180.0], "")).unwrap();
        Scene::resolve(&file, &folder.0, &Library::default()).unwrap_err().to_string()
    };
    let blind = told("{ file = \"blind.system.toml\", state = \"20\" }");
    assert!(blind.contains("no state '20'") && blind.contains("0, 15, 30"), "{blind}");
    let pane = told("{ file = \"pane.system.toml\", state = \"20\" }");
    assert!(pane.contains("no states"), "{pane}");
}

#[test]
fn the_plan_speaks_of_the_description() {
    let folder = Folder::new("plan", &[("blind.system.toml", BLIND)]);
    let system = "{ file = \"blind.system.toml\", state = \"15\" }";
    let lit = text(system, [30.0, 180.0], "").replace("diffuse_horizontal = 0.0", "diffuse_horizontal = 8000.0");
    let result = room(&lit, &folder.0);
    let reason = |name: &str| {
        let stage = result.plan.stages.iter().find(|stage| stage.name == name).unwrap();
        stage.reason.clone()
    };
    assert!(result.plan.runs("description"));
    assert!(reason("cells").contains("description") && reason("seen through").contains("description"));
    assert!(result.sensors.iter().all(|sensor| sensor.direct.value > 0.0));
}

#[test]
fn in_a_black_room_one_aperture_lights_the_other() {
    let folder = Folder::new("two", &[("blind.system.toml", BLIND)]);
    let blind = text("{ file = \"blind.system.toml\", state = \"75\" }", [30.0, 180.0], "");
    let roof = "[[aperture]]\nsurface = \"roof\"\norigin = [0.5, 0.5]\nsize = [3.0, 3.0]\n\
        system = { ideal = \"diffuse\", transmittance = 0.5 }\n[site]";
    let both = room(&blind.replace("[site]", roof), &folder.0);
    let reflected: f64 = both.sensors.iter().map(|sensor| sensor.interreflected.value).sum();
    assert!(reflected > 1.0, "the blind throws back what comes through the roof: {reflected} lx");
}

#[test]
fn the_sun_on_the_rim_counts_as_far_as_it_shines() {
    // Slats that begin to open at the disc's middle: half of it looks through.
    let folder = Folder::new("rim", &[("blind.system.toml", BLIND)]);
    let edge = (0.072_f64 / 0.08).atan().to_degrees();
    let at = |altitude: f64| {
        room(&text("{ file = \"blind.system.toml\", state = \"0\" }", [altitude, 180.0], ""), &folder.0).sensors[1].beam
    };
    assert_eq!(at(edge + 0.3), 0.0);
    let (rim, below) = (at(edge), at(edge - 1.0));
    assert!(rim > 0.0 && below > rim, "{rim} {below}");
    // Below the edge the share is 1 − w/s tanψ: from the disc's middle on it grows by w/(s cos²ψ), whose mean over half a disc
    // of radius r is 4r/3π of it.
    let slope = 0.08 / 0.072 / edge.to_radians().cos().powi(2);
    let mean = 0.5 * slope * 0.2665_f64.to_radians() * 4.0 / (3.0 * std::f64::consts::PI);
    let expected = 70_000.0 * edge.to_radians().sin() * mean;
    assert!((rim / expected - 1.0).abs() < 0.01, "{rim} {expected}");
}

#[test]
fn real_geometry() {
    let Some(cases) = data("reference/cases/beam") else { return };
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(&cases)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml") && path.with_extension("csv").exists())
        .collect();
    scenes.sort();
    assert!(scenes.len() >= 70);
    let library = Library::default();
    // Σ|ΔE|/ΣE beyond the reference's own uncertainty, sensors, and those inside the stated error.
    let outcomes: Vec<(String, f64, usize, usize)> = scenes
        .par_iter()
        .map(|path| {
            let result = compute(&load_scene(path, &library).unwrap());
            let rows: Vec<HashMap<String, f64>> = csv::Reader::from_path(path.with_extension("csv"))
                .unwrap()
                .deserialize()
                .collect::<Result<_, _>>()
                .unwrap();
            let (mut apart, mut sum, mut held) = (0.0, 0.0, 0);
            for (row, sensor) in rows.iter().zip(&result.sensors) {
                let (got, want, u) = (sensor.total(), row["E_lx"], row["E_error_lx"]);
                apart += (got.value - want).abs() - u;
                sum += want;
                held += usize::from((got.value - want).abs() <= got.error + u + 1e-3);
            }
            (path.file_stem().unwrap().to_string_lossy().into_owned(), (apart / sum).max(0.0), rows.len(), held)
        })
        .collect();
    let mut errors: Vec<f64> = outcomes.iter().map(|(_, error, ..)| *error).collect();
    errors.sort_by(f64::total_cmp);
    let (sensors, held) = outcomes.iter().fold((0, 0), |(n, h), (_, _, sensors, held)| (n + sensors, h + held));
    let worst = outcomes.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    println!("beams: median {:.2e}, worst {:.2e} ({}), {held} of {sensors} held", errors[35], worst.1, worst.0);
    assert!(errors[errors.len() / 2] < 1e-3 && worst.1 < 0.03, "{worst:?}");
    assert!(100 * held >= 95 * sensors, "{held} of {sensors} sensors inside the stated error");
}
