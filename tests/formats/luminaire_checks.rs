//! What readers of luminaire files tell or refuse: counts, gaps, symmetry, flux, openings, and text as it travels.

use crate::common::data;
use cfs::compute::btdf::{Finding, Severity};
use cfs::compute::direction::{Dir, Facade, Surface};
use cfs::compute::lid::c_gamma::{Aim, CGammaTable, Step};
use cfs::compute::lid::{EmergentLuminance, Lid};
use cfs::formats::ies::IesEdition;
use cfs::formats::luminaire::{Description, Luminaire, Photometry, Shape};
use cfs::formats::{FormatError, eulumdat, ies};
use std::f64::consts::PI;
use std::sync::Arc;

/// Angles from `first` to `last`.
fn steps(first: f64, last: f64, step: f64) -> Vec<f64> {
    (0..=((last - first) / step).round() as usize).map(|k| first + step * k as f64).collect()
}

fn list(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:.3}")).collect::<Vec<_>>().join(" ")
}

/// An LM-63 file: edition, lumens, type and sizes ("1 2 0.3 0.6 0") and tables.
struct Ies {
    edition: &'static str,
    lumens: &'static str,
    kind: &'static str,
    vertical: Vec<f64>,
    horizontal: Vec<f64>,
    table: Vec<f64>,
}

impl Ies {
    fn new(vertical: Vec<f64>, horizontal: Vec<f64>, cd: impl Fn(f64, f64) -> f64) -> Self {
        let table = horizontal.iter().flat_map(|h| vertical.iter().map(|v| cd(*h, *v)).collect::<Vec<_>>()).collect();
        Self { edition: "IESNA:LM-63-2002", lumens: "-1", kind: "1 2 0.3 0.6 0", vertical, horizontal, table }
    }

    /// 1000 cos γ cd below: 1000 π lm.
    fn lambert() -> Self {
        Self::new(steps(0.0, 90.0, 5.0), vec![0.0], |_, gamma| 1000.0 * gamma.to_radians().cos())
    }

    fn text(&self) -> String {
        let lines = [
            self.edition.to_owned(),
            "TILT=NONE".to_owned(),
            format!("1 {} 1 {} {} {}", self.lumens, self.vertical.len(), self.horizontal.len(), self.kind),
            "1 1 40".to_owned(),
            list(&self.vertical),
            list(&self.horizontal),
            list(&self.table),
        ];
        lines.join("\r\n") + "\r\n"
    }

    fn read(&self) -> Luminaire {
        ies::read(self.text().as_bytes()).expect("an LM-63 file")
    }
}

/// An EULUMDAT file for γ 0…90 in steps of 5°: (200 + 80 cos C) cos γ cd per 1000 lm, 2000 lm: 400 π lm.
struct Ldt {
    symmetry: usize,
    planes: Vec<f64>,
    stored: Vec<f64>,
    /// Lines that are other ones, from 1.
    other: Vec<(usize, &'static str)>,
    scale: f64,
}

impl Ldt {
    fn new(symmetry: usize, planes: Vec<f64>, stored: Vec<f64>) -> Self {
        Self { symmetry, planes, stored, other: Vec::new(), scale: 1.0 }
    }

    fn text(&self) -> String {
        let gamma = steps(0.0, 90.0, 5.0);
        let mut lines: Vec<String> = vec!["Maker".into(), "3".into(), self.symmetry.to_string()];
        lines.extend([self.planes.len().to_string(), "0".into(), "19".into(), "5".into()]);
        lines.extend(["report", "lamp", "number", "file", "2026", "600", "300", "50", "600", "300"].map(String::from));
        lines.extend(["0", "0", "0", "0", "100", "62.83", "1", "0", "1"].map(String::from));
        lines.extend(["1", "LED", "2000", "3000K", "80", "40"].map(String::from));
        lines.extend(std::iter::repeat_n("0.5".to_owned(), 10));
        lines.extend(self.planes.iter().chain(&gamma).map(f64::to_string));
        for c in &self.stored {
            let cd = self.scale * (200.0 + 80.0 * c.to_radians().cos());
            lines.extend(gamma.iter().map(|gamma| format!("{:.3}", cd * gamma.to_radians().cos())));
        }
        for (line, text) in &self.other {
            lines[line - 1] = (*text).to_owned();
        }
        lines.join("\r\n") + "\r\n"
    }

