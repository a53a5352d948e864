//! Checks of a dataset's identity: placeholders where names should be, and a thickness that no product has.

use super::Diagnosis;
use crate::compute::btdf::{Dataset, Finding};

/// Placeholders, in lower case, that templates and programs write in the place of names.
const TEMPLATE: [&str; 16] = [
    "name",
    "manufacturer",
    "unknown",
    "unnamed",
    "untitled",
    "none",
    "n/a",
    "test",
    "sample",
    "example",
    "product",
    "material",
    "perfect diffuser",
    "genbsdf",
    "new layer",
    "default",
];

/// Thickness above which a dataset cannot be a façade system. \[m\] Chosen: above the deepest louvres and light
/// shelves, and so low that a sheet of half a millimetre is found whose thickness was written in metres.
const MAX_THICKNESS: f64 = 0.5;

fn template(word: &str) -> bool {
    let word = word.trim().to_lowercase();
    TEMPLATE.contains(&word.as_str())
        || word.starts_with("test ")
        || word.ends_with(" test")
        || word.starts_with("example ")
}

/// Returns findings about placeholders for product and maker, and about an impossible thickness.
pub(super) fn check(dataset: &Dataset) -> Vec<Diagnosis> {
    // Datasets given by a formula come from no file (empty format); they get their name when they are stored.
    if dataset.format.is_empty() {
        return Vec::new();
    }
    let mut list = Vec::new();
    let is_reported = |code: &str| dataset.findings.iter().any(|finding| finding.code == code);
    for (what, word) in [("name", dataset.name.trim()), ("maker", dataset.manufacturer.trim())] {
        if template(word) {
            list.push(
                Finding::warning(
                    "template-word",
                    format!("The {what} '{word}' is the placeholder of a template, not that of the product."),
                )
                .into(),
            );
        } else if word.is_empty() && !is_reported("template-word") {
            list.push(Finding::info("no-identity", format!("The file gives no {what}.")).into());
        }
    }
    if let Some(thickness) = dataset.thickness.filter(|thickness| *thickness >= MAX_THICKNESS) {
        let message = format!(
            "The file states a thickness of {thickness} m; expected less than {MAX_THICKNESS} m. Millimetres may have been \
             written as metres."
        );
        list.push(Finding::warning("thickness-implausible", message).into());
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thickness_in_millimetres_is_told() {
        let thick = |thickness| {
            let dataset = Dataset { format: "x".into(), thickness, ..Dataset::default() };
            check(&dataset).iter().any(|one| one.finding.code == "thickness-implausible")
        };
        assert!(thick(Some(6.0)) && thick(Some(0.5)));
        assert!(!thick(Some(0.2029)) && !thick(Some(0.0)) && !thick(None));
    }

    #[test]
    fn template_words_are_told_from_names() {
        for word in ["Perfect Diffuser", " unknown", "TEST", "test 3", "genBSDF"] {
            assert!(template(word), "{word}");
        }
        for word in ["Attestor", "Unknown Pleasures 80", "Testa AG", "Samplex"] {
            assert!(!template(word), "{word}");
        }
    }
}
