//! The catalogue of products.