    fn with(mut self, line: usize, text: &'static str) -> Self {
        self.other.push((line, text));
        self
    }

    fn read(&self) -> Result<Luminaire, FormatError> {
        eulumdat::read(self.text().as_bytes())
    }
}

fn finding<'a>(luminaire: &'a Luminaire, code: &str) -> &'a Finding {
    let found = luminaire.findings.iter().find(|finding| finding.code == code);
    found.unwrap_or_else(|| panic!("no {code}: {:?}", luminaire.findings))
}

fn close(value: f64, expected: f64, relative: f64) {
    assert!((value / expected - 1.0).abs() < relative, "{value}, not {expected}");
}

#[test]
fn plain_files_give_no_findings() {
    assert_eq!(Ies::lambert().read().findings, []);
    close(Ies::lambert().read().flux(), 1000.0 * PI, 1e-4);
    for (symmetry, stored) in
        [(0, steps(0.0, 345.0, 15.0)), (2, steps(0.0, 180.0, 15.0)), (1, vec![90.0]), (4, steps(0.0, 90.0, 15.0))]
    {
        // The same flux whatever the symmetry does to the cosine, but for a quarter of the turn.
        let luminaire = Ldt::new(symmetry, steps(0.0, 345.0, 15.0), stored).with(23, "").read().unwrap();
        assert_eq!(luminaire.findings, [], "Isym {symmetry}");
        if symmetry != 4 {
            close(luminaire.flux(), 400.0 * PI, 1e-4);
        }
    }
}

#[test]
fn every_number_is_accounted_for() {
    let mut more = Ies::lambert();
    more.table.extend(more.table.clone());
    let luminaire = more.read();
    let told = finding(&luminaire, "surplus-values");
    assert_eq!(told.severity, Severity::Warning);
    assert!(told.message.contains("38 intensities where 19 are due"), "{}", told.message);
    let commas = Ies::lambert().text();
    let (head, table) = commas.rsplit_once("\r\n1000.").unwrap();
    let error = ies::read(format!("{head}\r\n1000,{}", table.replace('.', ",")).as_bytes()).unwrap_err().to_string();
    assert!(error.contains("line 7: 38 candela values; expected 19") && error.contains("comma"), "{error}");
    // Where a comma is the delimiter it stands as often as numbers do.
    let delimited = format!("{head}\r\n1000.{}", table.replace(' ', ","));
    close(ies::read(delimited.as_bytes()).unwrap().flux(), 1000.0 * PI, 1e-4);
    // A comma in the header shifts all that follows.
    let shifted = commas.replace("0.3 0.6 0", "0,3 0,6 0");
    assert!(ies::read(shifted.as_bytes()).unwrap_err().to_string().contains("decimals with a point"));

    let all = steps(0.0, 345.0, 15.0);
    let luminaire = Ldt::new(2, all.clone(), all).read().unwrap();
    let told = finding(&luminaire, "surplus-values");
    assert!(told.message.contains("456 intensities where 247 are due"), "{}", told.message);
    let file = Ies::lambert().text() + "that is all\r\n";
    assert_eq!(finding(&ies::read(file.as_bytes()).unwrap(), "text-after-values").severity, Severity::Info);
    assert_eq!(ies::read((Ies::lambert().text() + "\u{1a}").as_bytes()).unwrap().findings, []);
}

#[test]
fn planes_and_angles_that_leave_gaps_are_told() {
    let gamma = steps(0.0, 90.0, 5.0);
    let broken = Ies::new(gamma.clone(), steps(0.0, 225.0, 15.0), |_, _| 100.0).read();
    let told = &finding(&broken, "planes-leave-gap").message;
    assert!(told.contains("C 225° and C 360°: a gap of 135°") && told.contains("15° apart"), "{told}");
    // Without the plane at 360° nothing is missing; a closer look at one side is no gap either.
    let mut sides = steps(0.0, 90.0, 15.0);
    sides.extend(steps(92.0, 120.0, 2.0));
    sides.extend(steps(135.0, 360.0, 15.0));
    for horizontal in [steps(0.0, 345.0, 15.0), steps(0.0, 360.0, 90.0), vec![0.0, 180.0], sides] {
        assert_eq!(Ies::new(gamma.clone(), horizontal, |_, _| 100.0).read().findings, []);
    }
    // 2π·100 lm (1 − cos 85°): what lies between 85° and 90° is lost.
    let short = Ies::new(steps(0.0, 85.0, 5.0), vec![0.0], |_, _| 100.0).read();
    close(short.flux(), 200.0 * PI * (1.0 - 85_f64.to_radians().cos()), 1e-9);
    let told = finding(&short, "angles-leave-gap");
    assert!(told.message.contains("from 0° to 85°") && told.message.contains("100 cd"), "{}", told.message);
    assert_eq!(told.severity, Severity::Warning);
    let dark = Ies::new(steps(0.0, 120.0, 5.0), vec![0.0], |_, gamma| if gamma < 90.0 { 100.0 } else { 0.0 }).read();
    assert_eq!(finding(&dark, "angles-leave-gap").severity, Severity::Info);
    // 100 cd at C0, 50 cd where the turn closes.
    let open = Ies::new(gamma, steps(0.0, 360.0, 90.0), |c, _| if c < 360.0 { 100.0 } else { 50.0 }).read();
    assert!(finding(&open, "turn-not-closed").message.contains("50 %"));
}

