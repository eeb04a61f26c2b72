//! Hostile OBJ, STL and PLY files: each gives the error or the warning that it should, quickly, and never a panic.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::path::Path;
use std::time::{Duration, Instant};

use hachure::import::{ImportError, ImportOptions, Progress, load};
use hachure::scene::Scene;

fn attempt(folder: &Path, name: &str, data: &[u8]) -> Result<Scene, ImportError> {
    let path = folder.join(name);
    std::fs::write(&path, data).unwrap();
    let started = Instant::now();
    let result = load(&path, &ImportOptions::default(), &Progress::default());
    assert!(started.elapsed() < Duration::from_secs(10), "{name} took {:?}", started.elapsed());
    if let Ok(scene) = &result {
        check(scene);
    }
    result
}

/// What importers guarantee.
fn check(scene: &Scene) {
    assert!(scene.triangle_count() > 0);
    for node in &scene.nodes {
        assert!(node.mesh.is_none_or(|m| m < scene.meshes.len()));
    }
    for mesh in &scene.meshes {
        let n = mesh.positions.len();
        assert!(mesh.positions.iter().chain(&mesh.normals).all(|p| p.is_finite()));
        assert!(mesh.indices.iter().all(|&v| (v as usize) < n));
        assert!(
            mesh.normals.len() == n
                && [0, n].contains(&mesh.uvs.len())
                && [0, n].contains(&mesh.colors.len())
        );
        let mut next = 0;
        for part in &mesh.submeshes {
            assert_eq!(part.first_index, next);
            assert!(part.material < scene.materials.len());
            next += part.index_count;
        }
        assert_eq!(next as usize, mesh.indices.len());
    }
}

