//! Ranking of candidates whose figures have errors: utilities, ranges of ranks, the Pareto front, and the reasons.
//!
//! | file | content |
//! | --- | --- |
//! | `objective` | objectives: scale limits, weights, utilities |
//! | `order` | ranges of ranks |
//! | `front` | the Pareto front |
//! | `why` | a difference in parts that add up to it |
//! | `ranking` | all of it for a list |
//!
//! Utilities are linear between two scale limits that are given: worst and best of the present candidates would make
//! ranks depend on which others are ranked. One is better than another only where the interval of their difference
//! excludes 0: an interval order (Fishburn 1970), in which "within the uncertainty" is not transitive. So there are
//! ranges of ranks, never one rank with decimals.

mod front;
mod objective;
mod order;
mod ranking;
mod why;

pub use front::{Place, front};
pub use objective::{Better, Objective, utility};
pub use order::{Range, ranges, surely_above};
pub use ranking::{Ranked, Ranking};
pub use why::{Profile, Share, Why, difference, mean};