#[test]
fn planes_are_mirrored_by_angle() {
    let exact = 400.0 * PI;
    let half = steps(0.0, 180.0, 15.0);
    let listed = [steps(0.0, 345.0, 15.0), steps(0.0, 360.0, 15.0), half.clone()];
    let all: Vec<_> = listed.map(|planes| Ldt::new(2, planes, half.clone()).read().unwrap()).into();
    for luminaire in &all {
        close(luminaire.flux(), exact, 1e-4);
        assert_eq!((&luminaire.c_deg, &luminaire.intensity), (&all[0].c_deg, &all[0].intensity));
    }
    assert_eq!(all[0].findings, []);
    assert!(finding(&all[1], "planes-not-of-the-turn").message.contains("Mc is 25"));
    assert!(finding(&all[2], "planes-not-of-the-turn").message.contains("from 0° to 180°"));
    // About C90–C270: from C270 over C0 to C90, in the file's order.
    let mut stored = steps(270.0, 345.0, 15.0);
    stored.extend(steps(0.0, 90.0, 15.0));
    for planes in [steps(0.0, 345.0, 15.0), steps(0.0, 360.0, 15.0)] {
        let luminaire = Ldt::new(3, planes, stored.clone()).with(23, "").read().unwrap();
        let at = |c: f64| luminaire.plane(luminaire.c_deg.iter().position(|x| *x == c).unwrap())[0];
        assert_eq!([at(0.0), at(180.0), at(60.0), at(120.0), at(240.0)], [560.0, 560.0, 480.0, 480.0, 480.0]);
    }
    let odd = Ldt::new(2, vec![0.0, 30.0, 90.0, 200.0, 300.0], vec![0.0, 30.0, 90.0]).read().unwrap_err().to_string();
    assert!(odd.contains("C 200°") && odd.contains("Isym 2"), "{odd}");
}

#[test]
fn flux_that_contradicts_the_lamps_is_told() {
    let lamps = |lumens: &'static str| Ies { lumens, ..Ies::lambert() }.read();
    let told = lamps("1000");
    let message = &finding(&told, "flux-contradicts-lamps").message;
    assert!(
        message.contains("line 3: the table gives 3141.6 lm and the lamps 1000 lm: a light output ratio of 3.14"),
        "{message}"
    );
    assert!(finding(&lamps("100000"), "flux-contradicts-lamps").message.contains("0.03"));
    assert!(finding(&lamps("0"), "no-lamp-flux").message.contains("0 lm"));
    assert_eq!(lamps("4000").findings, []);

    let ldt = |scale: f64| Ldt { scale, ..Ldt::new(2, steps(0.0, 345.0, 15.0), steps(0.0, 180.0, 15.0)) };
    let told = ldt(2.0).read().unwrap();
    let message = &finding(&told, "flux-contradicts-lamps").message;
    assert!(message.contains("1.26, where the file states 0.63") && message.contains("per 1000 lm"), "{message}");
    let told = ldt(1.0).with(22, "40").read().unwrap();
    let message = &finding(&told, "downward-share-contradicts").message;
    assert!(message.contains("100 %") && message.contains("40 %"), "{message}");
    let tilted = ldt(1.0).with(25, "15").read().unwrap();
    assert!(finding(&tilted, "tilt").message.contains("line 25: tilted by 15°"));
    let steps = ldt(1.0).with(7, "10").read().unwrap();
    assert!(finding(&steps, "step-contradicts-angles").message.contains("Dg is 10° but the listed angles are 5°"));
}

