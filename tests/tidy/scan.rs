//! Reads Rust source just well enough to see its paths, macros and attributes: comments and literals are blanked, `use`
//! trees are spread out. Aliases (`use crate as x`) and paths built by macros are not followed.

/// A path as written, e.g. `crate::compute::btdf`, with the line on which it starts, counted from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UsedPath {
    /// Line, from 1.
    pub line: usize,
    /// Its words.
    pub words: Vec<String>,
}

/// The source with comments and the contents of literals turned into blanks, line for line.
pub fn blank(source: &str) -> String {
    let text: Vec<char> = source.chars().collect();
    let mut out = String::with_capacity(source.len());
    let mut at = 0;
    let keep_lines = |out: &mut String, part: &[char]| {
        out.extend(part.iter().map(|c| if *c == '\n' { '\n' } else { ' ' }));
    };
    while at < text.len() {
        let end = literal_end(&text, at).unwrap_or(at);
        if end > at {
            keep_lines(&mut out, &text[at..end]);
            at = end;
        } else if is_word(text[at]) {
            while at < text.len() && is_word(text[at]) {
                out.push(text[at]);
                at += 1;
            }
        } else {
            out.push(text[at]);
            at += 1;
        }
    }
    out
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Where the comment or literal that starts at `at` ends, if one does.
fn literal_end(text: &[char], at: usize) -> Option<usize> {
    let get = |i: usize| text.get(i).copied().unwrap_or('\0');
    let find = |mut i: usize, stop: &dyn Fn(usize) -> bool| {
        while i < text.len() && !stop(i) {
            i += 1;
        }
        i
    };
    match (get(at), get(at + 1)) {
        ('/', '/') => Some(find(at, &|i| text[i] == '\n')),
        ('/', '*') => {
            let (mut depth, mut i) = (1, at + 2);
            while i < text.len() && depth > 0 {
                match (get(i), get(i + 1)) {
                    ('/', '*') => (depth, i) = (depth + 1, i + 2),
                    ('*', '/') => (depth, i) = (depth - 1, i + 2),
                    _ => i += 1,
                }
            }
            Some(i)
        }
        ('"', _) => Some(quoted_end(text, at + 1, '"')),
        ('b', '"') => Some(quoted_end(text, at + 2, '"')),
        ('r', '"' | '#') | ('b', 'r') => {
            let start = find(at, &|i| !matches!(text[i], 'b' | 'r'));
            let quote = find(start, &|i| text[i] != '#');
            if get(quote) != '"' {
                return None;
            }
            let hashes = quote - start;
            let end = find(quote + 1, &|i| text[i] == '"' && (1..=hashes).all(|k| get(i + k) == '#'));
            Some((end + 1 + hashes).min(text.len()))
        }
        // A character, not a lifetime.
        ('\'', '\\') => Some(quoted_end(text, at + 1, '\'')),
        ('\'', _) if get(at + 2) == '\'' => Some(at + 3),
        _ => None,
    }
}

fn quoted_end(text: &[char], mut at: usize, quote: char) -> usize {
    while at < text.len() && text[at] != quote {
        at += if text[at] == '\\' { 2 } else { 1 };
    }
    (at + 1).min(text.len())
}

/// Words and signs with their lines; `::` is one sign.
fn tokens(blanked: &str) -> Vec<(usize, String)> {
    let mut list: Vec<(usize, String)> = vec![];
    for (line, text) in blanked.lines().enumerate() {
        let mut chars = text.chars().peekable();
        while let Some(c) = chars.next() {
            if c.is_whitespace() {
                continue;
            }
            let mut token = String::from(c);
            if is_word(c) {
                while let Some(next) = chars.next_if(|c| is_word(*c)) {
                    token.push(next);
                }
            } else if c == ':' && chars.next_if_eq(&':').is_some() {
                token.push(':');
            }
            list.push((line + 1, token));
        }
    }
    list
}

fn starts_word(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Every path of at least two words, and every single word after `use`; trees in braces are spread out.
pub fn paths(source: &str) -> Vec<UsedPath> {
    paths_of(&tokens(&blank(source)))
}

fn paths_of(tokens: &[(usize, String)]) -> Vec<UsedPath> {
    let mut found = vec![];
    let mut at = 0;
    while at < tokens.len() {
        let before = if at == 0 { "" } else { tokens[at - 1].1.as_str() };
        if starts_word(&tokens[at].1) && before != "." {
            let first = found.len();
            at = tree(tokens, at, &[], &mut found);
            if before != "use" {
                let kept: Vec<UsedPath> = found.drain(first..).filter(|path| path.words.len() > 1).collect();
                found.extend(kept);
            }
        } else {
            at += 1;
        }
    }
    found
}

/// Reads a path, and the tree that may end it, from `at`; returns where to go on.
fn tree(tokens: &[(usize, String)], mut at: usize, head: &[String], found: &mut Vec<UsedPath>) -> usize {
    let token = |at: usize| tokens.get(at).map_or("", |(_, token)| token.as_str());
    let line = tokens[at].0;
    let mut words = head.to_vec();
    while starts_word(token(at)) || token(at) == "*" {
        words.push(token(at).to_owned());
        at += 1;
        if token(at) != "::" {
            break;
        }
        at += 1;
        if token(at) == "{" {
            at += 1;
            while at < tokens.len() && token(at) != "}" {
                if starts_word(token(at)) || token(at) == "*" {
                    at = tree(tokens, at, &words, found);
                } else {
                    at += 1;
                }
            }
            return at + 1;
        }
    }
    found.push(UsedPath { line, words });
    at
}

/// Macros by name and line.
pub fn macros(source: &str) -> Vec<(usize, String)> {
    let tokens = tokens(&blank(source));
    let pairs = tokens.windows(3).filter(|three| {
        starts_word(&three[0].1) && three[1].1 == "!" && matches!(three[2].1.as_str(), "(" | "[" | "{")
    });
    pairs.map(|three| three[0].clone()).collect()
}

/// First words of attributes, with lines.
pub fn attributes(source: &str) -> Vec<(usize, String)> {
    let tokens = tokens(&blank(source));
    let pairs = tokens.windows(3).filter(|three| three[0].1 == "#" && three[1].1 == "[");
    pairs.map(|three| three[2].clone()).collect()
}

/// The source with everything under `#[cfg(test)]` turned into blanks, line for line.
pub fn without_tests(source: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let mut code: Vec<char> = blank(source).chars().collect();
    let mut text: Vec<char> = source.chars().collect();
    let mark: Vec<char> = MARK.chars().collect();
    while let Some(start) = code.windows(mark.len()).position(|part| part == mark) {
        let mut depth = 0_usize;
        let end = code[start + mark.len()..].iter().position(|&c| {
            match c {
                '{' => depth += 1,
                '}' => depth = depth.saturating_sub(1),
                _ => {}
            }
            (c == ';' || c == '}') && depth == 0
        });
        let end = end.map_or(code.len(), |at| start + mark.len() + at + 1);
        for at in start..end {
            if code[at] != '\n' {
                code[at] = ' ';
            }
            if text[at] != '\n' {
                text[at] = ' ';
            }
        }
    }
    text.into_iter().collect()
}

/// The same, besides comments and literals.
pub fn tests_blanked(source: &str) -> String {
    blank(&without_tests(source))
}

/// A string literal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Literal {
    /// Line, from 1.
    pub line: usize,
    /// What stands between its quotes.
    pub text: String,
    /// The code before it, comments and literals blanked.
    pub before: String,
}

/// String literals outside of tests.
pub fn literals(source: &str) -> Vec<Literal> {
    let text: Vec<char> = without_tests(source).chars().collect();
    let code: Vec<char> = blank(&text.iter().collect::<String>()).chars().collect();
    let (mut at, mut line, mut list) = (0, 1, vec![]);
    while at < text.len() {
        let end = if is_word(text[at]) && !matches!(text[at], 'r' | 'b') {
            (at..text.len()).find(|&i| !is_word(text[i])).unwrap_or(text.len())
        } else {
            literal_end(&text, at).unwrap_or(at + 1)
        };
        let own: String = text[at..end].iter().collect();
        if matches!(text[at], '"' | 'r' | 'b') && own.ends_with(['"', '#']) && own.len() > 1 {
            let inner = own.trim_start_matches(['r', 'b', '#']).trim_end_matches('#').trim_matches('"').to_owned();
            list.push(Literal { line, text: inner, before: code[at.saturating_sub(80)..at].iter().collect() });
        }
        line += own.matches('\n').count();
        at = end;
    }
    list
}

/// `use` trees with whether they are public, and the place of the first token behind them.
fn uses(tokens: &[(usize, String)]) -> Vec<(bool, std::ops::Range<usize>)> {
    let word = |at: usize| tokens.get(at).map_or("", |(_, token)| token.as_str());
    let starts = (0..tokens.len()).filter(|&at| word(at) == "use");
    starts
        .map(|at| {
            let end = (at..tokens.len()).find(|&end| word(end) == ";").unwrap_or(tokens.len());
            let public = at > 0 && (word(at - 1) == "pub" || word(at - 1) == ")");
            (public, at + 1..end)
        })
        .collect()
}

/// Names that a file hands on by `pub use`, each with the path it stands for.
pub fn reexports(text: &str) -> Vec<(String, Vec<String>)> {
    let tokens = tokens(text);
    let mut list = vec![];
    for (_, range) in uses(&tokens).into_iter().filter(|(public, _)| *public) {
        let mut found = vec![];
        tree(&tokens, range.start, &[], &mut found);
        for path in found {
            if let Some(name) = path.words.last() {
                list.push((name.clone(), path.words.clone()));
            }
        }
    }
    list
}

/// Paths that a file uses itself: those of [`paths`] without what it only hands on.
pub fn module_paths(text: &str) -> Vec<UsedPath> {
    let tokens = tokens(text);
    let mut kept = vec![];
    let mut at = 0;
    for (public, range) in uses(&tokens) {
        kept.extend_from_slice(&tokens[at..range.start - usize::from(public)]);
        if !public {
            kept.extend_from_slice(&tokens[range.clone()]);
        }
        at = range.end;
    }
    kept.extend_from_slice(&tokens[at..]);
    paths_of(&kept)
}
