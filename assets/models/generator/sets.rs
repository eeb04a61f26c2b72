//! Disjoint sets of numbers: each number points to a smaller one of its set, the smallest to itself.

/// The smallest number of the set.
pub(crate) fn root(parent: &[usize], mut i: usize) -> usize {
    while parent[i] != i {
        i = parent[i];
    }
    i
}

/// Unites two sets.
pub(crate) fn unite(parent: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(parent, a), root(parent, b));
    let low = a.min(b);
    parent[a] = low;
    parent[b] = low;
}
