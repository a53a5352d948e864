//! Weather files as makers write them, broken ones, and the years that come with the program.

use crate::common::data;
use cfs::compute::weather::{Closure, Hour, Quantity, Reading, SunOffset, Weather};
use cfs::formats::weather::{is_weather_file, read, table};
use cfs::study::weather::{BUILTIN, YEARS, load};
use std::path::Path;

/// The header of an EPW file as the dictionary has it.
const HEADER: &str = "LOCATION,Somewhere,-,Land,TMY3,012345,48.5,9.25,1.0,250.0\n\
    DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n\
    HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,\nCOMMENTS 2,\nDATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";

/// A row with an hour and its light: global, direct normal, diffuse.
fn row(date: &str, hour: u32, light: &str) -> String {
    format!("{date},{hour},0,?9,5.6,-4.4,49,101300,627,1378,277,{light},42500,65900,12400,1980,300,9.8\n")
}

fn epw(rows: &str) -> Vec<u8> {
    [HEADER, rows].concat().into_bytes()
}

fn good(bytes: &[u8]) -> Weather {
    read("x.epw", bytes).unwrap()
}

fn codes(weather: &Weather) -> Vec<&'static str> {
    weather.examine().unwrap().findings.iter().map(|finding| finding.code).collect()
}

#[test]
fn rows_of_epw_mean_the_interval_that_ends_at_their_hour() {
    let weather = good(&epw(&(row("2005,6,21", 12, "800,700,100") + &row("2005,6,21", 24, "0,0,-0.00"))));
    let station = &weather.station;
    assert_eq!((station.latitude, station.longitude, station.utc_offset, station.elevation), (48.5, 9.25, 1.0, 250.0));
    assert_eq!((station.name.as_str(), station.region.as_str()), ("Somewhere", ""));
    let noon = &weather.records[0];
    assert_eq!((noon.start, noon.line, weather.interval), (11 * 3600, 9, 60));
    assert_eq!(noon.middle(60), "2005-06-21T11:30:00");
    assert_eq!((noon.global, noon.direct, noon.diffuse), (Some(800.0), Some(700.0), Some(100.0)));
    assert_eq!(
        (noon.dew_point, noon.direct_illuminance, noon.diffuse_illuminance),
        (Some(-4.4), Some(65_900.0), Some(12_400.0))
    );
    let last = &weather.records[1];
    assert_eq!(last.start, 23 * 3600);
    // The minus of a zero is gone.
    assert!(last.diffuse.unwrap().is_sign_positive());
    assert_eq!((weather.find(6, 21, 11 * 3600), weather.find(6, 21, 12 * 3600 - 1)), (Some(0), Some(0)));
    assert_eq!((weather.find(6, 21, 12 * 3600), weather.find(6, 20, 11 * 3600)), (None, None));
}

#[test]
fn missing_codes_of_all_ages_are_no_values() {
    let rows = "2005,6,21,12,60,?9,5.6,99.9,49,101300,627,1378,277,9999,9999,99990,42500,999900,999999,1980,300,9.8\n";
    let record = good(&epw(rows)).records[0];
    assert_eq!((record.global, record.direct, record.diffuse, record.dew_point), (None, None, None, None));
    assert_eq!((record.direct_illuminance, record.diffuse_illuminance), (None, None));
}

#[test]
fn several_records_an_hour_end_with_their_minute() {
    let header = HEADER.replace("PERIODS,1,1,", "PERIODS,1,4,");
    let row = |minute: u32| row("2005,6,21", 12, "800,700,100").replace(",12,0,?9", &format!(",12,{minute},?9"));
    let text = header.clone() + &row(15) + &row(30) + &row(45) + &row(0);
    let weather = good(text.as_bytes());
    assert_eq!(weather.interval, 15);
    assert_eq!(weather.records.iter().map(|r| r.start / 60).collect::<Vec<_>>(), [660, 675, 690, 705]);
    assert_eq!(weather.records[0].middle(15), "2005-06-21T11:07:30");
    let error = read("x.epw", (header + &row(20)).as_bytes()).unwrap_err().to_string();
    assert!(error.contains("line 9, column 14, field 5 (minute)") && error.contains("multiple of 15 min"), "{error}");
}

