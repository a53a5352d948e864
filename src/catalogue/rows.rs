//! Products as lists show them, read out of the tables: the one place that knows which columns they come from.

use super::query::Figure;
use super::representative::{FirstRule, Numbers, representative};
use super::sight::IN_SIGHT;
use super::verified::damaged_products;
use super::{CatalogueError, CurvePoint, Origin};
use rusqlite::{Connection, Row};
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// Places of figures among the columns of a state as they are verified.
const COLUMNS: [(Figure, usize); 5] = [
    (Figure::TauNormal, 6),
    (Figure::TauHemispherical, 7),
    (Figure::ToCeiling, 9),
    (Figure::SunBlocked, 10),
    (Figure::View, 11),
];

/// A product as lists show it. Figures are those of the state that stands for it, see
/// [`representative`](super::representative()).
#[derive(Debug, Clone, PartialEq)]
pub struct ProductRow {
    /// Key by which scenes name it.
    pub key: String,
    /// Name.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Kind; may be empty.
    pub kind: String,
    /// Measured or computed.
    pub origin: Origin,
    /// Keys of the states in order; one empty key for a product without states.
    pub states: Vec<String>,
    /// Place of the state that stands for the product.
    pub representative: usize,
    /// Hash of the dataset of that state; `None` while it is still to be computed.
    pub dataset: Option<Arc<str>>,
    /// The rule by which it works when nobody has said otherwise.
    pub rule: FirstRule,
    /// Visible transmittance of light from outside at normal incidence.
    pub tau_normal: Option<f64>,
    /// The same under uniform luminance.
    pub tau_hemispherical: Option<f64>,
    /// The same at the profile angles [`PROFILE_ANGLES`](super::PROFILE_ANGLES), from light from below to light from
    /// above; empty when unknown.
    pub tau_profile: Vec<f64>,
    /// Share of the transmitted light that goes to the ceiling, where it is known.
    pub to_ceiling: Option<f64>,
    /// Share of direct sun that is kept out, where it is known.
    pub sun_blocked: Option<f64>,
    /// How much of the view is left, where it is known.
    pub view: Option<f64>,
    /// Marked by the user.
    pub favourite: bool,
    /// Comes with the program.
    pub builtin: bool,
    /// The folder of packages that it comes from, which is subscribed to; empty for others.
    pub subscribed: String,
}

impl ProductRow {
    /// A figure of the state that stands for the product.
    pub const fn figure(&self, figure: Figure) -> Option<f64> {
        match figure {
            Figure::TauNormal => self.tau_normal,
            Figure::TauHemispherical => self.tau_hemispherical,
            Figure::ToCeiling => self.to_ceiling,
            Figure::SunBlocked => self.sun_blocked,
            Figure::View => self.view,
        }
    }

    /// Has it more than one state?
    pub const fn moves(&self) -> bool {
        self.states.len() > 1
    }

    /// Key of the state that stands for it; empty for a product without states.
    pub fn state(&self) -> &str {
        self.states.get(self.representative).map_or("", String::as_str)
    }
}

/// A product with what it is found by beside its row.
#[derive(Debug, Clone)]
pub struct Sought {
    /// What lists show.
    pub row: Arc<ProductRow>,
    /// Free text.
    pub description: String,
    /// Words to find it by.
    pub tags: Vec<String>,
    /// Collections that it is in.
    pub collections: Vec<String>,
}

/// A state while it is read.
struct StateRow {
    key: String,
    numbers: Numbers,
    figures: [Option<f64>; COLUMNS.len()],
    profile: String,
    dataset: Option<Arc<str>>,
}

/// Lists of the products by their ids.
#[derive(Default)]
struct Lists {
    states: HashMap<i64, Vec<StateRow>>,
    curves: HashMap<i64, Vec<CurvePoint>>,
    tags: HashMap<i64, Vec<String>>,
    collections: HashMap<i64, Vec<String>>,
    /// Products with values that are not of their columns' types.
    unreadable: BTreeSet<i64>,
}

impl Lists {
    /// Takes a row on the way of its verification.
    fn take(&mut self, table: &str, product: i64, row: &Row<'_>) -> rusqlite::Result<()> {
        match table {
            "state" => {
                let mut figures = [None; COLUMNS.len()];
                for (figure, (_, column)) in figures.iter_mut().zip(COLUMNS) {
                    *figure = row.get(column)?;
                }
                let numbers = Numbers { value: row.get(4)?, tau_hemispherical: figures[1] };
                let (key, profile, dataset) = (row.get(2)?, row.get(8)?, row.get(5)?);
                let state = StateRow { key, numbers, figures, profile, dataset };
                self.states.entry(product).or_default().push(state);
            }
            "control_point" => {
                let point = CurvePoint { profile_angle: row.get(2)?, value: row.get(3)? };
                self.curves.entry(product).or_default().push(point);
            }
            "tag" => self.tags.entry(product).or_default().push(row.get(1)?),
            _ => {}
        }
        Ok(())
    }
}

