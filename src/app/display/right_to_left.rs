//! Hebrew and Arabic in the window. egui reverses and joins the letters within a word correctly, but arranges words
//! from left to right. This module rearranges the texts that a frame has drawn into reading order, so that no label,
//! list or picture has to do so.

use crate::texts::{has_right_to_left, visual_parts};
use egui::epaint::text::{ByteIndex, LayoutJob, LayoutSection, TextWrapping};
use egui::layers::ShapeIdx;
use egui::{Context, Galley, LayerId, Shape, Ui};
use std::ops::Range;
use std::sync::Arc;
use unicode_bidi_mirroring::get_mirrored;

/// Rearranges the texts with Hebrew or Arabic letters that the current frame has drawn into reading order. Called at
/// the end of the frame.
pub fn reorder(ui: &mut Ui) {
    let ctx = ui.ctx();
    let mut layers: Vec<LayerId> = ctx.memory(|memory| memory.layer_ids().collect());
    // The panels' layer may be none of the areas.
    if !layers.contains(&LayerId::background()) {
        layers.push(LayerId::background());
    }
    for layer in layers {
        let found: Vec<(usize, Shape)> = ctx.graphics(|graphics| {
            let shapes = graphics.get(layer).into_iter().flat_map(|list| list.all_entries().enumerate());
            let concerned = shapes.filter(|(_, clipped)| is_concerned(&clipped.shape));
            concerned.map(|(index, clipped)| (index, clipped.shape.clone())).collect()
        });
        for (index, mut shape) in found {
            set_in_order(ctx, &mut shape);
            ctx.graphics_mut(|graphics| {
                graphics.entry(layer).mutate_shape(ShapeIdx(index), |clipped| clipped.shape = shape);
            });
        }
    }
}

fn is_concerned(shape: &Shape) -> bool {
    match shape {
        Shape::Text(text) => has_right_to_left(text.galley.text()),
        Shape::Vec(shapes) => shapes.iter().any(is_concerned),
        _ => false,
    }
}

fn set_in_order(ctx: &Context, shape: &mut Shape) {
    match shape {
        Shape::Text(text) if has_right_to_left(text.galley.text()) => {
            text.galley = in_order(&text.galley, &|job| ctx.fonts_mut(|fonts| fonts.layout_job(job)));
        }
        Shape::Vec(shapes) => shapes.iter_mut().for_each(|shape| set_in_order(ctx, shape)),
        _ => {}
    }
}

/// Line of a text: its byte range in the text, and whether the text is cut there with "…".
type Line = (Range<usize>, bool);

/// Returns a laid-out text with every line in reading order; a text that was wrapped or cut is wrapped or cut again,
/// starting from its first letter in reading order.
fn in_order(galley: &Galley, layout: &dyn Fn(LayoutJob) -> Arc<Galley>) -> Arc<Galley> {
    let job = &*galley.job;
    let wraps = galley.elided || galley.rows.len() > job.text.split('\n').count();
    let fits = |line: Line| !wraps || layout(set(job, &[line])).size().x <= job.wrap.max_width;
    let (mut lines, mut start): (Vec<Line>, usize) = (Vec::new(), 0);
    for paragraph in job.text.split('\n') {
        let (mut first, mut end) = (start, start);
        for word in paragraph.split_inclusive(' ') {
            if end > first && !fits((first..end + word.trim_end().len(), false)) {
                lines.push((first..end, false));
                first = end;
            }
            end += word.len();
        }
        lines.push((first..end, false));
        start = end + 1;
    }
    if galley.elided {
        lines.truncate(job.wrap.max_rows);
        if let Some((range, cut)) = lines.last_mut() {
            let rest = job.text[range.start..].split('\n').next().unwrap_or_default();
            let ends = rest.char_indices().rev().map(|(end, _)| range.start + end);
            let end = ends.into_iter().find(|end| fits((range.start..*end, true))).unwrap_or(range.start);
            (range.end, *cut) = (end, true);
        }
    }
    layout(set(job, &lines))
}

