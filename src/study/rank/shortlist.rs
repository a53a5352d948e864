//! Ranked list, with everything that table, plot and texts display of it.

use super::list::List;
use super::table::{csv_text, ranked_table};
use crate::compute::estimate::Estimate;
use crate::compute::rank::{Place, Profile, difference, surely_above};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// Page of the ranking that is displayed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Page {
    /// Table of the products.
    #[default]
    Table,
    /// Plot of two objectives against each other.
    Plot,
    /// Objectives and their weights.
    Objectives,
}

/// Order of the rows in the table.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Sort {
    /// Score, falling.
    #[default]
    #[serde(rename = "Worth")]
    Score,
    /// Name, in alphabetical order.
    Name,
    /// Annual figure with this key, best value first.
    Figure(String),
}

/// Settings with which a ranking is displayed. Products and figures are given by their keys.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Look {
    /// Displayed page.
    pub page: Page,
    /// Words that the names of displayed products must contain.
    pub words: String,
    /// Whether only products on the Pareto front are displayed.
    pub front_only: bool,
    /// Whether excluded products are displayed too.
    pub excluded: bool,
    /// Order of the rows in the table.
    pub sort: Sort,
    /// Keys of the figures on the axes of the plot, horizontal and vertical; the first objectives if these keys do not
    /// exist.
    pub axes: [String; 2],
    /// Key of the product whose reasons are displayed.
    pub product: Option<String>,
    /// Key of the product with which it is compared; `None`: the best.
    pub against: Option<String>,
    /// Whether only those products are displayed that the search in the catalogue finds.
    pub in_search: bool,
    /// Index, from 0, of the aperture into which products are inserted; `None`: all that are filled from the catalogue.
    pub aperture: Option<usize>,
}

impl Look {
    /// Whether a product passes the filters of words, Pareto front and excluded products.
    pub fn shows(&self, entry: &Entry) -> bool {
        let (words, name) = (self.words.to_lowercase(), entry.name.to_lowercase());
        (entry.excluded.is_none() || self.excluded)
            && (entry.place == Some(Place::Front) || !self.front_only)
            && words.split_whitespace().all(|word| name.contains(word) || entry.product.contains(word))
    }
}

/// Product in a displayed ranking.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Key of the product in the catalogue.
    pub product: String,
    /// Name of the product.
    pub name: String,
    /// Annual figures in the order of the objectives; empty for an excluded product.
    pub figures: Vec<Estimate>,
    /// Score of the product with its error, 0 … 1.
    pub score: Estimate,
    /// Best and worst rank that are possible within the uncertainty, from 1.
    pub ranks: (usize, usize),
    /// Position relative to the Pareto front; `None` for an excluded product.
    pub place: Option<Place>,
    /// Reasons why the figures are less certain than their errors say; empty if there are none.
    pub approximate: Vec<String>,
    /// Whether the figures were computed with patch-averaged data so far, not yet in full.
    pub coarse: bool,
    /// Reason why the product is excluded; `None` if it is ranked.
    pub excluded: Option<String>,
}

/// Contribution of one objective to the difference between the scores of two products.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    /// Index of the objective in the list.
    pub objective: usize,
    /// Contribution to the difference of the scores; the contributions of all terms add up to the whole difference.
    pub score_difference: f64,
    /// Annual figures of both products, for this objective.
    pub figures: [f64; 2],
    /// Largest contributions to the difference of the figures, each with season, sun and zone.
    pub parts: Vec<(f64, [String; 3])>,
}

/// Reasons for the rank of a product, in comparison with another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Reason {
    /// Index of the other product in [`Shortlist::entries`].
    pub other: usize,
    /// Whether the scores do not differ by more than the uncertainty, so that it is not determined which product is
    /// better.
    pub open: bool,
    /// Difference between the score of the product and that of the other one.
    pub score_difference: f64,
    /// Contributions of the objectives to the difference, the largest first.
    pub terms: Vec<Term>,
}

/// Ranked list of products, ready to be displayed.
#[derive(Debug, Clone, PartialEq)]
pub struct Shortlist {
    /// List from which the ranking was made.
    pub list: List,
    /// Products by descending score, excluded ones last.
    pub entries: Vec<Entry>,
}

/// Maximum number of contributions to a difference that are stated, and minimum share of the difference that each must
/// have.
const PARTS: (usize, f64) = (2, 0.15);

