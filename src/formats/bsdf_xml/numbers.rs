//! Numbers inside `ScatteringData`: plain lists and brace-nested tensor trees.

use crate::compute::basis::MAX_LEVEL;
use crate::compute::btdf::{TreeNode, TreeRank};
use crate::compute::limits;
use crate::formats::location::{FormatError, Location, excerpt};

/// Maximum number of nodes of a tensor tree, more than any measurement or simulation yields; bounds its memory to 128
/// MB.
const MAX_TREE_NODES: usize = limits::TREE_NODES;

/// Reads numbers separated by blanks, line breaks and commas. `expected`: number of values that the bases require.
pub(super) fn parse_list(text: &str, expected: usize, at: &Location) -> Result<Vec<f64>, FormatError> {
    let mut values = Vec::with_capacity(expected.min(text.len() / 2 + 1));
    for token in tokens(text) {
        values.push(parse_number(token, values.len(), at)?);
    }
    Ok(values)
}

fn tokens(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c.is_ascii_whitespace() || c == ',').filter(|token| !token.is_empty())
}

fn parse_number(token: &str, index: usize, at: &Location) -> Result<f64, FormatError> {
    match token.parse::<f64>() {
        Ok(value) if value.abs() <= limits::COEFFICIENT => Ok(value),
        Ok(value) if value.is_finite() => Err(FormatError::new(
            at.clone(),
            format!("value {} is {value:e}, which no cell can have", index + 1),
            format!("values of at most {:e} in 1/sr", limits::COEFFICIENT),
        )),
        Ok(_) => Err(FormatError::new(
            at.clone(),
            format!("value {} is '{}', not a finite number", index + 1, excerpt(token)),
            "finite numbers in 1/sr",
        )),
        Err(_not_a_number) => Err(FormatError::new(
            at.clone(),
            format!("value {} is '{}', not a number", index + 1, excerpt(token)),
            "decimal numbers like 1.5e-03",
        )),
    }
}

/// Tensor tree that was read from text, and the negative values that were replaced.
pub(super) struct ParsedTree {
    /// Nodes of the tree, the root at index 0.
    pub nodes: Vec<TreeNode>,
    /// Negative values that were set to zero: their number, and the most negative one. \[1/sr\]
    pub negative: (usize, f64),
}

/// Reads a tensor tree from nested `{ … }`: a branch contains 2^rank braces, a leaf one number or a grid of 2^(rank·k)
/// numbers, of which the last coordinate runs fastest. No recursion beyond the allowed depth.
pub(super) fn parse_tree(text: &str, rank: TreeRank, at: &Location) -> Result<ParsedTree, FormatError> {
    let mut parser = Parser {
        rest: text.trim_start(),
        rank,
        at,
        tree: ParsedTree { nodes: vec![TreeNode::Leaf(0.0)], negative: (0, 0.0) },
    };
    parser.node(0, 0)?;
    if !parser.rest.is_empty() {
        return Err(parser.error("text after the tree's last brace", "nothing more, braces balanced"));
    }
    Ok(parser.tree)
}

struct Parser<'a> {
    rest: &'a str,
    rank: TreeRank,
    at: &'a Location,
    tree: ParsedTree,
}

