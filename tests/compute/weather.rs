//! Hours of weather: the sun's place in the lit part, light by luminous efficacy, the clock's test.

use crate::common::data;
use crate::goniophotometer_slats::kit::gunzip;
use cfs::compute::direction::Dir;
use cfs::compute::weather::{
    Day, Hour, HourError, LightSource, Quantity, Reading, Record, Station, SunOffset, SunPath, Weather,
};
use cfs::formats::weather::read;
use cfs::study::sun_position::{Place, parse_local_time, sun_position};

const PALM_SPRINGS: &str = "CA_Palm-Springs.CZ2010.epw";
const RENTON: &str = "USA_WA_Renton.TMY3.epw";
const NEW_YORK: &str = "USA_NY_New.York.City-Central.Park.TMY3.epw";
const PVGIS: &str = "PVGIS_45N_8E_2005_2023.epw";

fn weather(name: &str) -> Option<Weather> {
    let path = data(&format!("data/weather/{name}"))?;
    Some(read(name, &std::fs::read(path).unwrap()).unwrap())
}

fn moved(minutes: f64) -> Reading {
    Reading { offset: SunOffset::Minutes(minutes), ..Reading::default() }
}

/// A station with a record an hour of one day.
fn day_of(latitude: f64, day: Day, direct: f64, diffuse: f64) -> Weather {
    let records = (0..24_u16).map(|hour| Record {
        day,
        start: 3600 * i32::from(hour),
        direct: Some(direct),
        diffuse: Some(diffuse),
        global: None,
        dew_point: None,
        direct_illuminance: None,
        diffuse_illuminance: None,
        line: 9 + u32::from(hour),
    });
    Weather {
        first_weekday: None,
        format: "made",
        station: Station { latitude, ..Station::default() },
        quantity: Quantity::NormalIrradiance,
        interval: 60,
        clock: 0.0,
        tested: None,
        records: records.collect(),
        findings: Vec::new(),
        field_names: ["direct", "diffuse"],
    }
}

fn hours(weather: &Weather, reading: Reading) -> Vec<Hour> {
    weather.hours(reading).unwrap().map(|hour| hour.unwrap()).collect()
}

/// Reference years state for every hour where the sun was taken, and the light.
#[test]
fn hours_are_those_of_the_reference_years() {
    for (name, case, offset) in [
        (RENTON, "open_south_renton", 0.0),
        (NEW_YORK, "klems_south_newyork", -30.0),
        (PVGIS, "diffuse_east_pvgis", 40.0),
        (PALM_SPRINGS, "glass_west_palm", 0.0),
    ] {
        let Some(weather) = weather(name) else { return };
        let Some(path) = data(&format!("reference/cases/annual/{case}.hours.csv.gz")) else { return };
        let text = String::from_utf8(gunzip(&std::fs::read(path).unwrap())).unwrap();
        let hours = hours(&weather, moved(offset));
        assert_eq!(text.lines().count(), 8761);
        assert_eq!(hours.len(), 8760);
        let (mut lit, mut partial) = (0, 0);
        for (line, hour) in text.lines().skip(1).zip(&hours) {
            let field: Vec<&str> = line.split(',').collect();
            let number = |k: usize| field[k].parse::<f64>().unwrap();
            assert_eq!(weather.records[hour.index].middle(weather.interval), field[0]);
            let expected = Dir::from_altitude_bearing(
                number(1).to_radians(),
                cfs::compute::angle::Bearing::from_degrees(number(2)),
            );
            let apart = (hour.sun.vector() - expected.vector()).length().to_degrees();
            // Written to a thousandth.
            assert!(apart < 1.5e-3, "{case} {line:.60}: {apart}°");
            for (got, expected) in [(hour.direct_normal, number(3)), (hour.diffuse_horizontal, number(4))] {
                // Written to five digits.
                assert!((got - expected).abs() <= 2e-4 * expected + 1e-2, "{case} {line:.60}: {got}");
            }
            lit += usize::from(hour.is_lit());
            partial += usize::from(hour.lit > 0.0 && hour.lit < 1.0);
        }
        assert!(lit > 4000 && partial > 600, "{case}: {lit} {partial}");
    }
}

