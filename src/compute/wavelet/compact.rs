//! Wavelet compression of many indicatrices on the same emergent cells: each is stored as few numbers and restored on
//! request.

use super::hierarchy::Hierarchy;
use super::quantise::{Criterion, QuantisedRow, quantise, step_factors};
use super::transform::{Order, Transform};
use crate::compute::basis::RingBasis;
use rayon::prelude::*;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Maximum number of cells of a compressed indicatrix, about 0.4° wide, because the preparation of the transforms takes
/// time and memory. Chosen: limit of input; more cells are refused.
pub const MOST_CELLS: usize = 1 << 17;

/// Error of indicatrices that cannot be compressed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CompactError {
    /// More cells than [`MOST_CELLS`].
    #[error("indicatrices of {0} cells (allowed: {MOST_CELLS})")]
    Cells(usize),
    /// Threshold of the error outside the allowed range.
    #[error("a threshold of {0} (allowed: 1e-6 to below 1)")]
    Threshold(f64),
    /// Luminance coefficient that is negative or not finite.
    #[error("indicatrix {row} holds the value {value}; only finite values from 0 up have a compact form")]
    Value {
        /// Index of the indicatrix.
        row: usize,
        /// Rejected luminance coefficient. \[1/sr\]
        value: f64,
    },
}

/// Wavelet transform with the factors of its quantisation steps.
#[derive(Debug)]
struct Prepared {
    transform: Transform,
    factors: Vec<f64>,
}

/// Compressed indicatrix: its coefficients as a list of (gap, level) in variable-length numbers.
#[derive(Debug, Clone, PartialEq)]
struct Packed {
    order: Order,
    tau: f64,
    step: i16,
    count: u32,
    list: Box<[u8]>,
}

/// Wavelet transforms and weights that restore compressed indicatrices; shared by all indicatrices on the same cells.
#[derive(Debug, Clone)]
pub struct RowDecoder {
    basis: RingBasis,
    weights: Arc<[f64]>,
    /// Exponent β of the dependence of quantisation steps on the support of a wavelet, in tenths.
    exponent: u8,
    prepared: [Option<Arc<Prepared>>; 3],
}

impl RowDecoder {
    /// Creates a decoder for indicatrices on the cells of `basis` with wavelets of the given orders. `exponent`:
    /// exponent β of the quantisation steps, in tenths.
    pub fn new(basis: RingBasis, exponent: u8, orders: impl IntoIterator<Item = Order>) -> Self {
        let mut all = [None, None, None];
        for order in orders {
            all[order as usize] = Some(prepared(&basis, order, exponent));
        }
        Self { weights: basis.projected_solid_angles().into(), basis, exponent, prepared: all }
    }

    /// Returns the basis of the emergent cells of the indicatrices.
    pub const fn basis(&self) -> &RingBasis {
        &self.basis
    }

    /// Returns the wavelet transform of an order; `None` if the decoder was created without it.
    pub fn transform(&self, order: Order) -> Option<&Transform> {
        self.prepared[order as usize].as_ref().map(|prepared| &prepared.transform)
    }

    /// Returns the luminance coefficients of an indicatrix, restored from its quantised wavelet coefficients. \[1/sr\]
    /// `None` if these do not belong to the cells and orders of the decoder, or are outside the range of valid files.
    pub fn row(&self, order: Order, row: &QuantisedRow) -> Option<Vec<f64>> {
        self.fits(order, row).then(|| self.restore(order, row).0)
    }

    fn fits(&self, order: Order, row: &QuantisedRow) -> bool {
        row.levels.len() == self.basis.len()
            && row.levels.first() == Some(&0)
            && (0.0..1e30).contains(&row.tau)
            && row.step.unsigned_abs() <= 3200
            && row.levels.iter().all(|level| level.unsigned_abs() <= 1 << 24)
            && self.prepared[order as usize].is_some()
    }

    fn restore(&self, order: Order, row: &QuantisedRow) -> (Vec<f64>, f64) {
        let prepared = self.prepared[order as usize].as_ref().expect("the transforms of all rows are there");
        row.restore(&prepared.transform, &prepared.factors, &self.weights)
    }
}

/// Indicatrices on the same emergent cells, compressed by wavelets, with exact τ.
pub struct CompactRows {
    decoder: RowDecoder,
    rows: Vec<Packed>,
    /// Indicatrix that was restored last, because pictures and point queries request the same one repeatedly.
    last: Mutex<Option<(usize, Arc<[f64]>)>>,
}

/// Orders of wavelets in the sequence of their numbers in files, which never changes.
pub const ORDERS: [Order; 3] = [Order::Constant, Order::Linear, Order::Quadratic];

