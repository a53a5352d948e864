//! Rankings of the window, including those not shown.

use super::choose::{Board, Figures};
use crate::study::rank::Store;
use std::sync::Arc;

/// State of all rankings of the window, except the results shown.
#[derive(Default)]
pub(super) struct Choosing {
    /// Shared results of the running or last ranking, and the number of them that the window has read.
    pub board: Option<(Arc<Board>, u64)>,
    /// Results of earlier rankings for other inputs, to be shown again if their input returns.
    pub kept: Vec<Arc<Figures>>,
    /// Store of the computed annual simulations of products.
    pub store: Arc<Store>,
}
