//! Messages for SQLite's errors, in one sentence for the user of the catalogue.

use rusqlite::{Error, ErrorCode, ffi};

/// Returns a message for an SQLite error, without SQL: what is wrong, and what to do about it.
pub(super) fn user_message(error: &Error) -> String {
    let message = sqlite_message(error);
    match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull) => "the disk is full; nothing was changed; make room and try again".to_owned(),
        Some(ErrorCode::ReadOnly) => {
            "nothing can be written where it lies, a read-only place or a full disk; it can be read, not changed"
                .to_owned()
        }
        Some(ErrorCode::DatabaseCorrupt) => damaged(&message),
        Some(ErrorCode::NotADatabase) => format!("it is not a catalogue, or its beginning is damaged ({message})"),
        Some(ErrorCode::CannotOpen | ErrorCode::PermissionDenied) => {
            format!("it cannot be opened ({message}); check path and rights")
        }
        Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => {
            "another program has been writing to it for too long; try again".to_owned()
        }
        Some(ErrorCode::SystemIoFailure) => format!("the disk fails ({message}); nothing was changed"),
        _ => match error {
            Error::FromSqlConversionFailure(..) | Error::InvalidColumnType(..) | Error::IntegralValueOutOfRange(..) => {
                damaged(&message)
            }
            // A table or column that ought to be there, or ought not.
            Error::SqlInputError { .. } => misplaced(&message),
            Error::SqliteFailure(failure, _) if failure.extended_code == ffi::SQLITE_ERROR => misplaced(&message),
            _ => message,
        },
    }
}

/// Remedy named in messages about damage.
pub(super) const REMEDY: &str = "`cfs catalogue check --repair` repairs what can be repaired, and reports the rest";

fn misplaced(message: &str) -> String {
    format!("it is not laid out as a catalogue is ({message}); {REMEDY}")
}

fn damaged(message: &str) -> String {
    format!("it is damaged ({message}); {REMEDY}")
}

/// Returns SQLite's own message, without the text of the SQL statement.
pub(super) fn sqlite_message(error: &Error) -> String {
    match error {
        Error::SqlInputError { msg, .. } => msg.clone(),
        Error::SqliteFailure(_, Some(message)) => message.clone(),
        other => other.to_string(),
    }
}

/// Whether the error is caused by the file's location, such as a read-only folder, so that reading may still be
/// possible.
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
        let said = user_message(&error);
        assert!(said.contains("no such table") && !said.contains("SELECT") && said.contains(REMEDY), "{said}");
        for (code, words) in [
            (ffi::SQLITE_FULL, "the disk is full"),
            (ffi::SQLITE_READONLY, "nothing can be written"),
            (ffi::SQLITE_CORRUPT, "it is damaged"),
            (ffi::SQLITE_BUSY, "another program"),
        ] {
            let error = Error::SqliteFailure(ffi::Error::new(code), Some("as SQLite says".to_owned()));
            assert!(user_message(&error).contains(words), "{}", user_message(&error));
            assert_eq!(of_place(&error), code == ffi::SQLITE_FULL || code == ffi::SQLITE_READONLY);
        }
    }
}
