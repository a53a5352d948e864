//! Index of luminaire files (`.index.csv`): position, size and flux of each file, and the undeviated sunbeam that the
//! lighting program has to compute itself.
//!
//! Columns by name, in any order: `file,x,y,z,width,height,flux_lm` are required, `file` relative to the index, the
//! tile's centre in room axes \[m\], its size along x and along z (façade) or y (roof) \[m\]. Written too:
//!
//! | column | meaning |
//! | --- | --- |
//! | `surface`, `aim` | `facade` or `roof`; `mounted` or `down`: orientation of the file's planes and angles |
//! | `beam_lm` | flux of the sun's beams in the file, widened \[lm\] |
//! | `apart_lm`, `apart_x`, `apart_y`, `apart_z` | undeviated beam outside the file \[lm\], its direction (room axes) |
//! | `apart_lx` | illuminance of that beam on a plane perpendicular to it \[lx\] |
//! | `set` | name of the member of a series that the file belongs to |

use super::encoding::{decode, not_too_long};
use super::{FormatError, Location};
use crate::compute::direction::Surface;
use crate::compute::lid::c_gamma::Aim;
use crate::compute::limits;
use glam::DVec3;
use std::collections::HashMap;

/// Undeviated beam of sunlight that is not contained in a luminaire file: the lighting program has to compute it
/// itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparateBeam {
    /// Luminous flux of the beam through the file's part of the aperture. \[lm\]
    pub flux: f64,
    /// Unit vector in which the beam travels, in the room's axes.
    pub direction: DVec3,
    /// Illuminance by the beam on a plane perpendicular to it. \[lx\]
    pub normal: f64,
}

/// Row of the index: one luminaire file with its position, size and flux.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Path of the luminaire file, relative to the index.
    pub file: String,
    /// Centre of the luminous area, in the room's axes. \[m\]
    pub centre: DVec3,
    /// Size of the luminous area along x, and along z (façade) or y (roof), in the room's axes. \[m\]
    pub size: [f64; 2],
    /// Luminous flux of the file. \[lm\]
    pub flux: f64,
    /// Part of the file's luminous flux that is in widened sunbeams (direct or redirected). \[lm\]
    pub beam: f64,
    /// Surface of the room that contains the luminous area, façade or roof; `None`: not specified.
    pub surface: Option<Surface>,
    /// Orientation of the file's C planes: for a luminaire mounted in the aperture, or pointing down; `None`: not
    /// specified.
    pub aim: Option<Aim>,
    /// Undeviated beam of sunlight that the lighting program has to compute itself; `None` if there is none.
    pub separate_beam: Option<SeparateBeam>,
    /// Name of the member of a series (e.g. of times) that the file belongs to; empty without a series.
    pub set: String,
}

const HEADER: &str =
    "file,x,y,z,width,height,flux_lm,surface,aim,beam_lm,apart_lm,apart_x,apart_y,apart_z,apart_lx,set";

/// Maximum absolute value of lengths and coordinates. \[m\]
const LONGEST: f64 = 1e6;
/// Minimum luminous flux of an undeviated beam; weaker ones are left out. \[lm\]
const MIN_BEAM_FLUX: f64 = 1e-4;

/// Returns an index of luminaire files as CSV text.
pub fn write(rows: &[Row]) -> Vec<u8> {
    let mut text = format!("{HEADER}\r\n");
    for row in rows {
        let [x, y, z] = row.centre.to_array();
        let [width, height] = row.size;
        let surface = row.surface.map_or("", |surface| match surface {
            Surface::Facade => "facade",
            Surface::Roof => "roof",
        });
        let aim = row.aim.map_or("", |aim| match aim {
            Aim::Mounted => "mounted",
            Aim::Down => "down",
        });
        let beam_columns = row.separate_beam.map_or_else(
            || ",,,,".to_owned(),
            |beam| {
                let d = beam.direction;
                format!("{:.4},{:.8},{:.8},{:.8},{:.4}", beam.flux, d.x, d.y, d.z, beam.normal)
            },
        );
        text.push_str(&format!(
            "{},{x:.6},{y:.6},{z:.6},{width:.6},{height:.6},{:.6},{surface},{aim},{:.6},{beam_columns},{}\r\n",
            quoted(&row.file),
            row.flux,
            row.beam,
            quoted(&row.set)
        ));
    }
    text.into_bytes()
}

/// Returns a field quoted as CSV requires.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\r', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// Reads an index of luminaire files.
///
/// # Errors
/// Returns an error with the line if a required column or number is missing, a size is not valid, or a word is unknown.
pub fn read(bytes: &[u8]) -> Result<Vec<Row>, FormatError> {
    let text = decode(not_too_long(bytes)?)?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).from_reader(text.as_bytes());
    let broken = |error: &csv::Error| {
        let line = error.position().map_or(1, csv::Position::line) as usize;
        FormatError::new(Location::line(line), "what is not CSV", "comma-separated values, one file a line")
    };
    let header = reader.headers().map_err(|error| broken(&error))?.clone();
    let columns: HashMap<&str, usize> = header.iter().zip(0..).collect();
    for needed in ["file", "x", "y", "z", "width", "height", "flux_lm"] {
        if !columns.contains_key(needed) {
            let expected = "the columns file, x, y, z, width, height, flux_lm of an index of luminaire files";
            return Err(FormatError::new(Location::line(1), format!("no column \"{needed}\""), expected));
        }
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| broken(&error))?;
        rows.push(row(&columns, &record)?);
    }
    if rows.is_empty() {
        return Err(FormatError::new(Location::file(), "no rows", "one luminaire file a line"));
    }
    Ok(rows)
}

