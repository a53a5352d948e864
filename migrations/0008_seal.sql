-- Hash of what results hang on beside the datasets: description, states, control curve. Empty where it is not known, as for
-- what older programs stored.
ALTER TABLE product ADD COLUMN seal TEXT NOT NULL DEFAULT '';
