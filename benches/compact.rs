//! Run time of the compact form: one incident direction read from bytes or from memory, and compression of a dataset.
//!
//! `cargo bench --bench compact`. Before the times, sizes and errors of the datasets are printed.

#[path = "../tests/compute/compact/analytic.rs"]
mod analytic;

use cfs::compute::wavelet::Criterion;
use cfs::formats::compact_rows::{RowFile, write};
use cfs::study::compact::StandardRoom;
use divan::Bencher;

fn main() {
    for (name, step) in [("redirect", 1.0), ("redirect", 2.0), ("slats", 1.0), ("diffuser", 1.0)] {
        let data = analytic::system(name, step, 0.0);
        let made = data.compacted(Criterion::ARCHIVE).expect("closed forms are not negative");
        let rows = made.compact_rows().expect("it was just made");
        let room = StandardRoom::new(data.emergent());
        let effect = room.effect(String::new(), &data.row(60), &made.row(60));
        println!(
            "{name} {step}°: {} × {} values, {:.1} kB, {:.1} values a number, illuminance off by {:.3} %",
            rows.len(),
            data.emergent().len(),
            write(rows).len() as f64 / 1000.0,
            (rows.len() * data.emergent().len()) as f64 / rows.numbers() as f64,
            100.0 * effect.illuminance
        );
    }
    divan::main();
}

#[divan::bench(args = [1.0, 2.0])]
fn one_incidence_from_bytes(bencher: Bencher<'_, '_>, step: f64) {
    let data = analytic::system("redirect", step, 0.0).compacted(Criterion::ARCHIVE).expect("not negative");
    let bytes = write(data.compact_rows().expect("it was just made"));
    let file = RowFile::open(data.emergent().clone(), 145, &bytes).expect("just written");
    let mut row = 0;
    bencher.bench_local(|| {
        row = (row + 37) % 145;
        file.row(row)
    });
}

#[divan::bench(args = [1.0, 2.0])]
fn one_incidence_from_memory(bencher: Bencher<'_, '_>, step: f64) {
    let data = analytic::system("redirect", step, 0.0).compacted(Criterion::ARCHIVE).expect("not negative");
    let mut row = 0;
    bencher.bench_local(|| {
        row = (row + 37) % 145;
        data.row(row).len()
    });
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn a_dataset_of_two_degrees_compressed(bencher: Bencher<'_, '_>) {
    let data = analytic::system("redirect", 2.0, 0.0);
    bencher.bench_local(|| data.compacted(Criterion::ARCHIVE));
}
