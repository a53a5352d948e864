//! `cfs rank`: lists of products in a year, pieces of them merged, reasons that add up, refusals.

use crate::program::cfs;
use cfs::catalogue::{Catalogue, NewProduct};
use cfs::compute::btdf::{Btdf, Dataset};
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

/// A dataset of two incident and two emergent rings, all of one value. \[1/sr\]
fn sheet(name: &str, value: f64) -> String {
    let ring = |low: u32, high: u32| {
        format!(
            "<AngleBasisBlock><Theta>{}</Theta><nPhis>1</nPhis><ThetaBounds><LowerTheta>{low}</LowerTheta>\
             <UpperTheta>{high}</UpperTheta></ThetaBounds></AngleBasisBlock>",
            f64::from(low + high) / 2.0
        )
    };
    format!(
        "<?xml version=\"1.0\"?><WindowElement xmlns=\"http://windows.lbl.gov\"><Optical><Layer><Material><Name>{name}</Name>\
         <Manufacturer>Nobody</Manufacturer></Material><DataDefinition><IncidentDataStructure>Columns</IncidentDataStructure>\
         <AngleBasis><AngleBasisName>Own</AngleBasisName>{}{}</AngleBasis></DataDefinition><WavelengthData>\
         <LayerNumber>System</LayerNumber><Wavelength unit=\"Integral\">Visible</Wavelength><WavelengthDataBlock>\
         <WavelengthDataDirection>Transmission Front</WavelengthDataDirection><ColumnAngleBasis>Own</ColumnAngleBasis>\
         <RowAngleBasis>Own</RowAngleBasis><ScatteringDataType>BTDF</ScatteringDataType><ScatteringData>{}</ScatteringData>\
         </WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>",
        ring(0, 40),
        ring(40, 90),
        [value, 0.5 * value, 0.7 * value, value].map(|value| value.to_string()).join(" ")
    )
}

/// Four days of a year, from 7 to 18 o'clock, sunny but for the second.
fn weather() -> String {
    let mut text = String::from(
        "place Somewhere\nlatitude 47.5\nlongitude 122.2\ntime_zone 120\nsite_elevation 10\nweather_data_file_units 1\n",
    );
    for (month, day, direct) in [(1, 15, 500), (4, 20, 0), (7, 8, 700), (10, 22, 400)] {
        for hour in 8..18 {
            let noon = f64::from(6 - (12_i32 - hour).abs()) / 6.0;
            let _ = writeln!(text, "{month} {day} {hour}.500 {} {}", f64::from(direct) * noon, 60.0 + 120.0 * noon);
        }
    }
    text
}

const SCENE: &str = r#"
[room]
width = 4.0
depth = 5.0
height = 3.0
reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }
[[aperture]]
surface = "facade"
origin = [0.5, 1.0]
size = [3.0, 1.8]
reflectance = 0.0
system = "ranked"
[site]
ground_reflectance = 0.2
latitude = 47.5
longitude = -122.2
utc_offset = -8.0
[sky]
model = "uniform"
diffuse_horizontal = 1.0
[sensors]
plane = { z = 0.85, nx = 2, ny = 2 }
[control]
mode = "din-5034"
[compute]
interpolation = "patch"
[year]
weather = "days.wea"
[year.lighting]
power = 10.0
target = 300.0
min_power = 0.1
zones = [{ sensors = [0, 1], share = 0.5 }, { sensors = [2, 3], share = 0.5 }]
[rank]
products = "rankling"
azimuths = [180.0, 270.0]
[[rank.objective]]
figure = "lighting.kWh_m2"
better = "less"
worst = 0.5
best = 0.0
weight = 2.0
[[rank.objective]]
figure = "UDI_x"
better = "less"
worst = 1.0
best = 0.0
"#;

