//! EULUMDAT (`.ldt`), after Stockmar (1990): one value per line, intensities in cd/klm.
//!
//! Written: all planes of the full turn (Isym 0), CRLF, printable ASCII, millimetres. Read: every symmetry, one or more
//! lamp sets (the first one counts: sets are alternatives), decimal commas, byte-order mark, blank lines after the
//! header; LORL, DFF, tilt and steps are compared with the table, numbers after the last intensity are reported. Not
//! used: direct ratios and colour data.

use super::FormatError;
use super::location::excerpt;
use super::luminaire::{Description, Luminaire, Opening, Photometry, Shape};
use super::luminaire_check::{Stated, checked, closing_plane, surplus};
use super::luminaire_planes::{CLOSEST, Mirrors, Turn, check_rising, same_angle};
use super::luminaire_text::{ascii, at_line, decode, number, parse_number};
use crate::compute::btdf::Finding;
use crate::compute::limits;

const OPENING_LINE: usize = 16;
const DOWNWARD_LINE: usize = 22;
const OUTPUT_RATIO_LINE: usize = 23;
const TILT_LINE: usize = 25;
const LAMP_SETS_LINE: usize = 26;
/// Minimum luminous flux of the lamps; lamps with less are written as lamps of 1000 lm. \[lm\]
const LEAST_LAMPS: f64 = 0.1;
const MAX_PLANES: f64 = limits::LUMINAIRE_PLANES as f64;
const MAX_ANGLES: f64 = limits::LUMINAIRE_ANGLES as f64;

/// Returns an EULUMDAT file of a luminaire of photometry C, whose planes cover the full turn (or are a single one).
///
/// The rated flux is the zonal sum of the written intensities if the luminaire states none. All four heights of the
/// luminous area are the height of the opening, so that the luminous area is 0 in no direction. A width of 0 marks a
/// circle, so that another side of length 0 is written as 1 mm, except for a point.
pub fn write(luminaire: &Luminaire) -> Vec<u8> {
    let flux = luminaire.flux();
    let rated = luminaire.lamp_flux.unwrap_or(flux);
    // Lamps of next to no light: the flux that the file can say would not be the one that intensities are divided by.
    let light = luminaire.peak().max(rated) > 0.0;
    let rated = if rated < LEAST_LAMPS && light { 1000.0 } else { rated.min(limits::LAMP_FLUX) };
    let planes = luminaire.c_deg.len();
    let text = &luminaire.text;
    let mut lines = Vec::with_capacity(64 + planes * (luminaire.gamma_deg.len() + 1));
    let limited = |text: &str, limit: usize| ascii(text).trim().chars().take(limit).collect::<String>();

    lines.push(limited(&text.manufacturer, 78));
    // Ityp 3: neither rotationally symmetric nor linear; Isym 0: no symmetry claimed, 1: one plane for all.
    lines.push(if planes == 1 { "1" } else { "3" }.to_owned());
    lines.push(if planes == 1 { "1" } else { "0" }.to_owned());
    lines.push(planes.to_string());
    lines.push(number(even_step(&luminaire.c_deg, planes > 1), 4));
    lines.push(luminaire.gamma_deg.len().to_string());
    lines.push(number(even_step(&luminaire.gamma_deg, false), 4));
    lines.push(limited(&text.report, 78));
    lines.push(limited(&text.name, 78));
    lines.push(limited(&text.number, 78));
    lines.push(limited(&text.number, 8));
    lines.push(limited(&[&text.date, " ", &text.laboratory].concat(), 78));
    let mm = |metres: f64| number((1000.0 * metres).round(), 0);
    let Opening { along_c0, along_c90, height, .. } = luminaire.opening;
    let at_least_1 = |metres: f64| mm(metres.max(0.001));
    let [length, width] = if luminaire.opening.is_circle() {
        [at_least_1(along_c90), "0".to_owned()]
    } else if along_c0.max(along_c90).max(height) == 0.0 {
        ["0", "0"].map(str::to_owned)
    } else {
        [along_c90, along_c0].map(at_least_1)
    };
    // The housing is the opening.
    lines.extend([length.clone(), width.clone(), mm(height), length, width]);
    lines.extend(std::iter::repeat_n(mm(height), 4));
    let downward = luminaire.flux_within(90.0);
    lines.push(number(if flux > 0.0 { 100.0 * downward / flux } else { 0.0 }, 2));
    lines.push(number(if rated > 0.0 { (100.0 * flux / rated).min(100.0) } else { 100.0 }, 2));
    lines.extend(["1", "0", "1", "1"].map(str::to_owned));
    lines.push(limited(&text.lamp, 24));
    lines.push(number(rated, 4));
    lines.extend([String::new(), String::new()]);
    lines.push(number(luminaire.power, 1));
    lines.extend(direct_ratios(luminaire).map(|ratio| number(ratio, 3)));
    lines.extend(luminaire.c_deg.iter().chain(&luminaire.gamma_deg).map(|&angle| number(angle, 4)));
    let per_klm = if rated > 0.0 { 1000.0 / rated } else { 0.0 };
    lines.extend(luminaire.intensity.iter().map(|&cd| number(cd * per_klm, 4)));
    let mut out = lines.join("\r\n");
    out.push_str("\r\n");
    out.into_bytes()
}

