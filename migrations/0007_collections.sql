-- On which terms a product's data may be passed on, in the words of whoever gives them; empty: not told.
ALTER TABLE product ADD COLUMN license TEXT NOT NULL DEFAULT '';

-- Sets of products that users make. By key, as favourites: members survive the renewal of built-in products.
CREATE TABLE collection (
  name        TEXT NOT NULL CHECK (length(name) > 0),
  product_key TEXT NOT NULL,
  PRIMARY KEY (name, product_key)
) STRICT, WITHOUT ROWID;
CREATE INDEX collection_product ON collection (product_key);