#[test]
fn the_fast_path_of_the_sun_is_that_of_the_algorithm() {
    let mut worst: f64 = 0.0;
    for (latitude, longitude, utc_offset) in
        [(48.8, 9.2, 1.0), (-33.9, 151.2, 10.0), (78.2, 15.6, 1.0), (0.0, -179.5, -12.0), (-90.0, 0.0, 0.0)]
    {
        let place = Place::new(latitude, longitude, utc_offset).unwrap();
        let station = Station { latitude, longitude, utc_offset, ..Station::default() };
        let mut path = SunPath::new(&station);
        for (year, month, day) in
            [(1958, 1, 1), (1958, 1, 2), (2005, 6, 21), (2024, 2, 29), (2024, 3, 1), (2099, 12, 31)]
        {
            path.turn_to(Day::new(year, month, day).unwrap().number()).unwrap();
            for minute in [0, 7, 360, 725, 1081, 1439] {
                let text = format!("{year}-{month:02}-{day:02}T{:02}:{:02}", minute / 60, minute % 60);
                let (altitude, bearing) = sun_position(&place, parse_local_time(&text).unwrap()).unwrap();
                let expected = Dir::from_altitude_bearing(altitude, bearing).vector();
                worst = worst.max((path.at(f64::from(minute)) - expected).length().to_degrees());
            }
        }
    }
    assert!(worst < 2e-6, "{worst}°");
}

#[test]
fn partial_hours_have_their_sun_in_the_lit_part() {
    // On the equator the sun rises near 6 h: a day in which it rises within an hour.
    let day = Day::new(2001, 2, 11).unwrap();
    let weather = day_of(0.0, day, 300.0, 100.0);
    let hours = hours(&weather, Reading::default());
    let sunrise = &hours[6];
    assert!(sunrise.lit > 0.5 && sunrise.lit < 1.0, "{}", sunrise.lit);
    assert!(sunrise.sun.altitude() > 0.0 && sunrise.direct_normal_irradiance == 300.0);
    // Its altitude there is that of the middle between rise and the hour's end: half an hour's share of 15°/h.
    let expected = (0.5 * sunrise.lit * 15.0 * day_cosine(day)).to_radians();
    assert!((sunrise.sun.altitude() / expected - 1.0).abs() < 0.01, "{} {expected}", sunrise.sun.altitude());
    let total: f64 = hours.iter().map(|hour| hour.lit).sum();
    assert!((total - 12.0).abs() < 0.05, "{total}");
    // Twilight: no beam, a sky whose bright part stands on the horizon, the sun below it.
    let night = &hours[5];
    assert_eq!((night.lit, night.direct_normal, night.direct_normal_irradiance), (0.0, 0.0, 0.0));
    assert!(night.sun.altitude() < 0.0 && night.diffuse_horizontal > 5_000.0);
    assert!(night.sky_sun().altitude().abs() < 1e-12);
    assert!((night.sky_sun().bearing().degrees() - night.sun.bearing().degrees()).abs() < 1e-9);
    assert!(night.state.unwrap().clearness <= 1.0 + 1e-12);
}

/// Cosine of the declination.
fn day_cosine(day: Day) -> f64 {
    let mut path = SunPath::new(&Station { latitude: 90.0, ..Station::default() });
    path.turn_to(day.number()).unwrap();
    path.at(720.0).z.asin().cos()
}