/// A folder with a scene, four days of weather, and a catalogue with three products of one state, one of two, and one that
/// cannot follow the scene's rule.
fn prepared() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    std::fs::write(path.join("scene.toml"), SCENE).unwrap();
    std::fs::write(path.join("days.wea"), weather()).unwrap();
    for (name, value) in [("dim", 0.03), ("grey", 0.1), ("bright", 0.2)] {
        std::fs::write(path.join("x.xml"), sheet(&format!("Rankling {name}"), value)).unwrap();
        done(path, &["catalogue", "import", "x.xml", "--name", &format!("Rankling {name}")]);
    }
    std::fs::write(path.join("slats_0.xml"), sheet("Rankling blind 0", 0.2)).unwrap();
    std::fs::write(path.join("slats_60.xml"), sheet("Rankling blind 60", 0.02)).unwrap();
    done(path, &["catalogue", "import", "slats_0.xml", "slats_60.xml", "--name", "Rankling blind"]);
    // Its states have no numbers, which the scene's rule needs.
    let state = |state: &str, tau| {
        let mut dataset = Dataset { name: "glass".to_owned(), state: state.to_owned(), ..Dataset::default() };
        dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
        dataset
    };
    let new = NewProduct { name: "Rankling glass".to_owned(), ..NewProduct::default() };
    let mut catalogue = Catalogue::open(&path.join("catalogue.cfsdb")).unwrap();
    catalogue.import(&[state("clear", 0.5), state("dark", 0.1)], new).unwrap();
    folder
}

fn done(folder: &Path, command: &[&str]) -> String {
    let output = cfs(folder, command);
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The one line by which a command is refused.
fn refused(folder: &Path, command: &[&str]) -> String {
    let output = cfs(folder, command);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{command:?}: {error}");
    error
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn shards_merged_in_any_order_are_the_run_in_one() {
    let folder = prepared();
    let folder = folder.path();
    done(folder, &["rank", "scene.toml", "--out", "one.csv"]);
    let one = bytes(folder, "one.csv");
    let mut rows = csv::Reader::from_reader(one.as_slice());
    assert_eq!(
        rows.headers().unwrap().iter().collect::<Vec<_>>().join(","),
        "scene,climate,azimuth,product,lighting.kWh_m2,lighting.kWh_m2_error,UDI_x,UDI_x_error,utility,utility_error,rank_first,\
         rank_last,front,approximate,excluded,why"
    );
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 10);
    let out: Vec<&csv::StringRecord> = rows.iter().filter(|row| !row[14].is_empty()).collect();
    assert!(
        out.len() == 2 && out.iter().all(|row| row[14].contains("states without numbers") && row[4].is_empty()),
        "{out:?}"
    );
    assert!(rows.iter().filter(|row| row[14].is_empty()).all(|row| row[15].contains("the mean")), "{rows:?}");
    for count in [1, 2, 3] {
        let name = |number: usize| format!("part-{count}-{number}.csv");
        for number in 0..count {
            done(folder, &["rank", "scene.toml", "--shard", &format!("{number}/{count}"), "--out", &name(number)]);
        }
        let orders: &[&[usize]] = match count {
            1 => &[&[0]],
            2 => &[&[0, 1], &[1, 0], &[1, 0, 1]],
            _ => &[&[0, 1, 2], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]],
        };
        for order in orders {
            let parts: Vec<String> = order.iter().map(|&number| name(number)).collect();
            let mut command = vec!["rank", "--merge"];
            command.extend(parts.iter().map(String::as_str));
            command.extend(["--out", "merged.csv"]);
            done(folder, &command);
            assert!(bytes(folder, "merged.csv") == one, "{parts:?}");
        }
    }
    // What is there is not computed again; what was killed leaves nothing, and is computed by the next.
    let before = std::fs::metadata(folder.join("part-3-0.csv")).unwrap().modified().unwrap();
    done(folder, &["rank", "scene.toml", "--shard", "0/3", "--out", "part-3-0.csv"]);
    assert_eq!(std::fs::metadata(folder.join("part-3-0.csv")).unwrap().modified().unwrap(), before);
    let whole = bytes(folder, "part-3-1.csv");
    std::fs::remove_file(folder.join("part-3-1.csv")).unwrap();
    for wait in [0, 30, 100, 300] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_cfs"))
            .args(["rank", "scene.toml", "--shard", "1/3", "--out", "part-3-1.csv"])
            .current_dir(folder)
            .env("CFS_CATALOGUE", folder.join("catalogue.cfsdb"))
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_millis(wait));
        child.kill().unwrap();
        child.wait().unwrap();
        let there = std::fs::read(folder.join("part-3-1.csv")).ok();
        assert!(there.is_none_or(|there| there == whole), "half a piece under its final name");
    }
    done(folder, &["rank", "scene.toml", "--shard", "1/3", "--out", "part-3-1.csv"]);
    assert!(bytes(folder, "part-3-1.csv") == whole);
    merges_that_cannot_be(folder);
}

