//! Scores a picture of lines against the edges that are visible in truth.

use glam::DVec2;

use super::EdgeClass;
use super::visible_edges::VisibleEdges;

/// The usual tolerance, in pixels.
pub const TOLERANCE: f64 = 1.5;
/// A pixel with at least this much ink is part of a line.
const INK_THRESHOLD: f32 = 0.5;

/// How much ink lies on each pixel.
#[derive(Debug, Clone, Copy)]
pub struct InkImage<'a> {
    size: [usize; 2],
    ink: &'a [f32],
    ignored: Option<&'a [bool]>,
}

impl<'a> InkImage<'a> {
    /// A picture of `width` × `height` pixels, row by row from the top, 0 (paper) to 1 (ink); `None` if that is not
    /// how many there are.
    pub fn new(width: usize, height: usize, ink: &'a [f32]) -> Option<Self> {
        (width.checked_mul(height)? == ink.len()).then_some(Self {
            size: [width, height],
            ink,
            ignored: None,
        })
    }

    /// The same picture with pixels that count neither way, because edges do not tell what has to be there (the
    /// outlines of holes): ink on them is neither right nor wrong, and edges on them need no ink. `None` if there are
    /// not as many as pixels.
    pub fn ignoring(self, ignored: &'a [bool]) -> Option<Self> {
        (ignored.len() == self.ink.len()).then_some(Self { ignored: Some(ignored), ..self })
    }

    /// Whether each pixel is part of a line.
    pub fn lines(&self) -> Vec<bool> {
        self.ink.iter().map(|&ink| ink >= INK_THRESHOLD).collect()
    }

    /// The pixel at a position, if there is one and it counts.
    fn pixel(&self, position: DVec2) -> Option<usize> {
        let [width, height] = self.size;
        let inside =
            position.cmpge(DVec2::ZERO).all() && position.x < width as f64 && position.y < height as f64;
        let at = inside.then(|| position.y as usize * width + position.x as usize)?;
        self.counts(at).then_some(at)
    }

    fn counts(&self, pixel: usize) -> bool {
        self.ignored.is_none_or(|ignored| !ignored[pixel])
    }
}

/// How well lines agree with the truth; everything from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineScore {
    /// The part of the inked pixels that have a visible edge within the tolerance; 1 without ink.
    pub precision: f64,
    /// The part of the visible edges' length in the picture that has ink within the tolerance; 1 without edges.
    pub recall: f64,
    /// The recall of each class, in the order of [`EdgeClass::ALL`]; `None` where the class does not appear.
    pub class_recall: [Option<f64>; EdgeClass::ALL.len()],
}

impl LineScore {
    /// The harmonic mean of precision and recall; 0 when both are 0.
    pub fn f1(&self) -> f64 {
        let sum = self.precision + self.recall;
        if sum > 0.0 { 2.0 * self.precision * self.recall / sum } else { 0.0 }
    }
}

/// Compares pixel centers: those with ink with those that visible edges pass through, both ways. `tolerance` is in
/// pixels.
pub fn score(picture: InkImage<'_>, truth: &VisibleEdges, tolerance: f64) -> LineScore {
    let width = picture.size[0];
    let limit = tolerance * tolerance;
    let ink = picture.lines();
    let mut edges = vec![false; ink.len()];
    for at in truth.samples.iter().flatten().filter_map(|sample| picture.pixel(sample.position)) {
        edges[at] = true;
    }

    let from_edges = squared_distances(&edges, width);
    let judged = || (0..ink.len()).filter(|&at| ink[at] && picture.counts(at));
    let inked = judged().count();
    let right = judged().filter(|&at| from_edges[at] <= limit).count();

    let from_ink = squared_distances(&ink, width);
    let lengths = truth.samples.each_ref().map(|samples| {
        let inside = samples
            .iter()
            .filter_map(|sample| Some((sample.length, from_ink[picture.pixel(sample.position)?])));
        inside.fold((0.0, 0.0), |(found, all), (length, distance)| {
            (if distance <= limit { found + length } else { found }, all + length)
        })
    });
    let part = |(found, all): (f64, f64)| (all > 0.0).then(|| found / all);
    let total = lengths.iter().fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
    LineScore {
        precision: part((right as f64, inked as f64)).unwrap_or(1.0),
        recall: part(total).unwrap_or(1.0),
        class_recall: lengths.map(part),
    }
}

