-- States are known before their data are computed: the dataset may be missing while the figures are there. Figures of how
-- light leaves are NULL until they are known. A column cannot lose its NOT NULL in place, so both tables are made anew; the
-- one that refers to the other goes first, so that no row is taken out with its parent.
CREATE TABLE state_new (
  product           INTEGER NOT NULL REFERENCES product (id) ON DELETE CASCADE,
  position          INTEGER NOT NULL,
  key               TEXT NOT NULL,
  label             TEXT NOT NULL,
  value             REAL,
  dataset           TEXT REFERENCES dataset (hash), -- NULL: still to be computed from the product's description
  tau_normal        REAL,
  tau_hemispherical REAL,
  tau_profile       TEXT NOT NULL, -- JSON: transmittance at fixed profile angles
  to_ceiling        REAL, -- of the light transmitted from the sky above the horizontal, the share that leaves upwards
  sun_blocked       REAL, -- 1 - tau for the sun straight before the facade, 45 degrees high; NULL: figures not known yet
  view              REAL, -- direct-direct transmittance at normal incidence
  PRIMARY KEY (product, position),
  UNIQUE (product, key)
) STRICT, WITHOUT ROWID;
INSERT INTO state_new (product, position, key, label, value, dataset, tau_normal, tau_hemispherical, tau_profile)
  SELECT product, position, key, label, value, dataset, tau_normal, tau_hemispherical, tau_profile FROM state;

CREATE TABLE finding_new (
  product  INTEGER NOT NULL,
  state    INTEGER NOT NULL,
  position INTEGER NOT NULL,
  severity TEXT NOT NULL CHECK (severity IN ('info', 'warning', 'error')),
  code     TEXT NOT NULL,
  message  TEXT NOT NULL,
  PRIMARY KEY (product, state, position),
  FOREIGN KEY (product, state) REFERENCES state_new (product, position) ON DELETE CASCADE
) STRICT, WITHOUT ROWID;
INSERT INTO finding_new SELECT product, state, position, severity, code, message FROM finding;

DROP TABLE finding;
DROP TABLE state;
ALTER TABLE state_new RENAME TO state;
ALTER TABLE finding_new RENAME TO finding;
CREATE INDEX state_dataset ON state (dataset);
