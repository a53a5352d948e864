//! Reasons for the rank of a product as an English text, made from the numbers.

use super::figures::Found;
use super::list::List;
use crate::compute::rank::{Ranked, Why, surely_above};
use crate::drawing::ticks::number;

/// Difference of scores by an objective below which it is not mentioned.
const LEAST: f64 = 5e-4;
/// Maximum number of contributions to a difference that are stated.
const PARTS: usize = 2;
/// Minimum share of the difference that a stated contribution must have.
const LARGE: f64 = 0.15;

/// Returns one sentence on a product of a list: in comparison with the best (the best itself with the second), and with
/// the mean of all. `of`: index of the product in `ranked`, which contains all ranked products; `rows`: their keys and
/// figures in the order of [`List::ranked`].
pub fn why(list: &List, ranked: &[Ranked], rows: &[(&str, &Found)], of: usize) -> String {
    let own = &ranked[of];
    let mean = format!("{} the mean: {}", against(own.to_mean.utility), shares(list, rows[of].1, &own.to_mean, None));
    let Some((other, why)) = &own.to_best else { return "the only one".to_owned() };
    let rival = &ranked[*other];
    let is_distinct = surely_above(own.utility, rival.utility) || surely_above(rival.utility, own.utility);
    let qualifier = if is_distinct { "" } else { "within the uncertainty, " };
    let name = rows[*other].0;
    let shares = shares(list, rows[of].1, why, Some(rows[*other].1));
    format!("{qualifier}{} {name}: {shares}; {mean}", against(why.utility))
}

fn against(utility: f64) -> String {
    let word = if utility < 0.0 { "below" } else { "above" };
    format!("{} {word}", number(utility.abs(), 3))
}

fn signed(value: f64) -> String {
    format!("{}{}", if value > 0.0 { "+" } else { "" }, number(value, 3))
}

/// Returns the objectives that contribute to a difference, the largest first, with their figures and the largest groups
/// of hours. `other`: figures of the other product; `None` for the mean.
fn shares(list: &List, own: &Found, why: &Why, other: Option<&Found>) -> String {
    let mut order: Vec<usize> = (0..why.shares.len()).filter(|&k| why.shares[k].utility.abs() >= LEAST).collect();
    order.sort_by(|&a, &b| why.shares[b].utility.abs().total_cmp(&why.shares[a].utility.abs()));
    if order.is_empty() {
        return "in no objective".to_owned();
    }
    let words = |k: usize| {
        let (share, figure) = (&why.shares[k], own.figures[k].value);
        let rival = other.map_or(figure - share.figure, |other| other.figures[k].value);
        let mut text = format!(
            "{} by {} ({} against {}",
            signed(share.utility),
            list.figures[k],
            number(figure, 3),
            number(rival, 3)
        );
        let mut groups: Vec<usize> = (0..share.parts.len())
            .filter(|&part| {
                share.parts[part].abs() >= LARGE * share.figure.abs() && share.parts[part] * share.figure > 0.0
            })
            .collect();
        groups.sort_by(|&a, &b| share.parts[b].abs().total_cmp(&share.parts[a].abs()));
        for (place, part) in groups.into_iter().take(PARTS).enumerate() {
            let [season, sun, zone] = own.parts[k].name(part);
            let begin = if place == 0 { ", of it " } else { " and " };
            text.push_str(&format!("{begin}{} in {season}, {sun}, {zone}", signed(share.parts[part])));
        }
        text.push(')');
        text
    };
    order.into_iter().map(words).collect::<Vec<_>>().join(", ")
}
