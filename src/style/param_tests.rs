//! Of the declared list as a whole.

use super::param::{self, Condition};
use super::*;
use crate::geometry::EdgeClass;

/// For every parameter, in order, its key and a value that is not its default.
fn other_values() -> Vec<(String, Value)> {
    let mut style = Style::default();
    let other = |p: &Param<'_>| match &p.slot {
        Slot::Bool(b) => Value::Bool(!b.get()),
        Slot::Number { value, hard, .. } if value.get() == *hard.start() => {
            Value::parse(&hard.end().to_string())
        }
        Slot::Number { hard, .. } => Value::parse(&hard.start().to_string()),
        Slot::Integer { value, range } if **value == *range.start() => Value::Number((*range.end()).into()),
        Slot::Integer { range, .. } => Value::Number((*range.start()).into()),
        Slot::Color(_) => Value::Text("#123456".to_owned()),
        Slot::File(_) => Value::Text("images/ramp 2.png".to_owned()),
        Slot::Matrix { .. } => Value::Matrix(Matrix([[0.1, -1.5], [2.0, 0.25]])),
        Slot::Curve(_) => Value::Curve([[0.0, 0.1], [0.4, 0.2], [1.0, 0.9]].map(Point::from).to_vec()),
        Slot::Choice(c) => Value::Text(c.names().iter().find(|n| **n != c.name()).unwrap().to_string()),
    };
    style.params().iter().map(|p| (p.key.clone(), other(p))).collect()
}

fn set(style: &mut Style, key: &str, value: &str) -> Result<(), String> {
    param::set(&mut style.params(), key, &Value::parse(value)).map(drop).map_err(|e| e.to_string())
}

fn own(style: &Style, key: &str) -> Value {
    style.clone().params().iter().find(|p| p.key == key).unwrap().own()
}

fn to_toml(style: &Style) -> String {
    diff_to_toml(&mut style.clone().params(), &mut Style::default().params()).to_string()
}

fn from_toml(text: &str) -> Style {
    let mut style = Style::default();
    set_from_toml(&mut style.params(), text, "test").unwrap();
    style
}

#[test]
fn keys_are_unique_and_defaults_lie_in_their_ranges() {
    let mut style = Style::default();
    let params = style.params();
    for (i, param) in params.iter().enumerate() {
        assert!(params.iter().skip(i + 1).all(|p| p.key != param.key), "{} twice", param.key);
        assert!(!param.help.is_empty(), "{} has no help", param.key);
        if let Slot::Number { value, soft, hard } = &param.slot {
            assert!(soft.contains(&value.get()), "{}", param.key);
            assert!(hard.contains(soft.start()) && hard.contains(soft.end()), "{}", param.key);
        }
        if let Slot::Integer { value, range } = &param.slot {
            assert!(range.contains(value), "{}", param.key);
        }
    }
}

/// Keys of version 0.1 as they stood in its files, and what they are called now.
const FORMER_KEYS: [(&str, &str); 33] = [
    ("gooch.own_hue", "gooch.object_hue"),
    ("gooch.aside", "gooch.side_light"),
    ("toon.border", "toon.smoothing"),
    ("toon.tint", "toon.object_color"),
    ("halftone.own_tone", "halftone.object_tone"),
    ("matcap.own_color", "matcap.object_color"),
    ("hatching.stroke.thin", "hatching.stroke.min_width"),
    ("hatching.stroke.thick", "hatching.stroke.max_width"),
    ("hatching.stroke.spread", "hatching.stroke.tone_by_count"),
    ("hatching.stroke.chance", "hatching.stroke.randomness"),
    ("hatching.stroke.pointed", "hatching.stroke.pointedness"),
    ("hatching.stroke.inserted", "hatching.stroke.late_insertion"),
    ("hatching.own.begin", "hatching.own.taper_in"),
    ("hatching.own.end", "hatching.own.taper_out"),
    ("hatching.layers.count", "hatching.cross_hatching.directions"),
    ("hatching.layers.second", "hatching.cross_hatching.second"),
    ("hatching.layers.third", "hatching.cross_hatching.third"),
    ("hatching.layers.shadows_cross", "hatching.cross_hatching.shadows_cross"),
    ("hatching.tone.own_color", "hatching.tone.object_tone"),
    ("hatching.tone.white", "hatching.tone.lightest"),
    ("blueprint.opacity", "blueprint.fill_opacity"),
    ("blueprint.highlight", "blueprint.designated_color"),
    ("blueprint.layers", "blueprint.max_layers"),
    ("blueprint.least", "blueprint.min_coverage"),
    ("sketch.fill.density", "sketch.fill.opacity"),
    ("sketch.fill.surface_color", "sketch.fill.object_color"),
    ("edges.shortest", "edges.min_length"),
    ("edges.surface_color", "edges.object_color"),
    ("edges.profile.strength", "edges.profile.opacity"),
    ("edges.hidden.most", "edges.hidden.max_layers"),
    ("edges.hidden.least", "edges.hidden.min_coverage"),
    ("edges.hidden.strength", "edges.hidden.opacity"),
    ("edges.hidden.narrow", "edges.hidden.relative_width"),
];

