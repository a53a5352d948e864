//! Readers of scenes, system files, kept sessions and of what people type.

use super::choices::Choices;
use super::{again, edits, told};
use cfs::app::session::Kept;
use cfs::app::shell::typing;
use cfs::app::tiles::{Layout, TILES};
use cfs::formats::encoding::decode;
use cfs::formats::{system_toml, toml_place};
use cfs::study::control::ControlQuestion;
use cfs::study::scene_file::SystemKeys;
use cfs::study::sun_position::parse_local_time;
use cfs::study::system::{Need, ideal};
use cfs::study::{Scene, SceneFile, StudyError, System, SystemLibrary, moment};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

/// Sensors and boxes up to which a scene is resolved here: what stands outside is lit then, which is computing.
const FEW: usize = 4;

/// Closed forms alone; no files, no catalogue.
struct NoFiles;

impl SystemLibrary for NoFiles {
    fn load(&self, keys: &SystemKeys, _: &Path, _: Need) -> Result<Arc<System>, StudyError> {
        match keys {
            SystemKeys::Ideal { kind, transmittance } => ideal(*kind, *transmittance),
            _ => Err(StudyError::Catalogue("none at hand".to_owned())),
        }
    }

    fn controlled_state(&self, product: &str, _: &ControlQuestion<'_>) -> Result<String, StudyError> {
        Err(StudyError::Catalogue(format!("no product {product}")))
    }
}

fn system(choices: &mut Choices) -> String {
    let tau = choices.tidy(0.0, 1.0);
    match choices.below(10) {
        7 => "{ file = \"x.xml\" }".to_owned(),
        8 => "{ catalogue = \"venetian-80-72\", state = \"controlled\" }".to_owned(),
        9 => "{ luminaires = \"x.index.csv\", set = \"a\" }".to_owned(),
        1..=3 => format!("{{ ideal = \"diffuse\", transmittance = {tau} }}"),
        _ => format!("{{ ideal = \"transparent\", transmittance = {tau} }}"),
    }
}

fn sky(choices: &mut Choices, text: &mut String) {
    let sun = format!(
        "sun = {{ altitude = {}, azimuth = {}, direct_normal = {} }}",
        choices.tidy(1.0, 89.0),
        choices.tidy(-180.0, 360.0),
        choices.tidy(0.0, 9e4)
    );
    let _ = match choices.below(6) {
        0 => writeln!(text, "model = \"cie\"\ntype = 16\ndiffuse_horizontal = {}", choices.tidy(0.0, 2e4)),
        1 => writeln!(text, "model = \"cie\"\ntype = {}\ndiffuse_horizontal = 9000.0\n{sun}", 1 + choices.below(15)),
        2 => writeln!(text, "model = \"uniform\"\ndiffuse_horizontal = 9000.0\n{sun}"),
        3 => writeln!(
            text,
            "model = \"perez\"\n{sun}\ndirect_horizontal_irradiance = {}\ndiffuse_horizontal_irradiance = {}",
            choices.tidy(0.0, 300.0),
            choices.tidy(0.0, 300.0)
        ),
        4 => writeln!(
            text,
            "model = \"cie\"\ntype = 12\nilluminance = \"{}\"\nturbidity = 4.0\ntime = \"2026-{:02}-{:02}T{:02}:30\"",
            choices.pick(&["clear-sky", "rp-21"]),
            1 + choices.below(12),
            1 + choices.below(28),
            choices.below(24)
        ),
        _ => writeln!(text, "model = \"scan\"\nfile = \"scan.csv\""),
    };
    let _ = match choices.below(5) {
        3 => writeln!(text, "obstruction = {{ altitude = {}, luminance = 500.0 }}", choices.tidy(0.0, 60.0)),
        4 => writeln!(
            text,
            "skyline = {{ altitudes = [[0, 10], [{}, 25.0]], luminance = 500.0 }}",
            choices.tidy(1.0, 359.0)
        ),
        _ => Ok(()),
    };
}

fn control(choices: &mut Choices) -> String {
    let mode = choices.pick(&["cut-off", "din-5034", "curve", "retro-reflect", "redirect", "fixed", "user"]);
    let more = choices.pick(&[
        "",
        "curve = [[0.0, 64.0], [30.0, 25.0]]\n",
        "slats = { width = 0.08, spacing = 0.072, rise = 0.0 }\n",
        "schedule = [{ from = \"08:00\", to = \"18:00\", state = \"45\" }]\nstate = \"45\"\n",
        "threshold = 100.0\nclose_above = 70000.0\nhysteresis = 5.0\ndwell = 10.0\n",
    ]);
    format!("mode = \"{mode}\"\n{more}")
}

