//! Binary format of indicatrices compressed by wavelets ([`CompactRows`]).
//!
//! The bytes begin with the exponent of the quantisation steps, followed by a table of probabilities for each order of
//! wavelets that is used and the heads of all rows (τ, step, order, length), compressed together with zstd, and by one
//! string of an arithmetic coder per row. A row can be found by its head and decoded alone. Tables belong to the whole
//! dataset, so that short rows need not contain them.

mod model;
pub mod range_coder;

use crate::compute::basis::RingBasis;
use crate::compute::wavelet::{CompactRows, MOST_CELLS, ORDERS, Order, QuantisedRow, RowDecoder};
use model::{CONTEXTS, Counter, Reader, Writer, visit};
use rayon::prelude::*;
use std::io::Read as _;

/// Size of the head of a row: τ, step, order, length of the string. \[bytes\]
const HEAD: usize = 15;

/// Returns compressed indicatrices as bytes.
pub fn write(rows: &CompactRows) -> Vec<u8> {
    let all: Vec<(Order, QuantisedRow)> = (0..rows.len()).map(|row| rows.quantised(row)).collect();
    let mut tables: [Option<Vec<u8>>; 3] = [None, None, None];
    for (order, table) in ORDERS.into_iter().zip(&mut tables) {
        if let Some(transform) = rows.transform(order) {
            let mut counter = Counter::default();
            for (_, row) in all.iter().filter(|(own, row)| *own == order && row.tau > 0.0) {
                visit(transform, &mut row.levels.clone(), &mut counter);
            }
            *table = Some(counter.0.iter().map(|[zeros, ones]| range_coder::Chance::byte_for(*zeros, *ones)).collect());
        }
    }
    let number = |order: Order| ORDERS.iter().position(|own| *own == order).expect("ORDERS holds every order");
    let strings: Vec<Vec<u8>> = all
        .par_iter()
        .map(|(order, row)| match (rows.transform(*order), &tables[number(*order)]) {
            (Some(transform), Some(table)) if row.tau > 0.0 => {
                let mut writer = Writer::new(table);
                visit(transform, &mut row.levels.clone(), &mut writer);
                writer.finish()
            }
            _ => Vec::new(),
        })
        .collect();
    let mut plain = Vec::new();
    tables.iter().flatten().for_each(|table| plain.extend(table));
    let heads: Vec<[u8; HEAD]> = all
        .iter()
        .zip(&strings)
        .map(|((order, row), string)| {
            let mut head = [0; HEAD];
            head[..8].copy_from_slice(&row.tau.to_le_bytes());
            head[8..10].copy_from_slice(&row.step.to_le_bytes());
            head[10] = number(*order) as u8;
            head[11..].copy_from_slice(&(string.len() as u32).to_le_bytes());
            head
        })
        .collect();
    // Byte by byte: equal places of all heads are alike.
    (0..HEAD).for_each(|byte| plain.extend(heads.iter().map(|head| head[byte])));
    let packed = zstd::bulk::compress(&plain, 19).expect("compression into memory does not fail");
    let mut out = vec![rows.exponent(), tables.iter().enumerate().map(|(k, t)| u8::from(t.is_some()) << k).sum()];
    out.extend((packed.len() as u32).to_le_bytes());
    out.extend(packed);
    strings.iter().for_each(|string| out.extend(string));
    out
}

/// Compressed indicatrices in bytes: their heads have been read, rows are decoded one by one.
#[derive(Debug)]
pub struct RowFile<'a> {
    decoder: RowDecoder,
    tables: [Option<Vec<u8>>; 3],
    heads: Vec<Head<'a>>,
}

#[derive(Debug, Clone, Copy)]
struct Head<'a> {
    tau: f64,
    step: i16,
    order: usize,
    string: &'a [u8],
}