#[test]
fn flux_of_types_a_and_b_is_that_of_their_solid_angles() {
    let cos = |degrees: f64| degrees.to_radians().cos();
    let whole = || steps(-90.0, 90.0, 5.0);
    let of_type = |kind: &'static str, horizontal: Vec<f64>, cd: &dyn Fn(f64, f64) -> f64| {
        Ies { kind, ..Ies::new(whole(), horizontal, cd) }.read()
    };
    let [a, b] = ["3 2 0.3 0.6 0", "2 2 0.3 0.6 0"];
    // ∫∫ cos H cos V: over cos H dH dV, or over cos V dH dV, π/2 · 2.
    for kind in [a, b] {
        for horizontal in [whole(), steps(0.0, 90.0, 5.0)] {
            let luminaire = of_type(kind, horizontal, &|h, v| 1000.0 * cos(h) * cos(v));
            close(luminaire.flux(), 1000.0 * PI, 3e-3);
            assert_eq!(luminaire.findings.len(), 1, "{:?}", luminaire.findings);
        }
    }
    // ∫∫ cos V: π · π/2 of type A, 2 · 2 of type B.
    let vertical = |_: f64, v: f64| 1000.0 * cos(v);
    let (of_a, of_b) = (of_type(a, whole(), &vertical), of_type(b, whole(), &vertical));
    close(of_a.flux(), 1000.0 * PI * PI / 2.0, 3e-3);
    close(of_b.flux(), 4000.0, 3e-3);
    assert_eq!((of_a.photometry, of_b.photometry), (Photometry::A, Photometry::B));
    assert!(finding(&of_b, "not-type-c").message.contains("type is B"));
    let narrow = of_type(b, steps(-30.0, 30.0, 5.0), &|_, _| 100.0);
    // 2 sin 30° · π.
    close(narrow.flux(), 100.0 * PI, 1e-9);
    assert!(finding(&narrow, "angles-leave-gap").message.contains("horizontal angles from -30° to 30°"));
}

#[test]
fn round_openings_have_a_diameter() {
    let sizes = |edition: &'static str, kind: &'static str| Ies { edition, kind, ..Ies::lambert() }.read().opening;
    let old = sizes("IESNA:LM-63-1995", "1 1 -0.5 0.0 0.0");
    assert_eq!((old.shape, old.is_circle()), (Shape::Round, true));
    close(old.along_c0, 0.1524, 1e-12);
    close(old.along_c90, 0.1524, 1e-12);
    let new = sizes("IESNA:LM-63-2002", "1 2 -0.5 -0.5 0.1");
    assert_eq!((new.shape, new.along_c0, new.along_c90, new.height), (Shape::Round, 0.5, 0.5, 0.1));
    let round = Ldt::new(1, vec![0.0], vec![90.0]).with(16, "200").with(17, "0").read().unwrap();
    assert_eq!((round.opening.is_circle(), round.opening.along_c0), (true, 0.2));
    for back in written(&round) {
        assert_eq!(back.opening, round.opening);
    }
}

#[test]
fn openings_of_another_unit_are_told() {
    let area = |length: &'static str, width: &'static str| {
        Ldt::new(1, vec![0.0], vec![90.0]).with(16, length).with(17, width).read().unwrap()
    };
    // 400 π lm from 0.18 mm²: 7e9 lm/m².
    let small = area("0.6", "0.3");
    assert!(finding(&small, "opening-contradicts-flux").message.contains("0.6 mm x 0 mm (along C0"));
    close(small.flux(), 400.0 * PI, 1e-4);
    let large = area("600000", "300000");
    assert!(finding(&large, "opening-contradicts-flux").message.contains("far too large"));
    assert_eq!(area("10", "10").findings, []);
    let negative = area("-600", "300");
    assert_eq!(negative.opening.along_c90, 0.6);
    assert!(finding(&negative, "negative-size").message.contains("line 16: a size of -600 mm"));
}