/// The squared distance from each pixel to the nearest one that is set, infinite if there is none. Exact: Felzenszwalb
/// and Huttenlocher, "Distance Transforms of Sampled Functions", 2012.
fn squared_distances(set: &[bool], width: usize) -> Vec<f64> {
    let mut field: Vec<f64> = set.iter().map(|&set| if set { 0.0 } else { f64::INFINITY }).collect();
    if width == 0 {
        return field;
    }
    let height = field.len() / width;
    let mut line = vec![0.0; height];
    for x in 0..width {
        for (y, value) in line.iter_mut().enumerate() {
            *value = field[y * width + x];
        }
        lower_envelope(&mut line);
        for (y, &value) in line.iter().enumerate() {
            field[y * width + x] = value;
        }
    }
    field.chunks_exact_mut(width).for_each(lower_envelope);
    field
}

/// A parabola of a lower envelope.
struct Parabola {
    apex: f64,
    low: f64,
    /// Where it begins to be the lowest.
    begin: f64,
}

/// Replaces each value by the least of `values[q] + (p - q)²` over all q.
fn lower_envelope(values: &mut [f64]) {
    let mut envelope: Vec<Parabola> = Vec::new();
    for (q, &value) in values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        let q = q as f64;
        let mut begin = f64::NEG_INFINITY;
        while let Some(last) = envelope.last() {
            begin = ((value + q * q) - (last.low + last.apex * last.apex)) / (2.0 * (q - last.apex));
            if begin > last.begin {
                break;
            }
            envelope.pop();
            begin = f64::NEG_INFINITY;
        }
        envelope.push(Parabola { apex: q, low: value, begin });
    }
    let mut current = 0;
    for (p, value) in values.iter_mut().enumerate() {
        let p = p as f64;
        while envelope.get(current + 1).is_some_and(|next| next.begin <= p) {
            current += 1;
        }
        if let Some(Parabola { apex, low, .. }) = envelope.get(current) {
            *value = low + (p - apex) * (p - apex);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::visible_edges::EdgeSample;

    const SIZE: usize = 200;

    /// Silhouettes: the outline of a square of 100 px; ridges: a line of 50 px. Off the middle of the picture.
    fn truth() -> VisibleEdges {
        let mut truth = VisibleEdges::default();
        let mut line = |class: EdgeClass, from: DVec2, to: DVec2| {
            let count = 4 * from.distance(to) as usize;
            truth.samples[class as usize].extend((0..count).map(|i| EdgeSample {
                position: from.lerp(to, (i as f64 + 0.5) / count as f64),
                length: 0.25,
            }));
        };
        let corners =
            [(20.5, 30.5), (120.5, 30.5), (120.5, 130.5), (20.5, 130.5)].map(|(x, y)| DVec2::new(x, y));
        for i in 0..4 {
            line(EdgeClass::Silhouette, corners[i], corners[(i + 1) % 4]);
        }
        line(EdgeClass::Ridge, DVec2::new(50.5, 80.5), DVec2::new(100.5, 80.5));
        truth
    }

    fn perfect() -> Vec<f32> {
        let mut ink = vec![0.0; SIZE * SIZE];
        for sample in truth().samples.iter().flatten() {
            ink[sample.position.y as usize * SIZE + sample.position.x as usize] = 1.0;
        }
        ink
    }

    /// The picture whose pixel (x, y) is the perfect one's `from(x, y)`, blank outside.
    fn changed(from: impl Fn(i32, i32) -> (i32, i32)) -> Vec<f32> {
        let (size, perfect) = (SIZE as i32, perfect());
        (0..size * size)
            .map(|i| from(i % size, i / size))
            .map(|(x, y)| {
                let inside = (0..size).contains(&x) && (0..size).contains(&y);
                if inside { perfect[(y * size + x) as usize] } else { 0.0 }
            })
            .collect()
    }

    fn score_of(ink: &[f32]) -> LineScore {
        score(InkImage::new(SIZE, SIZE, ink).unwrap(), &truth(), TOLERANCE)
    }

    #[test]
    fn distances_are_those_of_a_search() {
        let (width, height) = (23, 17);
        let set: Vec<bool> = (0..width * height).map(|i| (i * 7919) % 61 == 3).collect();
        for (p, &found) in squared_distances(&set, width).iter().enumerate() {
            let nearest = (0..set.len())
                .filter(|&q| set[q])
                .map(|q| (p % width).abs_diff(q % width).pow(2) + (p / width).abs_diff(q / width).pow(2))
                .min();
            assert_eq!(found, nearest.unwrap() as f64);
        }
        assert!(squared_distances(&[false; 6], 3).iter().all(|d| d.is_infinite()));
    }

    #[test]
    fn a_perfect_or_slightly_shifted_picture_scores_one() {
        for shift in [0, 1] {
            let found = score_of(&changed(|x, y| (x - shift, y - shift)));
            assert_eq!((found.precision, found.recall, found.f1()), (1.0, 1.0, 1.0), "{shift}");
            let mut classes = [None; EdgeClass::ALL.len()];
            classes[EdgeClass::Silhouette as usize] = Some(1.0);
            classes[EdgeClass::Ridge as usize] = Some(1.0);
            assert_eq!(found.class_recall, classes);
        }
    }

    #[test]
    fn a_picture_shifted_too_far_scores_only_where_lines_cross() {
        let found = score_of(&changed(|x, y| (x - 4, y - 4)));
        // The outline crosses itself twice, 3 px of each line within the tolerance; the ridge covers nothing.
        assert!(found.recall > 0.0 && found.recall < 20.0 / 450.0, "{found:?}");
        assert!(found.precision > 0.0 && found.precision < 20.0 / 450.0, "{found:?}");
        assert_eq!(found.class_recall[EdgeClass::Ridge as usize], Some(0.0));
    }

    #[test]
    fn what_is_erased_costs_recall_and_what_is_added_costs_precision() {
        // The left half of the outline and 20 of the ridge's 50 px stay.
        let found = score_of(&changed(|x, y| if x < 70 { (x, y) } else { (-1, -1) }));
        assert_eq!(found.precision, 1.0);
        assert!((found.recall - 220.0 / 450.0).abs() < 0.01, "{found:?}");
        assert!((found.class_recall[EdgeClass::Silhouette as usize].unwrap() - 0.5).abs() < 0.01);
        assert!((found.class_recall[EdgeClass::Ridge as usize].unwrap() - 0.4).abs() < 0.03);

        let mut ink = perfect();
        let drawn = ink.iter().filter(|&&ink| ink > 0.0).count();
        ink[180 * SIZE..180 * SIZE + 150].fill(0.5);
        ink[190 * SIZE..190 * SIZE + 150].fill(0.49);
        let found = score_of(&ink);
        assert_eq!(found.recall, 1.0);
        assert!((found.precision - drawn as f64 / (drawn + 150) as f64).abs() < 1e-12);
    }

    #[test]
    fn what_is_ignored_counts_neither_way() {
        // A false line of 150 px, and a gap of 40 px in the square's upper side.
        let mut ink = perfect();
        ink[180 * SIZE..180 * SIZE + 150].fill(1.0);
        ink[30 * SIZE + 50..30 * SIZE + 90].fill(0.0);
        let found = score_of(&ink);
        assert!(found.precision < 0.8 && found.recall < 0.93, "{found:?}");
        let mut ignored = vec![false; SIZE * SIZE];
        ignored[180 * SIZE..180 * SIZE + 150].fill(true);
        ignored[30 * SIZE + 50..30 * SIZE + 90].fill(true);
        let picture = InkImage::new(SIZE, SIZE, &ink).unwrap();
        assert!(picture.ignoring(&ignored[1..]).is_none());
        let found = score(picture.ignoring(&ignored).unwrap(), &truth(), TOLERANCE);
        assert_eq!((found.precision, found.recall), (1.0, 1.0));
        // All the rest still has to be there.
        let blank = vec![0.0; SIZE * SIZE];
        let picture = InkImage::new(SIZE, SIZE, &blank).unwrap().ignoring(&ignored);
        assert_eq!(score(picture.unwrap(), &truth(), TOLERANCE).recall, 0.0);
        // Ink there does not make up for what is missing elsewhere beyond the tolerance, nor excuse other ink.
        let shifted = changed(|x, y| (x - 4, y - 4));
        let picture = InkImage::new(SIZE, SIZE, &shifted).unwrap();
        let found = score(picture.ignoring(&ignored).unwrap(), &truth(), TOLERANCE);
        assert!(found.f1() < 0.05, "{found:?}");
    }

    #[test]
    fn mirrored_and_blank_pictures_lose() {
        // Mirrored, the square spans 79 to 179: of its horizontal sides 41 of 100 px lie on the old ones, twice, and
        // 21 px of the ridge; where the others cross the rest, 3 px each.
        let found = score_of(&changed(|x, y| (SIZE as i32 - 1 - x, y)));
        let expected = (2.0 * 42.0 + 22.0) / 450.0;
        assert!((found.recall - expected).abs() < 10.0 / 450.0, "{found:?}");
        assert!((found.precision - expected).abs() < 10.0 / 450.0, "{found:?}");

        let blank = score_of(&changed(|_, _| (-1, -1)));
        assert_eq!((blank.precision, blank.recall, blank.f1()), (1.0, 0.0, 0.0));
        let nothing = InkImage::new(2, 1, &[0.0, 0.0]).unwrap();
        assert_eq!(score(nothing, &VisibleEdges::default(), TOLERANCE).f1(), 1.0);
        assert!(InkImage::new(3, 1, &[0.0, 0.0]).is_none());
    }
}
