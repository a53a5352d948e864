//! Licence expressions of dependencies against what the project accepts.

/// Licences that bind nobody beyond a notice.
const ACCEPTED: [&str; 13] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Crates that may have one more licence; the reasons stand in `deny.toml`.
pub const EXCEPTIONS: [(&str, &[&str]); 3] = [
    ("option-ext", &["MPL-2.0"]),
    ("colored", &["MPL-2.0"]),
    ("epaint_default_fonts", &["OFL-1.1", "Ubuntu-font-1.0"]),
];

/// Is there a way to satisfy the SPDX expression with accepted licences? A slash is the old way to write OR.
pub fn accepted(name: &str, expression: &str) -> Result<bool, String> {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let extra = EXCEPTIONS.iter().find(|(crate_name, _)| *crate_name == name).map_or(&[][..], |(_, extra)| extra);
    let mut at = 0;
    let answer = any_of(&words, &mut at, extra)?;
    if at == words.len() { Ok(answer) } else { Err(format!("`{expression}` cannot be read at word {}", at + 1)) }
}

fn any_of(words: &[&str], at: &mut usize, extra: &[&str]) -> Result<bool, String> {
    let mut answer = all_of(words, at, extra)?;
    while words.get(*at) == Some(&"OR") {
        *at += 1;
        answer |= all_of(words, at, extra)?;
    }
    Ok(answer)
}

fn all_of(words: &[&str], at: &mut usize, extra: &[&str]) -> Result<bool, String> {
    let mut answer = one(words, at, extra)?;
    while words.get(*at) == Some(&"AND") {
        *at += 1;
        answer &= one(words, at, extra)?;
    }
    Ok(answer)
}

fn one(words: &[&str], at: &mut usize, extra: &[&str]) -> Result<bool, String> {
    let word = *words.get(*at).ok_or("the expression ends early")?;
    *at += 1;
    if word == "(" {
        let answer = any_of(words, at, extra)?;
        if words.get(*at) != Some(&")") {
            return Err("a parenthesis stays open".into());
        }
        *at += 1;
        return Ok(answer);
    }
    let mut licence = word.to_owned();
    if words.get(*at) == Some(&"WITH") {
        let exception = words.get(*at + 1).ok_or("nothing after WITH")?;
        licence = format!("{word} WITH {exception}");
        *at += 2;
    }
    Ok(ACCEPTED.contains(&licence.as_str()) || extra.contains(&licence.as_str()))
}
