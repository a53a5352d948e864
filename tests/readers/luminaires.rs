//! Readers of luminaires: EULUMDAT, IES, and the index of a set of them.

use super::choices::Choices;
use super::{again, edits, told};
use cfs::compute::direction::Surface;
use cfs::compute::lid::c_gamma::Aim;
use cfs::compute::limits;
use cfs::formats::ies::IesEdition;
use cfs::formats::luminaire::{Description, Luminaire, Opening, Photometry};
use cfs::formats::luminaire_index::{self, Row, SeparateBeam};
use cfs::formats::{FileKind, eulumdat, ies, lid_tables};
use glam::DVec3;

fn luminaire(choices: &mut Choices) -> Luminaire {
    let (planes, angles) = ([1, 2, 4, 8, 24][choices.below(5)], [2, 3, 5, 19][choices.below(4)]);
    let last = [90.0, 180.0][choices.below(2)];
    let text = Description {
        report: choices.words(),
        laboratory: choices.words(),
        date: choices.words(),
        manufacturer: choices.words(),
        number: choices.words(),
        name: choices.words(),
        lamp: choices.words(),
        remarks: vec![choices.words()],
    };
    let size = |choices: &mut Choices| choices.tidy(0.0, 2.0);
    let (step, turn, scale) = (1 + choices.below(50), 2 + choices.below(40), choices.tidy(0.0, 2000.0));
    Luminaire {
        format: "computed".to_owned(),
        text,
        photometry: Photometry::C,
        opening: Opening::rectangular(size(choices), size(choices), size(choices)),
        c_deg: (0..planes).map(|k| 360.0 * k as f64 / planes as f64).collect(),
        gamma_deg: (0..angles).map(|k| last * k as f64 / (angles - 1) as f64).collect(),
        intensity: (0..planes * angles).map(|k| scale * ((k * step) % turn) as f64 / turn as f64).collect(),
        lamp_flux: choices.flag().then(|| choices.tidy(0.0, 5000.0)),
        power: choices.tidy(0.0, 100.0),
        findings: Vec::new(),
    }
}

/// Text, or now and then in UTF-16 or Latin-1.
fn encoded(choices: &mut Choices, text: &str) -> Vec<u8> {
    let latin = |c: char| if u32::from(c) < 256 { u32::from(c) as u8 } else { b'?' };
    match choices.below(12) {
        10 => "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect(),
        11 => text.chars().map(latin).collect(),
        _ => edits::text(choices, text.to_owned()),
    }
}

pub fn make_eulumdat(choices: &mut Choices) -> Vec<u8> {
    let luminaire = luminaire(choices);
    let text = String::from_utf8(eulumdat::write(&luminaire)).expect("ASCII");
    let mut lines: Vec<&str> = text.lines().collect();
    let (planes, angles) = (luminaire.c_deg.len(), luminaire.gamma_deg.len());
    let symmetry = choices.below(8);
    let stored = match symmetry {
        1 => 1,
        2 | 3 => planes / 2 + 1,
        4 => planes / 4 + 1,
        _ => planes,
    };
    let words = ["0", "1", "2", "3", "4"];
    if let (true, Some(word)) = (planes > 1, words.get(symmetry)) {
        lines[2] = word;
        lines.truncate(42 + planes + angles + stored * angles);
    }
    encoded(choices, &lines.join("\r\n"))
}

pub fn read_eulumdat(bytes: &[u8]) -> bool {
    match eulumdat::read(bytes) {
        Ok(luminaire) => {
            sound(&luminaire);
            let one = again("EULUMDAT", eulumdat::read(&eulumdat::write(&luminaire)));
            let two = again("EULUMDAT", eulumdat::read(&eulumdat::write(&one)));
            same(&one, &two);
            // As it is handed on.
            again("IES", ies::read(&ies::write(&luminaire, IesEdition::Lm63_2002)));
            true
        }
        Err(error) => told(&error),
    }
}

