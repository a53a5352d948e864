//! The data doctor on small systems made here, whose faults are known by construction: faults planted number by number,
//! blocks copied within a band and from one band to the other, repairs that are questions, percent, noise below zero.

use cfs::compute::basis::{AzimuthMap, Cell, RingBasis};
use cfs::compute::btdf::{Band, Btdf, CellMatrix, Component, Dataset, Scattered, Severity};
use cfs::compute::direction::Dir;
use cfs::compute::doctor::{BlockScope, Diagnosis, Repair, examine, examine_all, recorded, repaired, repaired_all};
use cfs::formats::{bsdf_xml, btdf_text};
use std::f64::consts::PI;
use std::path::Path;
use std::process::{Command, Output};

const FRONT: Component = Component::TransmissionFront;
const BACK: Component = Component::TransmissionBack;

/// One function in the place of another: its numbers, under the other's name.
fn copied(dataset: &Dataset, from: Component, to: Component) -> Option<Dataset> {
    let mut planted = dataset.clone();
    let Scattered::Cells(source) = dataset.visible.get(from)?.scattered.as_ref()? else { return None };
    let Scattered::Cells(target) = dataset.visible.get(to)?.scattered.as_ref()? else { return None };
    let matrix =
        CellMatrix::new(target.incident().clone(), target.emergent().clone(), source.values().into_owned()).unwrap();
    planted.visible.set(to, Btdf::from_cells(matrix));
    Some(planted)
}

#[test]
fn nothing_is_said_about_an_empty_dataset_but_that_it_is_empty() {
    let empty = Dataset { format: "made here".into(), visible: Band::default(), ..Dataset::default() };
    assert!(examine(&empty).iter().any(|one| one.finding.code == "no-transmission"));
}

/// A blind whose slats throw light from above back and let light from below through: reciprocal by construction, light
/// from outside scattered more evenly than light from inside. `amount` scales the light
/// that passes, `slope` how much the reflection depends on the height.
fn band(amount: f64, slope: f64) -> Band {
    let basis = |map| RingBasis::klems_full(map);
    let (outside, inside) = (basis(AzimuthMap::KLEMS_FRONT), basis(AzimuthMap::KLEMS_BACK));
    let rise = |cell: &Cell| cell.centre().vector().y;
    let enters = |cell: &Cell| amount * (1.0 - 0.9 * rise(cell)) * (1.0 + 0.1 * cell.centre().vector().x);
    let leaves = |cell: &Cell| (1.0 + 0.5 * rise(cell)) * cell.theta().cos();
    let through = |i: &Cell, o: &Cell| enters(i) * leaves(o) / PI;
    // Names of reflected light are turned by 180°, which makes r(ω, ω′) = r(ω′, ω) a product of turned halves.
    let mirror = |i: &Cell, o: &Cell, a: f64| 0.3 * (1.0 + a * rise(i)) * (1.0 - a * rise(o)) / PI;
    let matrix = |basis: &RingBasis, q: &dyn Fn(&Cell, &Cell) -> f64| {
        let cells: Vec<Cell> = basis.cells().collect();
        let values = cells.iter().flat_map(|i| cells.iter().map(move |o| q(i, o))).collect();
        Btdf::from_cells(CellMatrix::new(basis.clone(), basis.clone(), values).unwrap())
    };
    Band {
        transmission_front: Some(matrix(&outside, &through)),
        transmission_back: Some(matrix(&inside, &|i, o| through(o, i))),
        reflection_front: Some(matrix(&outside, &|i, o| mirror(i, o, slope))),
        reflection_back: Some(matrix(&inside, &|i, o| mirror(i, o, -0.375 * slope))),
    }
}

/// The blind in the visible band alone.
fn blind() -> Dataset {
    Dataset {
        name: "Blind".into(),
        manufacturer: "Tests".into(),
        format: "made here".into(),
        visible: band(0.4, 0.8),
        ..Dataset::default()
    }
}

