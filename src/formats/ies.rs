//! IES LM-63 (`.ies`): keywords, then numbers in free format.
//!
//! Written: absolute photometry (−1 lm, multiplier 1) of type C with the full turn 0…360°, metres, lines of at most 132
//! characters, CRLF, editions 2002 and 2019. Read: 1986 to 2019, types A, B and C (only C is expanded to a full turn),
//! TILT=NONE and INCLUDE (the factors are told, not applied). Not read: tilt in another file.

use super::FormatError;
use super::location::excerpt;
use super::luminaire::{
    CLOSEST, Description, Luminaire, Opening, Photometry, ascii, at_line, check_rising, decode, number, plausible,
};
use crate::compute::btdf::Finding;
use std::borrow::Cow;

/// Editions that are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IesEdition {
    /// `IESNA:LM-63-2002`: what most programs read.
    Lm63_2002,
    /// `IES:LM-63-2019`: says in the file generation type that the data are computed.
    Lm63_2019,
}

const LINE_LIMIT: usize = 132;

/// Writes a luminaire of photometry C whose planes cover the full turn (or are one).
pub fn write(luminaire: &Luminaire, edition: IesEdition) -> Vec<u8> {
    let mut out = Vec::new();
    let (first_line, generation) = match edition {
        IesEdition::Lm63_2002 => ("IESNA:LM-63-2002", "1"),
        // 1.00010: computer simulation.
        IesEdition::Lm63_2019 => ("IES:LM-63-2019", "1.00010"),
    };
    out.push(first_line.to_owned());
    let text = &luminaire.text;
    for (keyword, value) in [
        ("TEST", &text.report),
        ("TESTLAB", &text.laboratory),
        ("ISSUEDATE", &text.date),
        ("MANUFAC", &text.manufacturer),
        ("LUMCAT", &text.number),
        ("LUMINAIRE", &text.name),
        ("LAMP", &text.lamp),
    ] {
        keyword_lines(&mut out, keyword, value);
    }
    for remark in &text.remarks {
        keyword_lines(&mut out, "OTHER", remark);
    }
    out.push("TILT=NONE".to_owned());
    let mut c_deg = luminaire.c_deg.clone();
    let mut planes: Vec<Cow<'_, [f64]>> = (0..c_deg.len()).map(|k| luminaire.plane(k).into()).collect();
    if c_deg.len() > 1 {
        // A turn begins at C0; of EULUMDAT it may begin elsewhere, and C0 is then what lies between its neighbours.
        if c_deg[0] > CLOSEST {
            let (first, last) = (c_deg[0], 360.0 - c_deg[c_deg.len() - 1]);
            let share = last / (first + last);
            let between =
                planes[planes.len() - 1].iter().zip(planes[0].iter()).map(|(a, b)| a + share * (b - a)).collect();
            c_deg.insert(0, 0.0);
            planes.insert(0, between);
        }
        c_deg[0] = 0.0;
        // A full turn repeats C0 at 360°, so that no reader assumes a symmetry.
        c_deg.push(360.0);
        planes.push(planes[0].clone());
    }
    let Opening { along_c0, along_c90, height } = luminaire.opening;
    // "Width" lies across the C0 plane, "length" along it.
    let sizes = [along_c90, along_c0, height].map(|metres| number(metres, 4)).join(" ");
    out.push(format!("1 -1 1 {} {} 1 2 {sizes}", luminaire.gamma_deg.len(), c_deg.len()));
    out.push(format!("1 {generation} {}", number(luminaire.power, 1)));
    wrap(&mut out, &luminaire.gamma_deg, 4);
    wrap(&mut out, &c_deg, 4);
    // Five significant digits of the peak at least.
    let decimals = (5.0 - luminaire.peak().max(1e-9).log10().floor()).clamp(2.0, 12.0) as usize;
    for plane in planes {
        wrap(&mut out, &plane, decimals);
    }
    let mut file = out.join("\r\n");
    file.push_str("\r\n");
    file.into_bytes()
}

/// `[KEYWORD] text`, continued by `[MORE]`; nothing of the text is lost.
fn keyword_lines(out: &mut Vec<String>, keyword: &str, value: &str) {
    let value = ascii(value);
    let mut line = format!("[{keyword}]");
    for word in value.split_whitespace() {
        // Words longer than a line are cut: the format knows no other way.
        let mut rest = word;
        while !rest.is_empty() {
            let (piece, after) = rest.split_at(rest.len().min(LINE_LIMIT - 16));
            if line.len() + 1 + piece.len() > LINE_LIMIT {
                out.push(std::mem::replace(&mut line, "[MORE]".to_owned()));
            }
            line.push(' ');
            line.push_str(piece);
            rest = after;
        }
    }
    if line.ends_with(']') {
        line.push_str(" unknown");
    }
    out.push(line);
}

