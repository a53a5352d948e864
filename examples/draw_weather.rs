//! Converts a weather file into the compact table of a built-in year (`assets/weather`).
//!
//! `cargo run --example draw_weather IN.epw OUT.weather.txt NAME REGION COUNTRY SOURCE`
//!
//! If the clock of the file is shifted, the table states by how much (`clock`) and how well global = diffuse + direct
//! · sin h then fits (`closure`). Look at the printed line: number of records, size and clock.

use cfs::compute::weather::Station;
use cfs::formats::weather::table;
use cfs::study::files::{self, Replace};
use cfs::study::weather::load;
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [input, output, name, region, country, source] = words.as_slice() else {
        return Err("expected IN.epw OUT.weather.txt NAME REGION COUNTRY SOURCE (an empty word for none)".into());
    };
    let mut weather = load(Path::new(input), Path::new(""))?;
    let [name, region, country, source] = [name, region, country, source].map(String::clone);
    weather.station = Station { name, region, country, source, ..weather.station };
    if let Some(closure) = weather.closure()?.filter(|closure| closure.is_off()) {
        weather.clock = closure.best_offset;
        weather.tested = Some(closure);
    }
    let text = table::write(&weather)?;
    files::write(Path::new(output), text.as_bytes(), Replace::But(&[]))?;
    println!("{output}: {} records, {} kB, clock {:+} min", weather.records.len(), text.len() / 1000, weather.clock);
    Ok(())
}