#[test]
fn headers_in_latin_1_and_years_that_cannot_be_are_read() {
    let mut bytes = epw(&row("0,2,29", 12, "800,700,100"));
    let at = bytes.windows(9).position(|w| w == b"Somewhere").unwrap();
    bytes[at] = 0xd6;
    let weather = good(&bytes);
    assert_eq!(weather.station.name, "Öomewhere");
    assert_eq!(weather.records[0].day.to_string(), "2004-02-29");
    assert!(codes(&weather).contains(&"year-absurd"));
    let with_mark = [b"\xef\xbb\xbf".as_slice(), &bytes].concat();
    assert_eq!(read("any.thing", &with_mark).unwrap().records, weather.records);
    let crlf = String::from_utf8(epw(&row("2005,6,21", 12, "8,7,1"))).unwrap().replace('\n', "\r\n");
    assert_eq!(good(crlf.as_bytes()).records.len(), 1);
}

/// A file is the same in every encoding and with every line end that it travels in.
#[test]
fn text_is_read_as_it_travels() {
    let utf16 = |text: &str, big: bool, mark: bool| -> Vec<u8> {
        let unit = |unit: u16| if big { unit.to_be_bytes() } else { unit.to_le_bytes() };
        mark.then_some(0xfeff).into_iter().chain(text.encode_utf16()).flat_map(unit).collect()
    };
    let epw = String::from_utf8(epw(&row("2005,6,21", 12, "800,700,100"))).unwrap();
    let wea = "place Somewhere\nlatitude 40.78\nlongitude 73.96\ntime_zone 75\nsite_elevation 40.0\n\
               weather_data_file_units 1\n3 21 11.500 675 95\n3 21 12.500 725 136\n";
    let table = "cfs-weather 1\nname = Somewhere\nlatitude = 48.5\nlongitude = 9.25\nutc_offset = 1\nelevation = 250\n\n\
                 2005-06-21\n13,700.5,100,-4.4\n";
    for text in [&*epw, wea, table] {
        let plain = read("x", text.as_bytes()).unwrap();
        let named = text.replace("Somewhere", "Zürich");
        let latin: Vec<u8> = named.chars().map(|c| u32::from(c) as u8).collect();
        for bytes in [
            text.replace('\n', "\r").into_bytes(),
            text.replace('\n', "\r\n").into_bytes(),
            format!("\u{feff}{text}").into_bytes(),
            utf16(text, false, true),
            utf16(&text.replace('\n', "\r\n"), true, true),
            utf16(text, false, false),
            utf16(text, true, false),
            latin,
        ] {
            let again = read("x", &bytes).unwrap();
            assert_eq!((again.format, &again.records), (plain.format, &plain.records), "{bytes:?}");
        }
        assert_eq!(read("x", named.as_bytes()).unwrap().station.name, "Zürich");
    }
    for page in ["<!DOCTYPE html>\n<html>", "\n<html lang=\"en\">"] {
        let error = read("x.epw", page.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("an HTML page") && error.contains("download the raw file"), "{error}");
    }
}

#[test]
fn a_wrong_row_is_told_with_line_and_column() {
    for (rows, place, right) in [
        (
            row("2005,6,21", 12, "800,1700,100"),
            "line 9, column 55, field 15 (direct normal irradiance): \"1700\"",
            "0 to 1455 W/m²",
        ),
        (row("2005,6,21", 12, "800,700,1001"), "field 16 (diffuse horizontal irradiance): \"1001\"", "0 to 1000 W/m²"),
        (row("2005,6,21", 12, "-5,700,100"), "field 14 (global horizontal irradiance): \"-5\"", "0 to 2000 W/m²"),
        (row("2005,6,21", 12, "800,nan,100"), "field 15 (direct normal irradiance): \"nan\"", "a number"),
        (row("2005,6,21", 12, "800,1e308,100"), "field 15 (direct normal irradiance): \"1e308\"", ""),
        (row("2005,6,21", 25, "800,700,100"), "line 9, column 11, field 4 (hour): \"25\"", "1 to 24"),
        (row("2005,13,21", 12, "800,700,100"), "field 2 (month): \"13\"", "1 to 12"),
        (row("2005,4,31", 12, "800,700,100"), "field 3 (day): \"31\"", "a day that month 4 has"),
        ("2005,6,21,12,0,?9,5.6\n".to_owned(), "line 9, column 22: a row of 7 fields", "35 fields"),
        (String::new(), "no rows of data", "a row for every interval"),
    ] {
        let error = read("x.epw", &epw(&rows)).unwrap_err().to_string();
        assert!(error.contains(place) && error.contains(right), "{error}");
    }
    for (from, to, place) in [
        ("LOCATION,Some", "PLACE,Some", "line 1: \"PLACE"),
        (",48.5,", ",95.0,", "LOCATION, latitude: \"95.0\""),
        (",9.25,", ",200,", "LOCATION, longitude: \"200\""),
        ("1.0,250.0", "19,250.0", "LOCATION, time zone: \"19\""),
        ("DATA PERIODS", "DATA", "the DATA PERIODS line before the first row"),
        ("PERIODS,1,1,", "PERIODS,1,7,", "DATA PERIODS, records per hour: \"7\""),
    ] {
        let text = String::from_utf8(epw(&row("2005,6,21", 12, "8,7,1"))).unwrap().replacen(from, to, 1);
        let error = read("x.epw", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(place), "{error}");
    }
    assert!(read("x.bin", b"\x00\x01").unwrap_err().to_string().contains("EPW (first word LOCATION)"));
    assert!(read("x.epw", b"").unwrap_err().to_string().contains("LOCATION"));
}