/// Of the pieces of three that the test above left.
fn merges_that_cannot_be(folder: &Path) {
    let merge = |parts: &[&str]| {
        let mut command = vec!["rank", "--merge"];
        command.extend(parts);
        command.extend(["--out", "merged.csv"]);
        refused(folder, &command)
    };
    let error = merge(&["part-3-1.csv"]);
    assert!(error.contains("missing: shard 0/3, 2/3"), "{error}");
    let error = merge(&["part-3-0.csv", "part-2-1.csv"]);
    assert!(error.contains("one of 3; expected pieces of one division"), "{error}");
    let error = merge(&["part-3-0.csv", "one.csv"]);
    assert!(error.contains("one.csv: is not a piece of a ranking"), "{error}");
    // Another value for the same key.
    let text = String::from_utf8(bytes(folder, "part-3-0.csv")).unwrap();
    let row = text.lines().nth(2).unwrap();
    let fields: Vec<&str> = row.split(',').collect();
    let other = row.replacen(fields[4], "0.123", 1);
    std::fs::write(folder.join("wrong.csv"), text.replace(row, &other)).unwrap();
    let error = merge(&["part-3-0.csv", "wrong.csv", "part-3-1.csv", "part-3-2.csv"]);
    assert!(
        error.contains("two values for key") && error.contains("part-3-0.csv") && error.contains("wrong.csv"),
        "{error}"
    );
    // A piece that lost a row, and one of another ranking.
    std::fs::write(folder.join("cut.csv"), text.replace(&format!("{row}\n"), "")).unwrap();
    let error = merge(&["cut.csv", "part-3-1.csv", "part-3-2.csv"]);
    assert!(error.contains("cut.csv: has") && error.contains("rows"), "{error}");
    std::fs::write(folder.join("other.toml"), SCENE.replace("weight = 2.0", "weight = 3.0")).unwrap();
    done(folder, &["rank", "other.toml", "--shard", "2/3", "--out", "other.csv"]);
    let error = merge(&["part-3-0.csv", "part-3-1.csv", "other.csv"]);
    assert!(error.contains("other.csv: belongs to another ranking"), "{error}");
    let error = refused(folder, &["rank", "scene.toml", "--shard", "2/3", "--out", "other.csv"]);
    assert!(error.contains("piece 2/3 of another ranking"), "{error}");
}

#[test]
fn reasons_add_up_and_ranks_are_of_intervals() {
    let folder = prepared();
    let folder = folder.path();
    let json: Value = serde_json::from_str(&done(folder, &["rank", "scene.toml", "--json"])).unwrap();
    let lists = json["lists"].as_array().unwrap();
    assert_eq!(lists.iter().map(|list| number(&list["azimuth"])).collect::<Vec<_>>(), [180.0, 270.0]);
    for list in lists {
        let products = list["products"].as_array().unwrap();
        assert_eq!((products.len(), list["excluded"].as_array().map(Vec::len)), (4, Some(1)));
        let figure = |product: &Value, key: &str| number(&product["figures"][key]["value"]);
        let utility = |product: &Value| {
            let lamps = ((0.5 - figure(product, "lighting.kWh_m2")) / 0.5).clamp(0.0, 1.0);
            (2.0 * lamps + (1.0 - figure(product, "UDI_x")).clamp(0.0, 1.0)) / 3.0
        };
        let mean = products.iter().map(&utility).sum::<f64>() / 4.0;
        for product in products {
            assert!((number(&product["utility"]) - utility(product)).abs() < 1e-9, "{product}");
            let above = |a: &Value, b: &Value| {
                let end = |one: &Value, sign: f64| number(&one["utility"]) + sign * number(&one["utility_error"]);
                end(a, -1.0) > end(b, 1.0)
            };
            let better = products.iter().filter(|other| above(other, product)).count();
            let worse = products.iter().filter(|other| above(product, other)).count();
            assert_eq!(
                (product["rank_first"].as_u64(), product["rank_last"].as_u64()),
                (Some(1 + better as u64), Some((4 - worse) as u64))
            );
            let rival = products.iter().find(|other| other["product"] == product["to_best"]["product"]).unwrap();
            let against = [
                (&product["to_best"], utility(product) - utility(rival)),
                (&product["to_mean"], utility(product) - mean),
            ];
            for (why, difference) in against {
                let shares = why["shares"].as_array().unwrap();
                let sum: f64 = shares.iter().map(|share| number(&share["utility"])).sum();
                assert!((sum - number(&why["utility"])).abs() < 1e-12 && (sum - difference).abs() < 1e-9, "{why}");
                for share in shares {
                    let parts = share["parts"].as_array().unwrap();
                    assert_eq!(parts.len(), 4 * 2 * 2);
                    let sum: f64 = parts.iter().map(|part| number(&part["figure"])).sum();
                    let whole = number(&share["difference"]);
                    assert!((sum + number(&share["rest"]) - whole).abs() < 1e-12, "{share}");
                    // Both figures are sums over hours: nothing is left but digits.
                    assert!(number(&share["rest"]).abs() < 1e-8, "{share}");
                }
            }
        }
    }
    let words = lists[0]["products"][3]["why"].as_str().unwrap();
    assert!(words.contains("against") && words.contains(" in ") && words.contains("the mean"), "{words}");
    let table = done(folder, &["rank", "scene.toml", "--products", "rankling dim", "--out", "dim.csv"]);
    assert!(table.contains("rank") && table.contains("rankling-dim"), "{table}");
    assert!(String::from_utf8(bytes(folder, "dim.csv")).unwrap().contains("the only one"));
}

