//! Round numbers for axes and scales, and numbers as text with their unit.

use crate::texts;

/// Returns the smallest number of the series 1, 2, 5 · 10ⁿ that is at least `value`; 1 for a value that is not positive
/// and finite.
pub fn nice_ceil(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    let mantissa = value / decade;
    let rounded = [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| mantissa <= m * (1.0 + 1e-9)).unwrap_or(10.0);
    rounded * decade
}

/// Returns equally spaced round values between `lo` and `hi`, at most `count` + 1 of them.
pub fn linear(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    if !(hi > lo && (hi - lo).is_finite()) || count == 0 {
        return vec![];
    }
    multiples(lo, hi, nice_ceil((hi - lo) / count as f64))
}

/// Returns the multiples of `step` between `lo` and `hi`, both included.
pub fn multiples(lo: f64, hi: f64, step: f64) -> Vec<f64> {
    let first = (lo / step - 1e-9).ceil() as i64;
    let last = (hi / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// Returns the smallest number of the series 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 · 10ⁿ that is at least `value`: end of a
/// linear scale that is well filled. 1 for a value that is not positive and finite.
pub fn fine_ceil(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let exponent = value.log10().floor() as i32;
    // A power of ten below one is not exact, a division by one above it is: 0.6, not 0.6000000000000001.
    let scaled = |m: f64| if exponent < 0 { m / 10_f64.powi(-exponent) } else { m * 10_f64.powi(exponent) };
    let steps = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
    scaled(steps.into_iter().find(|m| value <= scaled(*m) * (1.0 + 1e-9)).unwrap_or(10.0))
}

/// Returns about `count` round values for a logarithmic axis between `lo` and `hi`: 1-2-5 steps where they are few
/// enough, else decades, else every second decade and so on; where there are less than two decades the 1-2-5 steps are
/// thinned instead.
pub fn logarithmic(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    if !(lo > 0.0 && hi > lo && hi.is_finite()) || count == 0 {
        return vec![];
    }
    let (first, last) = (lo.log10().floor() as i32, hi.log10().ceil() as i32);
    let list = |mantissas: &[f64]| -> Vec<f64> {
        let all = (first..=last).flat_map(|n| mantissas.iter().map(move |m| m * 10_f64.powi(n)));
        all.filter(|v| *v >= lo * (1.0 - 1e-9) && *v <= hi * (1.0 + 1e-9)).collect()
    };
    let (fine, decades) = (list(&[1.0, 2.0, 5.0]), list(&[1.0]));
    let chosen = if fine.len() <= count + 1 || decades.len() < 2 { fine } else { decades };
    let stride = chosen.len().div_ceil(count + 1).max(1);
    chosen.into_iter().step_by(stride).collect()
}

/// Returns a number as text with nine significant digits, without trailing zeros, with a decimal point in every
/// language.
pub fn nine_digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}").replace("-0", "0");
    }
    // Nobody counts the zeros of a number that is beyond all light.
    if value.abs() >= 1e16 {
        return format!("{value:.8e}").replace(".00000000e", "e");
    }
    let digits = (8 - value.abs().log10().floor() as i32).clamp(0, 17) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Returns a number as text with `digits` significant digits, without needless zeros, with the decimal sign of the
/// language: "0.0123", "412", "12 300".
pub fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..7).contains(&magnitude) {
        return texts::decimal(format!("{value:.*e}", digits.saturating_sub(1)));
    }
    let decimals = (digits as i32 - 1 - magnitude).max(0) as usize;
    let keep = 10_f64.powi((magnitude + 1 - digits as i32).max(0));
    let text = format!("{:.*}", decimals, (value / keep).round_ties_even_if(keep > 1.0) * keep);
    group(&text)
}

trait RoundIf {
    fn round_ties_even_if(self, condition: bool) -> f64;
}

impl RoundIf for f64 {
    fn round_ties_even_if(self, condition: bool) -> f64 {
        if condition { self.round_ties_even() } else { self }
    }
}

