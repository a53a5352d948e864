//! CSV tables with decimal commas and semicolons between fields, the format of German spreadsheets. They are accepted
//! wherever tables are read.

use std::borrow::Cow;

/// Byte-order mark by which spreadsheets recognise UTF-8.
const MARK: &str = "\u{feff}";

/// Returns a CSV table with semicolons between its fields and commas in its numbers, in UTF-8 with a byte-order mark.
pub fn with_decimal_commas(table: &str) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new()
        .delimiter(b';')
        .terminator(csv::Terminator::CRLF)
        .flexible(true)
        .from_writer(MARK.as_bytes().to_vec());
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(table.as_bytes());
    for record in reader.records() {
        let record = record.expect("a table of text has records of text");
        let fields = record.iter().map(|field| {
            let is_number = field.parse::<f64>().is_ok_and(f64::is_finite);
            if is_number { field.replace('.', ",") } else { field.to_owned() }
        });
        writer.write_record(fields).expect("memory takes all that is written to it");
    }
    writer.into_inner().expect("memory takes all that is written to it")
}

/// Returns a table with commas between its fields and points in its numbers, with unchanged line numbers. A text whose
/// first line has no more fields between semicolons than between commas is returned unchanged. Lines that begin with
/// `#` are comments, and become empty.
pub fn with_decimal_points(table: &str) -> Cow<'_, str> {
    let reader = |delimiter| {
        let mut builder = csv::ReaderBuilder::new();
        builder.delimiter(delimiter).comment(Some(b'#')).has_headers(false).flexible(true).from_reader(table.as_bytes())
    };
    let fields = |delimiter| reader(delimiter).records().next().and_then(Result::ok).map_or(0, |first| first.len());
    if fields(b';') <= fields(b',') {
        return Cow::Borrowed(table);
    }
    let (mut reader, mut record) = (reader(b';'), csv::StringRecord::new());
    let mut text = Vec::with_capacity(table.len());
    let mut line = 1;
    while reader.read_record(&mut record).expect("a table of text has records of text") {
        let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
        let fields = record.iter().map(|field| {
            let point = field.trim().replace(',', ".");
            let is_number = field.contains(',') && point.parse::<f64>().is_ok_and(f64::is_finite);
            if is_number { point } else { field.to_owned() }
        });
        writer.write_record(fields).expect("memory takes all that is written to it");
        let row = writer.into_inner().expect("memory takes all that is written to it");
        line += row.iter().filter(|byte| **byte == b'\n').count() as u64;
        // Empty lines and comments before the row: messages name lines.
        let skipped = reader.position().line().saturating_sub(line);
        text.extend(std::iter::repeat_n(b'\n', skipped as usize));
        text.extend(row);
        line += skipped;
    }
    Cow::Owned(String::from_utf8(text).expect("what was text is text"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_come_back_with_their_lines() {
        let table = "time,state,E_1,\"E, lx\"\n2005-01-01T08:30:00,v1.2,207.308098,-1.5e-3\n,\"a;b, \"\"c\"\"\",12,\n";
        let written = String::from_utf8(with_decimal_commas(table)).unwrap();
        assert_eq!(with_decimal_points(written.trim_start_matches(MARK)), table);
        assert!(matches!(with_decimal_points(table), Cow::Borrowed(_)));
        let lines = "x; y\n# 1,5; a\n\n 1,5;2\n\"a\nb\";1.234,5\n3;4,0\n";
        assert_eq!(with_decimal_points(lines), "x, y\n\n\n1.5,2\n\"a\nb\",\"1.234,5\"\n3,4.0\n");
        assert_eq!(with_decimal_points(""), "");
    }

    #[test]
    fn numbers_have_commas_and_text_stays() {
        let table = "time,state,E_1,\"E, lx\"\n2005-01-01T08:30:00,v1.2,207.308098,-1.5e-3\n,\"a;b, \"\"c\"\"\",12,\n";
        let written = "\u{feff}time;state;E_1;E, lx\r\n2005-01-01T08:30:00;v1.2;207,308098;-1,5e-3\r\n;\"a;b, \"\"c\"\"\";12;\r\n";
        assert_eq!(String::from_utf8(with_decimal_commas(table)).unwrap(), written);
    }
}
