//! Search index in memory: every word of every product, and with every answer the counts of the values that could be
//! chosen next.
//!
//! A typed word is compared with all different words of the catalogue, not with all products: as the whole, the
//! beginning or (from three letters) a part of one; if there is no such word, as one with a typing error or two.
//! Separately written words are also found written together ("lasercut"). A match is weighted by its place (name before
//! kind before tags before description) and by how well it fits.

use super::ProductRow;
use super::index_words::{Numbered, place, places, words_of};
use super::like::{Likeness, ProductDistance};
use super::query::{Figure, Filter, Query, Sort};
use super::query_facets::{Facet, Facets};
use super::rows::Sought;
use super::words::{self, distance, forgiven, letters, without_written_marks};
use crate::texts::{ascii_words, folded, is_syllable};
use std::sync::Arc;

/// Result of a search in the catalogue.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Found {
    /// Found products, in the requested order.
    pub entries: Vec<Arc<ProductRow>>,
    /// Number of visible products in the whole catalogue, found or not.
    pub total: usize,
    /// Values by which the search can be narrowed, each with the number of products that it would leave.
    pub facets: Facets,
    /// Filters and single words whose removal from the query would give results, each with the number of products.
    /// Empty unless nothing was found.
    pub without: Vec<(Filter, usize)>,
    /// Typed words that occur nowhere in the catalogue, each with the similar word that was searched for instead.
    pub read_as: Vec<(String, String)>,
    /// Length of the longest name among the found products, in characters.
    pub longest_name: usize,
    /// Keys of the products that are not listed because they are damaged.
    pub damaged: Vec<String>,
    /// Keys of the built-in products that were damaged, and restored since the catalogue was opened.
    pub restored: Vec<String>,
    /// Distances of the found products from the product named in [`Query::like`]; `None` if the query names none, or
    /// the catalogue does not contain it.
    pub like: Option<Likeness>,
}

/// Factor on the weight of a match in words joined from neighbours, relative to a match in a single word.
const JOINED: f32 = 0.9;
/// Minimum length of a typed word that is also searched for inside words, in characters.
const SHORTEST_PART: usize = 3;

/// Word that occurs in products of the catalogue.
#[derive(Debug)]
struct Word {
    text: String,
    /// Set of the letters and digits of the word, one bit each.
    letters: u64,
    length: usize,
    /// Indices of the products that contain the word, each with the weight of the most important field in which it
    /// occurs.
    products: Vec<(u32, f32)>,
}

/// Product in the index; texts are given by their numbers.
#[derive(Debug)]
struct Item {
    row: Arc<ProductRow>,
    kind: usize,
    manufacturer: usize,
    tags: Vec<usize>,
    collections: Vec<usize>,
    /// Positions of the product when all products are sorted by name, by maker and by kind.
    order: [usize; 3],
    /// Addition to the score for products with short names, which precede those with longer ones that match equally
    /// well.
    brevity: f32,
}

/// Search index of all products with their words, which answers any number of queries.
#[derive(Debug, Default)]
pub struct Index {
    items: Vec<Item>,
    words: Vec<Word>,
    kinds: Vec<String>,
    manufacturers: Vec<String>,
    tags: Vec<String>,
    collections: Vec<String>,
    /// Keys of products that are not listed because they are damaged.
    pub(super) damaged: Vec<String>,
    /// Keys of built-in products that were damaged and have been restored.
    pub(super) restored: Vec<String>,
}

/// Quality of the match of each product with the typed words.
struct Fit {
    /// Sum of the weights of the matches over all words; also set for products that lack a word.
    score: Vec<f32>,
    /// Number of the query's words that each product lacks, and the position of the last of them in the query.
    lacks: Vec<(u16, usize)>,
    read_as: Vec<(String, String)>,
}