/// Returns the layout job for some lines of another job, each in reading order.
fn set(job: &LayoutJob, lines: &[Line]) -> LayoutJob {
    let mut set = LayoutJob {
        text: String::new(),
        sections: Vec::new(),
        wrap: TextWrapping::no_max_width(),
        break_on_newline: true,
        ..job.clone()
    };
    // Sections of their own even where the format is the same: egui shapes each by itself, in one direction.
    let mut add = |text: &str, from: usize| {
        let of = job.sections.iter().find(|section| section.byte_range.end.0 > from).or(job.sections.last());
        let Some(section) = of else { return };
        let start = ByteIndex(set.text.len());
        set.text.push_str(text);
        set.sections.push(LayoutSection {
            leading_space: if start.0 == 0 { section.leading_space } else { 0.0 },
            byte_range: start..ByteIndex(set.text.len()),
            format: section.format.clone(),
        });
    };
    for (index, (line, cut)) in lines.iter().enumerate() {
        if index > 0 {
            add("\n", line.start);
        }
        for (part, right_to_left) in visual_parts(&job.text[line.clone()]) {
            let part = line.start + part.start..line.start + part.end;
            let mut characters = job.text[part.clone()].chars();
            if let (true, Some(mirrored), None) =
                (right_to_left, characters.next().and_then(get_mirrored), characters.next())
            {
                add(mirrored.encode_utf8(&mut [0; 4]), part.start);
                continue;
            }
            let ranges = job.sections.iter().map(|section| section.byte_range.start.0..section.byte_range.end.0);
            let within = ranges.map(|range| range.start.max(part.start)..range.end.min(part.end));
            let mut pieces: Vec<Range<usize>> = within.filter(|piece| !piece.is_empty()).collect();
            if right_to_left {
                pieces.reverse();
            }
            for piece in pieces {
                add(&job.text[piece.clone()], piece.start);
            }
        }
        if let (true, Some(sign)) = (*cut, job.wrap.overflow_character) {
            add(sign.encode_utf8(&mut [0; 4]), line.end.saturating_sub(1));
        }
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::text::TextFormat;

    /// Letters of the lines that a frame draws of a text, from left to right.
    fn seen(text: &str, wrap: TextWrapping) -> Vec<String> {
        let ctx = Context::default();
        crate::app::display::theme::install(&ctx);
        ctx.on_end_pass("right_to_left", Arc::new(reorder));
        let mut job = LayoutJob { wrap, ..LayoutJob::default() };
        // Two colours, as where a search marks letters.
        let (first, second) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
        let format = |colour| TextFormat { color: colour, ..TextFormat::default() };
        job.append(first, 0.0, format(egui::Color32::RED));
        job.append(second, 0.0, format(egui::Color32::GREEN));
        let output = ctx.run_ui(egui::RawInput::default(), |ui| {
            ui.painter().add(Shape::Vec(vec![Shape::galley(
                egui::pos2(10.0, 10.0),
                ui.fonts_mut(|fonts| fonts.layout_job(job.clone())),
                egui::Color32::WHITE,
            )]));
        });
        let mut lines = Vec::new();
        for clipped in &output.shapes {
            let Shape::Vec(shapes) = &clipped.shape else { continue };
            let Shape::Text(text) = &shapes[0] else { panic!("a text") };
            lines = text
                .galley
                .rows
                .iter()
                .map(|row| {
                    let mut letters: Vec<_> = row.glyphs.iter().filter(|glyph| glyph.advance_width > 0.0).collect();
                    letters.sort_by(|a, b| a.pos.x.total_cmp(&b.pos.x));
                    letters.into_iter().map(|glyph| glyph.chr).collect::<String>().trim().to_owned()
                })
                .collect();
        }
        output.drop_without_applying_deltas();
        lines
    }

    #[test]
    fn names_are_drawn_in_the_order_of_reading() {
        let free = TextWrapping::no_max_width;
        for (text, left_to_right) in [
            ("Louvre 80", "Louvre 80"),
            ("תריס אלומיניום 80", "80 םוינימולא סירת"),
            ("“תריס לבן” was added", "“ןבל סירת” was added"),
            ("תריס (לבן) 45", "45 (ןבל) סירת"),
        ] {
            assert_eq!(seen(text, free()), [left_to_right], "{text}");
        }
        assert_eq!(seen("תריס\nלבן", free()), ["סירת", "ןבל"]);
    }

    #[test]
    fn lines_are_wrapped_and_cut_in_the_order_of_the_letters() {
        let lines = seen("תריס אלומיניום לבן", TextWrapping::wrap_at_width(90.0));
        assert!(lines.len() > 1 && lines[0].ends_with("סירת") && lines.concat().contains("ןבל"), "{lines:?}");
        let cut = seen("תריס אלומיניום לבן Louvre", TextWrapping::truncate_at_width(90.0));
        assert!(cut.len() == 1 && cut[0].contains("סירת") && cut[0].ends_with('…') && !cut[0].contains('L'), "{cut:?}");
    }
}