impl Parser<'_> {
    fn error(&self, found: &str, expected: &str) -> FormatError {
        let rest = if self.rest.is_empty() { "the end".to_owned() } else { format!("'{}'", excerpt(self.rest)) };
        FormatError::new(self.at.clone(), format!("{found}, before {rest}"), expected)
    }

    fn skip(&mut self, bytes: usize) {
        self.rest = self.rest[bytes..].trim_start_matches(|c: char| c.is_ascii_whitespace() || c == ',');
    }

    fn node(&mut self, place: usize, level: u32) -> Result<(), FormatError> {
        if level > MAX_LEVEL {
            return Err(self.error("a tensor tree that is too deep", &format!("at most {MAX_LEVEL} levels of braces")));
        }
        if !self.rest.starts_with('{') {
            return Err(
                self.error("a missing '{' in the tensor tree (wrong number of children?)", "a '{' for every child")
            );
        }
        self.skip(1);
        if self.rest.starts_with('{') {
            let start = self.tree.nodes.len();
            self.tree.nodes[place] = TreeNode::Branch(start as u32);
            self.tree.nodes.extend((0..self.rank.children()).map(|_| TreeNode::Leaf(0.0)));
            for child in 0..self.rank.children() {
                if self.rest.starts_with('}') {
                    return Err(self.error(
                        &format!("a branch of the tensor tree with {child} children"),
                        &format!("{} children", self.rank.children()),
                    ));
                }
                self.node(start + child, level + 1)?;
            }
        } else {
            self.grid(place, level)?;
        }
        if !self.rest.starts_with('}') {
            return Err(self.error("unbalanced braces in the tensor tree", "a closing '}'"));
        }
        self.skip(1);
        Ok(())
    }

    fn grid(&mut self, place: usize, level: u32) -> Result<(), FormatError> {
        let end = self.rest.find(['{', '}']).unwrap_or(self.rest.len());
        let mut values = Vec::new();
        for token in tokens(&self.rest[..end]) {
            let mut value = parse_number(token, values.len(), self.at)?;
            if value < 0.0 {
                self.tree.negative = (self.tree.negative.0 + 1, self.tree.negative.1.min(value));
                value = 0.0;
            }
            values.push(value);
            if self.tree.nodes.len() + values.len() > MAX_TREE_NODES {
                return Err(FormatError::new(
                    self.at.clone(),
                    format!("a tensor tree of more than {MAX_TREE_NODES} nodes"),
                    "a smaller tree (pruned, as rttree_reduce does)",
                ));
            }
        }
        let dimensions = self.rank.dimensions() as u32;
        let depth = values.len().checked_ilog2().unwrap_or(0) / dimensions;
        if values.len() != 1 << (dimensions * depth) {
            return Err(self.error(
                &format!("{} numbers in one leaf of the tensor tree", values.len()),
                &format!("1, {} or {} numbers", 1 << dimensions, 1 << (2 * dimensions)),
            ));
        }
        if level + depth > MAX_LEVEL {
            return Err(self.error("a tensor tree that is too deep", &format!("at most {MAX_LEVEL} levels")));
        }
        self.skip(end);
        self.spread(place, &values, depth, depth, [0; 4]);
        Ok(())
    }

    /// Stores a grid of leaf values as nested branches of the tree.
    fn spread(&mut self, place: usize, values: &[f64], depth: u32, left: u32, corner: [usize; 4]) {
        let dimensions = self.rank.dimensions();
        if left == 0 {
            let index = corner[..dimensions].iter().fold(0, |index, at| (index << depth) + at);
            self.tree.nodes[place] = TreeNode::Leaf(values[index]);
            return;
        }
        let start = self.tree.nodes.len();
        self.tree.nodes[place] = TreeNode::Branch(start as u32);
        self.tree.nodes.extend((0..self.rank.children()).map(|_| TreeNode::Leaf(0.0)));
        for child in 0..self.rank.children() {
            let below = std::array::from_fn(|d| 2 * corner[d] + (child >> d & 1));
            self.spread(start + child, values, depth, left - 1, below);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_of_eight_has_its_last_coordinate_fastest() {
        let at = Location::file();
        let tree = parse_tree("{ 0 1 2 3, 4 5 6 7 }", TreeRank::Three, &at).unwrap();
        let TreeNode::Branch(first) = tree.nodes[0] else { panic!("a branch") };
        // Child 1 (bit 0) is the upper half of coordinate 0, the slowest: value 4.
        assert_eq!(tree.nodes[first as usize + 1], TreeNode::Leaf(4.0));
        assert_eq!(tree.nodes[first as usize + 4], TreeNode::Leaf(1.0));
    }

    #[test]
    fn refuses_broken_trees_with_their_reason() {
        let at = Location::file();
        let bad = |text: &str| parse_tree(text, TreeRank::Three, &at).err().expect("refused").to_string();
        assert!(bad("{ 1 2 3 }").contains("3 numbers"));
        assert!(bad("{{1}{1}{1}{1}{1}{1}{1}}").contains("7 children"));
        assert!(bad("{ 1").contains("unbalanced"));
        assert!(bad("{ 1 } }").contains("after"));
        assert!(bad(&"{".repeat(100_000)).contains("too deep"));
        assert!(bad("{ nan }").contains("finite"));
    }
}