#[test]
fn keys_of_earlier_versions_set_what_they_are_called_now_and_say_so() {
    let passes = (1..=8).flat_map(|n| {
        [("density", "opacity"), ("width", "relative_width")]
            .map(|names| [names.0, names.1].map(|name| format!("sketch.pass{n}.{name}")))
    });
    let classes = EdgeClass::ALL.map(<&str>::from).into_iter().chain(["inner"]);
    let classes = classes.map(|class| ["strength", "opacity"].map(|name| format!("edges.{class}.{name}")));
    let listed = FORMER_KEYS.map(|(former, key)| [former, key].map(str::to_owned));
    let all: Vec<_> = listed.into_iter().chain(passes).chain(classes).collect();
    let values = other_values();
    for [former, key] in &all {
        let value = &values.iter().find(|(k, _)| k == key).unwrap().1;
        let (mut old, mut new) = (Style::default(), Style::default());
        assert_eq!(param::set(&mut new.params(), key, value).unwrap(), None);
        let renamed = param::set(&mut old.params(), former, value).unwrap().unwrap();
        assert_eq!((&renamed.former, &renamed.now), (former, key));
        assert_eq!(old, new, "{former}");

        let mut read = Style::default();
        let written = if let Value::Text(text) = value { format!("{text:?}") } else { value.to_string() };
        let renamed =
            set_from_toml(&mut read.params(), &format!("{former} = {written}"), "old.toml").unwrap();
        assert_eq!((read, renamed.len()), (new.clone(), 1), "{former}");
        assert!(to_toml(&new).contains(key.rsplit('.').next().unwrap()) && !to_toml(&new).contains(former));
    }
    let mut style = Style::default();
    let declared = style.params().iter().filter(|p| p.former.is_some()).count();
    assert_eq!(declared, all.len(), "every former key is among them");
}

#[test]
fn values_of_earlier_versions_are_what_they_are_called_now_and_say_so() {
    let mut declared = 0;
    for param in Style::default().params() {
        let Some((former, now)) = param.former_value else { continue };
        declared += 1;
        let key = &param.key;
        let Slot::Choice(choice) = &param.slot else { panic!("{key} is no choice") };
        assert!(choice.names().contains(&now) && !choice.names().contains(&former), "{key}");
        let (mut old, mut new) = (Style::default(), Style::default());
        set(&mut new, key, now).unwrap();
        let renamed = param::set(&mut old.params(), key, &Value::from(former)).unwrap().unwrap();
        assert_eq!((renamed.former, renamed.now), (format!("{key}={former}"), format!("{key}={now}")));
        assert_eq!(old, new, "{key}");
        let mut read = Style::default();
        let renamed = set_from_toml(&mut read.params(), &format!("{key} = {former:?}"), "old.toml").unwrap();
        assert_eq!((read, renamed.len()), (new, 1), "{key}");
    }
    assert_eq!(declared, 2);
}

