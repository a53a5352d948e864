//! Layout of the incident and the emergent hemisphere in a tile, and their captions.

use crate::app::paint::colour_scale::LEGEND_HEIGHT;
use crate::app::paint::hemisphere::{Disk, Projection};
use crate::app::paint::palette::Palette;
use crate::texts::tiles as say;
use egui::{Align2, Rect, Ui, pos2, vec2};

/// Layout of one of the two hemispheres in the tile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Rectangle of the tile that belongs to the hemisphere.
    pub rect: Rect,
    /// Disk that represents the hemisphere.
    pub disk: Disk,
    /// Rectangle of the hemisphere's legend; `None` if it has none.
    pub legend: Option<Rect>,
    /// Rectangle of the caption in a corner of the tile, with its alignment; `None` if the caption is placed under the
    /// disk.
    pub corner: Option<(Rect, Align2)>,
}

/// Returns the layouts of the incident and the emergent hemisphere in a rectangle: side by side in a wide tile,
/// otherwise along a diagonal, where the disks are largest and the two free corners take the captions.
///
/// `stacked`: whether the emergent side is not drawn as a disk; in a narrow tile it is then placed below the incident
/// side.
pub(super) fn places(rect: Rect, stacked: bool) -> [Place; 2] {
    if rect.width() > 1.6 * rect.height() || rect.width() > 440.0 {
        let (left, right) = rect.split_left_right_at_fraction(0.5);
        return [left, right].map(|rect| {
            let legend = Rect::from_min_max(pos2(rect.left() + 4.0, rect.bottom() - LEGEND_HEIGHT), rect.max);
            let disk = Disk::within(Rect::from_min_max(rect.min, pos2(rect.right(), legend.top())));
            Place { rect, disk, legend: Some(legend), corner: None }
        });
    }
    if stacked {
        let (upper, lower) = rect.split_top_bottom_at_fraction(0.42);
        let legend = Rect::from_min_max(pos2(lower.left() + 2.0, lower.bottom() - LEGEND_HEIGHT), lower.max);
        let above = Rect::from_min_max(lower.min, pos2(lower.right(), legend.top()));
        return [
            Place { rect: upper, disk: Disk::within(upper), legend: None, corner: None },
            Place { rect: lower, disk: Disk::within(above), legend: Some(legend), corner: None },
        ];
    }
    const UP: f32 = 16.0;
    const GAP: f32 = 8.0;
    let legend = Rect::from_min_max(pos2(rect.left() + 2.0, rect.bottom() - LEGEND_HEIGHT), rect.max);
    let area = Rect::from_min_max(
        pos2(rect.left() + 3.0, rect.top() + UP),
        pos2(rect.right() - 3.0, (legend.top() - 4.0).max(rect.top() + UP + 20.0)),
    );
    // The centres, in opposite corners, are two radii and a gap apart: (w − 2r)² + (h − 2r)² = (2r + gap)².
    let (w, h) = (area.width(), area.height());
    let b = 4.0 * (w + h + GAP);
    let r = (b - (b * b - 16.0 * (w * w + h * h - GAP * GAP)).max(0.0).sqrt()) / 8.0;
    let radius = r.clamp(8.0, (0.5 * w.min(h)).max(8.0));
    let corner = vec2(w - 2.0 * radius - 2.0, h - 2.0 * radius - UP);
    let top = Rect::from_min_size(pos2(area.right() - corner.x, rect.top()), corner);
    let bottom = Rect::from_min_size(area.left_bottom() - vec2(0.0, corner.y), corner);
    [
        Place {
            rect,
            disk: Disk { centre: area.min + vec2(radius, radius), radius },
            legend: None,
            corner: Some((top, Align2::RIGHT_TOP)),
        },
        Place {
            rect,
            disk: Disk { centre: area.max - vec2(radius, radius), radius },
            legend: Some(legend),
            corner: Some((bottom, Align2::LEFT_BOTTOM)),
        },
    ]
}

/// Draws the rim of a hemisphere and its caption: `side` alone or, if there is room, with the explanation `what`.
pub(super) fn frame(ui: &Ui, place: &Place, projection: Projection, [side, what]: [&str; 2], palette: &Palette) {
    let Some((corner, align)) = place.corner else {
        let long = say::side_and(side, what);
        let caption = if place.rect.width() > 195.0 { &long } else { side };
        place.disk.frame(ui.painter(), projection, caption, palette);
        return;
    };
    place.disk.rim(ui.painter(), projection, palette);
    let text =
        if corner.width() > 76.0 && corner.height() > 44.0 { say::side_over(side, what) } else { side.to_owned() };
    let mut job =
        egui::text::LayoutJob::simple(text, egui::FontId::proportional(13.0), palette.weak, corner.width().max(50.0));
    job.halign = align.x();
    let galley = ui.painter().layout_job(job);
    let height = galley.size().y;
    let y = if align == Align2::RIGHT_TOP { corner.top() } else { corner.bottom() - height };
    let x = if align == Align2::RIGHT_TOP { corner.right() } else { corner.left() };
    ui.painter().galley(pos2(x, y), galley, palette.weak);
}
