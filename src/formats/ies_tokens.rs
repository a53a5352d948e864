//! Numbers of an LM-63 file after its TILT line, each with its line. Blanks and commas separate them.

use super::FormatError;
use super::location::excerpt;
use super::luminaire_text::{at_line, parse_number};

/// Numbers that are read one after the other.
pub(super) struct Tokens<'a> {
    tokens: Vec<(usize, &'a str)>,
    next: usize,
    /// Number of commas directly between two digits, as decimal commas are.
    commas: usize,
}

/// Text after the last required number.
pub(super) struct Rest {
    /// Number of numbers in it.
    pub numbers: usize,
    /// Line of the first piece; `None` where there is nothing.
    pub line: Option<usize>,
}

impl<'a> Tokens<'a> {
    /// Creates the tokens of the lines after the first `from`.
    pub fn new(lines: &[&'a str], from: usize) -> Self {
        let pieces = |line: &'a str| {
            // DOS ended texts with a control character.
            line.split(|c: char| c.is_whitespace() || c == ',' || c == '\u{1a}').filter(|token| !token.is_empty())
        };
        let numbered = lines[from..].iter().zip(from + 1..);
        let tokens = numbered.flat_map(|(line, number)| pieces(line).map(move |token| (number, token))).collect();
        let is_comma = |three: &[u8]| matches!(three, [b'0'..=b'9', b',', b'0'..=b'9']);
        let commas =
            lines[from..].iter().map(|line| line.as_bytes().windows(3).filter(|at| is_comma(at)).count()).sum();
        Self { tokens, next: 0, commas }
    }

    /// Returns the line of the number read last, from 1.
    pub fn line(&self) -> usize {
        self.tokens.get(self.next.saturating_sub(1)).or(self.tokens.last()).map_or(1, |token| token.0)
    }

    /// Returns the text that was not read.
    pub fn rest(&self) -> Rest {
        let left = &self.tokens[self.next..];
        let numbers = left.iter().filter(|(_, token)| parse_number(token).is_some()).count();
        Rest { numbers, line: left.first().map(|token| token.0) }
    }

    /// Whether decimal commas explain `surplus` numbers: each makes two numbers of one.
    pub fn has_decimal_commas(&self, surplus: usize) -> bool {
        surplus > 0 && self.commas == surplus
    }

    /// Returns the error, with a remark on commas where decimal commas may have shifted all numbers.
    pub fn explained(&self, mut error: FormatError) -> FormatError {
        if self.commas > 0 {
            error.expected.push_str(COMMAS);
        }
        error
    }

    /// Reads the next number, which messages call `name`.
    ///
    /// # Errors
    /// Returns an error if the file ends or something else than a finite number stands there.
    pub fn number(&mut self, name: &str) -> Result<f64, FormatError> {
        let Some(&(line, token)) = self.tokens.get(self.next) else {
            return Err(at_line(self.line(), "the end of the file", name));
        };
        self.next += 1;
        parse_number(token)
            .ok_or_else(|| at_line(line, format!("\"{}\"", excerpt(token)), format!("a number ({name})")))
    }

    /// Reads a count of angles, 1 … 3601.
    ///
    /// # Errors
    /// Returns an error if the next number is not such a count.
    pub fn count(&mut self, name: &str) -> Result<usize, FormatError> {
        let value = self.number(name)?;
        if !(1.0..=3601.0).contains(&value) || value.fract() != 0.0 {
            return Err(at_line(self.line(), format!("{name} {value}, out of range"), "a whole number from 1 to 3601"));
        }
        Ok(value as usize)
    }

    /// Reads one of the whole numbers 1 … `max`; `allowed` says in messages what they mean.
    ///
    /// # Errors
    /// Returns an error if the next number is another.
    pub fn choice(&mut self, name: &str, allowed: &str, max: u8) -> Result<u8, FormatError> {
        let value = self.number(name)?;
        (1..=max)
            .find(|&choice| value == f64::from(choice))
            .ok_or_else(|| at_line(self.line(), format!("{name} {value}"), format!("{name} must be {allowed}")))
    }

    /// Reads `count` numbers, which messages call `name`.
    ///
    /// # Errors
    /// Returns an error if the file ends before or something else than a number stands among them.
    pub fn take(&mut self, count: usize, name: &str) -> Result<Vec<f64>, FormatError> {
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

/// Remark on decimal commas. LM-63-2002: delimiters are commas, blanks and line ends.
pub(super) const COMMAS: &str = "; a comma separates numbers in LM-63: write decimals with a point";
