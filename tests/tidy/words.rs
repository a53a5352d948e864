//! What people read stands in `src/texts`, in both languages, and nowhere else.

use crate::scan::{Literal, literals};

/// What stands before literals that nobody reads in the window: names for egui, invariants, attributes.
const UNREAD: [&str; 15] = [
    "Id::new(",
    "Id::unique(",
    "id_salt(",
    "push_id(",
    ".with(",
    "Grid::new(",
    "Window::new(",
    "persistent_id(",
    "expect(",
    "panic!(",
    "unreachable!(",
    "assert!(",
    "reason = ",
    "doc = ",
    "Tile { title: ",
];

/// Is it said in words, apart from what is filled in? Names of kinds, keys and units are not.
fn is_said(text: &str) -> bool {
    let mut plain = String::new();
    let mut depth = 0_usize;
    for c in text.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            c if depth == 0 => plain.push(c),
            _ => {}
        }
    }
    let long = |word: &&str| word.chars().filter(|c| c.is_alphabetic()).count() > 2;
    let words: Vec<&str> = plain.split(|c: char| !c.is_alphabetic()).filter(long).collect();
    let capital = |word: &str| {
        let mut letters = word.chars();
        letters.next().is_some_and(char::is_uppercase) && letters.all(char::is_lowercase)
    };
    words.len() > 1 && plain.contains(' ') || words.iter().any(|word| capital(word))
}

/// Literals of a file that people read.
pub fn said(source: &str) -> Vec<Literal> {
    let unread = |before: &str| {
        let before = before.trim_end();
        UNREAD.iter().any(|start| before.ends_with(start.trim_end()))
    };
    literals(source).into_iter().filter(|literal| is_said(&literal.text) && !unread(&literal.before)).collect()
}

#[test]
fn words_are_told_from_names() {
    let source = r##"
        // "Not this comment"
        ui.label("Add to compare");
        ui.label(format!("{count} files of {total} were read"));
        Grid::new("Some grid"); Id::new("Another");
        ui.label(r#"Raw"#); unit("cd/m²"); key("slat_angle"); file.expect("a file is there"); let c = 'x';
        #[cfg(test)]
        mod tests { fn one() { say("Only in tests"); } }
        fn two() { say("Last one") }
    "##;
    let told: Vec<(usize, String)> = said(source).into_iter().map(|one| (one.line, one.text)).collect();
    let expected = [(3, "Add to compare"), (4, "{count} files of {total} were read"), (6, "Raw"), (9, "Last one")];
    assert_eq!(told, expected.map(|(line, text)| (line, text.to_owned())));
}
