//! Messages about the best explanation of a dataset's misfits, with its repairs.

use super::diagnosis::{Confidence, Diagnosis};
use super::evidence::Question;
use super::hypotheses::{Fault, Hypothesis};
use super::judgement::{ASK, Candidate, SURE, Verdict};
use super::repair::{BandScope, BlockScope, Repair};

/// Returns the names of the functions that a hypothesis is about, as text for messages.
fn subject(hypothesis: &Hypothesis) -> String {
    let words = hypothesis.scopes.iter().map(|scope| match scope {
        BlockScope::All => "the whole file",
        BlockScope::Transmission => "the transmissions of both sides",
        BlockScope::Reflection => "the reflections of both sides",
        BlockScope::One(component) => component.words(),
    });
    words.collect::<Vec<_>>().join(", ")
}

fn band(bands: BandScope) -> &'static str {
    match bands {
        BandScope::Visible => "visible",
        BandScope::Solar => "solar",
        BandScope::Both => "visible and solar",
    }
}

/// Returns the repairs that undo the fault of a hypothesis, in the bands that it is about.
pub(super) fn repairs(candidate: &Candidate) -> Vec<Repair> {
    let Candidate { hypothesis, bands, .. } = candidate;
    let kind = hypothesis.fault.repair();
    let of = |kind| hypothesis.scopes.iter().map(move |blocks| Repair { kind, bands: *bands, blocks: *blocks });
    kind.map(|kind| of(kind).collect()).unwrap_or_default()
}

/// Returns the text for the misfit of a question, to be followed by its value in percent.
const fn measured(question: Question) -> &'static str {
    match question {
        Question::Between => "the transmissions of both sides disagree by",
        Question::Alone => "the transmission disagrees with itself the other way round by",
        Question::Own => "the reflection disagrees with itself the other way round by",
        Question::Even => "the light left over differs from side to side by",
        Question::Opposed => "transmission and reflection favour the same directions by",
        Question::Rest => "the light left over depends on where it comes from by",
        Question::Won => "more light leaves than arrives, by",
        Question::Lost => "light is lost by",
        Question::Shape => "the change with the angle is off by",
    }
}

/// Returns the text about the two misfits that the repair reduces most.
fn evidence(verdict: &Verdict) -> String {
    let mut list: Vec<&(Question, f64, f64)> = verdict.evidence.iter().filter(|(_, then, now)| then > now).collect();
    list.sort_by(|a, b| (b.1 - b.2).total_cmp(&(a.1 - a.2)));
    let mut reported: Vec<Question> = Vec::new();
    let mut words = Vec::new();
    for (question, then, now) in list {
        if words.len() < 2 && !reported.contains(question) {
            reported.push(*question);
            words.push(format!(
                "{} {:.1} % as it is and {:.1} % put right",
                measured(*question),
                100.0 * then,
                100.0 * now
            ));
        }
    }
    words.join("; ")
}

/// Returns the finding about the best explanation, once for each of its repairs; an empty list if its gain is too
/// small.
pub(super) fn diagnoses(verdict: &Verdict) -> Vec<Diagnosis> {
    if !verdict.asks() {
        return Vec::new();
    }
    let best = &verdict.best;
    let fault = best.hypothesis.fault;
    let confidence = match best.gain {
        _ if verdict.sure() => Confidence::Certain,
        SURE.. => Confidence::Likely,
        _ => Confidence::Possible,
    };
    let close = verdict.rivals.iter().filter(|one| one.gain > best.gain - ASK);
    let others: Vec<String> = close
        .map(|one| {
            let repairs = repairs(one).iter().map(|repair| format!("({repair})")).collect::<Vec<_>>().join(" ");
            format!("{} {} {repairs}", subject(&one.hypothesis), one.hypothesis.fault.words()).trim_end().to_owned()
        })
        .take(MOST_RIVALS)
        .collect();
    let others = if others.is_empty() { String::new() } else { format!(" As well possible: {}.", others.join("; ")) };
    let subject = subject(&best.hypothesis);
    let message = format!(
        "{subject} ({}): {} {}: {}.{others}",
        band(best.bands),
        confidence.word(),
        fault.words(),
        evidence(verdict)
    );
    let message = message[..1].to_uppercase() + &message[1..];
    repairs(best)
        .into_iter()
        .map(|repair| {
            let one = Diagnosis::suspicion(confidence, fault.code(), message.clone());
            // A genuine block would be lost if the other were the copy.
            if fault == Fault::Copied { one.asking(repair) } else { one.with(repair) }
        })
        .collect()
}

/// Maximum number of alternative explanations in a message. Chosen: affects wording only.
const MOST_RIVALS: usize = 5;