pub fn make_ies(choices: &mut Choices) -> Vec<u8> {
    let mut luminaire = luminaire(choices);
    let edition = if choices.flag() { IesEdition::Lm63_2019 } else { IesEdition::Lm63_2002 };
    if choices.flag() {
        let text = String::from_utf8(ies::write(&luminaire, edition)).expect("ASCII");
        return encoded(choices, &text);
    }
    // What others write: parts of the turn, other types and units, tilt.
    const PLANES: [&[f64]; 6] =
        [&[0.0], &[0.0, 90.0], &[0.0, 45.0, 90.0], &[0.0, 90.0, 180.0], &[90.0, 180.0, 270.0], &[0.0, 180.0, 360.0]];
    let planes = PLANES[choices.below(6)];
    let angles = luminaire.gamma_deg.len();
    luminaire.intensity.resize(planes.len() * angles, 1.5);
    let tilt = choices.pick(&["NONE", "NONE", "INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8", "lamp.tlt"]);
    let list = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let head = choices.pick(&["IESNA:LM-63-1995", "IESNA91", "IESNA:LM-63-2002", "something else"]);
    let text = format!(
        "{head}\n[TEST] {}\n[MORE] {}\n[LUMCAT] x\nTILT={tilt}\n1 {} {} {angles} {} {} {} 0.5 0.5 0\n1 1 {}\n{}\n{}\n{}\n",
        luminaire.text.report.replace('\n', " "),
        luminaire.text.name.replace('\n', " "),
        choices.pick(&["1000", "-1", "0"]),
        choices.pick(&["1", "0.1", "2.5"]),
        planes.len(),
        choices.pick(&["1", "1", "2", "3"]),
        choices.pick(&["1", "2"]),
        luminaire.power,
        list(&luminaire.gamma_deg),
        list(planes),
        list(&luminaire.intensity),
    );
    encoded(choices, &text)
}

pub fn read_ies(bytes: &[u8]) -> bool {
    match ies::read(bytes) {
        Ok(luminaire) => {
            sound(&luminaire);
            if luminaire.photometry == Photometry::C {
                let write = |luminaire: &Luminaire| ies::write(luminaire, IesEdition::Lm63_2019);
                let one = again("IES", ies::read(&write(&luminaire)));
                let two = again("IES", ies::read(&write(&one)));
                same(&one, &two);
                again("EULUMDAT", eulumdat::read(&eulumdat::write(&luminaire)));
            }
            true
        }
        Err(error) => told(&error),
    }
}

fn sound(luminaire: &Luminaire) {
    let Luminaire { c_deg, gamma_deg, intensity, .. } = luminaire;
    assert_eq!(intensity.len(), c_deg.len() * gamma_deg.len(), "intensities that do not fit the angles");
    for (name, angles) in [("C", c_deg), ("gamma", gamma_deg)] {
        assert!(angles.iter().all(|angle| angle.is_finite()) && !angles.is_empty(), "angles {name} {angles:?}");
        assert!(angles.windows(2).all(|pair| pair[0] < pair[1]), "angles {name} that do not rise: {angles:?}");
    }
    let light = |cd: &f64| (0.0..=limits::INTENSITY).contains(cd);
    assert!(intensity.iter().all(light), "an intensity that no light is");
    assert!(luminaire.lamp_flux.is_none_or(|flux| flux.is_finite() && flux >= 0.0), "{:?}", luminaire.lamp_flux);
    assert!(luminaire.power.is_finite(), "{}", luminaire.power);
    if luminaire.photometry == Photometry::C {
        assert!(c_deg.iter().all(|c| (0.0..360.0).contains(c)), "planes beyond the turn: {c_deg:?}");
        let whole = luminaire.flux();
        assert!(whole.is_finite() && whole >= 0.0, "a flux of {whole} lm");
        let down = luminaire.flux_within(90.0);
        assert!((0.0..=whole * (1.0 + 1e-9) + 1e-9).contains(&down), "{down} lm of {whole} lm go down");
        assert!(eulumdat::direct_ratios(luminaire).iter().all(|ratio| ratio.is_finite()), "direct ratios");
        let read = luminaire.intensities();
        assert_eq!(read.values.len(), read.c.len() * read.gamma.len());
        if intensity.len() < 500 {
            assert!(lid_tables::to_csv(luminaire).lines().count() == intensity.len() + 1);
            assert!(!lid_tables::polar_diagram(luminaire).shapes.is_empty());
        }
    }
}

