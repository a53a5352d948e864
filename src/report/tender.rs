//! Tender texts: a template with named fields, filled with a product's figures.

use super::ReportError;
use crate::texts::{Language, export as texts, language};

/// Template of a tender text in English that comes with the program.
pub const TEMPLATE: &str = include_str!("../../assets/tender.txt");
/// Template of a tender text in German that comes with the program.
pub const TEMPLATE_GERMAN: &str = include_str!("../../assets/tender_de.txt");

/// Returns the template to use for `template`: a template that comes with the program is replaced by that in the
/// current language, any other is returned unchanged.
pub fn spoken(template: &str) -> &str {
    match language() {
        _ if template != TEMPLATE && template != TEMPLATE_GERMAN => template,
        Language::English => TEMPLATE,
        Language::German => TEMPLATE_GERMAN,
    }
}

/// Fields of a tender text: names with their values; an empty value means unknown.
pub type Fields = [(&'static str, String)];

/// Returns the lines of a template with their fields replaced by values. A line is left out if all of its fields are
/// unknown; if only some are, `–` replaces them. Lines that begin with `#` are left out, too.
///
/// # Errors
/// Returns an error if the template contains an unknown field or an unclosed brace.
pub fn fill(template: &str, fields: &Fields) -> Result<Vec<String>, ReportError> {
    let mut out = Vec::new();
    for (number, line) in template.lines().enumerate() {
        if line.starts_with('#') {
            continue;
        }
        let wrong = |what: String| ReportError::Template(number + 1, what);
        let (mut text, mut known, mut unknown) = (String::new(), 0, 0);
        let mut rest = line;
        while let Some((before, after)) = rest.split_once('{') {
            let (name, behind) = after.split_once('}').ok_or_else(|| wrong(texts::open_brace("{", "}", "{name}")))?;
            let names = || fields.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            let (_, value) =
                fields.iter().find(|(one, _)| *one == name).ok_or_else(|| wrong(texts::no_field(name, names())))?;
            text.push_str(before);
            if value.is_empty() {
                unknown += 1;
                text.push('–');
            } else {
                known += 1;
                text.push_str(value);
            }
            rest = behind;
        }
        text.push_str(rest);
        if known > 0 || unknown == 0 {
            out.push(text);
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_filled_and_lines_without_any_left_out() {
        let fields = [("name", "Blind".to_owned()), ("maker", String::new()), ("view", "3 %".to_owned())];
        let lines = fill("# x {nothing}\n{name}: {view}\nMaker: {maker}\nplain\n{view}, {maker}", &fields).unwrap();
        assert_eq!(lines, ["Blind: 3 %", "plain", "3 %, –"]);
    }

    #[test]
    fn the_shipped_templates_have_the_same_fields_and_own_ones_stay() {
        let fields = |text: &str| -> Vec<String> {
            let lines = text.lines().filter(|line| !line.starts_with('#')).flat_map(|line| line.split('{').skip(1));
            let mut list: Vec<String> = lines.filter_map(|rest| Some(rest.split_once('}')?.0.to_owned())).collect();
            list.sort();
            list
        };
        assert_eq!(fields(TEMPLATE), fields(TEMPLATE_GERMAN));
        assert_eq!(spoken(TEMPLATE_GERMAN), TEMPLATE);
        let _german = crate::texts::speak(Language::German);
        assert_eq!((spoken(TEMPLATE), spoken("own")), (TEMPLATE_GERMAN, "own"));
    }

    #[test]
    fn what_is_no_field_is_told_with_its_line() {
        let fields = [("name", String::new())];
        let error = fill("a\n{nmae}", &fields).unwrap_err().to_string();
        assert!(error.contains("line 2") && error.contains("{nmae}") && error.contains("fields are name"), "{error}");
        assert!(fill("{name", &fields).unwrap_err().to_string().contains("without its }"));
    }
}