impl<'a> RowFile<'a> {
    /// Reads the heads of `count` compressed indicatrices on the emergent cells of `basis`.
    ///
    /// # Errors
    /// Returns an error if the bytes are not those of [`write()`].
    pub fn open(basis: RingBasis, count: usize, bytes: &'a [u8]) -> Result<Self, String> {
        let cut_off = || "compact rows cut off".to_owned();
        let (fixed, rest) = bytes.split_first_chunk::<6>().ok_or_else(cut_off)?;
        let (exponent, mask) = (fixed[0], fixed[1]);
        // Transforms of that size would be prepared before the first byte of a row could be found wrong.
        if basis.len() > MOST_CELLS {
            return Err(format!("compact rows of {} cells (at most {MOST_CELLS})", basis.len()));
        }
        if exponent > 10 || mask > 0b111 {
            return Err("compact rows of a kind that is not known".to_owned());
        }
        let length = u32::from_le_bytes([fixed[2], fixed[3], fixed[4], fixed[5]]) as usize;
        let (packed, mut strings) = rest.split_at_checked(length).ok_or_else(cut_off)?;
        // The size is known beforehand. One byte more is enough to tell that there is too much, and no small file can
        // ask for all memory.
        let size = mask.count_ones() as usize * CONTEXTS + HEAD * count;
        let mut plain = Vec::new();
        zstd::stream::read::Decoder::new(packed)
            .and_then(|decoder| decoder.take(size as u64 + 1).read_to_end(&mut plain))
            .map_err(|error| format!("heads of compact rows cannot be read: {error}"))?;
        if plain.len() != size {
            return Err(format!("heads of compact rows do not have {size} bytes"));
        }
        let mut plain = plain.as_slice();
        // Tables of the orders that the mask names, each behind the one before; what then is left are the heads.
        let tables = [0, 1, 2].map(|k| {
            (mask >> k & 1 == 1).then(|| {
                let (table, rest) = plain.split_at(CONTEXTS);
                plain = rest;
                table.to_vec()
            })
        });
        let mut heads = Vec::with_capacity(count);
        for row in 0..count {
            // Heads are stored byte by byte: all first bytes, all second ones ….
            let byte = |k: usize| plain[k * count + row];
            let order = usize::from(byte(10));
            let length = u32::from_le_bytes([11, 12, 13, 14].map(byte)) as usize;
            // Strings lie end to end: a row begins where the lengths before it say.
            let (string, rest) = strings.split_at_checked(length).ok_or_else(cut_off)?;
            strings = rest;
            let tau = f64::from_le_bytes(std::array::from_fn(byte));
            // Rows without light name an order, too. A range refuses what is not a number as well.
            if tables.get(order).is_none_or(Option::is_none) || !(0.0..1e30).contains(&tau) {
                return Err(format!("compact row {row} has no table, or no transmittance"));
            }
            heads.push(Head { tau, step: i16::from_le_bytes([byte(8), byte(9)]), order, string });
        }
        if !strings.is_empty() {
            return Err(format!("{} bytes behind the last compact row", strings.len()));
        }
        let used = ORDERS.into_iter().zip(&tables).filter(|(_, table)| table.is_some()).map(|(order, _)| order);
        let decoder = RowDecoder::new(basis, exponent, used);
        Ok(Self { decoder, tables, heads })
    }

    /// Returns the quantised wavelet coefficients of one row, and the order of the wavelets.
    ///
    /// # Errors
    /// Returns an error if the row's bytes are not valid.
    pub fn quantised(&self, row: usize) -> Result<(Order, QuantisedRow), String> {
        let head = &self.heads[row];
        let order = ORDERS[head.order];
        let mut levels = vec![0; self.decoder.basis().len()];
        if head.tau > 0.0
            && let (Some(transform), Some(table)) = (self.decoder.transform(order), &self.tables[head.order])
            && !visit(transform, &mut levels, &mut Reader::new(table, head.string))
        {
            return Err(format!("compact row {row} holds a number beyond all bounds"));
        }
        Ok((order, QuantisedRow { tau: head.tau, step: head.step, levels }))
    }

    /// Returns one indicatrix: q of every emergent cell. \[1/sr\]
    ///
    /// # Errors
    /// Returns an error under the conditions of [`Self::quantised`].
    pub fn row(&self, row: usize) -> Result<Vec<f64>, String> {
        let (order, quantised) = self.quantised(row)?;
        let made = self.decoder.row(order, &quantised);
        made.ok_or_else(|| format!("compact row {row} holds numbers that no writer writes"))
    }

    /// Returns all rows, still compressed.
    ///
    /// # Errors
    /// Returns an error under the conditions of [`Self::quantised`].
    pub fn into_rows(self) -> Result<CompactRows, String> {
        let rows = (0..self.heads.len()).map(|row| self.quantised(row)).collect::<Result<Vec<_>, _>>()?;
        CompactRows::from_rows(self.decoder, rows)
            .ok_or_else(|| "a compact row holds numbers that no writer writes".to_owned())
    }
}
