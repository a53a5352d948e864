//! Room tile: illuminance on the work plane as a floor plan in false colours with iso-lux lines, and as a section along
//! the depth.

use crate::drawing::chart;
use crate::drawing::colours::{ColourMap, ColourScale, Inks, contrast};
use crate::drawing::contour::{ASKED_FOR, iso_levels, iso_lines};
use crate::drawing::font::width;
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::drawing::ticks::{si, tick};
use crate::drawing::{Align, Drawing, Frame, Point, Shape, TEXT, legend};
use crate::study::SensorResult;
use crate::study::comparison::scales::Range;
use crate::study::scene_file::{SceneFile, SurfaceKey};
use crate::study::scene_words::error_words;
use crate::study::subject::Subject;
use crate::texts::export as texts;

/// Floor plan on paper, seen from above: depth to the right, the room's x axis downwards, façade at the left.
pub(crate) struct Plan {
    /// Frame of the room in the drawing.
    pub area: Frame,
    scale: f64,
}

impl Plan {
    /// Creates the largest floor plan of a room of the given width and depth \[m\] in the middle of a frame.
    pub fn within(frame: Frame, [width, depth]: [f64; 2]) -> Self {
        let scale = (frame.width / depth).min(frame.height / width).max(1e-3);
        let [across, down] = [depth * scale, width * scale];
        let left = frame.left + 0.5 * (frame.width - across);
        Self { area: Frame::new(left, frame.top + 0.5 * (frame.height - down), across, down), scale }
    }

    fn place(&self, x: f64, y: f64) -> Point {
        [self.area.left + y * self.scale, self.area.top + x * self.scale]
    }

    /// Returns the frame in the drawing of the cell around a sensor point, given by the point's column and row and the
    /// steps between points \[m\].
    pub fn cell(&self, [i, j]: [usize; 2], step: [f64; 2]) -> Frame {
        let [left, top] = self.place(i as f64 * step[0], j as f64 * step[1]);
        Frame::new(left, top, step[1] * self.scale, step[0] * self.scale)
    }
}

/// Returns mean, minimum and maximum illuminance with their uncertainty as text.
pub fn figures(sensors: &[SensorResult]) -> String {
    let totals = || sensors.iter().map(SensorResult::total);
    let values = || totals().map(|total| total.value);
    let mean = values().sum::<f64>() / sensors.len().max(1) as f64;
    let (min, max) = values().fold((f64::INFINITY, 0.0_f64), |(a, b), value| (a.min(value), b.max(value)));
    texts::room_figures(si(mean, "lx"), si(min, "lx"), si(max, "lx"), error_words(totals()))
}

