//! How arcs are counted along one chain or loop.

/// How much a loop may be stretched, so that a whole number of periods fits.
const MAX_STRETCH: f64 = 0.1;

/// Lengths along one chain.
pub(super) struct Scale {
    /// Length at the fixed point.
    pub anchor: f64,
    /// Length of a loop; `None` if it is none.
    pub around: Option<f64>,
    pub period: f64,
}

impl Scale {
    /// The arcs of a part of the chain between two lengths. They are never negative; only their differences and
    /// what is left after whole periods mean something.
    pub(super) fn arcs(&self, [from, to]: [f64; 2]) -> [f32; 2] {
        let (wrap, factor) = match self.around {
            Some(around) => (if from.max(to) <= self.anchor { around } else { 0.0 }, self.factor(around)),
            None => (0.0, 1.0),
        };
        let before = (self.anchor * factor / self.period).ceil().max(0.0) * self.period;
        [from, to].map(|at| ((at + wrap - self.anchor) * factor + before) as f32)
    }

    fn factor(&self, around: f64) -> f64 {
        let factor = (around / self.period).round() * self.period / around;
        if (factor - 1.0).abs() <= MAX_STRETCH { factor } else { 1.0 }
    }
}
