-- Hash of all rows of a product: what lists, searches and sheets show of it. Products of a file without this column get it
-- with the column.
ALTER TABLE product ADD COLUMN shown_seal TEXT NOT NULL DEFAULT '';
