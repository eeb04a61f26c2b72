//! The command line: exit codes, messages, precedence, what it prints.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn hachure(args: &[&str]) -> Output {
    hachure_in(Path::new(env!("CARGO_MANIFEST_DIR")), args)
}

fn hachure_in(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hachure"))
        .current_dir(folder)
        .args(args)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap()
}

fn crank() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/models/crank.glb").to_string_lossy().into_owned()
}

fn render(folder: &Path, name: &str, file: &str, args: &[&str]) -> (Output, PathBuf) {
    let output = folder.join(name);
    let mut all = vec!["render", file, "--resolution", "96,96", "--output", output.to_str().unwrap()];
    if !args.iter().any(|arg| arg.starts_with("--samples")) {
        all.extend(["--samples", "1"]);
    }
    all.extend(args);
    (hachure(&all), output)
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[test]
fn mistakes_end_with_the_right_code_and_a_message_that_helps() {
    let folder = tempfile::tempdir().unwrap();
    let crank = crank();
    let cases: &[(&[&str], i32, &str)] = &[
        (&["--style", "goch"], 1, "did you mean `gooch`?"),
        (&["--set", "gooch.alpa=1"], 1, "did you mean `gooch.alpha`?"),
        (&["--set", "gooch.alpha=3"], 1, "out of range: 0 to 1"),
        (&["--set", "gooch.alpha"], 2, "write a parameter"),
        (&["--object-style", "rodd=gooch"], 1, "no object matches `rodd`"),
        (&["--hide", "["], 1, "is no pattern"),
        (&["--mask", "statue*"], 1, "no object matches `statue*`"),
        (&["--set", "blueprint.fraction=1.5"], 1, "out of range: 0 to 1"),
        (&["--resolution", "0,5"], 2, "is no size"),
        (&["--resolution", "60000,60000"], 1, "allows at most"),
        (&["--camera-position", "1,2"], 2, "is no vector"),
        (&["--camera-view-height", "2"], 2, "--camera-orthographic"),
        (&["--camera-view-angle", "nan"], 2, "angle from 1 to 170"),
        (&["--camera-azimuth-angle", "inf"], 2, "is no number"),
        (&["--up", "W"], 2, "is no axis"),
        (&["--samples", "0"], 2, "`0` is no number of samples from 1 to 1024"),
        (&["--samples", "2000"], 2, "from 1 to 1024"),
        (&["--samples", "many"], 2, "`many` is no number of samples"),
        (&["--samples=-4"], 2, "is no number of samples"),
        (&["--background", "red"], 2, "is no color"),
        (&["--look-from", "side"], 2, "use one of front, back"),
        (&["--scale", "1:50"], 2, "--camera-orthographic"),
        (&["--camera-orthographic", "--scale", "50"], 2, "such as 1:50"),
        (&["--camera-orthographic", "--scale", "1:0"], 2, "such as 1:50"),
        (&["--unit", "parsec"], 2, "use one of mm, cm"),
        (&["--dpi", "0"], 2, "number above 0"),
    ];
    for (args, code, message) in cases {
        // A later --resolution would clash with the one that `render` gives.
        let (result, output) = if args[0] == "--resolution" {
            let output = folder.path().join("x.png");
            (hachure(&["render", &crank, args[0], args[1], "-o", output.to_str().unwrap()]), output)
        } else {
            render(folder.path(), "x.png", &crank, args)
        };
        let text = String::from_utf8_lossy(&result.stderr);
        assert_eq!(result.status.code(), Some(*code), "{args:?}: {text}");
        assert!(text.contains(message), "{args:?}: {text}");
        assert!(!output.exists(), "{args:?} left a file behind");
    }
    let (jpg, _) = render(folder.path(), "x.jpg", &crank, &[]);
    assert!(String::from_utf8_lossy(&jpg.stderr).contains("ends in .png"));
    let missing = hachure(&["info", "/nonexistent.glb"]);
    assert_eq!(missing.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&missing.stderr).contains("cannot read /nonexistent.glb"));
    let window = hachure(&[]);
    assert_eq!(window.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&window.stderr).contains("no display"));
    assert_eq!(hachure(&["render"]).status.code(), Some(2));
}

