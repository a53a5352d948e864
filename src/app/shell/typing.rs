//! Reading of dates, times of day, coordinates and numbers as users type them; ambiguous input is refused.

use crate::texts::{decimal, scene as texts};
use jiff::civil::Date;

/// Beginnings of the names of the months from January to December, in English and German, without accents.
const MONTHS: [&[&str]; 12] = [
    &["jan"],
    &["feb"],
    &["mar", "maer", "mrz"],
    &["apr"],
    &["may", "mai"],
    &["jun"],
    &["jul"],
    &["aug"],
    &["sep"],
    &["oct", "okt"],
    &["nov"],
    &["dec", "dez"],
];

fn month_of(word: &str) -> Option<i8> {
    let word = word.to_lowercase().replace('ä', "a");
    let begins = |names: &&[&str]| names.iter().any(|name| word.starts_with(name));
    MONTHS.iter().position(begins).and_then(|index| i8::try_from(index + 1).ok())
}

/// Reads a date: `21.3.`, `21 Mar`, `Mar 21`, `2026-03-21`; a date without a year is in `year`.
///
/// # Errors
/// Returns a message with the expected form if the text is not a date.
pub fn read_date(text: &str, year: i16) -> Result<Date, String> {
    let text = text.trim();
    let wrong = || texts::no_date(text);
    let words: Vec<&str> = text.split(|c: char| c.is_whitespace() || ".-,".contains(c)).collect();
    let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
    let number = |word: &str| word.parse::<i16>().ok();
    let whole_year = |word: &str| number(word).filter(|_| word.len() == 4);
    let short = |word: &str| number(word).and_then(|number| i8::try_from(number).ok());
    let (year, month, day) = match words[..] {
        // With the year first the order is that of ISO 8601.
        [y, m, d] if whole_year(y).is_some() => (whole_year(y), short(m), short(d)),
        [m, d] if text.contains('-') && month_of(m).is_none() && month_of(d).is_none() => {
            (Some(year), short(m), short(d))
        }
        [a, b, ref rest @ ..] if rest.len() <= 1 => {
            let year = rest.first().map_or(Some(year), |word| whole_year(word));
            match (month_of(a), month_of(b)) {
                (Some(month), None) => (year, Some(month), short(b)),
                (None, Some(month)) => (year, Some(month), short(a)),
                _ => (year, short(b), short(a)),
            }
        }
        _ => return Err(wrong()),
    };
    // 3/21 and 21/3 would be read differently here and there: a slash is in no form above.
    let (Some(year), Some(month), Some(day)) = (year, month, day) else { return Err(wrong()) };
    Date::new(year, month, day).map_err(|_| texts::no_such_day(text))
}

/// Reads a time of day, returned as hour and minute: `12:30`, `12.5`, `9`; `930` is refused.
///
/// # Errors
/// Returns a message with the expected form if the text is not a time.
pub fn read_clock(text: &str) -> Result<(i8, i8), String> {
    let text = text.trim();
    let wrong = || texts::no_clock(text);
    let plain = text.strip_suffix('h').map_or(text, str::trim_end);
    let digits = |word: &str| !word.is_empty() && word.len() <= 2 && word.bytes().all(|byte| byte.is_ascii_digit());
    let (hour, minute) = if let Some((hour, minute)) = plain.split_once(':') {
        if !(digits(hour) && minute.len() == 2 && digits(minute)) {
            return Err(wrong());
        }
        (hour.parse::<i8>().map_err(|_| wrong())?, minute.parse::<i8>().map_err(|_| wrong())?)
    } else {
        let decimal = plain.replace(',', ".");
        if !decimal.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.') {
            return Err(wrong());
        }
        let hours: f64 = decimal.parse().map_err(|_| wrong())?;
        // Many write 12.30 for half past twelve.
        if let Some((whole, part)) = decimal.split_once('.')
            && part.len() == 2
            && part < "60"
        {
            let minutes = (hours.fract() * 60.0).round();
            return Err(texts::two_clocks(text, format!("{whole}:{part}"), format!("{whole}:{minutes:02}")));
        }
        if !(0.0..24.0).contains(&hours) {
            return Err(wrong());
        }
        let minutes = (hours * 60.0).round().min(1439.0) as i32;
        ((minutes / 60) as i8, (minutes % 60) as i8)
    };
    if (0..24).contains(&hour) && (0..60).contains(&minute) { Ok((hour, minute)) } else { Err(wrong()) }
}