#[test]
fn conditions_and_sources_are_parameters_of_the_list() {
    let mut style = Style::default();
    let params = style.params();
    let find = |key: &str| params.iter().find(|p| p.key == key).unwrap();
    for param in &params {
        for Condition { key, values } in &param.conditions {
            assert!(!values.is_empty());
            let has = |value: &&str| match &find(key).slot {
                Slot::Choice(c) => c.names().contains(value),
                Slot::Bool(_) => ["true", "false"].contains(value),
                Slot::Integer { range, .. } => value.parse().is_ok_and(|n: u32| range.contains(&n)),
                _ => false,
            };
            assert!(values.iter().all(has), "{key}={values:?}");
        }
        if let Some(other) = param.slot.inherits() {
            assert_eq!(std::mem::discriminant(&param.slot), std::mem::discriminant(&find(other).slot));
        }
    }
    let inheriting = params.iter().filter(|p| p.slot.inherits().is_some()).count();
    assert_eq!(inheriting, 5 * EdgeClass::ALL.len() + sketch::MAX_PASSES);
}

#[test]
fn every_parameter_is_set_read_written_and_reset() {
    for (key, value) in other_values() {
        let mut style = Style::default();
        let default = own(&style, &key);
        param::set(&mut style.params(), &key, &value).unwrap();
        assert_eq!(own(&style, &key), value, "{key}");
        assert_eq!(Value::parse(&value.to_string()), value, "{key}: the command line reads what is printed");
        assert_ne!(style, Style::default(), "{key}");
        assert_eq!(from_toml(&to_toml(&style)), style, "{key}");
        param::set(&mut style.params(), &key, &default).unwrap();
        assert_eq!(style, Style::default(), "{key}");
        assert_eq!(to_toml(&style), "", "{key}");
    }
}

#[test]
fn all_parameters_at_once_survive_a_round_trip_through_text() {
    let mut style = Style::default();
    for (key, value) in other_values() {
        param::set(&mut style.params(), &key, &value).unwrap();
    }
    assert_eq!(from_toml(&to_toml(&style)), style);
}

#[test]
fn what_is_inherited_follows_until_it_is_set() {
    let mut style = Style::default();
    set(&mut style, "edges.profile.width", "4").unwrap();
    assert_eq!(own(&style, "edges.silhouette.width"), Value::Inherit);
    assert_eq!(style.edges.line(EdgeClass::Silhouette).width, 4.0);
    assert_eq!(to_toml(&style), "[edges.profile]\nwidth = 4.0\n", "what is inherited is not written");

    set(&mut style, "edges.silhouette.width", "4").unwrap();
    set(&mut style, "edges.profile.width", "5").unwrap();
    assert_eq!(style.edges.line(EdgeClass::Silhouette).width, 4.0, "set to the same value it is its own");
    assert_eq!(style.edges.line(EdgeClass::Border).width, 5.0);
    assert_eq!(from_toml(&to_toml(&style)), style);

    set(&mut style, "edges.silhouette.width", "inherit").unwrap();
    assert_eq!(style.edges.line(EdgeClass::Silhouette).width, 5.0);
}

#[test]
fn a_class_that_is_off_by_itself_can_inherit_too() {
    let mut style = from_toml("[edges.material]\nshow = \"inherit\"\n");
    assert!(style.edges.line(EdgeClass::Material).show);
    assert_eq!(to_toml(&style), "[edges.material]\nshow = \"inherit\"\n");
    set(&mut style, "edges.inner.show", "false").unwrap();
    assert!(EdgeClass::ALL.iter().all(|class| style.edges.line(*class).show == class.is_profile()));
}