#[test]
fn without_a_driver_the_message_names_the_package() {
    let folder = tempfile::tempdir().unwrap();
    let result = Command::new(env!("CARGO_BIN_EXE_hachure"))
        .args(["render", &crank(), "-o"])
        .arg(folder.path().join("x.png"))
        .env("WGPU_BACKEND", "dx12")
        .output()
        .unwrap();
    assert_eq!(result.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&result.stderr).contains("mesa-vulkan-drivers"));
}

#[test]
fn later_ways_to_set_a_parameter_win_over_earlier_ones() {
    let folder = tempfile::tempdir().unwrap();
    let document = folder.path().join("a.hachure");
    std::fs::write(
        &document,
        format!("models = ['{}']\n[style]\ntechnique = \"unlit\"\n[nodes.\"/crank/flywheel\".style]\ntechnique = \"plain\"\n", crank()),
    )
    .unwrap();
    let document = document.to_str().unwrap();
    let picture = |name: &str, args: &[&str]| {
        let (result, path) = render(folder.path(), name, document, args);
        assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
        std::fs::read(path).unwrap()
    };
    let own = picture("own.png", &[]);
    let styled = picture("styled.png", &["--style", "statue"]);
    let object = picture("object.png", &["--style", "statue", "--object-style", "flywheel=lines"]);
    let set = picture(
        "set.png",
        &["--style", "statue", "--object-style", "flywheel=lines", "--set", "technique=unlit"],
    );
    let one = picture(
        "one.png",
        &["--style", "statue", "--object-style", "flywheel=lines", "--set", "flywheel:technique=unlit"],
    );
    let all = [&own, &styled, &object, &set, &one];
    for (i, a) in all.iter().enumerate() {
        assert!(all.iter().skip(i + 1).all(|b| a != b), "picture {i} equals a later one");
    }
    assert_eq!(own, picture("again.png", &[]), "the same call gives the same picture");
}

#[test]
fn keys_of_earlier_versions_are_read_with_a_warning_that_names_the_new_one() {
    let folder = tempfile::tempdir().unwrap();
    let style = folder.path().join("old.toml");
    std::fs::write(&style, "technique = \"toon\"\n[toon]\ntint = 0\n").unwrap();
    let document = folder.path().join("old.hachure");
    let models = serde_json::json!([crank()]);
    let text = format!(
        "models = {models}\n[style.gooch]\naside = 0.5\n[nodes.\"/crank\".style.gooch]\nown_hue = 1\n"
    );
    std::fs::write(&document, text).unwrap();
    let render = |file: &str, args: &[&str]| {
        let (output, path) = render(folder.path(), "out.png", file, args);
        let (said, code) = (String::from_utf8(output.stderr).unwrap(), output.status.code());
        assert_eq!(code, Some(0), "{said}");
        (said, std::fs::read(path).unwrap())
    };

    let style = style.to_str().unwrap();
    let args = ["--style", style, "--set", "edges.profile.strength=0.4"];
    let (said, old) = render(&crank(), &args);
    assert!(said.contains("old.toml: `toon.tint` is now called `toon.object_color`"), "{said}");
    assert!(said.contains("--set: `edges.profile.strength` is now called `edges.profile.opacity`"), "{said}");
    let new_style = folder.path().join("new.toml");
    std::fs::write(&new_style, "technique = \"toon\"\n[toon]\nobject_color = 0\n").unwrap();
    let new_style = new_style.to_str().unwrap();
    let (said, new) = render(&crank(), &["--style", new_style, "--set", "edges.profile.opacity=0.4"]);
    assert!(!said.contains("is now called"), "{said}");
    assert!(old == new);
    assert!(render(&crank(), &["--style", new_style]).1 != new, "the parameter matters");

    let (said, _) = render(document.to_str().unwrap(), &[]);
    assert!(said.contains("old.hachure, style: `gooch.aside` is now called `gooch.side_light`"), "{said}");
    assert!(said.contains("old.hachure, /crank: `gooch.own_hue` is now called `gooch.object_hue`"), "{said}");
}

