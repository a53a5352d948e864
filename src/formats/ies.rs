//! IES LM-63 (`.ies`): luminaire files with keywords, followed by numbers in free format.
//!
//! Written: absolute photometry (−1 lm, multiplier 1) of type C with the full turn 0…360°, metres, lines of at most 132
//! characters, CRLF, editions 2002 and 2019. Read: 1986 to 2019, types A, B and C (only C is expanded to a full turn),
//! TILT=NONE and INCLUDE (the factors are reported, not applied), openings of both generations of editions. Not read:
//! tilt in another file.

use super::FormatError;
use super::ies_tokens::Tokens;
use super::location::excerpt;
use super::luminaire::{Description, Luminaire, Opening, Photometry};
use super::luminaire_check::{Stated, checked, closing_plane, surplus};
use super::luminaire_planes::{CLOSEST, Mirrors, Turn, check_rising, same_angle};
use super::luminaire_text::{ascii, at_line, decode, number};
use crate::compute::btdf::Finding;
use std::borrow::Cow;

/// Edition of the standard IES LM-63 in which a luminaire file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IesEdition {
    /// `IESNA:LM-63-2002`, which most programs read.
    Lm63_2002,
    /// `IES:LM-63-2019`, whose file generation type says that the data are computed.
    Lm63_2019,
}

const LINE_LIMIT: usize = 132;
/// Value of the field "lumens per lamp" that marks absolute photometry.
const ABSOLUTE: f64 = -1.0;

/// Returns an IES file of a luminaire of photometry C whose planes cover the full turn (or are a single one).
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
    let sizes = luminaire.opening.to_lm63().map(|metres| number(metres, 4)).join(" ");
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

/// Adds the lines `[KEYWORD] text` to the file, continued by `[MORE]` lines where the text is long.
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

/// Adds numbers to the file, on lines of limited length.
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

/// Reads an IES LM-63 file.
///
/// # Errors
/// Returns an error with its line if there is no TILT line, if the tilt is in another file, if counts or types are out
/// of range, if angles do not increase, if there is text among the numbers, if there are fewer numbers than the counts
/// require, or if decimal commas make more of them.
pub fn read(bytes: &[u8]) -> Result<Luminaire, FormatError> {
    let (text, mut findings) = decode(bytes)?;
    let lines: Vec<&str> = text.lines().collect();
    let tilt_line = tilt_line(&lines)?;
    let format = lines.iter().map(|line| line.trim()).find(|line| !line.is_empty()).unwrap_or_default();
    let old = !format.contains("2002") && !format.contains("2019");
    let mut tokens = Tokens::new(&lines, tilt_line + 1);
    let numbers =
        Numbers::read(&mut tokens, &lines, tilt_line, &mut findings).map_err(|error| tokens.explained(error))?;
    let Numbers { photometry, gamma_deg, c_file, table, .. } = numbers;
    let (angles, planes) = (gamma_deg.len(), c_file.len());

    // The second factor counted in the older editions only; then it became "future use" and the generation type.
    let ballast = numbers.ballast * if old { numbers.ballast_lamp } else { 1.0 };
    let factor = numbers.multiplier * ballast;
    if factor == 0.0 {
        findings.push(Finding::warning("multiplier", "candela values multiplied by 0: the luminaire is dark"));
    } else if factor != 1.0 {
        findings.push(Finding::info("multiplier", format!("candela values multiplied by {factor}")));
    }
    let lumens = numbers.lumens;
    if lumens <= 0.0 && lumens != ABSOLUTE {
        findings.push(Finding::warning(
            "no-lamp-flux",
            format!(
                "line {}: lamps of {lumens} lm (-1 marks absolute photometry); the intensities are taken as absolute",
                numbers.lamps_line
            ),
        ));
    }
    let Turn { c_deg, source } = match photometry {
        Photometry::C => {
            findings.extend(closing_plane(&c_file, &table));
            Turn::new(&c_file, mirrors(&c_file, numbers.c_line)?)
        }
        Photometry::A | Photometry::B => {
            let letter = if photometry == Photometry::A { "A" } else { "B" };
            findings.push(Finding::warning(
                "not-type-c",
                format!("photometric type is {letter}, not C: planes and angles are shown as they stand"),
            ));
            Turn { source: (0..planes).collect(), c_deg: c_file }
        }
    };
    let intensity =
        source.iter().flat_map(|&plane: &usize| &table[plane * angles..][..angles]).map(|v| v * factor).collect();
    let keyword = |name: &str| keyword_value(&lines[..tilt_line], name);
    let date = keyword("ISSUEDATE");
    let lamp_flux = (lumens > 0.0).then_some(numbers.lamps * lumens);
    let luminaire = Luminaire {
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
        opening: Opening::from_lm63(numbers.sizes, old),
        c_deg,
        gamma_deg,
        intensity,
        lamp_flux,
        power: numbers.power,
        findings,
    };
    let stated = Stated {
        lamps: lamp_flux.map(|flux| flux * ballast),
        lamps_line: numbers.lamps_line,
        opening_line: numbers.opening_line,
        ..Stated::default()
    };
    checked(luminaire, &stated)
}

/// Returns the index of the TILT line, which ends the keywords.
fn tilt_line(lines: &[&str]) -> Result<usize, FormatError> {
    let upper = |line: &&str| line.trim_start().to_ascii_uppercase();
    let expected = "a line TILT=NONE or TILT=INCLUDE";
    if let Some(index) = lines.iter().position(|line| upper(line).starts_with("TILT=")) {
        return Ok(index);
    }
    Err(match lines.iter().position(|line| upper(line).contains("TILT=")) {
        Some(index) => at_line(index + 1, "TILT= within a line: a line break is missing", expected),
        None => at_line(lines.len(), "no TILT line", expected),
    })
}

