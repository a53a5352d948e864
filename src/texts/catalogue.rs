//! The list of products: search, facets, gallery, tags.

texts! {
    const CATALOGUE = "Catalogue" | "Katalog";
}
