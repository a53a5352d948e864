//! The data doctor on files of makers and programs, as they are and with faults planted in them.

use crate::common::data;
use cfs::compute::btdf::{Btdf, CellMatrix, Component, Dataset, Scattered, Severity, tau_max};
use cfs::compute::doctor::{BlockScope, Diagnosis, Repair, RepairKind, examine, repaired, repaired_all};
use cfs::formats::bsdf_xml;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn walk(folder: &Path, list: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            walk(&path, list);
        } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("xml")) {
            list.push(path);
        }
    }
}

/// Every dataset that can be read, by file name. Parser samples and a hand-made tree are no products.
fn genuine() -> Vec<(String, Dataset)> {
    let Some(makers) = data("data/bsdf") else { return Vec::new() };
    let Some(systems) = data("reference/systems") else { return Vec::new() };
    let mut files = Vec::new();
    walk(&makers, &mut files);
    walk(&systems, &mut files);
    if let Some(more) = std::env::var_os("CFS_TEST_MORE_XML") {
        walk(Path::new(&more), &mut files);
    }
    files.sort();
    // Copies of one file under two names would count twice.
    let mut seen = std::collections::BTreeSet::new();
    files.retain(|path| seen.insert(std::fs::read(path).unwrap()));
    let product = |path: &PathBuf| {
        let text = path.to_string_lossy();
        !text.contains("parser_samples") && !text.contains("tiny_tensor_tree")
    };
    files
        .into_iter()
        .filter(product)
        .map(|path| {
            let dataset = bsdf_xml::read(&std::fs::read(&path).unwrap()).unwrap();
            (path.file_name().unwrap().to_string_lossy().into_owned(), dataset)
        })
        .collect()
}

#[test]
fn no_genuine_product_is_called_broken() {
    for (name, dataset) in genuine() {
        let found = examine(&dataset);
        for one in found.iter().filter(|one| one.finding.severity == Severity::Warning) {
            println!("{name}: {} {}", one.finding.code, one.finding.message);
        }
        let broken: Vec<&Diagnosis> = found.iter().filter(|one| one.finding.severity == Severity::Error).collect();
        assert!(broken.is_empty(), "{name}: {broken:?}");
    }
}

const FRONT: Component = Component::TransmissionFront;
const BACK: Component = Component::TransmissionBack;

struct Plant {
    name: &'static str,
    codes: &'static [&'static str],
    make: fn(&Dataset) -> Option<Dataset>,
}

fn by(dataset: &Dataset, word: &str) -> Option<Dataset> {
    let repair: Repair = word.parse().unwrap();
    let blocks = dataset.visible.components();
    let meant = |c: &Component| repair.blocks.holds(*c) && !dataset.derived.contains(c);
    if let BlockScope::One(component) = repair.blocks
        && (!blocks.contains(&component) || dataset.derived.contains(&component))
    {
        return None;
    }
    if !blocks.iter().any(meant) {
        return None;
    }
    if repair.blocks == BlockScope::Transmission || repair.kind == RepairKind::SwapSides {
        // What belongs together only makes sense in pairs.
        let both = [FRONT, BACK].iter().all(|c| blocks.contains(c) && !dataset.derived.contains(c));
        if !both {
            return None;
        }
    }
    // A file that lost a function is read again: what was derived is derived anew.
    let mut source = dataset.clone();
    for component in &dataset.derived {
        source =
            repaired(&source, Repair { blocks: BlockScope::One(*component), ..Repair::whole(RepairKind::DropBlock) })
                .ok()?;
    }
    source.derived.clear();
    let mut planted = repaired(&source, repair).ok()?;
    planted.description.clear();
    if !dataset.derived.is_empty() || planted.visible.transmission_front.is_none() {
        let derive = Repair { blocks: BlockScope::One(FRONT), ..Repair::whole(RepairKind::DeriveByReciprocity) };
        planted = repaired(&planted, derive).unwrap_or(planted);
    }
    Some(planted)
}

fn copied(dataset: &Dataset, from: Component, to: Component) -> Option<Dataset> {
    let mut planted = dataset.clone();
    let Scattered::Cells(source) = dataset.visible.get(from)?.scattered.as_ref()? else { return None };
    let Scattered::Cells(target) = dataset.visible.get(to)?.scattered.as_ref()? else { return None };
    let matrix =
        CellMatrix::new(target.incident().clone(), target.emergent().clone(), source.values().into_owned()).unwrap();
    planted.visible.set(to, Btdf::from_cells(matrix));
    (tau_max(dataset.visible.get(from)?) > 0.0).then_some(planted)
}

fn zeroed(dataset: &Dataset, component: Component) -> Option<Dataset> {
    let mut planted = dataset.clone();
    let Scattered::Cells(matrix) = dataset.visible.get(component)?.scattered.as_ref()? else { return None };
    let zero = vec![0.0; matrix.values().len()];
    let zero = CellMatrix::new(matrix.incident().clone(), matrix.emergent().clone(), zero).unwrap();
    planted.visible.set(component, Btdf::from_cells(zero));
    Some(planted)
}

