//! Facets of a search: values that can be chosen next, with the number of products of each.

use super::Figure;

/// Value of a facet with the number of products that have it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Facet {
    /// Value to filter by.
    pub value: String,
    /// Number of products that have the value.
    pub count: usize,
}

/// Values to filter by, most frequent ones at the top. Every count is what choosing the value would find with all other
/// filters unchanged.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Facets {
    /// Kinds; empty text for products without a kind.
    pub kinds: Vec<Facet>,
    /// Makers; products without one are left out.
    pub manufacturers: Vec<Facet>,
    /// Tags.
    pub tags: Vec<Facet>,
    /// Collections.
    pub collections: Vec<Facet>,
    /// Number of products shown most recently, see [`Query::shown`](super::Query::shown).
    pub recent: usize,
    /// Origins of the data: measured, computed, unknown.
    pub origins: Vec<Facet>,
    /// Number of products with several states, and with one state.
    pub moving: [usize; 2],
    /// Number of products per range of [`Figure::LIMITS`], for every figure that any product has.
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