/// Returns the step of equally spaced angles \[°\]; 0 when they are not equally spaced, as the format defines.
fn even_step(angles: &[f64], closes_the_turn: bool) -> f64 {
    let Some(step) = angles.windows(2).map(|pair| pair[1] - pair[0]).next() else { return 0.0 };
    let even = angles.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-6);
    let closed = !closes_the_turn || (step * angles.len() as f64 - 360.0).abs() < 1e-6;
    if even && closed { step } else { 0.0 }
}

/// Returns the direct ratios of a luminaire: shares of the downward flux that reach the work plane without reflection,
/// for the room indices 0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5: a regular array on a ceiling, from the fluxes within
/// 41.4°, 60°, 75.5° and 90° (zonal method of LiTG publication 3.5). For one aperture in a wall this is only a number
/// that the format requires.
pub fn direct_ratios(luminaire: &Luminaire) -> [f64; 10] {
    // Weights of the four cumulated fluxes; each column of four sums to 1.
    const WEIGHTS: [[f64; 10]; 4] = [
        [0.943, 0.752, 0.636, 0.510, 0.429, 0.354, 0.286, 0.258, 0.236, 0.231],
        [-0.317, -0.033, 0.121, 0.238, 0.275, 0.248, 0.190, 0.118, -0.006, -0.099],
        [0.481, 0.372, 0.310, 0.282, 0.309, 0.363, 0.416, 0.463, 0.512, 0.518],
        [-0.107, -0.091, -0.067, -0.030, -0.013, 0.035, 0.108, 0.161, 0.258, 0.350],
    ];
    let fluxes = [41.4, 60.0, 75.5, 90.0].map(|gamma| luminaire.flux_within(gamma));
    let downward = fluxes[3];
    std::array::from_fn(|k| {
        if downward <= 0.0 {
            return 0.0;
        }
        WEIGHTS.iter().zip(fluxes).map(|(weights, flux)| weights[k] * flux).sum::<f64>() / downward
    })
}

