//! Saving of a window's session on disk: within a second of every change, on a separate thread.
//!
//! Every window has a separate file in the sessions folder, and a lock on a file beside it while it is open; the
//! operating system releases the lock however the program ends. A session without a lock belongs to a window that was
//! not closed regularly; the next window that starts restores it. A window that is closed saves its session as
//! `last.json`.

use super::error::SessionError;
use super::snapshot::{Content, Kept, KeptFault, Snapshot};
use crate::app::shell::clock;
use crate::app::shell::disk::{ends_in, read_bytes};
use crate::study::files::write_at_once;
use std::fs::{File, OpenOptions};
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime};

/// File name of the session of the window that was closed last.
const LAST: &str = "last.json";
/// Prefix of the file name of a session that was closed after a lost one and waits until that one is closed.
const CLOSED: &str = "session-closed-";
/// Minimum time between two writes; longer than a fast disk needs and far below a second.
const PAUSE: Duration = Duration::from_millis(200);

/// Maximum time to wait for a session to be written. A disk that does not respond must not block the window.
const WRITE_TIMEOUT: Duration = Duration::from_secs(5);
/// Time after the start within which an internal error is attributed to the restored session.
const SOON: Duration = Duration::from_secs(60);
/// Number of successive internal errors soon after the start after which a session is no longer restored, so that the
/// program can start.
const MOST_FAULTS: u32 = 2;

/// Age after which files left by killed programs are removed.
const OLD: Duration = Duration::from_secs(3600);

/// Sessions that were found on disk when the window started.
#[derive(Debug, Default)]
pub struct Found {
    /// Session to restore, if there is one.
    pub kept: Option<Kept>,
    /// Whether the session belongs to a window that was not closed regularly.
    pub lost: bool,
    /// Errors of the sessions that could not be read.
    pub problems: Vec<SessionError>,
}

enum Order {
    Write(Box<Snapshot>),
    /// Request for a reply as soon as all earlier sessions are written.
    Notify(Sender<()>),
    /// Session to write when an internal error ends the program.
    Fault(Box<Snapshot>, KeptFault),
    Close,
}

/// Writer that saves the session of one window on disk.
pub struct Autosave {
    folder: PathBuf,
    file: PathBuf,
    lock_file: PathBuf,
    /// Lock of the session, held while the window is open.
    lock: Option<File>,
    orders: Sender<Order>,
    problems: Receiver<SessionError>,
    writer: Option<JoinHandle<()>>,
    last: Option<Snapshot>,
    begun: Instant,
    /// Number of successive times that an internal error ended the program soon after it had restored this session.
    faults: u32,
}

fn lock(path: &Path) -> std::io::Result<Option<File>> {
    let file = OpenOptions::new().create(true).truncate(false).write(true).open(path)?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(std::fs::TryLockError::WouldBlock) => Ok(None),
        Err(std::fs::TryLockError::Error(error)) => Err(error),
    }
}

fn random() -> u64 {
    RandomState::new().build_hasher().finish()
}

fn is_closed(session: &Path) -> bool {
    session.file_name().is_some_and(|name| name.to_string_lossy().starts_with(CLOSED))
}

/// Returns the time of the last write to a file; `None` if there is no file.
fn changed(file: &Path) -> Option<SystemTime> {
    std::fs::metadata(file).and_then(|meta| meta.modified()).ok()
}

/// Returns the sessions in the folder, newest first.
fn sessions(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut list: Vec<(SystemTime, PathBuf)> = entries
        .flatten()
        .filter(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            name.starts_with("session-") && name.ends_with(".json")
        })
        .filter_map(|entry| Some((changed(&entry.path())?, entry.path())))
        .collect();
    list.sort();
    list.into_iter().rev().map(|(_, path)| path).collect()
}

