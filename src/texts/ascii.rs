//! Text of any script in comparable form, and in ASCII: keys of products, names of files, formats that know no other
//! letters.

use any_ascii::any_ascii_char;
use unicode_normalization::UnicodeNormalization as _;
use unicode_normalization::char::is_combining_mark;

/// Whether a character is a syllable or a word: Chinese, Japanese and Korean are written without blanks between words.
pub const fn is_syllable(letter: char) -> bool {
    matches!(letter, '\u{2e80}'..='\u{d7ff}' | '\u{20000}'..='\u{3ffff}')
}

/// Returns a text with every letter and its marks as one character, where Unicode has one.
pub fn composed(text: &str) -> String {
    text.nfc().collect()
}

/// Returns a text in lower case without marks, the same for composed and decomposed letters.
pub fn folded(text: &str) -> String {
    let mut folded = String::with_capacity(text.len());
    // By words: most have nothing to be normalised, and no mark is put on a blank.
    for word in text.split_inclusive(' ') {
        if word.is_ascii() {
            folded.extend(word.chars().map(|letter| letter.to_ascii_lowercase()));
        } else {
            fold(word, &mut folded);
        }
    }
    folded
}

fn fold(word: &str, folded: &mut String) {
    // Marks of Latin, Greek and Cyrillic letters only: those of other scripts make other letters.
    let unmarked = word.nfkd().filter(|letter| !matches!(letter, '\u{300}'..='\u{36f}')).nfc();
    for letter in unmarked.flat_map(char::to_lowercase) {
        match letter {
            // The same letter at the end of a word.
            'ς' => folded.push('σ'),
            // Latin letters that are not made of a plain one and a mark, as ß and ø.
            '\u{80}'..='\u{2af}' if letter.is_alphabetic() => folded.push_str(any_ascii_char(letter)),
            _ => folded.push(letter),
        }
    }
}

/// Returns a text in ASCII on one line: Latin letters without marks, other scripts by their sound, Chinese and Korean
/// syllables as words. What has no transliteration is left out.
pub fn ascii_words(text: &str) -> String {
    let mut words = String::with_capacity(text.len());
    let mut before = ' ';
    for letter in text.nfc() {
        let sound = match (before, letter) {
            // One vowel of two letters, see ELOT 743.
            ('ο' | 'Ο', 'υ' | 'ύ') => "u",
            ('Ο', 'Υ' | 'Ύ') => "U",
            _ => any_ascii_char(letter),
        };
        before = letter;
        // Syllables begin with a capital, kana do not and are joined.
        if is_syllable(letter) && sound.starts_with(|first: char| first.is_ascii_uppercase()) {
            words.extend([" ", sound, " "]);
        } else {
            words.push_str(sound);
        }
    }
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns letters and digits of a text as [`ascii_words`] does, for keys and names of files: signs other than dashes
/// are blanks.
pub fn ascii_letters(text: &str) -> String {
    let letter = |letter: char| match letter {
        '\u{2010}'..='\u{2015}' | '−' => '-',
        letter if letter.is_ascii() || letter.is_alphanumeric() || is_combining_mark(letter) => letter,
        _ => ' ',
    };
    ascii_words(&composed(text).chars().map(letter).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_compared_without_case_marks_and_composition() {
        for same in [
            ["Jalousie Köln", "JALOUSIE KO\u{308}LN"],
            ["ПОДЪЁМНЫЕ ЖАЛЮЗИ", "подъе\u{308}мные жалюзи"],
            ["Зелёный", "зеленыи\u{306}"],
            ["ΠΕΡΣΊΔΕΣ", "Περσι\u{301}δες"],
            ["Straße Ø", "STRASSE ø"],
            ["한국", "\u{1112}\u{1161}\u{11ab}\u{1100}\u{116e}\u{11a8}"],
        ] {
            assert_eq!(folded(same[0]), folded(same[1]), "{same:?}");
        }
        assert_eq!(folded("Écran TISSÉ, weiß – Łódź"), "ecran tisse, weiss – lodz");
        assert_ne!(folded("か"), folded("が"));
        assert_eq!(composed("Ko\u{308}ln"), "Köln");
    }

    #[test]
    fn other_scripts_are_written_by_their_sound() {
        for (text, ascii) in [
            ("Venetian 80/72", "Venetian 80/72"),
            ("Jalousie Ko\u{308}ln, weiß", "Jalousie Koln, weiss"),
            ("Жалюзи белые", "Zhalyuzi belye"),
            ("Περσίδες αλουμινίου", "Persides alouminiou"),
            ("铝百叶窗 80", "Lu Bai Ye Chuang 80"),
            ("한국\tスクリーン", "Han Gug sukurin"),
            ("\u{e000}", ""),
        ] {
            assert_eq!(ascii_words(text), ascii);
        }
        assert_eq!(ascii_letters("−35° Ko\u{308}ln, 铝 5 €"), "-35 Koln, Lu 5");
    }
}