impl Shortlist {
    /// Creates the ranking of a list by its objectives. `names`: names of the products by their keys; `coarse`: keys of
    /// those with figures by patch-averaged data so far.
    pub fn of(list: List, names: &BTreeMap<String, String>, coarse: &BTreeSet<String>) -> Self {
        let name = |product: &str| names.get(product).cloned().unwrap_or_else(|| product.to_owned());
        let (ranked, ranking) = (list.ranked(), list.ranking(&list.objectives));
        let mut entries: Vec<Entry> = ranking
            .order
            .iter()
            .map(|&k| {
                let ((row, found), one) = (ranked[k], &ranking.list[k]);
                Entry {
                    product: row.product.clone(),
                    name: name(&row.product),
                    figures: found.figures.clone(),
                    score: one.utility,
                    ranks: (one.ranks.first, one.ranks.last),
                    place: Some(one.place),
                    approximate: found.approximate.clone(),
                    coarse: coarse.contains(&row.product),
                    excluded: None,
                }
            })
            .collect();
        entries.extend(list.excluded().into_iter().map(|(row, reason)| Entry {
            product: row.product.clone(),
            name: name(&row.product),
            figures: Vec::new(),
            score: Estimate::exact(0.0),
            ranks: (0, 0),
            place: None,
            approximate: Vec::new(),
            coarse: false,
            excluded: Some(reason.to_owned()),
        }));
        Self { list, entries }
    }

