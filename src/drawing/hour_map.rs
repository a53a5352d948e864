//! Map of a quantity over the hours of a year: one column per day, one row per time step of the day, midnight at the
//! bottom; the colour of a cell shows its value. The window and files draw the same map.

use super::chart::{self, Panel};
use super::colours::{ColourMap, ColourScale, Inks};
use super::plot::{Axis, Plot, Unit};
use super::ticks::number;
use super::{Align, Drawing, Frame, Rgb, Shape, TEXT, font, legend};
use crate::texts::{csv_cell, words::MONTHS, year as say};
use std::fmt::Write as _;

/// Number of days before each month: of a common year, and of a leap year.
const BEFORE: [[u16; 12]; 2] =
    [[0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334], [0, 31, 60, 91, 121, 152, 182, 213, 244, 274, 305, 335]];

/// Meaning of the colours of an hour map: values of a quantity, or states of a product.
#[derive(Debug, Clone, PartialEq)]
pub enum Colours {
    /// Values on a colour scale, with the unit of the quantity.
    Scale(ColourScale, &'static str),
    /// Names of states; the value of a cell is the index of its state in this list.
    Names(Vec<String>),
}

/// Time step of the year with its value, as input of an hour map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Month, 1 … 12.
    pub month: u8,
    /// Day of the month, 1 … 31.
    pub day: u8,
    /// Time from midnight to the middle of the interval. \[min\]
    pub minute: u16,
    /// Value of the mapped quantity in its unit, or index of a state; NaN if there is none.
    pub value: f64,
}

/// Map of a quantity over the time of day and the days of a year. Cells are numbered day after day, within a day from
/// midnight on.
#[derive(Debug, Clone, PartialEq)]
pub struct HourMap {
    /// Name of the mapped quantity, without its unit.
    pub name: String,
    /// Number of columns of the map, one per day: 365, or 366 where a 29 February is among the intervals.
    pub days: usize,
    /// Number of rows of the map: time steps of equal length from midnight to midnight.
    pub rows: usize,
    /// Values of the cells, in the unit of the quantity or as indices of states, day after day and within a day from
    /// midnight on; NaN where there is none.
    pub values: Vec<f64>,
    /// Index of the interval that each cell shows, in the list from which the map was created; `None` where there was
    /// no interval.
    pub from: Vec<Option<u32>>,
    /// Meaning of the values and their colours.
    pub colours: Colours,
}

impl HourMap {
    /// Creates a map of intervals that are `length` minutes long. Where several fall on the same day and time of day
    /// (of different years), the first is shown.
    pub fn of(name: String, colours: Colours, length: f64, intervals: &[Interval]) -> Self {
        let leap = intervals.iter().any(|one| (one.month, one.day) == (2, 29));
        let days = 365 + usize::from(leap);
        let rows = (1440.0 / length.clamp(1.0, 1440.0)).round() as usize;
        let mut map =
            Self { name, days, rows, values: vec![f64::NAN; days * rows], from: vec![None; days * rows], colours };
        for (index, one) in intervals.iter().enumerate() {
            let month = usize::from(one.month.clamp(1, 12)) - 1;
            let column = usize::from(BEFORE[usize::from(leap)][month]) + usize::from(one.day.max(1)) - 1;
            let row = usize::from(one.minute) * rows / 1440;
            let cell = column * rows + row.min(rows - 1);
            if column < days && map.from[cell].is_none() {
                map.values[cell] = one.value;
                map.from[cell] = u32::try_from(index).ok();
            }
        }
        map
    }

    /// Returns the index of the cell at a month (1 … 12), day of the month and minute of the day; `None` for dates and
    /// times outside the map.
    pub fn cell(&self, month: u8, day: u8, minute: u16) -> Option<usize> {
        let month = usize::from(month.checked_sub(1)?);
        let leap = usize::from(self.days > 365);
        let column = usize::from(*BEFORE[leap].get(month)?) + usize::from(day.checked_sub(1)?);
        let row = usize::from(minute) * self.rows / 1440;
        (column < self.days && row < self.rows).then_some(column * self.rows + row)
    }

