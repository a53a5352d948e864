-- The description (geometry and material) that a computed product can be computed from again; empty for others.
ALTER TABLE product ADD COLUMN system TEXT NOT NULL DEFAULT '';