impl CompactRows {
    /// Compresses `count` indicatrices. `row`: returns the luminance coefficients of an indicatrix by index, one per
    /// cell of `basis` \[1/sr\]; `criterion`: allowed error. For each indicatrix the wavelet order with the smallest
    /// estimated size is used.
    ///
    /// # Errors
    /// Returns an error if a value is below 0 or not finite, if the threshold is out of range, or if there are more
    /// than [`MOST_CELLS`] cells.
    pub fn compress(
        basis: &RingBasis,
        count: usize,
        row: impl Fn(usize) -> Vec<f64> + Sync,
        criterion: Criterion,
    ) -> Result<Self, CompactError> {
        if !criterion.is_valid() {
            return Err(CompactError::Threshold(criterion.threshold()));
        }
        if basis.len() > MOST_CELLS {
            return Err(CompactError::Cells(basis.len()));
        }
        // Measured: 0.3 gives the fewest bytes for misplaced flux, 0 for square norms (see the module's head).
        let exponent = if matches!(criterion, Criterion::Misplaced(_)) { 3 } else { 0 };
        let mut decoder = RowDecoder::new(basis.clone(), exponent, ORDERS);
        let rows = (0..count)
            .into_par_iter()
            .map(|index| {
                let given = row(index);
                if let Some(&value) = given.iter().find(|value| !(**value >= 0.0 && value.is_finite())) {
                    return Err(CompactError::Value { row: index, value });
                }
                let tried = ORDERS.iter().zip(decoder.prepared.iter().flatten()).map(|(&order, p)| {
                    let row = quantise(&p.transform, &p.factors, &decoder.weights, &given, criterion);
                    (cost(&row), order, row)
                });
                let best = tried.reduce(|best, next| if next.0 < best.0 { next } else { best });
                let (_, order, row) = best.expect("there are three orders");
                Ok(pack(order, &row))
            })
            .collect::<Result<Vec<_>, _>>()?;
        for order in ORDERS {
            if rows.iter().all(|row| row.order != order) {
                decoder.prepared[order as usize] = None;
            }
        }
        Ok(Self { decoder, rows, last: Mutex::new(None) })
    }

    /// Creates compressed indicatrices from the order and the quantised coefficients of each, as read from a file.
    /// `None` if one of them does not fit the decoder, or contains numbers outside the range of valid files.
    pub fn from_rows(decoder: RowDecoder, rows: Vec<(Order, QuantisedRow)>) -> Option<Self> {
        let fits = rows.iter().all(|(order, row)| decoder.fits(*order, row));
        let packed = || rows.iter().map(|(order, row)| pack(*order, row)).collect();
        fits.then(|| Self { rows: packed(), decoder, last: Mutex::new(None) })
    }

    /// Returns the basis of the emergent cells of the indicatrices.
    pub fn basis(&self) -> &RingBasis {
        &self.decoder.basis
    }

    /// Returns the number of indicatrices.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no indicatrices.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Returns the exponent β of the dependence of quantisation steps on the support of a wavelet, in tenths.
    pub const fn exponent(&self) -> u8 {
        self.decoder.exponent
    }

    /// Returns τ = ∫q cosθ dω of the indicatrix with index `row`, exactly as before compression.
    pub fn tau(&self, row: usize) -> f64 {
        self.rows[row].tau
    }

    /// Returns the wavelet order and the quantised coefficients of the indicatrix with index `row`.
    pub fn quantised(&self, row: usize) -> (Order, QuantisedRow) {
        let packed = &self.rows[row];
        (packed.order, unpack(packed, self.decoder.basis.len()))
    }

    /// Returns the wavelet transform of an order; `None` if no indicatrix uses it.
    pub fn transform(&self, order: Order) -> Option<&Transform> {
        self.decoder.transform(order)
    }

    /// Returns the luminance coefficients of the indicatrix with index `row`, restored: not negative, with its τ to
    /// rounding. \[1/sr\]
    pub fn row(&self, row: usize) -> Vec<f64> {
        self.restored(row).0
    }

    /// Returns the luminance coefficients of the indicatrix with index `row`, restored \[1/sr\], and the share of its
    /// cells that would be negative without clamping to 0.
    pub fn restored(&self, row: usize) -> (Vec<f64>, f64) {
        let (order, quantised) = self.quantised(row);
        self.decoder.restore(order, &quantised)
    }

