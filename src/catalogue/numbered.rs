//! Names with numbers in them: what they have in common, and which number may be the angle of a state.

/// Words before a number that say that it is the angle of the state.
const BEFORE: [&str; 8] = ["slat", "tilt", "angle", "rot", "rotation", "winkel", "lamella", "lamelle"];
/// Words after a number that say so.
const AFTER: [&str; 3] = ["deg", "°", "grad"];
/// Words after a number that say that it is something else.
const UNITS: [&str; 8] = ["pct", "perc", "proz", "%", "mm", "cm", "nm", "lx"];

/// A name with its numbers taken out.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pattern {
    /// Lower case, `#` for every number.
    pub skeleton: String,
    /// In the order of the name.
    pub numbers: Vec<f64>,
    /// Which number is said to be the angle.
    pub marked: Option<usize>,
    /// Which have another unit.
    pub other: Vec<usize>,
}

impl Pattern {
    /// Of a name without its extension.
    pub fn of(name: &str) -> Self {
        let letters: Vec<char> = name.to_lowercase().chars().collect();
        let mut pattern = Self { skeleton: String::new(), numbers: Vec::new(), marked: None, other: Vec::new() };
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

    /// Takes a number in: its sign from what stands before it, its meaning from the words on both sides.
    fn take(&mut self, size: f64, after: &str) {
        let mut before = self.skeleton.chars().rev();
        let minus =
            before.next() == Some('-') && before.next().is_none_or(|c| matches!(c, '_' | ' ' | '(' | '=' | ','));
        if minus {
            self.skeleton.pop();
        }
        let number = self.numbers.len();
        let word = self.skeleton.trim_end_matches(['_', ' ', '-', '=', '(']);
        if BEFORE.iter().any(|known| word.ends_with(known)) || AFTER.iter().any(|known| after.starts_with(known)) {
            self.marked = Some(number);
        }
        if UNITS.iter().any(|known| after.starts_with(known)) {
            self.other.push(number);
        }
        self.numbers.push(if minus { -size } else { size });
        self.skeleton.push('#');
    }

    /// The numbers but one, for comparing.
    pub fn others(&self, one: usize) -> Vec<u64> {
        self.numbers.iter().enumerate().filter(|(i, _)| *i != one).map(|(_, value)| value.to_bits()).collect()
    }
}

/// What is left of a name without numbers, for telling whether two files speak of one product.
pub(super) fn wordless(name: &str) -> String {
    let skeleton = Pattern::of(name).skeleton;
    skeleton.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Could numbers that nothing calls angles be angles? Slats stand at multiples of 2.5°, and some of them are tilted.
pub(super) fn plausible(values: &[f64]) -> bool {
    let even = |value: &f64| value.abs() <= 90.0 && (value / 2.5).fract() == 0.0;
    values.iter().all(even) && values.iter().any(|value| value.abs() >= 5.0)
}

/// Is no number there twice?
pub(super) fn distinct(values: &[f64]) -> bool {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.windows(2).all(|pair| pair[0] < pair[1])
}
