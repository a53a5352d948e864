//! Products that this session has added to the catalogue.

use super::Products;
use super::changes::Added;
use super::shelf::Addition;
use crate::app::results::work::Outcome;
use crate::app::scene::first_choice::choose_first;
use crate::app::shell::Shell;
use crate::app::shell::error::AppError;
use crate::catalogue::{Product, Stored};
use crate::texts::{import as text, shell};
use std::sync::Arc;

impl Products {
    /// Whether additions are being stored.
    pub fn is_adding(&self) -> bool {
        !self.adding.is_empty()
    }

    /// Returns the indices of the additions that are being stored.
    pub fn being_added(&self) -> Vec<usize> {
        self.adding.iter().copied().collect()
    }

    /// Stores products in the catalogue as a separate undo step.
    pub fn add(&mut self, shell: &mut Shell, additions: Vec<Addition>) {
        if additions.is_empty() {
            return;
        }
        shell.end_step();
        let mut numbered = Vec::new();
        for addition in additions {
            let number = self.additions.len();
            self.additions.push(Added { addition: addition.clone(), key: None, message: None });
            shell.state.document.additions.push(number);
            numbered.push((number, addition));
        }
        self.store_additions(shell, numbered);
    }

    /// Queues the storing of additions, given with their numbers in this session: all are stored, or none.
    fn store_additions(&mut self, shell: &mut Shell, additions: Vec<(usize, Addition)>) {
        self.adding.extend(additions.iter().map(|(number, _)| *number));
        shell.queue(move |shelf| {
            let (numbers, additions): (Vec<_>, Vec<_>) = additions.into_iter().unzip();
            let look = |one: Stored| Ok((one.new, shelf.product(&one.imported.key)?));
            let stored = shelf.add_all(&additions).and_then(|list| list.into_iter().map(look).collect());
            Outcome::Added(numbers, stored)
        });
    }

    /// Takes over products that were stored: the first is selected by the step that added them.
    pub fn take_added(&mut self, shell: &mut Shell, numbers: &[usize], products: Vec<(bool, Arc<Product>)>) {
        self.adding.retain(|number| !numbers.contains(number));
        let (mut added, mut there, mut undone) = (Vec::new(), 0, Vec::new());
        for (&number, (new, product)) in numbers.iter().zip(products) {
            if !new {
                // This import did not add it, so undo does not remove it.
                there += 1;
            } else if shell.state.document.additions.contains(&number) {
                self.additions[number].key = Some(product.key.clone());
            } else {
                // Undone while it was being stored.
                undone.push(product.key.clone());
                continue;
            }
            added.push(product);
        }
        if !undone.is_empty() {
            shell.store(move |shelf| shelf.remove_all(&undone));
        }
        // What was asked before they were there has failed.
        shell.ask_again();
        if let Some(first) = added.first() {
            let what = match (added.len() - there, there) {
                (0, _) => shell::NOTHING_NEW.into(),
                (1, 0) => shell::ADDED.into(),
                (new, 0) => shell::added(new),
                (new, known) => shell::added_some(new, known),
            };
            let message = shell.toasts.success(what);
            numbers.iter().for_each(|number| self.additions[*number].message = Some(message));
            // The step that added it also shows it.
            choose_first(&mut shell.state.document, first);
            shell.end_step();
        }
        shell.search();
    }

    /// Forgets additions of which none could be stored, and says why.
    pub fn take_not_added(&mut self, shell: &mut Shell, numbers: &[usize], error: &AppError) {
        self.adding.retain(|number| !numbers.contains(number));
        shell.state.document.additions.retain(|other| !numbers.contains(other));
        shell.toasts.error(text::nothing_added(error));
    }

    /// Removes and restores additions after undo or redo. `before`: those of the document before it.
    pub fn step_additions(&mut self, shell: &mut Shell, before: &[usize]) {
        let after = shell.state.document.additions.clone();
        let gone = before.iter().filter(|number| !after.contains(number));
        let mut keys = Vec::new();
        for &number in gone {
            let addition = &mut self.additions[number];
            // What it says how to undo is undone.
            addition.message.take().into_iter().for_each(|message| shell.toasts.dismiss(Some(message)));
            keys.extend(addition.key.take());
        }
        if !keys.is_empty() {
            shell.store(move |shelf| shelf.remove_all(&keys));
        }
        // What is still being stored since it was added is there again as soon as it is there.
        let back = after.iter().filter(|number| !before.contains(number) && !self.adding.contains(number));
        let back: Vec<_> = back.map(|&number| (number, self.additions[number].addition.clone())).collect();
        if !back.is_empty() {
            self.store_additions(shell, back);
        }
    }
}
