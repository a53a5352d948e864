//! Which system for this façade: every product of the catalogue, or of a search in it, in a scene's year, put in order by the
//! scene's objectives.
//!
//! | file | what |
//! | --- | --- |
//! | `question` | `[rank]` judged: the lists to be made, each a scene in a climate with an azimuth |
//! | `candidate` | the scene with a product in it, under its own control |
//! | `parts` | figures that are sums over hours, by season, sun and zone |
//! | `figures` | figures of a product with their errors, coarse and full |
//! | `run` | all products, side by side, with progress and cancelling |
//! | `list` | figures of the products of a list; ranked again whenever weights change |
//! | `known` | figures that are kept, whatever is an objective |
//! | `offered` | figures that objectives are offered of, and usual objectives |
//! | `table` | the table of a ranking |
//! | `shortlist` | a list put in order, with all that is shown of it |
//! | `picture` | a ranking as a picture |
//! | `words` | why, in words |
//! | `shard` | a ranking in pieces: which piece computes what, and keys that say from what it was made |
//!
//! Figures of a product do not depend on weights, anchors or other products: these make the ranking, in microseconds
//! ([`List::ranking`]). A product that cannot be computed is left out with its reason and fails nothing.

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
