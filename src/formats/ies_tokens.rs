//! Numbers of an LM-63 file after its TILT line, each with its line. Blanks and commas separate them.

use super::FormatError;
use super::location::excerpt;
use super::luminaire_text::{at_line, parse_number};

/// Reader of the numbers of an LM-63 file one after the other, with their line numbers.
pub(super) struct Tokens<'a> {
    tokens: Vec<(usize, &'a str)>,
    next: usize,
    /// Number of commas directly between two digits, which may be decimal commas.
    commas: usize,
}

/// Summary of the text after the last required number of a file.
pub(super) struct Rest {
    /// Number of numbers that the text contains.
    pub numbers: usize,
    /// Line number where the text begins, from 1; `None` without any text.
    pub line: Option<usize>,
}

impl<'a> Tokens<'a> {
    /// Creates the reader for the lines of a file after the first `from` lines.
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

    /// Returns the line number of the number read last, from 1.
    pub fn line(&self) -> usize {
        self.tokens.get(self.next.saturating_sub(1)).or(self.tokens.last()).map_or(1, |token| token.0)
    }

    /// Returns a summary of the text that has not been read.
    pub fn rest(&self) -> Rest {
        let left = &self.tokens[self.next..];
        let numbers = left.iter().filter(|(_, token)| parse_number(token).is_some()).count();
        Rest { numbers, line: left.first().map(|token| token.0) }
    }

    /// Whether decimal commas, each of which makes two numbers of one, explain `surplus` superfluous numbers.
    pub fn has_decimal_commas(&self, surplus: usize) -> bool {
        surplus > 0 && self.commas == surplus
    }

    /// Returns the error, with a remark on decimal commas if these may have shifted all numbers.
    pub fn explained(&self, mut error: FormatError) -> FormatError {
        if self.commas > 0 {
            error.expected.push_str(COMMAS);
        }
        error
    }

    /// Reads the next number; `name`: its name in messages.
    ///
    /// # Errors
    /// Returns an error if the file ends, or if the next text is not a finite number.
    pub fn number(&mut self, name: &str) -> Result<f64, FormatError> {
        let Some(&(line, token)) = self.tokens.get(self.next) else {
            return Err(at_line(self.line(), "the end of the file", name));
        };
        self.next += 1;
        parse_number(token)
            .ok_or_else(|| at_line(line, format!("\"{}\"", excerpt(token)), format!("a number ({name})")))
    }

    /// Reads the next number as a count of angles, 1 … 3601; `name`: its name in messages.
    ///
    /// # Errors
    /// Returns an error if the next text is not such a count.
    pub fn count(&mut self, name: &str) -> Result<usize, FormatError> {
        let value = self.number(name)?;
        if !(1.0..=3601.0).contains(&value) || value.fract() != 0.0 {
            return Err(at_line(self.line(), format!("{name} {value}, out of range"), "a whole number from 1 to 3601"));
        }
        Ok(value as usize)
    }

    /// Reads the next number as a whole number from 1 to `max`; `allowed`: meaning of these numbers, for messages.
    ///
    /// # Errors
    /// Returns an error if the next text is not such a number.
    pub fn choice(&mut self, name: &str, allowed: &str, max: u8) -> Result<u8, FormatError> {
        let value = self.number(name)?;
        (1..=max)
            .find(|&choice| value == f64::from(choice))
            .ok_or_else(|| at_line(self.line(), format!("{name} {value}"), format!("{name} must be {allowed}")))
    }

    /// Reads the next `count` numbers; `name`: their name in messages.
    ///
    /// # Errors
    /// Returns an error if the file ends before, or if one of the texts is not a finite number.
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

/// Remark on decimal commas for messages. Source: LM-63-2002, delimiters are commas, blanks and line ends.
pub(super) const COMMAS: &str = "; a comma separates numbers in LM-63: write decimals with a point";