fn scene_text(choices: &mut Choices) -> String {
    let (width, depth, height) = (choices.tidy(2.0, 9.0), choices.tidy(2.0, 9.0), choices.tidy(2.4, 5.0));
    let mut text = format!(
        "[room]\nwidth = {width}\ndepth = {depth}\nheight = {height}\nreflectance = {{ floor = {}, walls = {}, ceiling = {} }}\n",
        choices.tidy(0.0, 1.0),
        choices.tidy(0.0, 1.0),
        choices.tidy(0.0, 1.0)
    );
    for k in 0..1 + choices.below(3) {
        let surface = if k == 1 { "roof" } else { "facade" };
        let _ = write!(
            text,
            "\n[[aperture]]\nsurface = \"{surface}\"\norigin = [{}, 0.2]\nsize = [0.5, {}]\nsystem = {}\n",
            0.1 + 0.3 * k as f64,
            choices.tidy(0.1, 1.5),
            system(choices)
        );
        if choices.one_in(3) {
            let _ =
                writeln!(text, "reflectance = {}\nframe = 0.1\ndirt = 0.9\nstructure = 0.07", choices.tidy(0.0, 1.0));
        }
    }
    for k in 0..choices.below(5).saturating_sub(2) {
        let _ = writeln!(
            text,
            "\n[[outside]]\nbox = {{ from = [{k}.0, -3.0, -1.0], to = [{k}.5, -2.0, {}], turn = {} }}\n{}",
            choices.tidy(0.0, 6.0),
            choices.tidy(0.0, 90.0),
            choices.pick(&["reflectance = 0.3", "luminance = 800.0", ""])
        );
    }
    let rules =
        ["\"none\"", "\"eu\"", "\"us\"", "\"chile\"", "[\"2026-03-29\", \"2026-10-25\"]", "[\"10-01\", \"04-01\"]"];
    let dst = choices.pick(&rules);
    let _ = writeln!(
        text,
        "\n[site]\nazimuth = {}\nlatitude = {}\nlongitude = 9.2\nutc_offset = 1.0\ndst = {dst}\nground_reflectance = 0.2\n",
        choices.tidy(0.0, 360.0),
        choices.tidy(-90.0, 90.0)
    );
    text.push_str("[sky]\n");
    sky(choices, &mut text);
    let _ = writeln!(text, "\n[sensors]\nplane = {{ z = 0.85, nx = {}, ny = 3 }}", 1 + choices.below(9));
    if choices.one_in(3) {
        let _ = writeln!(text, "points = [[1.0, 0.25, {}]]\nnormal = [0.0, 1.0, 1.0]", choices.tidy(0.0, 2.0));
    }
    if choices.one_in(3) {
        let _ = write!(text, "\n[control]\n{}", control(choices));
    }
    if choices.one_in(4) {
        let _ = writeln!(text, "\n[[compare]]\nname = \"x\"\nsystem = {}", system(choices));
    }
    if choices.one_in(3) {
        let _ = writeln!(
            text,
            "\n[compute]\ninterreflection = {}\nnear_field = \"{}\"\ninterpolation = \"{}\"\nbeam = \"cells\"",
            choices.flag(),
            choices.pick(&["solid-angle", "subdivision", "monte-carlo", "profile-table"]),
            choices.pick(&["auto", "patch"])
        );
    }
    text
}

pub fn make_scene(choices: &mut Choices) -> Vec<u8> {
    let text = scene_text(choices);
    edits::text(choices, text)
}

