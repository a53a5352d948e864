//! Tests the data check with known faults: it plants one fault at a time in good datasets and examines the result.
//!
//! `cargo run --release --example planted_faults [FILE…]`
//!
//! Without files it takes all BSDF XML files of the reference data (`CFS_TEST_DATA`). Look at the counts per fault:
//! - *repaired*: repaired automatically, and correctly;
//! - *asked*: the correct repair is among those offered;
//! - *general*: the correct repair is offered by the finding that every file with a preferred direction gets;
//! - *reported*: a new finding, without the correct repair;
//! - *missed*: no new finding;
//! - *worse*: an automatic repair that is wrong.
//!
//! Then follow the genuine files that get an automatic repair or an offer beyond the general one, and those that are
//! nearest to an offer. The constants `scale`, `ASK` and `SURE` of `compute::doctor::judgement` are chosen by these
//! tables: no file may become worse, and no genuine file may get an offer from the list of hypotheses.

use anyhow::Context as _;
use cfs::compute::basis::{AzimuthMap, Cell, RingBasis};
use cfs::compute::btdf::{Band, Btdf, CellMatrix, Component, Dataset, Scattered, Severity, tau_max};
use cfs::compute::doctor::{BlockScope, Diagnosis, Repair, RepairKind, examine, repaired, repaired_all, standing};
use cfs::formats::bsdf_xml;
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Weighted relative change below which two datasets count as equal, since measurement errors are larger.
const NOTHING: f64 = 0.02;

/// Good dataset, with the name of its file.
struct Good {
    name: String,
    dataset: Dataset,
}

/// Lists all XML files in a folder and its subfolders.
fn walk(folder: &Path, list: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            walk(&path, list);
        } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("xml")) {
            list.push(path);
        }
    }
}

/// Reads the files of products, without duplicates. Parser samples and an artificial tensor tree are left out.
fn products(mut files: Vec<PathBuf>) -> anyhow::Result<Vec<Good>> {
    files.sort();
    let mut seen = BTreeSet::new();
    let mut list = Vec::new();
    for path in files {
        let text = path.to_string_lossy();
        if text.contains("parser_samples") || text.contains("tiny_tensor_tree") {
            continue;
        }
        let bytes = std::fs::read(&path).with_context(|| format!("{text} cannot be read"))?;
        if seen.insert(bytes.clone()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            list.push(Good { dataset: bsdf_xml::read(&bytes).with_context(|| name.clone())?, name });
        }
    }
    Ok(list)
}

/// Makes datasets that are reciprocal by construction: blinds of different transmittance, reflection and asymmetry.
fn made() -> Vec<Good> {
    let blind = |amount: f64, slope: f64, aside: f64| {
        let rise = |cell: &Cell| cell.centre().vector().y;
        let right = |cell: &Cell| cell.centre().vector().x;
        let enters = move |cell: &Cell| amount * (1.0 - 0.9 * rise(cell)) * (1.0 + aside * right(cell));
        let leaves = move |cell: &Cell| (1.0 + 0.5 * rise(cell)) * cell.theta().cos();
        // Directions of reflected light are stored rotated by 180°; a product of rotated factors then has r(ω, ω′) =
        // r(ω′, ω).
        let mirror = move |i: &Cell, o: &Cell, a: f64| 0.3 * (1.0 + a * rise(i)) * (1.0 - a * rise(o)) / PI;
        let matrix = |map, q: &dyn Fn(&Cell, &Cell) -> f64| {
            let basis = RingBasis::klems_full(map);
            let cells: Vec<Cell> = basis.cells().collect();
            let values = cells.iter().flat_map(|i| cells.iter().map(move |o| q(i, o))).collect();
            CellMatrix::new(basis.clone(), basis, values).map(Btdf::from_cells)
        };
        let (front, back) = (AzimuthMap::KLEMS_FRONT, AzimuthMap::KLEMS_BACK);
        Band {
            transmission_front: matrix(front, &|i, o| enters(i) * leaves(o) / PI),
            transmission_back: matrix(back, &|i, o| enters(o) * leaves(i) / PI),
            reflection_front: matrix(front, &|i, o| mirror(i, o, slope)),
            reflection_back: matrix(back, &|i, o| mirror(i, o, -0.375 * slope)),
        }
    };
    let parts = [(0.4, 0.8, 0.1), (0.3, 0.7, 0.1), (0.2, 0.5, 0.0), (0.1, 0.4, 0.3)];
    let of = |(amount, slope, aside)| Good {
        name: format!("made: blind {amount} {slope} {aside}"),
        dataset: Dataset {
            name: "Blind".into(),
            manufacturer: "Made".into(),
            format: "made here".into(),
            visible: blind(amount, slope, aside),
            ..Dataset::default()
        },
    };
    parts.into_iter().map(of).collect()
}

