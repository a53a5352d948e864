//! A luminaire as photometric files describe it: what EULUMDAT and LM-63 have in common.
//!
//! Plain data between the two formats and the rest of the program. Angles are in degrees here, as in the files.

use super::encoding::{Encoding, any_text, not_too_long};
use super::{FormatError, Location};
use crate::compute::btdf::Finding;
use crate::compute::lid::Intensities;
use crate::compute::lid::c_gamma::{Aim, CGammaTable, Widened};
use crate::compute::limits;

/// Which axis the planes of a photometric file turn about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Photometry {
    /// About the vertical: C and γ.
    C,
    /// About a horizontal axis: B and β. Read as it stands, not turned into C.
    B,
    /// About a vertical axis, counted from the direction of travel. Read as it stands.
    A,
}

/// The text that identifies a luminaire.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Description {
    /// Number of the measurement or computation.
    pub report: String,
    /// Who measured or computed.
    pub laboratory: String,
    /// Date of issue.
    pub date: String,
    /// Maker.
    pub manufacturer: String,
    /// Catalogue number.
    pub number: String,
    /// What it is.
    pub name: String,
    /// The light source.
    pub lamp: String,
    /// Anything else a user of the file must know, a paragraph each.
    pub remarks: Vec<String>,
}

/// Size of the luminous opening. \[m\] Negative values, as LM-63 marks round shapes, are kept.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Opening {
    /// Along the C0–C180 plane ("length" of LM-63, "width" of EULUMDAT).
    pub along_c0: f64,
    /// Along the C90–C270 plane ("width" of LM-63, "length" of EULUMDAT).
    pub along_c90: f64,
    /// Vertical.
    pub height: f64,
}

/// A luminaire.
#[derive(Debug, Clone, PartialEq)]
pub struct Luminaire {
    /// Format as the file names itself.
    pub format: String,
    /// Identifying text.
    pub text: Description,
    /// Kind of planes.
    pub photometry: Photometry,
    /// Luminous opening.
    pub opening: Opening,
    /// Planes, rising; for photometry C all of the turn (360° not repeated) or one plane for all. \[°\]
    pub c_deg: Vec<f64>,
    /// Angles in a plane, rising. \[°\]
    pub gamma_deg: Vec<f64>,
    /// Plane by plane. \[cd\]
    pub intensity: Vec<f64>,
    /// Rated flux of the lamps that the intensities belong to; `None` for absolute photometry. \[lm\]
    pub lamp_flux: Option<f64>,
    /// Electrical power. \[W\]
    pub power: f64,
    /// What a reader had to assume.
    pub findings: Vec<Finding>,
}

impl Luminaire {
    /// The luminaire of an aperture whose distribution was tabulated.
    ///
    /// `size` is the aperture's along its own x and y \[m\]. Remarks on orientation, subdivision and quadrature are added
    /// to those of `text`, because a host that does not know them gets the near field or the direction wrong.
    pub fn from_table(table: &CGammaTable, size: [f64; 2], mut text: Description) -> Self {
        let [x, y] = size;
        let opening = match table.aim {
            Aim::Mounted => Opening { along_c0: 0.0, along_c90: x, height: y },
            Aim::Down => Opening { along_c0: x, along_c90: y, height: 0.0 },
        };
        text.remarks.extend(orientation_remarks(table.aim, size));
        text.remarks.push(table_remark(table));
        // To the digits that files have: a reader of ours finds the same numbers.
        let degrees = |angles: &[f64]| angles.iter().map(|angle| (1e4 * angle.to_degrees()).round() / 1e4).collect();
        Self {
            format: "computed".to_owned(),
            text,
            photometry: Photometry::C,
            opening,
            c_deg: degrees(&table.c),
            gamma_deg: degrees(&table.gamma),
            intensity: table.intensity.clone(),
            lamp_flux: Some(table.flux.value),
            power: 0.0,
            findings: Vec::new(),
        }
    }

    /// As a host reads them. Only for photometry C.
    pub fn intensities(&self) -> Intensities {
        let radians = |degrees: &[f64]| degrees.iter().map(|angle| angle.to_radians()).collect();
        Intensities { c: radians(&self.c_deg), gamma: radians(&self.gamma_deg), values: self.intensity.clone() }
    }

    /// Intensities of one plane. \[cd\]
    pub fn plane(&self, plane: usize) -> &[f64] {
        &self.intensity[plane * self.gamma_deg.len()..][..self.gamma_deg.len()]
    }

