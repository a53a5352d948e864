-- The catalogue: products with states, datasets by content, and what users add to them.
PRAGMA application_id = 1128682328;

CREATE TABLE meta (
  key   TEXT PRIMARY KEY,
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE product (
  id           INTEGER PRIMARY KEY,
  key          TEXT NOT NULL UNIQUE CHECK (length(key) BETWEEN 1 AND 200),
  name         TEXT NOT NULL CHECK (length(name) > 0),
  manufacturer TEXT NOT NULL,
  kind         TEXT NOT NULL,
  description  TEXT NOT NULL,
  origin       TEXT NOT NULL CHECK (origin IN ('measured', 'computed', 'unknown')),
  author       TEXT NOT NULL,
  method       TEXT NOT NULL,
  date         TEXT NOT NULL,
  source_file  TEXT NOT NULL,
  source_hash  TEXT NOT NULL,
  inside_face  TEXT NOT NULL,
  builtin      INTEGER NOT NULL CHECK (builtin IN (0, 1)),
  rank         INTEGER NOT NULL
) STRICT;
CREATE INDEX product_kind ON product (kind);
CREATE INDEX product_manufacturer ON product (manufacturer);

-- Compact binary datasets, named by the BLAKE3 hash of their bytes; shared by all states that have the same content.
CREATE TABLE dataset (
  hash TEXT PRIMARY KEY CHECK (length(hash) = 64),
  blob BLOB NOT NULL
) STRICT;

CREATE TABLE state (
  product           INTEGER NOT NULL REFERENCES product (id) ON DELETE CASCADE,
  position          INTEGER NOT NULL,
  key               TEXT NOT NULL,
  label             TEXT NOT NULL,
  value             REAL,
  dataset           TEXT NOT NULL REFERENCES dataset (hash),
  tau_normal        REAL,
  tau_hemispherical REAL,
  tau_profile       TEXT NOT NULL, -- JSON: transmittance at fixed profile angles
  PRIMARY KEY (product, position),
  UNIQUE (product, key)
) STRICT, WITHOUT ROWID;
CREATE INDEX state_dataset ON state (dataset);

-- Findings of readers and checks, one row each, so that lists need not decode datasets.
CREATE TABLE finding (
  product  INTEGER NOT NULL,
  state    INTEGER NOT NULL,
  position INTEGER NOT NULL,
  severity TEXT NOT NULL CHECK (severity IN ('info', 'warning', 'error')),
  code     TEXT NOT NULL,
  message  TEXT NOT NULL,
  PRIMARY KEY (product, state, position),
  FOREIGN KEY (product, state) REFERENCES state (product, position) ON DELETE CASCADE
) STRICT, WITHOUT ROWID;

-- Solar profile angle to the number of the state, both in degrees where the state is a slat angle.
CREATE TABLE control_point (
  product       INTEGER NOT NULL REFERENCES product (id) ON DELETE CASCADE,
  position      INTEGER NOT NULL,
  profile_angle REAL NOT NULL,
  value         REAL NOT NULL,
  PRIMARY KEY (product, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE tag (
  product INTEGER NOT NULL REFERENCES product (id) ON DELETE CASCADE,
  tag     TEXT NOT NULL CHECK (length(tag) > 0),
  PRIMARY KEY (product, tag)
) STRICT, WITHOUT ROWID;
CREATE INDEX tag_tag ON tag (tag);

-- By key, not by row: a favourite survives the renewal of built-in products.
CREATE TABLE favourite (
  product_key TEXT PRIMARY KEY
) STRICT, WITHOUT ROWID;

CREATE VIRTUAL TABLE product_text USING fts5 (
  name, manufacturer, kind, description, tags,
  tokenize = 'unicode61 remove_diacritics 2',
  prefix = '2 3'
);
