//! Bytes as decisions: what is made of a file, and how it is damaged.

/// Decisions drawn from bytes one after the other; without bytes the first of every choice.
pub struct Choices<'a> {
    bytes: &'a [u8],
}

impl<'a> Choices<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.bytes.split_first() else { return 0 };
        self.bytes = rest;
        *first
    }

    /// 0 … n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        let drawn = match n {
            0..=256 => usize::from(self.byte()),
            257..=65_536 => usize::from(u16::from_le_bytes([self.byte(), self.byte()])),
            _ => u32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()]) as usize,
        };
        drawn % n.max(1)
    }

    /// Once in n times.
    pub fn one_in(&mut self, n: usize) -> bool {
        self.below(n) + 1 == n
    }

    pub fn flag(&mut self) -> bool {
        self.below(2) == 1
    }

    /// From `low` to `high`, both included.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.byte()) / 255.0
    }

    /// The same, rounded to hundredths.
    pub fn tidy(&mut self, low: f64, high: f64) -> f64 {
        (100.0 * self.between(low, high)).round() / 100.0
    }

    pub fn pick<'b, T: ?Sized>(&mut self, list: &[&'b T]) -> &'b T {
        list[self.below(list.len())]
    }

    /// A name or remark, now and then one that formats have to quote.
    pub fn words(&mut self) -> String {
        const WORDS: [&str; 24] = [
            "",
            "Blind 80",
            "opal",
            "45",
            "Größe ß €",
            "a \"quoted\" word",
            "two\nlines",
            "tab\there",
            "--",
            "a -- b-",
            "---",
            "<b>&amp;</b>",
            "]]>",
            "'''",
            "'",
            "\\",
            "\u{202e}turned",
            "x, y; z",
            "# no comment",
            "\u{1}\u{7f}",
            "Unknown",
            "Name",
            " blanks ",
            "?>",
        ];
        // The plain ones more often.
        let kind = self.below(72);
        let mut text = WORDS.get(kind).copied().unwrap_or(WORDS[kind % 5]).to_owned();
        if self.one_in(40) {
            text = text.repeat(1 + self.below(200));
        }
        text
    }

    /// A number that readers may not expect.
    pub fn odd_number(&mut self) -> &'static str {
        const NUMBERS: [&str; 36] = [
            "0",
            "1",
            "2",
            "-1",
            "0.5",
            "-0",
            "1e-6",
            "3",
            "7",
            "90",
            "180",
            "360",
            "145",
            "1000",
            "0.001",
            "89.999",
            "-90",
            "1e9",
            "1e300",
            "1e308",
            "-1e308",
            "1e-320",
            "5e-324",
            "nan",
            "inf",
            "-inf",
            "4294967296",
            "18446744073709551616",
            "721",
            "7201",
            "1,5",
            "1.5.2",
            "+3",
            "0x10",
            "1e",
            "00000000000000000000000000000000000000001",
        ];
        NUMBERS[self.below(NUMBERS.len())]
    }
}