    /// Returns the index of the cell at a day of the year (from 0) and an hour of the day (0 … 24), both with
    /// fractions; the nearest cell if they lie outside the map.
    pub fn at(&self, day: f64, hour: f64) -> usize {
        let row = ((hour / 24.0 * self.rows as f64).max(0.0) as usize).min(self.rows - 1);
        (day.max(0.0) as usize).min(self.days - 1) * self.rows + row
    }

    /// Returns the time at the middle of a cell: day of the year from 0, and hour of the day, both with fractions.
    pub fn middle(&self, cell: usize) -> [f64; 2] {
        let (day, row) = (cell / self.rows, cell % self.rows);
        [day as f64 + 0.5, (row as f64 + 0.5) * 24.0 / self.rows as f64]
    }

    /// Returns the index of the cell that lies `days` columns later and `rows` rows higher than a cell (less for
    /// negative numbers); `None` outside the map.
    pub fn beside(&self, cell: usize, days: i32, rows: i32) -> Option<usize> {
        let rows = i64::from(days) * self.rows as i64 + i64::from(rows);
        let other = usize::try_from(cell as i64 + rows).ok()?;
        (other < self.values.len()).then_some(other)
    }

    /// Returns month (1 … 12), day of the month and minute of the day at which a cell begins.
    pub fn date(&self, cell: usize) -> (u8, u8, u16) {
        let day = (cell / self.rows) as u16;
        let before = BEFORE[usize::from(self.days > 365)];
        let month = before.iter().rposition(|first| *first <= day).unwrap_or(0);
        ((month + 1) as u8, (day - before[month] + 1) as u8, (cell % self.rows * 1440 / self.rows) as u16)
    }

    /// Returns the date and the time span of a cell as text, such as `21 Jun, 12:00–13:00`.
    pub fn when(&self, cell: usize) -> String {
        let (month, day, start) = self.date(cell);
        let at = |minutes: usize| format!("{:02}:{:02}", minutes / 60, minutes % 60);
        let end = usize::from(start) + 1440 / self.rows;
        say::day_span(day, MONTHS[usize::from(month) - 1], at(usize::from(start)), at(end))
    }

    /// Returns the value of a cell as text with its unit, or the name of its state, or words that say why there is no
    /// value.
    pub fn words(&self, cell: usize) -> String {
        match (&self.colours, self.values[cell]) {
            (_, value) if value.is_nan() => {
                if self.from[cell].is_some() {
                    say::DARK.into()
                } else {
                    say::NOT_COMPUTED.into()
                }
            }
            (Colours::Scale(_, unit), value) => format!("{} {unit}", number(value, 4)).trim_end().to_owned(),
            (Colours::Names(names), value) => names.get(value as usize).cloned().unwrap_or_default(),
        }
    }

    /// Returns the colour of a cell; `None` where there is no value.
    pub fn colour(&self, cell: usize) -> Option<Rgb> {
        let value = self.values[cell];
        let coloured = |value: f64| match &self.colours {
            Colours::Scale(scale, _) => scale.rgb(value),
            Colours::Names(names) => name_colour(names.len(), value as usize),
        };
        (!value.is_nan()).then(|| coloured(value))
    }

    /// Returns a plot with the axes of the map, days across and hours upwards, without series.
    pub fn plot(&self) -> Plot {
        Plot {
            x: Axis::linear([0.0, self.days as f64], "", Unit::Days),
            y: Axis::linear([0.0, 24.0], "", Unit::Hours),
            series: Vec::new(),
            guides: Vec::new(),
        }
    }