#[test]
fn polar_days_nights_and_the_zenith_are_finite() {
    for (latitude, month, day, lit) in
        [(78.0, 6, 21, 24.0), (78.0, 12, 21, 0.0), (90.0, 6, 21, 24.0), (-90.0, 6, 21, 0.0)]
    {
        let hours = hours(&day_of(latitude, Day::new(2004, month, day).unwrap(), 500.0, 80.0), Reading::default());
        assert_eq!(hours.iter().map(|hour| hour.lit).sum::<f64>(), lit, "{latitude} {month}");
        assert!(hours.iter().all(|hour| hour.diffuse_horizontal > 0.0 && (hour.direct_normal > 0.0) == (lit > 0.0)));
    }
    // The sun that goes below for less than an hour at midnight.
    for latitude in [66.0, 66.4, 66.6, 66.9] {
        let all = hours(&day_of(latitude, Day::new(2004, 6, 21).unwrap(), 500.0, 80.0), Reading::default());
        for hour in &all {
            assert!(hour.sun.vector().is_finite() && hour.direct_normal.is_finite() && hour.diffuse_horizontal > 0.0);
            assert_eq!(hour.lit > 0.0, hour.sun.altitude() > 0.0, "{latitude} {hour:?}");
        }
    }
    // Through the zenith.
    let hours = hours(&day_of(23.4, Day::new(2004, 6, 21).unwrap(), 900.0, 90.0), moved(30.0));
    assert!(hours.iter().map(|hour| hour.sun.altitude()).fold(0.0, f64::max) > 89.0_f64.to_radians());
    assert!(hours.iter().all(|hour| hour.sun.vector().is_finite() && hour.direct_normal.is_finite()));
}

#[test]
fn clocks_are_tested_by_the_files_own_irradiances() {
    // Where it closes best, what is left over there and at the file's own clock, over the hours with sun. W/m²
    for (name, best, rms_at_best, rms) in [
        (RENTON, 0.0, 0.55, 0.55),
        (PALM_SPRINGS, 0.0, 3.36, 3.36),
        (NEW_YORK, -30.0, 1.49, 21.93),
        (PVGIS, 40.0, 0.81, 38.17),
    ] {
        let Some(weather) = weather(name) else { return };
        let closure = weather.closure().unwrap().unwrap();
        assert_eq!(closure.best_offset, best, "{name} {closure:?}");
        assert!(
            (closure.best_rms - rms_at_best).abs() < 0.01 && (closure.rms - rms).abs() < 0.01,
            "{name} {closure:?}"
        );
        assert_eq!(closure.is_off(), best != 0.0, "{name}");
        let said = weather.examine().unwrap().findings.iter().any(|finding| finding.code == "clock-off");
        assert_eq!(said, best != 0.0, "{name}");
        // "auto" takes it, and nothing else does.
        let auto = weather.hours(Reading { offset: SunOffset::Auto, ..Reading::default() }).unwrap();
        assert_eq!((auto.offset(), weather.hours(Reading::default()).unwrap().offset()), (best, 0.0));
    }
}

#[test]
fn a_clock_that_cannot_be_tested_is_not_guessed() {
    let weather = day_of(40.0, Day::new(2001, 6, 21).unwrap(), 500.0, 80.0);
    assert_eq!(weather.closure().unwrap(), None);
    let refused = weather.hours(Reading { offset: SunOffset::Auto, ..Reading::default() });
    assert!(matches!(refused, Err(HourError::NoClosure)));
    assert!(matches!(weather.hours(moved(181.0)), Err(HourError::Offset(_))));
    assert!(matches!(weather.hours(moved(f64::NAN)), Err(HourError::Offset(_))));
}

#[test]
fn light_missing_by_day_is_refused_where_it_stands_and_by_night_is_dark() {
    let mut weather = day_of(40.0, Day::new(2001, 6, 21).unwrap(), 500.0, 80.0);
    weather.records[2].direct = None;
    weather.records[2].diffuse = None;
    weather.records[13].direct = None;
    let mut hours = weather.hours(Reading::default()).unwrap();
    assert!(!hours.at(2).unwrap().is_lit());
    let error = hours.at(13).unwrap_err().to_string();
    assert!(error.starts_with("line 22: direct is missing") && error.contains("2001-06-21 13:00–14:00"), "{error}");
    let summary = weather.examine().unwrap();
    let finding = summary.findings.iter().find(|finding| finding.code == "light-missing").unwrap();
    assert!(finding.message.contains("1 row, first in line 22"), "{}", finding.message);
}

