//! Names of nodes: without `/`, and unique among siblings.

use std::collections::{HashMap, HashSet};

/// Gives out names that are unique among siblings: the second `rod` becomes `rod.2`, the third `rod.3`.
#[derive(Debug, Default)]
pub(super) struct SiblingNames {
    taken: HashSet<String>,
    next: HashMap<String, u64>,
}

impl SiblingNames {
    /// `wanted` made fit for a path, with a number appended where a sibling has it already.
    pub(super) fn unique(&mut self, wanted: &str) -> String {
        let plain = clean_name(wanted);
        if self.taken.insert(plain.clone()) {
            return plain;
        }
        let next = self.next.entry(plain.clone()).or_insert(2);
        loop {
            let name = format!("{plain}.{next}");
            *next += 1;
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// Replaces `/` and control characters by `_`; an empty name becomes `node`.
fn clean_name(name: &str) -> String {
    let name: String =
        name.trim().chars().map(|c| if c == '/' || c.is_control() { '_' } else { c }).collect();
    if name.is_empty() { "node".to_owned() } else { name }
}

/// The name of the node that stands for a file: its name without the last ending.
pub(super) fn file_stem(path: &std::path::Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn siblings_get_different_names() {
        let mut names = SiblingNames::default();
        let given = ["rod", "rod", "rod.2", "rod", "", " ", "a/b\n"].map(|n| names.unique(n));
        assert_eq!(given, ["rod", "rod.2", "rod.2.2", "rod.3", "node", "node.2", "a_b"]);
    }
}