    /// Returns a product of the ranking by its key.
    pub fn entry(&self, product: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.product == product)
    }

    /// Returns the products that are displayed, in their order.
    pub fn shown(&self, look: &Look) -> Vec<&Entry> {
        let mut rows: Vec<&Entry> = self.entries.iter().filter(|entry| look.shows(entry)).collect();
        match &look.sort {
            Sort::Score => {}
            Sort::Name => rows.sort_by_cached_key(|entry| (entry.excluded.is_some(), entry.name.to_lowercase())),
            Sort::Figure(key) => {
                let place = self.list.figures.iter().position(|figure| figure == key);
                if let Some((k, objective)) = place.and_then(|k| Some((k, self.list.objectives.get(k)?))) {
                    rows.sort_by(|a, b| match (a.figures.get(k), b.figures.get(k)) {
                        (Some(a), Some(b)) if objective.prefers(a.value, b.value) => Ordering::Less,
                        (Some(a), Some(b)) if objective.prefers(b.value, a.value) => Ordering::Greater,
                        (a, b) => a.is_none().cmp(&b.is_none()),
                    });
                }
            }
        }
        rows
    }

    /// Returns the reasons for a product's rank, in comparison with the product `against`, else with the best; for the
    /// best itself with the second.
    pub fn reason(&self, product: &str, against: Option<&str>) -> Option<Reason> {
        let place = |key: &str| self.entries.iter().position(|one| one.product == key && one.excluded.is_none());
        let own = place(product)?;
        let best = || (0..self.entries.len()).find(|&k| k != own && self.entries[k].excluded.is_none());
        let other = against.and_then(place).filter(|&k| k != own).or_else(best)?;
        let found = |k: usize| {
            let ranked = self.list.rows.iter().find(|row| row.product == self.entries[k].product);
            ranked.and_then(|row| row.outcome.as_ref().ok())
        };
        let (a, b) = (found(own)?, found(other)?);
        let objectives = &self.list.objectives;
        let profile = |found: &super::figures::Found| Profile {
            utilities: objectives.iter().zip(&found.figures).map(|(one, figure)| one.utility(figure.value)).collect(),
            figures: found.figures.iter().map(|figure| figure.value).collect(),
            parts: found.parts.iter().map(|parts| parts.values.clone()).collect(),
        };
        let why = difference(objectives, &profile(a), &profile(b));
        let mut terms: Vec<Term> = why
            .shares
            .iter()
            .enumerate()
            .map(|(objective, share)| {
                let figures = [a.figures[objective].value, b.figures[objective].value];
                let mut parts: Vec<(f64, [String; 3])> = share
                    .parts
                    .iter()
                    .enumerate()
                    .filter(|(_, part)| **part * share.figure > 0.0 && part.abs() >= PARTS.1 * share.figure.abs())
                    .map(|(k, part)| (*part, a.parts[objective].name(k).map(str::to_owned)))
                    .collect();
                parts.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
                parts.truncate(PARTS.0);
                Term { objective, score_difference: share.utility, figures, parts }
            })
            .collect();
        terms.sort_by(|a, b| b.score_difference.abs().total_cmp(&a.score_difference.abs()));
        let [x, y] = [own, other].map(|k| self.entries[k].score);
        Some(Reason { other, open: !surely_above(x, y) && !surely_above(y, x), score_difference: why.utility, terms })
    }

    /// Returns the ranking as a CSV table, as `cfs rank --out` writes it.
    pub fn csv(&self) -> String {
        csv_text(&ranked_table(std::slice::from_ref(&self.list), &self.list.figures))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::rank::{Better, Objective};
    use crate::study::rank::{Found, Parts, Row};

    /// Products with energy (less is better, 0 to 10) and light (more is better, 0 to 1), in seasons of one zone.
    fn shortlist(weights: [f64; 2]) -> Shortlist {
        let parts = |sum: f64| {
            let mut values = vec![0.0; 8];
            (values[0], values[5]) = (0.75 * sum, 0.25 * sum);
            Parts { zones: vec!["room".to_owned()], values }
        };
        let row = |key: &str, energy: f64, light: f64| Row {
            product: key.to_owned(),
            key: key.to_owned(),
            outcome: Ok(Found {
                figures: vec![Estimate::new(energy, 0.1), Estimate::new(light, 0.01)],
                parts: vec![parts(energy), Parts::default()],
                approximate: Vec::new(),
            }),
        };
        let objective = |better, worst, best, weight| Objective { better, worst, best, weight };
        let broken = Row { product: "x".to_owned(), key: String::new(), outcome: Err("no data".to_owned()) };
        let list = List {
            number: 0,
            scene: "s".to_owned(),
            climate: "c".to_owned(),
            azimuth: 180.0,
            figures: vec!["energy".to_owned(), "light".to_owned()],
            objectives: vec![
                objective(Better::Less, 10.0, 0.0, weights[0]),
                objective(Better::More, 0.0, 1.0, weights[1]),
            ],
            rows: vec![row("a", 2.0, 0.3), row("b", 6.0, 0.9), row("c", 6.0, 0.25), broken],
        };
        let names = [("a", "Slats, white"), ("b", "Pane"), ("c", "Screen")];
        let names = names.map(|(key, name)| (key.to_owned(), name.to_owned())).into();
        Shortlist::of(list, &names, &BTreeSet::from(["c".to_owned()]))
    }

    fn order(list: &Shortlist, look: &Look) -> String {
        list.shown(look).iter().map(|entry| entry.product.as_str()).collect()
    }

    #[test]
    fn weights_order_and_looks_filter_and_sort() {
        let plain = Look::default();
        assert_eq!(
            (order(&shortlist([1.0, 1.0]), &plain), order(&shortlist([4.0, 1.0]), &plain)),
            ("bac".into(), "abc".into())
        );
        let list = shortlist([1.0, 1.0]);
        let with = |change: fn(&mut Look)| {
            let mut look = Look::default();
            change(&mut look);
            order(&list, &look)
        };
        assert_eq!(with(|look| look.excluded = true), "bacx");
        assert_eq!(with(|look| look.front_only = true), "ba");
        assert_eq!(with(|look| look.words = "white SLATS".to_owned()), "a");
        assert_eq!(with(|look| look.sort = Sort::Name), "bca");
        assert_eq!(with(|look| look.sort = Sort::Figure("energy".to_owned())), "abc");
        assert!(list.entries[2].coarse && !list.entries[0].coarse);
    }

    #[test]
    fn terms_add_up_and_go_against_any_other() {
        let list = shortlist([1.0, 1.0]);
        let against_best = list.reason("c", None).unwrap();
        assert_eq!((against_best.other, against_best.open), (0, false));
        let two = list.reason("a", Some("c")).unwrap();
        assert_eq!(list.entries[two.other].product, "c");
        let sum: f64 = two.terms.iter().map(|term| term.score_difference).sum();
        // (10 − 2)/10 − (10 − 6)/10 by energy, 0.05 by light, each counts a half.
        assert!((sum - two.score_difference).abs() < 1e-12 && (two.score_difference - 0.225).abs() < 1e-12, "{two:?}");
        let energy = &two.terms[0];
        assert_eq!((energy.objective, energy.figures), (0, [2.0, 6.0]));
        // Of −4 three quarters are in winter with sun.
        assert!(
            (energy.parts[0].0 + 3.0).abs() < 1e-12 && energy.parts[0].1 == ["winter", "sun", "room"],
            "{energy:?}"
        );
        assert_eq!(energy.parts.len(), 2);
        // The best against the second; what is left out against nothing.
        assert_eq!(list.reason("b", None).unwrap().other, 1);
        assert_eq!((list.reason("x", None), list.reason("a", Some("x")).unwrap().other), (None, 0));
    }

    #[test]
    fn the_table_has_every_product_and_as_many_fields_in_every_row() {
        let csv = shortlist([1.0, 1.0]).csv();
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        let head = reader.headers().unwrap().clone();
        assert_eq!((&head[0], &head[4], &head[5], head.len()), ("scene", "energy", "energy_error", 4 + 4 + 8));
        let rows: Vec<csv::StringRecord> = reader.records().collect::<Result<_, _>>().unwrap();
        let products: Vec<&str> = rows.iter().map(|row| &row[3]).collect();
        assert_eq!(products, ["b", "a", "c", "x"]);
        assert_eq!((&rows[3][14], &rows[0][10]), ("no data", "1"));
    }
}