impl Autosave {
    /// Begins to save a session in a folder, and finds the session to restore: with `take_up` the newest one of a
    /// window that was not closed regularly, otherwise that of the window that was closed last.
    ///
    /// # Errors
    /// Returns an error if the folder cannot be created or written to.
    pub fn begin(folder: &Path, take_up: bool) -> std::io::Result<(Self, Found)> {
        std::fs::create_dir_all(folder)?;
        tidy(folder);
        let mut found = Found::default();
        let mut own = None;
        if take_up {
            for file in sessions(folder) {
                let lock_file = file.with_extension("lock");
                // Whose window lives is left alone; another window may also have closed it since the look.
                let Some(held) = lock(&lock_file)?.filter(|_| file.exists()) else { continue };
                match read(&file) {
                    Ok(Kept { fault: Some(fault), .. }) if fault.times >= MOST_FAULTS => {
                        let aside = file.with_extension("aside");
                        drop(std::fs::rename(&file, &aside));
                        remove(&lock_file);
                        found.problems.push(SessionError::SetAside(aside, fault.report));
                    }
                    Ok(kept) => {
                        found.kept = Some(kept);
                        found.lost = !is_closed(&file);
                        own = Some((file, lock_file, held));
                        break;
                    }
                    Err(problem) => {
                        // Kept under another name for whoever can read it.
                        found.problems.push(problem);
                        drop(std::fs::rename(&file, file.with_extension("unreadable")));
                        remove(&lock_file);
                    }
                }
            }
        }
        let (file, lock_file, held) = match own {
            Some(own) => own,
            None => Self::new_place(folder)?,
        };
        let last = folder.join(LAST);
        if found.lost && changed(&last) > changed(&file) {
            // Another window was closed since. This one will leave its own session there; the next start restores that
            // one.
            std::fs::rename(&last, folder.join(format!("{CLOSED}{:016x}.json", random())))?;
        }
        if found.kept.is_none() && last.exists() {
            match read(&last) {
                Ok(kept) => found.kept = Some(kept),
                Err(problem) => found.problems.push(problem),
            }
        }
        let (orders, received) = channel();
        let (errors, problems) = channel();
        let target = file.clone();
        let writer = std::thread::Builder::new()
            .name("cfs session".to_owned())
            .spawn(move || write_all(&target, &received, &errors))?;
        let faults = found.kept.as_ref().and_then(|kept| kept.fault.as_ref()).map_or(0, |fault| fault.times);
        let keeper = Self {
            folder: folder.to_owned(),
            file,
            lock_file,
            lock: Some(held),
            orders,
            problems,
            writer: Some(writer),
            last: None,
            begun: Instant::now(),
            faults,
        };
        Ok((keeper, found))
    }

    fn new_place(folder: &Path) -> std::io::Result<(PathBuf, PathBuf, File)> {
        loop {
            let name = format!("session-{:016x}", random());
            let (file, lock_file) = (folder.join(format!("{name}.json")), folder.join(format!("{name}.lock")));
            if let Some(held) = lock(&lock_file)? {
                return Ok((file, lock_file, held));
            }
        }
    }

    /// Queues the state of the window for writing, if it has changed, without waiting.
    pub fn keep(&mut self, content: Content<'_>) {
        if self.last.as_ref().is_some_and(|last| last.is_of(content)) {
            return;
        }
        let snapshot = Snapshot::of(content);
        self.last = Some(snapshot.clone());
        // The writer ends only after the keeper has.
        drop(self.orders.send(Order::Write(Box::new(snapshot))));
    }

    /// Waits until the state queued last is written, or cannot be written.
    pub fn write_now(&self) {
        let (reply, written) = channel();
        if self.orders.send(Order::Notify(reply)).is_ok() {
            // After the timeout it is written later, or reported as an error.
            let _ = written.recv_timeout(WRITE_TIMEOUT);
        }
    }

    /// Writes the session, with the path of the report, when an internal error ends the program; the next start
    /// restores the state queued last.
    pub fn end_at_fault(self, report: Option<PathBuf>) {
        let times = if self.begun.elapsed() < SOON { self.faults + 1 } else { 1 };
        if let Some(last) = &self.last {
            drop(self.orders.send(Order::Fault(Box::new(last.clone()), KeptFault { times, report })));
            self.write_now();
        }
    }

    /// Returns the next write error that was not reported yet.
    pub fn problem(&self) -> Option<SessionError> {
        self.problems.try_recv().ok()
    }

    /// Saves the session regularly when the window is closed, so that the next window starts from it.
    pub fn close(&mut self) {
        drop(self.orders.send(Order::Close));
        if let Some(writer) = self.writer.take() {
            drop(writer.join());
        }
        if self.lock.is_some() && self.file.exists() && std::fs::rename(&self.file, self.folder.join(LAST)).is_err() {
            // It will be taken for lost, and so is not.
            return;
        }
        self.lock = None;
        remove(&self.lock_file);
    }
}

/// Removes old files that killed programs left in the sessions folder: partly written files, and locks of windows that
/// ended before they wrote a session. Recent ones may be in use by another window.
fn tidy(folder: &Path) {
    let old = |path: &Path| changed(path).and_then(|at| at.elapsed().ok()).is_some_and(|age| age > OLD);
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()).filter(|path| old(path)) {
        let lone_lock = ends_in(&path, "lock") && !path.with_extension("json").exists();
        if ends_in(&path, "part") || (lone_lock && lock(&path).is_ok_and(|held| held.is_some())) {
            remove(&path);
        }
    }
}

