//! Which files are states of one product: those whose names, or what they say about themselves, differ by an angle alone.
//!
//! In doubt every file is a product of its own: two products that are taken for one are wrong everywhere afterwards, one
//! that is taken for two is seen at once.

use super::source_file::SourceFile;
use crate::formats::{Format, is_one_function};
use std::collections::BTreeMap;

/// How files that are given together are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Grouping {
    /// As names and contents say.
    #[default]
    Proposed,
    /// Each file a product of its own; functions of one state that lie in files of their own stay together.
    Each,
    /// All files are the states of one product.
    One,
}

/// Files of one product.
#[derive(Debug)]
pub(super) struct Family {
    /// In the order of the states.
    pub files: Vec<SourceFile>,
    /// The angle of every file, as the names tell. \[°\]
    pub angles: Option<Vec<f64>>,
}

/// Places of a family's files, and their angles where names tell them.
type Member = (Vec<usize>, Option<Vec<f64>>);

/// Words before a number that say that it is the angle of the state.
const BEFORE: [&str; 8] = ["slat", "tilt", "angle", "rot", "rotation", "winkel", "lamella", "lamelle"];
/// Words after a number that say so.
const AFTER: [&str; 3] = ["deg", "°", "grad"];
/// Words after a number that say that it is something else.
const UNITS: [&str; 8] = ["pct", "perc", "proz", "%", "mm", "cm", "nm", "lx"];

/// A name with its numbers taken out.
#[derive(Debug, Clone, PartialEq)]
struct Pattern {
    /// Lower case, `#` for every number.
    skeleton: String,
    numbers: Vec<f64>,
    /// Which number is said to be the angle.
    marked: Option<usize>,
    /// Which have another unit.
    other: Vec<usize>,
}

