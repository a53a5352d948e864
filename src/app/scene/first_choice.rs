//! Initial state or control rule of a newly selected product.

use crate::app::scene::control;
use crate::app::scene::{Selection, fill, set_rule};
use crate::app::state::Document;
use crate::catalogue::FirstRule;
use crate::study::control::year::CONTROLLED;

/// Selects a product in a document with the control rule that the product defines, or else in the given state.
pub(in crate::app) fn first_choice(document: &mut Document, product: String, rule: FirstRule, state: Option<&str>) {
    let keys = control::first_keys(rule);
    let state = if keys.is_some() { CONTROLLED } else { state.unwrap_or_default() };
    document.selection = Selection { product, state: state.to_owned() };
    set_rule(&mut document.scene, None, keys);
    fill(&mut document.scene, &document.selection);
}