/// Reads an EULUMDAT file.
///
/// # Errors
/// Returns an error with its line if the header ends early, if counts or the symmetry indicator are out of range, if
/// angles do not increase, if a listed plane is not an image of one with intensities, if there is text where a number
/// belongs, or if there are fewer intensities than the counts require.
pub fn read(bytes: &[u8]) -> Result<Luminaire, FormatError> {
    let (text, mut findings) = decode(bytes)?;
    let lines = Lines { lines: text.lines().map(str::trim).collect() };
    let symmetry = lines.whole(3, "symmetry indicator Isym", 0.0, 4.0)?;
    let planes = lines.whole(4, "number of C planes Mc", 1.0, MAX_PLANES)?;
    let step_c = lines.number_or_zero(5, "distance of C planes")?;
    let angles = lines.whole(6, "number of gamma angles Ng", 1.0, MAX_ANGLES)?;
    let step_gamma = lines.number_or_zero(7, "distance of gamma angles")?;
    lines.header(LAMP_SETS_LINE)?;
    let output_ratio = lines.percent(OUTPUT_RATIO_LINE, "light output ratio LORL [%]")?;
    let downward = lines.percent(DOWNWARD_LINE, "downward flux fraction DFF [%]")?;
    let conversion = lines.number_or_zero(24, "conversion factor")?;
    let tilt = lines.number_or_zero(TILT_LINE, "tilt of the luminaire [°]")?;
    let lamp_sets = lines.whole(LAMP_SETS_LINE, "number of lamp sets", 1.0, 20.0)?;
    let lamp_line = LAMP_SETS_LINE + 1;
    let ratios_line = lamp_line + 6 * lamp_sets;
    lines.header(ratios_line + 9)?;
    let flux = lines.number_or_zero(lamp_line + 2, "total luminous flux of the lamps [lm]")?;

    let mut values = Values { lines: &lines, next: ratios_line + 10 };
    let c_line = values.next;
    let c_all = values.take(planes, "C angles")?;
    check_rising(&c_all, c_line, "C angle")?;
    let gamma_line = values.next;
    let gamma_deg = values.take(angles, "gamma angles")?;
    check_rising(&gamma_deg, gamma_line, "gamma angle")?;

    let stored = StoredPlanes::new(symmetry, &c_all);
    let Turn { c_deg, source } = stored.turn(c_line)?;
    let due = stored.c_deg.len() * angles;
    let table = values.take(due, "intensities")?;
    let counts = format!("Isym {symmetry}: {angles} angles in {} of {planes} planes", stored.c_deg.len());
    findings.extend(values.rest(due, &counts));
    findings.extend(closing_plane(&stored.c_deg, &table));
    findings.extend(stored.remark);
    findings.extend(step_contradicts("Dc", 5, step_c, &c_all));
    findings.extend(step_contradicts("Dg", 7, step_gamma, &gamma_deg));
    if tilt != 0.0 {
        let message =
            format!("line {TILT_LINE}: tilted by {tilt}° when it was measured; the intensities hold for that");
        findings.push(Finding::info("tilt", message));
    }
    if lamp_sets > 1 {
        findings.push(Finding::info(
            "several-lamp-sets",
            format!("{lamp_sets} lamp sets, which are alternatives; the first one ({flux} lm) is used"),
        ));
    }
    let factor = if conversion > 0.0 { conversion } else { 1.0 };
    if factor != 1.0 {
        findings.push(Finding::info("conversion-factor", format!("intensities multiplied by {factor}")));
    }
    // A dark luminaire needs no lamps.
    let is_dark = table.iter().all(|value| *value == 0.0);
    if flux <= 0.0 && !is_dark {
        findings.push(Finding::warning("no-lamp-flux", "no luminous flux of lamps; intensities are for 1000 lm"));
    }
    let rated = if flux > 0.0 || is_dark { flux } else { 1000.0 };
    let from_plane = |plane: usize| &table[plane * angles..][..angles];
    let intensity = source.iter().flat_map(|&plane| from_plane(plane)).map(|v| v * rated * factor / 1000.0).collect();
    let luminaire = Luminaire {
        format: "EULUMDAT".to_owned(),
        text: Description {
            report: lines.text(8),
            laboratory: String::new(),
            date: lines.text(12),
            manufacturer: lines.text(1),
            number: lines.text(10),
            name: lines.text(9),
            lamp: lines.text(lamp_line + 1),
            remarks: Vec::new(),
        },
        photometry: Photometry::C,
        opening: lines.opening(&mut findings)?,
        c_deg,
        gamma_deg,
        intensity,
        lamp_flux: Some(rated),
        power: lines.number_or_zero(lamp_line + 5, "power [W]").unwrap_or(0.0),
        findings,
    };
    let stated = Stated {
        lamps: (flux > 0.0).then_some(flux),
        lamps_line: lamp_line + 2,
        output_ratio,
        downward: downward.map(|share| (share, DOWNWARD_LINE)),
        opening_line: OPENING_LINE,
        is_per_klm: true,
    };
    checked(luminaire, &stated)
}