    /// Draws the map and its legend into a frame. `mark`: index of a cell that gets a ring, such as that of the present
    /// time.
    pub fn draw(&self, drawing: &mut Drawing, frame: Frame, mark: Option<usize>, inks: &Inks) {
        let [above, below] = frame.cut_bottom(legend::HEIGHT);
        let plot = self.plot();
        let panel = chart::panel(drawing, above.inside([18.0, 0.0, 8.0, 0.0]), &plot, inks);
        drawing.add(Shape::area(panel.area.corners(), inks.face));
        self.cells(drawing, &panel);
        drawing.add(Shape::line(panel.area.outline(), inks.outline, 1.0));
        if let Some(cell) = mark {
            let at = panel.place(self.middle(cell));
            drawing.add(Shape::ring(at, 5.0, inks.sun, 2.5));
            drawing.add(Shape::ring(at, 6.5, [0; 3], 1.0));
        }
        let below = below.inside([40.0, 4.0, 8.0, 0.0]);
        match &self.colours {
            Colours::Scale(scale, unit) => legend::scale(drawing, below, scale, unit, inks),
            Colours::Names(names) => names_legend(drawing, below, names, inks),
        }
    }

    /// Draws the cells of the map; days of one colour that follow each other in a row are one rectangle.
    fn cells(&self, drawing: &mut Drawing, panel: &Panel<'_>) {
        let hour = |row: usize| row as f64 * 24.0 / self.rows as f64;
        for row in 0..self.rows {
            // Days of one colour side by side are one piece.
            let of = |day: usize| self.colour(day * self.rows + row);
            let mut day = 0;
            while day < self.days {
                let (first, colour) = (day, of(day));
                while day < self.days && of(day) == colour {
                    day += 1;
                }
                let Some(colour) = colour else { continue };
                let [left, bottom] = panel.place([first as f64, hour(row)]);
                let [right, top] = panel.place([day as f64, hour(row + 1)]);
                drawing.add(Shape::cell(Frame::new(left, top, right - left, bottom - top).corners(), colour));
            }
        }
    }

    /// Returns the map as a CSV table: month, day and time at which each cell begins, and its value or the name of its
    /// state; cells without a value are empty. `column`: heading of the values, without unit, which is added.
    pub fn csv(&self, column: &str) -> String {
        let unit = match &self.colours {
            Colours::Scale(_, unit) if !unit.is_empty() => format!(" ({unit})"),
            _ => String::new(),
        };
        let mut out = format!("month,day,start,{}\n", csv_cell(&format!("{column}{unit}")));
        for cell in 0..self.values.len() {
            let (month, day, start) = self.date(cell);
            let value = match (&self.colours, self.values[cell]) {
                (_, value) if value.is_nan() => String::new(),
                (Colours::Scale(..), value) => value.to_string(),
                (Colours::Names(names), value) => csv_cell(names.get(value as usize).map_or("", String::as_str)),
            };
            // Writing to a String cannot fail.
            let _ = writeln!(out, "{month},{day},{:02}:{:02},{value}", start / 60, start % 60);
        }
        out
    }
}

/// Returns the colour of the state with the given index, of `count` states in total.
pub fn name_colour(count: usize, index: usize) -> Rgb {
    ColourMap::Sequential.rgb(index as f32 / (count.max(2) - 1) as f32)
}

