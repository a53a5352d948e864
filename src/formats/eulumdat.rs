//! EULUMDAT (`.ldt`), after Stockmar (1990): one value a line, intensities in cd/klm.
//!
//! Written: all planes of the full turn (Isym 0), CRLF, printable ASCII, millimetres. Read: every symmetry, one or more
//! lamp sets (the first one counts: sets are alternatives), decimal commas, byte-order mark, blank lines after the
//! header, whatever follows the last intensity. Not read: nothing is made of direct ratios and colour data.

use super::FormatError;
use super::luminaire::{
    Description, Luminaire, Opening, Photometry, ascii, at_line, check_rising, decode, number, plausible,
};
use crate::compute::btdf::Finding;
use crate::compute::limits;

const LAMP_SETS_LINE: usize = 26;
/// Lamps of less flux are written as lamps of 1000 lm. \[lm\]
const LEAST_LAMPS: f64 = 0.1;
const MAX_PLANES: f64 = limits::LUMINAIRE_PLANES as f64;
const MAX_ANGLES: f64 = limits::LUMINAIRE_ANGLES as f64;

/// Writes a luminaire of photometry C. Its planes must cover the full turn (or be one).
///
/// The rated flux is the flux of the file's own zonal sum when the luminaire states none. Four heights of the luminous
/// area are the opening's height on all sides, so that no direction divides by an area of nothing; a width of zero
/// would mean a round luminaire and is written as 1 mm.
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
    let mm = |metres: f64| number((1000.0 * metres.abs()).round(), 0);
    let at_least_1 = |metres: f64| mm(metres.abs().max(0.001));
    let Opening { along_c0, along_c90, height } = luminaire.opening;
    // The housing is the opening.
    lines.extend([at_least_1(along_c90), at_least_1(along_c0), mm(height)]);
    lines.extend([at_least_1(along_c90), at_least_1(along_c0)]);
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

/// Step of evenly spaced angles, 0 when they are not (as the format wants it).
fn even_step(angles: &[f64], closes_the_turn: bool) -> f64 {
    let Some(step) = angles.windows(2).map(|pair| pair[1] - pair[0]).next() else { return 0.0 };
    let even = angles.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-6);
    let closed = !closes_the_turn || (step * angles.len() as f64 - 360.0).abs() < 1e-6;
    if even && closed { step } else { 0.0 }
}

/// Share of the downward flux that reaches the work plane without reflection, for the room indices 0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5: the regular array
/// of a ceiling, from the fluxes within 41.4°, 60°, 75.5° and 90° (zonal method of LiTG publication 3.5).
/// For one aperture in a wall this is no more than a number that the format asks for.
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
/// A header that ends early, counts or the symmetry indicator out of range, angles that do not increase, text where a
/// number belongs, fewer intensities than the counts ask for. The first fault is told with its line.
pub fn read(bytes: &[u8]) -> Result<Luminaire, FormatError> {
    let (text, mut findings) = decode(bytes)?;
    let lines = Lines { lines: text.lines().map(str::trim).collect() };
    let symmetry = lines.whole(3, "symmetry indicator Isym", 0.0, 4.0)?;
    let planes = lines.whole(4, "number of C planes Mc", 1.0, MAX_PLANES)?;
    let step_c = lines.number_or_zero(5, "distance of C planes")?;
    let angles = lines.whole(6, "number of gamma angles Ng", 1.0, MAX_ANGLES)?;
    lines.header(LAMP_SETS_LINE)?;
    let conversion = lines.number_or_zero(24, "conversion factor")?;
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

    let stored = stored_planes(symmetry, planes);
    let table = values.take(stored.len() * angles, "intensities")?;
    if planes > 1 && step_c > 0.0 && (c_all[1] - c_all[0] - step_c).abs() > 1e-3 {
        findings.push(Finding::warning(
            "step-contradicts-angles",
            format!("Dc is {step_c}° but the listed C planes are {}° apart; the list is used", c_all[1] - c_all[0]),
        ));
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
    if flux <= 0.0 {
        findings.push(Finding::warning("no-lamp-flux", "no luminous flux of lamps; intensities are for 1000 lm"));
    }
    let rated = if flux > 0.0 { flux } else { 1000.0 };
    let from_plane = |plane: usize| &table[plane * angles..][..angles];
    let (c_deg, source) = expand(symmetry, &c_all, &stored);
    let intensity = source.iter().flat_map(|&plane| from_plane(plane)).map(|v| v * rated * factor / 1000.0).collect();
    let metres = |line: usize, name| lines.number_or_zero(line, name).map(|mm| mm / 1000.0);
    let along_c90 = metres(16, "length of the luminous area [mm]")?;
    let along_c0 = metres(17, "width of the luminous area [mm]")?;
    let heights = [18, 19, 20, 21].map(|line| metres(line, "height of the luminous area [mm]"));
    let mut height = 0.0_f64;
    for each in heights {
        height = height.max(each?);
    }
    plausible(Luminaire {
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
        // A width of 0 says that the length is a diameter.
        opening: Opening { along_c0: if along_c0 == 0.0 { -along_c90 } else { along_c0 }, along_c90, height },
        c_deg,
        gamma_deg,
        intensity,
        lamp_flux: Some(rated),
        power: lines.number_or_zero(lamp_line + 5, "power [W]").unwrap_or(0.0),
        findings,
    })
}

/// Numbers, in the list of all C planes, of the planes whose intensities are in the file.
fn stored_planes(symmetry: usize, planes: usize) -> Vec<usize> {
    match symmetry {
        1 => vec![0],
        2 => (0..=planes / 2).collect(),
        // From C270 over C0 to C90.
        3 => (0..=planes / 2).map(|k| (k + 3 * planes / 4) % planes).collect(),
        4 => (0..=planes / 4).collect(),
        _ => (0..planes).collect(),
    }
}

/// Planes of the full turn and, for each, which of the stored ones it copies.
fn expand(symmetry: usize, c_all: &[f64], stored: &[usize]) -> (Vec<f64>, Vec<usize>) {
    let planes = c_all.len();
    if symmetry == 1 {
        return (vec![0.0], vec![0]);
    }
    let find = |plane: usize| stored.iter().position(|&s| s == plane % planes);
    let source = (0..planes)
        .map(|plane| {
            let across_c0 = (planes - plane) % planes;
            let across_c90 = (planes + planes / 2 - plane) % planes;
            // Mirror images in turn; the first one that the file holds.
            [plane, across_c0, across_c90, (plane + planes / 2) % planes].into_iter().find_map(find).unwrap_or(0)
        })
        .collect();
    // A list that ends at 360° repeats its first plane.
    let mut pair: (Vec<f64>, Vec<usize>) = (c_all.to_vec(), source);
    if planes > 1 && c_all[planes - 1] >= c_all[0] + 360.0 - 1e-9 {
        pair.0.pop();
        pair.1.pop();
    }
    pair
}

struct Lines<'a> {
    lines: Vec<&'a str>,
}

impl Lines<'_> {
    /// Fails when the file is shorter than the header.
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

/// Non-blank lines of numbers from a given line on.
struct Values<'a, 'b> {
    lines: &'a Lines<'b>,
    /// Line to read next, from 1.
    next: usize,
}

impl Values<'_, '_> {
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
    let value = text.replace(',', ".").parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| {
        let shown: String = text.chars().take(40).collect();
        at_line(line, format!("\"{shown}\""), format!("a number ({name})"))
    })
}
