//! Luminaire files: what is written is read back, real files are read, damaged ones are refused with their reason.

use crate::common::data;
use cfs::compute::direction::{Dir, Facade, Surface};
use cfs::compute::lid::c_gamma::{Aim, CGammaTable, Step};
use cfs::compute::lid::{EmergentLuminance, Lid};
use cfs::formats::ies::IesEdition;
use cfs::formats::luminaire::{Description, Luminaire, Photometry};
use cfs::formats::{FormatError, Location, eulumdat, ies};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

fn lid(parts: Vec<EmergentLuminance>) -> Lid {
    Lid { surface: Surface::Facade, size: [1.2, 0.7], parts, beams: Vec::new() }
}

/// Only up and to the right seen from outside, on top of a little light everywhere.
fn lopsided() -> Lid {
    lid(vec![
        EmergentLuminance::Uniform(50.0),
        EmergentLuminance::Function(Arc::new(|twin: Dir<Facade>| {
            let goes = twin.reversed().vector();
            if goes.x > 0.0 && goes.y > 0.0 { 4000.0 } else { 0.0 }
        })),
    ])
}

fn text() -> Description {
    Description {
        report: "scene façade.toml, aperture 1".into(),
        laboratory: "computed".into(),
        date: "2026-03-21".into(),
        manufacturer: "Größe & Söhne".into(),
        number: "A-1".into(),
        name: "Opening".into(),
        lamp: "sky".into(),
        remarks: vec!["word ".repeat(80)],
    }
}

fn luminaire(lid: &Lid, aim: Aim, step: Step) -> Luminaire {
    Luminaire::from_table(&CGammaTable::new(lid, aim, step), lid.size, text())
}

fn formats(luminaire: &Luminaire) -> [Luminaire; 3] {
    [
        eulumdat::read(&eulumdat::write(luminaire)).expect("own EULUMDAT"),
        ies::read(&ies::write(luminaire, IesEdition::Lm63_2002)).expect("own LM-63-2002"),
        ies::read(&ies::write(luminaire, IesEdition::Lm63_2019)).expect("own LM-63-2019"),
    ]
}

#[test]
fn what_is_written_is_read_back() {
    for (aim, step) in [(Aim::Mounted, Step::NORMAL), (Aim::Down, Step::NORMAL), (Aim::Mounted, Step::FINE)] {
        let original = luminaire(&lopsided(), aim, step);
        for back in formats(&original) {
            assert_eq!(back.c_deg, original.c_deg);
            assert_eq!(back.gamma_deg, original.gamma_deg);
            for (a, b) in back.intensity.iter().zip(&original.intensity) {
                assert!((a - b).abs() < 1e-5 * original.peak(), "{a} {b}");
            }
            assert!((back.flux() / original.flux() - 1.0).abs() < 1e-4);
            assert!((back.opening.along_c90 - original.opening.along_c90).abs() < 1e-9);
            assert!((back.opening.along_c0 - original.opening.along_c0).abs() < 1.1e-3);
            assert!((back.opening.height - original.opening.height).abs() < 1e-9);
            assert_eq!(back.text.name, "Opening");
            assert_eq!(back.text.manufacturer, "Groesse & Soehne");
        }
    }
}

#[test]
fn flux_in_the_file_is_the_flux_of_the_aperture() {
    // ∫L cosθ dω · A: 50 π over the hemisphere and 4000 π/4 over the quarter.
    let exact = (50.0 * PI + 4000.0 * PI / 4.0) * 1.2 * 0.7;
    for aim in [Aim::Mounted, Aim::Down] {
        for back in formats(&luminaire(&lopsided(), aim, Step::NORMAL)) {
            assert!((back.flux() / exact - 1.0).abs() < 1e-4, "{} {exact}", back.flux());
        }
    }
}

#[test]
fn up_is_up_and_right_is_right_in_the_files() {
    for back in formats(&luminaire(&lopsided(), Aim::Mounted, Step::NORMAL)) {
        // Into the room, 45° to the right (C315) or left (C45), 45° up (γ 135) or down.
        let at = |c: f64, gamma: f64| {
            let plane = back.c_deg.iter().position(|x| (x - c).abs() < 1e-9).expect("plane");
            let angle = back.gamma_deg.iter().position(|x| (x - gamma).abs() < 1e-9).expect("angle");
            back.plane(plane)[angle]
        };
        let cosine = 45_f64.to_radians().sin() * 45_f64.to_radians().cos() * 1.2 * 0.7;
        assert!((at(315.0, 135.0) / (4050.0 * cosine) - 1.0).abs() < 2e-3);
        for (c, gamma) in [(45.0, 135.0), (315.0, 45.0), (45.0, 45.0)] {
            assert!((at(c, gamma) / (50.0 * cosine) - 1.0).abs() < 2e-3);
        }
        assert!(at(180.0, 90.0) < 1e-6 * back.peak());
    }
}