impl Index {
    /// Creates the index of a list of products. Products that match equally well stay in the order of the list.
    pub fn new(products: Vec<Sought>) -> Self {
        let mut all = Numbered::default();
        let mut found_in: Vec<Vec<(u32, f32)>> = Vec::new();
        let [mut kinds, mut manufacturers, mut tags, mut collections] = [(); 4].map(|()| Numbered::default());
        let order = [
            places(&products, |product| folded(&product.row.name)),
            places(&products, |product| folded(&product.row.manufacturer)),
            places(&products, |product| folded(&product.row.kind)),
        ];
        let mut items = Vec::with_capacity(products.len());
        for (number, product) in products.into_iter().enumerate() {
            let row = &product.row;
            let mut put = |text: &str, weight: f32, join: bool| {
                words_of(text, join, &mut |word, joined| {
                    let at = all.of(word);
                    if at == found_in.len() {
                        found_in.push(Vec::new());
                    }
                    let weight = if joined { JOINED * weight } else { weight };
                    match found_in[at].last_mut() {
                        Some((last, best)) if *last as usize == number => *best = best.max(weight),
                        _ => found_in[at].push((number as u32, weight)),
                    }
                });
            };
            put(&row.name, place::NAME, true);
            put(&row.kind, place::KIND, true);
            put(&row.manufacturer, place::MAKER, true);
            put(&row.key, place::KEY, true);
            // Who cannot type the script of a name types how it sounds.
            [&row.name, &row.manufacturer].into_iter().filter(|text| !text.is_ascii()).for_each(|text| {
                put(&ascii_words(text), place::KEY, true);
            });
            put(words::german(&row.kind), place::GERMAN, false);
            for tag in &product.tags {
                put(tag, place::TAG, true);
                put(words::german(tag), place::GERMAN, false);
            }
            put(&product.description, place::DESCRIPTION, false);
            items.push(Item {
                kind: kinds.of(&row.kind),
                manufacturer: manufacturers.of(&row.manufacturer),
                tags: product.tags.iter().map(|tag| tags.of(tag)).collect(),
                collections: product.collections.iter().map(|name| collections.of(name)).collect(),
                order: [order[0][number], order[1][number], order[2][number]],
                brevity: 0.5 / (1.0 + row.name.split_whitespace().count() as f32),
                row: product.row,
            });
        }
        let word = |(text, products): (String, Vec<(u32, f32)>)| {
            let spelt: Vec<char> = text.chars().collect();
            Word { letters: letters(&spelt), length: spelt.len(), text, products }
        };
        let words = all.texts.into_iter().zip(found_in).map(word).collect();
        let [kinds, manufacturers, tags, collections] = [kinds, manufacturers, tags, collections].map(|all| all.texts);
        Self { items, words, kinds, manufacturers, tags, collections, damaged: Vec::new(), restored: Vec::new() }
    }

    /// Returns the answer to a query.
    pub fn find(&self, query: &Query) -> Found {
        let fit = self.fit(query);
        let misses: Vec<u16> = (0..self.items.len()).map(|number| self.misses(query, &fit, number)).collect();
        let mut order: Vec<usize> = (0..self.items.len()).filter(|number| misses[*number] == 0).collect();
        self.sort(&mut order, query, &fit);
        let like = query.like.as_deref().and_then(|key| self.like(key, &mut order, query));
        let entries: Vec<Arc<ProductRow>> = order.into_iter().map(|number| self.items[number].row.clone()).collect();
        let without = if entries.is_empty() { self.without(query, &fit, &misses) } else { Vec::new() };
        Found {
            longest_name: entries.iter().map(|row| row.name.chars().count()).max().unwrap_or(0),
            total: self.items.len(),
            facets: self.facets(query, &misses),
            damaged: self.damaged.clone(),
            restored: self.restored.clone(),
            entries,
            like,
            without,
            read_as: fit.read_as,
        }
    }

    /// Computes how well each product matches the words of a query, and which words it lacks.
    fn fit(&self, query: &Query) -> Fit {
        let count = self.items.len();
        let mut fit = Fit { score: vec![0.0; count], lacks: vec![(0, 0); count], read_as: Vec::new() };
        let typed = query.typed_words();
        let mut own = vec![0.0_f32; count];
        let mut last = None;
        let mut lacking = vec![false; count];
        for (place, word) in &typed {
            if last != Some(*place) {
                lacking.fill(false);
                last = Some(*place);
            }
            own.fill(0.0);
            let (matches, read_as) = self.matches(word);
            for (at, quality) in matches {
                for (product, weight) in &self.words[at].products {
                    let best = &mut own[*product as usize];
                    *best = best.max(quality * weight);
                }
            }
            fit.read_as.extend(read_as.map(|read_as| (word.clone(), read_as)));
            for number in 0..count {
                fit.score[number] += own[number];
                if own[number] == 0.0 && !std::mem::replace(&mut lacking[number], true) {
                    fit.lacks[number] = (fit.lacks[number].0 + 1, *place);
                }
            }
        }
        if !typed.is_empty() {
            fit.score.iter_mut().zip(&self.items).for_each(|(score, item)| *score += item.brevity);
        }
        fit
    }