pub(super) fn room(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    range: Range,
    inks: &Inks,
) -> Result<String, String> {
    let result = subject.room.as_ref().ok_or(texts::NO_ROOM)?;
    let [nx, ny] = subject.scene.grid.ok_or(texts::LISTED_POINTS)?;
    let totals: Vec<f64> = result.sensors.iter().map(|sensor| sensor.total().value).collect();
    let file = &subject.file;
    let (wide, deep) = (file.room.width, file.room.depth);
    // A dark room still needs a scale with an extent.
    let max = totals.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max).max(1.0);
    let max = range.map_or(max, |[_, high]| high);
    let scale = ColourScale::up_to(max, false, 2, ColourMap::Sequential);
    let beside = frame.width > 1.6 * frame.height;
    let [upper, lower] = if beside { frame.split(0.55) } else { frame.cut_bottom(0.38 * frame.height) };
    let [above, below] = upper.cut_bottom(legend::HEIGHT);
    let plan = Plan::within(above.inside([26.0, 4.0, 10.0, 4.0]), [wide, deep]);
    let step = [wide / nx as f64, deep / ny as f64];
    for (k, total) in totals.iter().enumerate() {
        drawing.add(Shape::cell(plan.cell([k % nx, k / nx], step).corners(), scale.rgb(*total)));
    }
    let row = nx / 2;
    let x = (row as f64 + 0.5) * step[0];
    let dashes = [plan.place(x, 0.0), plan.place(x, deep)];
    drawing.add(Shape::dashed(dashes, [255; 3], 1.2, [4.0, 4.0]));
    let mut used = vec![Frame::new(plan.area.left, dashes[0][1] - 1.0, plan.area.width, 2.0)];
    let mut bar = Drawing::new(1.0, 1.0);
    used.push(scale_bar(&mut bar, &plan));
    let node = |p: &[f64; 2]| plan.place((p[0] + 0.5) * step[0], (p[1] + 0.5) * step[1]);
    let mut named: Vec<(f64, Vec<Vec<Point>>)> = Vec::new();
    for level in iso_levels(&scale, &totals) {
        let colour = contrast(scale.rgb(level));
        let mut lines = Vec::new();
        for line in iso_lines(nx, ny, &totals, level) {
            let mut points: Vec<Point> = line.points.iter().map(node).collect();
            if line.closed {
                points.extend(points.first().copied());
            }
            drawing.add(Shape::line(points.clone(), colour, 1.1));
            lines.push(points);
        }
        named.push((level, lines));
    }
    drawing.shapes.extend(bar.shapes);
    // The names come over all lines, those of the levels that are asked for first.
    named.sort_by_key(|(level, _)| !ASKED_FOR.contains(level));
    for (level, lines) in &named {
        let mut done = false;
        for points in lines {
            done |= name(drawing, points, *level, &scale, plan.area, &mut used);
        }
        // Crossed by the row's dashes or by another name at worst, but never without its own.
        if let (false, true, Some(longest)) = (done, ASKED_FOR.contains(level), lines.iter().max_by_key(|l| l.len())) {
            name(drawing, longest, *level, &scale, plan.area, &mut Vec::new());
        }
    }
    drawing.add(Shape::line(plan.area.outline(), inks.outline, 1.5));
    openings(drawing, file, &plan, inks);
    let at = [plan.area.left - 16.0, plan.area.centre()[1]];
    let (text, colour) = (texts::FACADE.into(), inks.weak);
    drawing.add(Shape::Text { at, text, colour, size: TEXT, align: Align::Middle, turn: -90.0 });
    legend::scale(drawing, below, &scale, "lx", inks);
    section(drawing, lower, &result.sensors, ([nx, ny], row, deep), &scale, inks);
    let summary = figures(&result.sensors);
    Ok(match &file.sensors.plane {
        Some(plane) => texts::e_on_plane_at(tick(plane.z), summary),
        None => texts::e_on_plane(summary),
    })
}

fn openings(drawing: &mut Drawing, file: &SceneFile, plan: &Plan, inks: &Inks) {
    for aperture in &file.aperture {
        let ([x, y], [width, height]) = (aperture.origin, aperture.size);
        match aperture.surface {
            SurfaceKey::Facade => {
                let ends = [plan.place(x, 0.0), plan.place(x + width, 0.0)].map(|[x, y]| [x - 3.5, y]);
                drawing.add(Shape::line(ends, inks.series[0], 5.0));
            }
            SurfaceKey::Roof => {
                let [left, top] = plan.place(x, y);
                let place = Frame::new(left, top, height * plan.scale, width * plan.scale);
                drawing.add(Shape::line(place.outline(), inks.series[0], 2.0));
            }
        }
    }
}