/// New values from the old: (incident cell, emergent cell, value of any pair).
fn rewritten(dataset: &Dataset, component: Component, q: impl Fn(usize, usize, &CellMatrix) -> f64) -> Dataset {
    let Some(Scattered::Cells(old)) = &dataset.visible.get(component).unwrap().scattered else { unreachable!() };
    let n = old.incident().len();
    let values = (0..n).flat_map(|i| (0..n).map(move |o| (i, o))).map(|(i, o)| q(i, o, old)).collect();
    let mut out = dataset.clone();
    let matrix = CellMatrix::new(old.incident().clone(), old.emergent().clone(), values).unwrap();
    out.visible.set(component, Btdf::from_cells(matrix));
    out
}

/// The cell at the same place above instead of below.
fn upside(matrix: &CellMatrix, k: usize) -> usize {
    let v = matrix.incident().cell(k).centre().vector();
    matrix.incident().index(Dir::from_unit(glam::DVec3::new(v.x, -v.y, v.z))).unwrap()
}

fn largest_difference(a: &Dataset, b: &Dataset) -> f64 {
    let mut largest = 0.0_f64;
    for component in Component::ALL {
        let (Some(Scattered::Cells(a)), Some(Scattered::Cells(b))) = (
            a.visible.get(component).and_then(|btdf| btdf.scattered.as_ref()),
            b.visible.get(component).and_then(|btdf| btdf.scattered.as_ref()),
        ) else {
            continue;
        };
        assert_eq!(a.incident(), b.incident(), "{component:?}");
        largest = a.values().iter().zip(b.values().iter()).map(|(a, b)| (a - b).abs()).fold(largest, f64::max);
    }
    largest
}

#[test]
fn a_sound_blind_is_called_sound() {
    let found = examine(&blind());
    let worse: Vec<_> = found.iter().filter(|one| one.finding.severity > Severity::Info).collect();
    assert!(worse.is_empty(), "{worse:?}");
    assert!(found.iter().any(|one| one.finding.message.contains("excellent")));
}

#[test]
fn faults_planted_number_by_number_are_found_and_the_repair_offered_undoes_them() {
    let sound = blind();
    let cosine = |m: &CellMatrix, o: usize| m.emergent().cell(o).theta().cos();
    let all = |dataset: &Dataset, q: &dyn Fn(usize, usize, &CellMatrix) -> f64| {
        Component::ALL.into_iter().fold(dataset.clone(), |dataset, c| rewritten(&dataset, c, q))
    };
    let cases: Vec<(&str, Dataset)> = vec![
        ("transposed-block", rewritten(&sound, BACK, |i, o, m| m.value(o, i))),
        ("upside-down-block", rewritten(&sound, BACK, |i, o, m| m.value(upside(m, i), upside(m, o)))),
        ("cosine-factor", all(&sound, &|i, o, m| m.value(i, o) * cosine(m, o))),
        ("percent", all(&sound, &|i, o, m| 100.0 * m.value(i, o))),
    ];
    for (code, broken) in cases {
        let found = examine(&broken);
        let one = found.iter().find(|one| one.finding.code == code).unwrap_or_else(|| panic!("{code}: {found:?}"));
        assert!(
            one.finding.severity > Severity::Info && !cfs::texts::findings::meaning(one.finding.code).is_empty(),
            "{one:?}"
        );
        let repair = one.repair.unwrap();
        let mended = repaired(&broken, repair).unwrap();
        assert!(largest_difference(&mended, &sound) < 1e-12, "{code} by {repair}");
        assert_eq!(recorded(&mended.description).1, [repair]);
        let back = repaired(&mended, repair.inverse().unwrap()).unwrap();
        assert!(largest_difference(&back, &broken) < 1e-9, "{code}");
        assert_eq!(back.description, broken.description);
    }
}

