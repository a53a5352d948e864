//! Luminaire files in tiles: what they hold, what they leave to the host, and the room that they light when read back.

use cfs::compute::estimate::Silent;
use cfs::compute::lid::c_gamma::{Aim, CGammaTable, Step};
use cfs::compute::lid::tiling::Tiling;
use cfs::formats::ies::IesEdition;
use cfs::formats::{LuminaireFormat, eulumdat, ies, luminaire_index};
use cfs::study::luminaire_file::{LidFormat, describe};
use cfs::study::luminaire_set::{LuminaireOptions, LuminaireSet, TileFile, Tiles, make};
use cfs::study::luminaires::{self, words};
use cfs::study::{Library, Scene, SceneFile, Session};
use std::path::Path;

const CLEAR: &str = "{ ideal = \"transparent\", transmittance = 0.7 }";
const OPAL: &str = "{ ideal = \"diffuse\", transmittance = 0.5 }";

fn keys(system: &str, diffuse_horizontal: f64) -> SceneFile {
    SceneFile::parse(&format!(
        r#"
[room]
width = 4.0
depth = 6.0
height = 3.0
reflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}
[[aperture]]
surface = "facade"
origin = [0.6, 1.0]
size = [2.8, 1.5]
reflectance = 0.0
system = {system}
[site]
ground_reflectance = 0.2
[sky]
model = "cie"
type = 12
diffuse_horizontal = {diffuse_horizontal:.1}
sun = {{ altitude = 35.0, azimuth = 170.0, direct_normal = 70000.0 }}
[sensors]
points = [[2.0, 1.5, 0.85], [1.0, 3.5, 0.85], [3.0, 5.0, 0.85]]
"#
    ))
    .expect("a scene")
}

fn resolve(file: &SceneFile) -> Scene {
    Scene::resolve(file, Path::new("."), &Library::default()).expect("a scene")
}

fn files(file: &SceneFile, tiles: Tiles, without_beam: bool) -> LuminaireSet {
    files_as(LuminaireFormat::Ies(IesEdition::Lm63_2002), file, tiles, without_beam)
}

fn files_as(format: LuminaireFormat, file: &SceneFile, tiles: Tiles, without_beam: bool) -> LuminaireSet {
    let format = LidFormat::Luminaire(format);
    let wish = LuminaireOptions { format, aim: None, step: None, tiles, without_beam };
    let text = describe("test.toml", file, std::path::Path::new(""), 0, "2026-03-21");
    let name = |tile: Option<usize>| format!("x_{}.ies", tile.map_or(0, |k| k + 1));
    make(&Session::new(), &resolve(file), 0, &text, &wish, name, &Silent).expect("files")
}

fn write(folder: &Path, set: &LuminaireSet) -> String {
    for file in &set.files {
        std::fs::write(folder.join(&file.row.file), &file.bytes).expect("a file");
    }
    let index = folder.join("x.index.csv");
    std::fs::write(&index, set.index()).expect("an index");
    format!("{{ luminaires = {:?} }}", index.to_string_lossy())
}

#[test]
fn a_room_lit_by_its_own_files_is_the_room() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = keys(OPAL, 10_000.0);
    let set = files(&own, Tiles::Auto, false);
    let reached = set.reached.expect("examined");
    assert!(reached.holds() && reached.fields > 20, "{reached:?}");
    // Light that is the same in all directions: all tiles are alike.
    let held = |file: &TileFile| ies::read(&file.bytes).expect("LM-63").intensity;
    assert!(set.files.iter().all(|file| held(file) == held(&set.files[0])));
    let read = write(folder.path(), &set);
    let back = luminaires::read(&folder.path().join("x.index.csv"), None).expect("an index");
    assert_eq!(words(&back.aperture), words(&resolve(&own).apertures[0].aperture));
    let light = |file: &SceneFile| Session::new().room(&resolve(file), &Silent).expect("a result");
    let (wanted, got) = (light(&own), light(&keys(&read, 10_000.0)));
    assert!((got.flux.value / wanted.flux.value - 1.0).abs() < 1e-3);
    for (a, b) in got.sensors.iter().zip(&wanted.sensors) {
        assert!((a.direct.value / b.direct.value - 1.0).abs() < 0.01, "{a:?} {b:?}");
        assert!((a.interreflected.value / b.interreflected.value - 1.0).abs() < 0.02, "{a:?} {b:?}");
    }
    // Another sky changes nothing.
    let other = light(&keys(&read, 20_000.0));
    for (a, b) in other.sensors.iter().zip(&got.sensors) {
        assert_eq!(a.total().value, b.total().value);
    }
    // Another place is refused.
    let mut moved = keys(&read, 10_000.0);
    moved.aperture[0].origin = [0.4, 1.0];
    let error = Scene::resolve(&moved, Path::new("."), &Library::default()).expect_err("another place").to_string();
    assert!(error.contains("aperture[1].system.luminaires") && error.contains("not the aperture"), "{error}");
}

