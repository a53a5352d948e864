//! Stages of computations, which the layers below name by keys, have a text in both languages.

use crate::scan::literals;
use crate::{none, sources};
use std::collections::BTreeSet;

/// What stands before the key of a stage.
const NAMES: [&str; 3] = ["advance(", "in_blocks(scene,", "STAGE: &str ="];

#[test]
fn stages_have_texts_and_texts_a_stage() {
    let texts = cfs::texts::pairs().filter(|(file, ..)| *file == "stages");
    let known: BTreeSet<&str> = texts.map(|(_, key, _)| key).collect();
    let (mut wrong, mut named) = (Vec::new(), BTreeSet::new());
    for (file, text) in sources(&["src"]).into_iter().filter(|(file, _)| !file.starts_with("src/texts/")) {
        for literal in literals(&text) {
            let before = literal.before.trim_end();
            if NAMES.iter().any(|name| before.ends_with(name)) && !known.contains(&*literal.text) {
                wrong.push(format!("{file}:{}: {:?} has no text in src/texts/stages.rs", literal.line, literal.text));
            }
            named.insert(literal.text);
        }
    }
    let unnamed = known.iter().filter(|key| !named.contains(**key));
    wrong.extend(unnamed.map(|key| format!("src/texts/stages.rs: no computation has the stage {key:?}")));
    none(&wrong);
}
