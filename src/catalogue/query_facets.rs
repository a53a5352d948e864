//! What could be chosen next, with counts.

use super::Figure;

/// One value of a facet with the number of products that have it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Facet {
    /// The value.
    pub value: String,
    /// How many products.
    pub count: usize,
}

/// Values to filter by, most frequent first. Every count is what choosing the value would find with all other filters as
/// they are.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Facets {
    /// Kinds; an empty one for products that tell none.
    pub kinds: Vec<Facet>,
    /// Makers, those without left out.
    pub manufacturers: Vec<Facet>,
    /// Tags.
    pub tags: Vec<Facet>,
    /// Collections.
    pub collections: Vec<Facet>,
    /// Products that were shown last, see [`Query::shown`](super::Query::shown).
    pub recent: usize,
    /// Measured, computed, unknown.
    pub origins: Vec<Facet>,
    /// Products of several states, and of one.
    pub moving: [usize; 2],
    /// For every figure that any product has: products by [`Figure::LIMITS`].
    pub ranges: Vec<(Figure, Vec<usize>)>,
    /// Favourites.
    pub favourites: usize,
    /// Built-in products.
    pub builtin: usize,
    /// The user's products.
    pub own: usize,
    /// All products of the catalogue, whatever is asked.
    pub all: usize,
}