#[test]
fn the_files_own_light_is_taken_where_it_is_plausible() {
    let mut weather = day_of(40.0, Day::new(2001, 6, 21).unwrap(), 500.0, 80.0);
    for (hour, light) in
        [(12, (Some(50_000.0), Some(9_000.0))), (13, (Some(50_000.0), Some(90_000.0))), (14, (None, Some(9_000.0)))]
    {
        (weather.records[hour].direct_illuminance, weather.records[hour].diffuse_illuminance) = light;
    }
    let file = hours(&weather, Reading { light: LightSource::File, ..Reading::default() });
    let model = hours(&weather, Reading::default());
    assert_eq!(
        (file[12].direct_normal, file[12].diffuse_horizontal, file[12].light),
        (50_000.0, 9_000.0, LightSource::File)
    );
    assert_eq!(file[12].state, model[12].state);
    for hour in [13, 14, 15] {
        assert_eq!(file[hour], model[hour]);
        assert_eq!(file[hour].light, LightSource::Efficacy);
    }
    assert!(model.iter().all(|hour| hour.light == LightSource::Efficacy));
    assert_eq!(weather.examine().unwrap().with_illuminances, 1);
}

/// The three units of Radiance's files are three ways to the same hour.
#[test]
fn horizontal_beams_and_illuminances_lead_back_to_the_same_hour() {
    let weather = day_of(40.0, Day::new(2001, 6, 21).unwrap(), 500.0, 80.0);
    let normal = hours(&weather, Reading::default());
    let mut horizontal = weather.clone();
    horizontal.quantity = Quantity::HorizontalIrradiance;
    let mut light = weather.clone();
    light.quantity = Quantity::NormalIlluminance;
    for (k, hour) in normal.iter().enumerate() {
        horizontal.records[k].direct = Some(500.0 * hour.sun.vector().z.max(0.0));
        light.records[k].direct = Some(hour.direct_normal);
        light.records[k].diffuse = Some(hour.diffuse_horizontal);
    }
    for (other, most) in [(hours(&horizontal, Reading::default()), 1e-9), (hours(&light, Reading::default()), 1e-4)] {
        for (a, b) in normal.iter().zip(&other) {
            for (a, b) in [
                (a.direct_normal_irradiance, b.direct_normal_irradiance),
                (a.diffuse_horizontal_irradiance, b.diffuse_horizontal_irradiance),
                (a.direct_normal, b.direct_normal),
                (a.diffuse_horizontal, b.diffuse_horizontal),
            ] {
                assert!((a - b).abs() <= most * a, "{a} {b}");
            }
        }
    }
}

#[test]
fn suns_without_sky_keep_their_light() {
    let Some(weather) = weather(PALM_SPRINGS) else { return };
    let summary = weather.examine().unwrap();
    assert_eq!(summary.without_sky, 59);
    for hour in hours(&weather, Reading::default()) {
        if hour.diffuse_horizontal_irradiance == 0.0 && hour.direct_normal_irradiance > 0.0 {
            assert!(hour.direct_normal > 0.0 && hour.diffuse_horizontal == 0.0);
        }
    }
}

#[test]
fn sums_are_those_of_the_files() {
    // kWh/m²: global, direct normal, diffuse, added up field by field.
    for (name, sums) in [
        (NEW_YORK, [1257.4, 1095.7, 586.7]),
        (RENTON, [1256.0, 1187.7, 582.8]),
        (PALM_SPRINGS, [2016.3, 2449.5, 577.3]),
        (PVGIS, [1435.9, 1591.6, 570.9]),
    ] {
        let Some(weather) = weather(name) else { return };
        let got = weather.examine().unwrap().sums;
        for (got, expected) in [got.global, got.direct_normal, got.diffuse].into_iter().zip(sums) {
            // Beams of rows with the sun down are left out: told as such.
            assert!((got - expected).abs() < 0.06 || (expected - got) / expected < 0.01, "{name} {got} {expected}");
        }
        let efficacy = got.global_light / got.global;
        // The Californian file's own illuminances are low: 63 lm/W of its sun.
        assert!((80.0..125.0).contains(&efficacy), "{name} {efficacy}");
    }
}

