//! Undo and redo by value.

use super::Document;

/// States of a document before and after the present one.
#[derive(Debug, Default)]
pub struct History {
    past: Vec<Document>,
    future: Vec<Document>,
    present: Option<Document>,
}

/// Older steps are forgotten.
const MAX_STEPS: usize = 200;

impl History {
    /// Notes the document's state once a change is finished (the button is up again): if it differs from the last
    /// noted one, that becomes a step to go back to.
    pub fn commit(&mut self, document: &Document) {
        match &mut self.present {
            None => self.present = Some(document.clone()),
            Some(present) if present != document => {
                self.past.push(std::mem::replace(present, document.clone()));
                if self.past.len() > MAX_STEPS {
                    self.past.remove(0);
                }
                self.future.clear();
            }
            Some(_) => {}
        }
    }

    /// Forgets everything; `document` is the new beginning.
    pub fn restart(&mut self, document: &Document) {
        *self = Self { present: Some(document.clone()), ..Self::default() };
    }

    /// Whether [`Self::undo`] would change anything.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether [`Self::redo`] would change anything.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }

    /// Goes one step back; an unfinished change counts as a step.
    pub fn undo(&mut self, document: &mut Document) {
        self.commit(document);
        if let Some(before) = self.past.pop() {
            self.future.push(std::mem::replace(document, before));
            self.present = Some(document.clone());
        }
    }

    /// Takes one undo back.
    pub fn redo(&mut self, document: &mut Document) {
        if let Some(after) = self.future.pop() {
            self.past.push(std::mem::replace(document, after));
            self.present = Some(document.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_is_one_step_and_comes_back_by_value() {
        let mut document = Document::default();
        let mut history = History::default();
        history.restart(&document);
        let start = document.clone();
        for i in 1..=10 {
            document.style.gooch.alpha = i as f32 / 10.0; // while dragging nothing is committed
        }
        history.commit(&document);
        history.commit(&document);
        let end = document.clone();
        history.undo(&mut document);
        assert_eq!(document, start);
        assert!(!history.can_undo());
        history.redo(&mut document);
        assert_eq!(document, end);
        assert!(!history.can_redo());
        history.undo(&mut document);
        document.style.gooch.beta = 0.0;
        history.commit(&document);
        assert!(!history.can_redo(), "a new change drops the redo steps");
    }
}