#[test]
fn the_block_with_the_swapped_label_is_put_right_and_no_other() {
    let sound = blind();
    for component in Component::ALL {
        // Columns read as rows.
        let swapped = rewritten(&sound, component, |i, o, m| m.value(o, i));
        let sure: Vec<Repair> =
            examine(&swapped).into_iter().filter(|one| one.sure).filter_map(|one| one.repair).collect();
        assert_eq!(sure.len(), 1, "{component:?}: {sure:?}");
        assert!(sure[0].blocks == BlockScope::One(component), "{component:?}: {}", sure[0]);
        assert!(
            largest_difference(&repaired_all(&swapped, &sure).unwrap(), &sound) < 1e-9,
            "{component:?}: {}",
            sure[0]
        );
    }
    // With two functions alone nothing says which of them it was: both are named, and none is touched.
    let mut two = rewritten(&sound, BACK, |i, o, m| m.value(o, i));
    (two.visible.reflection_front, two.visible.reflection_back) = (None, None);
    let found = examine(&two);
    assert!(found.iter().all(|one| !one.sure), "{found:?}");
    let asked = with_code(&found, "transposed-block");
    let named = |word: &str| asked.iter().any(|one| format!("{:?} {}", one.repair, one.finding.message).contains(word));
    assert!(asked.len() == 1 && named("Transmission Front") && named("Transmission Back"), "{found:?}");
}

/// Much light goes straight out whatever the incidence, on both sides alike but for the noise of measuring; what does
/// not pass is reflected. Transmission is far from going both ways alike, as in many simulated shutters.
fn shutter() -> Dataset {
    let noise = |i: usize, o: usize, side: usize| 1.0 + 0.25 * ((i * 7919 + o * 104_729 + side * 31) as f64).sin();
    let matrix = |map, q: &dyn Fn(&Cell, &Cell, usize, usize) -> f64| {
        let basis = RingBasis::klems_full(map);
        let cells: Vec<Cell> = basis.cells().collect();
        let value = |i: usize, o: usize| q(&cells[i], &cells[o], i, o);
        let values = (0..cells.len()).flat_map(|i| (0..cells.len()).map(move |o| (i, o)));
        let values = values.map(|(i, o)| value(i, o)).collect();
        Btdf::from_cells(CellMatrix::new(basis.clone(), basis, values).unwrap())
    };
    let tau = |cell: &Cell| 0.17 + 0.14 * cell.theta().cos().powi(4);
    let through = move |i: &Cell, o: &Cell| tau(i) * (0.35 + 2.2 * o.theta().cos().powi(4)) / PI / 1.08;
    let (front, back) = (AzimuthMap::KLEMS_FRONT, AzimuthMap::KLEMS_BACK);
    Dataset {
        visible: Band {
            transmission_front: Some(matrix(front, &|i, o, k, l| through(i, o) * noise(k, l, 0))),
            transmission_back: Some(matrix(back, &|i, o, k, l| through(i, o) * noise(k, l, 1))),
            reflection_front: Some(matrix(front, &|i, _, _, _| (0.85 - tau(i)) / PI)),
            reflection_back: Some(matrix(back, &|i, _, _, _| (0.85 - tau(i)) / PI)),
        },
        ..blind()
    }
}

#[test]
fn what_its_own_sums_contradict_is_not_offered() {
    let shutter = shutter();
    let found = examine(&shutter);
    // One transmission transposed would go with the other, and light would be won.
    assert!(found.iter().any(|one| one.finding.code == "reciprocity" && one.finding.severity == Severity::Warning));
    assert!(with_code(&found, "transposed-block").is_empty() && found.iter().all(|one| !one.sure), "{found:?}");
    let forced = repaired(&shutter, "transpose:transmission_back".parse().unwrap()).unwrap();
    assert!(with_code(&examine(&forced), "energy-above-one").len() == 1);
}

#[test]
fn states_of_the_same_data_are_told_the_same() {
    let (sound, percent) = (blind(), repaired(&blind(), "multiply-by-100".parse().unwrap()).unwrap());
    let states = [sound.clone(), percent.clone(), sound.clone()];
    assert_eq!(examine_all(&states), [examine(&sound), examine(&percent), examine(&sound)]);
}

