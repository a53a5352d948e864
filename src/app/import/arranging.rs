//! Creation of the products of an import from files that were read, and changes of the arrangement of files into
//! products.

use super::proposal::{Import, ImportFields, KeptImport, Proposed, StateWords, file_id};
use crate::app::catalogue::shelf::Shelf;
use crate::app::results::work::Outcome;
use crate::app::shell::error::AppError;
use crate::catalogue::{Ambiguity, Gathered, Grouping, Known, NewProduct, SourceFile, content_of, gathered, propose};
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{examine_all, repaired_all};
use crate::compute::estimate::Progress;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Files of one proposed product, by their indices in the import.
struct Part {
    files: Vec<usize>,
    angles: Option<Vec<f64>>,
    ambiguity: Option<Ambiguity>,
    /// Name of an earlier file with the same data, if there is one.
    same_as: Option<String>,
}

/// Returns the groups of files that form a product each, by their names and contents. A file with the same data as an
/// earlier one is a separate group.
fn proposed(sources: &[Arc<SourceFile>], places: &[usize], grouping: Grouping) -> Vec<Part> {
    let mut first: HashMap<(&str, Vec<&str>), usize> = HashMap::new();
    let mut own = Vec::new();
    let mut list = Vec::new();
    for &place in places {
        let file = &sources[place];
        // What names its states itself may well have two of the same data.
        let states: Vec<&str> = file.datasets.iter().map(|dataset| dataset.state.as_str()).collect();
        let content = (file.content.as_str(), states);
        match first.get(&content).filter(|_| !file.content.is_empty()) {
            Some(&other) => list.push(Part {
                files: vec![place],
                angles: None,
                ambiguity: None,
                same_as: Some(sources[other].name.clone()),
            }),
            None => {
                first.insert(content, place);
                own.push(place);
            }
        }
    }
    let files: Vec<&SourceFile> = own.iter().map(|&place| &*sources[place]).collect();
    list.extend(propose(&files, grouping).into_iter().map(|one| Part {
        files: one.files.into_iter().map(|place| own[place]).collect(),
        angles: one.angles,
        ambiguity: one.ambiguity,
        same_as: None,
    }));
    list
}

/// Returns the groups of files that form a product each: those made by hand, and those that names and contents propose
/// for all other files.
fn parts(sources: &[Arc<SourceFile>], grouping: Grouping, by_hand: Option<&[Vec<String>]>) -> Vec<Part> {
    let Some(by_hand) = by_hand else {
        return proposed(sources, &(0..sources.len()).collect::<Vec<_>>(), grouping);
    };
    let places: HashMap<String, usize> =
        sources.iter().enumerate().map(|(place, file)| (file_id(file), place)).collect();
    let mut taken = vec![false; sources.len()];
    let mut list = Vec::new();
    // What would be asked without the hand is still asked of products that it did not touch.
    let mut untouched = proposed(sources, &(0..sources.len()).collect::<Vec<_>>(), grouping);
    for group in by_hand {
        // Missing files are left out; this was reported when they could not be read.
        let files: Vec<usize> =
            group.iter().filter_map(|id| places.get(id).copied()).filter(|&at| !taken[at]).collect();
        files.iter().for_each(|&place| taken[place] = true);
        let own: Vec<&SourceFile> = files.iter().map(|&place| &*sources[place]).collect();
        list.extend(propose(&own, Grouping::One).into_iter().map(|one| Part {
            files: one.files.iter().map(|&place| files[place]).collect(),
            // A single file names its state itself, if it does.
            angles: one.angles.filter(|_| files.len() > 1),
            ambiguity: None,
            same_as: None,
        }));
        let same = |one: &Part| one.files == files;
        if let (Some(own), Some(last)) = (untouched.iter().position(same), list.last_mut()) {
            *last = untouched.swap_remove(own);
        }
    }
    let rest: Vec<usize> = (0..sources.len()).filter(|&place| !taken[place]).collect();
    list.extend(proposed(sources, &rest, grouping));
    list
}

/// Context in which products are created from the files of an import.
pub struct Arranging<'a> {
    /// Catalogue, which may contain the same data already; `None` before it is open.
    pub shelf: Option<&'a dyn Shelf>,
    /// Products of the previous arrangement; those with the same files are reused.
    pub before: Vec<Proposed>,
    /// Texts and repairs of a session or draft for the same files, if there are any.
    pub kept: Option<&'a KeptImport>,
}

