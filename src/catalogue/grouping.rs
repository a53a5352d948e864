//! Grouping of files into products: the names or contents of files with states of one product differ by an angle alone.
//!
//! When in doubt, every file becomes a product of its own: two products that were taken for one are wrong everywhere
//! afterwards, one that was taken for two is noticed at once. Where numbers might be angles the user is asked, see
//! [`Ambiguity`].

use super::ambiguity::{Ambiguity, confirmed, speaks_of_slats};
use super::numbered::{Pattern, distinct, plausible, unclear, wordless};
use super::source_file::SourceFile;
use crate::formats::{Format, is_one_function};
use std::collections::BTreeMap;

/// Rule by which files that are imported together become products.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Grouping {
    /// Grouping by names and contents.
    #[default]
    Proposed,
    /// Each file as a product of its own; only files with different functions (such as transmission and reflection) of
    /// one state are joined.
    Each,
    /// All files as the states of one product.
    One,
}

/// Group of files that become one product.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Proposal {
    /// Indices of the files in the list of all imported files, in the order of the product's states.
    pub files: Vec<usize>,
    /// Angle of every file according to its name \[°\]; `None` where datasets contain the names of their states.
    pub angles: Option<Vec<f64>>,
    /// Question for the user about this grouping, if any.
    pub ambiguity: Option<Ambiguity>,
}

/// Indices of the files of one product, with their angles \[°\] where the file names contain them.
type Member = (Vec<usize>, Option<Vec<f64>>);

/// File of a list: its index, properties that all files of one product share, and the pattern of its name.
type Named<K> = (usize, K, Pattern);

/// Files whose names differ by one number.
struct Series {
    /// Index of each file, and the number by which its name differs.
    members: Vec<(usize, f64)>,
    /// Common part of the names, with `#` in place of numbers.
    skeleton: String,
    /// Whether a word in the names identifies the number as an angle.
    marked: bool,
    /// Whether the numbers may count or measure something rather than being angles.
    unclear: bool,
    /// Whether the files are states of one product: all numbers differ, and are identified as angles or could be
    /// angles.
    family: bool,
}

/// Returns the series of files whose names differ by one number alone. `marked_alone`: only numbers that a word in the
/// name identifies as angles are considered.
fn series<K: Ord>(names: &[Named<K>], marked_alone: bool) -> Vec<Series> {
    let mut by_skeleton: BTreeMap<(&K, &str), Vec<&Named<K>>> = BTreeMap::new();
    for entry in names {
        by_skeleton.entry((&entry.1, &entry.2.skeleton)).or_default().push(entry);
    }
    let mut found = Vec::new();
    for ((_, skeleton), group) in by_skeleton.into_iter().filter(|(_, group)| group.len() > 1) {
        let first = &group[0].2;
        let varies = |number: usize| group.iter().any(|(_, _, p)| p.numbers[number] != first.numbers[number]);
        // Without a word that tells, the last number that varies is the angle: what comes before it names the product.
        let guessed = (0..first.numbers.len()).rev().find(|&number| varies(number) && !first.other.contains(&number));
        let marked = first.marked;
        let Some(angle) = marked.or(if marked_alone { None } else { guessed }) else { continue };
        let mut by_others: BTreeMap<Vec<u64>, Vec<(usize, f64)>> = BTreeMap::new();
        for (place, _, pattern) in group {
            by_others.entry(pattern.others(angle)).or_default().push((*place, pattern.numbers[angle]));
        }
        for members in by_others.into_values().filter(|members| members.len() > 1) {
            let values: Vec<f64> = members.iter().map(|(_, value)| *value).collect();
            let unclear = unclear(&values, marked.and(first.called));
            let called = marked.is_some() && !unclear;
            let family = distinct(&values) && (called || (marked.is_none() && plausible(&values)));
            found.push(Series { members, skeleton: skeleton.to_owned(), marked: marked.is_some(), unclear, family });
        }
    }
    found
}

/// Returns the groups of files that are states of one product, each file by its index with its angle. \[°\]
fn families<K: Ord>(names: &[Named<K>], marked_alone: bool) -> Vec<Vec<(usize, f64)>> {
    let all = series(names, marked_alone).into_iter();
    all.filter(|one| one.family).map(|one| one.members).collect()
}