    /// Flux between the nadir and γ, by the zonal sum: a zone between two angles has the mean of their intensities, a
    /// plane stands for half the way to its neighbours. Only for photometry C. \[lm\]
    pub fn flux_within(&self, gamma_deg: f64) -> f64 {
        let weights = self.plane_weights();
        let mut flux = 0.0;
        for (pair_index, pair) in self.gamma_deg.windows(2).enumerate() {
            if pair[0] >= gamma_deg {
                break;
            }
            let end = pair[1].min(gamma_deg);
            let share = (end - pair[0]) / (pair[1] - pair[0]);
            let zone = pair[0].to_radians().cos() - end.to_radians().cos();
            for (plane, weight) in weights.iter().enumerate() {
                let [from, to] = [pair_index, pair_index + 1].map(|k| self.plane(plane)[k]);
                let to = from + share * (to - from);
                flux += 0.5 * (from + to) * zone * weight;
            }
        }
        flux
    }

    /// Flux of the whole distribution. \[lm\]
    pub fn flux(&self) -> f64 {
        self.flux_within(180.0)
    }

    /// Azimuth that each plane stands for. \[rad\]
    fn plane_weights(&self) -> Vec<f64> {
        let n = self.c_deg.len();
        (0..n)
            .map(|k| {
                let next = if k + 1 < n { self.c_deg[k + 1] } else { self.c_deg[0] + 360.0 };
                let last = if k > 0 { self.c_deg[k - 1] } else { self.c_deg[n - 1] - 360.0 };
                (0.5 * (next - last)).to_radians()
            })
            .collect()
    }

    /// Largest intensity. \[cd\]
    pub fn peak(&self) -> f64 {
        self.intensity.iter().copied().fold(0.0, f64::max)
    }
}

fn orientation_remarks(aim: Aim, [x, y]: [f64; 2]) -> Vec<String> {
    let orientation = match aim {
        Aim::Mounted => {
            "Orientation: type C as mounted in the facade. Nadir is down, C0 points into the room, C90 to the left seen \
             from outside (C counted counter-clockwise seen from above). Place without tilt."
        }
        Aim::Down => {
            "Orientation: outward normal up, light goes down (as in a roof). C0 is the right seen from outside, C90 the \
             aperture's up. For a facade tilt by 90 deg so that C90 points up and the nadir into the room."
        }
    };
    vec![
        orientation.to_owned(),
        format!(
            "Opening {x:.4} m x {y:.4} m (width x height seen from outside). The host must subdivide the luminous area: \
             as a point source it is wrong nearer than about five times its size."
        ),
    ]
}

fn table_remark(table: &CGammaTable) -> String {
    let mut text = format!(
        "Intensities are means over cells of {} deg; zonal flux {:.4} lm, scaled by {:+.4} % to match the computed flux \
         (numerical error {:.4} lm).",
        table.step.degrees(),
        table.flux.value,
        100.0 * (table.scaled_by - 1.0),
        table.flux.error
    );
    let flux = table.beam_flux;
    let beams = match table.widened {
        _ if flux == 0.0 => String::new(),
        None => format!(
            " The unscattered sunbeam of {flux:.4} lm is spread over the four nearest nodes: patches of sun are blurred to \
             this step."
        ),
        Some(Widened { size: [x, y], distance: [near, far], step: [across, along] }) => format!(
            " Unscattered sunlight of {flux:.4} lm is widened to {x:.3} m x {y:.3} m at {near:.2} m to {far:.2} m, where \
             it meets a surface, with nodes as close as {:.2} deg in C and {:.2} deg in gamma round it: edges of patches \
             of sun are blurred by that, flux and place are kept.",
            across.to_degrees(),
            along.to_degrees()
        ),
    };
    text.push_str(&beams);
    text
}

/// Text of a file: UTF-8 or Latin-1, as such files are, or UTF-16, which is told; without a byte-order mark.
pub(super) fn decode(bytes: &[u8]) -> Result<(String, Vec<Finding>), FormatError> {
    let bytes = not_too_long(bytes)?;
    let (text, encoding) = any_text(bytes);
    let told = (encoding == Some(Encoding::Utf16)).then(|| {
        let message =
            "The text is UTF-16, which other programs do not expect in a luminaire file; it was read as such.";
        Finding::warning("encoding", message)
    });
    Ok((text, told.into_iter().collect()))
}

/// Printable ASCII: what every reader takes. Letters with marks are spelt out, line breaks become blanks, the rest '?'.
pub(super) fn ascii(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            ' '..='~' => out.push(c),
            'ä' => out.push_str("ae"),
            'ö' => out.push_str("oe"),
            'ü' => out.push_str("ue"),
            'Ä' => out.push_str("Ae"),
            'Ö' => out.push_str("Oe"),
            'Ü' => out.push_str("Ue"),
            'ß' => out.push_str("ss"),
            'à' | 'â' | 'á' | 'å' => out.push('a'),
            'é' | 'è' | 'ê' | 'ë' => out.push('e'),
            'ç' => out.push('c'),
            'ñ' => out.push('n'),
            'ô' | 'ó' | 'ø' => out.push('o'),
            '°' => out.push_str(" deg"),
            '²' => out.push('2'),
            '×' => out.push('x'),
            '–' | '—' | '−' => out.push('-'),
            c if c.is_whitespace() => out.push(' '),
            _ => out.push('?'),
        }
    }
    out
}

