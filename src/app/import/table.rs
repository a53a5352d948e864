//! Execution of commands about the table of the import sheet.

use super::Imports;
use super::arranging::{catch_up, rearranged};
use super::proposal::{Arranged, Arrangement, Import, Proposed, Row};
use super::step::{Choose, Step};
use crate::app::shell::Shell;
use crate::app::shell::jobs::Lane;
use crate::catalogue::Grouping;
use crate::texts::import as text;
use std::collections::BTreeSet;

impl Import {
    fn choose(&mut self, rows: BTreeSet<Row>, how: Choose) {
        let Some((&first, &last)) = rows.first().zip(rows.last()) else { return };
        match how {
            Choose::Only => self.selected = rows,
            Choose::Also if rows.is_subset(&self.selected) => self.selected.retain(|row| !rows.contains(row)),
            Choose::Also => self.selected.extend(rows),
            Choose::UpTo => {
                let from = self.shown.unwrap_or(first);
                let (low, high) = (from.min(first), from.max(last));
                self.selected = self.rows().filter(|row| (low..=high).contains(row)).collect();
                // Where the range began stays, so that it can be changed.
                return;
            }
        }
        self.shown = Some(first);
    }

    fn states_of(&self, product: usize) -> BTreeSet<Row> {
        self.rows().filter(|row| row.0 == product).collect()
    }

    /// Returns the current grouping of the files into products as lists of file identifiers, without the given files.
    fn without(&self, files: &[String]) -> Vec<Vec<String>> {
        let rest = |one: &Proposed| -> Vec<String> {
            one.files.iter().filter(|file| !files.contains(file)).cloned().collect()
        };
        // While products are still those of the arrangement before, that which was asked for last is what is changed.
        if let (Some(groups), true) = (&self.by_hand, self.arranging) {
            let rest = |group: &Vec<String>| group.iter().filter(|file| !files.contains(file)).cloned().collect();
            return groups.iter().map(rest).filter(|files: &Vec<String>| !files.is_empty()).collect();
        }
        self.products.iter().filter(|one| !one.packed).map(rest).filter(|files| !files.is_empty()).collect()
    }
}

impl Imports {
    /// Executes a command about the table of the import sheet.
    pub fn act(&mut self, shell: &mut Shell, step: Step) {
        let Some(import) = &mut self.open else { return };
        let before = import.arrangement();
        match step {
            Step::Choose(row, how) => import.choose(BTreeSet::from([row]), how),
            Step::ChooseProduct(product, how) => import.choose(import.states_of(product), how),
            Step::ChooseAll => {
                let all: BTreeSet<Row> = import.rows().collect();
                import.selected = if import.selected == all { BTreeSet::new() } else { all };
            }
            Step::Fold(product) => {
                if !import.folded.remove(&product) {
                    import.folded.insert(product);
                }
            }
            Step::Together | Step::Separate => {
                let files = import.files_of_selected();
                let mut groups = import.without(&files);
                import.answered.extend(files.iter().cloned());
                match step {
                    Step::Together => groups.push(files),
                    _ => groups.extend(files.into_iter().map(|file| vec![file])),
                }
                self.arrange_by_hand(shell, groups);
            }
            Step::StatesOf(product) => {
                let Some(target) = import.products.get(product).filter(|one| !one.packed) else { return };
                let mut files = target.files.clone();
                let more = import.files_of_selected();
                files.extend(more.into_iter().filter(|file| !target.files.contains(file)));
                let mut groups = import.without(&files);
                import.answered.extend(files.iter().cloned());
                groups.push(files);
                self.arrange_by_hand(shell, groups);
            }
            Step::Name((product, state), words) => {
                if let Some(place) = import.products.get_mut(product).and_then(|one| one.states.get_mut(state)) {
                    *place = words;
                }
            }
            Step::Word(word, text) => {
                for product in import.selected_products() {
                    if let Some(one) = import.products.get_mut(product) {
                        word.of(&mut one.fields).clone_from(&text);
                    }
                }
            }
            Step::Settle(product) => {
                if let Some(one) = import.products.get_mut(product) {
                    one.ambiguity = None;
                    import.answered.extend(one.files.iter().cloned());
                }
            }
            Step::SettleAll => {
                for one in &mut import.products {
                    if one.ambiguity.take().is_some() {
                        import.answered.extend(one.files.iter().cloned());
                    }
                }
            }
        }
        self.note_arrangement(shell, before);
    }

    /// Records a change from one arrangement to another as an undo step.
    fn note_arrangement(&mut self, shell: &mut Shell, before: Arrangement) {
        let Some(import) = &self.open else { return };
        let after = import.arrangement();
        if before != after {
            let number = self.arranged.len();
            self.arranged.push(Arranged { paths: import.paths.clone(), before, after });
            shell.end_step();
            shell.state.document.arranged.push(number);
            shell.end_step();
        }
    }

    /// Restores the arrangement that is in effect after undo or redo.
    pub fn step_arranged(&mut self, shell: &mut Shell, before: &[usize]) {
        let after = shell.state.document.arranged.clone();
        let steps = &self.arranged;
        let gone = before.iter().rev().filter(|number| !after.contains(number)).map(|&n| (&steps[n], &steps[n].before));
        let back = after.iter().filter(|number| !before.contains(number)).map(|&n| (&steps[n], &steps[n].after));
        let Some((step, wanted)) = gone.chain(back).last().map(|(step, wanted)| (step.clone(), wanted.clone())) else {
            return;
        };
        match &mut self.open {
            Some(import) if import.paths == step.paths => {
                (import.grouping, import.by_hand, import.answered) = (wanted.grouping, wanted.by_hand, wanted.answered);
                self.rearrange(shell);
            }
            _ => shell.toasts.info(text::NOT_OPEN),
        }
    }

    /// Shows a new arrangement with texts that were typed meanwhile. The arrangement of an import that is no longer
    /// open is dropped.
    pub fn take_rearranged(&mut self, shell: &mut Shell, mut new: Import, names: &[(Vec<String>, String)]) {
        if let Some(now) = self.open.as_ref().filter(|now| now.paths == new.paths) {
            catch_up(&mut new, now, names);
            self.open = Some(new);
            self.repair_next(shell);
        }
    }

    /// Stops the computation of a new arrangement, so that the current one stays.
    pub fn stop_arranging(&mut self) {
        if let Some(import) = self.open.as_mut().filter(|import| import.arranging) {
            import.arranging = false;
            let groups = import.products.iter().filter(|one| !one.packed).map(|one| one.files.clone());
            import.by_hand = Some(groups.collect());
        }
    }

    /// Starts the creation of products from these groups of files in a job.
    fn arrange_by_hand(&mut self, shell: &mut Shell, groups: Vec<Vec<String>>) {
        if let Some(import) = &mut self.open {
            import.by_hand = Some(groups);
            self.rearrange(shell);
        }
    }

    /// Changes the rule by which files are grouped into products, and starts the new arrangement.
    pub fn group(&mut self, shell: &mut Shell, grouping: Grouping) {
        let Some(import) = &mut self.open else { return };
        if import.grouping != grouping || import.by_hand.is_some() {
            let before = import.arrangement();
            (import.grouping, import.by_hand) = (grouping, None);
            self.rearrange(shell);
            self.note_arrangement(shell, before);
        }
    }

    fn rearrange(&mut self, shell: &mut Shell) {
        let Some(import) = &mut self.open else { return };
        import.arranging = true;
        let import = import.clone();
        let shelf = shell.state.shelf();
        shell.start(Lane::Arrange, move |job| rearranged(import, shelf.as_deref(), job));
    }
}