#[test]
fn files_keep_to_their_format() {
    let fine = luminaire(&lopsided(), Aim::Mounted, Step::FINE);
    for edition in [IesEdition::Lm63_2002, IesEdition::Lm63_2019] {
        let file = String::from_utf8(ies::write(&fine, edition)).expect("ASCII");
        assert!(file.is_ascii() && file.ends_with("\r\n"));
        assert!(file.lines().all(|line| line.len() <= 132));
        for keyword in ["[TEST] ", "[TESTLAB] ", "[ISSUEDATE] ", "[MANUFAC] ", "[LUMCAT] ", "[LUMINAIRE] ", "[LAMP] "] {
            assert_eq!(file.matches(keyword).count(), 1, "{keyword}");
        }
        let (first, generation) = match edition {
            IesEdition::Lm63_2002 => ("IESNA:LM-63-2002\r\n", "\r\n1 1 0\r\n"),
            IesEdition::Lm63_2019 => ("IES:LM-63-2019\r\n", "\r\n1 1.00010 0\r\n"),
        };
        assert!(file.starts_with(first) && file.contains(generation));
        assert!(file.contains("\r\n1 -1 1 181 361 1 2 1.2 0 0.7\r\n"));
    }
    let ldt = String::from_utf8(eulumdat::write(&fine)).expect("ASCII");
    let lines: Vec<&str> = ldt.split_terminator("\r\n").collect();
    assert_eq!(lines.len(), 26 + 6 + 10 + 360 + 181 + 360 * 181);
    assert_eq!(&lines[2..7], ["0", "360", "1", "181", "1"]);
    // Seen along C0 the opening is 1200 mm wide and 700 mm high; a width of 0 would mean a disk.
    assert_eq!(&lines[15..21], ["1200", "1", "700", "700", "700", "700"]);
    assert!(lines.iter().all(|line| line.len() <= 78));
}

#[test]
fn downward_share_of_a_vertical_lambertian_is_half() {
    let lambert = lid(vec![EmergentLuminance::Uniform(1000.0)]);
    for (aim, expected) in [(Aim::Mounted, 50.0), (Aim::Down, 100.0)] {
        let ldt = String::from_utf8(eulumdat::write(&luminaire(&lambert, aim, Step::NORMAL))).expect("ASCII");
        let share: f64 = ldt.lines().nth(21).expect("DFF").parse().expect("number");
        assert!((share - expected).abs() < 0.7, "{share}");
    }
}

#[test]
fn dark_aperture_is_written_without_nan() {
    for back in formats(&luminaire(&lid(vec![]), Aim::Mounted, Step::NORMAL)) {
        assert!(back.intensity.iter().all(|&i| i == 0.0));
    }
}

fn read(path: &Path) -> Result<Luminaire, FormatError> {
    let bytes = std::fs::read(path).expect("file");
    if path.extension().is_some_and(|e| e == "ldt") { eulumdat::read(&bytes) } else { ies::read(&bytes) }
}

#[test]
fn real_files_are_read_and_rewritten() {
    let Some(data) = data("data") else { return };
    let mut count = 0;
    for folder in ["ldt", "ies"] {
        for entry in std::fs::read_dir(data.join("photometry").join(folder)).expect("folder") {
            let path = entry.expect("entry").path();
            let name = path.file_name().expect("name").to_string_lossy().into_owned();
            if !(name.ends_with(".ldt") || name.ends_with(".ies")) {
                continue;
            }
            let result = read(&path);
            if name == "mdl_test_file_format_error.ies" {
                assert_eq!(result.unwrap_err().at, Location::line(3));
                continue;
            }
            let luminaire = result.unwrap_or_else(|error| panic!("{name}: {error}"));
            count += 1;
            assert_eq!(luminaire.intensity.len(), luminaire.c_deg.len() * luminaire.gamma_deg.len(), "{name}");
            if luminaire.photometry == Photometry::C {
                assert!(luminaire.flux() > 0.0, "{name}");
                for back in formats(&luminaire) {
                    let (a, b) = (back.flux(), luminaire.flux());
                    assert!((a / b - 1.0).abs() < 2e-3, "{name} {a} {b}");
                }
            }
        }
    }
    assert!(count >= 40, "only {count} files");
}

/// Makers' light output ratios are flux over lamp flux: an independent check of units, symmetry and integration.
#[test]
fn integrated_flux_is_the_light_output_ratio() {
    let Some(data) = data("data") else { return };
    for name in ["eulumdatpy_1", "eulumdatpy_2", "eulumdatpy_3", "eulumdatpy_4", "eulumdatpy_6", "eulumdatpy_10"] {
        let path = data.join("photometry/ldt").join(format!("{name}.ldt"));
        let file = String::from_utf8_lossy(&std::fs::read(&path).expect("file")).into_owned();
        let field = |line: usize| file.lines().nth(line - 1).expect("line").trim().parse::<f64>().expect("number");
        let luminaire = read(&path).expect(name);
        let ratio = 100.0 * luminaire.flux() / luminaire.lamp_flux.expect("relative");
        assert!((ratio - field(23)).abs() < 1.5, "{name}: {ratio} % against {} %", field(23));
        let downward = 100.0 * luminaire.flux_within(90.0) / luminaire.flux();
        assert!((downward - field(22)).abs() < 1.5, "{name}: {downward} % down against {} %", field(22));
    }
}