#[test]
fn text_is_read_as_it_travels() {
    let (text, ldt) = (Ies::lambert().text(), Ldt::new(1, vec![0.0], vec![90.0]).text().replace("Maker", "Müller"));
    let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let exponents = text.replace("1000.000", "1.0E+0003").replace("996.195", "9.96195D+02");
    let [mac, double] = ["\r", "\r\r\n"].map(|end| text.replace("\r\n", end));
    let marked = format!("\u{feff}{text}");
    for bytes in [mac.as_bytes(), double.as_bytes(), &utf16, exponents.as_bytes(), marked.as_bytes()] {
        close(ies::read(bytes).unwrap().flux(), 1000.0 * PI, 1e-4);
    }
    let latin: Vec<u8> = ldt.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    for bytes in [ldt.replace("\r\n", "\r").into_bytes(), ldt.replace("\r\n", "\r\r\n").into_bytes(), latin] {
        let luminaire = eulumdat::read(&bytes).unwrap();
        close(luminaire.flux(), 400.0 * PI, 1e-4);
        assert_eq!(luminaire.text.manufacturer, "Müller");
    }
    let page = b"<!DOCTYPE html><html><head><title>lamp.ies</title></head><body>IESNA:LM-63-2002</body></html>";
    for error in [ies::read(page).unwrap_err(), eulumdat::read(page).unwrap_err()] {
        assert!(error.to_string().contains("an HTML page") && error.to_string().contains("raw file"), "{error}");
    }
    for (broken, gist) in [
        (text.replace("\r\n", " "), "characters without a line break"),
        (text.replace("\r\nTILT", " TILT"), "line 1: TILT= within a line: a line break is missing"),
        (text.replace("TILT=NONE\r\n", "TILT=NONE "), "TILT=NONE 1 -1 1 19 1 1 2 0.3 0.6 0: a line break is missing"),
    ] {
        let error = ies::read(broken.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(gist), "{error}");
    }
    let error = eulumdat::read(ldt.replace("\r\n", " ").as_bytes()).unwrap_err().to_string();
    assert!(error.contains("without a line break"), "{error}");
    let joined = ldt.replace("\r\n85\r\n90\r\n", "\r\n85 90\r\n");
    let error = eulumdat::read(joined.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("\"85 90\"; expected a number (gamma angles), one on a line"), "{error}");
}

fn written(luminaire: &Luminaire) -> [Luminaire; 3] {
    [
        eulumdat::read(&eulumdat::write(luminaire)).expect("EULUMDAT"),
        ies::read(&ies::write(luminaire, IesEdition::Lm63_2002)).expect("LM-63-2002"),
        ies::read(&ies::write(luminaire, IesEdition::Lm63_2019)).expect("LM-63-2019"),
    ]
}

#[test]
fn what_is_written_is_read_without_a_finding() {
    let quarter = |twin: Dir<Facade>| if twin.vector().x > 0.0 && twin.vector().y < 0.0 { 4000.0 } else { 0.0 };
    let parts = [
        vec![],
        vec![EmergentLuminance::Uniform(1e-6)],
        vec![EmergentLuminance::Uniform(30_000.0)],
        vec![EmergentLuminance::Function(Arc::new(quarter))],
    ];
    for parts in parts {
        for size in [[1.2, 0.7], [0.01, 0.02], [12.0, 3.0]] {
            let lid = Lid { surface: Surface::Facade, size, parts: parts.clone(), beams: Vec::new() };
            for (aim, step) in [Aim::Mounted, Aim::Down].into_iter().flat_map(|aim| [(aim, 15.0), (aim, 2.5)]) {
                let table = CGammaTable::new(&lid, aim, Step::from_degrees(step).unwrap());
                for back in written(&Luminaire::from_table(&table, size, Description::default())) {
                    assert_eq!(back.findings, [], "{} {aim:?} {step} {size:?}", back.format);
                }
            }
        }
    }
}

/// Makers' and other programs' files.
#[test]
fn real_files_have_no_gaps_and_openings_of_their_light() {
    let Some(data) = data("data") else { return };
    for folder in ["ldt", "ies"] {
        for entry in std::fs::read_dir(data.join("photometry").join(folder)).expect("folder") {
            let path = entry.expect("entry").path();
            let bytes = std::fs::read(&path).expect("file");
            let read = match path.extension().and_then(|extension| extension.to_str()) {
                Some("ldt") => eulumdat::read(&bytes),
                Some("ies") => ies::read(&bytes),
                _ => continue,
            };
            let Ok(luminaire) = read else { continue };
            for code in ["planes-leave-gap", "angles-leave-gap", "turn-not-closed", "opening-contradicts-flux"] {
                assert!(luminaire.findings.iter().all(|finding| finding.code != code), "{path:?}: {code}");
            }
        }
    }
}
