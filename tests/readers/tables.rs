//! Readers of small tables and of archives: control curve, sky scan, figures, places, zip.

use super::choices::Choices;
use super::{again, edits, told};
use cfs::compute::limits;
use cfs::formats::control_curve::read_control_curve;
use cfs::formats::figures_table::{self, FigureRow};
use cfs::formats::scan::read_scan;
use cfs::formats::{FileKind, LuminaireFormat, archive, encoding, extension_of, gazetteer};
use std::fmt::Write as _;

pub fn make_curve(choices: &mut Choices) -> Vec<u8> {
    let (mut text, separator) = (String::new(), choices.pick(&[",", ";", " ", "\t"]));
    if choices.flag() {
        let _ = writeln!(text, "profile_angle_deg{separator}value_deg");
    }
    let count = 1 + choices.below(12);
    for k in 0..count {
        let _ = writeln!(text, "{}{separator}{}", -80.0 + 13.0 * k as f64, choices.tidy(-90.0, 90.0));
    }
    edits::text(choices, text)
}

pub fn read_curve(bytes: &[u8]) -> bool {
    let points = match read_control_curve(bytes) {
        Ok(points) => points,
        Err(error) => return told(&error),
    };
    assert!(points.windows(2).all(|pair| pair[0][0] < pair[1][0]), "profile angles that do not rise: {points:?}");
    assert!(points.iter().all(|[angle, value]| angle.abs() <= 90.0 && value.is_finite()), "{points:?}");
    let text: String = points.iter().map(|[angle, value]| format!("{angle},{value}\n")).collect();
    assert_eq!(again("a curve", read_control_curve(text.as_bytes())), points);
    true
}

pub fn make_scan(choices: &mut Choices) -> Vec<u8> {
    let mut text = "# sky\n".to_owned();
    let (header, step) = (choices.below(3), 1 + choices.below(90));
    if header > 0 {
        text.push_str(["", "L_mean_cdm2\n", "row;luminance;x\n"][header]);
    }
    for k in 0..145 {
        let value = 100 * ((k * step) % 97);
        let _ = match header {
            2 => writeln!(text, "{k};{value};0"),
            0 if k % 12 != 11 => write!(text, "{value} "),
            _ => writeln!(text, "{value}"),
        };
    }
    edits::text(choices, text)
}

pub fn read_scan_file(bytes: &[u8]) -> bool {
    let scan = match read_scan(bytes) {
        Ok(scan) => scan,
        Err(error) => return told(&error),
    };
    assert!(scan.values().iter().all(|value| (0.0..=limits::LUMINANCE).contains(value)), "{:?}", scan.values());
    let text: String = scan.values().iter().map(|value| format!("{value}\n")).collect();
    assert_eq!(again("a scan", read_scan(text.as_bytes())), scan);
    true
}

const ANGLES: [f64; 3] = [-45.0, 0.0, 45.0];

pub fn make_figures(choices: &mut Choices) -> Vec<u8> {
    let count = 1 + choices.below(6);
    let rows: Vec<FigureRow> = (0..count)
        .map(|k| FigureRow {
            product: format!("product-{k}"),
            fingerprint: "00ff".to_owned(),
            state: ["", "45"][k % 2].to_owned(),
            tau_normal: choices.between(0.0, 1.0),
            tau_hemispherical: choices.between(0.0, 1.0),
            tau_profile: ANGLES.map(|_| choices.between(0.0, 1.0)).to_vec(),
            to_ceiling: choices.flag().then(|| choices.between(0.0, 1.0)),
            sun_blocked: choices.between(0.0, 1.0),
            view: choices.between(0.0, 1.0),
        })
        .collect();
    let text = figures_table::write(&rows, &ANGLES);
    edits::text(choices, text)
}

pub fn read_figures(bytes: &[u8]) -> bool {
    let text = match encoding::decode(bytes) {
        Ok(text) => text,
        Err(error) => return told(&error),
    };
    match figures_table::read(&text, &ANGLES) {
        Ok(rows) => {
            let twin = again("a table of figures", figures_table::read(&figures_table::write(&rows, &ANGLES), &ANGLES));
            assert_eq!(twin.len(), rows.len(), "rows that got lost");
            true
        }
        Err(error) => told(&error),
    }
}

pub fn make_places(choices: &mut Choices) -> Vec<u8> {
    let mut text = "DE\tGermany\nUS\tUnited States\n\n".to_owned();
    for _ in 0..1 + choices.below(5) {
        let (latitude, longitude) = (choices.tidy(-90.0, 90.0), choices.tidy(-180.0, 180.0));
        let name = choices.words().replace(['\n', '\t'], " ");
        let _ = writeln!(text, "{name}\tDE\t\t{latitude}\t{longitude}\t{}\t1\tkoln,cologne", choices.pick(&["", "58"]));
    }
    let text = edits::text(choices, text);
    let packed = zstd::bulk::compress(&text, 1).expect("compression into memory");
    if choices.one_in(8) { edits::bytes(choices, packed) } else { packed }
}

pub fn read_places(bytes: &[u8]) -> bool {
    match gazetteer::read_cities(bytes) {
        Ok(list) => {
            let on_earth = |city: &gazetteer::City| city.latitude.abs() <= 90.0 && city.longitude.abs() <= 180.0;
            assert!(list.iter().all(on_earth), "a city beyond the earth");
            true
        }
        Err(error) => told(&error),
    }
}

pub fn make_archive(choices: &mut Choices) -> Vec<u8> {
    use std::io::{Cursor, Write as _};
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for k in 0..1 + choices.below(4) {
        let name = format!(
            "{}{k}{}",
            choices.pick(&["", "a/", "../", "__MACOSX/", "b\\c/"]),
            choices.pick(&[".xml", "", ".zip"])
        );
        // Names that are there already are left out.
        if zip.start_file(name, zip::write::SimpleFileOptions::default()).is_ok() {
            let content = vec![choices.byte(); 1 << choices.below(14)];
            zip.write_all(&content).expect("an archive in memory");
        }
    }
    let bytes = zip.finish().expect("an archive in memory").into_inner();
    edits::bytes(choices, bytes)
}

pub fn read_archive(bytes: &[u8]) -> bool {
    extension_of(bytes);
    let bytes = &archive::with_distinct_names(bytes.to_vec());
    let luminaires = LuminaireFormat::ALL.map(FileKind::Luminaire);
    let tables = [FileKind::Csv, FileKind::Json, FileKind::Comparison, FileKind::Svg];
    for kind in tables.into_iter().chain(luminaires) {
        kind.may_be(bytes);
    }
    let files = match archive::contents(bytes) {
        Ok(contents) => contents.files,
        Err(error) => return told(&error),
    };
    for file in files.iter().take(8) {
        match archive::read(bytes, file.index, 1 << 20) {
            Ok(file) => assert!(file.len() <= 1 << 20, "a file larger than it may be"),
            Err(error) => {
                told(&error);
            }
        }
    }
    true
}