#[test]
fn what_was_derived_follows_its_origin() {
    let mut one = blind();
    one.visible.transmission_front = None;
    let derived = repaired(&one, "derive-by-reciprocity:transmission_front".parse().unwrap()).unwrap();
    for word in ["transpose:transmission_back", "multiply-cosine"] {
        let after = repaired(&derived, word.parse().unwrap()).unwrap();
        let mut before = repaired(&one, word.parse().unwrap()).unwrap();
        before = repaired(&before, "derive-by-reciprocity:transmission_front".parse().unwrap()).unwrap();
        assert!(largest_difference(&after, &before) < 1e-12, "{word}");
    }
}

#[test]
fn copies_and_gaps_are_found() {
    let sound = blind();
    let code = |dataset: &Dataset, code: &str| examine(dataset).into_iter().find(|one| one.finding.code == code);
    let copy = copied(&sound, FRONT, BACK).unwrap();
    let derive = code(&copy, "copied-block").unwrap().repair.unwrap();
    assert!(largest_difference(&repaired(&copy, derive).unwrap(), &sound) < 1e-12);
    let gap = rewritten(&sound, FRONT, |i, o, m| if i == 40 { 0.0 } else { m.value(i, o) });
    assert!(code(&gap, "missing-patches").is_some());
    assert!(code(&sound, "missing-patches").is_none());
    let mut less = sound.clone();
    less.visible.reflection_back = None;
    assert!(code(&less, "missing-block").is_some_and(|one| one.finding.severity == Severity::Warning));
}

#[test]
fn what_no_data_can_tell_is_asked() {
    let turned = repaired(&blind(), "turn-upside-down".parse().unwrap()).unwrap();
    for dataset in [blind(), turned] {
        let found = examine(&dataset);
        let ask = found.iter().find(|one| one.finding.code == "orientation").unwrap();
        assert!(ask.finding.message.contains("If that is not so") && ask.repair.is_some(), "{ask:?}");
    }
}

#[test]
fn every_function_that_a_finding_names_gets_its_repair() {
    let sound = blind();
    let percent = [FRONT, BACK]
        .into_iter()
        .fold(sound.clone(), |dataset, component| rewritten(&dataset, component, |i, o, m| 100.0 * m.value(i, o)));
    let found = examine(&percent);
    let repairs: Vec<Repair> =
        found.iter().filter(|one| one.finding.code == "percent").filter_map(|one| one.repair).collect();
    assert_eq!(repairs.len(), 2, "{found:?}");
    assert!(largest_difference(&repaired_all(&percent, &repairs).unwrap(), &sound) < 1e-12);
}

/// The same with the solar transmission from outside transposed.
fn rewritten_solar(dataset: &Dataset) -> Dataset {
    repaired(dataset, "transpose:solar.transmission_front".parse().unwrap())
        .map(|made| Dataset { description: String::new(), ..made })
        .unwrap()
}

fn two_bands() -> Dataset {
    Dataset { visible: band(0.3, 0.7), solar: Some(band(0.36, 0.6)), ..blind() }
}

fn with_code<'a>(found: &'a [Diagnosis], code: &str) -> Vec<&'a Diagnosis> {
    found.iter().filter(|one| one.finding.code == code).collect()
}

