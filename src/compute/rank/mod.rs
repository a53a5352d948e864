//! Which of many is best, as far as figures with errors tell: utilities, ranges of ranks, the Pareto front, and why.
//!
//! | file | what |
//! | --- | --- |
//! | `objective` | what counts: anchors, weights, utilities |
//! | `order` | ranges of ranks |
//! | `front` | the Pareto front |
//! | `why` | a difference in parts that add up to it |
//! | `ranking` | all of it for a list |
//!
//! Utilities are linear between two anchors that are given: worst and best of what happens to be there would make ranks
//! depend on who else is in. One is better than another only where the interval of their difference excludes 0: an interval
//! order (Fishburn 1970), in which "cannot be told apart" is not transitive. So there are ranges of ranks, never one rank with
//! decimals.

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
