//! Rankings that the window has, shown or not.

use super::choose::{Board, Figures};
use crate::study::rank::Store;
use std::sync::Arc;

/// State of the rankings beside the one that is shown.
#[derive(Default)]
pub(super) struct Choosing {
    /// Board of the current or last ranking, and the number of its results that were read.
    pub board: Option<(Arc<Board>, u64)>,
    /// Results for other inputs.
    pub kept: Vec<Arc<Figures>>,
    /// Store of products whose years are computed.
    pub store: Arc<Store>,
}
