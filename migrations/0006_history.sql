-- What happened to products, by key: a product that is stored anew under its key keeps its history.
CREATE TABLE history (
  id          INTEGER PRIMARY KEY,
  product_key TEXT NOT NULL,
  at          TEXT NOT NULL, -- UTC, e.g. 2026-03-21T12:00:00Z
  what        TEXT NOT NULL CHECK (length(what) > 0)
) STRICT;
CREATE INDEX history_product ON history (product_key);

-- Files that a product was read from, as paths on the computer that read them, for reading them again.
CREATE TABLE source (
  product_key TEXT NOT NULL,
  position    INTEGER NOT NULL,
  path        TEXT NOT NULL,
  PRIMARY KEY (product_key, position)
) STRICT, WITHOUT ROWID;

-- Hash of a state's functions without the words about them; empty where it is not known. The same data are found by it.
ALTER TABLE state ADD COLUMN content TEXT NOT NULL DEFAULT '';
CREATE INDEX state_content ON state (content);

-- Folders of packages whose products are listed among the others.
CREATE TABLE subscription (
  folder TEXT PRIMARY KEY
) STRICT, WITHOUT ROWID;

-- Products that come from such folders: the package's file name in the folder, and the hash of its bytes.
CREATE TABLE subscribed (
  product_key TEXT PRIMARY KEY,
  folder      TEXT NOT NULL,
  package     TEXT NOT NULL,
  hash        TEXT NOT NULL
) STRICT, WITHOUT ROWID;