pub fn read_scene(bytes: &[u8]) -> bool {
    let text = match decode(bytes) {
        Ok(text) => text,
        Err(error) => return told(&error),
    };
    let file = match SceneFile::parse(&text) {
        Ok(file) => file,
        Err(error) => return told(&error),
    };
    let written = toml::to_string(&file).unwrap_or_else(|error| panic!("a scene cannot be written: {error}"));
    // Debug, since what is no number is not equal to itself.
    let twin = again("a scene", SceneFile::parse(&written));
    assert_eq!(format!("{twin:?}"), format!("{file:?}"), "a scene changes when it is read and written again");
    // What the window asks before anything is judged.
    let mut stepped = file.clone();
    let _ = (
        moment::of(&file),
        moment::place(&file, std::path::Path::new("")),
        moment::sun(&file, std::path::Path::new("")),
        moment::sun_hours(&file, std::path::Path::new("")),
    );
    moment::step(&mut stepped, 1, 30);
    if file.outside.len() > FEW || file.aperture.len() > 2 * FEW {
        return true;
    }
    match Scene::resolve(&file, Path::new("/no/such/folder"), &NoFiles) {
        Ok(scene) => {
            for one in &scene.apertures {
                assert!((0.0..=1.0).contains(&one.clear) && (0.0..=1.0).contains(&one.reflectance), "{one:?}");
                assert!(one.aperture.size.iter().all(|side| *side > 0.0 && side.is_finite()), "{one:?}");
            }
            let here = |sensor: &cfs::compute::room::direct::Sensor| {
                sensor.position.is_finite() && (sensor.normal.length() - 1.0).abs() < 1e-9
            };
            assert!(!scene.sensors.is_empty() && scene.sensors.iter().all(here), "a sensor that is nowhere");
            assert!(
                scene.sun.is_none_or(|sun| sun.direct_normal.is_finite() && sun.direct_normal >= 0.0),
                "{:?}",
                scene.sun
            );
            assert!(scene.too_near().len() == scene.apertures.len());
        }
        Err(error) => {
            told(&error);
        }
    }
    true
}

fn system_text(choices: &mut Choices, depth: usize) -> (&'static str, String) {
    let share = |choices: &mut Choices| choices.tidy(0.0, 0.5);
    match choices.below(if depth < 3 { 10 } else { 8 }) {
        0 => (
            "pane",
            format!("index = {}\nthickness = 0.004\nabsorption = {}", choices.tidy(1.0, 2.0), choices.tidy(0.0, 50.0)),
        ),
        1 => (
            "venetian",
            format!(
                "width = 0.08\nspacing = {}\nrise = {}\nangles = {}\nupper = {{ reflectance = {} }}\nlower = {{ reflectance = 0.4, \
                 specular = {}, roughness = 5.0 }}",
                choices.tidy(0.03, 0.1),
                choices.tidy(0.0, 0.02),
                choices.pick(&["[0.0, 45.0]", "{ from = -75.0, to = 75.0, step = 15.0 }"]),
                share(choices),
                share(choices)
            ),
        ),
        2 => (
            "laser-cut-panel",
            format!(
                "index = 1.49\nspacing = 0.004\ndepth = {}\ncut_loss = {}",
                choices.tidy(0.01, 0.05),
                share(choices)
            ),
        ),
        3 => (
            "prismatic",
            format!("index = 1.49\nangles = [{}, 5.0]\npitch = 0.01\nbase = 0.002", choices.tidy(1.0, 60.0)),
        ),
        4 => (
            "diffuser",
            match choices.below(3) {
                0 => format!(
                    "model = \"lambertian\"\ntransmittance = {}\nreflectance = {}",
                    share(choices),
                    share(choices)
                ),
                1 => format!("model = \"opal\"\nindex = 1.49\ntransmittance = {}\nreflectance = 0.3", share(choices)),
                _ => format!(
                    "model = \"spreading\"\nindex = 1.49\nlobe = 0.5\nspread = 20.0\ntransmittance = {}",
                    share(choices)
                ),
            },
        ),
        5 => ("woven", format!("openness = {}\nreflectance = {}\ntransmittance = 0.1", share(choices), share(choices))),
        6 => (
            "perforated",
            format!(
                "hole = \"{}\"\nwidth = 0.002\npitch = [0.005, {}]\nthickness = 0.001\nreflectance = {}",
                choices.pick(&["round", "rectangle", "rhombus"]),
                choices.tidy(0.01, 0.02),
                share(choices)
            ),
        ),
        7 => (
            "redirecting-glass",
            format!(
                "index = 1.49\nspacing = 0.01\nbodies = [[[0.0, 0.0], [0.01, 0.0], [0.01, {}]]]",
                choices.tidy(0.01, 0.02)
            ),
        ),
        _ => {
            let mut layers = Vec::new();
            for _ in 0..1 + choices.below(3) {
                layers.push(match choices.below(4) {
                    0 => "{ file = \"x.system.toml\" }".to_owned(),
                    1 => "{ catalogue = \"blind\", state = \"each\" }".to_owned(),
                    _ => {
                        let (kind, table) = system_text(choices, depth + 1);
                        format!(
                            "{{ system = {{ name = \"l\", kind = \"{kind}\", {kind} = {{ {} }} }} }}",
                            table.replace('\n', ", ")
                        )
                    }
                });
            }
            ("stack", format!("layers = [{}]", layers.join(", ")))
        }
    }
}

