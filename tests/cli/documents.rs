//! README, guide and examples: every command in them runs, those of README and guide print what is shown below them, and
//! every scene fragment is a scene.
//!
//! The fenced blocks of a page are worked through in order, in one folder that holds the project's examples and system
//! descriptions, with a catalogue of its own:
//! - `console`: lines `$ cfs …` are run; the lines below are what the command prints, standard output first. `…` stands for any
//!   text in a line and, alone, for any number of lines. The command fails exactly where it shows a line `cfs: …`.
//! - any block with a file name after its language: the file is written;
//! - `toml` without a file name: laid over `examples/office.toml`, it is a scene;
//! - `rust`: a documentation test of the library, which `cargo test` runs by itself;
//! - `sh`: commands that need more than the program; `tests/tidy` and the scripts in `.ci` run them.

use cfs::study::SceneFile;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Fenced block of a page.
struct Block<'a> {
    /// Number of its first line.
    line: usize,
    language: &'a str,
    /// File name behind the language.
    file: Option<&'a str>,
    lines: Vec<&'a str>,
}

fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut list = Vec::new();
    let mut open: Option<Block<'_>> = None;
    for (number, line) in text.lines().enumerate() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(_), Some(_)) => list.extend(open.take()),
            (Some(info), None) => {
                let mut words = info.split_whitespace();
                let language = words.next().unwrap_or_default();
                open = Some(Block { line: number + 2, language, file: words.next(), lines: Vec::new() });
            }
            (None, Some(block)) => block.lines.push(line),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block that does not end");
    list
}

/// Commands of a console block, each with the output that is shown.
fn commands<'a>(block: &Block<'a>) -> Vec<(&'a str, Vec<&'a str>)> {
    let mut list: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in &block.lines {
        match (line.strip_prefix("$ "), list.last_mut()) {
            (Some(command), _) => list.push((command, Vec::new())),
            (None, Some((_, shown))) => shown.push(line),
            (None, None) => panic!("line {}: output without a command", block.line),
        }
    }
    list
}

/// Whether `text` is `pattern`, whose `…` stand for any text.
fn is_line(pattern: &str, text: &str) -> bool {
    let Some((start, rest)) = pattern.split_once('…') else { return pattern == text };
    let Some(mut text) = text.strip_prefix(start) else { return false };
    let mut parts: Vec<&str> = rest.split('…').collect();
    let end = parts.pop().unwrap_or_default();
    for part in parts {
        let Some(place) = text.find(part) else { return false };
        text = &text[place + part.len()..];
    }
    text.ends_with(end)
}

/// Whether the printed lines are those shown, where a line `…` stands for any number of them.
fn is_shown(shown: &[&str], printed: &[&str]) -> bool {
    match (shown, printed) {
        ([], []) => true,
        (["…", rest @ ..], _) => (0..=printed.len()).any(|skipped| is_shown(rest, &printed[skipped..])),
        ([pattern, rest @ ..], [line, others @ ..]) => is_line(pattern, line.trim_end()) && is_shown(rest, others),
        _ => false,
    }
}

/// Folder with copies of the examples and of the system descriptions.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for source in ["examples", "assets/systems"] {
        std::fs::create_dir_all(folder.path().join(source)).unwrap();
        for entry in std::fs::read_dir(root().join(source)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "toml" || e == "txt") {
                std::fs::copy(&path, folder.path().join(source).join(path.file_name().unwrap())).unwrap();
            }
        }
    }
    folder
}

