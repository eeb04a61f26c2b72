//! Of parameters that are curves.

use super::param::{self, Params};
use super::*;

const KEY: &str = "hatching.curve";

fn params(curve: &mut Curve) -> Vec<Param<'_>> {
    let mut list = Params::default();
    list.section("hatching", |list| list.curve("curve", "Tone curve", "How dark each tone is drawn.", curve));
    list.finish()
}

fn curve(numbers: &[[f32; 2]]) -> Curve {
    let points: Vec<Point> = numbers.iter().copied().map(Point::from).collect();
    Curve::of_points(&points).unwrap()
}

/// As `--set` has it.
fn set(curve: &mut Curve, value: &str) -> Result<(), String> {
    param::set(&mut params(curve), KEY, &Value::parse(value)).map(drop).map_err(|e| e.to_string())
}

fn read(curve: &mut Curve, text: &str) -> Result<(), String> {
    set_from_toml(&mut params(curve), text, "my.toml").map(drop).map_err(|e| e.to_string())
}

fn written(curve: Curve) -> String {
    diff_to_toml(&mut params(&mut { curve }), &mut params(&mut Curve::default())).to_string()
}

#[test]
fn curves_are_set_read_and_written() {
    for (numbers, line, file) in [
        (&[[0.0, 1.0], [1.0, 0.0]][..], "0,1,1,0", "[[0.0, 1.0], [1.0, 0.0]]"),
        (&[[0.0, 0.1], [0.4, 0.2], [1.0, 1.0]], "0,0.1,0.4,0.2,1,1", "[[0.0, 0.1], [0.4, 0.2], [1.0, 1.0]]"),
    ] {
        let expected = curve(numbers);
        let mut set_by_line = Curve::default();
        set(&mut set_by_line, line).unwrap();
        assert_eq!(set_by_line, expected);
        let own = params(&mut set_by_line)[0].own();
        assert_eq!(own.to_string(), line, "what is printed is what was written");
        param::set(&mut params(&mut set_by_line), KEY, &own).unwrap();
        assert_eq!(set_by_line, expected);

        let text = written(expected);
        assert_eq!(text, format!("[hatching]\ncurve = {file}\n"));
        let mut read_again = Curve::default();
        read(&mut read_again, &text).unwrap();
        assert_eq!(read_again, expected);
    }
    assert_eq!(written(Curve::LINEAR), "", "the default is not written");
    let mut read_whole = Curve::default();
    read(&mut read_whole, "hatching.curve = [\n  [0, 0], # dark\n  [5e-1, 0x1],\n  [+1, 0],\n]\n").unwrap();
    assert_eq!(read_whole, curve(&[[0.0, 0.0], [0.5, 1.0], [1.0, 0.0]]));
    let mut longest = Curve::default();
    set(&mut longest, "0,0,0.01,0,0.02,0,0.03,0,0.04,0,0.05,0,0.06,0,1,1").unwrap();
    assert_eq!(longest.points().len(), 8);
    read(&mut Curve::default(), &written(longest)).unwrap();
}

#[test]
fn what_is_no_curve_is_told_and_changes_nothing() {
    let mut kept = curve(&[[0.0, 0.1], [0.4, 0.2], [1.0, 1.0]]);
    let before = kept;
    let takes = "`hatching.curve` takes a curve of 2 to 8 points from x = 0 to x = 1, y from 0 to 1, \
                 [[x, y], …] in a file and x,y,… behind --set, not ";
    for (value, found) in [
        ("0.5", "the number 0.5"),
        ("0,0,1", "the text `0,0,1`"),
        ("0,0,x,1", "the text `0,0,x,1`"),
        ("[[0,0],[1,1]]", "the text `[[0,0],[1,1]]`"),
        ("on", "the switch `true`"),
        ("", "the text ``"),
        ("inherit", "`inherit`, for it inherits from nothing"),
    ] {
        assert_eq!(set(&mut kept, value), Err(format!("{takes}{found}")));
    }
    for (value, wrong) in [
        ("0,0", "a curve has 2 to 8 points, not 1"),
        ("0,0,nan,1", "x = NaN of point 2 is out of range: 0 to 1"),
        ("0,0,1,1.5", "y = 1.5 of point 2 is out of range: 0 to 1"),
        ("0,-0.1,0.5,0,1,1", "y = -0.1 of point 1 is out of range: 0 to 1"),
        ("0.2,0,1,1", "point 1 has x = 0.2; the first point has x = 0 and the last one x = 1"),
        (
            "0,0,0.5,0.2,0.5,0.4,1,1",
            "point 3 has x = 0.5 after x = 0.5; x grows from point to point, by 0.01 at least",
        ),
    ] {
        assert_eq!(set(&mut kept, value), Err(format!("`hatching.curve`: {wrong}")));
    }

    let mut row =
        |value: &str| read(&mut kept, &format!("[hatching]\n# of 9\ncurve = {value}\n")).unwrap_err();
    let place = "my.toml, line 3: ";
    for array in
        ["[]", "[[]]", "[0, 0, 1, 1]", "[[0, 0], [1]]", "[[0, 0, 0], [1, 1]]", "[[0, \"0\"], [1, 1]]"]
    {
        assert_eq!(row(array), format!("{place}{takes}this array"), "{array}");
    }
    assert_eq!(row("\"0,0,1,1\""), format!("{place}{takes}the text `0,0,1,1`"));
    let far = "x = 1000000000 of point 2 is out of range: 0 to 1";
    assert_eq!(row("[[0, 0], [1e9, 1]]"), format!("{place}`hatching.curve`: {far}"));
    let many = format!("[{}]", "[0, 0], ".repeat(100_000));
    assert_eq!(row(&many), format!("{place}`hatching.curve`: a curve has 2 to 8 points, not 100000"));
    assert_eq!(kept, before);
}

#[test]
fn other_kinds_refuse_curves() {
    let mut style = Style::default();
    let mut message = |key: &str| {
        param::set(&mut style.params(), key, &Value::parse("0,0,0.5,0.2,1,1")).unwrap_err().to_string()
    };
    for key in ["gooch.alpha", "gooch.cool", "sketch.pass1.matrix", "technique", "toon.image", "toon.bands"] {
        let said = message(key);
        assert!(said.starts_with(&format!("`{key}` takes ")) && said.ends_with(", not 3 points"), "{said}");
    }
    assert_eq!(style, Style::default());
}

#[test]
fn curves_matter_under_conditions_as_all_do() {
    let (mut is_on, mut curve) = (false, Curve::default());
    let mut keys = |value: bool| -> Vec<String> {
        is_on = value;
        let mut list = Params::default();
        list.switch("on", "On", "Whether.", &mut is_on);
        list.when("on", "true", |list| list.curve("curve", "Tone curve", "How.", &mut curve));
        let mut params = list.finish();
        param::retain_relevant(&mut params);
        params.iter().map(|p| p.key.clone()).collect()
    };
    assert_eq!(keys(true), ["on", "curve"]);
    assert_eq!(keys(false), ["on"]);
}