#[test]
fn damaged_files_are_refused_with_their_reason() {
    let Some(data) = data("data") else { return };
    for (name, gist) in [
        ("ldt_trunc_header.ldt", "header"),
        ("ldt_trunc_data.ldt", "intensities"),
        ("ldt_mc_huge.ldt", "out of range"),
        ("ldt_ng_negative.ldt", "out of range"),
        ("ldt_isym_9.ldt", "out of range"),
        ("ldt_gamma_swapped.ldt", "increase"),
        ("ies_no_tilt.ies", "no TILT line"),
        ("ies_tilt_file.ies", "external tilt file"),
        ("ies_tilt_count_huge.ies", "out of range"),
        ("ies_gamma_count_negative.ies", "out of range"),
        ("ies_last_row_missing.ies", "37 candela values"),
        ("ies_type_7.ies", "photometric type must be 1"),
    ] {
        let error = read(&data.join("malformed").join(name)).expect_err(name).to_string();
        assert!(error.contains(gist), "{name}: {error}");
    }
    let comma = read(&data.join("malformed/ldt_decimal_comma.ldt")).expect("decimal commas");
    let base = read(&data.join("photometry/ldt/eulumdatpy_4.ldt")).expect("base");
    assert_eq!(comma.intensity, base.intensity);
}

#[test]
fn faults_are_told_with_their_line() {
    let file = b"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n1 x\n";
    let error = ies::read(file).unwrap_err();
    assert_eq!((error.at, error.found.as_str()), (Location::line(7), "\"x\""));
    assert!(ies::read(b"").is_err() && eulumdat::read(b"").is_err());
}

#[test]
fn light_that_cannot_be_is_refused_and_a_little_below_nothing_is_told() {
    let file = |cd: &str, lumens: &str| {
        let text = format!("IESNA:LM-63-2002\nTILT=NONE\n1 {lumens} 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n100 {cd}\n");
        ies::read(text.as_bytes())
    };
    for (cd, lumens) in [("-1e9", "-1"), ("1e308", "-1"), ("-3", "-1"), ("1e13", "-1"), ("5", "1e300")] {
        let error = file(cd, lumens).expect_err(cd).to_string();
        assert!(error.contains("expected 0 to 1e") && error.len() < 120, "{cd}: {error}");
    }
    let mended = file("-0.5", "-1").unwrap();
    assert_eq!(mended.intensity, [100.0, 0.0]);
    assert!(mended.findings.iter().any(|finding| finding.code == "negative-intensities"));
    assert!(mended.flux().is_finite() && mended.flux() > 0.0);
    // A wide C angle or a size beyond all measure would make the flux none.
    let wide = b"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 1 2 0 0 0\n1 1 0\n0 90\n0 1e300\n9 1\n9 1\n";
    assert!(ies::read(wide).is_err());
    let long = b"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 1e300 0 0\n1 1 0\n0 90\n0\n9 1\n";
    assert!(ies::read(long).unwrap_err().to_string().contains("size of the luminous opening"));
}

#[test]
fn quadrant_symmetry_is_expanded() {
    let file = b"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 3 1 2 0 0 0\n1 1 0\n0 90\n0 45 90\n9 1\n9 2\n9 3\n";
    let luminaire = ies::read(file).unwrap();
    assert_eq!(luminaire.c_deg, [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0]);
    let at_horizon: Vec<f64> = (0..8).map(|plane| luminaire.plane(plane)[1]).collect();
    assert_eq!(at_horizon, [1.0, 2.0, 3.0, 2.0, 1.0, 2.0, 3.0, 2.0]);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_a_reader_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = (eulumdat::read(&bytes), ies::read(&bytes));
    }

    #[test]
    fn no_numbers_make_a_reader_panic(numbers in proptest::collection::vec(-3_i32..8, 0..120)) {
        let words: Vec<String> = numbers.iter().map(i32::to_string).collect();
        let _ = ies::read(format!("IESNA:LM-63-2002\nTILT=INCLUDE\n{}", words.join(" ")).as_bytes());
        let _ = ies::read(format!("IESNA91\nTILT=NONE\n{}", words.join(" ")).as_bytes());
        let _ = eulumdat::read(words.join("\n").as_bytes());
    }

    #[test]
    fn flux_closes_for_any_quadrants(values in proptest::array::uniform4(0.0..1e5_f64), step in 0_usize..4) {
        let step = Step::from_degrees([15.0, 10.0, 5.0, 2.5][step]).unwrap();
        let exact = values.iter().sum::<f64>() * PI / 4.0 * 0.84;
        let quadrants = lid(vec![EmergentLuminance::Function(Arc::new(move |twin: Dir<Facade>| {
            let v = twin.vector();
            values[usize::from(v.x > 0.0) + 2 * usize::from(v.y > 0.0)]
        }))]);
        for aim in [Aim::Mounted, Aim::Down] {
            let table = CGammaTable::new(&quadrants, aim, step);
            prop_assert!((table.zonal_flux() - exact).abs() <= 1e-4 * exact);
        }
    }
}