#[test]
fn one_block_copied_from_band_to_band_is_noticed() {
    let sound = two_bands();
    assert!(examine(&sound).iter().all(|one| one.finding.severity == Severity::Info), "{:?}", examine(&sound));
    for (component, name) in [
        (FRONT, "Transmission Front (solar)"),
        (BACK, "Transmission Back (solar)"),
        (Component::ReflectionFront, "Reflection Front (solar)"),
        (Component::ReflectionBack, "Reflection Back (solar)"),
    ] {
        let mut copied = sound.clone();
        copied.solar.as_mut().unwrap().set(component, sound.visible.get(component).unwrap().clone());
        let found = examine(&copied);
        let told = with_code(&found, "band-copied");
        assert_eq!(told.len(), 1, "{name}: {found:?}");
        assert_eq!(told[0].finding.severity, Severity::Warning);
        assert!(told[0].finding.message.contains(name), "{name}: {}", told[0].finding.message);
        // Which band it belongs to, no number says: nothing is done by itself.
        assert!(told[0].repair.is_none() && found.iter().all(|one| !one.sure), "{name}: {found:?}");
    }
    let mut whole = sound.clone();
    whole.solar = Some(sound.visible.clone());
    assert_eq!(with_code(&examine(&whole), "band-copied").len(), 1);
    // Bands of a neutral material agree in everything: no single block of it was copied.
    let mut neutral = sound.clone();
    neutral.solar = Some(band(0.301, 0.7));
    neutral.solar.as_mut().unwrap().set(Component::ReflectionBack, sound.visible.reflection_back.clone().unwrap());
    assert!(with_code(&examine(&neutral), "band-copied").is_empty());
}

#[test]
fn a_copied_transmission_is_told_from_the_genuine_one_by_the_light_left_over() {
    // All that is not transmitted is reflected evenly: the reflection knows the genuine transmission.
    let mut sound = two_bands();
    sound.solar = None;
    for (from, to) in [(FRONT, BACK), (BACK, FRONT)] {
        let copied = copied(&sound, from, to).unwrap();
        // A copy that was rounded on its way is one all the same.
        let rounded = rewritten(&copied, to, |i, o, m| format!("{:.3e}", m.value(i, o)).parse().unwrap());
        assert_eq!(with_code(&examine(&rounded), "copied-block").len(), 1, "{to:?} rounded");
        let found = examine(&copied);
        let told = with_code(&found, "copied-block");
        assert_eq!(told.len(), 1, "{to:?}: {found:?}");
        assert!(!told[0].sure, "a genuine block could be lost: {:?}", told[0]);
        if let Some(repair) = told[0].repair {
            let mended = repaired(&copied, repair).unwrap();
            let (a, b) = (mended.visible.get(to).unwrap(), sound.visible.get(to).unwrap());
            assert!((a.tau_normal() - b.tau_normal()).abs() < 1e-9, "{to:?}: {repair} does not restore it");
        }
    }
}

fn cfs(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cfs")).args(arguments).current_dir(folder).output().unwrap()
}

