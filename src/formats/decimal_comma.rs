//! Tables as a spreadsheet opens them by a double click where decimals have a comma, as in German: semicolons between fields.

/// Mark by which spreadsheets know UTF-8.
const MARK: &str = "\u{feff}";

/// Returns a CSV table with semicolons between its fields and a comma in its numbers, in UTF-8 with its mark.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_commas_and_text_stays() {
        let table = "time,state,E_1,\"E, lx\"\n2005-01-01T08:30:00,v1.2,207.308098,-1.5e-3\n,\"a;b, \"\"c\"\"\",12,\n";
        let written = "\u{feff}time;state;E_1;E, lx\r\n2005-01-01T08:30:00;v1.2;207,308098;-1,5e-3\r\n;\"a;b, \"\"c\"\"\";12;\r\n";
        assert_eq!(String::from_utf8(with_decimal_commas(table)).unwrap(), written);
    }
}