/// Returns the products that are as they were stored, in the catalogue's order – built-in ones first in their own, then
/// the user's by name – and the keys of the damaged ones.
pub(super) fn read(db: &Connection) -> Result<(Vec<Sought>, Vec<String>), CatalogueError> {
    let mut lists = Lists::default();
    let mut damaged = damaged_products(db, &mut |table, product, row| {
        if lists.take(table, product, row).is_err() {
            lists.unreadable.insert(product);
        }
    })?;
    damaged.append(&mut lists.unreadable);
    let mut collections =
        db.prepare("SELECT p.id, c.name FROM collection c JOIN product p ON p.key = c.product_key ORDER BY 1, 2")?;
    let mut rows = collections.query([])?;
    while let Some(row) = rows.next()? {
        lists.collections.entry(row.get(0)?).or_default().push(row.get(1)?);
    }
    // Descriptions are read for those whose rule hangs on them alone: what moves and brings no curve. Keys last: products
    // of the same name keep their places from one search to the next.
    let mut statement = db.prepare(&format!(
        "SELECT p.id, p.key, p.name, p.manufacturer, p.kind, p.origin, p.builtin, p.description,
                EXISTS (SELECT 1 FROM favourite WHERE product_key = p.key),
                CASE WHEN EXISTS (SELECT 1 FROM control_point WHERE product = p.id)
                       OR NOT EXISTS (SELECT 1 FROM state WHERE product = p.id AND position = 1)
                     THEN '' ELSE p.system END,
                coalesce((SELECT folder FROM subscribed WHERE product_key = p.key), '')
         FROM product p WHERE 1{IN_SIGHT} ORDER BY p.builtin DESC, p.rank, p.name COLLATE NOCASE, p.key"
    ))?;
    let mut rows = statement.query([])?;
    let (mut list, mut left_out) = (Vec::new(), Vec::new());
    while let Some(row) = rows.next()? {
        let id: i64 = row.get(0)?;
        if damaged.contains(&id) {
            // Even the bytes of the key may be none of a text.
            left_out.push(String::from_utf8_lossy(row.get_ref(1)?.as_bytes().unwrap_or_default()).into_owned());
            continue;
        }
        let own = lists.states.remove(&id).unwrap_or_default();
        let curve = lists.curves.remove(&id).unwrap_or_default();
        let numbers: Vec<Numbers> = own.iter().map(|state| state.numbers).collect();
        let (rule, place) = representative(&numbers, &curve, row.get_ref(9)?.as_str().unwrap_or_default());
        let stands = own.get(place);
        let figure = |figure: Figure| {
            let at = COLUMNS.iter().position(|(column, _)| *column == figure)?;
            stands.and_then(|state| state.figures[at])
        };
        let product = ProductRow {
            key: row.get(1)?,
            name: row.get(2)?,
            manufacturer: row.get(3)?,
            kind: row.get(4)?,
            origin: Origin::from_word(&row.get::<_, String>(5)?),
            representative: place,
            dataset: stands.and_then(|state| state.dataset.clone()),
            rule,
            tau_normal: figure(Figure::TauNormal),
            tau_hemispherical: figure(Figure::TauHemispherical),
            tau_profile: stands.map(|state| list_of(&state.profile)).unwrap_or_default(),
            to_ceiling: figure(Figure::ToCeiling),
            sun_blocked: figure(Figure::SunBlocked),
            view: figure(Figure::View),
            states: own.into_iter().map(|state| state.key).collect(),
            favourite: row.get(8)?,
            builtin: row.get(6)?,
            subscribed: row.get(10)?,
        };
        list.push(Sought {
            row: Arc::new(product),
            description: row.get(7)?,
            tags: lists.tags.remove(&id).unwrap_or_default(),
            collections: lists.collections.remove(&id).unwrap_or_default(),
        });
    }
    Ok((list, left_out))
}

/// A stored list, e.g. of transmittances; empty when it is none.
pub(super) fn list_of<T: serde::de::DeserializeOwned>(text: &str) -> Vec<T> {
    serde_json::from_str(text).unwrap_or_default()
}
