//! Words that the field does not use, or uses for something else: of identifiers, phrases, and openings of documentation.

use crate::{none, scan, sources};
use std::path::Path;
use std::sync::LazyLock;

/// Words of identifiers and of file names, with what to write instead. `a_b`: consecutive words.
const IDENTIFIERS: [(&str, &str); 48] = [
    ("told", "message, note, reported, specified, formatted"),
    ("untold", "unreported, unspecified"),
    ("foretold", "predicted"),
    ("tell", "report, notify, describe"),
    ("tells", "reports, specifies"),
    ("telling", "significant"),
    ("teller", "reply sender"),
    ("said", "note, message"),
    ("thrown", "reflected; projected; illuminance"),
    ("throws", "reflects"),
    ("very", "model, exact"),
    ("doubt", "uncertainty; ambiguity"),
    ("doubts", "uncertainties"),
    ("doubtful", "uncertain"),
    ("doubted", "uncertain"),
    ("specimen", "optical model"),
    ("specimens", "optical models"),
    ("landed", "incident, beam response, hit"),
    ("anew", "again, recomputed, exact"),
    ("mend", "repair"),
    ("mends", "repairs"),
    ("mended", "repaired"),
    ("shining", "emitting, emission"),
    ("worth", "score, weight"),
    ("apart", "distance, difference, separate, distinguishable"),
    ("witness", "evidence"),
    ("witnesses", "evidence"),
    ("shelve", "catalogue command"),
    ("shelved", "loaded, stored"),
    ("shelving", "catalogue command"),
    ("evenly", "uniform"),
    ("wish", "options, request"),
    ("wished", "requested"),
    ("patience", "timeout, delay"),
    ("gist", "excerpt"),
    ("tray", "comparison"),
    ("hand_on", "export"),
    ("handing_on", "export"),
    ("handed_on", "exported"),
    ("take_in", "import"),
    ("take_out", "remove, extract"),
    ("take_away", "remove"),
    ("go_on", "continue, resume"),
    ("goes_on", "continues"),
    ("in_sight", "visible"),
    ("out_of_sight", "hidden"),
    ("put_aside", "keep as draft"),
    ("at_work", "progress"),
];

/// Phrases of comments and literals, with what to write instead. `a|b`: either word; `_`: any word.
const PHRASES: [(&str, &str); 55] = [
    ("hand|hands|handed|handing on", "export"),
    ("hand|hands|handed|handing it|this|them|one on", "export"),
    ("take|takes|taken|took|taking away|out", "remove, extract"),
    ("take|takes|taken|took|taking _ away|out", "remove, extract"),
    ("hang|hangs|hanging on", "depends on"),
    ("tell|tells|told apart", "distinguish; within the uncertainty"),
    ("tell|tells|told _ apart", "distinguish; within the uncertainty"),
    ("at its|their|his word", "used as given"),
    ("out of sight", "hidden"),
    ("in sight", "visible"),
    ("go|goes|going|gone|went on", "continue, resume; extends"),
    ("anew", "again; from scratch"),
    ("foretold|foretell|foretells", "predicted"),
    ("throw|throws|thrown|threw", "reflect"),
    ("straight on|before", "undeviated; perpendicular to"),
    ("mend|mends|mending", "repair"),
    ("data on cells", "patch-averaged data"),
    ("data on its|their cells", "patch-averaged data"),
    ("beams|data as they are", "sharp beams; patch-averaged data"),
    ("fault of the program", "internal error"),
    ("the last|first|worst|best|nearest|newest first", "newest first, best first"),
    ("for good", "permanently"),
    ("stand|stands outside", "obstructions"),
    ("before the façade|facade|window|pane|aperture", "in front of the façade"),
    ("kept out", "blocked"),
    ("sensors|sensor|places|place|points|point|not|is|are in the dark", "dark"),
    ("even light|sky|luminance|exitance|radiance|illumination|outside", "uniform"),
    ("upright|level plane|section|slats|louvres", "vertical, horizontal"),
    ("light is won", "transmittance plus reflectance exceeds 1"),
    ("light that is won", "transmittance plus reflectance exceeds 1"),
    ("ordinary method|one|run", "default"),
    ("usual objectives", "default objectives"),
    ("put into the scene", "added to the scene"),
    ("present scene|room", "current scene"),
    ("tray", "comparison"),
    ("in hand", "active; selected"),
    ("may be passed on", "licence of the data"),
    ("end|ends with status", "exits with status"),
    ("for programs", "as JSON; machine-readable"),
    ("put|puts in order", "ranked, sorted"),
    ("what it|they come|comes to", "results, totals"),
    ("take|takes no part", "is excluded"),
    ("of sqlite", "database errors"),
    ("to be had", "available"),
    ("given from elsewhere", "external"),
    ("gereiht|reihung", "Rangfolge, bewerten"),
    ("ideal gestreut", "ideal diffus streuend (Lambert)"),
    ("geradewegs", "direkt"),
    ("weitergeben|weitergegeben", "exportieren"),
    ("messpunkt|messpunkte|messpunkten|messpunkts", "Berechnungspunkt"),
    ("leibung|leibungen", "Laibung"),
    ("kennzahl|kennzahlen", "Kennwert"),
    ("anker", "Skalengrenzen"),
    ("sonnenbündel|sonnenstrahl|sonnenstrahlen", "direktes Sonnenlicht"),
    ("light is thrown", "reflected"),
];

/// First words of documentation that make it a riddle, a question, or a part of its neighbour's sentence.
const OPENINGS: [&str; 41] = [
    "The same", "What", "How", "Where", "When", "Why", "Which", "Whose", "Who", "That", "Those", "Of", "By", "For",
    "From", "In", "To", "With", "Without", "At", "On", "As", "Its", "It", "They", "Them", "Is", "Are", "Does", "Do",
    "Has", "Have", "May", "Can", "So", "Most", "Least", "And", "Or", "...", "…",
];

