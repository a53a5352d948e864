//! Findings about datasets have a title and a meaning in both languages.

use crate::scan::literals;
use crate::{none, sources};
use std::collections::BTreeSet;

/// Readers, writers and checks of datasets.
const PLACES: [&str; 9] = [
    "src/catalogue/",
    "src/compute/btdf/",
    "src/compute/doctor/",
    "src/formats/beams.rs",
    "src/formats/bsdf_xml/",
    "src/formats/btdf_text/",
    "src/formats/encoding.rs",
    "src/study/by_description.rs",
    "src/study/compact.rs",
];

/// What stands before the code of a finding.
const REPORTS: [&str; 5] =
    ["Finding::info(", "Finding::warning(", "Finding::error(", "suspicion(confidence,", "report("];

#[test]
fn findings_about_datasets_have_words_and_words_a_finding() {
    let known: BTreeSet<&str> = cfs::texts::findings::WORDS.iter().map(|(code, _)| *code).collect();
    assert_eq!(known.len(), cfs::texts::findings::WORDS.len(), "a code twice");
    let mut wrong = vec![];
    let mut named = BTreeSet::new();
    for (name, text) in sources(&["src"]).iter().filter(|(name, _)| PLACES.iter().any(|place| name.starts_with(place)))
    {
        for literal in literals(text) {
            let before = literal.before.trim_end();
            if REPORTS.iter().any(|report| before.ends_with(report)) && !known.contains(&*literal.text) {
                wrong
                    .push(format!("{name}:{}: {:?} has no words in src/texts/findings.rs", literal.line, literal.text));
            }
            named.insert(literal.text);
        }
    }
    wrong.extend(
        known.iter().filter(|code| !named.contains(**code)).map(|code| format!("{code:?} is reported nowhere")),
    );
    none(&wrong);
}