/// Reads latitude (north positive) and longitude (east positive) \[°\]: `48.78 9.18`, `48.78°N, 9.18°E`; `None` if the
/// text is not a pair of numbers.
///
/// # Errors
/// Returns a message with the valid ranges if a number lies outside them.
pub fn read_coordinates(text: &str) -> Option<Result<(f64, f64), String>> {
    let parts =
        |signs: &[char]| -> Vec<&str> { text.split(signs).map(str::trim).filter(|part| !part.is_empty()).collect() };
    // A comma stands between the two, or it is a decimal one in both: `48,78 9,18`.
    let (plain, decimal_commas) = (parts(&[' ', ',', ';']), parts(&[' ', ';']));
    let [latitude, longitude] = plain[..] else {
        let [latitude, longitude] = decimal_commas[..] else { return None };
        let once = |part: &str| part.matches(',').count() == 1 && !part.contains('.') && !part.ends_with(',');
        return (once(latitude) && once(longitude))
            .then(|| read_coordinates(&format!("{latitude} {longitude}").replace(',', ".")))
            .flatten();
    };
    let number = |part: &str, positive: char, negative: char| {
        let upper = part.to_uppercase();
        let (plain, sign) = match (upper.strip_suffix(positive), upper.strip_suffix(negative)) {
            (Some(plain), _) => (plain, 1.0),
            (_, Some(plain)) => (plain, -1.0),
            _ => (&*upper, 1.0),
        };
        let value: f64 = plain.trim_end_matches('°').replace('−', "-").parse().ok()?;
        value.is_finite().then_some(sign * value)
    };
    let (latitude, longitude) = (number(latitude, 'N', 'S')?, number(longitude, 'E', 'W')?);
    let on_globe = latitude.abs() <= 90.0 && longitude.abs() <= 180.0;
    Some(if on_globe {
        Ok((latitude, longitude))
    } else {
        Err(texts::not_on_globe(decimal(latitude.to_string()), decimal(longitude.to_string())))
    })
}

/// Reads a number with a decimal point or comma, followed by its unit or not; `None` if the text is not a number.
pub fn read_number(text: &str, unit: &str) -> Option<f64> {
    let plain: String = text.chars().filter(|c| !c.is_whitespace()).map(|c| if c == '−' { '-' } else { c }).collect();
    let unit: String = unit.chars().filter(|c| !c.is_whitespace()).collect();
    let plain = plain.strip_suffix(&*unit).unwrap_or(&plain);
    // A comma is a decimal one; beside a point, or twice, it could separate thousands.
    let commas = plain.matches(',').count();
    if commas > 1 || commas == 1 && plain.contains('.') {
        return None;
    }
    plain.replace(',', ".").parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use jiff::civil::date;

    #[test]
    fn dates_are_read_as_people_write_them() {
        for text in [
            "21.3.",
            "21.3",
            "21. 3.",
            "21 Mar",
            "21 march",
            "Mar 21",
            "21. März",
            "2026-03-21",
            "03-21",
            "21.3.2026",
            "21 Mar 2026",
            " 21.03. ",
        ] {
            assert_eq!(read_date(text, 2026), Ok(date(2026, 3, 21)), "{text}");
        }
        assert_eq!(read_date("1.12.", 2031), Ok(date(2031, 12, 1)));
        assert_eq!(read_date("29.2.2028", 2026), Ok(date(2028, 2, 29)));
        assert_eq!(read_date("3 Dez", 2026), Ok(date(2026, 12, 3)));
    }

    #[test]
    fn what_is_no_date_is_refused_with_what_would_be_right() {
        for text in [
            "",
            "21",
            "tomorrow",
            "32.3.",
            "29.2.",
            "21.13.",
            "3/21",
            "21.3.26",
            "2026-03",
            "21.3.2026 12:00",
            "300.3.",
        ] {
            let told = read_date(text, 2026).expect_err(text);
            assert!(told.contains("21.3."), "{told}");
        }
    }

    #[test]
    fn times_are_read_as_people_write_them() {
        for (text, clock) in [
            ("12:30", (12, 30)),
            ("12.5", (12, 30)),
            ("12,5", (12, 30)),
            ("9", (9, 0)),
            ("9 h", (9, 0)),
            ("09:05", (9, 5)),
            ("0", (0, 0)),
            ("23:59", (23, 59)),
            ("23.999", (23, 59)),
            ("8.75", (8, 45)),
        ] {
            assert_eq!(read_clock(text), Ok(clock), "{text}");
        }
        for text in ["", "24:00", "24", "-1", "12:60", "12:3", "noon", "1e1", "12:30:00", "930", "+9"] {
            assert!(read_clock(text).is_err_and(|told| told.contains("12:30")), "{text}");
        }
        // Half past twelve, or 18 minutes past.
        let told = read_clock("12.30").unwrap_err();
        assert!(told.contains("12:30") && told.contains("12:18"), "{told}");
    }

    #[test]
    fn coordinates_are_told_from_names() {
        for text in ["48,78 9,18", "48,78; 9,18", "48,78°N 9,18°E"] {
            assert_eq!(read_coordinates(text), Some(Ok((48.78, 9.18))), "{text}");
        }
        for text in ["48.78 9.18", "48.78, 9.18", "48.78°N 9.18°E", "48.78N;9.18e"] {
            assert_eq!(read_coordinates(text), Some(Ok((48.78, 9.18))), "{text}");
        }
        assert_eq!(read_coordinates("33.9S 70.7W"), Some(Ok((-33.9, -70.7))));
        assert_eq!(read_coordinates("-33.9 −70.7"), Some(Ok((-33.9, -70.7))));
        assert!(read_coordinates("91 9").is_some_and(|read| read.is_err_and(|told| told.contains("latitude"))));
        for text in ["Stuttgart", "New York", "48.78", "nan nan", "1 2 3"] {
            assert_eq!(read_coordinates(text), None, "{text}");
        }
    }

    #[test]
    fn numbers_come_with_comma_and_unit() {
        assert_eq!(read_number("2,5 m", " m"), Some(2.5));
        assert_eq!(read_number(" 2.5m", " m"), Some(2.5));
        assert_eq!(read_number("−10", "°"), Some(-10.0));
        for text in ["", "m", "1,000.5", "1,2,3", "inf", "nan", "2 m high"] {
            assert_eq!(read_number(text, " m"), None, "{text}");
        }
    }
}
