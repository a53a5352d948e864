//! Opening of a catalogue file: settings of the connection, numbered migrations, built-in products.

use super::connection::Catalogue;
use super::sealing::seal_what_is_left;
use super::{CatalogueError, builtin};
use rusqlite::{Connection, OpenFlags, TransactionBehavior};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Migrations from an empty file to the current layout; `PRAGMA user_version` counts those that were applied.
const MIGRATIONS: &[&str] = &[
    include_str!("../../migrations/0001_products.sql"),
    include_str!("../../migrations/0002_system.sql"),
    include_str!("../../migrations/0003_deleted.sql"),
    include_str!("../../migrations/0004_figures.sql"),
    include_str!("../../migrations/0005_no_text_index.sql"),
    include_str!("../../migrations/0006_history.sql"),
    include_str!("../../migrations/0007_collections.sql"),
    include_str!("../../migrations/0008_seal.sql"),
    include_str!("../../migrations/0009_shown_seal.sql"),
];

/// Flags for opening a file that may be changed or created.
const WRITING: OpenFlags =
    OpenFlags::SQLITE_OPEN_READ_WRITE.union(OpenFlags::SQLITE_OPEN_CREATE).union(OpenFlags::SQLITE_OPEN_NO_MUTEX);
/// Flags for opening a file that is only read.
pub(super) const READING: OpenFlags = OpenFlags::SQLITE_OPEN_READ_ONLY.union(OpenFlags::SQLITE_OPEN_NO_MUTEX);

/// `PRAGMA application_id` of a catalogue: "CFSX". Set by the first migration.
pub(super) const APPLICATION: i64 = 0x4346_5358;

/// Maximum time that a connection waits for another one to finish writing.
const TIMEOUT: Duration = Duration::from_secs(10);

/// Returns the error with the name of the file added.
fn located(error: CatalogueError, path: &Path) -> CatalogueError {
    let shown = || path.display().to_string();
    match error {
        CatalogueError::Sql(cause) => CatalogueError::Open { path: path.to_owned(), cause },
        CatalogueError::Newer { found, known, .. } => CatalogueError::Newer { path: shown(), found, known },
        CatalogueError::Older { found, known, .. } => CatalogueError::Older { path: shown(), found, known },
        CatalogueError::Layout { found, known, .. } => CatalogueError::Layout { path: shown(), found, known },
        CatalogueError::NotACatalogue(_) => CatalogueError::NotACatalogue(shown()),
        other => other,
    }
}

/// Returns the URI of a file that makes SQLite assume that nobody changes the file, so that it needs no lock.
fn unchanging(path: &Path) -> String {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut name = String::from("file:");
    let slashed = path.to_string_lossy().replace('\\', "/");
    // On Windows a name begins with its drive.
    if !slashed.starts_with('/') {
        name.push_str("///");
    }
    for byte in slashed.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-._~:".contains(&byte) {
            name.push(char::from(byte));
        } else {
            name.push_str(&format!("%{byte:02X}"));
        }
    }
    name + "?immutable=1"
}

/// Returns the path of the user's catalogue: that in the environment variable `CFS_CATALOGUE`, else `catalogue.sqlite`
/// in the user's folder for application data.
pub fn default_path() -> Result<PathBuf, CatalogueError> {
    if let Some(path) = std::env::var_os("CFS_CATALOGUE").filter(|path| !path.is_empty()) {
        return Ok(path.into());
    }
    let folders = directories::ProjectDirs::from("", "", "cfs").ok_or(CatalogueError::NoHome)?;
    Ok(folders.data_dir().join("catalogue.sqlite"))
}

