//! Ranking tile: products in the order of the window's ranking.

use crate::drawing::colours::Inks;
use crate::drawing::{Drawing, Frame};
use crate::study::subject::Subject;
use crate::texts::choose as texts;

pub(super) fn choose(drawing: &mut Drawing, frame: Frame, subject: &Subject, inks: &Inks) -> Result<String, String> {
    let (list, look) = subject.ranking.as_ref().ok_or(texts::NO_RANKING)?;
    Ok(list.draw(drawing, frame, look, inks))
}