    /// Returns the words of the catalogue that match a typed one, by their indices, each with the quality of the match,
    /// up to 1. Returns also the similar word that was searched for instead, if the typed one occurs nowhere.
    fn matches(&self, typed: &str) -> (Vec<(usize, f32)>, Option<String>) {
        let spelt: Vec<char> = typed.chars().collect();
        let plain = without_written_marks(typed).map(|plain| (letters(&plain.chars().collect::<Vec<char>>()), plain));
        let own = letters(&spelt);
        // Scripts without blanks between words, as Chinese, have words of one character.
        let is_part = spelt.len() >= SHORTEST_PART || spelt.iter().any(|letter| is_syllable(*letter));
        let quality = |word: &str, typed: &str| {
            if word == typed {
                Some(1.0)
            } else if word.starts_with(typed) {
                Some(0.7 + 0.2 * typed.len() as f32 / word.len() as f32)
            } else {
                (is_part && word.contains(typed)).then_some(0.45)
            }
        };
        // Most words lack a letter of the typed one: those need no look.
        let looked_at = |word: &Word, letters: u64, typed: &str| {
            if letters & !word.letters == 0 { quality(&word.text, typed) } else { None }
        };
        let fits = |word: &Word| {
            let plainly = || plain.as_ref().and_then(|(letters, plain)| looked_at(word, *letters, plain));
            looked_at(word, own, typed).or_else(plainly)
        };
        let found: Vec<(usize, f32)> =
            self.words.iter().enumerate().filter_map(|(at, word)| Some((at, fits(word)?))).collect();
        if !found.is_empty() {
            return (found, None);
        }
        let most = forgiven(&spelt);
        if most == 0 {
            return (found, None);
        }
        let near = |(at, word): (usize, &Word)| {
            let foreign = (own & !word.letters).count_ones() as usize > most;
            if foreign || word.length + most < spelt.len() {
                return None;
            }
            let errors = distance(&spelt, &word.text.chars().collect::<Vec<char>>(), most)?;
            Some((at, errors, word.length.abs_diff(spelt.len())))
        };
        let near: Vec<(usize, usize, usize)> = self.words.iter().enumerate().filter_map(near).collect();
        // The one that is most likely meant: fewest errors, nearest in length, in most products.
        let meant = near.iter().min_by_key(|(at, errors, longer)| {
            (*errors, *longer, usize::MAX - self.words[*at].products.len(), &self.words[*at].text)
        });
        let read_as = meant.map(|(at, ..)| self.words[*at].text.clone());
        let weight = |errors: usize, longer: usize| 0.3 - 0.05 * errors as f32 - if longer > 2 { 0.05 } else { 0.0 };
        (near.into_iter().map(|(at, errors, longer)| (at, weight(errors, longer))).collect(), read_as)
    }

    /// Returns the filters of the query that a product does not pass, one bit each.
    fn misses(&self, query: &Query, fit: &Fit, number: usize) -> u16 {
        let row = &*self.items[number].row;
        let in_list = |list: &[String], value: &str| list.is_empty() || list.iter().any(|one| one == value);
        let passes = |filter: Filter| match filter {
            Filter::Words | Filter::Word(_) => fit.lacks[number].0 == 0,
            Filter::Kinds => in_list(&query.kinds, &row.kind),
            Filter::Manufacturers => in_list(&query.manufacturers, &row.manufacturer),
            Filter::Tags => {
                let own = &self.items[number].tags;
                query.tags.iter().all(|tag| own.iter().any(|at| self.tags[*at] == *tag))
            }
            Filter::Collections => {
                let own = &self.items[number].collections;
                query.collections.is_empty() || own.iter().any(|at| query.collections.contains(&self.collections[*at]))
            }
            Filter::Recent => !query.recent || query.shown.contains(&row.key),
            Filter::Favourite => query.favourite.is_none_or(|favourite| row.favourite == favourite),
            Filter::Origin => query.origin.is_none_or(|origin| row.origin == origin),
            Filter::Builtin => query.builtin.is_none_or(|builtin| row.builtin == builtin),
            Filter::Moving => query.moving.is_none_or(|moving| row.moves() == moving),
            Filter::Range(figure) => {
                let mut ranges = query.ranges.iter().filter(|range| range.figure == figure).peekable();
                ranges.peek().is_none()
                    || row.figure(figure).is_some_and(|value| ranges.any(|range| range.holds(value)))
            }
        };
        Filter::all().enumerate().fold(0, |bits, (bit, filter)| bits | u16::from(!passes(filter)) << bit)
    }