#[test]
fn the_page_of_parameters_is_what_the_program_prints() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/parameters.md");
    let page = std::fs::read_to_string(file).unwrap_or_default();
    let printed = stdout(&hachure(&["styles", "--markdown"]));
    let differs = printed.lines().zip(page.lines()).find(|(new, old)| new != old);
    assert!(
        page == printed,
        "docs/parameters.md is not up to date; run `make docs`. First change: {differs:?}"
    );
}

#[test]
fn info_styles_and_bench_print_what_they_promise() {
    let info: serde_json::Value =
        serde_json::from_str(&stdout(&hachure(&["info", &crank(), "--json"]))).unwrap();
    assert!(info["triangles"].as_u64().unwrap() > 20_000);
    assert_eq!(info["up"], "+Y");
    assert!(info["nodes"].as_array().unwrap().iter().any(|n| n["path"] == "/crank/flywheel"));
    assert!(stdout(&hachure(&["info", &crank()])).contains("triangles"));

    let styles: serde_json::Value = serde_json::from_str(&stdout(&hachure(&["styles", "--json"]))).unwrap();
    let names: Vec<_> =
        styles["presets"].as_array().unwrap().iter().map(|p| p["id"].as_str().unwrap()).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/styles");
    let mut all: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    all.sort();
    assert_eq!(names, all);
    let parameters = styles["parameters"].as_array().unwrap();
    let parameter = |key: &str| parameters.iter().find(|p| p["key"] == key).unwrap();
    let threshold = parameter("edges.profile.threshold");
    assert!(threshold["range"]["hard"].is_array() && !threshold["help"].as_str().unwrap().is_empty());
    assert_eq!(threshold["when"]["edges.mode"][0], "image_space");
    let width = parameter("edges.silhouette.width");
    assert_eq!((&width["default"], &width["unit"]), (&"inherit".into(), &"px".into()));
    assert_eq!(width["inherits"], "edges.profile.width");
    let text = stdout(&hachure(&["styles"]));
    assert!(text.contains("edges.profile.threshold") && text.contains("(edges.mode=image_space"));
    assert!(text.contains("2.5 px, a number from 0.25 to 64\n"), "{text}");
    assert!(text.contains("as edges.profile.width, a number from 0.25 to 64, or inherit"), "{text}");

    let bench = hachure(&["bench", &crank(), "--frames", "1", "--resolution", "64,64", "--json"]);
    let bench: serde_json::Value = serde_json::from_str(&stdout(&bench)).unwrap();
    assert_eq!(bench["styles"][0]["style"], "plain");
    let stage = |style: &str, stage: &str| {
        let found = bench["styles"].as_array().unwrap().iter().find(|s| s["style"] == style).unwrap();
        found["stages_ms"][stage].as_f64().unwrap_or_default()
    };
    assert!(stage("gooch + edges, diagonal", "operators") > 0.0);
    assert!(stage("gooch + edges, 2 px", "segments") > 0.0);
    assert!(stage("gooch + edges, 32 px", "lines") > 0.0);
    assert_eq!(stage("plain", "lines"), 0.0);
}

#[test]
fn bench_says_what_it_cannot_measure() {
    let nowhere = tempfile::tempdir().unwrap();
    let bench = hachure_in(nowhere.path(), &["bench"]);
    assert!(!bench.status.success());
    assert!(String::from_utf8_lossy(&bench.stderr).contains("name a model"));
    let bench = hachure(&["bench", &crank(), "--resolution", "64,64", "--only", "no such row"]);
    assert!(!bench.status.success());
    assert!(String::from_utf8_lossy(&bench.stderr).contains("`no such row`"));
}