#[test]
fn auto_makes_what_is_beyond_doubt_and_asks_for_the_rest() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let put = |name: &str, dataset: &Dataset| {
        std::fs::write(folder.join(name), bsdf_xml::write(dataset).unwrap().bytes).unwrap();
    };
    let sound = two_bands();
    put("sound.xml", &sound);
    put("percent.xml", &repaired(&sound, "multiply-by-100".parse().unwrap()).unwrap());
    // Turned as a whole, nothing contradicts itself: only who knows the product can say.
    put("turned.xml", &repaired(&sound, "turn-upside-down".parse().unwrap()).unwrap());
    for name in ["sound.xml", "turned.xml"] {
        let output = cfs(folder, &["repair", name, "--repair", "auto", "--out", "out.xml"]);
        assert_eq!(output.status.code(), Some(2), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(!folder.join("out.xml").exists());
    }
    let output = cfs(folder, &["repair", "turned.xml", "--repair", "auto", "--out", "out.xml"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(error.contains("question") && error.contains("turn-upside-down"), "{error}");

    let label = rewritten(&rewritten_solar(&sound), FRONT, |i, o, m| m.value(o, i));
    put("label.xml", &label);
    let output = cfs(folder, &["repair", "label.xml", "--repair", "auto", "--out", "label_out.xml"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mended = bsdf_xml::read(&std::fs::read(folder.join("label_out.xml")).unwrap()).unwrap();
    assert!(largest_difference(&mended, &sound) < 1e-6);

    let output = cfs(folder, &["repair", "percent.xml", "--repair", "auto", "--out", "out.xml"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mended = bsdf_xml::read(&std::fs::read(folder.join("out.xml")).unwrap()).unwrap();
    for (mended, sound) in
        [(&mended.visible, &sound.visible), (mended.solar.as_ref().unwrap(), sound.solar.as_ref().unwrap())]
    {
        for component in Component::ALL {
            let (a, b) = (mended.get(component).unwrap(), sound.get(component).unwrap());
            assert!((a.tau_hemispherical() / b.tau_hemispherical() - 1.0).abs() < 1e-8, "{component:?}");
        }
    }
}

/// The transmission from outside as text, every value `times` as large, the first one replaced.
fn text(times: f64, first: Option<f64>) -> Vec<u8> {
    let mut dataset = two_bands();
    dataset.solar = None;
    let written = String::from_utf8(btdf_text::write(&dataset).unwrap().bytes).unwrap();
    let mut replaced = first;
    let number = |word: &str| (word.parse::<f64>().unwrap() * times).to_string();
    let line = |line: &str| -> String {
        if !line.starts_with(|c: char| c.is_ascii_digit()) {
            return line.to_owned();
        }
        let words: Vec<&str> = line.split(' ').collect();
        let mut values: Vec<String> = words[2..].iter().map(|word| number(word)).collect();
        if let Some(first) = replaced.take() {
            values[0] = first.to_string();
        }
        format!("{} {} {}", words[0], words[1], values.join(" "))
    };
    written.lines().map(line).collect::<Vec<_>>().join("\n").into_bytes()
}

#[test]
fn text_in_percent_is_read_told_and_mended() {
    let sound = btdf_text::read(&text(1.0, None)).unwrap();
    assert!(examine(&sound).iter().all(|one| one.finding.severity < Severity::Error), "{:?}", examine(&sound));
    let percent = btdf_text::read(&text(100.0, None)).unwrap();
    let found = examine(&percent);
    let told = with_code(&found, "percent");
    assert!(told.len() == 1 && told[0].sure && told[0].finding.severity == Severity::Error, "{found:?}");
    let mended = repaired(&percent, told[0].repair.unwrap()).unwrap();
    let (a, b) = (mended.transmission().unwrap(), sound.transmission().unwrap());
    assert!((a.tau_hemispherical() / b.tau_hemispherical() - 1.0).abs() < 1e-9);
    // In no unit, and with a factor that need not be percent.
    let error = btdf_text::read(&text(4.0, None)).unwrap_err().to_string();
    assert!(error.contains("times the light") && error.contains("π"), "{error}");
    let error = btdf_text::read(&text(1e4, None)).unwrap_err().to_string();
    assert!(error.contains("times the light") && error.contains("percent"), "{error}");
}

#[test]
fn noise_below_zero_is_set_to_zero_and_told_while_more_is_an_error_with_its_place() {
    let sound = btdf_text::read(&text(1.0, None)).unwrap();
    let Some(Scattered::Cells(matrix)) = &sound.transmission().unwrap().scattered else { panic!() };
    let largest = matrix.values().iter().copied().fold(0.0, f64::max);
    let noisy = btdf_text::read(&text(1.0, Some(-0.9e-3 * largest))).unwrap();
    let told: Vec<_> = noisy.findings.iter().filter(|one| one.code == "negative-values").collect();
    assert!(
        told.len() == 1 && told[0].severity == Severity::Info && told[0].message.contains("1 negative"),
        "{told:?}"
    );
    let Some(Scattered::Cells(matrix)) = &noisy.transmission().unwrap().scattered else { panic!() };
    assert!(matrix.values().iter().all(|q| *q >= 0.0));
    let error = btdf_text::read(&text(1.0, Some(-1.1e-3 * largest))).unwrap_err().to_string();
    let first = text(1.0, None);
    let before = String::from_utf8(first).unwrap();
    let line = 1 + before.lines().position(|line| line.starts_with(|c: char| c.is_ascii_digit())).unwrap();
    assert!(error.contains("negative") && error.contains(&format!("line {line}")), "{error}");
}
