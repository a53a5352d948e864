//! Facets of a search: values by which it can be narrowed, with the number of products of each.

use super::Figure;

/// Value of a filter, such as a kind or a maker, with the number of products that have it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Facet {
    /// Value by which products can be filtered.
    pub value: String,
    /// Number of products that have the value.
    pub count: usize,
}

/// Values by which a search can be narrowed, the most frequent at the top. Each count is the number of products that
/// would be found if this value were chosen and all other filters unchanged.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Facets {
    /// Kinds of product; empty text for products without a kind.
    pub kinds: Vec<Facet>,
    /// Makers; products without one are left out.
    pub manufacturers: Vec<Facet>,
    /// Tags of products.
    pub tags: Vec<Facet>,
    /// Collections of the user.
    pub collections: Vec<Facet>,
    /// Number of found products that the user viewed recently, see [`Query::shown`](super::Query::shown).
    pub recent: usize,
    /// Origins of the data, as keys: measured, computed, unknown.
    pub origins: Vec<Facet>,
    /// Number of products with several states, and with one state.
    pub moving: [usize; 2],
    /// Number of products in each of the ranges that begin at [`Figure::LIMITS`], for every figure that any product
    /// has.
    pub ranges: Vec<(Figure, Vec<usize>)>,
    /// Number of favourites.
    pub favourites: usize,
    /// Number of built-in products.
    pub builtin: usize,
    /// Number of the user's products.
    pub own: usize,
    /// Number of all products of the catalogue, whatever the query.
    pub all: usize,
}