/// What a file should lead to, with a part of what is said.
#[derive(Debug, Clone, Copy)]
enum Expect {
    Malformed(&'static str),
    Empty(&'static str),
    Warning(&'static str),
    Clean,
}
use Expect::{Clean, Empty, Malformed, Warning};

/// What is wrong with the outcome, if anything.
fn complaint(name: &str, data: &[u8], expected: Expect) -> Option<String> {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("model");
    std::fs::create_dir(&inside).unwrap();
    std::fs::write(folder.path().join("secret.mtl"), "newmtl red\nKd 1 0 0\n").unwrap();
    let result = attempt(&inside, name, data);
    let said = match &result {
        Err(error) => error.to_string(),
        Ok(scene) => scene.warnings.iter().map(|w| format!("{w}\n")).collect(),
    };
    let fits = match (&result, expected) {
        (Err(ImportError::Malformed { .. }), Malformed(part))
        | (Err(ImportError::Empty { .. }), Empty(part))
        | (Ok(_), Warning(part)) => said.contains(part),
        (Ok(_), Clean) => said.is_empty(),
        _ => false,
    };
    let outcome = if result.is_ok() { "loaded" } else { "failed" };
    let start = String::from_utf8_lossy(&data[..data.len().min(300)]);
    (!fits).then(|| format!("{start}\n→ {outcome}: {said}\n  instead of {expected:?}\n\n"))
}

fn check_table(name: &str, table: &[(Vec<u8>, Expect)]) {
    let complaints: String =
        table.iter().filter_map(|(data, expected)| complaint(name, data, *expected)).collect();
    assert!(complaints.is_empty(), "{complaints}");
}

#[test]
fn hostile_obj_files() {
    let good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let with = |more: &str| format!("{good}{more}").into_bytes();
    let many_corners = || {
        let mut text: String = (0..30_000_u64)
            .map(|i| format!("v {} {} 0\n", i * 7919_u64 % 30_011, i * 104_729_u64 % 29_989))
            .collect();
        text += "f";
        (1..=30_000).for_each(|i| text += &format!(" {i}"));
        text.into_bytes()
    };
    let table: &[(Vec<u8>, Expect)] = &[
        (vec![], Malformed("empty")),
        (b"\n\n".to_vec(), Empty("no faces")),
        (b"\x00\xff\xfe garbage".to_vec(), Malformed("neither vertices nor faces")),
        (b"hello\nworld\n".to_vec(), Malformed("neither vertices nor faces")),
        (b"v 0 0 0\nv 1 0 0\n".to_vec(), Empty("no faces")),
        (b"v 0 0 0\nv 1 0 0\np 1 2\nl 1 2\n".to_vec(), Empty("only points and lines")),
        (b"v 0 0 0\nf 1 1 1\n".to_vec(), Empty("without area")),
        (b"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n".to_vec(), Empty("degenerate")),
        (b"f 1 2 3\n".to_vec(), Empty("out of range")),
        (b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(), Empty("NaN")),
        (b"v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(), Empty("infinite")),
        (with(""), Clean),
        (with("f 1 2"), Warning("line 5: a face has fewer")),
        (
            with("f 1 2 4\nf 0 1 2\nf -9 1 2\nf 4294967295 1 2\nf 99999999999999 1 2\n"),
            Warning("left out 5 triangles"),
        ),
        (with("f 1/1 2/7 3/-9\nf 3 2 1\n"), Warning("references to texture")),
        (with("f 1//1 2//1 3//1\n"), Warning("references to normals")),
        (with("f a b c\n"), Warning("line 5: cannot be understood")),
        (with("f 1 2 99999999999999999999999\n"), Warning("line 5: cannot be understood")),
        (with("v 1 x 2\nf 1 2 4\n"), Warning("line 5: cannot be understood")),
        (with("v inf 0 0\nf 1 2 4\n"), Warning("infinite")),
        (with("f 3 1 2\n"), Warning("duplicate")),
        (with("vn 0 0 0\nf 1//1 3//1 2//1\n"), Warning("duplicate")),
        (
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 0\nf 1//1 2//1 3//1\n".to_vec(),
            Warning("normals without a direction"),
        ),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\no \xff/\0\nf 1 2 3".to_vec(), Clean),
        (with("mtllib missing.mtl\n"), Warning("cannot read")),
        (with("mtllib ../secret.mtl\n"), Warning("outside the model's folder")),
        (with("mtllib x/../../secret.mtl\n"), Warning("outside the model's folder")),
        (with("mtllib /etc/passwd\n"), Warning("outside the model's folder")),
        (with("mtllib C:\\windows\\x.mtl\n"), Warning("outside the model's folder")),
        (with("mtllib a.mtl b.mtl\n"), Warning("a.mtl")),
        (with("mtllib\n"), Warning("no materials")),
        (with("mtllib .\n"), Warning("directory")),
        (with("mtllib bad.obj\n"), Clean),
        (with("curv 0 1\n"), Warning("free-form")),
        (with("\\"), Clean),
        (many_corners(), Warning("degenerate")),
        (with(&"g a\nf 1 2 3\ng b\nf 3 2 1\n".repeat(20_000)), Warning("duplicate")),
        (vec![b'f'; 1 << 20], Malformed("neither")),
        (b"v ".repeat(1 << 19), Empty("no faces")),
        ([b"v 0 0 0\nf".to_vec(), b" 1".repeat(1 << 20)].concat(), Empty("degenerate")),
    ];
    check_table("bad.obj", table);
}

#[test]
fn an_obj_reaches_no_image_outside_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let mtl = "newmtl a\nmap_Kd ../../x.png\nnewmtl b\nmap_Kd /etc/hostname\nnewmtl c\nmap_Kd m.mtl\nnewmtl d\nmap_Kd gone.png\n";
    std::fs::write(folder.path().join("m.mtl"), mtl).unwrap();
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nusemtl c\nusemtl d\n";
    let scene = attempt(folder.path(), "a.obj", obj.as_bytes()).unwrap();
    let said: Vec<String> = scene.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 4, "{said:?}");
    assert!(said[0].contains("outside") && said[1].contains("outside") && said[2].contains("gone.png"));
    assert!(said[3].contains("neither a PNG nor a JPEG"));
    assert!(scene.textures.is_empty());
}

fn stl(declared: u32, triangles: &[[f32; 9]]) -> Vec<u8> {
    let mut out = vec![b' '; 80];
    out.extend(declared.to_le_bytes());
    for triangle in triangles {
        out.extend([0; 12]);
        out.extend(triangle.iter().flat_map(|c| c.to_le_bytes()));
        out.extend([0; 2]);
    }
    out
}

#[test]
fn hostile_stl_files() {
    let good = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let mut nan = good;
    nan[4] = f32::NAN;
    let flat = [1.0; 9];
    let facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let text = |more: &str| format!("solid x\n{facet}{more}").into_bytes();
    let table: &[(Vec<u8>, Expect)] = &[
        (vec![], Malformed("empty")),
        (vec![7; 10], Malformed("neither a binary STL")),
        (vec![0; 83], Malformed("neither a binary STL")),
        (stl(0, &[]), Empty("no triangle")),
        (stl(u32::MAX, &[]), Malformed("ends before the first of its 4294967295 triangles")),
        (stl(u32::MAX, &[good]), Warning("declares 4294967295 triangles and holds 1")),
        (stl(2, &[good, good])[..150].to_vec(), Warning("cut off")),
        (stl(1, &[good, nan]), Warning("has room for 2; 1 are shown")),
        (stl(2, &[good, nan]), Warning("left out 1 triangle with a NaN")),
        (stl(2, &[nan, flat]), Empty("none of its 2 triangles")),
        (stl(3, &[good, good, flat]), Warning("duplicate")),
        (stl(1, &[good]), Clean),
        (b"solid x\nendsolid x\n".to_vec(), Empty("no triangle")),
        (b"solid".to_vec(), Empty("no triangle")),
        (text(""), Clean),
        (text("facet\nouter loop\nvertex 0 0 0\nvertex 1"), Warning("cut off")),
        (text("facet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"), Warning("fewer than three")),
        (
            text("facet\nouter loop\nvertex a b c\nvertex 1 0 0\nvertex 0 0 1\nendloop\n"),
            Warning("no number"),
        ),
        (text("facet\nvertex 1e99 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\n"), Warning("infinite")),
        (text("facet\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\nendloop\n"), Warning("degenerate")),
        (b"solid \xff\xfe\n".iter().chain(facet.as_bytes()).copied().collect(), Clean),
        (text(&"vertex 1 2 3 ".repeat(100_000)), Warning("cut off")),
    ];
    check_table("bad.stl", table);
}

#[test]
fn hostile_ply_files() {
    let file = |format: &str, vertices: &str, faces: &str, list: &str, body: &[u8]| {
        let header = format!(
            "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
             element face {faces}\nproperty list {list} vertex_indices\nend_header\n"
        );
        [header.as_bytes(), body].concat()
    };
    let ascii = |vertices: &str, faces: &str, body: &str| {
        file("ascii", vertices, faces, "uchar int", body.as_bytes())
    };
    let binary = |vertices: &str, faces: &str, list: &str, bytes: &[u8]| {
        let body: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
            .iter()
            .flat_map(|c| c.to_le_bytes())
            .chain(bytes.iter().copied())
            .collect();
        file("binary_little_endian", vertices, faces, list, &body)
    };
    let face = [3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0];
    let table: &[(Vec<u8>, Expect)] = &[
        (vec![], Malformed("empty")),
        (b"ply".to_vec(), Malformed("end_header")),
        (b"plyx\n".to_vec(), Malformed("first line")),
        (b"ply\nend_header\n".to_vec(), Malformed("`format`")),
        (b"ply\nformat ascii 1.0\nend_header\n".to_vec(), Empty("no triangle")),
        (b"ply\nformat braille 1.0\nend_header\n".to_vec(), Malformed("line 2: unknown format `braille`")),
        (b"ply\nformat ascii 1.0\nproperty float x\nend_header\n".to_vec(), Malformed("line 3")),
        (b"ply\nformat ascii 1.0\nelement vertex -1\nend_header\n".to_vec(), Malformed("`-1` is no number")),
        (
            b"ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n".to_vec(),
            Malformed("line 4"),
        ),
        (
            b"ply\nformat ascii 1.0\nelement vertex 9\nproperty quad x\nend_header\n".to_vec(),
            Malformed("line 4"),
        ),
        (
            b"ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nend_header\n0 0 0".to_vec(),
            Malformed("no `y`"),
        ),
        (b"ply\nformat ascii 1.0\nelement vertex 99999999999999\nend_header\n".to_vec(), Malformed("no `x`")),
        (b"ply\nformat ascii 1.0\nelement x 99999999999999\nend_header\n".to_vec(), Empty("no triangle")),
        (b"ply\n".iter().chain(&b"comment x\n".repeat(200_000)).copied().collect(), Malformed("end_header")),
        (ascii("3", "1", "0 0 0 1 0 0 0 1 0 3 0 1 2"), Clean),
        (ascii("3", "0", "0 0 0 1 0 0 0 1 0"), Empty("only points")),
        (ascii("18446744073709551615", "1", "0 0 0"), Malformed("declares 18446744073709551615 vertices")),
        (ascii("99999999999999999999999", "1", "0 0 0"), Malformed("no number of entries")),
        (ascii("3", "1", "0 0 0 1 0 0 0 1"), Malformed("room for 2 at most")),
        (ascii("3", "1", "0 0 0 1 x 0 0 1 0"), Malformed("after 1 of 3")),
        (
            ascii("3", "18446744073709551615", "0 0 0 1 0 0 0 1 0 3 0 1 2"),
            Warning("after 1 of 18446744073709551615"),
        ),
        (ascii("3", "1", "0 0 0 1 0 0 0 1 0 999999999 0 1 2"), Empty("no triangle")),
        (ascii("3", "1", "0 0 0 1 0 0 0 1 0 -1 0 1 2"), Empty("no triangle")),
        (ascii("3", "2", "0 0 0 1 0 0 0 1 0 3 0 1 2 3 0 1 3"), Warning("out of range")),
        (ascii("3", "2", "0 0 0 1 0 0 0 1 0 3 0 1 2 3 0 1 -1"), Warning("out of range")),
        (ascii("3", "2", "0 0 0 1 0 0 0 1 0 3 0 1 2 3 0 1 0.5"), Warning("out of range")),
        (ascii("3", "2", "0 0 0 1 0 0 0 1 0 3 0 1 2 5 0 1 2 7 1"), Warning("left out")),
        (ascii("3", "2", "0 0 0 1 0 0 0 1 0 3 0 1 2 2 0 1"), Warning("fewer than three corners")),
        (ascii("4", "2", "0 0 0 1 0 0 0 1 0 nan 0 0 3 0 1 2 3 0 1 3"), Warning("NaN")),
        (ascii("3", "1", "5 5 5 5 5 5 5 5 5 3 0 1 2"), Empty("degenerate")),
        (ascii("3", "1", "0 0 0 1 0 0 0 1 0 3 0 1 \u{fffd}"), Empty("no triangle")),
        (binary("3", "1", "uchar int", &face), Clean),
        (binary("3", "2", "uchar int", &face), Warning("after 1 of 2")),
        (binary("4", "1", "uchar int", &face), Empty("no triangle")),
        (binary("4000000000", "1", "uchar int", &face), Malformed("room for 4 at most")),
        (binary("3", "1", "int int", &[255, 255, 255, 127]), Empty("no triangle")),
        (binary("3", "1", "int int", &[255; 4]), Empty("no triangle")),
        (binary("3", "1", "uint int", &[255; 4]), Empty("no triangle")),
        (binary("3", "1000000", "uchar int", &vec![0; 1_000_000]), Empty("no triangle")),
    ];
    check_table("bad.ply", table);
}

/// A small deterministic generator (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n.max(1) as u64) as usize
    }