/// Numbers of a file after its TILT line, as written in it; sizes are in metres.
struct Numbers {
    lamps: f64,
    lumens: f64,
    /// Line number of the lumens per lamp, from 1.
    lamps_line: usize,
    multiplier: f64,
    photometry: Photometry,
    /// Width, length and height of the luminous opening, negative where they mark round shapes. \[m\]
    sizes: [f64; 3],
    /// Line number of the opening's last size, from 1.
    opening_line: usize,
    ballast: f64,
    ballast_lamp: f64,
    power: f64,
    gamma_deg: Vec<f64>,
    c_file: Vec<f64>,
    /// Line number of the last horizontal angle, from 1.
    c_line: usize,
    table: Vec<f64>,
}

impl Numbers {
    fn read(
        tokens: &mut Tokens,
        lines: &[&str],
        tilt_line: usize,
        findings: &mut Vec<Finding>,
    ) -> Result<Self, FormatError> {
        findings.extend(tilt(tokens, lines[tilt_line].trim()[5..].trim(), tilt_line + 1)?);
        let lamps = tokens.number("number of lamps")?;
        let lumens = tokens.number("lumens per lamp")?;
        let lamps_line = tokens.line();
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
        let sizes = [tokens.number("width")?, tokens.number("length")?, tokens.number("height")?];
        let opening_line = tokens.line();
        let ballast = tokens.number("ballast factor")?;
        let ballast_lamp = tokens.number("ballast-lamp factor, future use or file generation type")?;
        let power = tokens.number("input watts")?;
        let gamma_deg = tokens.take(angles, "vertical angles")?;
        check_rising(&gamma_deg, tokens.line(), "vertical angle")?;
        let c_file = tokens.take(planes, "horizontal angles")?;
        let c_line = tokens.line();
        check_rising(&c_file, c_line, "horizontal angle")?;
        let table = tokens.take(angles * planes, "candela values")?;
        findings.extend(after_the_table(tokens, [angles, planes])?);
        let sizes = sizes.map(|size| size * metres);
        Ok(Self {
            lamps,
            lumens,
            lamps_line,
            multiplier,
            photometry,
            sizes,
            opening_line,
            ballast,
            ballast_lamp,
            power,
            gamma_deg,
            c_file,
            c_line,
            table,
        })
    }
}

/// Reads the tilt factors that the TILT line announces, which are not applied; returns a finding about them.
fn tilt(tokens: &mut Tokens, word: &str, line: usize) -> Result<Option<Finding>, FormatError> {
    let upper = word.to_ascii_uppercase();
    match upper.as_str() {
        "NONE" => Ok(None),
        "INCLUDE" => {
            tokens.number("lamp to luminaire geometry")?;
            let count = tokens.count("number of tilt angles")?;
            let angles = tokens.take(count, "tilt angles")?;
            check_rising(&angles, tokens.line(), "tilt angle")?;
            tokens.take(count, "tilt factors")?;
            Ok(Some(Finding::info(
                "tilt-factors",
                format!("{count} tilt factors in the file; the intensities hold for the untilted luminaire"),
            )))
        }
        other => {
            let known = other.split_whitespace().next().is_some_and(|first| ["NONE", "INCLUDE"].contains(&first));
            let why = if known { "a line break is missing" } else { "an external tilt file, which is not available" };
            Err(at_line(line, format!("TILT={}: {why}", excerpt(other)), "TILT=NONE or TILT=INCLUDE"))
        }
    }
}

/// Returns a finding on text after the last candela value that the counts require.
fn after_the_table(tokens: &Tokens, [angles, planes]: [usize; 2]) -> Result<Option<Finding>, FormatError> {
    let rest = tokens.rest();
    let Some(line) = rest.line else { return Ok(None) };
    let due = angles * planes;
    let found = due + rest.numbers;
    let counts = format!("{angles} angles in {planes} {}", if planes == 1 { "plane" } else { "planes" });
    if tokens.has_decimal_commas(rest.numbers) {
        return Err(at_line(line, format!("{found} candela values"), format!("{due} ({counts})")));
    }
    Ok(Some(if rest.numbers > 0 {
        surplus(found, due, line, &counts)
    } else {
        Finding::info("text-after-values", format!("line {line}: text after the last candela value is not read"))
    }))
}

/// Returns the text of a keyword with its `[MORE]` lines; empty when the keyword is missing.
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

/// Returns the symmetry that the first and the last horizontal angle of type C imply.
fn mirrors(c_file: &[f64], line: usize) -> Result<Mirrors, FormatError> {
    let (first, last) = (c_file[0], c_file[c_file.len() - 1]);
    let from_to = |a: f64, b: f64| same_angle(first, a) && same_angle(last, b);
    if c_file.len() == 1 {
        Ok(Mirrors::None)
    } else if from_to(0.0, 90.0) {
        Ok(Mirrors::Both)
    } else if from_to(90.0, 270.0) {
        Ok(Mirrors::C90)
    } else if from_to(0.0, 180.0) {
        Ok(Mirrors::C0)
    } else if same_angle(first, 0.0) && last > 180.0 && last < 360.0 + CLOSEST {
        Ok(Mirrors::None)
    } else {
        Err(at_line(
            line,
            format!("horizontal angles from {first} to {last}"),
            "0 alone, 0 to 90, 0 to 180, 0 to 360 or 90 to 270",
        ))
    }
}