impl Catalogue {
    /// Opens a catalogue file. Creates it when missing, and updates its layout and its built-in products to the version
    /// of this program. Nothing is computed: the figures of built-in products come with the program, and their data are
    /// computed at their first use.
    ///
    /// Where nothing can be written – in a read-only folder, on a full disk – the file is opened for reading.
    pub fn open(path: &Path) -> Result<Self, CatalogueError> {
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            std::fs::create_dir_all(folder)
                .map_err(|cause| CatalogueError::Folder { path: folder.to_owned(), cause })?;
        }
        let opened = Connection::open_with_flags(path, WRITING).map_err(CatalogueError::from).and_then(Self::prepare);
        match opened {
            Err(error) if error.of_place() && path.is_file() => match Self::open_for_reading(path) {
                // Why nothing can be written says more than why nothing can be read.
                Err(CatalogueError::Sql(_) | CatalogueError::Older { found: 0, .. }) => Err(located(error, path)),
                other => other.map_err(|error| located(error, path)),
            },
            other => other.map_err(|error| located(error, path)),
        }
    }

    /// Opens an existing file for reading and writes nothing, not even beside it.
    pub(super) fn open_for_reading(path: &Path) -> Result<Self, CatalogueError> {
        let mut wal = path.as_os_str().to_owned();
        wal.push("-wal");
        let waiting = std::fs::metadata(wal).is_ok_and(|meta| meta.len() > 0);
        let open = |name: &Path, more: OpenFlags| {
            let db = Connection::open_with_flags(name, READING | more)?;
            db.busy_timeout(TIMEOUT)?;
            let catalogue = Self::of(db);
            let found = catalogue.judge()?;
            let known = MIGRATIONS.len() as i64;
            if found < known {
                return Err(CatalogueError::Older { path: String::new(), found, known });
            }
            Ok(catalogue)
        };
        match open(path, OpenFlags::empty()) {
            // Write-ahead logging wants to write beside the file. Without waiting changes there is nothing to log.
            Err(CatalogueError::Sql(_)) if !waiting => open(Path::new(&unchanging(path)), OpenFlags::SQLITE_OPEN_URI),
            Err(CatalogueError::Sql(_)) => Err(CatalogueError::Waiting { path: path.to_owned() }),
            other => other,
        }
    }

    /// Opens the user's own catalogue, see [`default_path`].
    pub fn open_default() -> Result<Self, CatalogueError> {
        Self::open(&default_path()?)
    }

    /// Creates a catalogue in memory, with the built-in products.
    pub fn in_memory() -> Result<Self, CatalogueError> {
        Self::prepare(Connection::open_in_memory()?)
    }

    /// Creates a catalogue in memory, without any product.
    pub fn empty_in_memory() -> Result<Self, CatalogueError> {
        Self::laid_out(Connection::open_in_memory()?)
    }

    fn prepare(db: Connection) -> Result<Self, CatalogueError> {
        let mut catalogue = Self::laid_out(db)?;
        builtin::renew(&mut catalogue)?;
        Ok(catalogue)
    }

    /// Brings the layout of an open database up to date, or creates it in an empty one.
    fn laid_out(db: Connection) -> Result<Self, CatalogueError> {
        db.busy_timeout(TIMEOUT)?;
        db.pragma_update(None, "foreign_keys", true)?;
        let mut catalogue = Self::of(db);
        // Judged before anything is written: a foreign file stays as it is.
        let found = catalogue.judge()?;
        let known = known_layout();
        // A migration that is applied twice would delete what later ones added.
        if (1..known).contains(&found) && layout_of(&catalogue.db)? != Some(found) && catalogue.judge()? == found {
            return Err(CatalogueError::Layout { path: String::new(), found, known });
        }
        catalogue.write_ahead()?;
        catalogue.migrate(MIGRATIONS)?;
        Ok(catalogue)
    }

    /// Turns on write-ahead logging, so that readers and a writer do not wait for each other. Repeats it while SQLite
    /// answers "busy", which happens when two connections change the mode of a new file at once.
    fn write_ahead(&self) -> Result<(), CatalogueError> {
        let mut tries = 0;
        loop {
            match self.db.pragma_update_and_check(None, "journal_mode", "wal", |row| row.get::<_, String>(0)) {
                Ok(_) => break,
                Err(error) if tries < 100 && error.sqlite_error_code() == Some(rusqlite::ErrorCode::DatabaseBusy) => {
                    tries += 1;
                    std::thread::sleep(Duration::from_millis(20));
                }
                Err(error) => return Err(error.into()),
            }
        }
        // In write-ahead mode a crash of the program loses nothing; a power cut at most the last changes.
        Ok(self.db.pragma_update(None, "synchronous", "normal")?)
    }

    fn version(db: &Connection) -> Result<i64, CatalogueError> {
        Ok(db.pragma_query_value(None, "user_version", |row| row.get(0))?)
    }

    /// Returns the number of the file's layout. Returns an error for files of other programs, files of newer versions,
    /// and unknown layouts.
    fn judge(&self) -> Result<i64, CatalogueError> {
        // One look at all three: another program may be making the file at this moment.
        let look = self.db.unchecked_transaction()?;
        let found = Self::version(&look)?;
        let application: i64 = look.pragma_query_value(None, "application_id", |row| row.get(0))?;
        let tables: i64 = look.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
        look.finish()?;
        if tables > 0 && application != APPLICATION {
            return Err(CatalogueError::NotACatalogue(String::new()));
        }
        let known = MIGRATIONS.len() as i64;
        if found > known {
            return Err(CatalogueError::Newer { path: String::new(), found, known });
        }
        // A new file has the layout 0, and nothing in it.
        if tables == 0 && found != 0 {
            return Err(CatalogueError::NotACatalogue(String::new()));
        }
        if found < 0 || (found == 0 && tables > 0) {
            return Err(CatalogueError::Layout { path: String::new(), found, known });
        }
        Ok(found)
    }

    /// Applies the missing migrations of the file's layout, each in one transaction.
    fn migrate(&mut self, steps: &[&str]) -> Result<(), CatalogueError> {
        while Self::version(&self.db)? < steps.len() as i64 {
            let step = self.db.transaction_with_behavior(TransactionBehavior::Immediate)?;
            // Another connection may have taken it while this one waited.
            let done = Self::version(&step)?;
            let next = usize::try_from(done).ok();
            let Some(sql) = next.and_then(|done| steps.get(done)) else {
                // Taken, all of them; or a number that no step leads on from.
                if done < 0 {
                    let known = steps.len() as i64;
                    return Err(CatalogueError::Layout { path: String::new(), found: done, known });
                }
                break;
            };
            step.execute_batch(sql)?;
            // With the last step or not at all: a product without a seal is a damaged one.
            if done + 1 == known_layout() {
                seal_what_is_left(&step)?;
            }
            step.pragma_update(None, "user_version", done + 1)?;
            step.commit()?;
        }
        Ok(())
    }
}

