//! Reading the cases of the reference kit: descriptions, tables, patch matrices.

use crate::common::data;
use crate::goniophotometer_slats::kit::gunzip;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::system::measure::{Measured, Side};
use std::path::PathBuf;

/// The folder of the cases, where it is.
pub fn folder() -> Option<PathBuf> {
    data("reference/cases/goniophotometer")
}

/// Shares of one incident patch: τ front, τ back, ρ front, ρ back, and their uncertainty.
pub struct Expected {
    pub shares: [f64; 4],
    pub uncertainty: f64,
}

/// The rows of a table in the order of Klems patches.
pub fn table(name: &str) -> Vec<Expected> {
    let text = std::fs::read_to_string(folder().unwrap().join(format!("{name}.tau.csv"))).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| head.iter().position(|h| *h == name).unwrap();
    let columns = ["tau_front", "tau_back", "rho_front", "rho_back"].map(column);
    let uncertainty = column("uncertainty");
    let row = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        Expected { shares: columns.map(|c| cells[c]), uncertainty: cells[uncertainty] }
    };
    lines.map(row).collect()
}

/// A block of a packed matrix file, [outgoing][incident] in Klems order; `None` if it has none of that direction.
pub fn block(file: &str, direction: &str) -> Option<Vec<Vec<f64>>> {
    let text = String::from_utf8(gunzip(&std::fs::read(folder()?.join(file)).unwrap())).unwrap();
    let block = text.split("<WavelengthDataBlock>").find(|part| {
        let words: Vec<&str> = direction.split(' ').collect();
        let found = part.split("<WavelengthDataDirection>").nth(1).and_then(|rest| rest.split('<').next());
        found.is_some_and(|found| found.split_whitespace().collect::<Vec<_>>() == words)
    })?;
    let data = block.split("<ScatteringData>").nth(1).unwrap().split('<').next().unwrap();
    let values = data.split([',', ' ', '\n', '\t']).filter(|v| !v.trim().is_empty());
    let values: Vec<f64> = values.map(|v| v.trim().parse().unwrap()).collect();
    assert_eq!(values.len(), 145 * 145, "{file} {direction}");
    Some(values.chunks(145).map(<[f64]>::to_vec).collect())
}

/// Cells that name patches as the kit numbers them: for both sides the lateral direction of travel, seen from the room.
pub fn patch_of_cell(side: Side) -> Vec<usize> {
    let names = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let own = RingBasis::klems_full(match side {
        Side::Front => AzimuthMap::KLEMS_FRONT,
        Side::Back => AzimuthMap::KLEMS_BACK,
    });
    names.cells().map(|cell| own.index(cell.centre()).unwrap()).collect()
}

/// What a comparison found.
#[derive(Debug, Default)]
pub struct Found {
    /// Largest and mean excess of |Δτ|, |Δρ| over the uncertainty.
    pub worst: [f64; 2],
    pub mean: [f64; 2],
    /// Patches: transmitted and reflected, front.
    pub patches: [Option<f64>; 2],
}

pub fn compare(name: &str, measured: &Measured) -> Found {
    let mut found = Found::default();
    let expected = table(name);
    let weights = measured.emergent.projected_solid_angles();
    for side in Side::BOTH {
        let patch = patch_of_cell(side);
        let seen = measured.seen(side);
        for (what, q) in [&seen.transmitted, &seen.reflected].into_iter().enumerate() {
            let column = 2 * what + usize::from(side == Side::Back);
            for (cell, share) in measured.shares(q).into_iter().enumerate() {
                let row = &expected[patch[cell]];
                let excess = ((share - row.shares[column]).abs() - row.uncertainty).max(0.0);
                found.worst[what] = found.worst[what].max(excess);
                found.mean[what] += excess / 290.0;
            }
        }
    }
    for (what, direction) in ["Transmission Front", "Reflection Front"].into_iter().enumerate() {
        let Some(best) = block(&format!("{name}.xml.gz"), direction) else { continue };
        let seen = measured.seen(Side::Front);
        let q = if what == 0 { &seen.transmitted } else { &seen.reflected };
        let (mut apart, mut flux) = (0.0, 0.0);
        for i in 0..145 {
            for o in 0..145 {
                apart += (q[i * 145 + o] - best[o][i]).abs() * weights[i] * weights[o];
                flux += best[o][i] * weights[i] * weights[o];
            }
        }
        found.patches[what] = Some(apart / flux);
    }
    found
}