/// Returns a finding if the angular step that the header states differs from that between the first two angles of its
/// list.
fn step_contradicts(name: &str, line: usize, step: f64, angles: &[f64]) -> Option<Finding> {
    let [first, second, ..] = angles else { return None };
    let listed = second - first;
    (step > 0.0 && (listed - step).abs() > 1e-3).then(|| {
        Finding::warning(
            "step-contradicts-angles",
            format!(
                "line {line}: {name} is {step}° but the listed angles are {}° apart; the list is used",
                number(listed, 4)
            ),
        )
    })
}

/// C planes whose intensities the file contains, and those that it lists.
struct StoredPlanes<'a> {
    symmetry: usize,
    /// Planes that the file lists, without one at 360° that repeats the first and has no intensities. \[°\]
    listed: &'a [f64],
    /// Angles C of the planes with intensities, in the order of the table. \[°\]
    c_deg: Vec<f64>,
    /// Finding on a list of planes that deviates from the format.
    remark: Option<Finding>,
}

impl<'a> StoredPlanes<'a> {
    /// Determines the planes with intensities from the symmetry indicator and the list of the file `c_all` \[°\], which
    /// should contain the planes of the full turn, whatever the symmetry.
    fn new(symmetry: usize, c_all: &'a [f64]) -> Self {
        let count = c_all.len();
        let (first, last) = (c_all[0], c_all[count - 1]);
        if matches!(symmetry, 0 | 1) {
            let c_deg = if symmetry == 1 { vec![0.0] } else { c_all.to_vec() };
            return Self { symmetry, listed: &c_all[..c_deg.len()], c_deg, remark: None };
        }
        let is_closed = count > 1 && same_angle(last, first + 360.0);
        let listed = if is_closed { &c_all[..count - 1] } else { c_all };
        let n = listed.len();
        let [low, high] = match symmetry {
            2 => [0.0, 180.0],
            3 => [90.0, 270.0],
            _ => [0.0, 90.0],
        };
        let is_part = n > 1 && first > low - CLOSEST && last < high + CLOSEST;
        let c_deg = match symmetry {
            _ if is_part => listed.to_vec(),
            2 => listed[..=n / 2].to_vec(),
            // From C270 over C0 to C90.
            3 => (0..=n / 2).map(|k| listed[(k + 3 * n / 4) % n]).collect(),
            _ => listed[..=n / 4].to_vec(),
        };
        let finding = |what: String| {
            Finding::info("planes-not-of-the-turn", format!("line 4: Mc is {count}, {what}; Isym {symmetry} by angle"))
        };
        let remark = if is_closed {
            Some(finding(format!("with the plane at {last}°, which is the one at {first}° again: {n} planes are used")))
        } else if is_part && n > 2 {
            Some(finding(format!("planes from {first}° to {last}°, where the format counts those of the full turn")))
        } else {
            None
        };
        Self { symmetry, listed, c_deg, remark }
    }

    /// Returns all planes of the full turn, at the listed angles, with the stored plane that each copies.
    fn turn(&self, line: usize) -> Result<Turn, FormatError> {
        let (mirrors, about) = match self.symmetry {
            2 => (Mirrors::C0, "C0-C180"),
            3 => (Mirrors::C90, "C90-C270"),
            4 => (Mirrors::Both, "C0-C180 and C90-C270"),
            _ => (Mirrors::None, ""),
        };
        let mut turn = Turn::new(&self.c_deg, mirrors);
        // One plane stands for all.
        if mirrors == Mirrors::None || self.c_deg.len() == 1 {
            return Ok(turn);
        }
        for listed in self.listed {
            let Some(c) = turn.c_deg.iter_mut().find(|c| same_angle(**c, *listed)) else {
                return Err(at_line(
                    line,
                    format!("a plane at C {listed}°, which is not an image of a plane with intensities"),
                    format!("planes that are images of each other about {about}, as Isym {} says", self.symmetry),
                ));
            };
            *c = *listed;
        }
        Ok(turn)
    }
}

struct Lines<'a> {
    lines: Vec<&'a str>,
}