/// The error of a reader at a line, counted from 1.
pub(super) fn at_line(line: usize, found: impl Into<String>, expected: impl Into<String>) -> FormatError {
    FormatError::new(Location::line(line), found, expected)
}

/// Judges the light of a luminaire that was read, all numbers of it: what no luminaire has is refused, and intensities a
/// little below 0, as differences of measurements are, count as 0, which is told.
pub(super) fn plausible(mut luminaire: Luminaire) -> Result<Luminaire, FormatError> {
    let wrong = |what: &str, value: f64, unit: &str, (least, most): (f64, f64)| {
        let at = Location::file().in_element(what);
        Err(FormatError::new(at, format!("{value:e} {unit}"), format!("{least} to {most:e} {unit}")))
    };
    let peak = luminaire.peak();
    for (index, cd) in luminaire.intensity.iter().enumerate() {
        // Written so that what is no number fails too.
        if !(*cd >= -BELOW_ZERO * peak && *cd <= limits::INTENSITY) {
            let angles = luminaire.gamma_deg.len();
            let [c, gamma] = [luminaire.c_deg[index / angles], luminaire.gamma_deg[index % angles]];
            return wrong(&format!("intensity at C {c}°, gamma {gamma}°"), *cd, "cd", (0.0, limits::INTENSITY));
        }
    }
    let flux = luminaire.lamp_flux.unwrap_or(0.0);
    if !(0.0..=limits::LAMP_FLUX).contains(&flux) {
        return wrong("flux of the lamps", flux, "lm", (0.0, limits::LAMP_FLUX));
    }
    // Below 0 where it is not known.
    if luminaire.power.is_nan() || luminaire.power.abs() > MOST_POWER {
        return wrong("power", luminaire.power, "W", (0.0, MOST_POWER));
    }
    let Opening { along_c0, along_c90, height } = luminaire.opening;
    for size in [along_c0, along_c90, height] {
        // Below 0 it is a diameter.
        if size.is_nan() || size.abs() > MOST_SIZE {
            return wrong("size of the luminous opening", size, "m", (-MOST_SIZE, MOST_SIZE));
        }
    }
    for angle in luminaire.c_deg.iter().chain(&luminaire.gamma_deg) {
        if angle.is_nan() || angle.abs() > 360.0 {
            return wrong("angle", *angle, "°", (-360.0, 360.0));
        }
    }
    if luminaire.photometry == Photometry::C {
        // Beyond, zones and planes would count backwards; a plane at 360° is the first one again.
        let turn = 360.0 - CLOSEST;
        if let Some(c) = luminaire.c_deg.iter().find(|c| !(0.0..=turn).contains(*c)) {
            return wrong("plane C", *c, "°", (0.0, 360.0));
        }
        if let Some(gamma) = luminaire.gamma_deg.iter().find(|gamma| !(0.0..=180.0).contains(*gamma)) {
            return wrong("gamma angle", *gamma, "°", (0.0, 180.0));
        }
    }
    let below = luminaire.intensity.iter().filter(|cd| **cd < 0.0).count();
    if below > 0 {
        luminaire.intensity.iter_mut().for_each(|cd| *cd = cd.max(0.0));
        luminaire.findings.push(Finding::warning(
            "negative-intensities",
            format!("{below} intensities are a little below 0 cd, which no light is; they count as 0"),
        ));
    }
    Ok(luminaire)
}

/// Of the largest intensity, how far below 0 differences of measurements may be.
const BELOW_ZERO: f64 = 0.01;
/// Angles closer together are the same once they are written, with four decimals. \[°\]
pub(super) const CLOSEST: f64 = 2e-4;
/// A luminaire's power. \[W\]
const MOST_POWER: f64 = 1e7;
/// A luminaire's extent. \[m\]
const MOST_SIZE: f64 = 1000.0;

/// Fails unless the angles rise by what files can tell apart.
pub(super) fn check_rising(angles: &[f64], line: usize, name: &str) -> Result<(), FormatError> {
    match angles.windows(2).find(|pair| pair[1] - pair[0] < CLOSEST) {
        Some(pair) => Err(at_line(
            line,
            format!("{name} {} after {}", pair[1], pair[0]),
            format!("{name}s that increase strictly"),
        )),
        None => Ok(()),
    }
}

/// The shortest of up to `decimals` decimals, without trailing zeros or "-0".
pub(super) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
