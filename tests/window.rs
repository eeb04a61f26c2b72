//! The real program in a real window on a virtual display: opens a model, turns it with the mouse, takes screenshots.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A process that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

const PATIENCE: Duration = Duration::from_secs(40);

fn install(program: &str, package: &str, error: &std::io::Error) -> String {
    format!("{program} could not be started ({error}); install it: `apt install {package}`")
}

/// A virtual display with a number that nobody else has.
fn display() -> (Running, String) {
    let first = 200 + std::process::id() % 300;
    for number in first..first + 50 {
        if Path::new(&format!("/tmp/.X11-unix/X{number}")).exists()
            || Path::new(&format!("/tmp/.X{number}-lock")).exists()
        {
            continue;
        }
        let name = format!(":{number}");
        let child = Command::new("Xvfb")
            .args([&name, "-screen", "0", "900x700x24", "-nolisten", "tcp", "-noreset"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|e| panic!("{}", install("Xvfb", "xvfb", &e)));
        let mut server = Running(child);
        let began = Instant::now();
        while began.elapsed() < PATIENCE {
            // The socket's file is there a moment before anybody answers.
            if UnixStream::connect(format!("/tmp/.X11-unix/X{number}")).is_ok() {
                return (server, name);
            }
            // Somebody else took the number in the meantime.
            if server.0.try_wait().unwrap().is_some() {
                break;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }
    panic!("Xvfb found no free display");
}

struct Mouse<'a>(&'a str);

impl Mouse<'_> {
    fn run(&self, arguments: &str) -> String {
        let output = Command::new("xdotool")
            .args(arguments.split_whitespace())
            .env("DISPLAY", self.0)
            .output()
            .unwrap_or_else(|e| panic!("{}", install("xdotool", "xdotool", &e)));
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }
}

fn until<T>(what: &str, log: &Path, mut look: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        let said = || std::fs::read_to_string(log).unwrap_or_default();
        assert!(began.elapsed() < PATIENCE, "waited in vain until {what}; the program said:\n{}", said());
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// A tetrahedron, so that no file is needed.
const MODEL: &str = "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn a_model_is_opened_turned_and_photographed() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("tetrahedron.obj");
    std::fs::write(&model, MODEL).unwrap();
    let (pictures, log) = (folder.path().join("pictures"), folder.path().join("log"));

    let (_server, display) = display();
    let mouse = Mouse(&display);
    let errors = std::fs::File::create(&log).unwrap();
    let _program = Running(
        Command::new(env!("CARGO_BIN_EXE_hachure"))
            .arg(&model)
            .env("DISPLAY", &display)
            .env_remove("WAYLAND_DISPLAY")
            .env("HOME", folder.path())
            .env("XDG_DATA_HOME", folder.path().join("data"))
            .env("HACHURE_PICTURES", &pictures)
            .stdout(Stdio::null())
            .stderr(errors)
            .spawn()
            .unwrap(),
    );
    // The title names the model once it is loaded.
    let window = until("the window shows the model", &log, || {
        let found = mouse.run("search --name tetrahedron");
        found.lines().next().filter(|l| !l.is_empty()).map(str::to_owned)
    });
    mouse.run(&format!("windowfocus {window}"));

    let shoot = |number: u32| -> PathBuf {
        let path = pictures.join(format!("tetrahedron_{number}.png"));
        mouse.run("key F12");
        until("the screenshot is there", &log, || path.exists().then_some(()));
        path
    };
    let before = image::open(shoot(1)).unwrap().to_rgb8();
    mouse.run("mousemove 330 350 mousedown 1");
    for _ in 0..8 {
        mouse.run("mousemove_relative 25 5");
    }
    mouse.run("mouseup 1");
    // Screenshots wait for what was asked before them, but the mouse may still be on its way.
    let mut number = 1;
    let after = until("the drag turned the model", &log, || {
        number += 1;
        let picture = image::open(shoot(number)).unwrap().to_rgb8();
        (picture != before).then_some(picture)
    });
    assert_eq!(before.dimensions(), after.dimensions());
    let inked = |picture: &image::RgbImage| {
        let paper = *picture.get_pixel(0, 0);
        picture.pixels().filter(|p| **p != paper).count()
    };
    let least = before.len() / 3 / 50;
    assert!(inked(&before) > least && inked(&after) > least, "the model is in both pictures");
}
