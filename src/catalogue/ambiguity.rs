//! Questions about files that their contents do not answer: whether they are states of one product.

use super::numbered::Pattern;
use super::source_file::SourceFile;
use crate::texts::import as text;

/// Question about a product made from files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ambiguity {
    /// Files that were grouped as states of one product only because of numbers in their names.
    NumbersAlone,
    /// File that became a product of its own although its name differs from those of these other files by a number
    /// alone.
    PerhapsStates(Vec<String>),
}

impl Ambiguity {
    /// Returns the question to the user in one sentence.
    pub fn question(&self) -> String {
        match self {
            Self::NumbersAlone => text::ASK_NUMBERS.into(),
            Self::PerhapsStates(others) => {
                let shown: Vec<&str> = others.iter().take(3).map(String::as_str).collect();
                let shown = shown.join(", ");
                text::ask_state(if others.len() > 3 { text::and_more(shown, others.len() - 3) } else { shown })
            }
        }
    }
}

/// Beginnings of words that only systems with moving parts have in their names.
const MOVING: [&str; 9] = ["blind", "venet", "slat", "lamel", "jalous", "raff", "louv", "persian", "shutter"];

/// Whether the words of a text refer to slats.
pub(super) fn speaks_of_slats(text: &str) -> bool {
    let text = text.to_lowercase();
    text.split(|c: char| !c.is_alphabetic())
        .any(|word| word == "ven" || MOVING.iter().any(|known| word.starts_with(known)))
}

/// Returns the hemispherical transmittance of the system in a file; `None` if the file has several datasets or no
/// transmission.
fn light(file: &SourceFile) -> Option<f64> {
    let [dataset] = file.datasets.as_slice() else { return None };
    dataset.transmission_of_either_side().map(|btdf| btdf.tau_hemispherical())
}

/// Trend of the hemispherical transmittance over the files of a family, by rising number in their names, which may be
/// the slat angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Trend {
    /// Transmittance that falls from step to step, as of slats that close.
    Falls,
    /// Transmittance that rises from step to step, as of fabrics with increasing openness.
    Rises,
    Neither,
}

/// Returns the trend of the hemispherical transmittance over the absolute value of the number in each file's name.
fn trend(files: &[&SourceFile], family: &[(usize, f64)]) -> Trend {
    let mut steps: Vec<(f64, f64)> = Vec::new();
    for (place, angle) in family {
        let Some(light) = light(files[*place]) else { return Trend::Neither };
        steps.push((angle.abs(), light));
    }
    steps.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Anything less than a hundredth may be noise.
    let (first, last) = (steps.first().map_or(0.0, |step| step.1), steps.last().map_or(0.0, |step| step.1));
    let all = |holds: fn(f64, f64) -> bool| steps.windows(2).all(|pair| holds(pair[0].1, pair[1].1));
    if last < 0.9 * first && all(|a, b| b <= a + 0.01) {
        Trend::Falls
    } else if last > 1.1 * first && all(|a, b| b >= a - 0.01) {
        Trend::Rises
    } else {
        Trend::Neither
    }
}

/// Whether the product names inside the files contain the same angles, and differ by them.
fn names_contain_angles(files: &[&SourceFile], family: &[(usize, f64)]) -> bool {
    let names: Vec<&str> =
        family.iter().map(|(place, _)| files[*place].datasets.first().map_or("", |one| one.name.as_str())).collect();
    let holds = |name: &str, angle: f64| {
        let pattern = Pattern::of(name);
        let own = pattern.numbers.iter().enumerate().filter(|(number, _)| !pattern.other.contains(number));
        own.map(|(_, value)| *value).any(|value| value.abs() == angle.abs())
    };
    let all = names.iter().zip(family).all(|(name, (_, angle))| *angle == 0.0 || holds(name, *angle));
    all && names.iter().any(|name| *name != names[0])
}

/// Whether anything besides numbers in their names confirms that files are states of one product. `family`: index of
/// each file and the number in its name; `skeleton`: common part of the names; `marked`: whether a word in the names
/// identifies the number as an angle.
pub(super) fn confirmed(files: &[&SourceFile], family: &[(usize, f64)], skeleton: &str, marked: bool) -> bool {
    let moving = |place: usize| {
        let file = files[place];
        let named = file.datasets.iter().any(|dataset| speaks_of_slats(&dataset.name));
        named || speaks_of_slats(&file.fields.kind) || file.fields.tags.iter().any(|tag| speaks_of_slats(tag))
    };
    // Only what turns has negative numbers.
    let signed = family.iter().any(|(_, angle)| *angle < 0.0);
    let spoken = speaks_of_slats(skeleton) || family.iter().all(|(place, _)| moving(*place));
    let inside = || spoken || names_contain_angles(files, family);
    marked
        || signed
        || match trend(files, family) {
            Trend::Falls => family.len() > 2 || inside(),
            // Roller blinds are blinds too, and their openness is a number.
            Trend::Rises => false,
            Trend::Neither => inside(),
        }
}