#[test]
fn rankings_that_cannot_be_are_refused_in_one_line() {
    let folder = prepared();
    let folder = folder.path();
    let change = |from: &str, to: &str| {
        assert!(SCENE.contains(from), "{from}");
        std::fs::write(folder.join("wrong.toml"), SCENE.replace(from, to)).unwrap();
    };
    for (from, to, words) in [
        ("figure = \"UDI_x\"", "figure = \"UDI_y\"", "the year has no figure \"UDI_y\"; it has: hours, "),
        ("products = \"rankling\"", "products = \"qqqqqqqqqqqq\"", "rank.products: no product"),
        ("system = \"ranked\"", "system = { ideal = \"diffuse\", transmittance = 0.5 }", "aperture: none is ranked"),
        ("weather = \"days.wea\"", "weather = \"none.wea\"", "year.weather"),
        ("best = 0.0\nweight", "best = 1.0\nweight", "rank.objective[1].best: 1 is not better"),
        ("better = \"less\"", "better = \"lower\"", "better"),
        ("system = \"ranked\"", "system = \"rank\"", "the word \"ranked\""),
    ] {
        change(from, to);
        let error = refused(folder, &["rank", "wrong.toml", "--out", "x.csv"]);
        assert!(error.contains("wrong.toml") && error.contains(words), "{words}: {error}");
    }
    for command in
        [["room", "scene.toml"], ["year", "scene.toml"], ["control", "scene.toml"], ["compare", "scene.toml"]]
    {
        let error = refused(folder, &command);
        assert!(error.contains("aperture[1].system") && error.contains("use `cfs rank`"), "{command:?}: {error}");
    }
    let error = cfs(folder, &["rank", "scene.toml", "--shard", "3/3", "--out", "x.csv"]);
    assert!(error.status.code() == Some(2) && String::from_utf8_lossy(&error.stderr).contains("expected n/N"));
    assert!(!folder.join("x.csv").exists());
}