/// Draws a legend of the states' colours and names; if they do not all fit, only every n-th.
fn names_legend(drawing: &mut Drawing, frame: Frame, names: &[String], inks: &Inks) {
    let widest = names.iter().map(|name| font::width(name, TEXT)).fold(0.0, f64::max) + 28.0;
    let room = (frame.width / widest).max(1.0) as usize;
    let y = frame.top + 10.0;
    for (place, k) in (0..names.len()).step_by(names.len().div_ceil(room).max(1)).enumerate() {
        let x = frame.left + place as f64 * widest;
        let swatch = Frame::new(x, y - 5.0, 10.0, 10.0);
        drawing.add(Shape::area(swatch.corners(), name_colour(names.len(), k)));
        drawing.add(Shape::line(swatch.outline(), inks.outline, 1.0));
        drawing.add(Shape::words([x + 15.0, y], names[k].clone(), inks.ink, TEXT, Align::Start));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hours(leap: bool) -> Vec<Interval> {
        let days = [31, if leap { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
        let mut list = Vec::new();
        for (month, days) in (1..).zip(days) {
            for day in 1..=days {
                for hour in 0..24 {
                    let value = f64::from(hour) + 100.0 * f64::from(month);
                    list.push(Interval { month, day, minute: 60 * hour + 30, value });
                }
            }
        }
        list
    }

    fn map(intervals: &[Interval], length: f64) -> HourMap {
        let scale = ColourScale::up_to(1300.0, false, 3, ColourMap::Sequential);
        HourMap::of("light".to_owned(), Colours::Scale(scale, "lx"), length, intervals)
    }

    #[test]
    fn every_hour_of_a_year_has_its_cell_and_comes_back_from_it() {
        for leap in [false, true] {
            let list = hours(leap);
            let map = map(&list, 60.0);
            assert_eq!((map.days, map.rows, map.values.len()), (365 + usize::from(leap), 24, list.len()));
            for (k, one) in list.iter().enumerate() {
                let cell = map.cell(one.month, one.day, one.minute).unwrap();
                assert_eq!((map.values[cell], map.from[cell]), (one.value, Some(k as u32)));
                assert_eq!(map.date(cell), (one.month, one.day, one.minute - 30));
                let [day, hour] = map.middle(cell);
                assert_eq!(map.at(day, hour), cell);
            }
        }
        let common = map(&hours(false), 60.0);
        assert_eq!((common.cell(2, 29, 0), common.cell(3, 1, 0)), (common.cell(3, 1, 0), Some(59 * 24)));
        assert_eq!((common.cell(13, 1, 0), common.cell(0, 1, 0), common.cell(12, 31, 1440)), (None, None, None));
        assert_eq!(common.when(common.cell(6, 21, 750).unwrap()), "21 Jun, 12:00–13:00");
    }

    #[test]
    fn quarters_of_an_hour_have_rows_and_the_first_of_two_years_is_shown() {
        let of = |minute, value| Interval { month: 3, day: 1, minute, value };
        let map = map(&[of(7, 1.0), of(22, 2.0), of(7, 3.0), of(1433, f64::NAN)], 15.0);
        let cell = map.cell(3, 1, 0).unwrap();
        assert_eq!((map.rows, map.values[cell], map.values[cell + 1], map.from[cell]), (96, 1.0, 2.0, Some(0)));
        assert_eq!(map.beside(cell, 0, 1), Some(cell + 1));
        assert_eq!((map.beside(0, -1, 0), map.beside(map.values.len() - 1, 0, 1)), (None, None));
        // Known to be dark, and not computed.
        assert_eq!((map.words(cell + 95), map.words(cell + 2)), (say::DARK.into(), say::NOT_COMPUTED.into()));
        assert_eq!(map.colour(cell + 95), None);
    }

    #[test]
    fn a_picture_is_as_large_as_its_changes_and_numbers_are_those_shown() {
        let list = hours(false);
        let map = map(&list, 60.0);
        let mut drawing = Drawing::new(800.0, 400.0);
        let frame = drawing.frame();
        map.draw(&mut drawing, frame, map.cell(6, 21, 720), &Inks::LIGHT);
        // Twelve months of 24 rows, and what stands round them.
        assert!((12 * 24..12 * 24 + 300).contains(&drawing.shapes.len()), "{}", drawing.shapes.len());
        let csv = map.csv("light");
        assert!(csv.starts_with("month,day,start,light (lx)\n1,1,00:00,100\n1,1,01:00,101\n"));
        assert_eq!(csv.lines().count(), 1 + list.len());
    }
}