#[test]
fn a_beam_is_in_the_files_or_left_to_the_host() {
    let own = keys(CLEAR, 10_000.0);
    let lid = Session::new().lid(&resolve(&own), 0, &Silent).expect("a distribution").lid;
    let beam = lid.beam_flux();
    assert!(beam > 1e4, "{beam}");
    let tiling = Tiling { columns: 14, rows: 10 };
    let held = files(&own, Tiles::Fixed(tiling), false);
    assert_eq!((held.files.len(), held.separate_beam), (140, None));
    let sum: f64 = held.files.iter().map(|file| file.row.beam).sum();
    assert!((sum / beam - 1.0).abs() < 1e-6, "{sum} {beam}");
    let flux: f64 = held.files.iter().map(|file| file.row.flux).sum();
    assert!((flux / held.flux.value - 1.0).abs() < 1e-6);
    let reached = held.reached.expect("examined");
    assert!(reached.sum.abs() < 0.01 && reached.rms < 0.02, "{reached:?}");
    let left = files(&own, Tiles::Fixed(tiling), true);
    let apart = left.separate_beam.expect("a straight beam");
    assert!((apart.flux / beam - 1.0).abs() < 1e-9 && left.files.iter().all(|file| file.row.beam == 0.0));
    assert!(((left.flux.value + apart.flux) / held.flux.value - 1.0).abs() < 1e-3);
    // From the south-south-east, 35° high, into a room that faces south.
    let (sin, cos) = 35_f64.to_radians().sin_cos();
    assert!((apart.direction.z + sin).abs() < 1e-4 && apart.direction.y > 0.98 * cos, "{:?}", apart.direction);
    assert!((apart.normal / 49_000.0 - 1.0).abs() < 1e-3);
    let header = String::from_utf8(left.files[9].bytes.clone()).expect("ASCII").replace("\r\n[MORE]", "");
    for gist in ["tile 10 of 140", "14 x 10 tiles", "Without direct sunlight", "rms", "sun 35.0/170.0"] {
        assert!(header.contains(gist), "{gist}");
    }
}

#[test]
fn what_is_written_is_read_again() {
    let own = keys(CLEAR, 10_000.0);
    let lid = Session::new().lid(&resolve(&own), 0, &Silent).expect("a distribution").lid;
    let table = CGammaTable::new(&lid, Aim::Mounted, Step::FINE);
    let peak = table.intensity.iter().copied().fold(0.0, f64::max);
    let [ldt, ies_2002] = LuminaireFormat::ALL;
    for format in [ldt, ies_2002, LuminaireFormat::Ies(IesEdition::Lm63_2019)] {
        let one = files_as(format, &own, Tiles::None, false);
        assert_eq!((one.files.len(), one.step), (1, Step::FINE));
        let back = format.read(&one.files[0].bytes).expect("a luminaire");
        assert_eq!(back.intensity.len(), table.intensity.len());
        for (got, wanted) in back.intensity.iter().zip(&table.intensity) {
            assert!((got - wanted).abs() <= 1e-4 * peak, "{got} {wanted}");
        }
    }
    // Tiles hold the same in both formats, and the index what they hold and where they are.
    let tiles = Tiles::Fixed(Tiling { columns: 3, rows: 2 });
    let sets = [ldt, ies_2002].map(|of| files_as(of, &own, tiles, false));
    for (ldt, ies) in sets[0].files.iter().zip(&sets[1].files) {
        let (a, b) = (eulumdat::read(&ldt.bytes).expect("EULUMDAT"), ies::read(&ies.bytes).expect("LM-63"));
        let peak = a.peak();
        assert!(a.intensity.iter().zip(&b.intensity).all(|(a, b)| (a - b).abs() <= 1e-4 * peak));
    }
    let rows = luminaire_index::read(&sets[0].index()).expect("an index");
    assert_eq!(rows.len(), 6);
    for (row, file) in rows.iter().zip(&sets[0].files) {
        assert!(row.centre.distance(file.row.centre) < 1e-6 && (row.flux / file.row.flux - 1.0).abs() < 1e-6);
        assert_eq!((&row.file, row.surface, row.aim), (&file.row.file, file.row.surface, file.row.aim));
        let held = eulumdat::read(&file.bytes).expect("EULUMDAT").flux();
        assert!((held / row.flux - 1.0).abs() < 1e-3, "{held} {}", row.flux);
    }
}
