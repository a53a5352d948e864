//! Division of a ranking into pieces that can be computed on several machines. A piece is a number n of 0 … N − 1; its
//! share of the work follows from the scenes, the catalogue and n / N alone.
//!
//! Pieces are divided by lists first, since all products of a list share the room and the light of the year: with no
//! more pieces than lists, a piece has whole lists; else a list is divided into as many pieces as there are for it.

use super::question::Group;
use super::run::Item;
use crate::study::fingerprint::{digest, of_product, of_scene};

/// Piece of a ranking, the n-th of N.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number n of the piece, from 0.
    pub number: usize,
    /// Number N of all pieces.
    pub count: usize,
}

impl Shard {
    /// Whole ranking as one piece.
    pub const WHOLE: Self = Self { number: 0, count: 1 };

    /// Reads a piece from the text "n/N".
    ///
    /// # Errors
    /// Returns a message that says what is expected.
    pub fn read(text: &str) -> Result<Self, String> {
        let wrong = || format!("\"{text}\" is not a shard; expected n/N with n from 0 to N - 1, e.g. 0/8");
        let (number, count) = text.split_once('/').ok_or_else(wrong)?;
        let (number, count) = (number.parse().map_err(|_| wrong())?, count.parse().map_err(|_| wrong())?);
        if number < count { Ok(Self { number, count }) } else { Err(wrong()) }
    }

    /// Returns the products of this piece. `products`: number of products of each list.
    pub fn items(self, products: &[usize]) -> Vec<Item> {
        let lists = products.len();
        let mut items = Vec::new();
        for (group, &own) in products.iter().enumerate() {
            // The pieces from the first one of this list to that of the next one; none: the list belongs to a piece of
            // several.
            let first = |list: usize| (list * self.count).div_ceil(lists);
            let (from, to) = (first(group), first(group + 1));
            let (from, to) = if self.count <= lists {
                let piece = group * self.count / lists;
                (piece, piece + 1)
            } else {
                (from, to)
            };
            if !(from..to).contains(&self.number) {
                continue;
            }
            let (piece, pieces) = (self.number - from, to - from);
            items.extend((own * piece / pieces..own * (piece + 1) / pieces).map(|product| Item { group, product }));
        }
        items
    }
}

/// Returns the keys of the products' rows: hashes of all input of their figures, which is the scene, files that it
/// names, the product and the program.
pub fn keys(groups: &[Group], items: &[Item]) -> Vec<String> {
    let scenes: Vec<String> = groups.iter().map(of_group).collect();
    let key = |item: &Item| {
        let product = &groups[item.group].products[item.product];
        digest(&[scenes[item.group].as_bytes(), product.key.as_bytes(), of_product(product).as_bytes()])
    };
    items.iter().map(key).collect()
}

/// Returns the key of a whole ranking: equal for all pieces of the same ranking, different for different ones.
pub fn run_key(groups: &[Group]) -> String {
    let all = Shard::WHOLE.items(&groups.iter().map(|group| group.products.len()).collect::<Vec<_>>());
    digest(&keys(groups, &all).iter().map(String::as_bytes).collect::<Vec<_>>())
}

fn of_group(group: &Group) -> String {
    let mut parts = of_scene(&group.file, &group.base);
    parts.push(group.scene.clone().into_bytes());
    digest(&parts.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_in_one_piece_and_lists_are_cut_last() {
        for products in [&[5, 3, 4][..], &[1], &[0, 2], &[7, 7, 7, 7, 7]] {
            let all = Shard::WHOLE.items(products);
            assert_eq!(all.len(), products.iter().sum::<usize>());
            for count in 1..20 {
                let pieces: Vec<Vec<Item>> = (0..count).map(|number| Shard { number, count }.items(products)).collect();
                assert_eq!(pieces.concat(), all, "{products:?} in {count}");
                if count <= products.len() {
                    // Whole lists alone.
                    for group in 0..products.len() {
                        let with = pieces.iter().filter(|piece| piece.iter().any(|item| item.group == group)).count();
                        assert!(with <= 1, "{products:?} in {count}");
                    }
                } else {
                    assert!(pieces.iter().all(|piece| piece.windows(2).all(|two| two[0].group == two[1].group)));
                }
            }
        }
    }

    #[test]
    fn shards_are_read() {
        assert_eq!(Shard::read("3/8"), Ok(Shard { number: 3, count: 8 }));
        for wrong in ["8/8", "0/0", "-1/8", "1", "1/x", "", "1/2/3"] {
            assert!(Shard::read(wrong).unwrap_err().contains("expected n/N"), "{wrong}");
        }
    }
}