/// Fault to plant in a good dataset.
enum Fault {
    /// Repair, which damages good data.
    Done(&'static str),
    /// Copy of one block of data under the name of another.
    Copied(Component, Component),
    /// Block of zeros.
    Zeroed(Component),
}

const FRONT: Component = Component::TransmissionFront;
const BACK: Component = Component::TransmissionBack;
const OUTSIDE: Component = Component::ReflectionFront;
const INSIDE: Component = Component::ReflectionBack;

const FAULTS: &[(&str, Fault)] = &[
    ("label T front", Fault::Done("transpose:transmission_front")),
    ("label T back", Fault::Done("transpose:transmission_back")),
    ("label R front", Fault::Done("transpose:reflection_front")),
    ("label R back", Fault::Done("transpose:reflection_back")),
    ("label T", Fault::Done("transpose:transmission")),
    ("label R", Fault::Done("transpose:reflection")),
    ("label all", Fault::Done("transpose")),
    ("upside down T front", Fault::Done("turn-upside-down:transmission_front")),
    ("upside down T back", Fault::Done("turn-upside-down:transmission_back")),
    ("upside down R front", Fault::Done("turn-upside-down:reflection_front")),
    ("upside down R back", Fault::Done("turn-upside-down:reflection_back")),
    ("upside down T", Fault::Done("turn-upside-down:transmission")),
    ("upside down R", Fault::Done("turn-upside-down:reflection")),
    ("upside down all", Fault::Done("turn-upside-down")),
    ("mirrored T front", Fault::Done("mirror-left-right:transmission_front")),
    ("mirrored T back", Fault::Done("mirror-left-right:transmission_back")),
    ("azimuth T front", Fault::Done("turn-half-round:transmission_front")),
    ("azimuth T back", Fault::Done("turn-half-round:transmission_back")),
    ("sides of T", Fault::Done("swap-sides:transmission")),
    ("sides of R", Fault::Done("swap-sides:reflection")),
    ("sides of all", Fault::Done("swap-sides")),
    ("percent T front", Fault::Done("multiply-by-100:transmission_front")),
    ("percent R back", Fault::Done("multiply-by-100:reflection_back")),
    ("percent all", Fault::Done("multiply-by-100")),
    ("cosine × T front", Fault::Done("multiply-cosine:transmission_front")),
    ("cosine × T", Fault::Done("multiply-cosine:transmission")),
    ("cosine × R front", Fault::Done("multiply-cosine:reflection_front")),
    ("cosine × all", Fault::Done("multiply-cosine")),
    ("cosine / T front", Fault::Done("remove-cosine:transmission_front")),
    ("cosine / T", Fault::Done("remove-cosine:transmission")),
    ("cosine / R back", Fault::Done("remove-cosine:reflection_back")),
    ("cosine / all", Fault::Done("remove-cosine")),
    ("solid angle × all", Fault::Done("multiply-solid-angle")),
    ("missing T back", Fault::Done("drop-block:transmission_back")),
    ("missing R back", Fault::Done("drop-block:reflection_back")),
    ("missing R", Fault::Done("drop-block:reflection")),
    ("zero T back", Fault::Zeroed(BACK)),
    ("zero R back", Fault::Zeroed(INSIDE)),
    ("copy T front to T back", Fault::Copied(FRONT, BACK)),
    ("copy T back to T front", Fault::Copied(BACK, FRONT)),
    ("copy R front to R back", Fault::Copied(OUTSIDE, INSIDE)),
    ("copy T front to R front", Fault::Copied(FRONT, OUTSIDE)),
];

impl Fault {
    /// Returns the dataset with the fault, or `None` if it lacks the block that the fault concerns.
    fn planted(&self, dataset: &Dataset) -> Option<Dataset> {
        match self {
            Self::Done(word) => done(dataset, word.parse().ok()?),
            Self::Copied(from, to) => {
                let (source, target) = (cells(dataset, *from)?, cells(dataset, *to)?);
                (tau_max(dataset.visible.get(*from)?) > 0.0 && !dataset.derived.contains(from)).then_some(())?;
                with(dataset, *to, target, source.values().into_owned())
            }
            Self::Zeroed(component) => {
                let target = cells(dataset, *component)?;
                with(dataset, *component, target, vec![0.0; target.values().len()])
            }
        }
    }
}

fn cells(dataset: &Dataset, component: Component) -> Option<&CellMatrix> {
    match dataset.visible.get(component)?.scattered.as_ref()? {
        Scattered::Cells(matrix) => Some(matrix),
        _ => None,
    }
}

/// Replaces the values of a block.
fn with(dataset: &Dataset, component: Component, target: &CellMatrix, values: Vec<f64>) -> Option<Dataset> {
    let mut planted = dataset.clone();
    let matrix = CellMatrix::new(target.incident().clone(), target.emergent().clone(), values)?;
    planted.visible.set(component, Btdf::from_cells(matrix));
    Some(planted)
}

fn done(dataset: &Dataset, repair: Repair) -> Option<Dataset> {
    let own = |c: &Component| dataset.visible.get(*c).is_some() && !dataset.derived.contains(c);
    let pairs = repair.blocks == BlockScope::Transmission || repair.kind == RepairKind::SwapSides;
    // Repairs of pairs need both blocks.
    let there = match repair.blocks {
        BlockScope::One(component) => own(&component),
        _ if pairs => own(&FRONT) && own(&BACK),
        scope => Component::ALL.iter().any(|c| scope.holds(*c) && own(c)),
    };
    if !there {
        return None;
    }
    // Blocks that were derived when the file was read are derived again from the damaged data.
    let mut source = dataset.clone();
    for component in &dataset.derived {
        let drop = Repair { blocks: BlockScope::One(*component), ..Repair::whole(RepairKind::DropBlock) };
        source = repaired(&source, drop).ok()?;
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

/// Returns the largest weighted relative change of any block.
fn change(before: &Dataset, after: &Dataset) -> f64 {
    let mut largest = 0.0_f64;
    for component in Component::ALL {
        let (Some(a), Some(b)) = (before.visible.get(component), after.visible.get(component)) else {
            if before.visible.get(component).is_some() {
                largest = 1.0;
            }
            continue;
        };
        let (Some(a), Some(b)) = (cells(before, component), cells(after, component)) else {
            largest = largest.max(f64::from(u8::from(a != b)));
            continue;
        };
        let (wi, wo) = (a.incident().projected_solid_angles(), a.emergent().projected_solid_angles());
        let (a, b) = (a.values(), b.values());
        let (mut difference, mut sum) = (0.0, 0.0);
        for ((a, b), k) in a.iter().zip(b.iter()).zip(0..) {
            let w = wi[k / wo.len()] * wo[k % wo.len()];
            difference += w * (a - b).abs();
            sum += w * 0.5 * (a + b);
        }
        if sum > 1e-9 {
            largest = largest.max(difference / sum);
        }
    }
    largest
}

/// Outcome of the data check for one planted fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Outcome {
    /// Automatic repair that is correct.
    Repaired,
    /// Correct repair among those offered.
    Asked,
    /// Correct repair, offered by the finding that every file with a preferred direction gets.
    General,
    /// New finding, without the correct repair.
    Reported,
    /// No new finding.
    Missed,
    /// Automatic repair that is wrong.
    Worse,
}

impl Outcome {
    const ALL: [Self; 6] = [Self::Repaired, Self::Asked, Self::General, Self::Reported, Self::Missed, Self::Worse];
}

/// Returns the repairs that a finding offers: its own, and the alternatives that its message names.
fn offered(one: &Diagnosis) -> Vec<Repair> {
    let words = one.finding.message.split(['(', ')']).filter_map(|word| word.parse().ok());
    one.repair.into_iter().chain(words).collect()
}

fn outcome(good: &Dataset, planted: &Dataset, before: &[Diagnosis], found: &[Diagnosis]) -> Outcome {
    let right =
        |repairs: &[Repair]| repaired_all(planted, repairs).is_ok_and(|repaired| change(good, &repaired) < NOTHING);
    let mut sure: Vec<Repair> = Vec::new();
    for repair in found.iter().filter(|one| one.sure).filter_map(|one| one.repair) {
        if !sure.contains(&repair) {
            sure.push(repair);
        }
    }
    if !sure.is_empty() {
        return if right(&sure) { Outcome::Repaired } else { Outcome::Worse };
    }
    for one in found {
        // A finding about several blocks offers one repair for each.
        let together: Vec<Repair> =
            found.iter().filter(|other| other.finding == one.finding).filter_map(|other| other.repair).collect();
        if right(&together) && !together.is_empty() || offered(one).iter().any(|repair| right(&[*repair])) {
            let general = one.finding.severity == Severity::Info;
            return if general { Outcome::General } else { Outcome::Asked };
        }
    }
    let count = |list: &[Diagnosis], code: &str| {
        list.iter().filter(|one| one.finding.code == code && one.finding.severity > Severity::Info).count()
    };
    let new = found.iter().any(|one| count(found, one.finding.code) > count(before, one.finding.code));
    if new { Outcome::Reported } else { Outcome::Missed }
}

fn main() -> anyhow::Result<()> {
    let mut files: Vec<PathBuf> = std::env::args().skip(1).map(PathBuf::from).collect();
    if files.is_empty() {
        let root = std::env::var_os("CFS_TEST_DATA")
            .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared"), PathBuf::from);
        ["data/bsdf", "reference/systems"].iter().for_each(|folder| walk(&root.join(folder), &mut files));
    }
    let mut goods = products(files)?;
    goods.extend(made());
    let before: Vec<Vec<Diagnosis>> = goods.iter().map(|good| examine(&good.dataset)).collect();

    println!("{:<26} planted  repaired  asked  general  reported  missed  worse   not asked about", "fault");
    let (mut totals, mut spent, mut slowest) = ([0_usize; 6], Duration::ZERO, Duration::ZERO);
    for (name, fault) in FAULTS {
        let mut counts = [0_usize; 6];
        let mut rest = Vec::new();
        for (good, before) in goods.iter().zip(&before) {
            // Tensor trees take long and add no other kind of fault.
            if good.dataset.format.contains("tree") {
                continue;
            }
            let Some(planted) = fault.planted(&good.dataset) else { continue };
            if change(&good.dataset, &planted) < NOTHING {
                continue;
            }
            let start = Instant::now();
            let found = examine(&planted);
            let took = start.elapsed();
            (spent, slowest) = (spent + took, slowest.max(took));
            let outcome = outcome(&good.dataset, &planted, before, &found);
            counts[outcome as usize] += 1;
            if outcome > Outcome::Asked {
                rest.push(format!("{} {outcome:?}", good.name));
            }
        }
        totals.iter_mut().zip(counts).for_each(|(total, count)| *total += count);
        println!("{}   {}", row(name, &counts), rest.join(", "));
    }
    println!("{}", row("all", &totals));
    let planted: usize = totals.iter().sum();
    println!(
        "mean {:.1} ms, longest {:.0} ms",
        1e3 * spent.as_secs_f64() / planted as f64,
        1e3 * slowest.as_secs_f64()
    );

    println!("\ngenuine files with an automatic repair (SURE), or an offer beyond the general one:");
    for (good, found) in goods.iter().zip(&before) {
        for one in found.iter().filter(|one| one.sure || one.finding.severity > Severity::Info) {
            if let Some(repair) = one.repair {
                println!("  {}: {}{} {repair}", good.name, if one.sure { "SURE " } else { "" }, one.finding.code);
            }
        }
    }
    println!("\ngenuine files nearest to an offer: gain and lead of their best hypothesis, and its repairs:");
    let mut near: Vec<_> = goods.iter().filter_map(|good| Some((standing(&good.dataset)?, &good.name))).collect();
    near.sort_by(|a, b| b.0.gain.total_cmp(&a.0.gain));
    for (best, name) in near.iter().take(8) {
        let repairs = best.repairs.iter().map(Repair::to_string).collect::<Vec<_>>().join(" ");
        println!("  {:>6.2} {:>6.2}  {name}: {repairs}", best.gain, best.lead);
    }
    Ok(())
}

fn row(name: &str, counts: &[usize; 6]) -> String {
    let widths = [10, 7, 9, 10, 8, 7];
    let cells: String =
        Outcome::ALL.iter().zip(widths).map(|(one, w)| format!("{:>w$}", counts[*one as usize])).collect();
    format!("{name:<26}{:>8}{cells}", counts.iter().sum::<usize>())
}