impl Arranging<'_> {
    /// Creates the products of an import from its files; `packed`: products that come from packages. Errors are added
    /// to the import.
    pub fn products(mut self, import: &mut Import, packed: Vec<Proposed>, progress: &dyn Progress) {
        let parts = parts(&import.sources, import.grouping, import.by_hand.as_deref());
        let mut list: Vec<(usize, Proposed)> = Vec::new();
        let (count, done) = (parts.len(), AtomicUsize::new(0));
        let mut fresh = Vec::new();
        for part in parts {
            let place = part.files.iter().min().copied().unwrap_or(0);
            let ids: Vec<String> = part.files.iter().map(|&place| file_id(&import.sources[place])).collect();
            match self.before.iter().position(|old| !old.packed && old.files == ids) {
                // The question may be another one in another company.
                Some(old) => {
                    let old = self.before.swap_remove(old);
                    list.push((place, Proposed { ambiguity: part.ambiguity, same_as: part.same_as, ..old }));
                }
                None => fresh.push((place, ids, part)),
            }
        }
        let sources = &import.sources;
        let made: Vec<(usize, Proposed)> = fresh
            .into_par_iter()
            .map(|(place, ids, part)| {
                let files: Vec<&SourceFile> = part.files.iter().map(|&place| &*sources[place]).collect();
                let product = of_files(&files, ids, part);
                progress.advance("checks", done.fetch_add(1, Ordering::Relaxed) + 1, count);
                (place, product)
            })
            .collect();
        let mut failures = Vec::new();
        for (place, mut product) in made {
            self.take_kept(&mut product, &mut failures);
            list.push((place, product));
        }
        list.sort_by_key(|(place, _)| *place);
        import.products = list.into_iter().map(|(_, product)| product).collect();
        for mut product in packed {
            self.take_kept(&mut product, &mut failures);
            import.products.push(product);
        }
        import.failures.extend(failures);
        for product in &mut import.products {
            // A catalogue that does not answer keeps nobody from adding: it will say so itself.
            product.known = self.shelf.map(|shelf| known(product, shelf)).unwrap_or_default();
            if product.files.iter().any(|file| import.answered.contains(file)) {
                product.ambiguity = None;
            }
        }
    }

    /// Restores the texts and repairs of a product that were stored for the same files.
    fn take_kept(&self, product: &mut Proposed, failures: &mut Vec<String>) {
        carry_over(&self.before, product);
        if let Some(kept) = self.kept.and_then(|kept| kept.products.iter().find(|kept| kept.is_about(product))) {
            product.fields = kept.fields.clone();
            product.add_anyway = kept.add_anyway;
            if kept.states.len() == product.states.len() {
                product.states.clone_from(&kept.states);
            }
            product.repairs = kept.made();
            if !product.repairs.is_empty() {
                match repaired(product) {
                    Ok(whole) => *product = whole,
                    Err(error) => {
                        product.repairs.clear();
                        failures.push(error.to_string());
                    }
                }
            }
        }
    }
}

/// Copies texts that were typed for the same files in the previous arrangement to a product: names and angles of
/// states, maker, kind, tags and author. The product's name is derived from its files.
fn carry_over(before: &[Proposed], product: &mut Proposed) {
    let holding = |file: &String| before.iter().find(|old| !old.packed && old.files.contains(file));
    if let Some(old) = product.files.first().and_then(holding) {
        let (new, old) = (&mut product.fields, &old.fields);
        new.manufacturer.clone_from(&old.manufacturer);
        new.kind.clone_from(&old.kind);
        new.tags.clone_from(&old.tags);
        new.author.clone_from(&old.author);
        new.license.clone_from(&old.license);
    }
    for (words, part) in product.states.iter_mut().zip(&product.parts) {
        let [file] = part.as_slice() else { continue };
        let Some(old) = holding(&product.files[*file]) else { continue };
        let place = old.files.iter().position(|other| *other == product.files[*file]);
        let state = old.parts.iter().position(|part| Some(part.as_slice()) == place.as_ref().map(std::slice::from_ref));
        if let Some(state) = state
            && old.states[state] != StateWords::of(&old.originals[state].state)
        {
            words.clone_from(&old.states[state]);
        }
    }
}

/// Copies texts and answers that the user has typed while a new arrangement was computed; `names`: names of the
/// products, by their files, at the time of the request.
pub fn catch_up(new: &mut Import, now: &Import, names: &[(Vec<String>, String)]) {
    new.answered.clone_from(&now.answered);
    for product in &mut new.products {
        if let Some(same) = now.products.iter().find(|one| one.files == product.files) {
            let (ambiguity, known) = (product.ambiguity.take(), std::mem::take(&mut product.known));
            *product = Proposed { ambiguity, known, same_as: product.same_as.take(), ..same.clone() };
        } else {
            carry_over(&now.products, product);
            let holding =
                product.files.first().and_then(|file| now.products.iter().find(|one| one.files.contains(file)));
            let typed =
                |one: &&Proposed| names.iter().any(|(files, name)| *files == one.files && *name != one.fields.name);
            if let Some(one) = holding.filter(typed) {
                product.fields.name.clone_from(&one.fields.name);
            }
        }
        if product.files.iter().any(|file| new.answered.contains(file)) {
            product.ambiguity = None;
        }
    }
}