    /// Sorts product indices in the order that the query requests; products without a value of the sorting criterion
    /// come last.
    fn sort(&self, order: &mut [usize], query: &Query, fit: &Fit) {
        let item = |number: &usize| &self.items[*number];
        match query.sort {
            // What was shown last first, where nothing was typed.
            Sort::Match if query.recent && !query.has(Filter::Words) => {
                order.sort_by_key(|number| query.shown.iter().position(|key| *key == item(number).row.key));
            }
            // Equally good ones stay in the catalogue's order.
            Sort::Match => order.sort_by(|a, b| fit.score[*b].total_cmp(&fit.score[*a])),
            Sort::Name => order.sort_by_key(|number| item(number).order[0]),
            Sort::Maker => order.sort_by_key(|number| (item(number).order[1], item(number).order[0])),
            Sort::Kind => order.sort_by_key(|number| (item(number).order[2], item(number).order[0])),
            Sort::States => order.sort_by_key(|number| item(number).row.states.len()),
            Sort::By(figure) => {
                let value = |number: &usize| item(number).row.figure(figure).unwrap_or(f64::NAN);
                order.sort_by(|a, b| value(a).total_cmp(&value(b)));
            }
        }
        if query.descending {
            order.reverse();
        }
        // What has no value has no place in an order: at the end, whichever way.
        match query.sort {
            Sort::By(figure) => order.sort_by_key(|number| item(number).row.figure(figure).is_none()),
            Sort::Maker => order.sort_by_key(|number| item(number).row.manufacturer.is_empty()),
            Sort::Kind => order.sort_by_key(|number| item(number).row.kind.is_empty()),
            Sort::Match | Sort::Name | Sort::States => {}
        }
    }

    /// Sorts products by their distance from the product with the key `key`, nearest at the top unless the query
    /// requests another order, and returns the distances. Leaves out that product itself and those without a known
    /// distance.
    fn like(&self, key: &str, order: &mut Vec<usize>, query: &Query) -> Option<Likeness> {
        let other = &self.items.iter().find(|item| item.row.key == key)?.row;
        let of = |number: usize| {
            let row = &self.items[number].row;
            if row.key == key { None } else { Some((number, ProductDistance::of(row, other)?)) }
        };
        let mut list: Vec<(usize, ProductDistance)> = order.iter().filter_map(|number| of(*number)).collect();
        if query.sort == Sort::Match {
            list.sort_by(|a, b| a.1.distance.total_cmp(&b.1.distance));
            if query.descending {
                list.reverse();
            }
        }
        let distances;
        (*order, distances) = list.into_iter().unzip();
        Some(Likeness { key: key.to_owned(), name: other.name.clone(), distances })
    }

