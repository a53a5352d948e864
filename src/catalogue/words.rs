//! Words as the search compares them: without case and diacritics, German words for what products say in English, and
//! the number of typing errors between a typed word and a word of the catalogue.

/// Maximum length of a word that is compared, in characters.
pub(super) const LONGEST: usize = 64;

/// German words for kinds and tags, so that a search for "Raffstore" finds exterior venetian blinds: a product with the
/// kind or tag on the left is also found by the words on the right, which are written without diacritics.
const GERMAN: &[(&str, &str)] = &[
    ("venetian", "jalousie jalousien lamelle lamellen lamellenjalousie lamellenstore"),
    ("exterior venetian blind", "raffstore raffstoren aussenjalousie aussenraffstore"),
    ("interior venetian blind", "innenjalousie"),
    ("mirror venetian blind", "spiegellamelle spiegellamellen lichtlenkjalousie"),
    ("vertical blind", "vertikallamelle vertikallamellen vertikaljalousie"),
    ("glazing with blind", "jalousie lamellen verglasung isolierglas"),
    ("glazing with screen", "screen rollo verglasung isolierglas"),
    ("louvres", "grosslamelle grosslamellen sonnenschutzlamelle sonnenschutzlamellen"),
    ("vertical louvres", "grosslamelle grosslamellen vertikallamelle vertikallamellen"),
    ("micro-louvre screen", "mikrolamelle mikrolamellen"),
    ("roller blind", "rollo rollos springrollo"),
    ("woven", "gewebe stoff textil screen rollo"),
    ("fabric", "gewebe stoff textil"),
    ("prismatic", "prisma prismen prismenplatte prismensystem"),
    ("prismatic panel", "prismenplatte"),
    ("prismatic film", "prismenfolie folie"),
    ("laser-cut-panel", "laserschnittplatte acrylglas"),
    ("laser-cut panel", "laserschnittplatte acrylglas"),
    ("redirecting-glass", "lichtlenkglas"),
    ("diffuser", "diffusor streuscheibe"),
    ("diffusing", "streuend diffus"),
    ("diffusing glass", "milchglas streuglas mattglas"),
    ("opal sheet", "opalplatte opalglas"),
    ("pane", "glas scheibe verglasung"),
    ("glass", "glas verglasung"),
    ("clear glazing", "klarglas floatglas isolierglas"),
    ("tinted glass", "farbglas getoentes glas"),
    ("coated glazing", "beschichtetes waermeschutzglas sonnenschutzglas"),
    ("electrochromic glazing", "elektrochrom schaltbar schaltbares"),
    ("perforated", "gelocht"),
    ("perforated metal", "lochblech"),
    ("expanded metal", "streckmetall"),
    ("egg-crate grid", "raster wabe"),
    ("membrane", "membran"),
    ("multiwall sheet", "stegplatte hohlkammerplatte"),
    ("translucent insulation", "waermedaemmung transluzent"),
    ("acrylic", "acrylglas plexiglas"),
    ("redirecting", "lichtlenkung lichtlenkend umlenkend"),
    ("retro-reflecting", "retroreflektierend ruecklenkend"),
    ("solar control", "sonnenschutz"),
    ("glare protection", "blendschutz"),
    ("moving", "beweglich"),
    ("ideal", "ideal referenz"),
];

/// Returns the German words for a kind or a tag; empty if there are none.
pub(super) fn german(kind_or_tag: &str) -> &'static str {
    GERMAN.iter().find(|(english, _)| *english == kind_or_tag).map_or("", |(_, words)| words)
}

/// Splits a text without case and diacritics into runs of letters and digits.
pub(super) fn runs(folded: &str) -> impl Iterator<Item = &str> {
    folded.split(|c: char| !c.is_alphanumeric()).filter(|run| !run.is_empty())
}

/// Splits a run of letters and digits into parts where letters meet digits; empty for a run of letters only or digits
/// only.
pub(super) fn parts(run: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let mut start = 0;
    let mut before: Option<bool> = None;
    for (at, letter) in run.char_indices() {
        let digit = letter.is_ascii_digit();
        if before.is_some_and(|before| before != digit) {
            parts.push(&run[start..at]);
            start = at;
        }
        before = Some(digit);
    }
    if start > 0 {
        parts.push(&run[start..]);
    }
    parts
}