/// Numbers on lines of limited length.
fn wrap(out: &mut Vec<String>, values: &[f64], decimals: usize) {
    let mut line = String::new();
    for &value in values {
        let text = number(value, decimals);
        if !line.is_empty() && line.len() + 1 + text.len() > LINE_LIMIT {
            out.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(&text);
    }
    out.push(line);
}

/// Reads an LM-63 file.
///
/// # Errors
/// No TILT line, tilt in another file, counts or types out of range, angles that do not increase, text among the
/// numbers, fewer numbers than the counts ask for. The first fault is told with its line.
pub fn read(bytes: &[u8]) -> Result<Luminaire, FormatError> {
    let (text, mut findings) = decode(bytes)?;
    let lines: Vec<&str> = text.lines().collect();
    let tilt_line = lines
        .iter()
        .position(|line| line.trim_start().to_ascii_uppercase().starts_with("TILT="))
        .ok_or_else(|| at_line(lines.len(), "no TILT line", "a line TILT=NONE or TILT=INCLUDE"))?;
    let format = lines[0].trim();
    let old = !format.contains("2002") && !format.contains("2019");
    let mut tokens = Tokens::new(&lines, tilt_line + 1);
    match lines[tilt_line].trim()[5..].trim().to_ascii_uppercase().as_str() {
        "NONE" => {}
        "INCLUDE" => {
            tokens.number("lamp to luminaire geometry")?;
            let count = tokens.count("number of tilt angles")?;
            let angles = tokens.take(count, "tilt angles")?;
            check_rising(&angles, tokens.line(), "tilt angle")?;
            tokens.take(count, "tilt factors")?;
            findings.push(Finding::info(
                "tilt-factors",
                format!("{count} tilt factors in the file; the intensities hold for the untilted luminaire"),
            ));
        }
        other => {
            return Err(at_line(
                tilt_line + 1,
                format!("TILT={}: an external tilt file, which is not available", excerpt(other)),
                "TILT=NONE or TILT=INCLUDE",
            ));
        }
    }

    let lamps = tokens.number("number of lamps")?;
    let lumens = tokens.number("lumens per lamp")?;
    let multiplier = tokens.number("candela multiplier")?;
    let angles = tokens.count("number of vertical angles")?;
    let planes = tokens.count("number of horizontal angles")?;
    let photometry = match tokens.choice("photometric type", "1 (C), 2 (B) or 3 (A)", 3)? {
        1 => Photometry::C,
        2 => Photometry::B,
        _ => Photometry::A,
    };
    let metres = match tokens.choice("units type", "1 (feet) or 2 (metres)", 2)? {
        1 => 0.3048,
        _ => 1.0,
    };
    let width = tokens.number("width")? * metres;
    let length = tokens.number("length")? * metres;
    let height = tokens.number("height")? * metres;
    let ballast = tokens.number("ballast factor")?;
    let ballast_lamp = tokens.number("ballast-lamp factor, future use or file generation type")?;
    let power = tokens.number("input watts")?;
    let gamma_deg = tokens.take(angles, "vertical angles")?;
    check_rising(&gamma_deg, tokens.line(), "vertical angle")?;
    let c_file = tokens.take(planes, "horizontal angles")?;
    check_rising(&c_file, tokens.line(), "horizontal angle")?;
    let table = tokens.take(angles * planes, "candela values")?;

    // The second factor counted in the older editions only; then it became "future use" and the generation type.
    let factor = multiplier * ballast * if old { ballast_lamp } else { 1.0 };
    if factor != 1.0 {
        findings.push(Finding::info("multiplier", format!("candela values multiplied by {factor}")));
    }
    let (c_deg, source) = match photometry {
        Photometry::C => expand(&c_file, tokens.line())?,
        Photometry::A | Photometry::B => {
            findings.push(Finding::warning(
                "not-type-c",
                "photometric type is not C: planes and angles are shown as they stand, no flux is computed",
            ));
            (c_file.clone(), (0..planes).collect())
        }
    };
    let intensity =
        source.iter().flat_map(|&plane: &usize| &table[plane * angles..][..angles]).map(|v| v * factor).collect();
    let keyword = |name: &str| keyword_value(&lines[..tilt_line], name);
    let date = keyword("ISSUEDATE");
    plausible(Luminaire {
        format: if format.starts_with("IES") { format.to_owned() } else { "LM-63-1986".to_owned() },
        text: Description {
            report: keyword("TEST"),
            laboratory: keyword("TESTLAB"),
            date: if date.is_empty() { keyword("DATE") } else { date },
            manufacturer: keyword("MANUFAC"),
            number: keyword("LUMCAT"),
            name: keyword("LUMINAIRE"),
            lamp: keyword("LAMP"),
            remarks: vec![keyword("OTHER")].into_iter().filter(|text| !text.is_empty()).collect(),
        },
        photometry,
        opening: Opening { along_c0: length, along_c90: width, height },
        c_deg,
        gamma_deg,
        intensity,
        lamp_flux: (lumens > 0.0).then_some(lamps * lumens),
        power,
        findings,
    })
}

/// Value of a keyword with its `[MORE]` lines; empty when it is not there.
fn keyword_value(lines: &[&str], name: &str) -> String {
    let mut parts = Vec::new();
    let mut inside = false;
    for line in lines {
        let Some((keyword, value)) = line.trim().strip_prefix('[').and_then(|rest| rest.split_once(']')) else {
            continue;
        };
        inside = keyword.eq_ignore_ascii_case(name) || (inside && keyword.eq_ignore_ascii_case("MORE"));
        if inside {
            parts.push(value.trim());
        }
    }
    parts.join(" ").trim().to_owned()
}

/// Planes of the full turn and, for each, which of the file's planes it copies.
fn expand(c_file: &[f64], line: usize) -> Result<(Vec<f64>, Vec<usize>), FormatError> {
    let (first, last) = (c_file[0], c_file[c_file.len() - 1]);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    if c_file.len() == 1 {
        return Ok((vec![0.0], vec![0]));
    }
    let mut all: Vec<(f64, usize)> = c_file.iter().copied().zip(0..).collect();
    if near(first, 0.0) && near(last, 90.0) {
        // Symmetric about both planes: first about C90–C270, then about C0–C180.
        all.extend(c_file.iter().zip(0..).map(|(c, k)| (180.0 - c, k)));
    } else if near(first, 90.0) && near(last, 270.0) {
        all.extend(c_file.iter().zip(0..).map(|(c, k)| ((540.0 - c).rem_euclid(360.0), k)));
    } else if !(near(first, 0.0) && (near(last, 180.0) || last > 180.0 && last <= 360.0 + 1e-6)) {
        return Err(at_line(
            line,
            format!("horizontal angles from {first} to {last}"),
            "0 alone, 0 to 90, 0 to 180, 0 to 360 or 90 to 270",
        ));
    }
    let half_turn = all.iter().all(|(c, _)| *c <= 180.0 + 1e-6);
    if half_turn {
        all.extend(all.clone().into_iter().map(|(c, k)| ((360.0 - c).rem_euclid(360.0), k)));
    }
    for (c, _) in &mut all {
        if near(*c, 360.0) {
            *c = 0.0;
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.dedup_by(|a, b| near(a.0, b.0));
    Ok(all.into_iter().unzip())
}

/// Numbers after the TILT line, each with its line.
struct Tokens<'a> {
    tokens: Vec<(usize, &'a str)>,
    next: usize,
}

impl<'a> Tokens<'a> {
    fn new(lines: &[&'a str], from: usize) -> Self {
        let tokens = lines[from..]
            .iter()
            .zip(from + 1..)
            .flat_map(|(line, number)| {
                line.split(|c: char| c.is_whitespace() || c == ',')
                    .filter(|token| !token.is_empty())
                    .map(move |token| (number, token))
            })
            .collect();
        Self { tokens, next: 0 }
    }

    /// Line of the token read last.
    fn line(&self) -> usize {
        self.tokens.get(self.next.saturating_sub(1)).or(self.tokens.last()).map_or(1, |token| token.0)
    }

    fn number(&mut self, name: &str) -> Result<f64, FormatError> {
        let Some(&(line, token)) = self.tokens.get(self.next) else {
            return Err(at_line(self.line(), "the end of the file", name));
        };
        self.next += 1;
        token.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(|| {
            let shown: String = token.chars().take(40).collect();
            at_line(line, format!("\"{shown}\""), format!("a number ({name})"))
        })
    }

    /// A count of things of which at least as many numbers must follow.
    fn count(&mut self, name: &str) -> Result<usize, FormatError> {
        let value = self.number(name)?;
        if !(1.0..=3601.0).contains(&value) || value.fract() != 0.0 {
            return Err(at_line(self.line(), format!("{name} {value}, out of range"), "a whole number from 1 to 3601"));
        }
        Ok(value as usize)
    }

    fn choice(&mut self, name: &str, allowed: &str, max: u8) -> Result<u8, FormatError> {
        let value = self.number(name)?;
        (1..=max)
            .find(|&choice| value == f64::from(choice))
            .ok_or_else(|| at_line(self.line(), format!("{name} {value}"), format!("{name} must be {allowed}")))
    }

    fn take(&mut self, count: usize, name: &str) -> Result<Vec<f64>, FormatError> {
        let left = self.tokens.len() - self.next;
        if left < count {
            // Text among the numbers explains more than the count does.
            for _ in 0..left {
                self.number(name)?;
            }
            return Err(at_line(
                self.line(),
                format!("only {left} {name}, then the end of the file"),
                format!("{count} {name}"),
            ));
        }
        (0..count).map(|_| self.number(name)).collect()
    }
}