impl Lines<'_> {
    /// Returns an error if the file is shorter than the header.
    fn header(&self, line: usize) -> Result<(), FormatError> {
        if self.lines.len() < line {
            return Err(at_line(
                self.lines.len(),
                "the end of the file in the header",
                format!("at least {line} header lines"),
            ));
        }
        Ok(())
    }

    fn text(&self, line: usize) -> String {
        self.lines.get(line - 1).copied().unwrap_or_default().to_owned()
    }

    fn number_or_zero(&self, line: usize, name: &str) -> Result<f64, FormatError> {
        self.header(line)?;
        match self.lines[line - 1] {
            "" => Ok(0.0),
            text => parse(text, line, name),
        }
    }

    /// Returns a value stated in percent as a share, 0 … 1; `None` where the line is blank.
    fn percent(&self, line: usize, name: &str) -> Result<Option<f64>, FormatError> {
        let value = self.number_or_zero(line, name)?;
        Ok((!self.lines[line - 1].is_empty()).then_some(value / 100.0))
    }

    /// Returns the luminous opening that the file states; a width of 0 marks a circle whose diameter is the length.
    fn opening(&self, findings: &mut Vec<Finding>) -> Result<Opening, FormatError> {
        let mut sizes = [0.0; 6];
        for (size, line) in sizes.iter_mut().zip(OPENING_LINE..) {
            let mm = self.number_or_zero(line, "a size of the luminous area [mm]")?;
            if mm < 0.0 {
                let message = format!("line {line}: a size of {mm} mm is less than 0; its magnitude is used");
                findings.push(Finding::warning("negative-size", message));
            }
            *size = mm.abs() / 1000.0;
        }
        let [length, width, heights @ ..] = sizes;
        let height = heights.into_iter().fold(0.0, f64::max);
        if width == 0.0 && length > 0.0 {
            return Ok(Opening { shape: Shape::Round, along_c0: length, along_c90: length, height });
        }
        Ok(Opening::rectangular(width, length, height))
    }

    fn whole(&self, line: usize, name: &str, min: f64, max: f64) -> Result<usize, FormatError> {
        let value = self.number_or_zero(line, name)?;
        if !(min..=max).contains(&value) || value.fract() != 0.0 {
            return Err(at_line(
                line,
                format!("{name} {value}, out of range"),
                format!("a whole number from {min} to {max}"),
            ));
        }
        Ok(value as usize)
    }
}

/// Numbers of a file, one per line, from a given line on, without blank lines.
struct Values<'a, 'b> {
    lines: &'a Lines<'b>,
    /// Number of the line to read next, from 1.
    next: usize,
}

impl Values<'_, '_> {
    /// Returns a finding on numbers and text after the last value; `due`: number of values required, `counts`: their
    /// counts as text.
    fn rest(&self, due: usize, counts: &str) -> Option<Finding> {
        let left = self.lines.lines.iter().zip(1..).skip(self.next - 1);
        let left = left.map(|(text, line)| (text.trim_matches('\u{1a}'), line)).filter(|(text, _)| !text.is_empty());
        let line = left.clone().map(|(_, line)| line).next()?;
        let numbers = left.filter(|(text, _)| parse(text, line, "").is_ok()).count();
        Some(if numbers > 0 {
            surplus(due + numbers, due, line, counts)
        } else {
            Finding::info("text-after-values", format!("line {line}: text after the last intensity is not read"))
        })
    }

    fn take(&mut self, count: usize, name: &str) -> Result<Vec<f64>, FormatError> {
        let mut values = Vec::new();
        while values.len() < count {
            let Some(text) = self.lines.lines.get(self.next - 1) else {
                return Err(at_line(
                    self.lines.lines.len(),
                    format!("the end of the file after {} of {count} {name}", values.len()),
                    format!("{count} {name}"),
                ));
            };
            if !text.is_empty() {
                values.push(parse(text, self.next, name)?);
            }
            self.next += 1;
        }
        Ok(values)
    }
}

fn parse(text: &str, line: usize, name: &str) -> Result<f64, FormatError> {
    let point = |text: &str| parse_number(&text.replace(',', "."));
    point(text).ok_or_else(|| {
        let several = text.split_whitespace().all(|piece| point(piece).is_some());
        let remedy = if several { ", one on a line: a line break is missing" } else { "" };
        at_line(line, format!("\"{}\"", excerpt(text)), format!("a number ({name}){remedy}"))
    })
}