    fn mutate(&mut self, seed: &[u8]) -> Vec<u8> {
        let mut data = seed.to_vec();
        for _ in 0..1 + self.below(6) {
            let at = self.below(data.len());
            let length = self.below(40).min(data.len() - at);
            match self.below(6) {
                0 => data.truncate(at),
                1 => drop(data.drain(at..at + length)),
                2 => drop(data.splice(at..at, data[at..at + length].to_vec())),
                3 => {
                    let words: [&[u8]; 8] = [
                        b"-1",
                        b" nan ",
                        b"99999999999",
                        b"1e39",
                        b"\n",
                        b"\xff\xff\xff\xff",
                        b"/",
                        b"list ",
                    ];
                    let word = words[self.below(words.len())];
                    drop(data.splice(at..at, word.iter().copied()));
                }
                _ if data.is_empty() => {}
                4 => data[at] = self.below(256) as u8,
                _ => data[at] ^= 1 << self.below(8),
            }
        }
        data
    }
}

#[test]
fn mutated_files_never_make_the_importers_panic() {
    let obj = "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.2 0.5 3\nvt 0 0\nvt 1 1\nvn 0 0 1\no a\ng b\n\
        usemtl m\nf 1/1/1 2/2/1 3//1 4//1\nf 1 -4 -1\ng c\nf 1/1 2/1 5/2\ns 1\nl 1 2\nf 5 4 3 2 1\n";
    let text_stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
        facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid a\n";
    let good = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n\
             property list uchar int vertex_indices\nelement tristrips 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let ascii_ply = header("ascii")
        + "0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n0 0 1 9 9 9\n3 0 1 2\n4 0 1 2 3\n5 0 1 2 -1 3\n";
    let binary_ply = |format: &str, big: bool| {
        let mut data = header(format).into_bytes();
        let number = |bytes: [u8; 4]| bytes.into_iter().collect::<Vec<u8>>();
        let float = |v: f32| number(if big { v.to_be_bytes() } else { v.to_le_bytes() });
        let index = |v: i32| number(if big { v.to_be_bytes() } else { v.to_le_bytes() });
        for p in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            p.into_iter().for_each(|c| data.extend(float(c)));
            data.extend([1, 2, 3]);
        }
        for list in [&[0, 1, 2][..], &[0, 1, 2, 3], &[0, 1, 2, -1, 3]] {
            data.push(list.len() as u8);
            list.iter().for_each(|&v| data.extend(index(v)));
        }
        data
    };
    let seeds: [(&str, Vec<u8>); 6] = [
        ("fuzz.obj", obj.into()),
        ("fuzz.stl", text_stl.into()),
        ("fuzz.stl", stl(3, &[good, good.map(|c| c * 2.0), good.map(|c| -c)])),
        ("fuzz.ply", ascii_ply.into()),
        ("fuzz.ply", binary_ply("binary_little_endian", false)),
        ("fuzz.ply", binary_ply("binary_big_endian", true)),
    ];
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.mtl"), "newmtl m\nKd 1 0 0\nmap_Kd -s 1 2 x.png\n").unwrap();
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for (name, seed) in seeds {
        let sound = attempt(folder.path(), name, &seed);
        assert!(sound.is_ok(), "{name}: {}", sound.unwrap_err());
        for _ in 0..300 {
            let data = random.mutate(&seed);
            if let Err(error) = attempt(folder.path(), name, &data) {
                // The loader turns panics into errors that say so.
                assert!(
                    !error.to_string().contains("please report"),
                    "{error}\n{}",
                    String::from_utf8_lossy(&data)
                );
            }
        }
    }
}

#[test]
fn mutated_material_files_never_make_the_importers_panic() {
    let folder = tempfile::tempdir().unwrap();
    let mtl = b"newmtl m\nKd 1 0 0\nd 0.5\nTr 0.1\nmap_Kd -s 1 2 3 -o 1 -clamp on -bm 2 x.png\nmap_d x.png\nnorm -bm 1 n.png\n";
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    let mut random = Random(42);
    for _ in 0..300 {
        std::fs::write(folder.path().join("a.mtl"), random.mutate(mtl)).unwrap();
        attempt(folder.path(), "a.obj", obj.as_bytes()).unwrap();
    }
}
