//! Blinds of a year that ask the room, or that IES LM-83-12 works: against rules and rooms of the single hours, done by hand.

use crate::rooms::*;
use cfs::compute::estimate::Silent;
use cfs::study::scene_file::SystemKeys;
use cfs::study::year::{Quantity, SHADE, Year, figures, metrics, scene_at, year};
use cfs::study::{Library, RoomResult, Scene, SceneFile, Session};
use std::path::Path;

const WEATHER: &str = "place Test\nlatitude 40\nlongitude 0\ntime_zone 0\nsite_elevation 0\nweather_data_file_units 1\n\
                       1 21 9.5 200 60\n1 21 12.5 700 80\n1 21 19.5 0 0\n6 21 12.5 800 110\n9 21 15.5 30 60\n11 2 11.5 0 120\n";
const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\n\
    angles = [0.0, 60.0]\nupper = { reflectance = 0.5 }\nlower = { reflectance = 0.5 }\n";

/// A room with a window and a rooflight.
fn text([facade, roof]: [&str; 2], more: &str, year: &str) -> String {
    format!(
        "[room]\nwidth = 4.0\ndepth = 5.0\nheight = 3.0\nreflectance = {{ floor = 0.0, walls = 0.0, ceiling = 0.0 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\nreflectance = 0.0\nsystem = {facade}\n\
         [[aperture]]\nsurface = \"roof\"\norigin = [1.5, 3.5]\nsize = [1.0, 1.0]\nreflectance = 0.0\nsystem = {roof}\n\
         [site]\nazimuth = 180.0\nlatitude = 40.0\nlongitude = 0.0\nutc_offset = 0.0\nground_reflectance = 0.2\n\
         [sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 1.0\n[sensors]\nplane = {{ z = 0.8, nx = 3, ny = 4 }}\n\
         [compute]\ninterreflection = false\n{more}\n[year]\nweather = \"w.wea\"\n{year}\n"
    )
}

/// A scene in a folder of its own, and its year.
struct Case {
    folder: tempfile::TempDir,
    file: SceneFile,
    year: Year,
}

fn case(text: &str) -> Case {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("w.wea"), WEATHER).unwrap();
    std::fs::write(folder.path().join("blind.system.toml"), BLIND).unwrap();
    let file = SceneFile::parse(text).unwrap();
    let year = year(&file, folder.path(), &Library::default(), &Session::new(), &|_| true, &Silent).unwrap();
    Case { folder, file, year }
}

impl Case {
    /// The room of a chosen step with other systems in the apertures.
    fn room(&self, row: usize, change: impl Fn(&mut SceneFile)) -> RoomResult {
        let (base, library) = (self.folder.path(), Library::default());
        let time = self.year.steps.list[self.year.chosen[row]].time;
        let mut hour = scene_at(&self.file, base, &library, time, &Silent).unwrap();
        change(&mut hour);
        compute(&Scene::resolve(&hour, Path::new(base), &library).unwrap())
    }

    fn is_lit(&self, row: usize) -> bool {
        self.year.steps.list[self.year.chosen[row]].hour.is_lit()
    }
}

fn put(system: &mut SystemKeys, key: &str) {
    let SystemKeys::File { state, .. } = system else { panic!("{system:?}") };
    *state = Some(key.to_owned());
}

/// How many of the sensors have 1000 lx of beams.
fn sunny(room: &RoomResult) -> usize {
    room.sensors.iter().filter(|sensor| sensor.beam >= 1000.0).count()
}