/// Groups digits by threes with thin spaces, in whole parts of five digits and more, and sets minus and decimal sign.
fn group(text: &str) -> String {
    let (sign, rest) = text.strip_prefix('-').map_or(("", text), |rest| ("−", rest));
    let (whole, fraction) = rest.split_once('.').map_or((rest, ""), |(a, b)| (a, b));
    let mut out = String::from(sign);
    for (i, digit) in whole.chars().enumerate() {
        if whole.len() > 4 && i > 0 && (whole.len() - i).is_multiple_of(3) {
            out.push(' ');
        }
        out.push(digit);
    }
    if !fraction.is_empty() {
        out.push(texts::decimal_sign());
        out.push_str(fraction);
    }
    out
}

/// Returns a value with its unit to three significant digits, with the prefixes kilo and mega from ten thousand up:
/// "12.3 klx", "850 lx".
pub fn si(value: f64, unit: &str) -> String {
    let size = value.abs();
    if size >= 1e7 {
        format!("{} M{unit}", number(value * 1e-6, 3))
    } else if size >= 1e4 {
        format!("{} k{unit}", number(value * 1e-3, 3))
    } else {
        format!("{} {unit}", number(value, 3))
    }
}

/// Returns the label of a tick: few digits, no trailing zeros, "k" and "M" for thousands and millions.
pub fn tick(value: f64) -> String {
    fine_tick(value, value)
}

/// Returns the label of a tick, with enough digits to distinguish it from a neighbour that is `step` away; "k" and "M"
/// for thousands and millions.
pub fn fine_tick(value: f64, step: f64) -> String {
    let size = value.abs();
    let (scale, unit, least) = match size {
        1e6.. => (1e-6, "M", 3),
        1e4.. => (1e-3, "k", 3),
        _ => (1.0, "", 4),
    };
    let digits = (1.0 + (size / step.abs()).log10().ceil()).clamp(0.0, 12.0) as usize;
    let text = number(value * scale, digits.max(least));
    let sign = texts::decimal_sign();
    let plain = text.contains(sign) && !text.contains('e');
    format!("{}{unit}", if plain { text.trim_end_matches('0').trim_end_matches(sign) } else { &text })
}

/// Returns an angle, given in radians, as text in whole degrees: "40°".
pub fn degrees(radians: f64) -> String {
    format!("{:.0}°", radians.to_degrees() + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn round_numbers() {
        assert_eq!(nice_ceil(0.37), 0.5);
        assert_eq!(nice_ceil(2000.0), 2000.0);
        assert_eq!(nice_ceil(0.0), 1.0);
        assert_eq!(linear(0.0, 1.0, 5), vec![0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(logarithmic(1.0, 1000.0, 4), vec![1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(logarithmic(0.02, 20.0, 3), vec![0.1, 1.0, 10.0]);
        assert_eq!(fine_ceil(6280.0), 8000.0);
        assert!(linear(1.0, 1.0, 4).is_empty() && logarithmic(0.0, 1.0, 4).is_empty());
    }

    #[test]
    fn text_of_quantities() {
        assert_eq!(si(12_345.0, "lx"), "12.3 klx");
        assert_eq!(si(850.4, "lx"), "850 lx");
        assert_eq!(si(1.47e9, "cd/m²"), "1470 Mcd/m²");
        assert_eq!(number(0.012_345, 3), "0.0123");
        assert_eq!(number(123_456.0, 3), "123 000");
        assert_eq!(number(-5.0, 2), "−5.0");
        assert_eq!(number(f64::NAN, 3), "–");
        assert_eq!(tick(0.2), "0.2");
        assert_eq!(tick(0.0005), "0.0005");
        assert_eq!(tick(20_000.0), "20k");
    }

    proptest! {
        #[test]
        fn ticks_lie_inside_and_are_few(lo in -1e6..1e6_f64, width in 1e-3..1e6_f64, count in 1..12_usize) {
            let ticks = linear(lo, lo + width, count);
            prop_assert!(ticks.len() <= count + 1);
            for t in ticks {
                prop_assert!(t >= lo - width * 1e-6 && t <= lo + width * (1.0 + 1e-6));
            }
        }

        #[test]
        fn a_number_reads_back(value in 1e-3..1e5_f64) {
            let read: f64 = number(value, 4).replace(' ', "").parse().unwrap();
            prop_assert!((read / value - 1.0).abs() < 6e-4);
        }
    }
}