impl Pattern {
    fn of(name: &str) -> Self {
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
    fn others(&self, one: usize) -> Vec<u64> {
        self.numbers.iter().enumerate().filter(|(i, _)| *i != one).map(|(_, value)| value.to_bits()).collect()
    }
}

/// What is left of a name without numbers, for telling whether two files speak of one product.
fn wordless(name: &str) -> String {
    let skeleton = Pattern::of(name).skeleton;
    skeleton.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Could numbers that nothing calls angles be angles? Slats stand at multiples of 2.5°, and some of them are tilted.
fn plausible(values: &[f64]) -> bool {
    let even = |value: &f64| value.abs() <= 90.0 && (value / 2.5).fract() == 0.0;
    values.iter().all(even) && values.iter().any(|value| value.abs() >= 5.0)
}

fn distinct(values: &[f64]) -> bool {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.windows(2).all(|pair| pair[0] < pair[1])
}

/// A file's place, what it has in common with its family, and its name's pattern.
type Named<K> = (usize, K, Pattern);

/// Which places hold files of one family, with their angles; by the patterns of one name of each.
///
/// Files of one skeleton whose other numbers agree and whose angles are distinct. `marked_alone`: only numbers that are
/// called angles count.
fn families<K: Ord>(names: &[Named<K>], marked_alone: bool) -> Vec<Vec<(usize, f64)>> {
    let mut by_skeleton: BTreeMap<(&K, &str), Vec<&Named<K>>> = BTreeMap::new();
    for entry in names {
        by_skeleton.entry((&entry.1, &entry.2.skeleton)).or_default().push(entry);
    }
    let mut found = Vec::new();
    for group in by_skeleton.into_values().filter(|group| group.len() > 1) {
        let first = &group[0].2;
        let varies = |number: usize| group.iter().any(|(_, _, p)| p.numbers[number] != first.numbers[number]);
        // Without a word that tells, the last number that varies is the angle: what comes before it names the product.
        let guessed = (0..first.numbers.len()).rev().find(|&number| varies(number) && !first.other.contains(&number));
        let marked = first.marked;
        let Some(angle) = marked.or(if marked_alone { None } else { guessed }) else { continue };
        let mut apart: BTreeMap<Vec<u64>, Vec<(usize, f64)>> = BTreeMap::new();
        for (place, _, pattern) in group {
            apart.entry(pattern.others(angle)).or_default().push((*place, pattern.numbers[angle]));
        }
        found.extend(apart.into_values().filter(|family| {
            let values: Vec<f64> = family.iter().map(|(_, value)| *value).collect();
            family.len() > 1 && distinct(&values) && (marked.is_some() || plausible(&values))
        }));
    }
    found
}

/// The name that a file of a format of one function a file gives its product.
fn one_function_name(file: &SourceFile) -> Option<&str> {
    let own = file.datasets.iter().all(|dataset| is_one_function(dataset) && !dataset.name.is_empty());
    own.then(|| file.datasets.first().map(|dataset| dataset.name.as_str())).flatten()
}

/// What files of one product have in common besides their names: folder, maker, words of the name, bases.
fn common(file: &SourceFile) -> Option<[String; 5]> {
    let [dataset] = file.datasets.as_slice() else { return None };
    Some([
        file.folder.clone(),
        dataset.manufacturer.trim().to_lowercase(),
        wordless(&dataset.name),
        dataset.incident_basis.clone(),
        dataset.emergent_basis.clone(),
    ])
}

/// A family by rising angle.
fn in_order(mut family: Vec<(usize, f64)>) -> Member {
    family.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (places, angles) = family.into_iter().unzip();
    (places, Some(angles))
}

/// Do all files hold the same functions?
fn one_side(files: &[SourceFile], places: &[usize]) -> bool {
    let functions =
        |place: usize| -> Vec<_> { files[place].datasets.iter().map(|dataset| dataset.visible.components()).collect() };
    places.iter().all(|&place| files[place].datasets.len() == 1 && functions(place) == functions(places[0]))
}

/// Families among files: places with angles, or with no angle where the files name their states themselves.
fn proposed(files: &[SourceFile]) -> Vec<Member> {
    let mut list: Vec<Member> = Vec::new();
    let mut taken = vec![false; files.len()];
    let mut named: BTreeMap<Vec<String>, Vec<usize>> = BTreeMap::new();
    for (place, file) in files.iter().enumerate() {
        if let Some(name) = one_function_name(file) {
            named.entry(vec![name.to_owned()]).or_default().push(place);
        } else if let [one] = file.datasets.as_slice()
            && !one.state.is_empty()
            && let Some(mut key) = common(file)
        {
            // Such files name product and state; wherever they lie they belong together.
            key[0].clone_from(&one.name);
            named.entry(key.to_vec()).or_default().push(place);
        }
    }
    for places in named.into_values() {
        let states: Vec<&str> = places.iter().map(|&place| files[place].datasets[0].state.as_str()).collect();
        let one_function = one_function_name(&files[places[0]]).is_some();
        let nameless = places.len() > 1 && states.iter().all(|state| state.is_empty());
        if one_function && nameless && one_side(files, &places) {
            // States that only the names of their files tell apart.
            let names: Vec<Named<()>> =
                places.iter().map(|&place| (place, (), Pattern::of(Format::stem(&files[place].name)))).collect();
            if let Some(family) = families(&names, false).into_iter().find(|family| family.len() == places.len()) {
                places.iter().for_each(|&place| taken[place] = true);
                list.push(in_order(family));
                continue;
            }
        }
        let different = (1..states.len()).all(|i| !states[..i].contains(&states[i]));
        if one_function || different {
            places.iter().for_each(|&place| taken[place] = true);
            list.push((places, None));
        }
    }
    for by_file_name in [true, false] {
        let names: Vec<Named<[String; 5]>> = (0..files.len())
            .filter(|&place| !taken[place])
            .filter_map(|place| {
                let file = &files[place];
                let text = if by_file_name { Format::stem(&file.name) } else { file.datasets.first()?.name.as_str() };
                let nameless = file.datasets.first()?.state.is_empty();
                nameless.then(|| common(file).map(|key| (place, key, Pattern::of(text)))).flatten()
            })
            .collect();
        for family in families(&names, !by_file_name) {
            family.iter().for_each(|(place, _)| taken[*place] = true);
            list.push(in_order(family));
        }
    }
    list.extend((0..files.len()).filter(|&place| !taken[place]).map(|place| (vec![place], None)));
    list
}

/// All as one: with angles where the names of all have them.
fn joined(files: &[SourceFile]) -> Member {
    let nameless = |file: &SourceFile| matches!(file.datasets.as_slice(), [one] if one.state.is_empty());
    let names: Vec<Named<()>> =
        files.iter().enumerate().map(|(place, file)| (place, (), Pattern::of(Format::stem(&file.name)))).collect();
    let whole = families(&names, false).into_iter().find(|family| family.len() == files.len());
    match whole.filter(|_| files.iter().all(nameless) && !files.iter().all(|file| one_function_name(file).is_some())) {
        Some(family) => in_order(family),
        None => ((0..files.len()).collect(), None),
    }
}

/// Each file for itself, but for the functions of one state.
fn apart(files: &[SourceFile]) -> Vec<Member> {
    let mut list: Vec<Member> = Vec::new();
    let key = |place: usize| {
        let file = &files[place];
        one_function_name(file).map(|name| (name, file.datasets[0].state.as_str()))
    };
    for place in 0..files.len() {
        match list.iter_mut().find(|(others, _)| key(place).is_some() && key(others[0]) == key(place)) {
            Some((others, _)) => others.push(place),
            None => list.push((vec![place], None)),
        }
    }
    list
}

/// Files as families, in the order in which their first files were given.
pub(super) fn group(files: Vec<SourceFile>, grouping: Grouping) -> Vec<Family> {
    if files.is_empty() {
        return Vec::new();
    }
    let mut list = match grouping {
        Grouping::Proposed => proposed(&files),
        Grouping::Each => apart(&files),
        Grouping::One => vec![joined(&files)],
    };
    list.sort_by_key(|(places, _)| places.iter().min().copied());
    let mut files: Vec<Option<SourceFile>> = files.into_iter().map(Some).collect();
    list.into_iter()
        .map(|(places, angles)| Family {
            // Every place is in one family alone.
            files: places.into_iter().filter_map(|place| files[place].take()).collect(),
            angles,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::Dataset;

    fn file(name: &str, product: &str, basis: &str) -> SourceFile {
        let dataset = Dataset {
            name: product.to_owned(),
            incident_basis: basis.to_owned(),
            emergent_basis: basis.to_owned(),
            ..Dataset::default()
        };
        SourceFile { name: name.to_owned(), datasets: vec![dataset], ..SourceFile::default() }
    }

    /// Names of the files of every family with more than one, with their angles.
    fn found(files: &[SourceFile]) -> Vec<Vec<(String, f64)>> {
        let families = group(files.to_vec(), Grouping::Proposed);
        families
            .into_iter()
            .filter_map(|family| {
                let angles = family.angles?;
                Some(family.files.into_iter().map(|file| file.name).zip(angles).collect())
            })
            .collect()
    }

    fn of_names(names: &[&str]) -> Vec<Vec<f64>> {
        let files: Vec<SourceFile> = names.iter().map(|name| file(name, "", "Klems")).collect();
        found(&files).into_iter().map(|family| family.into_iter().map(|one| one.1).collect()).collect()
    }

    #[test]
    fn angles_in_names_make_families_in_order() {
        assert_eq!(of_names(&["b60.xml", "b00.xml", "b45.xml"]), [vec![0.0, 45.0, 60.0]]);
        assert_eq!(of_names(&["slat_35.xml", "slat_-35.xml", "slat_7.xml"]), [vec![-35.0, 7.0, 35.0]]);
        assert_eq!(of_names(&["tilt45.xml", "tilt0.xml"]), [vec![0.0, 45.0]]);
        assert_eq!(of_names(&["Blind 80mm_45deg.xml", "Blind 80mm_22.5deg.xml"]), [vec![22.5, 45.0]]);
        assert_eq!(of_names(&["ven80_0.xml", "ven80_45.xml", "ven60_0.xml", "ven60_45.xml"]).len(), 2);
    }

    #[test]
    fn other_numbers_do_not() {
        for names in [
            &["sample1.xml", "sample2.xml", "sample3.xml"][..],
            &["cl_Tn0.6.xml", "cl_Tn0.9.xml"],
            &["2011-SA1.xml", "2011-SA45.xml"],
            &["screen_5pct.xml", "screen_10pct.xml"],
            &["venetian.xml", "fabric.xml", "honeycomb.xml"],
            &["slat_80mm.xml", "blind_60mm.xml"],
            &["b00.xml", "b0.xml"],
            &["cgdb_14060.xml", "cgdb_14065.xml"],
        ] {
            assert_eq!(of_names(names), Vec::<Vec<f64>>::new(), "{names:?}");
        }
    }

    #[test]
    fn files_of_different_products_bases_or_folders_stay_apart() {
        let same = [file("v0.xml", "Single", "Klems"), file("v45.xml", "Single 45", "Klems")];
        assert_eq!(found(&same).len(), 1);
        let other_name = [same[0].clone(), file("v45.xml", "Satine", "Klems")];
        let other_basis = [same[0].clone(), file("v45.xml", "Single", "Tree")];
        let other_folder = [same[0].clone(), SourceFile { folder: "x".to_owned(), ..same[1].clone() }];
        for files in [other_name, other_basis, other_folder] {
            assert!(found(&files).is_empty(), "{files:?}");
        }
        // The names of the files say nothing, those of the products do.
        let told = [file("x.xml", "Lamella, 0°", "Klems"), file("y.xml", "Lamella, 30°", "Klems")];
        assert_eq!(found(&told), [vec![("x.xml".to_owned(), 0.0), ("y.xml".to_owned(), 30.0)]]);
    }

    #[test]
    fn the_user_may_take_them_otherwise() {
        let files = [file("b00.xml", "", "K"), file("b30.xml", "", "K"), file("roof.xml", "", "K")];
        let count = |grouping| group(files.to_vec(), grouping).len();
        assert_eq!([Grouping::Proposed, Grouping::Each, Grouping::One].map(count), [2, 3, 1]);
        let one = group(files[..2].to_vec(), Grouping::One).remove(0);
        assert_eq!(one.angles, Some(vec![0.0, 30.0]));
    }
}