/// Runs a command of a page; what is wrong with it.
fn run(folder: &Path, command: &str, shown: &[&str]) -> Option<String> {
    let mut words = command.split_whitespace();
    if words.next() != Some("cfs") {
        return Some("only the program itself is run".into());
    }
    let output = Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(words.map(|word| word.trim_matches(['"', '\''])))
        .current_dir(folder)
        .env("CFS_CATALOGUE", folder.join("catalogue.sqlite"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap();
    let printed = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    let fails = shown.iter().any(|line| line.starts_with("cfs: "));
    if output.status.success() == fails {
        return Some(format!("{}:\n{printed}", output.status));
    }
    let lines: Vec<&str> = printed.lines().collect();
    (!is_shown(shown, &lines)).then(|| format!("prints\n{printed}"))
}

/// Lays the tables of `over` over those of `table`.
fn lay_over(table: &mut toml::Table, over: toml::Table) {
    for (key, value) in over {
        match (table.get_mut(&key), value) {
            (Some(toml::Value::Table(below)), toml::Value::Table(above)) => lay_over(below, above),
            (_, value) => drop(table.insert(key, value)),
        }
    }
}

/// What is wrong with a fragment of a scene.
fn fragment(text: &str) -> Option<String> {
    let office = std::fs::read_to_string(root().join("examples/office.toml")).unwrap();
    let mut scene: toml::Table = office.parse().unwrap();
    match text.parse() {
        Ok(over) => lay_over(&mut scene, over),
        Err(error) => return Some(error.to_string()),
    }
    SceneFile::parse(&scene.to_string()).err().map(|error| error.to_string())
}

/// Works through a page; what is wrong with it, with places.
fn examine(path: &Path) -> Vec<String> {
    let name = path.strip_prefix(root()).unwrap().display();
    let text = std::fs::read_to_string(path).unwrap();
    let folder = folder();
    let mut wrong = Vec::new();
    for block in blocks(&text) {
        let place = format!("{name}:{}", block.line);
        match (block.language, block.file) {
            (_, Some(file)) => std::fs::write(folder.path().join(file), block.lines.join("\n") + "\n").unwrap(),
            ("console", None) => wrong.extend(commands(&block).into_iter().filter_map(|(command, shown)| {
                run(folder.path(), command, &shown).map(|fault| format!("{place}: {command}: {fault}"))
            })),
            ("toml", None) => {
                wrong.extend(fragment(&block.lines.join("\n")).map(|fault| format!("{place}: {fault}")));
            }
            ("rust" | "sh", None) => {}
            (language, None) => wrong.push(format!("{place}: nothing tests a block of language '{language}'")),
        }
    }
    wrong
}

#[test]
fn readme_and_guide_are_as_the_program_is() {
    let mut pages: Vec<PathBuf> =
        std::fs::read_dir(root().join("assets/guide")).unwrap().map(|entry| entry.unwrap().path()).collect();
    pages.push(root().join("README.md"));
    assert!(pages.len() > 7, "{pages:?}");
    let wrong: Vec<String> = pages.par_iter().flat_map(|page| examine(page)).collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Lines `#   cfs …` of the comment that an example begins with.
fn commands_of_head(text: &str) -> Vec<&str> {
    text.lines().map_while(|line| line.strip_prefix('#')).filter_map(|line| line.strip_prefix("   ")).collect()
}

#[test]
fn examples_run_by_the_commands_that_they_begin_with() {
    let folder = folder();
    let mut wrong = Vec::new();
    for entry in std::fs::read_dir(folder.path().join("examples")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let commands = commands_of_head(&text);
        assert!(!commands.is_empty(), "{}: begins with no command", path.display());
        for command in commands {
            // The data of all products that it finds take minutes.
            let few = if command.starts_with("cfs rank") { " --products electrochromic" } else { "" };
            wrong.extend(run(folder.path(), &format!("{command}{few}"), &["…"]));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn what_differs_from_the_page_is_seen() {
    assert!(is_line("a … c", "a b c") && is_line("…", "") && is_line("x…", "xy") && !is_line("a … c", "a b"));
    assert!(is_shown(&["a", "…", "d"], &["a", "b", "c", "d"]) && is_shown(&["…"], &[]));
    assert!(!is_shown(&["a"], &["a", "b"]) && !is_shown(&["a", "…", "x"], &["a", "b"]) && !is_shown(&["a"], &["b"]));
    let page = "```console\n$ cfs sky a.toml\nout\n$ cfs limits\n```\ntext\n```toml s.toml\n[a]\n```\n";
    let found = blocks(page);
    assert_eq!(commands(&found[0]), [("cfs sky a.toml", vec!["out"]), ("cfs limits", vec![])]);
    assert_eq!((found[1].line, found[1].file, found[1].lines[0]), (8, Some("s.toml"), "[a]"));
    assert!(fragment("[room]\nwidth = 3.0").is_none() && fragment("[room]\nwidht = 3.0").is_some());
    let folder = folder();
    assert!(run(folder.path(), "cfs limits", &["…"]).is_none());
    assert!(run(folder.path(), "cfs limits", &["nothing"]).is_some());
    assert!(run(folder.path(), "cfs info none.xml", &["cfs: none.xml: …"]).is_none());
    assert!(run(folder.path(), "cfs info none.xml", &["…"]).is_some(), "a failure has to be shown");
    assert!(run(folder.path(), "ls", &["…"]).is_some());
    assert_eq!(
        commands_of_head("# A room.\n#\n#   cfs room a.toml\n# x\n[a]\n#   cfs sky a.toml\n"),
        ["cfs room a.toml"]
    );
}
