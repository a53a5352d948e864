//! Report on an internal error: one text that says what happened, where and during which work, which the user can send
//! to the developers.

use super::Fault;
use crate::study::StudyError;
use crate::study::clock;
use crate::study::files::write_at_once;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Maximum number of reports in the folder; the oldest are removed.
pub const MOST_REPORTS: usize = 30;

/// Content of a report other than the panic itself.
#[derive(Debug, Clone, Default)]
pub struct Report<'a> {
    /// Work in progress, such as the job and its stage.
    pub doing: &'a str,
    /// Last steps of the user, oldest first.
    pub steps: &'a [String],
    /// Open documents: title and text of each, such as the scene in TOML, which is written without changes.
    pub open: &'a [(String, String)],
}

/// Returns the folder of the user's reports: beside the catalogue, in the user's folder for application data.
pub fn folder() -> Option<PathBuf> {
    directories::ProjectDirs::from("", "", "cfs").map(|folders| folders.data_dir().join("reports"))
}

/// Returns an argument of a command without its folders, which are private: `--out=/a/b.csv` becomes `--out=b.csv`.
pub fn without_folders(argument: &str) -> String {
    let (option, value) = match argument.split_once('=') {
        Some((option, value)) if option.starts_with('-') => (format!("{option}="), value),
        _ => (String::new(), argument),
    };
    let name = value.trim_end_matches(['/', '\\']).rsplit(['/', '\\']).next().unwrap_or_default();
    option + name
}

/// Replaces the user's home folder in a text by `~`.
fn without_home(text: &str) -> String {
    let home = directories::BaseDirs::new().map(|folders| folders.home_dir().display().to_string());
    match home.filter(|home| home.len() > 1) {
        Some(home) => text.replace(&home, "~"),
        None => text.to_owned(),
    }
}

/// Appends the data of one panic to a text.
fn append_fault(text: &mut String, fault: &Fault) {
    let place = if fault.place.is_empty() { "not known" } else { &fault.place };
    let [at, thread, backtrace] = [&fault.at, &fault.thread, &fault.backtrace];
    // Writing to a String cannot fail.
    let _ = write!(text, "message: {}\nplace: {place}\nthread: {thread}\nat: {at}\n{backtrace}", fault.message);
}

/// Returns the full text of a report. `before`: earlier panics.
fn text(fault: &Fault, before: &[Fault], report: &Report<'_>) -> String {
    let build = if cfg!(debug_assertions) { "debug" } else { "release" };
    let (system, processor) = (std::env::consts::OS, std::env::consts::ARCH);
    let mut own = String::new();
    let _ = write!(
        own,
        "cfs {} ({system}, {processor}, {build} build)\n\
         Internal error. This report can be read and sent as it is.\n\n\
         == What was being done\n{}\n\n== Fault\n",
        env!("CARGO_PKG_VERSION"),
        report.doing
    );
    append_fault(&mut own, fault);
    for other in before.iter().filter(|other| !other.is_same(fault)) {
        own.push_str("\n== Another one, which nobody waited for\n");
        append_fault(&mut own, other);
    }
    if !report.steps.is_empty() {
        let _ = write!(own, "\n== Last steps\n{}\n", report.steps.join("\n"));
    }
    let mut all = without_home(&own);
    for (title, open) in report.open {
        let _ = write!(all, "\n== {title}\n{open}\n");
    }
    all
}

/// Whether `name` is the file name of a report.
fn is_report(name: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|c| c.is_ascii_digit() || b"-T".contains(&c));
    name.strip_suffix(".txt").is_some_and(|stem| stem.len() >= 19 && stem.contains('T') && digits(stem))
}

/// Removes the oldest reports from a folder.
fn tidy(folder: &Path) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut list: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    list.retain(|name| is_report(name));
    list.sort();
    for name in list.iter().rev().skip(MOST_REPORTS) {
        // A report that another window has removed already is as good.
        drop(std::fs::remove_file(folder.join(name)));
    }
}

