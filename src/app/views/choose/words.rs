//! Figures, scores and explanations of a ranking as text.

use super::input::{Due, Running, rank_words};
use crate::compute::estimate::Estimate;
use crate::drawing::ticks::number;
use crate::study::rank::{Entry, Reason, Shortlist, Term, figure_words};
use crate::texts::{choose as say, fixed};

/// Returns the name of an annual figure and its unit, as a heading.
pub(super) fn heading(key: &str) -> String {
    let (name, unit) = figure_words(key);
    if matches!(unit, "" | "%") { name } else { format!("{name} / {unit}") }
}

/// Returns value and error of a figure as text: a share in %, others without their unit, which the head of the column
/// contains.
pub(super) fn value(unit: &str, figure: Estimate) -> String {
    if unit == "%" {
        // An error too small for the value's digits is not shown as 0.
        format!("{} ± {} %", fixed(100.0 * figure.value, 1), number(100.0 * figure.error, 1))
    } else {
        format!("{} ± {}", number(figure.value, 3), number(figure.error, 1))
    }
}

/// Returns a value with its unit, without its error, as text; a share in %.
fn bare(unit: &str, value: f64) -> String {
    if unit == "%" {
        format!("{} %", fixed(100.0 * value, 1))
    } else {
        format!("{} {unit}", number(value, 3)).trim_end().to_owned()
    }
}

fn signed(text: String, value: f64) -> String {
    if value > 0.0 { format!("+{text}") } else { text.replacen('-', "−", 1) }
}

/// Returns the score of a product with its error, as text.
pub(super) fn score(entry: &Entry) -> String {
    say::score(fixed(entry.score.value, 3), fixed(entry.score.error, 3))
}

/// Returns the sentence before the terms of an explanation: the difference in score from the other product, and whether
/// it exceeds the uncertainty.
pub(super) fn head(list: &Shortlist, reason: &Reason) -> String {
    let other = &list.entries[reason.other].name;
    let score = fixed(reason.score_difference.abs(), 3);
    match (reason.open, reason.score_difference < 0.0) {
        (true, false) => say::open_above(score, other),
        (true, true) => say::open_below(score, other),
        (false, false) => say::surely_above(score, other),
        (false, true) => say::surely_below(score, other),
    }
}

/// Returns a term of an explanation as text, i.e. the part of the difference in score that is due to one objective:
/// `+0.120 by Lighting energy: 4.1 against 9.3 kWh/m² (of it −3.2 in winter, no sun, rear)`.
pub(super) fn term(list: &Shortlist, term: &Term) -> String {
    let (name, unit) = figure_words(&list.list.figures[term.objective]);
    let score = signed(fixed(term.score_difference, 3), term.score_difference);
    let [own, other] = term.figures.map(|figure| bare(unit, figure));
    let text = say::by_objective(score, name, own, other);
    let part = |(part, [season, sun, zone]): &(f64, [String; 3])| {
        let words = [season, sun, zone].map(|word| say::part_word(word)).join(", ");
        say::part_is(signed(bare(unit, *part), *part), words)
    };
    let parts: Vec<String> = term.parts.iter().map(part).collect();
    if parts.is_empty() { text } else { format!("{text} ({})", parts.join("; ")) }
}

/// Returns the progress of a ranking as text: `34 of 113 products, 12 s left`.
pub(super) fn running(running: &Running) -> String {
    let all =
        if running.coarse { say::by_cells(running.done, running.all) } else { say::done(running.done, running.all) };
    match running.left {
        Some(left) => say::left(all, fixed(left.max(1.0), 0)),
        None => all,
    }
}

/// Returns label and tooltip of the button that computes the ranking (again) for a reason; `None` for none.
pub(super) fn due(due: Due) -> Option<(&'static str, String)> {
    match due {
        Due::Nothing => None,
        Due::Changed => Some((say::AGAIN.get(), say::AGAIN_TIP.into())),
        Due::Unfinished(left) => Some((say::CONTINUE.get(), say::unfinished(left))),
        Due::Figure => Some((say::FIND_FIGURE.get(), say::FIND_FIGURE_TIP.into())),
    }
}

/// Returns name, rank, score and all figures of a product as one line of text.
pub(super) fn entry(list: &Shortlist, entry: &Entry) -> String {
    let mut text = format!("{} · {} · {}", entry.name, say::rank_is(rank_words(entry.ranks)), score(entry));
    for (key, figure) in list.list.figures.iter().zip(&entry.figures) {
        let (name, unit) = figure_words(key);
        let unit = if unit == "%" { "" } else { unit };
        text.push_str(format!(" · {name} {} {unit}", value(figure_words(key).1, *figure)).trim_end());
    }
    text
}
