//! File names with numbers: the common part of several names, and which number may be the angle of a state.

/// Words before a number that identify it as the angle of a state, unless it counts something.
const TURNS: [&str; 5] = ["tilt", "angle", "rot", "rotation", "winkel"];
/// Words for a component, before a number that may be its angle or its width.
const THINGS: [&str; 3] = ["slat", "lamella", "lamelle"];
/// Widths of slats on the market. \[mm\]
const WIDTHS: [f64; 13] = [16.0, 25.0, 35.0, 50.0, 60.0, 65.0, 70.0, 80.0, 90.0, 93.0, 100.0, 120.0, 150.0];
/// Words after a number that identify it as an angle in degrees.
const AFTER: [&str; 3] = ["deg", "°", "grad"];
/// Words after a number that identify it as another quantity than an angle.
const UNITS: [&str; 8] = ["pct", "perc", "proz", "%", "mm", "cm", "nm", "lx"];

/// Kind of the word in a file name that suggests that a number is an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Called {
    /// Unit of degrees after the number.
    Degrees,
    /// Word for a rotation before the number.
    Turn,
    /// Word for a component before the number, which has both an angle and a width.
    Thing,
}

/// Whether numbers could be something other than angles, such as counts or widths. `called`: kind of the word that
/// suggests angles.
pub(super) fn unclear(values: &[f64], called: Option<Called>) -> bool {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let [least, most] = [sorted[0], sorted[sorted.len() - 1]];
    let counted = (least == 0.0 || least == 1.0) && sorted.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
    let widths = values.iter().all(|value| WIDTHS.contains(value));
    match called {
        Some(Called::Degrees) => false,
        Some(Called::Turn) => counted || most > 90.0,
        Some(Called::Thing) => counted || widths || most > 90.0,
        None => widths,
    }
}

/// Pattern of a file name: its text without the numbers, and the numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pattern {
    /// Name in lower case, with `#` in place of every number.
    pub skeleton: String,
    /// Numbers in the order of the name.
    pub numbers: Vec<f64>,
    /// Index in `numbers` of the one that a word identifies as the angle.
    pub marked: Option<usize>,
    /// Kind of the word that identifies it.
    pub called: Option<Called>,
    /// Indices in `numbers` of those with another unit than degrees.
    pub other: Vec<usize>,
}

impl Pattern {
    /// Creates the pattern of a name without its extension.
    pub fn of(name: &str) -> Self {
        let letters: Vec<char> = name.to_lowercase().chars().collect();
        let mut pattern =
            Self { skeleton: String::new(), numbers: Vec::new(), marked: None, called: None, other: Vec::new() };
        let mut at = 0;
        while at < letters.len() {
            if !letters[at].is_ascii_digit() {
                pattern.skeleton.push(letters[at]);
                at += 1;
                continue;
            }
            let start = at;
            let digit = |at: usize| letters.get(at).is_some_and(char::is_ascii_digit);
            while digit(at) {
                at += 1;
            }
            if letters.get(at) == Some(&'.') && digit(at + 1) {
                at += 1;
                while digit(at) {
                    at += 1;
                }
            }
            let text: String = letters[start..at].iter().collect();
            let Ok(size) = text.parse::<f64>() else { continue };
            let after: String = letters[at..].iter().collect();
            pattern.take(size, after.trim_start_matches(['_', ' ', '-']));
        }
        pattern
    }

    /// Adds a number of the name. `size`: its absolute value; its sign is found in the text before it, its meaning in
    /// the words before it and in `after`.
    fn take(&mut self, size: f64, after: &str) {
        let mut before = self.skeleton.chars().rev();
        let minus =
            before.next() == Some('-') && before.next().is_none_or(|c| matches!(c, '_' | ' ' | '(' | '=' | ','));
        if minus {
            self.skeleton.pop();
        }
        let number = self.numbers.len();
        let word = self.skeleton.trim_end_matches(['_', ' ', '-', '=', '(']);
        let ends = |known: &[&str]| known.iter().any(|known| word.ends_with(known));
        let called = if AFTER.iter().any(|known| after.starts_with(known)) {
            Some(Called::Degrees)
        } else if UNITS.iter().any(|known| after.starts_with(known)) {
            // A unit counts more than the word before: "slat 80 mm" gives a width, not an angle.
            self.other.push(number);
            None
        } else if ends(&TURNS) {
            Some(Called::Turn)
        } else {
            ends(&THINGS).then_some(Called::Thing)
        };
        if called.is_some() {
            (self.marked, self.called) = (Some(number), called);
        }
        self.numbers.push(if minus { -size } else { size });
        self.skeleton.push('#');
    }

    /// Returns the bits of all numbers except the one at index `one`, for comparison with another name.
    pub fn others(&self, one: usize) -> Vec<u64> {
        self.numbers.iter().enumerate().filter(|(i, _)| *i != one).map(|(_, value)| value.to_bits()).collect()
    }
}

/// Returns the words of a name without numbers, for deciding whether two files describe one product.
pub(super) fn wordless(name: &str) -> String {
    let skeleton = Pattern::of(name).skeleton;
    skeleton.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Whether numbers without a marking word could be angles: multiples of 2.5° up to ±90°, of which at least one is 5° or
/// more.
pub(super) fn plausible(values: &[f64]) -> bool {
    let even = |value: &f64| value.abs() <= 90.0 && (value / 2.5).fract() == 0.0;
    values.iter().all(even) && values.iter().any(|value| value.abs() >= 5.0)
}

/// Whether all numbers differ.
pub(super) fn distinct(values: &[f64]) -> bool {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.windows(2).all(|pair| pair[0] < pair[1])
}