const WAYS: &[&str] = &[
    "upside-down-block",
    "mirrored-block",
    "transposed-block",
    "sides-swapped",
    "maybe-upside-down",
    "maybe-sides-swapped",
    "energy-above-one",
];
/// Where little light passes, hundred times as much is an energy above one and no more.
const PERCENT: &[&str] = &["percent", "energy-above-one"];
const MISSING: &[&str] = &["missing-block", "no-transmission"];
const SCALE: &[&str] = &["cosine-factor", "energy-above-one"];

const PLANTS: &[Plant] = &[
    Plant { name: "flip T back", codes: WAYS, make: |d| by(d, "turn-upside-down:transmission_back") },
    Plant { name: "flip T front", codes: WAYS, make: |d| by(d, "turn-upside-down:transmission_front") },
    Plant { name: "half turn T back", codes: WAYS, make: |d| by(d, "turn-half-round:transmission_back") },
    Plant { name: "flip R front", codes: WAYS, make: |d| by(d, "turn-upside-down:reflection_front") },
    Plant { name: "flip R back", codes: WAYS, make: |d| by(d, "turn-upside-down:reflection_back") },
    Plant { name: "flip R both", codes: WAYS, make: |d| by(d, "turn-upside-down:reflection") },
    Plant { name: "flip T both", codes: WAYS, make: |d| by(d, "turn-upside-down:transmission") },
    Plant { name: "flip all", codes: WAYS, make: |d| by(d, "turn-upside-down") },
    Plant { name: "swap T", codes: WAYS, make: |d| by(d, "swap-sides:transmission") },
    Plant { name: "swap R", codes: WAYS, make: |d| by(d, "swap-sides:reflection") },
    Plant { name: "swap all", codes: WAYS, make: |d| by(d, "swap-sides") },
    Plant { name: "transpose T front", codes: WAYS, make: |d| by(d, "transpose:transmission_front") },
    Plant { name: "transpose T back", codes: WAYS, make: |d| by(d, "transpose:transmission_back") },
    Plant { name: "transpose R front", codes: WAYS, make: |d| by(d, "transpose:reflection_front") },
    Plant { name: "transpose all", codes: WAYS, make: |d| by(d, "transpose") },
    Plant { name: "percent T front", codes: PERCENT, make: |d| by(d, "multiply-by-100:transmission_front") },
    Plant { name: "percent R back", codes: PERCENT, make: |d| by(d, "multiply-by-100:reflection_back") },
    Plant { name: "percent all", codes: PERCENT, make: |d| by(d, "multiply-by-100") },
    Plant { name: "cosine x T front", codes: SCALE, make: |d| by(d, "multiply-cosine:transmission_front") },
    Plant { name: "cosine x T", codes: SCALE, make: |d| by(d, "multiply-cosine:transmission") },
    Plant { name: "cosine x R front", codes: SCALE, make: |d| by(d, "multiply-cosine:reflection_front") },
    Plant { name: "cosine x all", codes: SCALE, make: |d| by(d, "multiply-cosine") },
    Plant { name: "cosine / T front", codes: SCALE, make: |d| by(d, "remove-cosine:transmission_front") },
    Plant { name: "cosine / T", codes: SCALE, make: |d| by(d, "remove-cosine:transmission") },
    Plant { name: "cosine / R back", codes: SCALE, make: |d| by(d, "remove-cosine:reflection_back") },
    Plant { name: "cosine / all", codes: SCALE, make: |d| by(d, "remove-cosine") },
    Plant { name: "solid angle x all", codes: SCALE, make: |d| by(d, "multiply-solid-angle") },
    Plant { name: "missing T back", codes: MISSING, make: |d| by(d, "drop-block:transmission_back") },
    Plant { name: "missing R back", codes: MISSING, make: |d| by(d, "drop-block:reflection_back") },
    Plant { name: "missing R both", codes: MISSING, make: |d| by(d, "drop-block:reflection") },
    Plant { name: "zero T back", codes: &["back-zero", "front-zero"], make: |d| zeroed(d, BACK) },
    Plant { name: "zero R back", codes: &["zero-block"], make: |d| zeroed(d, Component::ReflectionBack) },
    Plant { name: "copy T front to T back", codes: &["copied-block"], make: |d| copied(d, FRONT, BACK) },
    Plant {
        name: "copy R front to R back",
        codes: &["copied-block"],
        make: |d| copied(d, Component::ReflectionFront, Component::ReflectionBack),
    },
    Plant {
        name: "copy T front to R front",
        codes: &["block-mislabelled"],
        make: |d| copied(d, FRONT, Component::ReflectionFront),
    },
];

