//! Storage of a long annual simulation while it is computed, beside its table, so that an interrupted run can be
//! resumed.
//!
//! A partial file `NAME.part` contains the hash of all input of the hours, then a line for each hour with all bits of
//! its numbers, so that a resumed year is identical to one of a single run. It is created only when the run takes
//! longer than [`STORE_DELAY`], and removed when the table is complete. A line that was incomplete when the run ended
//! is written again. Results that follow from the hours (glare, solar energy, figures) are not stored.

use super::light::{Counted, Engine, Found, Light, Question, prepared};
use crate::compute::estimate::Progress;
use crate::study::error::StudyError;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Duration of a run after which its hours are stored; shorter runs create no partial file.
pub const STORE_DELAY: Duration = Duration::from_secs(10);
/// Duration of the computation between two writes, which determines the number of hours in a block.
const BLOCK: Duration = Duration::from_secs(10);
/// Number of hours in the first block, before their duration is known.
const FIRST: usize = 64;
/// First word of a partial file, with the version of its format.
const HEAD: &str = "cfs-year-part-2";

/// Illuminances of one hour, for storage in the partial file.
#[derive(Debug, Clone, PartialEq)]
struct Hour {
    values: Vec<f64>,
    errors: Vec<f64>,
    sun: Option<Vec<f64>>,
}

/// Stored hours of an annual simulation, and their partial file.
#[derive(Debug)]
pub struct Kept {
    path: PathBuf,
    fingerprint: String,
    file: Option<File>,
    hours: BTreeMap<usize, Hour>,
    waiting: String,
    begun: Instant,
    delay: Duration,
}

fn wrong(path: &Path, message: impl Into<String>) -> StudyError {
    StudyError::File { path: path.to_owned(), message: message.into() }
}

fn numbers(text: &mut String, values: &[f64]) {
    for value in values {
        // Writing to a String cannot fail.
        let _ = write!(text, " {:016x}", value.to_bits());
    }
}

impl Hour {
    fn line(&self, step: usize) -> String {
        let sun = if self.sun.is_some() { 's' } else { '-' };
        let mut text = format!("{step} {} {sun}", self.values.len());
        numbers(&mut text, &self.values);
        numbers(&mut text, &self.errors);
        numbers(&mut text, self.sun.as_deref().unwrap_or_default());
        text.push('\n');
        text
    }

    /// Reads the index of a step and its illuminances from a line of the partial file; `None` if the line is
    /// incomplete.
    fn read(line: &str) -> Option<(usize, Self)> {
        let mut words = line.split(' ');
        let step = words.next()?.parse().ok()?;
        let places: usize = words.next()?.parse().ok()?;
        let sun = match words.next()? {
            "-" => false,
            "s" => true,
            _ => return None,
        };
        let all: Vec<f64> = words
            .map(|word| (word.len() == 16).then(|| u64::from_str_radix(word, 16).ok().map(f64::from_bits)).flatten())
            .collect::<Option<_>>()?;
        if places == 0 || all.len() != places * if sun { 3 } else { 2 } {
            return None;
        }
        let part = |k: usize| all[k * places..][..places].to_vec();
        Some((step, Self { values: part(0), errors: part(1), sun: sun.then(|| part(2)) }))
    }
}

impl Kept {
    /// Creates the store beside a table, and reads an existing partial file. `fingerprint`: hash of all input of the
    /// hours; `delay`: see [`STORE_DELAY`]; `may_overwrite`: whether a file of another input may be overwritten.
    ///
    /// # Errors
    /// Returns an error if the partial file is of another scene, weather or program, or if another run is writing it.
    pub fn beside(table: &Path, fingerprint: String, delay: Duration, may_overwrite: bool) -> Result<Self, StudyError> {
        let mut name = table.as_os_str().to_owned();
        name.push(".part");
        let path = PathBuf::from(name);
        let mut kept = Self {
            path,
            fingerprint,
            file: None,
            hours: BTreeMap::new(),
            waiting: String::new(),
            begun: Instant::now(),
            delay,
        };
        if kept.path.exists() {
            kept.take_up(may_overwrite)?;
        }
        Ok(kept)
    }

