//! Writes a catalogue with many artificial products and measures the time to open and to search it.
//!
//! `cargo run --release --example large_catalogue FILE [PRODUCTS] [DATASETS]`
//!
//! By default 10 000 products share 500 datasets; one product in twenty has ten states. An existing file is not
//! written again, only measured. Look at the times of opening and of each search. `cfs --catalogue FILE` opens the
//! window with it.

use cfs::catalogue::{Catalogue, NewProduct, Query};
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset};
use cfs::compute::direction::{Dir, Facade};
use std::path::PathBuf;
use std::time::Instant;

/// Number of states of a product with several states.
const STATES: usize = 10;

const KINDS: [&str; 5] = ["venetian", "screen", "prismatic", "diffusing glass", "laser-cut panel"];
const MAKERS: [&str; 8] = ["Alder", "Birch", "Cedar", "Elm", "Fir", "Hazel", "Larch", "Maple"];
const FINISHES: [&str; 10] =
    ["white", "silver", "grey", "anthracite", "bronze", "mirror", "beige", "sand", "stone", "opal"];

fn main() -> anyhow::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let file = PathBuf::from(arguments.next().unwrap_or_else(|| "large.sqlite".to_owned()));
    let products: usize = arguments.next().map_or(Ok(10_000), |text| text.parse())?;
    let datasets: usize = arguments.next().map_or(Ok(500), |text| text.parse())?;
    if !file.exists() {
        let start = Instant::now();
        fill(&file, products, datasets.max(STATES))?;
        println!(
            "written in {:.1} s, {} MB",
            start.elapsed().as_secs_f64(),
            std::fs::metadata(&file)?.len() / 1_000_000
        );
    }
    let start = Instant::now();
    let catalogue = Catalogue::open(&file)?;
    let opened = start.elapsed();
    let all = catalogue.find(&Query::default())?;
    println!("opened in {:.0} ms, first list after {:.0} ms", milliseconds(opened), milliseconds(start.elapsed()));
    println!("{} products", all.entries.len());
    for words in ["v", "ve", "ven", "venetian", "venetian sil", "venetian silver 4", "nothing like it"] {
        let query = Query { text: words.to_owned(), ..Query::default() };
        let start = Instant::now();
        let found = catalogue.find(&query)?.entries.len();
        println!("{words:?}: {found} found in {:.1} ms", milliseconds(start.elapsed()));
    }
    Ok(())
}

fn milliseconds(time: std::time::Duration) -> f64 {
    1e3 * time.as_secs_f64()
}

fn fill(file: &std::path::Path, products: usize, datasets: usize) -> anyhow::Result<()> {
    let made: Vec<Dataset> = (0..datasets).map(|number| dataset(number, datasets)).collect();
    let mut catalogue = Catalogue::open(file)?;
    // Transactions of 500 products fit into memory.
    for first in (0..products).step_by(500) {
        let some = (first..products.min(first + 500)).map(|number| {
            let states = if number % 20 == 0 { STATES } else { 1 };
            let finish = FINISHES[number / KINDS.len() % FINISHES.len()];
            let new = NewProduct {
                name: format!("{} {finish} {number}", KINDS[number % KINDS.len()]),
                manufacturer: MAKERS[number % MAKERS.len()].to_owned(),
                kind: KINDS[number % KINDS.len()].to_owned(),
                description: format!("Made to try a large catalogue, {finish}"),
                tags: vec![finish.to_owned()],
                ..NewProduct::default()
            };
            let data = (0..states).map(|state| Dataset {
                state: if states > 1 { format!("slat_{}", 10 * state) } else { String::new() },
                ..made[(number + state) % datasets].clone()
            });
            (data.collect(), new)
        });
        catalogue.import_all(some.collect())?;
    }
    Ok(())
}

/// Makes a dataset with a lobe on the Tregenza patches, whose direction and width depend on `number`.
fn dataset(number: usize, of: usize) -> Dataset {
    let share = number as f64 / of as f64;
    let turned = (share * 140.0 - 70.0).to_radians();
    let sharp = 1.0 + 30.0 * (7.0 * share).sin().powi(2);
    let q = |i: Dir<Facade>, o: Dir<Facade>| {
        let (i, o) = (i.vector(), o.vector());
        let through = i.x * o.x
            + (i.y * turned.cos() - i.z * turned.sin()) * o.y
            + (i.y * turned.sin() + i.z * turned.cos()) * o.z;
        0.02 + 0.1 * through.max(0.0).powf(sharp)
    };
    let basis = RingBasis::tregenza().with_azimuth(AzimuthMap::KLEMS_FRONT);
    let centres: Vec<Dir<Facade>> = basis.cells().map(|cell| cell.centre()).collect();
    let values = centres.iter().flat_map(|&i| centres.iter().map(move |&o| q(i, o))).collect();
    let matrix = CellMatrix::new(basis.clone(), basis, values).expect("n² values for n cells");
    let mut dataset = Dataset { name: format!("made {number}"), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::from_cells(matrix));
    dataset
}