/// Largest weighted relative change of any function; a plant without effect is none.
fn effect(before: &Dataset, after: &Dataset) -> f64 {
    let mut largest = 0.0_f64;
    for component in Component::ALL {
        let (Some(a), Some(b)) = (before.visible.get(component), after.visible.get(component)) else {
            if before.visible.get(component).is_some() {
                largest = 1.0;
            }
            continue;
        };
        let (Some(Scattered::Cells(a)), Some(Scattered::Cells(b))) = (&a.scattered, &b.scattered) else {
            largest = largest.max(if a == b { 0.0 } else { 1.0 });
            continue;
        };
        let (wi, wo) = (a.incident().projected_solid_angles(), a.emergent().projected_solid_angles());
        let (mut difference, mut sum) = (0.0, 0.0);
        for (i, wi) in wi.iter().enumerate() {
            for (o, wo) in wo.iter().enumerate() {
                difference += wi * wo * (a.value(i, o) - b.value(i, o)).abs();
                sum += wi * wo * 0.5 * (a.value(i, o) + b.value(i, o));
            }
        }
        if sum > 1e-9 {
            largest = largest.max(difference / sum);
        }
    }
    largest
}

fn warned(found: &[Diagnosis]) -> BTreeMap<&'static str, Severity> {
    let mut codes = BTreeMap::new();
    for one in found {
        let worst = codes.entry(one.finding.code).or_insert(one.finding.severity);
        *worst = one.finding.severity.max(*worst);
    }
    codes
}

#[test]
fn planted_faults_in_genuine_products_are_found() {
    let cells = |dataset: &Dataset| !dataset.format.contains("tree");
    let genuine: Vec<(String, Dataset)> = genuine().into_iter().filter(|(_, dataset)| cells(dataset)).collect();
    let examined: BTreeMap<&String, Vec<Diagnosis>> = genuine.iter().map(|(name, one)| (name, examine(one))).collect();
    let known: BTreeMap<&String, _> = examined.iter().map(|(name, found)| (*name, warned(found))).collect();
    let mut totals = (0, 0, 0);
    let mut harmed = Vec::new();
    println!("| fault | planted | found | as error | asked | restored unasked | without effect (< 2 %) | neither |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for plant in PLANTS {
        let (mut planted, mut found, mut errors, mut asked, mut restored, mut nothing) = (0, 0, 0, 0, 0, 0);
        let mut missed = Vec::new();
        for (name, dataset) in &genuine {
            let Some(broken) = (plant.make)(dataset) else { continue };
            let change = effect(dataset, &broken);
            if change < 0.02 {
                nothing += 1;
                continue;
            }
            planted += 1;
            let found_now = examine(&broken);
            // What is made without being asked mends, and never leads further away from the genuine numbers.
            let mut sure: Vec<Repair> = Vec::new();
            for repair in found_now.iter().filter(|one| one.sure).filter_map(|one| one.repair) {
                if !sure.contains(&repair) {
                    sure.push(repair);
                }
            }
            if !sure.is_empty() {
                let left = effect(dataset, &repaired_all(&broken, &sure).unwrap());
                restored += usize::from(left < 0.02);
                if left > change + 0.02 {
                    harmed.push(format!("{}: {name} by {sure:?}: {change:.2} → {left:.2}", plant.name));
                }
            }
            let (before, after) = (&known[name], warned(&found_now));
            let new = after.iter().filter(|(code, severity)| before.get(*code).is_none_or(|old| old < severity));
            let told: Vec<&str> = new.clone().map(|(code, _)| *code).collect();
            let hits: Vec<_> = new.filter(|(code, _)| plant.codes.contains(code)).collect();
            // A block that repeats itself anew is told again even where something of the kind was told before.
            let again = plant.codes.iter().any(|code| {
                let count = |list: &[Diagnosis]| list.iter().filter(|one| one.finding.code == *code).count();
                count(&found_now) > count(&examined[name])
            });
            // Where all numbers agree with each other, the way the light goes is shown and asked about.
            let asks = |one: &Diagnosis| ["orientation", "sides"].contains(&one.finding.code) && one.repair.is_some();
            if hits.is_empty() && !again && plant.codes == WAYS && found_now.iter().any(asks) {
                asked += 1;
            } else if hits.is_empty() && !again {
                missed.push(format!(
                    "{name} ({change:.2}{}{})",
                    if told.is_empty() { "" } else { ": " },
                    told.join(" ")
                ));
            } else {
                found += 1;
                errors += usize::from(hits.iter().any(|(_, severity)| **severity == Severity::Error));
            }
        }
        totals.0 += planted;
        totals.1 += found;
        totals.2 += asked;
        println!(
            "| {} | {planted} | {found} | {errors} | {asked} | {restored} | {nothing} | {} |",
            plant.name,
            missed.join(", ")
        );
    }
    assert!(harmed.is_empty(), "{}", harmed.join("\n"));
    let (planted, found, asked) = totals;
    println!("of {planted}: {found} found, {asked} asked about");
    assert!(found * 100 >= planted * 75 && (found + asked) * 100 >= planted * 90, "{totals:?}");
}
