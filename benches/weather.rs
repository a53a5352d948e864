//! Run time of a year of weather: reading, positions of the sun, skies. The year is a built-in one, written as EPW.
//!
//! `cargo bench --bench weather`. Before the times, the largest deviation of the fast solar position from the
//! algorithm that it is derived from is printed.

use cfs::compute::direction::Dir;
use cfs::compute::weather::{Reading, Station, SunPath, Weather};
use cfs::formats::weather::read;
use cfs::study::sun_position::{Place, parse_local_time, sun_position};
use cfs::study::weather::load;
use divan::Bencher;
use std::fmt::Write as _;
use std::path::Path;

fn main() {
    println!("sun's path against the Solar Position Algorithm: at most {:.1e}°", worst_path());
    divan::main();
}

fn renton() -> Weather {
    load(Path::new("builtin:renton"), Path::new("")).expect("comes with the program")
}

/// Returns the built-in year as an EPW file.
fn epw() -> Vec<u8> {
    let weather = renton();
    let station = &weather.station;
    let mut text = format!(
        "LOCATION,made,-,-,made,0,{},{},{},{}\n",
        station.latitude, station.longitude, station.utc_offset, station.elevation
    );
    for line in ["DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0"] {
        let _ = writeln!(text, "{line}");
    }
    text.push_str(
        "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,\nCOMMENTS 2,\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n",
    );
    for record in &weather.records {
        let (day, hour) = (record.day, record.start / 60 + 1);
        let (direct, diffuse) = (record.direct.unwrap_or(0.0), record.diffuse.unwrap_or(0.0));
        let _ = writeln!(
            text,
            "{},{},{},{hour},0,?9?9?9?9E0?9?9?9?9?9?9?9?9?9?9?9?9?9?9?9*9*9?9?9?9,6.0,{},70,100100,0,0,314,{},{direct},{diffuse},\
             999999,999999,999999,9999,240,2.1,10,10,16.1,930,9,999999999,110,0.0900,0,88,0.350,0.0,1.0",
            day.year,
            day.month,
            day.day,
            record.dew_point.unwrap_or(99.9),
            direct + diffuse
        );
    }
    text.into_bytes()
}

fn worst_path() -> f64 {
    let place = Place::new(47.48, -122.22, -8.0).expect("a place on earth");
    let mut path =
        SunPath::new(&Station { latitude: 47.48, longitude: -122.22, utc_offset: -8.0, ..Station::default() });
    let mut worst: f64 = 0.0;
    for record in renton().records.iter().step_by(37) {
        path.turn_to(record.day.number()).expect("a year of our time");
        let time = parse_local_time(&record.middle(60)).expect("a moment of a year");
        let (altitude, bearing) = sun_position(&place, time).expect("a year of our time");
        let exact = Dir::from_altitude_bearing(altitude, bearing).vector();
        worst = worst.max((path.at(record.middle_minutes(60, 0.0)) - exact).length().to_degrees());
    }
    worst
}

#[divan::bench(sample_count = 10)]
fn read_epw(bencher: Bencher) {
    let bytes = epw();
    bencher.bench(|| read("x.epw", &bytes).expect("what was made here"));
}

#[divan::bench(sample_count = 10)]
fn read_and_place_suns(bencher: Bencher) {
    let bytes = epw();
    bencher.bench(|| {
        let weather = read("x.epw", &bytes).expect("what was made here");
        weather
            .hours(Reading::default())
            .expect("a whole year")
            .map(|hour| hour.map_or(0, |h| usize::from(h.is_lit())))
            .sum::<usize>()
    });
}

#[divan::bench(sample_count = 10)]
fn test_the_clock(bencher: Bencher) {
    let weather = read("x.epw", &epw()).expect("what was made here");
    bencher.bench(|| weather.closure().expect("a year of our time"));
}
