//! Initial state or control rule of a newly selected product.

use crate::app::scene::control;
use crate::app::scene::{Selection, fill, set_rule};
use crate::app::state::Document;
use crate::catalogue::{FirstRule, Product, ProductRow};
use crate::study::control::year::CONTROLLED;

/// Selects a product in a document with the control rule that the product defines, or else in its representative
/// state.
pub(in crate::app) fn choose_first(document: &mut Document, product: &Product) {
    let (rule, place) = product.representative();
    let state = product.states.get(place).filter(|_| product.states.len() > 1);
    choose(document, &product.key, rule, state.map(|state| state.key.as_str()));
}

/// Selects a listed product as [`choose_first`] does.
pub(in crate::app) fn choose_first_listed(document: &mut Document, row: &ProductRow) {
    choose(document, &row.key, row.rule, Some(row.state()).filter(|_| row.moves()));
}

fn choose(document: &mut Document, product: &str, rule: FirstRule, state: Option<&str>) {
    let keys = control::first_keys(rule);
    let state = if keys.is_some() { CONTROLLED } else { state.unwrap_or_default() };
    document.selection = Selection { product: product.to_owned(), state: state.to_owned() };
    set_rule(&mut document.scene, None, keys);
    fill(&mut document.scene, &document.selection);
}