fn same(one: &Luminaire, two: &Luminaire) {
    assert_eq!((&one.c_deg, &one.gamma_deg), (&two.c_deg, &two.gamma_deg), "angles change when written again");
    let largest = one.peak();
    for (a, b) in one.intensity.iter().zip(&two.intensity) {
        assert!((a - b).abs() <= 1e-4 * largest + 1e-9, "an intensity of {a} cd is {b} cd when written again");
    }
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-3 * a.abs().max(1.0);
    match (one.lamp_flux, two.lamp_flux) {
        (Some(a), Some(b)) => assert!(close(a, b), "lamps of {a} lm are {b} lm when written again"),
        (a, b) => assert_eq!(a, b, "the lamps' flux"),
    }
}

pub fn make_index(choices: &mut Choices) -> Vec<u8> {
    let count = 1 + choices.below(4);
    let rows: Vec<Row> = (0..count)
        .map(|k| Row {
            file: format!("{} {k}.ies", choices.words().trim()),
            centre: DVec3::new(choices.tidy(0.0, 5.0), choices.tidy(0.0, 5.0), choices.tidy(0.0, 3.0)),
            size: [choices.tidy(0.1, 2.0), choices.tidy(0.1, 2.0)],
            flux: choices.tidy(0.0, 1000.0),
            beam: choices.tidy(0.0, 100.0),
            surface: [None, Some(Surface::Facade), Some(Surface::Roof)][choices.below(3)],
            aim: [None, Some(Aim::Mounted), Some(Aim::Down)][choices.below(3)],
            separate_beam: choices.flag().then(|| SeparateBeam {
                flux: choices.tidy(0.1, 100.0),
                direction: DVec3::new(choices.tidy(0.0, 1.0), choices.tidy(0.0, 1.0), -0.5).normalize(),
                normal: choices.tidy(0.0, 9e4),
            }),
            set: choices.words().trim().to_owned(),
        })
        .collect();
    let text = String::from_utf8(luminaire_index::write(&rows)).expect("text");
    edits::text(choices, text)
}

pub fn read_index(bytes: &[u8]) -> bool {
    assert!(!FileKind::Png.may_be(bytes) || !FileKind::Csv.may_be(bytes), "two kinds of file");
    let rows = match luminaire_index::read(bytes) {
        Ok(rows) => rows,
        Err(error) => return told(&error),
    };
    for row in &rows {
        assert!(row.centre.is_finite() && row.size.iter().all(|side| side.is_finite() && *side > 0.0), "{row:?}");
        assert!(row.flux.is_finite() && row.flux >= 0.0 && row.beam.is_finite() && row.beam >= 0.0, "light of {row:?}");
        if let Some(apart) = row.separate_beam {
            assert!((apart.direction.length() - 1.0).abs() < 1e-9, "{row:?}");
            assert!(
                apart.flux > 0.0 && apart.flux.is_finite() && apart.normal >= 0.0 && apart.normal.is_finite(),
                "{row:?}"
            );
        }
    }
    let one = again("an index", luminaire_index::read(&luminaire_index::write(&rows)));
    let two = again("an index", luminaire_index::read(&luminaire_index::write(&one)));
    assert_eq!(one.len(), rows.len(), "rows that got lost");
    for ((row, one), two) in rows.iter().zip(&one).zip(&two) {
        assert_eq!(
            (&row.file, &row.set, row.separate_beam.is_some()),
            (&one.file, &one.set, one.separate_beam.is_some())
        );
        let direction = |row: &Row| row.separate_beam.map_or(DVec3::Z, |apart| apart.direction);
        assert!((direction(one) - direction(two)).length() < 1e-6, "{one:?} is {two:?}");
        let rest = |row: &Row| Row {
            separate_beam: row.separate_beam.map(|apart| SeparateBeam { direction: DVec3::Z, ..apart }),
            ..row.clone()
        };
        assert_eq!(rest(one), rest(two), "an index changes when it is read and written again");
    }
    true
}