/// Returns the number of the newest layout that this program knows.
pub(super) const fn known_layout() -> i64 {
    MIGRATIONS.len() as i64
}

/// Returns the names of the database's tables, each with its columns.
fn shape(db: &Connection) -> rusqlite::Result<Vec<(String, String)>> {
    let sql = "SELECT t.name, (SELECT group_concat(c.name) FROM pragma_table_info(t.name) c) FROM sqlite_schema t
               WHERE t.type = 'table' AND t.name NOT LIKE 'sqlite!_%' ESCAPE '!' ORDER BY t.name";
    db.prepare(sql)?
        .query_map([], |row| Ok((row.get(0)?, row.get::<_, Option<String>>(1)?.unwrap_or_default())))?
        .collect()
}

/// Returns the number of the file's layout according to its tables, whatever number it states; `None` for a layout that
/// this program does not know.
pub(super) fn layout_of(db: &Connection) -> Result<Option<i64>, CatalogueError> {
    let found = shape(db)?;
    let mut known = Catalogue::of(Connection::open_in_memory()?);
    for steps in 1..=MIGRATIONS.len() {
        known.migrate(&MIGRATIONS[..steps])?;
        if shape(&known.db)? == found {
            return Ok(Some(steps as i64));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bare() -> Catalogue {
        let db = Connection::open_in_memory().unwrap();
        db.pragma_update(None, "foreign_keys", true).unwrap();
        Catalogue::of(db)
    }

    fn schema(db: &Connection) -> Vec<(String, String)> {
        let sql = "SELECT name, coalesce(sql, '') FROM sqlite_schema ORDER BY name";
        let mut statement = db.prepare(sql).unwrap();
        statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?))).unwrap().map(Result::unwrap).collect()
    }

    #[test]
    fn a_migrated_file_has_the_layout_of_a_new_one() {
        let new = Catalogue::in_memory().unwrap();
        for from in 0..MIGRATIONS.len() {
            let mut old = bare();
            old.migrate(&MIGRATIONS[..from]).unwrap();
            old.migrate(MIGRATIONS).unwrap();
            assert_eq!(schema(&old.db), schema(&new.db), "from {from}");
        }
    }

    #[test]
    fn where_nothing_can_be_written_it_is_read_and_says_so_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a ü?#%.sqlite");
        drop(Catalogue::open(&path).unwrap());
        let named = |path: &Path| {
            let db = Connection::open_with_flags(unchanging(path), READING | OpenFlags::SQLITE_OPEN_URI)?;
            db.query_row("SELECT count(*) FROM product", [], |row| row.get::<_, i64>(0))
        };
        assert!(named(&path).unwrap() > 10, "the name is the file's");
        let mut catalogue = Catalogue::open_for_reading(&path).unwrap();
        assert!(catalogue.product("clear-single").is_ok() && !catalogue.waiting().unwrap().is_empty());
        // What is computed is there as long as the catalogue is open.
        let mut pane = catalogue.product("clear-single").unwrap();
        let mut dataset = crate::compute::btdf::Dataset::default();
        dataset.visible.transmission_front = Some(crate::compute::btdf::Btdf::ideal_diffuse(0.25));
        assert_eq!(catalogue.to_compute("clear-single", None).unwrap().as_deref(), Some(""));
        pane.description.clear();
        catalogue.keep_state(&pane, &dataset).unwrap();
        assert_eq!(catalogue.to_compute("clear-single", None).unwrap(), None);
        let held = catalogue.dataset("clear-single", None).unwrap();
        assert!((held.transmission().unwrap().tau_hemispherical() - 0.25).abs() < 1e-6 && held.described.is_some());
        let error = catalogue.set_favourite("clear-single", true).unwrap_err();
        assert!(error.of_place());
        let told = error.to_string();
        assert!(told.contains("nothing can be written") && told.matches("catalogue").count() == 1, "{told}");
        // An older layout cannot be brought to the present one there.
        catalogue = Catalogue::open(&path).unwrap();
        catalogue.db.execute_batch("ALTER TABLE product DROP COLUMN shown_seal; ALTER TABLE product DROP COLUMN seal; PRAGMA user_version = 7").unwrap();
        drop(catalogue);
        assert!(matches!(Catalogue::open_for_reading(&path), Err(CatalogueError::Older { found: 7, .. })));
        Catalogue::open(&path).unwrap();
    }

    #[test]
    fn a_number_that_is_no_layout_ends() {
        let mut catalogue = bare();
        catalogue.migrate(MIGRATIONS).unwrap();
        for number in [-1_i64, i64::from(i32::MIN), 0] {
            catalogue.db.pragma_update(None, "user_version", number).unwrap();
            let told = catalogue.judge().unwrap_err();
            assert!(matches!(told, CatalogueError::Layout { found, .. } if found == number), "{told}");
        }
        catalogue.db.pragma_update(None, "user_version", -1).unwrap();
        assert!(catalogue.migrate(MIGRATIONS).is_err());
        assert_eq!(layout_of(&catalogue.db).unwrap(), Some(MIGRATIONS.len() as i64));
    }

    #[test]
    fn a_failing_step_leaves_nothing_behind() {
        let mut catalogue = bare();
        catalogue.migrate(MIGRATIONS).unwrap();
        let before = schema(&catalogue.db);
        let mut steps = MIGRATIONS.to_vec();
        steps.push("CREATE TABLE half (x) STRICT; CREATE TABLE broken (");
        assert!(catalogue.migrate(&steps).is_err());
        assert_eq!(schema(&catalogue.db), before);
        assert_eq!(Catalogue::version(&catalogue.db).unwrap(), MIGRATIONS.len() as i64);
    }

    #[test]
    fn the_mark_of_a_catalogue_is_set() {
        let catalogue = Catalogue::in_memory().unwrap();
        let mark: i64 = catalogue.db.pragma_query_value(None, "application_id", |row| row.get(0)).unwrap();
        assert_eq!(mark, APPLICATION);
        let on: bool = catalogue.db.pragma_query_value(None, "foreign_keys", |row| row.get(0)).unwrap();
        assert!(on);
    }
}
