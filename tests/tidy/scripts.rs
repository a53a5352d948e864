//! Scripts that use the window as a person would name its texts as `src/texts` does.

use crate::{files, none, root};

/// What stands before the name of a text: its file and its key.
const BEFORE: [&str; 2] = ["words(\"", "pattern(\""];

#[test]
fn scripts_name_texts_that_exist() {
    let mut named = 0;
    let mut wrong = Vec::new();
    for (script, path) in files(&[".ci/user"]) {
        let text = std::fs::read_to_string(path).unwrap();
        for name in BEFORE.iter().flat_map(|before| text.split(before).skip(1)) {
            let name = name.split('"').next().unwrap_or_default();
            named += 1;
            let known = name.split_once('.').is_some_and(|(file, key)| {
                let texts = std::fs::read_to_string(root().join(format!("src/texts/{file}.rs"))).unwrap_or_default();
                texts.contains(&format!("const {key} =")) || texts.contains(&format!("fn {key}("))
            });
            if !known {
                wrong.push(format!("{script}: {name:?} is no text of src/texts"));
            }
        }
    }
    assert!(named > 5, "no names of texts found in .ci/user");
    none(&wrong);
}