pub fn make_system(choices: &mut Choices) -> Vec<u8> {
    let (kind, table) = system_text(choices, 0);
    let upright = choices.flag();
    let mut text = format!("name = \"System\"\nkind = \"{kind}\"\nupright = {upright}\n\n[{kind}]\n{table}\n");
    if choices.flag() {
        text.push_str("\n[catalogue]\nkey = \"system-1\"\ntags = [\"a\"]\ncontrol = \"cut-off\"\n");
    }
    edits::text(choices, text)
}

pub fn read_system(bytes: &[u8]) -> bool {
    let file = match system_toml::read(bytes) {
        Ok(file) => file,
        Err(error) => return told(&error),
    };
    let states = file.system.states();
    assert!(!states.is_empty(), "a system without states");
    let text = &*decode(bytes).expect("it was read as text");
    if let Some(states) = system_toml::states(text) {
        assert!(
            !states.is_empty() && system_toml::described(text, &states[0]).is_some(),
            "a state that is not described"
        );
    }
    if let Some(own) = system_toml::self_contained(text, &mut |_| None) {
        let twin = again("a system", system_toml::read(own.as_bytes()));
        assert_eq!(
            format!("{:?}", twin.system),
            format!("{:?}", file.system),
            "a system changes when it is written again"
        );
    }
    true
}

pub fn make_session(choices: &mut Choices) -> Vec<u8> {
    let kept = Kept {
        version: 1,
        at: "2026-03-21T12:00:00Z".to_owned(),
        scene: scene_text(choices),
        product: choices.words(),
        state: choices.words(),
        maximised: choices.flag().then(|| choices.words()),
        ..Kept::default()
    };
    let text = if choices.one_in(3) {
        Layout::tabs(&TILES.iter().take(1 + choices.below(5)).map(|entry| entry.tile).collect::<Vec<_>>()).text()
    } else {
        serde_json::to_string_pretty(&kept).expect("a session can be written")
    };
    edits::text(choices, text)
}

pub fn read_session(bytes: &[u8]) -> bool {
    let known: Vec<_> = TILES.iter().map(|entry| entry.tile).collect();
    let text = String::from_utf8_lossy(bytes);
    match Layout::read(&text, &known) {
        Ok(layout) => {
            assert_eq!(layout.tiles().len(), known.len(), "tiles that got lost");
            let twin = again("a layout", Layout::read(&layout.text(), &known));
            assert_eq!(twin.text(), layout.text(), "a layout changes when it is read and written again");
            return true;
        }
        Err(error) => {
            told(&error);
        }
    }
    match Kept::read(bytes) {
        Ok(kept) => {
            let written = serde_json::to_vec(&kept).expect("a session can be written");
            let twin = again("a session", Kept::read(&written));
            assert_eq!(format!("{twin:?}"), format!("{kept:?}"), "a session changes when it is read and written again");
            true
        }
        Err(error) => told(&error),
    }
}

pub fn make_typed(choices: &mut Choices) -> Vec<u8> {
    let text = match choices.below(6) {
        0 => format!("{}.{}.", 1 + choices.below(28), 1 + choices.below(12)),
        1 => format!(
            "2026-{:02}-{:02}T{:02}:{:02}",
            1 + choices.below(12),
            1 + choices.below(28),
            choices.below(24),
            choices.below(60)
        ),
        2 => format!("{}:{:02}", choices.below(24), choices.below(60)),
        3 => format!("{}°N, {}°E", choices.tidy(0.0, 90.0), choices.tidy(0.0, 180.0)),
        4 => format!("{} m", choices.tidy(-9.0, 9.0)),
        _ => format!(
            "{} {} {}",
            1 + choices.below(28),
            choices.pick(&["März", "mar", "Dezember"]),
            1900 + choices.below(300)
        ),
    };
    edits::text(choices, text)
}

pub fn read_typed(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let mut taken = false;
    taken |= typing::read_date(&text, 2026).is_ok();
    if let Ok((hour, minute)) = typing::read_clock(&text) {
        assert!((0..24).contains(&hour) && (0..60).contains(&minute), "{hour}:{minute}");
        taken = true;
    }
    if let Some(Ok((latitude, longitude))) = typing::read_coordinates(&text) {
        assert!(latitude.abs() <= 90.0 && longitude.abs() <= 180.0, "{latitude} {longitude}");
        taken = true;
    }
    if let Some(number) = typing::read_number(&text, "m") {
        assert!(number.is_finite(), "{number}");
        taken = true;
    }
    if let Err(error) = toml::from_str::<toml::Table>(&text) {
        let place = toml_place::place(&text, &error, 1, |_| None);
        assert!(place.line >= 1 && place.column >= 1, "a place before the file");
    }
    taken | parse_local_time(&text).is_ok()
}
