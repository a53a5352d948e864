//! Who made what: words that programs leave in files where names should be.

use super::Diagnosis;
use crate::compute::btdf::{Dataset, Finding};

/// Names that templates and programs write, in lower case.
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

fn template(word: &str) -> bool {
    let word = word.trim().to_lowercase();
    TEMPLATE.contains(&word.as_str())
        || word.starts_with("test ")
        || word.ends_with(" test")
        || word.starts_with("example ")
}

pub(super) fn check(dataset: &Dataset) -> Vec<Diagnosis> {
    // Closed forms are named by whoever stores them.
    if dataset.format.is_empty() {
        return Vec::new();
    }
    let mut list = Vec::new();
    let told = |code: &str| dataset.findings.iter().any(|finding| finding.code == code);
    for (what, word) in [("name", dataset.name.trim()), ("maker", dataset.manufacturer.trim())] {
        if template(word) {
            list.push(
                Finding::warning(
                    "template-word",
                    format!("The {what} '{word}' is a template's word: tell the product's."),
                )
                .into(),
            );
        } else if word.is_empty() && !told("template-word") {
            list.push(Finding::info("no-identity", format!("The file gives no {what}.")).into());
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

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