    /// Reads the existing partial file; new hours will follow its last complete line.
    fn take_up(&mut self, may_overwrite: bool) -> Result<(), StudyError> {
        let cannot =
            |error: std::io::Error| wrong(&self.path, format!("cannot be read ({error}); check path and rights"));
        let mut file = OpenOptions::new().read(true).write(true).open(&self.path).map_err(cannot)?;
        locked(&file, &self.path)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(cannot)?;
        let text = String::from_utf8_lossy(&bytes);
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let mut lines = whole.lines();
        let head = lines.next().unwrap_or_default();
        if head != format!("{HEAD} {}", self.fingerprint) && !(may_overwrite || whole.is_empty()) {
            let what = match head.strip_prefix(HEAD) {
                Some(_) => "holds hours of another scene, weather, product or program",
                None => "is not a part of a year",
            };
            return Err(wrong(&self.path, format!("{what}; remove it, or start again with --force")));
        }
        let mut end = 0;
        if head == format!("{HEAD} {}", self.fingerprint) {
            end = head.len() + 1;
            for line in lines {
                // Lines after a damaged line are not trusted.
                let Some((step, hour)) = Hour::read(line) else { break };
                self.hours.insert(step, hour);
                end += line.len() + 1;
            }
        }
        let write_error = |error: std::io::Error| wrong(&self.path, format!("cannot be written ({error})"));
        file.set_len(end as u64).map_err(write_error)?;
        file.seek(SeekFrom::End(0)).map_err(write_error)?;
        if end == 0 {
            file.write_all(format!("{HEAD} {}\n", self.fingerprint).as_bytes()).map_err(write_error)?;
        }
        self.file = Some(file);
        Ok(())
    }

    /// Returns the number of stored hours.
    pub fn count(&self) -> usize {
        self.hours.len()
    }

    /// Returns the path of the partial file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn keep(&mut self, step: usize, hour: Hour) {
        self.waiting.push_str(&hour.line(step));
        self.hours.insert(step, hour);
    }

    /// Writes the hours that have not been written, once the run has taken longer than the delay.
    fn write(&mut self) -> Result<(), StudyError> {
        if self.waiting.is_empty() || self.file.is_none() && self.begun.elapsed() < self.delay {
            return Ok(());
        }
        let write_error = |error: std::io::Error| wrong(&self.path, format!("cannot be written ({error}); make room"));
        if self.file.is_none() {
            let mut file = OpenOptions::new().write(true).create_new(true).open(&self.path).map_err(write_error)?;
            locked(&file, &self.path)?;
            file.write_all(format!("{HEAD} {}\n", self.fingerprint).as_bytes()).map_err(write_error)?;
            self.file = Some(file);
        }
        if let Some(file) = &mut self.file {
            file.write_all(self.waiting.as_bytes()).map_err(write_error)?;
        }
        self.waiting.clear();
        Ok(())
    }

    /// Removes the partial file, because the table is complete or will not be written.
    ///
    /// # Errors
    /// Returns an error if the file cannot be removed.
    pub fn done(mut self) -> Result<(), StudyError> {
        match self.file.take() {
            None => Ok(()),
            Some(file) => {
                drop(file);
                let remove_error = |error: std::io::Error| wrong(&self.path, format!("cannot be removed ({error})"));
                std::fs::remove_file(&self.path).map_err(remove_error)
            }
        }
    }
}