/// Value of a key of a file, which never changes. Texts without a space are keys, too.
const KEY: &str = "data on their cells";

/// Words of a name in lower case, split at underscores and capitals.
fn words_of(name: &str) -> Vec<String> {
    let mut words = vec![];
    let mut before = '_';
    for c in name.chars() {
        if c.is_uppercase() && !before.is_uppercase() || before == '_' {
            words.push(String::new());
        }
        if c != '_' {
            words.last_mut().unwrap().extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Sequences of words, each with its alternatives, and what to write instead.
type Forbidden = Vec<(Vec<Vec<&'static str>>, &'static str)>;

/// Returns the sequences of a list, whose keys are split at `between`.
fn forbidden_in(list: &[(&'static str, &'static str)], between: char) -> Forbidden {
    let sequence = |key: &'static str| key.split(between).map(|word| word.split('|').collect()).collect();
    list.iter().map(|(key, instead)| (sequence(key), *instead)).collect()
}

/// Returns what to write instead of the first sequence that a list of words contains.
fn instead_of(words: &[String], forbidden: &Forbidden) -> Option<&'static str> {
    let matches = |(word, any): (&String, &Vec<&str>)| any.contains(&"_") || any.contains(&word.as_str());
    let contains = |wanted: &[Vec<&str>]| words.windows(wanted.len()).any(|some| some.iter().zip(wanted).all(matches));
    forbidden.iter().find(|(wanted, _)| contains(wanted)).map(|(_, instead)| *instead)
}

fn forbidden_name(name: &str) -> Option<String> {
    static NAMES: LazyLock<Forbidden> = LazyLock::new(|| forbidden_in(&IDENTIFIERS, '_'));
    Some(format!("`{name}`: {}", instead_of(&words_of(name), &NAMES)?))
}

fn forbidden_phrase(text: &str) -> Option<String> {
    static TEXTS: LazyLock<Forbidden> = LazyLock::new(|| forbidden_in(&PHRASES, ' '));
    let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<String> = words.map(str::to_lowercase).collect();
    Some(format!("\"{text:.90}\": {}", instead_of(&words, &TEXTS)?))
}

fn forbidden_opening(line: &str) -> bool {
    let begins = |word: &&str| {
        let rest = line.strip_prefix(*word);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '-' || c == '`'))
    };
    OPENINGS.iter().any(begins) || line.ends_with(['?', '…']) || line.ends_with("...")
}

/// Forbidden words of one file, outside of its tests.
fn forbidden(name: &str, source: &str) -> Vec<String> {
    let mut wrong = vec![];
    let stem = Path::new(name).file_stem().unwrap().to_str().unwrap();
    wrong.extend(forbidden_name(stem).map(|how| format!("{name}: {how}")));
    for (at, line) in scan::tests_blanked(source).lines().enumerate() {
        let names = line.split(|c: char| !c.is_alphanumeric() && c != '_');
        wrong.extend(names.filter_map(forbidden_name).map(|how| format!("{name}:{}: {how}", at + 1)));
    }
    for literal in scan::literals(source).iter().filter(|literal| literal.text.contains(' ') && literal.text != KEY) {
        wrong.extend(forbidden_phrase(&literal.text).map(|how| format!("{name}:{}: {how}", literal.line)));
    }
    let (mut comment, mut start, mut is_doc) = (String::new(), 0, false);
    for (at, line) in scan::without_tests(source).lines().chain([""]).enumerate() {
        let line = line.trim();
        if let Some(text) = line.strip_prefix("//") {
            let doc = text.strip_prefix(['/', '!']);
            let text = doc.unwrap_or(text).trim();
            if comment.is_empty() {
                start = at + 1;
            }
            if doc.is_some() && !is_doc && forbidden_opening(text) {
                wrong.push(format!("{name}:{}: documentation opens with \"{text:.60}\"", at + 1));
            }
            is_doc = doc.is_some();
            comment = comment + " " + text;
        } else {
            wrong.extend(forbidden_phrase(&comment).map(|how| format!("{name}:{start}: {how}")));
            comment.clear();
            is_doc = false;
        }
    }
    wrong
}

#[test]
fn names_and_texts_use_the_words_of_the_field() {
    let is_test = |name: &str| name.ends_with("tests.rs") || name.contains("/tests/");
    let all = sources(&["src", "examples", "benches"]);
    none(
        &all.iter()
            .filter(|(name, _)| !is_test(name))
            .flat_map(|(name, text)| forbidden(name, text))
            .collect::<Vec<_>>(),
    );
}

#[test]
fn words_of_another_field_are_found() {
    assert_eq!(words_of("handOn_GO_ONHidden"), ["hand", "on", "go", "onhidden"]);
    assert!(forbidden_name("VerySystem").is_some() && forbidden_name("EVERY").is_none());
    assert!(forbidden_name("hand_on_files").is_some() && forbidden_name("on_hand").is_none());
    let seen = |source: &str| forbidden("src/a.rs", source).len();
    assert_eq!(seen("/// Of the room.\n/// It goes\n/// on. Nothing else.\nfn a() { let told = \"Hand on…\"; }"), 4);
    assert_eq!(seen("/// Ofen, so-called. \nfn a() {}\n#[cfg(test)]\nmod tests { fn told() {} }"), 0);
    assert_eq!(seen("/// Is it?\nfn a() {}\n\n// A tray.\nfn b() { x(\"mended\") }"), 2);
}