fn read(file: &Path) -> Result<Kept, SessionError> {
    let bytes = read_bytes(file).map_err(SessionError::File)?;
    Kept::read(&bytes).map_err(|problem| SessionError::Unreadable(file.to_owned(), Box::new(problem)))
}

/// Removes a file that is no longer needed; ignores one that is already gone.
fn remove(file: &Path) {
    drop(std::fs::remove_file(file));
}

/// Writes the queued sessions until the order to close; of several queued ones only the last. A written session
/// survives the end of the program at once; a second thread waits until it is safe on the disk, which may take seconds.
fn write_all(file: &Path, orders: &Receiver<Order>, errors: &Sender<SessionError>) {
    let (written, waiting) = channel::<File>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            while let Ok(file) = waiting.recv() {
                // Of several the last: the others are no longer there under any name.
                if let Err(error) = waiting.try_iter().last().unwrap_or(file).sync_all() {
                    drop(errors.send(SessionError::NotSafe(error.to_string())));
                }
            }
        });
        write_until_closed(file, orders, errors, written);
    });
}

fn write_until_closed(file: &Path, orders: &Receiver<Order>, errors: &Sender<SessionError>, written: Sender<File>) {
    let mut failing = false;
    let mut closing = false;
    while !closing {
        let Ok(mut order) = orders.recv() else { return };
        let mut newest = None;
        let mut waiting = Vec::new();
        loop {
            match order {
                Order::Write(snapshot) => newest = Some((snapshot, None)),
                Order::Fault(snapshot, fault) => newest = Some((snapshot, Some(fault))),
                Order::Notify(reply) => waiting.push(reply),
                Order::Close => closing = true,
            }
            match orders.try_recv() {
                Ok(next) => order = next,
                Err(_) => break,
            }
        }
        if let Some((snapshot, fault)) = newest {
            let done = serde_json::to_vec_pretty(&Kept { fault, ..snapshot.kept(clock::stamp()) })
                .map_err(|error| error.to_string())
                .and_then(|bytes| write_at_once(file, &bytes).map_err(|error| error.to_string()));
            match done {
                Ok(file) => {
                    drop(written.send(file));
                    failing = false;
                }
                // Reported once; the receiver may be gone.
                Err(error) if !failing => {
                    drop(errors.send(SessionError::NotKept(error)));
                    failing = true;
                }
                Err(_) => {}
            }
        }
        for reply in waiting {
            // Who asked may have lost patience.
            let _ = reply.send(());
        }
        if !closing {
            std::thread::sleep(PAUSE);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::snapshot::ContentMut;
    use super::*;
    use crate::app::goniophotometer::Goniophotometer;
    use crate::app::import::Imports;
    use crate::app::state::{Settings, State};

    fn keep(keeper: &mut Autosave, azimuth: f64) {
        let mut state = State::new(Settings::default());
        state.document.scene.site.azimuth = azimuth;
        let (imports, goniophotometer) = Default::default();
        keeper.keep(Content { state: &state, imports: &imports, goniophotometer: &goniophotometer });
    }

    fn azimuth(kept: &Kept) -> f64 {
        let mut state = State::new(Settings::default());
        let (mut imports, mut goniophotometer) = <(Imports, Goniophotometer)>::default();
        let put = ContentMut { state: &mut state, imports: &mut imports, goniophotometer: &mut goniophotometer };
        kept.put_into(put).unwrap();
        state.document.scene.site.azimuth
    }

    /// Acts like a killed program: releases the lock and leaves the files.
    fn kill(mut keeper: Autosave) {
        keeper.lock = None;
        drop(keeper);
    }

    fn wait_for(keeper: &Autosave, wanted: f64) -> Duration {
        let start = Instant::now();
        while read(&keeper.file).ok().is_none_or(|kept| azimuth(&kept) != wanted) {
            assert!(start.elapsed() < Duration::from_secs(20));
            std::thread::sleep(Duration::from_millis(5));
        }
        start.elapsed()
    }

    #[test]
    fn a_session_that_did_not_close_is_taken_up_once_and_one_that_did_is_where_the_next_starts() {
        let folder = tempfile::tempdir().unwrap();
        let (mut first, found) = Autosave::begin(folder.path(), true).unwrap();
        assert!(found.kept.is_none() && found.problems.is_empty());
        for azimuth in 1..=50 {
            keep(&mut first, f64::from(azimuth));
        }
        wait_for(&first, 50.0);
        kill(first);
        let (mut second, found) = Autosave::begin(folder.path(), true).unwrap();
        assert!(found.lost);
        assert_eq!(azimuth(&found.kept.unwrap()), 50.0);
        keep(&mut second, 70.0);
        second.close();
        let (_third, found) = Autosave::begin(folder.path(), true).unwrap();
        assert!(!found.lost, "it was closed");
        assert_eq!(azimuth(&found.kept.unwrap()), 70.0);
    }

    #[test]
    fn an_older_lost_session_takes_no_newer_one_away() {
        let folder = tempfile::tempdir().unwrap();
        let (mut lost, _) = Autosave::begin(folder.path(), true).unwrap();
        keep(&mut lost, 10.0);
        wait_for(&lost, 10.0);
        kill(lost);
        std::thread::sleep(Duration::from_millis(20));
        let (mut newer, _) = Autosave::begin(folder.path(), false).unwrap();
        keep(&mut newer, 20.0);
        newer.close();
        let mut seen = Vec::new();
        for _ in 0..3 {
            let (mut next, found) = Autosave::begin(folder.path(), true).unwrap();
            let found = azimuth(&found.kept.unwrap());
            seen.push(found);
            keep(&mut next, found);
            next.close();
        }
        assert_eq!(seen, [10.0, 20.0, 20.0]);
    }

    #[test]
    fn windows_at_once_keep_sessions_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let (mut first, _) = Autosave::begin(folder.path(), true).unwrap();
        keep(&mut first, 10.0);
        wait_for(&first, 10.0);
        let (mut second, found) = Autosave::begin(folder.path(), true).unwrap();
        assert!(found.kept.is_none(), "the first one lives");
        keep(&mut second, 20.0);
        wait_for(&second, 20.0);
        kill(first);
        kill(second);
        let (one, found_one) = Autosave::begin(folder.path(), true).unwrap();
        let (two, found_two) = Autosave::begin(folder.path(), true).unwrap();
        let mut found: Vec<f64> = [found_one, found_two].iter().map(|f| azimuth(f.kept.as_ref().unwrap())).collect();
        found.sort_by(f64::total_cmp);
        assert_eq!(found, [10.0, 20.0]);
        drop((one, two));
    }

    #[test]
    fn what_is_to_be_written_now_is_on_disk_when_the_call_returns() {
        let folder = tempfile::tempdir().unwrap();
        let (mut keeper, _) = Autosave::begin(folder.path(), true).unwrap();
        for wanted in [30.0, 40.0, 50.0] {
            keep(&mut keeper, wanted);
            keeper.write_now();
            assert_eq!(azimuth(&read(&keeper.file).unwrap()), wanted);
        }
    }

    #[test]
    fn a_fault_is_taken_up_with_its_report_and_one_that_comes_at_once_again_is_set_aside() {
        let folder = tempfile::tempdir().unwrap();
        let report = Some(PathBuf::from("a.txt"));
        let (mut first, _) = Autosave::begin(folder.path(), true).unwrap();
        keep(&mut first, 10.0);
        first.end_at_fault(report.clone());
        let (mut second, found) = Autosave::begin(folder.path(), true).unwrap();
        let kept = found.kept.unwrap();
        assert!(found.lost && azimuth(&kept) == 10.0);
        assert_eq!(kept.fault, Some(KeptFault { times: 1, report: report.clone() }));
        keep(&mut second, 10.0);
        second.end_at_fault(report.clone());
        let (mut third, found) = Autosave::begin(folder.path(), true).unwrap();
        assert!(found.kept.is_none(), "the program must start");
        let [SessionError::SetAside(aside, told)] = &*found.problems else { panic!("{:?}", found.problems) };
        assert!(azimuth(&read(aside).unwrap()) == 10.0 && *told == report);
        // Long after the start it is another matter.
        keep(&mut third, 20.0);
        (third.faults, third.begun) = (1, Instant::now() - 2 * SOON);
        third.end_at_fault(None);
        let (_fourth, found) = Autosave::begin(folder.path(), true).unwrap();
        assert_eq!(found.kept.unwrap().fault, Some(KeptFault { times: 1, report: None }));
    }

    #[test]
    fn a_damaged_session_is_told_and_set_aside() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("session-0.json"), "{\"version\": 1, \"sc").unwrap();
        let (_keeper, found) = Autosave::begin(folder.path(), true).unwrap();
        assert!(found.kept.is_none() && found.problems.len() == 1, "{:?}", found.problems);
        assert!(found.problems[0].to_string().contains("session-0.json"));
        let (_keeper, found) = Autosave::begin(folder.path(), true).unwrap();
        assert!(found.problems.is_empty(), "told once");
    }
}
