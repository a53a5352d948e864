//! Merging of the parts of a ranking, in any order, by the keys of their rows.

use super::rank_csv::{Shape, objectives_of, parts_of};
use crate::compute::estimate::Estimate;
use crate::formats::decimal_comma::with_decimal_points;
use crate::formats::encoding::decode;
use crate::study::files;
use crate::study::rank::{BETWEEN, Found, List, RESULT, Row, WHERE};
use anyhow::{Context as _, anyhow, bail};
use csv::StringRecord;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Part of a ranking, as read from its file.
struct Piece {
    shape: Shape,
    header: StringRecord,
    rows: Vec<StringRecord>,
}

/// Merges the files of all parts of a ranking. Returns the lists, and the keys of the figures of all lists.
///
/// # Errors
/// Returns an error if a file is not a part or belongs to another ranking, if a key has two values, or if a part is
/// missing.
pub(super) fn merged(parts: &[PathBuf]) -> anyhow::Result<(Vec<List>, Vec<String>)> {
    let mut pieces: Vec<Piece> = Vec::with_capacity(parts.len());
    for path in parts {
        let piece = read(path)?;
        if let Some(first) = pieces.first() {
            let other = parts[0].display();
            if piece.shape.run != first.shape.run {
                bail!(
                    "{}: belongs to another ranking than {other} (other scenes, products or program)",
                    path.display()
                );
            }
            let same = |a: &StringRecord, b: &StringRecord| a.iter().take(a.len() - 1).eq(b.iter().take(b.len() - 1));
            if piece.shape.shard.count != first.shape.shard.count || !same(&piece.header, &first.header) {
                bail!(
                    "{}: is one of {} pieces, {other} one of {}; expected pieces of one division",
                    path.display(),
                    piece.shape.shard.count,
                    first.shape.shard.count
                );
            }
        }
        pieces.push(piece);
    }
    let Some(first) = pieces.first() else { bail!("no pieces") };
    let columns = Columns::of(&first.header).ok_or_else(|| anyhow!("{}: lacks columns", parts[0].display()))?;
    let mut rows: BTreeMap<String, (&StringRecord, &Path)> = BTreeMap::new();
    for (piece, path) in pieces.iter().zip(parts) {
        for record in &piece.rows {
            let key = record.get(columns.key).unwrap_or_default().to_owned();
            match rows.get(&key) {
                Some((other, at)) if *other != record => bail!(
                    "two values for key {key} ({}): in {} and in {}",
                    record.get(columns.product).unwrap_or_default(),
                    at.display(),
                    path.display()
                ),
                _ => drop(rows.insert(key, (record, path))),
            }
        }
    }
    let count = first.shape.shard.count;
    let missing: Vec<String> = (0..count)
        .filter(|number| !pieces.iter().any(|piece| piece.shape.shard.number == *number))
        .map(|number| format!("{number}/{count}"))
        .collect();
    if !missing.is_empty() {
        bail!("missing: shard {}; compute it and merge all {count}", missing.join(", "));
    }
    let mut lists: BTreeMap<usize, List> = BTreeMap::new();
    for (key, (record, path)) in &rows {
        let wrong = || anyhow!("{}: the row of key {key} cannot be read; compute this piece again", path.display());
        columns.put(record, key, &mut lists).ok_or_else(wrong)?;
    }
    let mut lists: Vec<List> = lists.into_values().collect();
    lists.iter_mut().for_each(List::sort);
    Ok((lists, columns.figures))
}

fn read(path: &Path) -> anyhow::Result<Piece> {
    let bytes = files::read(path)?;
    let text = decode(&bytes).with_context(|| path.display().to_string())?;
    let text = with_decimal_points(&text);
    let wrong = |error: csv::Error| anyhow!("{}: {error}", path.display());
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().map_err(wrong)?.clone();
    let shape = header.iter().next_back().and_then(Shape::read).ok_or_else(|| {
        anyhow!("{}: is not a piece of a ranking; expected a file of `cfs rank --shard n/N`", path.display())
    })?;
    let rows: Vec<StringRecord> = reader.records().collect::<Result<_, _>>().map_err(wrong)?;
    if rows.len() != shape.rows {
        bail!("{}: has {} of {} rows; compute this piece again", path.display(), rows.len(), shape.rows);
    }
    Ok(Piece { shape, header, rows })
}

/// Columns of a part: names of the figures, and indices of the other columns.
struct Columns {
    figures: Vec<String>,
    product: usize,
    excluded: usize,
    approximate: usize,
    list: usize,
    objectives: usize,
    parts: usize,
    key: usize,
}

impl Columns {
    fn of(header: &StringRecord) -> Option<Self> {
        let names: Vec<&str> = header.iter().collect();
        // The last column of a name, since figures, which come before, may have any name.
        let behind = |name: &str| names.iter().rposition(|one| *one == name);
        let result = behind(RESULT[0])?;
        let figures: Vec<String> =
            names.get(WHERE.len()..result)?.iter().step_by(2).map(|name| (*name).to_owned()).collect();
        let (list, key) = (behind("list")?, behind("key")?);
        if names.get(..WHERE.len())? != WHERE.as_slice() || key != list + 2 + figures.len() {
            return None;
        }
        Some(Self {
            product: WHERE.len() - 1,
            excluded: behind("excluded")?,
            approximate: behind("approximate")?,
            list,
            objectives: behind("objectives")?,
            parts: list + 2,
            key,
            figures,
        })
    }

    /// Adds a row to its list; `None` if the row cannot be read.
    fn put(&self, record: &StringRecord, key: &str, lists: &mut BTreeMap<usize, List>) -> Option<()> {
        let text = |at: usize| record.get(at);
        let number = |at: usize| text(at)?.parse::<f64>().ok();
        let place: usize = text(self.list)?.parse().ok()?;
        let (figures, objectives) = objectives_of(text(self.objectives)?)?;
        let list = lists.entry(place).or_insert(List {
            number: place,
            scene: text(0)?.to_owned(),
            climate: text(1)?.to_owned(),
            azimuth: number(2)?,
            figures: figures.clone(),
            objectives: objectives.clone(),
            rows: Vec::new(),
        });
        if list.objectives != objectives || list.figures != figures {
            return None;
        }
        let outcome = match text(self.excluded)? {
            "" => {
                let mut found = Found::default();
                for figure in &figures {
                    let column = self.figures.iter().position(|one| one == figure)?;
                    let at = WHERE.len() + 2 * column;
                    found.figures.push(Estimate { value: number(at)?, error: number(at + 1)? });
                    found.parts.push(parts_of(text(self.parts + column)?)?);
                }
                let approximate = text(self.approximate)?;
                found.approximate =
                    approximate.split(BETWEEN).filter(|one| !one.is_empty()).map(str::to_owned).collect();
                Ok(found)
            }
            reason => Err(reason.to_owned()),
        };
        list.rows.push(Row { product: text(self.product)?.to_owned(), key: key.to_owned(), outcome });
        Some(())
    }
}