#[test]
fn camera_flags_mean_what_they_say() {
    let folder = tempfile::tempdir().unwrap();
    let picture = |name: &str, args: &[&str]| {
        let (result, path) = render(folder.path(), name, &crank(), args);
        assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
        image::open(path).unwrap().into_rgba8()
    };
    // The same view by angles and by position: straight from the right.
    let info: serde_json::Value =
        serde_json::from_str(&stdout(&hachure(&["info", &crank(), "--json"]))).unwrap();
    let corner = |which: &str, i: usize| info["bounds"][which][i].as_f64().unwrap();
    let middle: Vec<f64> = (0..3).map(|i| (corner("min", i) + corner("max", i)) * 0.5).collect();
    let focal = format!("{},{},{}", middle[0], middle[1], middle[2]);
    let position = format!("{},{},{}", middle[0] + 5.0, middle[1], middle[2]);
    let orthographic =
        ["--camera-orthographic", "--camera-view-height", "0.5", "--camera-focal-point", &focal];
    let by_position = [&orthographic[..], &["--camera-position", &position]].concat();
    let by_angle = [&orthographic[..], &["--camera-azimuth-angle", "90"]].concat();
    let (a, b) = (picture("a.png", &by_position), picture("b.png", &by_angle));
    let differing = a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count();
    assert!(differing < 92, "{differing} of 9216 pixels differ");
    let lying = picture("up.png", &[&by_position[..], &["--camera-view-up", "0,0,1"]].concat());
    assert!(lying != picture("c.png", &by_position));
    // Nothing of a transparent picture is paper, and a wider angle shows a smaller model.
    let share = |args: &[&str]| {
        let image = picture("d.png", &[args, &["--no-background"]].concat());
        image.pixels().filter(|p| p.0[3] > 0).count()
    };
    let from = ["--camera-position", "0,0,2", "--camera-focal-point", "0,0,0"];
    let narrow = share(&[&from[..], &["--camera-view-angle", "20"]].concat());
    let wide = share(&[&from[..], &["--camera-view-angle", "60"]].concat());
    assert!(narrow > 4 * wide && wide > 0, "{narrow} {wide}");
}

#[test]
fn a_scale_is_true_on_paper_and_seen_from_straight_above() {
    let folder = tempfile::tempdir().unwrap();
    // 2 units wide and 1 deep, on a post that must not be seen past it.
    let model = folder.path().join("table.obj");
    std::fs::write(
        &model,
        "v -1 0 -.5\nv -1 0 .5\nv 1 0 .5\nv 1 0 -.5\nv -1 -9 -.5\nv 1 -9 -.5\nf 1 2 3 4\nf 1 4 6 5\n",
    )
    .unwrap();
    let model = model.to_str().unwrap();
    let plan = ["--look-from", "top", "--camera-orthographic", "--style", "plain", "--no-background"];
    let scaled = [&plan[..], &["--scale", "1:10", "--dpi", "50.8"]].concat();
    let (without_unit, _) = render(folder.path(), "x.png", model, &scaled);
    assert!(String::from_utf8_lossy(&without_unit.stderr).contains("add --unit mm"));

    // A centimeter is 20 px at 50.8 pixels per inch.
    for (unit, factor) in [("cm", 0.1), ("mm", 0.01)] {
        let scale = format!("1:{}", 10.0 * factor);
        let args = [&plan[..], &["--scale", &scale, "--dpi", "50.8", "--unit", unit]].concat();
        let (result, output) = render(folder.path(), "plan.png", model, &args);
        assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
        let image = image::open(&output).unwrap().into_rgba8();
        let drawn: Vec<_> = image.enumerate_pixels().filter(|(.., p)| p.0[3] > 127).collect();
        let side = |of: fn(u32, u32) -> u32| {
            let at = || drawn.iter().map(|(x, y, _)| of(*x, *y));
            at().max().unwrap() + 1 - at().min().unwrap()
        };
        assert_eq!((side(|x, _| x), side(|_, y| y)), (40, 20), "{unit}");
        let reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&output).unwrap()));
        let dims = reader.read_info().unwrap().info().pixel_dims.unwrap();
        assert_eq!((dims.xppu, dims.yppu, dims.unit), (2000, 2000, png::Unit::Meter));
    }

    // Whoever asks for no scale gets no resolution written.
    let (_, output) = render(folder.path(), "free.png", model, &plan);
    let reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&output).unwrap()));
    assert!(reader.read_info().unwrap().info().pixel_dims.is_none());
}