#[test]
fn lm_83_closes_openings_while_the_sun_is_on_the_desks() {
    let systems = [TRANSPARENT, "{ file = \"blind.system.toml\", state = \"controlled\" }"];
    let case = case(&text(systems, "[control]\nmode = \"fixed\"\nstate = \"60\"", "lm83 = true"));
    let lm83 = case.year.lm83.as_ref().unwrap();
    assert_eq!(lm83.groups.iter().map(|group| group.apertures.clone()).collect::<Vec<_>>(), [[1], [2]]);
    assert_eq!(lm83.groups[0].states, None, "nothing moves in the window");
    assert_eq!(lm83.groups[1].states, Some(["0".to_owned(), "60".to_owned()]));
    let states = |closed: [bool; 2]| {
        move |scene: &mut SceneFile| {
            if closed[0] {
                let keys = format!("system = {{ ideal = \"diffuse\", transmittance = {SHADE} }}");
                let parsed: std::collections::BTreeMap<String, SystemKeys> = toml::from_str(&keys).unwrap();
                scene.aperture[0].system = parsed["system"].clone();
            }
            put(&mut scene.aperture[1].system, if closed[1] { "60" } else { "0" });
        }
    };
    let mut seen = Vec::new();
    let mut reached = [0; 12];
    for (row, worked) in lm83.worked.iter().enumerate() {
        if !case.is_lit(row) {
            assert_eq!(worked.closed, [false, false]);
            continue;
        }
        // 2 % of twelve sensors is less than one. What the window alone brings, then both.
        let alone = |index: usize| {
            let other = 1 - index;
            let black = |scene: &mut SceneFile| {
                states([false, false])(scene);
                scene.aperture[other].dirt = 0.0;
            };
            sunny(&case.room(row, black))
        };
        let closed = [alone(0) > 0, alone(1) > 0];
        assert_eq!((&worked.closed[..], worked.unsure), (&closed[..], false), "row {row}");
        seen.push(closed);
        let room = case.room(row, states(closed));
        for (s, sensor) in room.sensors.iter().enumerate() {
            let [own, error] = [&lm83.values, &lm83.errors].map(|table| f64::from(table.row(row)[s]));
            let moment = sensor.total();
            let off = (own - moment.value).abs();
            assert!(off <= error + moment.error + 2e-3 * moment.value, "row {row}: {own} ± {error}, {moment:?}");
            reached[s] += usize::from(moment.value >= 300.0);
        }
    }
    assert!(seen.contains(&[true, false]) && seen.contains(&[false, false]), "{seen:?}");
    let all = metrics(&case.year, &figures(&case.year));
    let stated = |key: &str| all.iter().find(|one| one.key() == key).map(|one| one.values[0].clone());
    // Five of the six steps are by day; the dark one at half past seven in the evening is nobody's.
    let share = reached.iter().filter(|hours| **hours as f64 >= 2.5).count() as f64 / 12.0;
    assert_eq!(stated("sDA300_50_LM83_12"), Some(Quantity::Number(share)));
    let hours = |group: usize| seen.iter().filter(|closed| closed[group]).count() as f64;
    assert_eq!(stated("blinds_closed_hours"), Some(Quantity::List(vec![hours(0), hours(1)])));
    assert!(case.year.notes.iter().any(|note| note.contains("nothing moves in aperture 1")), "{:?}", case.year.notes);
}

#[test]
fn a_control_reads_the_room_and_opens_where_it_is_dark() {
    let blind = "{ file = \"blind.system.toml\", state = \"controlled\" }";
    let black = "{ ideal = \"diffuse\", transmittance = 0.0 }";
    // The two states by themselves, hour by hour: as rooms, without a word of a sensor.
    let plain = case(&text([blind, black], "[control]\nmode = \"din-5034\"", ""));
    let mean = |row: usize, state: &str| {
        let room = plain.room(row, |scene| put(&mut scene.aperture[0].system, state));
        let light = totals(&room);
        0.5 * (light[0] + light[7])
    };
    let rows = 0..plain.year.chosen.len();
    let means: Vec<[f64; 2]> =
        rows.map(|row| if plain.is_lit(row) { ["60", "0"].map(|state| mean(row, state)) } else { [0.0; 2] }).collect();
    let mut kinds = [0; 3];
    for limit in [2.0, 150.0, 600.0, 60_000.0] {
        let control = format!("[control]\nmode = \"din-5034\"\nopen_below = {limit:?}\nindoor_sensors = [0, 7]");
        let case = case(&text([blind, black], &control, ""));
        let indoor = case.year.indoor.as_ref().unwrap();
        for (row, [shut, open]) in means.iter().copied().enumerate() {
            let k = case.year.chosen[row];
            let closed = case.year.moving[0].device.keys[case.year.states[k][0]] == "60";
            let sun = case.year.steps.list[k].hour.direct_normal > 0.0;
            let bright = sun && shut >= limit;
            assert_eq!(closed, bright, "{limit} lx, row {row}: {shut} lx closed, {open} lx open");
            let hunts = sun && !bright && open >= limit;
            assert_eq!(indoor.hunting.contains(&k), hunts, "{limit} lx, row {row}: {shut} lx closed, {open} lx open");
            let kind = if bright {
                0
            } else if hunts {
                1
            } else {
                2
            };
            kinds[kind] += usize::from(sun);
        }
        // Four steps have sun; in the others both states are the open one.
        assert_eq!(indoor.read, 4, "{limit}");
    }
    assert!(kinds.iter().all(|count| *count > 0), "{kinds:?}");
}
