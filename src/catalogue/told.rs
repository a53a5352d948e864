//! Messages for SQLite's errors, in one sentence for the user of the catalogue.

use rusqlite::{Error, ErrorCode, ffi};

/// Returns a message without SQL: what is wrong, and what to do about it.
pub(super) fn told(error: &Error) -> String {
    let said = said(error);
    match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull) => "the disk is full; nothing was changed; make room and try again".to_owned(),
        Some(ErrorCode::ReadOnly) => {
            "nothing can be written where it lies, a read-only place or a full disk; it can be read, not changed"
                .to_owned()
        }
        Some(ErrorCode::DatabaseCorrupt) => damaged(&said),
        Some(ErrorCode::NotADatabase) => format!("it is not a catalogue, or its beginning is damaged ({said})"),
        Some(ErrorCode::CannotOpen | ErrorCode::PermissionDenied) => {
            format!("it cannot be opened ({said}); check path and rights")
        }
        Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => {
            "another program has been writing to it for too long; try again".to_owned()
        }
        Some(ErrorCode::SystemIoFailure) => format!("the disk fails ({said}); nothing was changed"),
        _ => match error {
            Error::FromSqlConversionFailure(..) | Error::InvalidColumnType(..) | Error::IntegralValueOutOfRange(..) => {
                damaged(&said)
            }
            // A table or column that ought to be there, or ought not.
            Error::SqlInputError { .. } => misplaced(&said),
            Error::SqliteFailure(failure, _) if failure.extended_code == ffi::SQLITE_ERROR => misplaced(&said),
            _ => said,
        },
    }
}

/// Remedy named in messages about damage.
pub(super) const REMEDY: &str = "`cfs catalogue check --repair` repairs what can be repaired, and reports the rest";

fn misplaced(said: &str) -> String {
    format!("it is not laid out as a catalogue is ({said}); {REMEDY}")
}

fn damaged(said: &str) -> String {
    format!("it is damaged ({said}); {REMEDY}")
}

/// Returns SQLite's own message, without the statement.
pub(super) fn said(error: &Error) -> String {
    match error {
        Error::SqlInputError { msg, .. } => msg.clone(),
        Error::SqliteFailure(_, Some(message)) => message.clone(),
        other => other.to_string(),
    }
}

/// Whether the error comes from the place of the file, so that reading may still be possible.
pub(super) fn of_place(error: &Error) -> bool {
    matches!(
        error.sqlite_error_code(),
        Some(ErrorCode::ReadOnly | ErrorCode::DiskFull | ErrorCode::CannotOpen | ErrorCode::SystemIoFailure)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use rusqlite::Connection;

    #[test]
    fn no_sentence_has_sql_in_it() {
        let db = Connection::open_in_memory().unwrap();
        let error = db.execute("SELECT x FROM nowhere", []).unwrap_err();
        let said = told(&error);
        assert!(said.contains("no such table") && !said.contains("SELECT") && said.contains(REMEDY), "{said}");
        for (code, words) in [
            (ffi::SQLITE_FULL, "the disk is full"),
            (ffi::SQLITE_READONLY, "nothing can be written"),
            (ffi::SQLITE_CORRUPT, "it is damaged"),
            (ffi::SQLITE_BUSY, "another program"),
        ] {
            let error = Error::SqliteFailure(ffi::Error::new(code), Some("as SQLite says".to_owned()));
            assert!(told(&error).contains(words), "{}", told(&error));
            assert_eq!(of_place(&error), code == ffi::SQLITE_FULL || code == ffi::SQLITE_READONLY);
        }
    }
}
