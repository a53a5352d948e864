-- Products that the user took out of sight, until they are restored or removed for good. By key, as favourites: a built-in
-- product stays out of sight when it is renewed.
CREATE TABLE deleted (
  product_key TEXT PRIMARY KEY,
  at          TEXT NOT NULL -- UTC, e.g. 2026-03-21T12:00:00Z
) STRICT, WITHOUT ROWID;