/// Returns a word with the digraphs ae, oe, ue replaced by a, o, u, to match words whose umlauts lost their dots;
/// `None` if it has none.
pub(super) fn without_written_marks(word: &str) -> Option<String> {
    let plain = word.replace("ae", "a").replace("oe", "o").replace("ue", "u");
    (plain != word).then_some(plain)
}

/// Returns the number of typing errors that are tolerated in a typed word of this length; 0 for words with digits,
/// which are sizes.
pub(super) fn forgiven(word: &[char]) -> usize {
    match word.len() {
        _ if word.iter().any(char::is_ascii_digit) => 0,
        0..=3 => 0,
        4..=7 => 1,
        _ => 2,
    }
}

/// Returns the smallest number of typing errors (a letter omitted, inserted, changed, or two swapped) between a typed
/// word and the beginning of another; `None` if above `most`.
pub(super) fn distance(typed: &[char], word: &[char], most: usize) -> Option<usize> {
    let word = &word[..word.len().min(typed.len() + most)];
    let width = word.len() + 1;
    // Three rows: the one before the last tells swapped letters.
    let mut rows = [vec![0; width], (0..width).collect::<Vec<usize>>(), vec![0; width]];
    for (i, letter) in typed.iter().enumerate() {
        let [before, last, this] = &mut rows;
        this[0] = i + 1;
        for (j, other) in word.iter().enumerate() {
            let changed = last[j] + usize::from(letter != other);
            let mut best = changed.min(last[j + 1] + 1).min(this[j] + 1);
            if i > 0 && j > 0 && *letter == word[j - 1] && typed[i - 1] == *other {
                best = best.min(before[j - 1] + 1);
            }
            this[j + 1] = best;
        }
        if this.iter().min().is_none_or(|least| *least > most) {
            return None;
        }
        rows.rotate_left(1);
    }
    rows[1].iter().min().copied().filter(|least| *least <= most)
}

/// Returns the set of letters and digits of a word, one bit each: words whose sets differ in many bits cannot be
/// similar.
pub(super) fn letters(word: &[char]) -> u64 {
    word.iter().fold(0, |set, letter| set | 1 << (u32::from(*letter) % 61))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texts::folded;

    fn apart(typed: &str, word: &str) -> Option<usize> {
        let [typed, word] = [typed, word].map(|text| text.chars().collect::<Vec<char>>());
        distance(&typed, &word, forgiven(&typed))
    }

    #[test]
    fn typing_errors_are_counted_to_the_beginning_of_a_word() {
        assert_eq!(apart("venezian", "venetian"), Some(1));
        assert_eq!(apart("prismtic", "prismatic"), Some(1));
        assert_eq!(apart("vneetian", "venetian"), Some(1));
        assert_eq!(apart("venez", "venetian"), Some(1));
        assert_eq!(apart("prism", "prismatic"), Some(0));
        assert_eq!(apart("laser", "blind"), None);
        // Too short, and a size: to the letter.
        assert_eq!((apart("abc", "abd"), apart("80x72", "80x73")), (None, None));
    }

    #[test]
    fn words_lose_case_and_marks_and_fall_into_parts() {
        assert_eq!(folded("Écran TISSÉ, weiß – Grün"), "ecran tisse, weiss – grun");
        assert_eq!(folded("e\u{301}cran"), "ecran");
        assert_eq!(runs(&folded("Single Clear45 80/72")).collect::<Vec<_>>(), ["single", "clear45", "80", "72"]);
        assert_eq!(parts("clear45"), ["clear", "45"]);
        assert!(parts("clear").is_empty());
        assert_eq!(without_written_marks("gruen").as_deref(), Some("grun"));
        assert!(german("exterior venetian blind").contains("raffstore"));
    }

    #[test]
    fn german_words_are_folded_themselves() {
        for (_, words) in GERMAN {
            for word in words.split(' ') {
                assert_eq!(folded(word), word);
                assert!(word.chars().all(char::is_alphanumeric), "{word}");
            }
        }
    }
}