#[test]
fn wrong_signs_and_gaps_are_told() {
    let Some(path) = data("data/weather/NYC.wea") else { return };
    let text = std::fs::read_to_string(path).unwrap();
    let codes = |text: &str| {
        let weather = read("x.wea", text.as_bytes()).unwrap();
        weather.examine().unwrap().findings.iter().map(|finding| finding.code).collect::<Vec<_>>()
    };
    assert!(!codes(&text).contains(&"sun-down-light"));
    let east = text.replace("longitude 73.96", "longitude -73.96").replace("time_zone 75", "time_zone -75");
    // Both wrong cancel out: noon is where it was.
    assert!(!codes(&east).contains(&"sun-down-light"));
    // Only one of the two signs wrong: the sun is hours off.
    assert!(codes(&text.replace("longitude 73.96", "longitude -73.96")).contains(&"sun-down-light"));
    let mut lines: Vec<&str> = text.lines().collect();
    lines.drain(2000..2003);
    let gap = read("x.wea", lines.join("\n").as_bytes()).unwrap().examine().unwrap();
    assert_eq!(gap.missing, 3);
    let message = &gap.findings.iter().find(|finding| finding.code == "gaps").unwrap().message;
    assert!(message.contains("3 h between lines 2000 and 2001"), "{message}");
    lines.insert(1000, lines[1000]);
    assert!(codes(&lines.join("\n")).contains(&"order"));
}

/// A typical year: each month of another year, one record a day.
fn spliced(years: [i16; 12], first_weekday: Option<u8>) -> Weather {
    let month = |(month, year): (u8, i16)| {
        (1..=31).filter_map(move |day| Day::new(year, month, day)).filter(|day| (day.month, day.day) != (2, 29))
    };
    let days = (1..).zip(years).flat_map(month);
    let records = days.map(|day| Record { day, ..day_of(45.0, day, 0.0, 0.0).records[12] }).collect();
    Weather { first_weekday, records, ..day_of(45.0, Day::new(2001, 1, 1).unwrap(), 0.0, 0.0) }
}

#[test]
fn weekdays_of_typical_years_are_those_of_one_calendar() {
    const SUNDAY: u8 = 6;
    let working = |weather: &Weather| weather.weekdays().iter().filter(|weekday| **weekday < 5).count();
    let years = [1999, 1983, 1992, 2001, 1987, 1990, 1979, 1995, 1980, 2003, 1976, 1998];
    let stated = spliced(years, Some(SUNDAY));
    assert!(stated.is_spliced());
    let weekdays = stated.weekdays();
    assert_eq!((weekdays.len(), weekdays[0], weekdays[31], weekdays[364]), (365, SUNDAY, 2, SUNDAY));
    assert!(weekdays.windows(2).all(|pair| pair[1] == (pair[0] + 1) % 7));
    assert_eq!(working(&stated), 260);
    // Without a statement the calendar begins as in the year of the first record: 1 January 1999 was a Friday.
    let own = spliced(years, None);
    assert_eq!(own.weekdays()[0], 4);
    assert!((260..=262).contains(&working(&own)));
    // The rows of one year, or of years that follow each other, have their own weekdays, whatever the file states.
    for year in [spliced([2024; 12], Some(SUNDAY)), spliced([2023; 12], Some(SUNDAY))] {
        assert!(!year.is_spliced());
        let own: Vec<u8> = year.records.iter().map(|record| record.day.weekday()).collect();
        assert_eq!(year.weekdays(), own);
    }
}

#[test]
fn whole_hours_of_an_offset_are_a_clock_that_is_wrong() {
    let weather = day_of(45.0, Day::new(2001, 6, 21).unwrap(), 100.0, 100.0);
    for (minutes, moved_clock) in [(0.0, 0), (30.0, 0), (59.0, 0), (60.0, 60), (-90.0, -60), (150.0, 120)] {
        let hours = weather.hours(moved(minutes)).unwrap();
        assert_eq!((hours.moved_clock(), hours.offset()), (moved_clock, minutes));
    }
}

#[test]
fn a_black_sky_under_a_high_sun_is_warned_of() {
    let codes = |diffuse: f64| -> Vec<&'static str> {
        let weather = day_of(45.0, Day::new(2001, 6, 21).unwrap(), 0.0, diffuse);
        weather.examine().unwrap().findings.iter().map(|finding| finding.code).collect()
    };
    assert!(codes(0.0).contains(&"black-sky") && !codes(10.0).contains(&"black-sky"));
}