    /// Returns the luminance coefficient of one cell of the indicatrix with index `row`. \[1/sr\] The indicatrix is
    /// restored once and cached until another is requested.
    pub fn value(&self, row: usize, cell: usize) -> f64 {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some((known, values)) if *known == row => values[cell],
            _ => {
                let values: Arc<[f64]> = self.row(row).into();
                let value = values[cell];
                *last = Some((row, values));
                value
            }
        }
    }

    /// Returns the total number of stored numbers: wavelet coefficients that are not 0, and one τ per indicatrix.
    pub fn numbers(&self) -> usize {
        self.rows.iter().map(|row| row.count as usize).sum()
    }

    /// Returns the memory of the compressed indicatrices in bytes, without the transforms, which all data on these
    /// cells share.
    pub fn bytes_in_use(&self) -> usize {
        self.rows.iter().map(|row| size_of::<Packed>() + row.list.len()).sum()
    }
}

impl Clone for CompactRows {
    fn clone(&self) -> Self {
        Self { decoder: self.decoder.clone(), rows: self.rows.clone(), last: Mutex::new(None) }
    }
}

impl PartialEq for CompactRows {
    fn eq(&self, other: &Self) -> bool {
        self.basis() == other.basis() && self.exponent() == other.exponent() && self.rows == other.rows
    }
}

impl fmt::Debug for CompactRows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CompactRows({} on {} cells, {} numbers)", self.len(), self.basis().len(), self.numbers())
    }
}

/// Returns an estimate of the size of a quantised row in bits, by the entropy of its zeros and the magnitudes of the
/// other levels, for comparisons between orders.
fn cost(row: &QuantisedRow) -> f64 {
    let n = row.levels.len() as f64;
    let kept = row.levels.iter().filter(|level| **level != 0);
    let bits: f64 = kept.clone().map(|level| 1.7 + 1.5 * f64::from(level.unsigned_abs()).log2()).sum();
    let p = kept.count() as f64 / n;
    let places = if p > 0.0 && p < 1.0 { -n * (p * p.log2() + (1.0 - p) * (1.0 - p).log2()) } else { 0.0 };
    bits + places
}

/// Packs a row: gaps between coefficients other than 0 and zigzag-coded levels, as numbers of 7 bits per byte.
fn pack(order: Order, row: &QuantisedRow) -> Packed {
    let mut list = Vec::new();
    let mut number = |mut n: u32| {
        while n >= 128 {
            list.push(n as u8 | 128);
            n >>= 7;
        }
        list.push(n as u8);
    };
    let mut next = 0;
    for (at, &level) in row.levels.iter().enumerate().filter(|(_, level)| **level != 0) {
        number((at - next) as u32);
        number(((level << 1) ^ (level >> 31)) as u32);
        next = at + 1;
    }
    Packed { order, tau: row.tau, step: row.step, count: row.count() as u32, list: list.into() }
}

/// Unpacks a row on a basis with this number of cells.
fn unpack(packed: &Packed, cells: usize) -> QuantisedRow {
    let mut levels = vec![0; cells];
    let mut bytes = packed.list.iter();
    let mut number = || {
        let (mut n, mut shift) = (0_u32, 0);
        for byte in bytes.by_ref() {
            n |= u32::from(byte & 127) << shift;
            shift += 7;
            if *byte < 128 {
                return Some(n);
            }
        }
        None
    };
    let mut at = 0;
    while let (Some(gap), Some(folded)) = (number(), number()) {
        at += gap as usize;
        levels[at] = (folded >> 1) as i32 ^ -((folded & 1) as i32);
        at += 1;
    }
    QuantisedRow { tau: packed.tau, step: packed.step, levels }
}

/// Number of cached transforms for the bases that were used last, three orders of three bases; building one takes a
/// third of a second for 20 000 cells. Chosen: cost only, no effect on results.
const REMEMBERED: usize = 9;

/// Returns the transform of a basis with its step factors, from the cache if it is there. `exponent`: exponent β of the
/// quantisation steps, in tenths.
fn prepared(basis: &RingBasis, order: Order, exponent: u8) -> Arc<Prepared> {
    type Known = Mutex<Vec<((RingBasis, Order, u8), Arc<Prepared>)>>;
    static KNOWN: Known = Mutex::new(Vec::new());
    let key = (basis.clone(), order, exponent);
    {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = known.iter().position(|(own, _)| *own == key) {
            let entry = known.remove(at);
            let found = Arc::clone(&entry.1);
            known.push(entry);
            return found;
        }
    }
    // Built without holding the lock: several may be needed at once, and building one twice only costs time.
    let most = 2 * order.functions();
    let transform = Transform::new(&Hierarchy::of_rings(basis, most), order);
    let factors = step_factors(&transform, f64::from(exponent) / 10.0);
    let made = Arc::new(Prepared { transform, factors });
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if known.len() >= REMEMBERED {
        known.remove(0);
    }
    known.push((key, Arc::clone(&made)));
    made
}
