//! Ranking of systems for a façade: every product of the catalogue, or of a search in it, is computed in a scene's year
//! and ranked by the scene's objectives.
//!
//! | file | what |
//! | --- | --- |
//! | `question` | checks of `[rank]`: the lists to be made, each a scene in a climate with an azimuth |
//! | `candidate` | the scene with a product in it, under its own control |
//! | `parts` | figures that are sums over hours, by season, sun and zone |
//! | `figures` | figures of a product with their errors, coarse and full |
//! | `run` | all products, side by side, with progress and cancelling |
//! | `list` | figures of the products of a list; ranked again whenever weights change |
//! | `known` | stored figures, independent of objectives |
//! | `offered` | figures that objectives can use, and default objectives |
//! | `table` | the table of a ranking |
//! | `shortlist` | a ranked list, with everything that is displayed of it |
//! | `picture` | a ranking as a picture |
//! | `words` | reasons for a rank, in words |
//! | `shard` | a ranking in pieces: which piece computes what, and keys that identify the input |
//!
//! Figures of a product do not depend on weights, scale limits or other products: these only make the ranking, in
//! microseconds ([`List::ranking`]). A product that cannot be computed is excluded with its reason; the others are not
//! affected.

mod candidate;
mod figures;
mod known;
mod list;
mod offered;
mod parts;
mod picture;
mod question;
mod run;
mod shard;
mod shortlist;
mod table;
mod words;

pub use candidate::with_product;
pub use figures::{Found, Outcome, Stage};
pub use known::{Known, Store, list_of};
pub use list::{List, Row};
pub use offered::{Offered, figure_words, offered, usual_objectives};
pub use parts::{Parts, SEASONS, SUN};
pub use question::{Group, groups, objectives};
pub use run::{Answer, Item, lists_of, run};
pub use shard::{Shard, keys, run_key};
pub use shortlist::{Entry, Look, Page, Reason, Shortlist, Sort, Term};
pub use table::{BETWEEN, RESULT, WHERE, begin, csv_text, exact, excluded, header, ranked_table};
pub use words::why;