#[test]
fn a_scale_bar_is_shown_in_parallel_views_only() {
    let folder = tempfile::tempdir().unwrap();
    let crank = crank();
    let drawn = |name: &str, args: &[&str]| {
        let (result, output) = render(folder.path(), name, &crank, args);
        assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
        std::fs::read(output).unwrap()
    };
    let bar = ["--set", "view.scale_bar=true"];
    let parallel = ["--camera-orthographic"];
    assert_eq!(drawn("a.png", &bar), drawn("b.png", &[]));
    assert_ne!(drawn("c.png", &[&parallel[..], &bar].concat()), drawn("d.png", &parallel));
}

#[test]
fn more_samples_are_smoother() {
    let folder = tempfile::tempdir().unwrap();
    let colors = |name: &str, args: &[&str]| {
        let flat = ["--style", "plain", "--no-background", "--json"];
        let (result, path) = render(folder.path(), name, &crank(), &[&flat, args].concat());
        assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
        let said: serde_json::Value = serde_json::from_str(&stdout(&result)).unwrap();
        let image = image::open(path).unwrap().into_rgba8();
        let alphas: std::collections::BTreeSet<u8> = image.pixels().map(|p| p.0[3]).collect();
        (alphas.len(), said["samples"].as_u64().unwrap())
    };
    let (one, four, many) =
        (colors("1.png", &[]), colors("4.png", &["--samples", "4"]), colors("64.png", &["--samples", "64"]));
    assert_eq!((one.1, four.1, many.1), (1, 4, 64));
    let unset = hachure(&[
        "render",
        &crank(),
        "--resolution",
        "32,32",
        "--json",
        "-o",
        folder.path().join("a.png").to_str().unwrap(),
    ]);
    let said: serde_json::Value = serde_json::from_str(&stdout(&unset)).unwrap();
    assert_eq!(said["samples"], 16, "pictures are smooth unless told otherwise");
    assert!(one.0 == 2 && (5..=6).contains(&four.0) && many.0 > 50, "{one:?} {four:?} {many:?}");
}

#[test]
fn the_crease_angle_smooths_files_without_normals() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("roof.obj");
    // Two faces that meet at 53°.
    std::fs::write(
        &path,
        "v -1 0 0\nv 0 0.5 0\nv 1 0 0\nv -1 0 2\nv 0 0.5 2\nv 1 0 2\nf 1 4 5 2\nf 2 5 6 3\n",
    )
    .unwrap();
    let picture = |angle: &str| {
        let setting = format!("view.crease_angle={angle}");
        let (result, picture) = render(
            folder.path(),
            "roof.png",
            path.to_str().unwrap(),
            &["--style", "plain", "--set", &setting],
        );
        assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
        std::fs::read(picture).unwrap()
    };
    assert_eq!(picture("10"), picture("30"));
    assert!(picture("30") != picture("80"));
}

