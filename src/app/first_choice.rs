//! First display of a product.

use super::control;
use super::scene::{Selection, fill, set_rule};
use super::state::Document;
use crate::catalogue::FirstRule;
use crate::study::control::year::CONTROLLED;

/// Puts a product into a document as it is first shown: with its own control rule, else in the state that is given.
pub(super) fn first_choice(document: &mut Document, product: String, rule: FirstRule, state: Option<&str>) {
    let keys = control::first_keys(rule);
    let state = if keys.is_some() { CONTROLLED } else { state.unwrap_or_default() };
    document.selection = Selection { product, state: state.to_owned() };
    set_rule(&mut document.scene, None, keys);
    fill(&mut document.scene, &document.selection);
}