#[test]
fn mistakes_say_what_would_be_right() {
    let mut style = Style::default();
    let mut message = |key: &str, value: &str| set(&mut style, key, value).unwrap_err();
    assert_eq!(
        message("edges.silhoutte.width", "2"),
        "unknown parameter `edges.silhoutte.width`; did you mean `edges.silhouette.width`?"
    );
    assert_eq!(
        message("edges.silhouette.width", "100"),
        "`edges.silhouette.width` = 100 is out of range: 0.25 to 64"
    );
    assert_eq!(
        message("edges.ridge.width", "thick"),
        "`edges.ridge.width` takes a number from 0.25 to 64, or inherit, not the text `thick`"
    );
    assert_eq!(
        message("edges.inner.width", "inherit"),
        "`edges.inner.width` takes a number from 0.25 to 64, not `inherit`, for it inherits from nothing"
    );
    assert_eq!(
        message("toon.bands", "2.5"),
        "`toon.bands` takes a whole number from 2 to 8, not the number 2.5"
    );
    assert_eq!(message("toon.bands", "9"), "`toon.bands` = 9 is out of range: 2 to 8");
    assert_eq!(
        message("toon.bands", "nan"),
        "`toon.bands` takes a whole number from 2 to 8, not the number NaN"
    );
    assert_eq!(
        message("toon.image", "3"),
        "`toon.image` takes the path of a PNG or JPEG image, or an empty text, not the number 3"
    );
    assert_eq!(
        message("edges.mode", "exakt"),
        "`edges.mode` takes one of exact, image_space, not the text `exakt`"
    );
    assert_eq!(style, Style::default());
}

#[test]
fn only_what_matters_is_retained() {
    let keys = |style: &Style| -> Vec<String> {
        let mut style = style.clone();
        let mut params = style.params();
        param::retain_relevant(&mut params);
        params.iter().map(|p| p.key.clone()).collect()
    };
    let mut style = Style::default();
    let exact = keys(&style);
    set(&mut style, "edges.mode", "image_space").unwrap();
    let paper = keys(&style);
    let has = |keys: &[String], key: &str| keys.iter().any(|k| k == key);
    for key in ["edges.profile.width", "edges.ridge.threshold", "edges.dash.gap", "edges.alignment"] {
        assert!(has(&exact, key) && !has(&paper, key), "{key}");
    }
    for key in ["edges.operator", "edges.profile.gain", "edges.inner.threshold"] {
        assert!(!has(&exact, key) && has(&paper, key), "{key}");
    }
    assert!(!has(&paper, "edges.profile.gain_c1"), "of the other operator");
    assert!(has(&paper, "edges.inner.color") && has(&exact, "gooch.cool") && !has(&exact, "plain.ambient"));
}

#[test]
fn images_are_needed_while_their_choices_hold() {
    let mut style = Style::default();
    set(&mut style, "toon.image", "ramp.png").unwrap();
    assert_eq!(style.images(), []);
    set(&mut style, "toon.ramp", "image").unwrap();
    assert_eq!(style.images(), [], "no toon is drawn");
    set(&mut style, "technique", "toon").unwrap();
    assert_eq!(style.images(), [("toon.image".to_owned(), Some("ramp.png".into()))]);
    set(&mut style, "toon.image", "").unwrap();
    assert_eq!(style.images(), [("toon.image".to_owned(), None)]);
}

#[test]
fn whole_numbers_are_written_as_such() {
    let mut style = Style::default();
    set(&mut style, "toon.bands", "5").unwrap();
    assert_eq!(to_toml(&style), "[toon]\nbands = 5\n");
    assert_eq!(from_toml("[toon]\nbands = 5.0\n"), style);
}

#[test]
fn what_no_parameter_accepts_is_clamped_before_it_is_drawn() {
    for wild in [f32::NAN, f32::INFINITY, -1e30] {
        let mut style = Style::default();
        for param in style.params() {
            match param.slot {
                Slot::Number { mut value, .. } => value.set(wild),
                Slot::Integer { value, .. } => *value = wild as u32,
                Slot::Matrix { value, .. } => *value = Matrix([[wild; 2]; 2]),
                _ => {}
            }
        }
        let mut clamped = style.clamped();
        for mut param in clamped.params() {
            let value = param.value();
            assert!(param.set(&value).is_ok(), "{} = {value}, set to {wild}", param.key);
        }
        assert_eq!(Style::default().clamped(), Style::default());
    }
}

#[test]
fn labels_fit_into_the_panel() {
    let mut style = Style::default();
    for param in style.params().iter().filter(|p| !p.head) {
        assert!(param.label.chars().count() <= 15, "{}: {}", param.key, param.label);
    }
}
