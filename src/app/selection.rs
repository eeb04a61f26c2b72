//! Which nodes are selected.

use std::collections::BTreeSet;

use crate::scene::{Node, NodeId, Scene};

/// The selected nodes; the last one that was touched leads.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Selection {
    nodes: BTreeSet<NodeId>,
    lead: Option<NodeId>,
}

impl Selection {
    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// How many nodes are selected.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether this node is selected.
    pub fn contains(&self, node: NodeId) -> bool {
        self.nodes.contains(&node)
    }

    /// All selected nodes, in the order of the scene.
    pub fn iter(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.nodes.iter().copied()
    }

    /// The node that was touched last, whose values the panels show.
    pub fn lead(&self) -> Option<NodeId> {
        self.lead.filter(|n| self.nodes.contains(n)).or_else(|| self.nodes.first().copied())
    }

    /// The node of the files that leads; `None` where a glyph does.
    pub fn lead_object<'a>(&self, files: &'a Scene) -> Option<&'a Node> {
        files.nodes.get(self.lead()?)
    }

    /// Selects nothing.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Selects this node only.
    pub fn set(&mut self, node: NodeId) {
        self.nodes = BTreeSet::from([node]);
        self.lead = Some(node);
    }

    /// Adds the node, or takes it out if it is selected.
    pub fn toggle(&mut self, node: NodeId) {
        if !self.nodes.remove(&node) {
            self.nodes.insert(node);
            self.lead = Some(node);
        }
    }

    /// Adds nodes; the last one leads.
    pub fn extend(&mut self, nodes: impl IntoIterator<Item = NodeId>) {
        for node in nodes {
            self.nodes.insert(node);
            self.lead = Some(node);
        }
    }

    /// The selected nodes and all that hangs below them.
    pub fn with_descendants(&self, scene: &Scene) -> Vec<NodeId> {
        let mut all = Vec::new();
        let mut covered = 0;
        for &node in &self.nodes {
            let subtree = scene.subtree(node);
            all.extend(subtree.start.max(covered)..subtree.end);
            covered = covered.max(subtree.end);
        }
        all
    }

    /// The selected nodes that hang below no other selected one.
    pub fn topmost(&self, scene: &Scene) -> Vec<NodeId> {
        let mut covered = 0;
        self.iter()
            .filter(|&node| {
                let top = node >= covered;
                covered = covered.max(scene.subtree(node).end);
                top
            })
            .collect()
    }

    /// The same nodes, by path, in another scene.
    #[must_use]
    pub fn carried_over(&self, from: &Scene, to: &Scene) -> Self {
        let mut there = Self::default();
        let by_path: std::collections::HashMap<_, _> =
            to.nodes.iter().enumerate().map(|(id, n)| (n.path.as_str(), id)).collect();
        there.extend(self.iter().filter_map(|n| by_path.get(from.nodes.get(n)?.path.as_str()).copied()));
        there
    }
}