fn row(columns: &HashMap<&str, usize>, record: &csv::StringRecord) -> Result<Row, FormatError> {
    let line = record.position().map_or(0, csv::Position::line) as usize;
    let wrong = |found: String, expected: &str| FormatError::new(Location::line(line), found, expected);
    let word = |name: &str| columns.get(name).and_then(|&k| record.get(k)).unwrap_or_default();
    let number = |name: &str| {
        let value = word(name).parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| wrong(format!("{name} \"{}\"", word(name)), "a number"))
    };
    let or_zero = |name: &str| if word(name).is_empty() { Ok(0.0) } else { number(name) };
    let light = |name: &str, value: f64| match value {
        value if (0.0..=limits::LAMP_FLUX).contains(&value) => Ok(value),
        other => Err(wrong(format!("{name} {other:e}"), "light, 0 or more")),
    };
    let length = |name: &str| match number(name)? {
        length if (limits::OPENING..=LONGEST).contains(&length) => Ok(length),
        other => Err(wrong(format!("{name} {other:e}"), "a length above 0 m")),
    };
    let place = |name: &str| match number(name)? {
        place if place.abs() <= LONGEST => Ok(place),
        other => Err(wrong(format!("{name} {other:e}"), "metres")),
    };
    let surface = match word("surface") {
        "" => None,
        "facade" => Some(Surface::Facade),
        "roof" => Some(Surface::Roof),
        other => return Err(wrong(format!("surface \"{other}\""), "facade or roof")),
    };
    let aim = match word("aim") {
        "" => None,
        "mounted" => Some(Aim::Mounted),
        "down" => Some(Aim::Down),
        other => return Err(wrong(format!("aim \"{other}\""), "mounted or down")),
    };
    let file = word("file").to_owned();
    if file.is_empty() {
        return Err(wrong("no file".to_owned(), "the name of a luminaire file"));
    }
    let (beam_flux, direction) =
        (or_zero("apart_lm")?, DVec3::new(or_zero("apart_x")?, or_zero("apart_y")?, or_zero("apart_z")?));
    // Less is written as nothing.
    let separate_beam = if light("apart_lm", beam_flux)? >= MIN_BEAM_FLUX {
        let direction = direction.try_normalize();
        let direction = direction.ok_or_else(|| {
            wrong("a beam (apart_lm) whose direction is 0".to_owned(), "its direction in apart_x, apart_y and apart_z")
        })?;
        Some(SeparateBeam { flux: beam_flux, direction, normal: light("apart_lx", or_zero("apart_lx")?)? })
    } else {
        None
    };
    Ok(Row {
        file,
        centre: DVec3::new(place("x")?, place("y")?, place("z")?),
        size: [length("width")?, length("height")?],
        flux: light("flux_lm", number("flux_lm")?)?,
        beam: light("beam_lm", or_zero("beam_lm")?)?,
        surface,
        aim,
        separate_beam,
        set: word("set").to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Vec<Row> {
        let apart = SeparateBeam { flux: 12.5, direction: DVec3::new(0.0, 0.6, -0.8), normal: 30_000.0 };
        let first = Row {
            file: "a, b_1.ies".into(),
            centre: DVec3::new(0.5, 0.0, 1.25),
            size: [0.35, 0.1875],
            flux: 100.25,
            beam: 4.5,
            surface: Some(Surface::Facade),
            aim: Some(Aim::Mounted),
            separate_beam: Some(apart),
            set: String::new(),
        };
        let second = Row { file: "b.ies".into(), surface: Some(Surface::Roof), aim: Some(Aim::Down), ..first.clone() };
        vec![first, Row { separate_beam: None, set: "06-21 12:00".into(), ..second }]
    }

    #[test]
    fn what_is_written_is_read() {
        assert_eq!(read(&write(&example())).unwrap(), example());
    }

    #[test]
    fn text_is_read_as_spreadsheets_save_it() {
        let text = String::from_utf8(write(&example())).unwrap();
        let utf16: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [utf16, format!("\u{feff}{text}").into_bytes(), text.replace("\r\n", "\r").into_bytes()] {
            assert_eq!(read(&bytes).unwrap(), example());
        }
    }

    #[test]
    fn the_needed_columns_are_enough_in_any_order() {
        let rows = read(b"z,y,x,flux_lm,height,width,file,remark\n1.5,0,2,10,1,2,a.ldt,old\n").unwrap();
        assert_eq!((rows[0].centre, rows[0].size), (DVec3::new(2.0, 0.0, 1.5), [2.0, 1.0]));
        assert_eq!((rows[0].surface, rows[0].aim, rows[0].separate_beam), (None, None, None));
    }

    #[test]
    fn faults_are_told_with_their_line() {
        let good = String::from_utf8(write(&example())).unwrap();
        for (from, to, line, gist) in [
            ("flux_lm", "lumen", 1, "flux_lm"),
            ("0.350000", "-0.35", 2, "width"),
            ("roof", "wall", 3, "wall"),
            (",down", ",up", 3, "mounted or down"),
            ("b.ies", "", 3, "name of a luminaire file"),
            ("1.250000", "high", 2, "z \"high\""),
        ] {
            let error = read(good.replacen(from, to, 1).as_bytes()).unwrap_err();
            assert_eq!(error.at, Location::line(line), "{error}");
            assert!(error.to_string().contains(gist), "{error}");
        }
        assert!(read(b"").is_err());
        assert!(read(format!("{HEADER}\n").as_bytes()).unwrap_err().to_string().contains("no rows"));
    }
}
