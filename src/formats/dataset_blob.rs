//! Compact binary format of a [`Dataset`](crate::compute::btdf::Dataset), in which the catalogue and exchange packages
//! store it.
//!
//! `CFSD`, a version byte, then fields in a fixed order, little-endian; texts and lists carry their length. Values of
//! cell matrices are rounded to f32 (relative 6e-8), split into their four byte planes and compressed with zstd; or
//! they are already compressed by wavelets ([`super::compact_rows`]) and are stored so. Equal datasets have equal
//! bytes, so that the BLAKE3 hash of a blob names its content.

mod read;
mod write;

pub use read::{decode, decode_within};
pub use write::{encode, encode_with_wordless};

/// First bytes of every dataset in the binary format.
pub(crate) const MAGIC: &[u8; 4] = b"CFSD";
/// First version of the binary format, without thermal data.
pub(crate) const FIRST: u8 = 1;
/// Newest version of the binary format, in which thermal data follow the findings; written only if there are any.
pub(crate) const VERSION: u8 = 2;

/// Error in reading a dataset in the binary format.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BlobError {
    /// Bytes that do not begin with `CFSD`.
    #[error("not a binary dataset: it does not begin with CFSD")]
    Magic,
    /// Dataset of a newer version of the format: that version.
    #[error(
        "the binary dataset was written by a newer version of cfs (version {0}; this program reads {FIRST} to {VERSION})"
    )]
    Version(u8),
    /// Bytes that end before the dataset is complete: their number.
    #[error("binary dataset cut off at byte {0}")]
    Truncated(usize),
    /// Superfluous bytes after the last field: their number.
    #[error("{0} bytes behind the end of the binary dataset")]
    Trailing(usize),
    /// Field with an invalid value.
    #[error("binary dataset, byte {at}: {what}")]
    Invalid {
        /// Offset at which reading stopped. \[bytes\]
        at: usize,
        /// Description of the problem.
        what: String,
    },
}

/// Returns the BLAKE3 hash of a dataset in the binary format as 64 hexadecimal digits, which identifies its content.
pub fn content_hash(blob: &[u8]) -> String {
    blake3::hash(blob).to_hex().to_string()
}

/// Returns the total size of `rows` indicatrices under lossless compression (f32, byte planes, zstd), each compressed
/// separately; `row` returns the values of one. \[bytes\]
pub fn lossless_bytes(rows: usize, row: impl Fn(usize) -> Vec<f64>) -> usize {
    let packed = |values: Vec<f64>| zstd::bulk::compress(&split_planes(values.len(), values.into_iter()), 19);
    (0..rows).map(|index| packed(row(index)).map_or(0, |bytes| bytes.len())).sum()
}

/// Converts `count` values to f32 and splits them into byte planes (byte k of all values together), which compress far
/// better than the values one by one.
pub(crate) fn split_planes(count: usize, values: impl Iterator<Item = f64>) -> Vec<u8> {
    let mut planes = vec![0; count * 4];
    for (index, value) in values.take(count).enumerate() {
        for (plane, byte) in (value as f32).to_le_bytes().into_iter().enumerate() {
            planes[plane * count + index] = byte;
        }
    }
    planes
}

/// Joins byte planes to f32 values, four bytes each: the inverse of [`split_planes`].
pub(crate) fn join_planes(planes: &[u8]) -> impl Iterator<Item = f32> + '_ {
    let n = planes.len() / 4;
    (0..n).map(move |i| f32::from_le_bytes([planes[i], planes[n + i], planes[2 * n + i], planes[3 * n + i]]))
}
