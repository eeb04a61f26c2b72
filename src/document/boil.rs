//! Sketches that are drawn anew several times per second, as animators do: the document as it is at a time.

use std::borrow::Cow;
use std::time::Duration;

use super::Document;
use crate::style::Style;

/// Steps after which drawings come again.
const PERIOD: u64 = 1 << 16;

impl Document {
    /// The document so many seconds after it was opened, and how long it stays so; `None`: for good. Nothing but the numbers of
    /// noise changes, and only of styles that ask for it.
    pub fn at(&self, seconds: f64) -> (Cow<'_, Self>, Option<Duration>) {
        let rates = self.styles().map(rate).filter(|rate| *rate > 0.0);
        let seconds = if seconds.is_finite() { seconds.max(0.0) } else { 0.0 };
        let until_next = |rate: f64| (1.0 - (seconds * rate).fract()) / rate;
        let Some(left) = rates.map(until_next).min_by(f64::total_cmp) else {
            return (Cow::Borrowed(self), None);
        };
        let mut now = self.clone();
        now.styles_mut().for_each(|style| boil(style, seconds));
        (Cow::Owned(now), Some(Duration::from_secs_f64(left.clamp(1e-3, 60.0))))
    }
}

/// How often per second a style is drawn anew; 0: never.
fn rate(style: &Style) -> f64 {
    let rate = f64::from(style.sketch.wander.boil);
    if style.sketch.enabled && rate > 0.0 { rate.min(24.0) } else { 0.0 }
}

fn boil(style: &mut Style, seconds: f64) {
    let step = (seconds * rate(style)) as u64 % PERIOD;
    let seed = &mut style.sketch.wander.seed;
    // Far from the numbers that people choose.
    *seed = seed.wrapping_add((step as u32).wrapping_mul(10_007));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_boils_changes_and_only_when_it_is_due() {
        let mut document = Document::default();
        assert_eq!(document.at(3.0).1, None);
        document.style.sketch.enabled = true;
        document.style.sketch.wander.boil = 8.0;
        let (first, left) = document.at(1.0);
        assert_eq!(
            (first.style.sketch.wander.seed != document.style.sketch.wander.seed, left),
            (true, Some(Duration::from_millis(125)))
        );
        assert_eq!(document.at(1.1).0, first);
        assert_ne!(document.at(1.13).0, first);
        assert_eq!(document.at(0.0).0.as_ref(), &document);
        assert_eq!(document.at(f64::NAN).0.as_ref(), &document);
    }
}