#[test]
fn the_accuracy_of_a_ranking_is_told_by_effort() {
    let folder = prepared();
    let folder = folder.path();
    // By default beams are as they are.
    let scene = SCENE.replace("[compute]\ninterpolation = \"patch\"\n", "");
    std::fs::write(folder.join("scene.toml"), scene).unwrap();
    let text = done(folder, &["accuracy", "scene.toml", "--rank", "--csv", "ranks.csv", "--json"]);
    let found: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        ["lists", "products", "ranked"].map(|key| found[key].as_u64()),
        [Some(2), Some(10), Some(8)],
        "one cannot follow the scene's rule"
    );
    let rankings = found["rankings"].as_array().unwrap();
    let settings: Vec<&str> = rankings.iter().map(|one| one["setting"].as_str().unwrap()).collect();
    let targets = [10, 3, 1].map(|percent| format!("error target {percent} %"));
    assert_eq!(settings[..2], ["data on their cells", "as the scene has it"]);
    assert_eq!(settings[2..5], targets);
    let (finest, others) = rankings.split_last().unwrap();
    assert!(finest["error_target"] == 0.003 && finest["error_rms"].is_null() && finest["coverage"].is_null());
    // Four products in two lists, of data in two rings, which leave open where in them the light goes.
    let apart = finest["pairs"]["apart"].as_u64().unwrap();
    assert!(finest["pairs"]["all"] == 12 && (3..=12).contains(&apart), "{finest}");
    for one in others {
        assert!(one["seconds"].as_f64().unwrap() > 0.0 && one["stated_mean"].as_f64().unwrap() > 0.0, "{one}");
        assert!(one["pairs"]["apart"] == apart && one["pairs"]["reversed"] == 0, "{one}");
        let coarse = one["setting"] == "data on their cells";
        assert!(coarse || (one["pairs"]["told"] == apart && one["coverage"]["held"] == 1.0), "{one}");
    }
    let table = String::from_utf8(bytes(folder, "ranks.csv")).unwrap();
    assert_eq!(table.lines().count(), 7);
    assert!(table.starts_with("setting,seconds,stated_mean,error_rms,error_max,products,share_held,"), "{table}");
    let error = refused(folder, &["accuracy", "scene.toml", "--rank", "--products", "no such thing"]);
    assert!(error.contains("rank.products"), "{error}");
}

#[test]
fn states_from_a_table_hold_until_the_next_row() {
    let folder = prepared();
    let folder = folder.path();
    let state = |key: &str| format!("{{ state = \"{key}\", value = {key}.0, file = \"slats_{key}.xml\" }}");
    let system = format!("system = {{ state = \"controlled\", states = [{}, {}] }}", state("0"), state("60"));
    let scene =
        SCENE.replace("system = \"ranked\"", &system).replace("\"din-5034\"", "\"table\"\nfile = \"states.csv\"");
    std::fs::write(folder.join("table.toml"), &scene).unwrap();
    let states = "time,state\n2001-01-01T00:00,60\n2019-04-20T10:30,0\n2019-04-20T12:00,60\n2005-10-01T00:00,0\n";
    std::fs::write(folder.join("states.csv"), states).unwrap();
    let table = done(folder, &["year", "table.toml"]);
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let column = reader.headers().unwrap().iter().position(|name| name == "state_1").unwrap();
    let mut count = 0;
    for row in reader.records().map(Result::unwrap) {
        let (time, own) = (&row[0][5..16], &row[column]);
        let open = time.starts_with("10-22") || (time.starts_with("04-20") && ("10:30".."12:00").contains(&&time[6..]));
        assert_eq!(own, if open { "0" } else { "60" }, "{time}");
        count += usize::from(open);
    }
    assert_eq!(count, 12);
    for (from, to, words) in [
        ("12:00,60", "12:00,30", "states.csv: line 4: 'slats_0.xml' has no state '30'; it has: 0, 60"),
        ("12:00,60", "12:00,", "states.csv: line 4: no state"),
        ("2001-01-01T00:00,60\n", "", "begins on 04-20 10:30"),
        ("2019-04-20T12:00", "2019-04-20T09:00", "line 4: 2019-04-20T09:00 does not come after"),
    ] {
        std::fs::write(folder.join("states.csv"), states.replace(from, to)).unwrap();
        let error = refused(folder, &["year", "table.toml"]);
        assert!(error.contains("control.file") && error.contains(words), "{words}: {error}");
    }
    std::fs::write(folder.join("states.csv"), states).unwrap();
    // A moment of a room takes the row that holds then.
    let room = |time: &str| {
        let sky = "[sky]\nmodel = \"cie\"\ntype = 16\ndiffuse_horizontal = 10000.0\ntime = ";
        let text =
            scene.replace("[sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 1.0\n", &format!("{sky}\"{time}\"\n"));
        std::fs::write(folder.join("moment.toml"), text).unwrap();
        let table = done(folder, &["room", "moment.toml"]);
        table.lines().nth(1).unwrap().split(',').nth(6).unwrap().parse::<f64>().unwrap()
    };
    let (open, closed) = (room("2026-04-20T11:00"), room("2026-04-20T12:30"));
    assert!(open > 5.0 * closed && closed > 0.0, "{open} {closed}");
}