#[test]
fn summer_time_in_the_header_is_told_and_not_followed() {
    let text = String::from_utf8(epw(&row("2005,6,21", 12, "8,7,1"))).unwrap();
    let weather = good(text.replace("SAVINGS,No,0,0,0", "SAVINGS,Yes,3/29,10/25,0").as_bytes());
    assert!(codes(&weather).contains(&"summer-time"));
    assert_eq!(weather.records[0].start, 11 * 3600);
}

#[test]
fn radiances_files_count_west_and_their_hours_are_middles() {
    let text = "place Somewhere_Land\nlatitude 40.78\nlongitude 73.96\ntime_zone 75\nsite_elevation 40.0\n\
                weather_data_file_units 1\n3 21 11.500 675 95\n3 21 12.500 725 136\n";
    let weather = read("x.wea", text.as_bytes()).unwrap();
    assert_eq!((weather.station.longitude, weather.station.utc_offset), (-73.96, -5.0));
    assert_eq!((weather.interval, weather.records[1].start), (60, 12 * 3600));
    assert_eq!(weather.records[0].middle(60), "2001-03-21T11:30:00");
    for (unit, quantity) in [("2", Quantity::HorizontalIrradiance), ("3", Quantity::NormalIlluminance)] {
        assert_eq!(
            read("x.wea", text.replace("units 1", &format!("units {unit}")).as_bytes()).unwrap().quantity,
            quantity
        );
    }
    let quarter = text.replace("11.500", "12.125").replace("12.500", "12.375");
    let weather = read("x.wea", quarter.as_bytes()).unwrap();
    assert_eq!((weather.interval, weather.records[0].start, weather.records[1].start), (15, 43_200, 44_100));
    assert_eq!(read("x.wea", text.replace("3 21 11", "2 29 11").as_bytes()).unwrap().records[1].day.year, 2004);
    for (from, to, place) in [
        ("725 136", "-5 136", "line 8, column 13, column 4 (direct normal irradiance): \"-5\""),
        ("725 136", "725", "line 8, column 16: a row of 4 numbers"),
        ("longitude", "lon", "line 3: \"lon 73.96\"; expected \"longitude\" and its value"),
        ("units 1", "units 7", "line 6, column 25, weather_data_file_units: \"7\""),
        ("time_zone 75", "time_zone 750", "time_zone: \"750\""),
        ("3 21 12.500", "3 21 25", "column 3 (hour): \"25\""),
    ] {
        let error = read("x.wea", text.replacen(from, to, 1).as_bytes()).unwrap_err().to_string();
        assert!(error.contains(place), "{error}");
    }
}

#[test]
fn makers_files_are_read_and_damaged_ones_judged() {
    let Some(folder) = data("data/weather") else { return };
    let mut files = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        assert!(is_weather_file(&name));
        let weather = load(&path, Path::new("")).unwrap();
        let whole = weather.records.len() == 8760;
        assert_eq!(codes(&weather).contains(&"partial-year"), !whole, "{name}");
        assert!(!codes(&weather).contains(&"order"), "{name}");
        assert_eq!(weather.examine().unwrap().missing == 0, whole, "{name}");
        files += 1;
    }
    assert!(files >= 10, "{files}");
    let Some(folder) = data("data/malformed") else { return };
    let load = |name: &str| load(&folder.join(name), Path::new(""));
    assert!(codes(&load("epw_missing_codes.epw").unwrap()).contains(&"light-missing"));
    assert!(codes(&load("epw_rows_missing.epw").unwrap()).contains(&"gaps"));
    for (name, said) in [
        ("epw_header_missing.epw", "line 1: \"1990,3,21,9"),
        ("epw_latitude_95.epw", "line 1, column 59, LOCATION, latitude: \"95.00\"; expected -90 to 90"),
        ("wea_negative.wea", "line 47, column 12, column 4 (direct normal irradiance): \"-5\"; expected 0 to"),
    ] {
        let error = load(name).unwrap_err().to_string();
        assert!(error.contains(said) && error.contains(name), "{error}");
    }
}