/// Writes the level of an iso-lux line \[lx\] on it where nothing else is drawn. Returns `false` if there is no free
/// place.
fn name(
    drawing: &mut Drawing,
    points: &[Point],
    level: f64,
    scale: &ColourScale,
    area: Frame,
    used: &mut Vec<Frame>,
) -> bool {
    let text = tick(level);
    let [wide, high] = [width(&text, TEXT) + 6.0, 15.0];
    if points.len() < 2 || area.width < wide + 2.0 || area.height < high + 2.0 {
        return false;
    }
    // From the middle outwards; next to an edge the name moves inside.
    for k in 0..20 {
        let share = 0.5 + if k % 2 == 0 { 0.5 } else { -0.5 } * f64::from(k) / 20.0;
        let [x, y] = points[((points.len() - 1) as f64 * share).round() as usize];
        let left = (x - 0.5 * wide).clamp(area.left + 1.0, area.right() - wide - 1.0);
        let top = (y - 0.5 * high).clamp(area.top + 1.0, area.bottom() - high - 1.0);
        let place = Frame::new(left, top, wide, high);
        let [cx, cy] = place.centre();
        if (cx - x).hypot(cy - y) <= 0.5 * high + 1.0 && used.iter().all(|other| !other.meets(&place.inside([-2.0; 4])))
        {
            let ground = scale.rgb(level);
            drawing.add(Shape::area(place.corners(), ground));
            drawing.add(Shape::text(place.centre(), text, contrast(ground)));
            used.push(place);
            return true;
        }
    }
    false
}

/// Draws a scale bar of whole metres in a corner of the plan, far from the façade. Returns its frame.
fn scale_bar(drawing: &mut Drawing, plan: &Plan) -> Frame {
    let metres = [10.0, 5.0, 2.0].into_iter().find(|m| m * plan.scale < 0.3 * plan.area.width).unwrap_or(1.0);
    let text = format!("{metres} m");
    let length = metres * plan.scale;
    let size = [length.max(width(&text, TEXT)) + 10.0, 25.0];
    let place = Frame::new(plan.area.right() - size[0] - 3.0, plan.area.bottom() - size[1] - 3.0, size[0], size[1]);
    if !plan.area.holds(&place) {
        return Frame::new(0.0, 0.0, 0.0, 0.0);
    }
    drawing.add(Shape::Area { points: place.corners().to_vec(), colour: [0; 3], opacity: 0.65, edge: 0.0 });
    let [middle, _] = place.centre();
    let (y, ends) = (place.bottom() - 5.0, [middle - 0.5 * length, middle + 0.5 * length]);
    drawing.add(Shape::line([[ends[0], y], [ends[1], y]], [255; 3], 1.5));
    for x in ends {
        drawing.add(Shape::line([[x, y - 3.0], [x, y + 3.0]], [255; 3], 1.5));
    }
    drawing.add(Shape::text([middle, place.top + 9.0], text, [255; 3]));
    place
}

fn section(
    drawing: &mut Drawing,
    frame: Frame,
    sensors: &[SensorResult],
    ([nx, ny], row, deep): ([usize; 2], usize, f64),
    scale: &ColourScale,
    inks: &Inks,
) {
    let at_depth = |j: usize| (j as f64 + 0.5) / ny as f64 * deep;
    let value = |i: usize, j: usize| &sensors[j * nx + i];
    // Between the darkest and the brightest row.
    let band = |j: usize| {
        let rows = || (0..nx).map(|i| value(i, j).total().value);
        [rows().fold(f64::INFINITY, f64::min), rows().fold(0.0, f64::max)]
    };
    let line = |name: &str, of: fn(&SensorResult) -> f64| {
        Series::line(name, (0..ny).map(|j| [at_depth(j), of(value(row, j))]))
    };
    let plot = Plot {
        x: Axis::linear([0.0, deep], texts::FROM_FACADE, Unit::Named("m")),
        y: Axis::linear([scale.lo, scale.hi], "E", Unit::Named("lx")),
        series: vec![
            Series {
                band: (0..ny).map(band).collect(),
                ..line(&texts::total_in_row(row + 1, nx), |one| one.total().value)
            },
            line(texts::DIRECT.get(), |one| one.direct.value),
        ],
        guides: ASKED_FOR
            .map(|level| Guide { name: format!("{level:.0} lx"), ends: [[0.0, level], [deep, level]] })
            .into(),
    };
    let high = chart::names(drawing, frame.inside([40.0, 2.0, 8.0, 0.0]), &plot.series, inks);
    chart::panel(drawing, frame.inside([0.0, high + 2.0, 0.0, 0.0]), &plot, inks);
}