/// Whether the files of a series that were not grouped could still be states of one product, so that the user is asked.
/// Numbers that cannot be angles, and two or three samples with their numbers, are not ambiguous.
fn is_ambiguous(one: &Series) -> bool {
    let mut values: Vec<f64> = one.members.iter().map(|(_, value)| *value).collect();
    values.sort_by(f64::total_cmp);
    let (least, most) = (values[0], values[values.len() - 1]);
    if one.unclear && distinct(&values) && (one.marked || speaks_of_slats(&one.skeleton)) {
        return true;
    }
    let angles = least >= -90.0 && most <= 90.0 && most - least >= 5.0;
    // The same number twice: one file of the family is there in two forms.
    let twice = !distinct(&values) && (one.marked || plausible(&values));
    angles && (twice || one.marked || values.len() > 2 || speaks_of_slats(&one.skeleton))
}

/// Returns the product name in a file of a format that has one function (such as the front transmission) per file.
fn one_function_name(file: &SourceFile) -> Option<&str> {
    let own = file.datasets.iter().all(|dataset| is_one_function(dataset) && !dataset.name.is_empty());
    own.then(|| file.datasets.first().map(|dataset| dataset.name.as_str())).flatten()
}

/// Returns the properties besides the file name's numbers that all files of one product share: folder, maker, words of
/// the name, bases.
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

/// Returns a group of files with their angles, sorted by rising angle.
fn in_order(mut family: Vec<(usize, f64)>) -> Member {
    family.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (places, angles) = family.into_iter().unzip();
    (places, Some(angles))
}

/// Whether all files contain the same functions, such as the front transmission alone.
fn one_side(files: &[&SourceFile], places: &[usize]) -> bool {
    let functions =
        |place: usize| -> Vec<_> { files[place].datasets.iter().map(|dataset| dataset.visible.components()).collect() };
    places.iter().all(|&place| files[place].datasets.len() == 1 && functions(place) == functions(places[0]))
}

