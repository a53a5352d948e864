-- Products are found in memory (parts of words, slips of the finger), not by a full text index.
DROP TABLE product_text;
