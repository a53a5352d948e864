//! Rankings that the window has, shown or not.

use super::choose::{Board, Figures};
use crate::study::rank::Store;
use std::sync::Arc;

/// What the window knows of rankings beside the one that is shown.
#[derive(Default)]
pub(super) struct Choosing {
    /// The one that is under way, or was last, and what of it was seen.
    pub board: Option<(Arc<Board>, u64)>,
    /// Those of other questions.
    pub kept: Vec<Arc<Figures>>,
    /// Products whose years are known.
    pub store: Arc<Store>,
}