/// Returns the groups of files whose datasets contain the names of product and state, and marks their indices as taken.
fn self_named(files: &[&SourceFile], taken: &mut [bool]) -> Vec<Member> {
    let mut list: Vec<Member> = Vec::new();
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
        let one_function = one_function_name(files[places[0]]).is_some();
        let nameless = places.len() > 1 && states.iter().all(|state| state.is_empty());
        if one_function && nameless && one_side(files, &places) {
            // States that only the names of their files distinguish.
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
    list
}

/// Returns the proposed groups of files, with angles, or without them where the datasets contain the names of their
/// states.
fn proposed(files: &[&SourceFile]) -> Vec<Proposal> {
    let mut taken = vec![false; files.len()];
    let mut list: Vec<Proposal> = self_named(files, &mut taken).into_iter().map(Proposal::from).collect();
    let mut asked: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for by_file_name in [true, false] {
        let names: Vec<Named<[String; 5]>> = (0..files.len())
            .filter(|&place| !taken[place])
            .filter_map(|place| {
                let file = files[place];
                let text = if by_file_name { Format::stem(&file.name) } else { file.datasets.first()?.name.as_str() };
                let nameless = file.datasets.first()?.state.is_empty();
                nameless.then(|| common(file).map(|key| (place, key, Pattern::of(text)))).flatten()
            })
            .collect();
        for one in series(&names, !by_file_name) {
            let places: Vec<usize> = one.members.iter().map(|(place, _)| *place).collect();
            if one.family {
                places.iter().for_each(|&place| taken[place] = true);
                let sure = !one.unclear && confirmed(files, &one.members, &one.skeleton, one.marked);
                let ambiguity = (!sure).then_some(Ambiguity::NumbersAlone);
                list.push(Proposal { ambiguity, ..in_order(one.members).into() });
            } else if is_ambiguous(&one) {
                asked.extend(places.iter().map(|&place| (place, places.clone())));
            }
        }
    }
    strays(files, &list, &taken, &mut asked);
    let shown = |place: &usize| files[*place].name.clone();
    list.extend((0..files.len()).filter(|&place| !taken[place]).map(|place| {
        let others = asked.get(&place).into_iter().flatten().filter(|&&other| other != place && !taken[other]);
        let mut others: Vec<String> = others.map(shown).collect();
        let family = asked.get(&place).into_iter().flatten().filter(|&&other| taken[other]);
        others.extend(family.map(shown));
        let ambiguity = (!others.is_empty()).then_some(Ambiguity::PerhapsStates(others));
        Proposal { files: vec![place], angles: None, ambiguity }
    }));
    list
}

/// Adds to `asked` the files that are named like those of a group but have other contents, such as another basis or
/// another maker: for each, the files of the group.
fn strays(files: &[&SourceFile], list: &[Proposal], taken: &[bool], asked: &mut BTreeMap<usize, Vec<usize>>) {
    let skeleton = |place: usize| Pattern::of(Format::stem(&files[place].name)).skeleton;
    for family in list.iter().filter(|family| family.angles.is_some()) {
        let first = family.files[0];
        let own = skeleton(first);
        let like = |place: &usize| {
            !taken[*place]
                && files[*place].folder == files[first].folder
                && files[*place].datasets.len() == 1
                && own.contains('#')
                && skeleton(*place) == own
        };
        for place in (0..files.len()).filter(like) {
            asked.entry(place).or_insert_with(|| family.files.clone());
        }
    }
}

impl From<Member> for Proposal {
    fn from((files, angles): Member) -> Self {
        Self { files, angles, ambiguity: None }
    }
}

/// Returns all files as one product, with angles where all names contain them.
fn joined(files: &[&SourceFile]) -> Member {
    let nameless = |file: &&SourceFile| matches!(file.datasets.as_slice(), [one] if one.state.is_empty());
    let names: Vec<Named<()>> =
        files.iter().enumerate().map(|(place, file)| (place, (), Pattern::of(Format::stem(&file.name)))).collect();
    let whole = families(&names, false).into_iter().find(|family| family.len() == files.len());
    match whole.filter(|_| files.iter().all(nameless) && !files.iter().all(|file| one_function_name(file).is_some())) {
        Some(family) => in_order(family),
        None => ((0..files.len()).collect(), None),
    }
}

/// Returns each file as a product of its own, except that files with different functions of one state are joined.
fn separate(files: &[&SourceFile]) -> Vec<Member> {
    let mut list: Vec<Member> = Vec::new();
    let key = |place: usize| {
        let file = files[place];
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

/// Returns the groups of files that each become a product, in the order of their first files.
pub fn propose(files: &[&SourceFile], grouping: Grouping) -> Vec<Proposal> {
    if files.is_empty() {
        return Vec::new();
    }
    let mut list = match grouping {
        Grouping::Proposed => proposed(files),
        Grouping::Each => separate(files).into_iter().map(Proposal::from).collect(),
        Grouping::One => vec![joined(files).into()],
    };
    list.sort_by_key(|one| one.files.iter().min().copied());
    list
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
        let families = propose(&files.iter().collect::<Vec<_>>(), Grouping::Proposed);
        families
            .into_iter()
            .filter_map(|family| {
                let angles = family.angles?;
                Some(family.files.into_iter().map(|place| files[place].name.clone()).zip(angles).collect())
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
        let given: Vec<&SourceFile> = files.iter().collect();
        let count = |grouping| propose(&given, grouping).len();
        assert_eq!([Grouping::Proposed, Grouping::Each, Grouping::One].map(count), [2, 3, 1]);
        let one = propose(&given[..2], Grouping::One).remove(0);
        assert_eq!(one.angles, Some(vec![0.0, 30.0]));
    }

    /// Places of every product with what is asked about it, of files with these names, names of products and
    /// transmittances.
    fn asked(files: &[(&str, &str, f64)]) -> Vec<(Vec<usize>, Option<Ambiguity>)> {
        let made: Vec<SourceFile> = files
            .iter()
            .map(|(name, product, tau)| {
                let mut made = file(name, product, "Klems");
                made.datasets[0].visible.transmission_front = Some(crate::compute::btdf::Btdf::ideal_diffuse(*tau));
                made
            })
            .collect();
        let proposals = propose(&made.iter().collect::<Vec<_>>(), Grouping::Proposed);
        proposals.into_iter().map(|one| (one.files, one.ambiguity)).collect()
    }

    #[test]
    fn numbers_that_nothing_else_confirms_are_a_question() {
        // Five, ten and twenty percent of holes let more and more light through; slats less and less.
        let cloth = asked(&[("tex05.xml", "", 0.05), ("tex10.xml", "", 0.1), ("tex20.xml", "", 0.2)]);
        assert_eq!(cloth, [(vec![0, 1, 2], Some(Ambiguity::NumbersAlone))]);
        let slats = asked(&[("tex05.xml", "", 0.5), ("tex10.xml", "", 0.45), ("tex20.xml", "", 0.3)]);
        assert_eq!(slats, [(vec![0, 1, 2], None)]);
        // Two are too few to see that, unless names speak of slats, or those of the products have the angles too.
        assert!(asked(&[("x5.xml", "", 0.5), ("x10.xml", "", 0.4)])[0].1.is_some());
        assert!(asked(&[("x5.xml", "Louvre", 0.5), ("x10.xml", "Louvre", 0.4)])[0].1.is_none());
        assert!(asked(&[("x5.xml", "p5", 0.5), ("x10.xml", "p10", 0.4)])[0].1.is_none());
        // A roller blind is a blind, and its openness a number.
        assert!(asked(&[("roller blind 5.xml", "", 0.05), ("roller blind 10.xml", "", 0.1)])[0].1.is_some());
        for names in [["t_-35.xml", "t_35.xml"], ["t tilt 5.xml", "t tilt 10.xml"]] {
            assert!(asked(&[(names[0], "", 0.1), (names[1], "", 0.2)])[0].1.is_none(), "{names:?}");
        }
    }

    #[test]
    fn what_is_kept_apart_though_it_may_belong_together_is_a_question() {
        // Steps of seven degrees.
        let odd = asked(&[("a0.xml", "", 0.5), ("a7.xml", "", 0.4), ("a14.xml", "", 0.3)]);
        assert_eq!(odd.len(), 3);
        assert_eq!(odd[0].1, Some(Ambiguity::PerhapsStates(vec!["a7.xml".to_owned(), "a14.xml".to_owned()])));
        assert!(odd[0].1.as_ref().unwrap().question().contains("a7.xml, a14.xml"));
        // One angle twice, in two ways of writing.
        assert!(
            asked(&[("b0.xml", "", 0.5), ("b00.xml", "", 0.4), ("b30.xml", "", 0.3)]).iter().all(|one| one.1.is_some())
        );
        // Of a family of three one has another basis.
        let mut files = [file("v0.xml", "V", "Klems"), file("v30.xml", "V", "Klems"), file("v60.xml", "V", "Tree")];
        let ask = |files: &[SourceFile]| propose(&files.iter().collect::<Vec<_>>(), Grouping::Proposed);
        let found = ask(&files);
        assert_eq!((found[0].files.as_slice(), found[1].files.as_slice()), (&[0, 1][..], &[2][..]));
        assert_eq!(found[1].ambiguity, Some(Ambiguity::PerhapsStates(vec!["v0.xml".to_owned(), "v30.xml".to_owned()])));
        files[2].folder = "elsewhere".to_owned();
        assert_eq!(ask(&files)[1].ambiguity, None);
        // Counted variants and widths of slats, also where a word of angles stands before them.
        for names in [
            ["x_rot1.xml", "x_rot2.xml", "x_rot3.xml"],
            ["slat50.xml", "slat80.xml", "slat100.xml"],
            ["Lamelle 60.xml", "Lamelle 80.xml", "Lamelle 90.xml"],
            ["venetian_50.xml", "venetian_80.xml", "venetian_100.xml"],
            ["winkel1.xml", "winkel2.xml", "winkel3.xml"],
        ] {
            let found = asked(&names.map(|name| (name, "", 0.5)));
            assert!(found.len() == 3 && found.iter().all(|one| one.1.is_some()), "{names:?}: {found:?}");
        }
        // Widths below 90 look like angles all the more.
        let widths = asked(&[("venetian_50.xml", "", 0.5), ("venetian_80.xml", "", 0.4)]);
        assert_eq!(widths, [(vec![0, 1], Some(Ambiguity::NumbersAlone))]);
        // A unit says that it is none, degrees that it is one.
        assert_eq!(asked(&[("slat_60mm.xml", "", 0.5), ("slat_80mm.xml", "", 0.4)]).len(), 2);
        for names in [["slat 1deg.xml", "slat 2deg.xml"], ["rot0.xml", "rot90.xml"], ["slat15.xml", "slat60.xml"]] {
            assert_eq!(asked(&names.map(|name| (name, "", 0.5))), [(vec![0, 1], None)], "{names:?}");
        }
        // Samples, contents of fabrics and article numbers raise no question.
        for names in [
            ["s1.xml", "s2.xml", "s3.xml"],
            ["cl_0.6.xml", "cl_0.7.xml", "cl_0.9.xml"],
            ["5pct.xml", "10pct.xml", "30pct.xml"],
        ] {
            assert!(asked(&names.map(|name| (name, "", 0.5))).iter().all(|one| one.1.is_none()), "{names:?}");
        }
    }
}