/// Locks the partial file. Where files cannot be locked, two simultaneous runs are not detected.
fn locked(file: &File, path: &Path) -> Result<(), StudyError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(wrong(path, "another run is writing it; expected one at a time")),
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// Computes the illuminances of all hours like [`super::light::light`], but reads finished hours from the partial file
/// and appends new ones to it.
pub(super) fn light(
    question: &Question<'_>,
    states: &[Vec<usize>],
    chosen: &[usize],
    kept: &mut Kept,
    progress: &dyn Progress,
) -> Result<Light, StudyError> {
    let places = question.settings.sensors + question.settings.eyes.len();
    let mut sets: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
    for &k in chosen.iter().filter(|&&k| question.settings.asks(&question.steps.list[k])) {
        sets.entry(&states[k]).or_default().push(k);
    }
    let (count, all) = (sets.len(), sets.values().map(Vec::len).sum());
    let mut done = chosen.iter().filter(|k| kept.hours.contains_key(*k)).count();
    for (set, steps) in sets {
        let missing: Vec<usize> = steps.iter().copied().filter(|k| !kept.hours.contains_key(k)).collect();
        if missing.is_empty() {
            continue;
        }
        let engine = Engine::new(question, prepared(question, set)?, steps.len(), progress)?;
        let (mut at, mut block) = (0, FIRST);
        while at < missing.len() {
            let part = &missing[at..(at + block).min(missing.len())];
            let clock = Instant::now();
            let put = |index: usize, Found { light, sun }| {
                let (values, errors) = light.iter().map(|e| (e.value, e.error)).unzip();
                kept.keep(part[index], Hour { values, errors, sun });
            };
            let ended = engine.steps(question, part, put, &Counted { inner: progress, before: done, all });
            // Hours found before a run is cancelled are not lost.
            kept.write()?;
            ended?;
            (at, done) = (at + part.len(), done + part.len());
            let share = BLOCK.as_secs_f64() / clock.elapsed().as_secs_f64().max(1e-3);
            block = ((part.len() as f64 * share) as usize).max(FIRST);
        }
    }
    let mut light = Light::zeros(chosen.len(), places, all, count);
    for (row, k) in chosen.iter().enumerate() {
        let Some(hour) = kept.hours.get(k).filter(|hour| hour.values.len() == places) else { continue };
        light.put(row, &hour.values, &hour.errors, hour.sun.as_deref());
    }
    Ok(light)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hour(sun: bool) -> Hour {
        let sun = sun.then(|| vec![0.0, 1e-300]);
        Hour { values: vec![0.1, 12345.678901234567], errors: vec![f64::MIN_POSITIVE, 2.0], sun }
    }

    #[test]
    fn an_hour_keeps_every_bit() {
        for one in [hour(true), hour(false)] {
            let line = one.line(4711);
            assert_eq!(Hour::read(line.trim_end()), Some((4711, one)));
            // Whatever is missing of it, it is none.
            for end in 0..line.len() - 2 {
                assert_eq!(Hour::read(&line[..end]), None, "{end}");
            }
        }
    }

    #[test]
    fn a_part_goes_on_behind_its_last_whole_line() {
        let folder = tempfile::tempdir().unwrap();
        let table = folder.path().join("hours.csv");
        let open = |fingerprint: &str, anew| Kept::beside(&table, fingerprint.to_owned(), Duration::ZERO, anew);
        let mut kept = open("a", false).unwrap();
        assert_eq!(kept.count(), 0);
        kept.keep(3, hour(true));
        kept.keep(4, hour(false));
        kept.write().unwrap();
        let busy = open("a", false).unwrap_err().to_string();
        assert!(busy.contains("another run"), "{busy}");
        let path = kept.path().to_owned();
        drop(kept);
        let mut text = std::fs::read(&path).unwrap();
        text.truncate(text.len() - 7);
        std::fs::write(&path, &text).unwrap();
        let other = open("b", false).unwrap_err().to_string();
        assert!(
            other.contains("hours.csv.part") && other.contains("another scene") && !other.contains('\n'),
            "{other}"
        );
        let mut kept = open("a", false).unwrap();
        assert_eq!(kept.hours, BTreeMap::from([(3, hour(true))]));
        kept.keep(5, hour(false));
        kept.write().unwrap();
        drop(kept);
        let kept = open("a", false).unwrap();
        assert_eq!(kept.hours.keys().copied().collect::<Vec<_>>(), [3, 5]);
        drop(kept);
        let kept = open("b", true).unwrap();
        assert_eq!(kept.count(), 0);
        kept.done().unwrap();
        assert!(!path.exists());
        std::fs::write(&path, "notes\n").unwrap();
        assert!(open("a", false).unwrap_err().to_string().contains("is not a part of a year"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "notes\n");
    }

    #[test]
    fn short_runs_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut kept = Kept::beside(&folder.path().join("a.csv"), "a".to_owned(), STORE_DELAY, false).unwrap();
        kept.keep(1, hour(true));
        kept.write().unwrap();
        assert!(!kept.path().exists() && kept.done().is_ok());
    }
}