/// Returns the products of the catalogue that contain all data of a proposed product.
fn known(product: &Proposed, shelf: &dyn Shelf) -> Vec<Known> {
    let mut list = shelf.products_from(&product.file_info.provenance.source_hash).unwrap_or_default();
    let mut holding: Option<Vec<Known>> = None;
    for content in &product.contents {
        let these = shelf.products_holding(content).unwrap_or_default();
        holding = Some(match holding {
            None => these,
            Some(before) => before.into_iter().filter(|one| these.contains(one)).collect(),
        });
    }
    for one in holding.into_iter().flatten() {
        if !list.contains(&one) {
            list.push(one);
        }
    }
    list
}

fn of_files(files: &[&SourceFile], ids: Vec<String>, part: Part) -> Proposed {
    let Gathered { meta, datasets, sources, parts, file_stem, .. } = gathered(files, part.angles.as_deref());
    let content = |(dataset, own): (&Dataset, &Vec<usize>)| match own.as_slice() {
        [one] if files[*one].datasets.len() == 1 && !files[*one].content.is_empty() => files[*one].content.clone(),
        _ => content_of(dataset),
    };
    let contents = datasets.iter().zip(&parts).map(content).collect();
    let mut product = of_datasets(meta, datasets, &file_stem);
    (product.files, product.contents, product.sources, product.parts) = (ids, contents, sources, parts);
    (product.ambiguity, product.same_as) = (part.ambiguity, part.same_as);
    product
}

/// Creates a proposed product from datasets and their metadata; `stem`: file name without extension.
fn of_datasets(meta: NewProduct, datasets: Vec<Dataset>, stem: &str) -> Proposed {
    let diagnoses = examine_all(&datasets);
    let datasets: Vec<_> = datasets.into_iter().map(Arc::new).collect();
    let fields = ImportFields {
        name: if meta.name.is_empty() { stem.to_owned() } else { meta.name.clone() },
        manufacturer: meta.manufacturer.clone(),
        kind: meta.kind.clone(),
        tags: meta.tags.join(", "),
        author: meta.provenance.author.clone(),
        license: meta.license.clone(),
    };
    Proposed {
        diagnoses,
        taus: taus(&datasets),
        states: datasets.iter().map(|dataset| StateWords::of(&dataset.state)).collect(),
        // Repairs always start from what the files hold, so that each can be taken back.
        originals: datasets.clone(),
        datasets,
        fields,
        file_info: meta,
        ..Proposed::default()
    }
}

/// Creates a proposed product from a product of a package.
pub fn of_package(package: &str, datasets: Vec<Dataset>, meta: NewProduct) -> Proposed {
    let id = format!("{package}#{}", meta.key.as_deref().unwrap_or(&meta.name));
    let contents = datasets.par_iter().map(content_of).collect();
    let sources = vec![package.to_owned(); datasets.len()];
    let parts = vec![Vec::new(); datasets.len()];
    let product = of_datasets(meta, datasets, package);
    Proposed { files: vec![id], packed: true, contents, sources, parts, ..product }
}

/// Creates the products of an import again after its arrangement has changed; products with the same files keep their
/// texts, repairs and answers.
pub fn rearranged(mut import: Import, shelf: Option<&dyn Shelf>, progress: &dyn Progress) -> Outcome {
    let before = std::mem::take(&mut import.products);
    let names = before.iter().map(|one| (one.files.clone(), one.fields.name.clone())).collect();
    let (packed, before): (Vec<_>, Vec<_>) = before.into_iter().partition(|product| product.packed);
    import.selected.clear();
    import.shown = None;
    import.folded.clear();
    import.arranging = false;
    Arranging { shelf, before, kept: None }.products(&mut import, packed, progress);
    Outcome::Rearranged(Box::new(import), names)
}

/// Returns the hemispherical visible transmittance of each dataset; `None` without a transmission.
fn taus(datasets: &[Arc<Dataset>]) -> Vec<Option<f64>> {
    let tau = |dataset: &Arc<Dataset>| Some(dataset.transmission_of_either_side()?.tau_hemispherical());
    datasets.iter().map(tau).collect()
}

/// Returns a product with its requested repairs applied to the original data of all states, and the results checked.
fn repaired(product: &Proposed) -> Result<Proposed, AppError> {
    let results: Result<Vec<Arc<Dataset>>, _> =
        product.originals.iter().map(|dataset| repaired_all(dataset, &product.repairs).map(Arc::new)).collect();
    let datasets = results?;
    let diagnoses = examine_all(&datasets);
    Ok(Proposed { diagnoses, taus: taus(&datasets), datasets, ..product.clone() })
}

/// Applies the requested repairs to all states of a product and checks the results, in a job.
pub fn repair_product(product: &Proposed) -> Outcome {
    Outcome::Repaired(product.files.clone(), repaired(product).map(Box::new))
}
