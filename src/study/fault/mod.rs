//! Internal errors of the program: data of every panic, wherever it happened, and the report on it that a user can
//! send.
//!
//! Once [`watch`] was called, message, source location and backtrace of every panic are stored before its thread
//! unwinds, a thread of ours or one of a pool. Whoever catches the panic finds them by its message ([`caught`]),
//! because a pool passes on only the message to the thread that waits for it.

mod report;

pub use report::{MOST_REPORTS, Report, folder, without_folders, write};

use super::clock;
use std::any::Any;
use std::backtrace::Backtrace;
use std::collections::VecDeque;
use std::panic::PanicHookInfo;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

/// Maximum number of panics whose data are stored until they are caught; the oldest are dropped.
const MOST_KEPT: usize = 20;

/// Data of a panic, which is an internal error of the program.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fault {
    /// Message of the panic.
    pub message: String,
    /// Source file, line and column of the panic; empty if [`watch`] was not called.
    pub place: String,
    /// Name of the thread that panicked.
    pub thread: String,
    /// Time of the panic, as UTC text.
    pub at: String,
    /// Backtrace of the panic; empty if [`watch`] was not called.
    pub backtrace: String,
    /// Path of the report on the panic, if one was written already.
    pub report: Option<PathBuf>,
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl Fault {
    /// Whether both panics have the same source location and message.
    pub fn is_same(&self, other: &Self) -> bool {
        self.message == other.message && self.place == other.place
    }

    fn with_message(message: Option<&str>) -> Self {
        Self { message: message.unwrap_or(NO_MESSAGE).to_owned(), ..Self::default() }
    }
}

/// Message for a panic without text.
const NO_MESSAGE: &str = "no message";

/// Data of recent panics that nobody has caught, oldest first.
static KEPT: Mutex<VecDeque<Fault>> = Mutex::new(VecDeque::new());

fn kept() -> MutexGuard<'static, VecDeque<Fault>> {
    KEPT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Stores the data of every panic from now on. With `true` panics are also printed on standard error where they happen,
/// as without this call; with `false` whoever catches them has to report them. The value of the first call applies.
pub fn watch(is_printed: bool) {
    static WATCHING: Once = Once::new();
    WATCHING.call_once(|| {
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            keep(info);
            if is_printed {
                before(info);
            }
        }));
    });
}

/// Stores the data of a panic, with its backtrace.
fn keep(info: &PanicHookInfo<'_>) {
    let fault = Fault {
        place: info.location().map(ToString::to_string).unwrap_or_default(),
        thread: std::thread::current().name().unwrap_or("one of a pool").to_owned(),
        at: clock::now().timestamp().to_string(),
        backtrace: Backtrace::force_capture().to_string(),
        ..Fault::with_message(info.payload_as_str())
    };
    let mut kept = kept();
    if kept.len() >= MOST_KEPT {
        kept.pop_front();
    }
    kept.push_back(fault);
}

/// Returns the data of a panic that was caught, and removes them from the stored ones.
pub fn caught(panic: &(dyn Any + Send)) -> Fault {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    let fault = Fault::with_message(text);
    let mut kept = kept();
    let known = kept.iter().rposition(|one| one.message == fault.message);
    known.and_then(|place| kept.remove(place)).unwrap_or(fault)
}

/// Returns the newest panic that nobody has caught yet.
pub fn newest() -> Option<Fault> {
    kept().back().cloned()
}

/// Records that the report on a panic was written that nobody has caught yet, so that whoever catches it need not write
/// another.
pub fn reported(fault: &Fault, report: PathBuf) {
    if let Some(one) = kept().iter_mut().rev().find(|one| one.is_same(fault)) {
        one.report = Some(report);
    }
}

/// Returns the panics that nobody has caught, newest first: those of threads that nobody waits for, and earlier ones.
fn uncaught() -> Vec<Fault> {
    kept().iter().rev().cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;
    use std::panic::catch_unwind;

    #[test]
    fn a_panic_in_a_pool_is_known_with_its_place_to_who_waits_for_the_pool() {
        watch(true);
        let panic = catch_unwind(|| {
            (0..64_u32).into_par_iter().for_each(|number| assert!(number != 41, "the pool's {number} is at fault"));
        });
        let line = line!() - 2;
        let fault = caught(&*panic.unwrap_err());
        assert_eq!(fault.message, "the pool's 41 is at fault");
        assert!(fault.place.starts_with(&format!("{}:{line}:", file!())), "{}", fault.place);
        assert!(fault.backtrace.contains("study::fault"), "{}", fault.backtrace);
        assert!(!fault.at.is_empty() && !fault.thread.is_empty());
        assert!(!uncaught().iter().any(|one| one.is_same(&fault)), "it is forgotten");
    }

    #[test]
    fn a_panic_without_text_or_watch_is_still_a_fault() {
        let panic = catch_unwind(|| std::panic::resume_unwind(Box::new(3_u8))).unwrap_err();
        assert_eq!(caught(&*panic), Fault::with_message(None));
        let panic = catch_unwind(|| std::panic::resume_unwind(Box::new("from far away"))).unwrap_err();
        let fault = caught(&*panic);
        assert_eq!((fault.to_string().as_str(), fault.place.as_str()), ("from far away", ""));
    }

    #[test]
    fn only_so_many_are_kept_and_a_report_is_known_to_who_catches_it() {
        watch(true);
        let last = |number: usize| format!("kept {number}");
        let mut panics: Vec<_> =
            (0..MOST_KEPT + 5).map(|number| catch_unwind(|| panic!("kept {number}")).unwrap_err()).collect();
        assert!(uncaught().len() <= MOST_KEPT);
        let newest = uncaught().into_iter().find(|one| one.message == last(MOST_KEPT + 4)).unwrap();
        reported(&newest, "a.txt".into());
        let fault = caught(&*panics.pop().unwrap());
        assert_eq!(fault.report, Some("a.txt".into()));
    }
}