#[test]
fn how_many_layers_blueprints_have_and_what_that_uncovered_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    let crank = crank();
    let blueprints = |args: &[&str]| -> (serde_json::Value, serde_json::Value) {
        let (result, _) = render(folder.path(), "x.png", &crank, &[args, &["--json"]].concat());
        let printed: serde_json::Value = serde_json::from_str(&stdout(&result)).unwrap();
        (printed["blueprints"].clone(), printed["warnings"].clone())
    };
    assert_eq!(blueprints(&["--style", "gooch"]).0, serde_json::json!([]));
    let designated = ["--style", "blueprint", "--mask", "rod*", "--set"];
    let masked = |setting: &str| {
        blueprints(&[&designated[..], &[setting, "--set", "blueprint.min_coverage=0"]].concat())
    };
    let (all, warnings) = masked("blueprint.fraction=1");
    let mask = &all[0]["mask"];
    assert_eq!(warnings, serde_json::json!([]));
    assert_eq!(all[0]["ended_by"], "mask uncovered");
    assert!(mask["pixels"].as_u64() > Some(50) && mask["uncovered"] == mask["pixels"], "{all}");
    assert_eq!(mask["reached"], 1.0);
    let layers = all[0]["layers"].as_u64().unwrap() as usize;
    assert!(layers > 1);
    for counts in [&all[0]["pixels"], &mask["uncovered_by_layer"]] {
        assert_eq!(counts.as_array().unwrap().len(), layers);
    }
    let (fewer, _) = masked("blueprint.fraction=0");
    assert_eq!(fewer[0]["layers"], 1);
    let (result, _) = render(
        folder.path(),
        "x.png",
        &crank,
        &[&designated[..], &["blueprint.fraction=1", "--set", "blueprint.to=1"]].concat(),
    );
    let text = String::from_utf8_lossy(&result.stderr);
    assert!(
        result.status.success() && text.contains("of what is designated is uncovered after 1 layer"),
        "{text}"
    );
}

/// A name that is no Unicode, as old archives leave them.
#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_are_printed_as_well_as_they_can_be() {
    use std::os::unix::ffi::OsStrExt as _;
    let folder = tempfile::tempdir().unwrap();
    let name = |ending: &[u8]| {
        folder.path().join(std::ffi::OsStr::from_bytes(&[b"k\xf6rper".as_slice(), ending].concat()))
    };
    let (model, picture) = (name(b".glb"), name(b".png"));
    std::fs::copy(crank(), &model).unwrap();
    let run = |arguments: &[&std::ffi::OsStr]| {
        Command::new(env!("CARGO_BIN_EXE_hachure")).args(arguments).output().unwrap()
    };
    let (flag, model, picture) = ("--json".as_ref(), model.as_os_str(), picture.as_os_str());
    let info = run(&["info".as_ref(), model, flag]);
    assert!(info.status.success(), "{info:?}");
    assert!(stdout(&info).contains("k\u{fffd}rper.glb"));
    let rendered = run(&[
        "render".as_ref(),
        model,
        flag,
        "-o".as_ref(),
        picture,
        "--resolution".as_ref(),
        "64,64".as_ref(),
    ]);
    assert!(rendered.status.success(), "{rendered:?}");
    assert!(stdout(&rendered).contains("k\u{fffd}rper.png"));
    assert!(Path::new(picture).exists());
    for arguments in [
        &["styles".as_ref(), flag, model] as &[&std::ffi::OsStr],
        &["render".as_ref(), model, "-o".as_ref(), picture, "--style".as_ref(), model],
        &["info".as_ref(), picture, flag],
    ] {
        let failed = run(arguments);
        let said = String::from_utf8_lossy(&failed.stderr).into_owned();
        assert!(matches!(failed.status.code(), Some(1 | 2)), "{failed:?}");
        assert!(!said.contains("panicked") && !said.is_empty(), "{said}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_without_a_session_says_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_hachure"))
        .args(["render", &crank(), "--resolution", "64,64", "-o"])
        .arg(folder.path().join("crank.png"))
        .env_remove("XDG_RUNTIME_DIR")
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap();
    assert!(output.status.success());
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}