    /// Counts for each value of each filter the products that would be found if it were chosen. `misses`: filters that
    /// each product does not pass.
    fn facets(&self, query: &Query, misses: &[u16]) -> Facets {
        let counted = |filter: Filter| {
            let bit = bit(filter);
            self.items.iter().zip(misses).filter(move |(_, misses)| **misses & !bit == 0).map(|(item, _)| item)
        };
        let list = |texts: &[String], counts: Vec<usize>, chosen: &[String], empty: bool| {
            let shown =
                |(text, count): &(&String, usize)| (*count > 0 || chosen.contains(text)) && (empty || !text.is_empty());
            let mut list: Vec<Facet> = texts
                .iter()
                .zip(counts)
                .filter(shown)
                .map(|(value, count)| Facet { value: value.clone(), count })
                .collect();
            list.sort_by(|a, b| b.count.cmp(&a.count).then_with(|| a.value.cmp(&b.value)));
            list
        };
        let tally = |filter: Filter, texts: &[String], of: fn(&Item) -> usize| {
            let mut counts = vec![0; texts.len()];
            counted(filter).for_each(|item| counts[of(item)] += 1);
            counts
        };
        let kinds = tally(Filter::Kinds, &self.kinds, |item| item.kind);
        let makers = tally(Filter::Manufacturers, &self.manufacturers, |item| item.manufacturer);
        // All chosen tags must hold: another one is counted among those that have them.
        let tags = vec![0; self.tags.len()];
        let tags =
            self.items.iter().zip(misses).filter(|(_, misses)| **misses == 0).fold(tags, |mut tags, (item, _)| {
                item.tags.iter().for_each(|at| tags[*at] += 1);
                tags
            });
        let mut in_collections = vec![0; self.collections.len()];
        for item in counted(Filter::Collections) {
            item.collections.iter().for_each(|at| in_collections[*at] += 1);
        }
        let mut origins = Vec::new();
        for origin in [super::Origin::Measured, super::Origin::Computed, super::Origin::Unknown] {
            let count = counted(Filter::Origin).filter(|item| item.row.origin == origin).count();
            if count > 0 || query.origin == Some(origin) {
                origins.push(Facet { value: origin.word().to_owned(), count });
            }
        }
        let known = |figure: &Figure| self.items.iter().any(|item| item.row.figure(*figure).is_some());
        let ranges = Figure::ALL.into_iter().filter(known).map(|figure| {
            let mut counts = vec![0; Figure::LIMITS.len()];
            for value in counted(Filter::Range(figure)).filter_map(|item| item.row.figure(figure)) {
                if let Some(place) = (0..counts.len()).find(|place| figure.range(*place).holds(value)) {
                    counts[place] += 1;
                }
            }
            (figure, counts)
        });
        Facets {
            kinds: list(&self.kinds, kinds, &query.kinds, true),
            manufacturers: list(&self.manufacturers, makers, &query.manufacturers, false),
            tags: list(&self.tags, tags, &query.tags, false),
            collections: list(&self.collections, in_collections, &query.collections, false),
            recent: counted(Filter::Recent).filter(|item| query.shown.contains(&item.row.key)).count(),
            origins,
            moving: [true, false]
                .map(|moving| counted(Filter::Moving).filter(|item| item.row.moves() == moving).count()),
            ranges: ranges.collect(),
            favourites: counted(Filter::Favourite).filter(|item| item.row.favourite).count(),
            builtin: counted(Filter::Builtin).filter(|item| item.row.builtin).count(),
            own: counted(Filter::Builtin).filter(|item| !item.row.builtin).count(),
            all: self.items.len(),
        }
    }

    /// Returns, for each filter and each word of the query, the number of products that would be found without it,
    /// largest number at the top.
    fn without(&self, query: &Query, fit: &Fit, misses: &[u16]) -> Vec<(Filter, usize)> {
        let mut list: Vec<(Filter, usize)> = Filter::all()
            .filter(|filter| query.has(*filter))
            .map(|filter| (filter, misses.iter().filter(|misses| **misses & !bit(filter) == 0).count()))
            .collect();
        let places = query.text.split_whitespace().count();
        let lacks_only = |place: usize| {
            let other = !bit(Filter::Words);
            let all = misses.iter().zip(&fit.lacks);
            all.filter(|(misses, lacks)| **misses & other == 0 && (lacks.0 == 0 || **lacks == (1, place))).count()
        };
        if places > 1 {
            list.extend((0..places).map(|place| (Filter::Word(place), lacks_only(place))));
        }
        list.retain(|(_, count)| *count > 0);
        list.sort_by_key(|one| std::cmp::Reverse(one.1));
        list
    }
}

/// Returns the bit that represents a filter in the result of [`Index::misses`].
fn bit(filter: Filter) -> u16 {
    Filter::all().position(|one| one == filter).map_or(0, |place| 1 << place)
}