#[test]
fn tables_keep_what_light_needs() {
    let mut weather = good(&epw(&(1..=24)
        .map(|hour| row("2005,6,21", hour, if hour == 13 { "800,700.5,100" } else { "0,0,0" }))
        .collect::<String>()));
    weather.clock = -30.0;
    weather.tested = Some(Closure { rms: 26.7, best_offset: -30.0, best_rms: 1.8 });
    let text = table::write(&weather).unwrap();
    assert!(text.starts_with("cfs-weather 1\n") && text.ends_with("\n\n2005-06-21\n13,700.5,100,-4.4\n"), "{text}");
    let again = read("x.weather.txt", text.as_bytes()).unwrap();
    assert_eq!((again.clock, again.tested, again.records.len()), (weather.clock, weather.tested, 24));
    let light =
        |weather: &Weather| -> Vec<Hour> { weather.hours(Reading::default()).unwrap().map(Result::unwrap).collect() };
    assert_eq!(light(&again), light(&weather));
    // Its own clock is where "auto" leaves it.
    let auto = again.hours(Reading { offset: SunOffset::Auto, ..Reading::default() }).unwrap();
    assert_eq!(auto.offset(), -30.0);
    for (from, to, place) in [
        ("13,700.5", "25,700.5", "value 1 (hour): \"25\""),
        ("13,700.5,100", "13,9999,100", "value 2 (direct normal irradiance): \"9999\""),
        ("2005-06-21", "2005-06-31", "day: \"31\""),
        ("\n2005-06-21", "", "before those of its hours"),
        ("latitude = 48.5\n", "", "latitude: missing"),
        ("clock = -30", "clock = -300", "clock: \"-300\""),
        ("region", "regoin", "a key and its value"),
    ] {
        let text = text.replacen("latitude", "region = x\nlatitude", 1).replacen(from, to, 1);
        let error = read("x.weather.txt", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(place), "{error}");
    }
    weather.records.pop();
    assert!(table::write(&weather).unwrap_err().to_string().contains("whole day"));
}

/// The figures that come with the program are those of their sources: every hour has the same light.
#[test]
fn years_that_come_with_the_program_are_their_sources() {
    for (key, source, offset) in [
        ("new-york", "USA_NY_New.York.City-Central.Park.TMY3.epw", -30.0),
        ("renton", "USA_WA_Renton.TMY3.epw", 0.0),
        ("piedmont", "PVGIS_45N_8E_2005_2023.epw", 40.0),
    ] {
        let year = YEARS.iter().find(|year| year.key == key).unwrap();
        assert!(year.table.len() <= 100_000, "{key}: {} bytes", year.table.len());
        let name = format!("{BUILTIN}{key}");
        let builtin = load(Path::new(&name), Path::new("/nowhere")).unwrap();
        assert_eq!((builtin.records.len(), builtin.clock), (8760, offset));
        assert!(codes(&builtin).iter().all(|code| {
            ["clock-stated", "clock-untested", "sun-down-light", "dark-sky", "black-sky", "illuminance-missing"]
                .contains(code)
        }));
        let Some(path) = data(&format!("data/weather/{source}")) else { return };
        let epw = load(&path, Path::new("")).unwrap();
        if let Some(tested) = builtin.tested {
            let closure = epw.closure().unwrap().unwrap();
            assert_eq!(closure.best_offset, offset);
            assert!(
                (closure.rms - tested.rms).abs() < 0.06 && (closure.best_rms - tested.best_rms).abs() < 0.06,
                "{closure:?}"
            );
        }
        let moved = Reading { offset: SunOffset::Minutes(offset), ..Reading::default() };
        for (ours, theirs) in builtin.hours(Reading::default()).unwrap().zip(epw.hours(moved).unwrap()) {
            assert_eq!(ours.unwrap(), theirs.unwrap(), "{key}");
        }
        // Drawn again it is the same table.
        let mut again = epw;
        again.station = builtin.station.clone();
        (again.clock, again.tested) = (builtin.clock, builtin.tested);
        assert_eq!(table::write(&again).unwrap(), year.table, "{key}");
    }
    let error = load(Path::new("builtin:atlantis"), Path::new("")).unwrap_err().to_string();
    assert!(error.contains("builtin:new-york, builtin:piedmont, builtin:renton"), "{error}");
}
