//! Compression of indicatrices by spherical wavelets, with exact τ (IEA SHC Task 31 report, §3.1, eq 14–15 and Figure
//! 11).
//!
//! ```text
//!  cells ─ Hierarchy ─ Transform ─► coefficients ─ QuantisedRow ─► CompactRows ─► formats::compact_rows (bytes)
//! ```
//!
//! # Choices and reasons
//!
//! The report resamples indicatrices to a triangle quadtree and uses the Haar wavelets of Schröder and Sweldens (1995).
//! Here the wavelets are defined on the cells of the data, halved down from the hemisphere, and are orthonormal under
//! the cells' projected solid angles: nothing is resampled, the values are restored exactly if no coefficient is
//! dropped, Σ w q² = Σ c², and one coefficient is τ. Besides Haar wavelets (of constants) there are wavelets that
//! vanish on functions linear or quadratic in the direction ([`Order`]); for each indicatrix the order with the
//! smallest size is used.
//!
//! Compression ratio (values per stored number) at 1 % rms error, cells of 1°, by thresholds alone (with quantisation
//! in brackets):
//!
//! | | triangles, Haar | triangles, linear | rings, Haar | rings, linear | rings, quadratic |
//! | --- | --- | --- | --- | --- | --- |
//! | light-redirecting glass | 14.4 (12.2) | 30.7 (27.0) | 12.6 (10.9) | **32.6 (27.5)** | 33.4 (28.6) |
//! | the same, 2 % noise | 8.8 (6.8) | 20.7 (17.1) | 7.6 (6.2) | **21.8 (18.3)** | 21.2 (18.0) |
//! | diffusing glass | 7.5 (6.1) | 278 (234) | 5.8 (4.7) | 248 (210) | **1146 (1031)** |
//! | the same, 2 % noise | 3.8 (3.1) | 6.4 (5.3) | 3.4 (2.9) | 6.3 (5.2) | **6.8 (5.6)** |
//! | a lobe of 2° | 109 (86) | 59 (46) | **138 (111)** | 98 (74) | 69 (56) |
//!
//! The tree therefore matters little and the order much: Haar is worst for smooth indicatrices and best for single
//! peaks.
//!
//! Quantisation steps may depend on the support W of a wavelet by (W/W_all)^−β. For a square norm β = 0 is best; for
//! misplaced flux, which tolerates large errors on small areas, β = 0.3 saves up to a tenth of the bytes.
//!
//! Noise should not be stored: 2 % of it on a diffuser costs 50 kB with 0.5 % misplaced flux and 1 kB with 1.5 %. A
//! threshold below the noise of a measurement only preserves the noise.

mod compact;
mod hierarchy;
mod quantise;
mod report;
mod transform;

pub use compact::{CompactError, CompactRows, MOST_CELLS, ORDERS, RowDecoder};
pub use hierarchy::{CellPoint, Group, Hierarchy};
pub use quantise::{Criterion, QuantisedRow};
pub use report::CompactReport;
pub use transform::{Block, Order, Transform};