/// Writes a report on a panic into a folder, under a name made from the time in UTC such as `2026-11-23T10-22-05.txt`,
/// and returns its path.
///
/// # Errors
/// Returns an error that names the folder or the file if it cannot be written.
pub fn write(folder: &Path, fault: &Fault, report: &Report<'_>) -> Result<PathBuf, StudyError> {
    std::fs::create_dir_all(folder).map_err(|error| StudyError::File {
        path: folder.to_owned(),
        message: format!("cannot be made ({error}); expected a writable place"),
    })?;
    let stem = clock::now().timestamp().strftime("%Y-%m-%dT%H-%M-%S").to_string();
    let names =
        (1_u32..).map(|number| if number == 1 { format!("{stem}.txt") } else { format!("{stem}-{number}.txt") });
    let mut paths = names.map(|name| folder.join(name));
    // There are more numbers than files.
    let path = paths.find(|path| !path.exists()).unwrap_or_default();
    drop(write_at_once(&path, text(fault, &super::uncaught(), report).as_bytes())?);
    tidy(folder);
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault() -> Fault {
        Fault {
            message: "index 3 of 2".to_owned(),
            place: "src/a.rs:12:5".to_owned(),
            thread: "cfs room".to_owned(),
            at: "2026-11-23T10:22:05Z".to_owned(),
            backtrace: "0: cfs::a\n".to_owned(),
            report: None,
        }
    }

    #[test]
    fn a_report_says_all_of_it_and_names_nobodys_folder() {
        let folder = tempfile::tempdir().unwrap();
        let home = directories::BaseDirs::new().unwrap().home_dir().display().to_string();
        let fault = Fault { backtrace: format!("0: cfs::a at {home}/src/a.rs"), ..fault() };
        let steps = ["10:22 Hour(2)".to_owned(), "10:22 Select(\"opal\")".to_owned()];
        let scene = "[room]\nwidth = 4.0 # in /somewhere/of/the/scene\n";
        let open = [("Scene".to_owned(), scene.to_owned())];
        let report = Report { doing: "room, interreflection", steps: &steps, open: &open };
        let path = write(folder.path(), &fault, &report).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let version = env!("CARGO_PKG_VERSION");
        let platform = std::env::consts::OS;
        for part in
            [version, platform, "room, interreflection", "index 3 of 2", "src/a.rs:12:5", "cfs::a", "Hour(2)", scene]
        {
            assert!(text.contains(part), "{part} is not in {text}");
        }
        assert!(home.len() < 2 || !text.contains(&home), "{text}");
    }

    #[test]
    fn only_the_newest_reports_stay_and_nothing_else_goes() {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path();
        for day in 0..MOST_REPORTS + 10 {
            std::fs::write(at.join(format!("2001-01-{day:02}T10-00-00.txt")), "old").unwrap();
        }
        std::fs::write(at.join("notes.txt"), "mine").unwrap();
        let [first, second] = [(); 2].map(|()| write(at, &fault(), &Report::default()).unwrap());
        assert!(first != second && first.exists() && second.exists());
        let count = std::fs::read_dir(at).unwrap().count();
        assert_eq!(count, MOST_REPORTS + 1);
        assert!(at.join("notes.txt").exists() && !at.join("2001-01-00T10-00-00.txt").exists());
        assert!(first.file_name().and_then(|name| name.to_str()).is_some_and(is_report), "{first:?}");
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let taken = folder.path().join("taken");
        std::fs::write(&taken, "").unwrap();
        let error = write(&taken, &fault(), &Report::default()).unwrap_err().to_string();
        assert!(error.contains("taken: cannot be made"), "{error}");
    }

    #[test]
    fn arguments_keep_their_names_alone() {
        let said = ["room", "/a b/office.toml", "--out=C:\\x\\y.csv", "--tiles=8x8", "a/"].map(without_folders);
        assert_eq!(said, ["room", "office.toml", "--out=y.csv", "--tiles=8x8", "a"]);
    }
}
