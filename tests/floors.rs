//! Who imports whom: modules and floors only look down, and no circle of files is large. And the files that comments name are
//! there.
//!
//! Reads the paths that begin with `crate`, `super` or `self` in every file of `src/`, in `use` trees and elsewhere, and
//! takes each for the file in which it ends. Comments, strings and what is only compiled for tests are left out.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Modules, top to bottom, as in ARCHITECTURE.md. A module imports only from itself and from modules below it.
const MODULES: [&[&str]; 11] = [
    &["main", "cli"],
    &["app"],
    &["export"],
    &["render"],
    &["import"],
    &["gpu"],
    &["hatching"],
    &["document"],
    &["scene"],
    &["style"],
    &["geometry"],
];

/// What a module does not know although it lies below.
const STRANGERS: [(&str, &str); 2] = [("gpu", "style"), ("gpu", "document")];

/// Floors inside of `render/`, top to bottom. A floor imports only from itself and from floors below it. What is named
/// nowhere here is on the lowest floor. Empty: the floors are not looked at.
const RENDER_FLOORS: &[&str] = &["renderer", "frame", "views", "drawing", "effects", "passes", "base"];

/// Circles of more files than this are none that a person can keep in mind.
const LARGEST_CIRCLE: usize = 3;

/// A module by its path: `["render", "passes", "edge_map"]`. The crate's root is `[]`, the program's `["main"]`.
type Module = Vec<String>;

/// For each module the modules that it imports from.
type Imports = BTreeMap<Module, BTreeSet<Module>>;

fn name(module: &Module) -> String {
    if module.is_empty() { "lib".to_owned() } else { module.join("/") }
}

/// The source without comments, and with nothing in its strings and character literals.
fn bare(source: &str) -> String {
    let chars: Vec<char> = source.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let mut out = String::with_capacity(source.len());
    let mut i = 0;
    while i < chars.len() {
        let is_word_before = i > 0 && (at(i - 1).is_alphanumeric() || at(i - 1) == '_');
        match (at(i), at(i + 1)) {
            ('/', '/') => {
                while i < chars.len() && at(i) != '\n' {
                    i += 1;
                }
            }
            ('/', '*') => {
                let mut depth = 0;
                loop {
                    match (at(i), at(i + 1)) {
                        ('/', '*') => (depth, i) = (depth + 1, i + 2),
                        ('*', '/') => (depth, i) = (depth - 1, i + 2),
                        _ => i += 1,
                    }
                    if depth == 0 || i >= chars.len() {
                        break;
                    }
                }
            }
            ('r', '"' | '#') if !is_word_before && is_raw_string(&chars[i + 1..]) => {
                let hashes = chars[i + 1..].iter().take_while(|c| **c == '#').count();
                let end: Vec<char> = std::iter::once('"').chain(std::iter::repeat_n('#', hashes)).collect();
                i += hashes + 2;
                while i < chars.len() && !chars[i..].starts_with(&end) {
                    i += 1;
                }
                i += end.len();
                out.push_str("\"\"");
            }
            ('"', _) => {
                i += 1;
                while i < chars.len() && at(i) != '"' {
                    i += if at(i) == '\\' { 2 } else { 1 };
                }
                i += 1;
                out.push_str("\"\"");
            }
            // A lifetime has no quote at its end.
            ('\'', '\\') => {
                i += 3;
                while i < chars.len() && at(i) != '\'' {
                    i += 1;
                }
                i += 1;
                out.push_str("' '");
            }
            ('\'', _) if at(i + 2) == '\'' => {
                i += 3;
                out.push_str("' '");
            }
            (c, _) => {
                out.push(c);
                i += 1;
            }
        }
    }
    out
}

fn is_raw_string(rest: &[char]) -> bool {
    rest.iter().find(|c| **c != '#') == Some(&'"')
}

/// A piece of Rust: a word, `::`, or a single sign.
fn tokens(source: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut chars = source.chars().peekable();
    while let Some(c) = chars.next() {
        if c.is_alphanumeric() || c == '_' {
            let mut word = c.to_string();
            while let Some(c) = chars.next_if(|c| c.is_alphanumeric() || *c == '_') {
                word.push(c);
            }
            tokens.push(word);
        } else if c == ':' && chars.next_if_eq(&':').is_some() {
            tokens.push("::".to_owned());
        } else if !c.is_whitespace() {
            tokens.push(c.to_string());
        }
    }
    tokens
}

/// The place after the item that begins here: after its `;` or its block.
fn after_item(tokens: &[String], start: usize) -> usize {
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate().skip(start) {
        match token.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => {
                depth -= 1;
                if token == "}" && depth == 0 {
                    return i + 1;
                }
            }
            ";" | "," if depth == 0 => return i + 1,
            _ => {}
        }
        if depth < 0 {
            return i;
        }
    }
    tokens.len()
}

/// What a file says about others.
#[derive(Debug, Default, PartialEq)]
struct Read {
    /// Paths from `crate`, `super` or `self`, each with the names of the inline modules around it.
    paths: Vec<(Vec<String>, Vec<String>)>,
    /// Modules in files of their own that exist only for tests.
    test_modules: Vec<String>,
}

fn read(source: &str) -> Read {
    let tokens = tokens(&bare(source));
    let mut found = Read::default();
    // Inline modules around the present place, with the depth of braces in each.
    let mut inline: Vec<(String, usize)> = Vec::new();
    let (mut depth, mut i) = (0, 0);
    let is = |i: usize, what: &str| tokens.get(i).is_some_and(|t| t == what);
    let starts = |i: usize, what: &[&str]| what.iter().enumerate().all(|(k, t)| is(i + k, t));
    while i < tokens.len() {
        if starts(i, &["#", "[", "cfg", "(", "test", ")", "]"]) {
            let mut item = i + 7;
            // Further attributes belong to the same item.
            while starts(item, &["#", "["]) {
                item = after_bracket(&tokens, item + 1);
            }
            let end = after_item(&tokens, item);
            let module = tokens[item..end].iter().position(|t| t == "mod").map(|m| item + m + 1);
            if let Some(module) = module.filter(|m| is(m + 1, ";")) {
                found.test_modules.push(tokens[module].clone());
            }
            i = end;
            continue;
        }
        match tokens[i].as_str() {
            "mod" if is(i + 2, "{") => {
                inline.push((tokens[i + 1].clone(), depth));
                depth += 1;
                i += 3;
            }
            "{" => (depth, i) = (depth + 1, i + 1),
            "}" => {
                depth -= 1;
                inline.pop_if(|(_, outside)| *outside == depth);
                i += 1;
            }
            // Who may see something imports nothing: `pub(in crate::app)`.
            "in" if i > 1 && starts(i - 2, &["pub", "("]) => i = skip_path(&tokens, i + 1),
            "crate" | "super" | "self" if is(i + 1, "::") && !(i > 0 && is(i - 1, "::")) => {
                let around: Vec<String> = inline.iter().map(|(name, _)| name.clone()).collect();
                let mut paths = Vec::new();
                i = tree(&tokens, i, &[], &mut paths);
                found.paths.extend(paths.into_iter().map(|path| (around.clone(), path)));
            }
            _ => i += 1,
        }
    }
    found
}

fn skip_path(tokens: &[String], start: usize) -> usize {
    tokens.iter().skip(start).position(|t| t == ")").map_or(tokens.len(), |n| start + n)
}

fn after_bracket(tokens: &[String], start: usize) -> usize {
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate().skip(start) {
        match token.as_str() {
            "[" => depth += 1,
            "]" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return i + 1;
        }
    }
    tokens.len()
}

/// Reads a path or a tree of paths; returns the place after it.
fn tree(tokens: &[String], start: usize, prefix: &[String], out: &mut Vec<Vec<String>>) -> usize {
    let mut path = prefix.to_vec();
    let mut i = start;
    loop {
        match tokens.get(i).map(String::as_str) {
            Some("{") => {
                i += 1;
                while tokens.get(i).is_some_and(|t| t != "}") {
                    if tokens[i] == "," {
                        i += 1;
                    } else {
                        i = tree(tokens, i, &path, out);
                    }
                }
                return i + 1;
            }
            Some("self") if !path.is_empty() => i += 1,
            Some(word) if word.starts_with(|c: char| c.is_alphanumeric() || c == '_') => {
                path.push(word.to_owned());
                i += 1;
            }
            // `*` imports from the module before it.
            Some("*") => i += 1,
            _ => {}
        }
        match tokens.get(i).map(String::as_str) {
            // Not of a path: `crate::f::<T>()`.
            Some("::") if tokens.get(i + 1).is_some_and(|t| t == "<") => break,
            Some("::") => i += 1,
            // Another name for it changes nothing.
            Some("as") => {
                i += 2;
                break;
            }
            _ => break,
        }
    }
    out.push(path);
    // Whatever came, something was read.
    i.max(start + 1)
}

/// The file in which a path ends; `None`: outside of the crate.
fn target(module: &Module, inline: &[String], path: &[String], files: &BTreeSet<Module>) -> Option<Module> {
    let mut here: Vec<String> = match path.first()?.as_str() {
        "crate" => Vec::new(),
        _ => module.iter().chain(inline).cloned().collect(),
    };
    for word in path {
        match word.as_str() {
            "crate" | "self" => {}
            "super" => drop(here.pop()),
            _ => here.push(word.clone()),
        }
    }
    // What follows the module is an item in it.
    while !files.contains(&here) {
        here.pop()?;
    }
    Some(here)
}

fn module_of(path: &Path) -> Module {
    let mut parts: Module = path.iter().map(|p| p.to_string_lossy().into_owned()).collect();
    let last = parts.pop().unwrap();
    match last.strip_suffix(".rs").unwrap() {
        "mod" | "lib" => {}
        other => parts.push(other.to_owned()),
    }
    parts
}

fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

/// Who imports from whom in some sources, those apart that exist only for tests.
fn imports(sources: &BTreeMap<Module, String>) -> Imports {
    let read: BTreeMap<&Module, Read> = sources.iter().map(|(module, text)| (module, read(text))).collect();
    let tests: BTreeSet<Module> = read
        .iter()
        .flat_map(|(module, read)| {
            read.test_modules.iter().map(|t| [module.as_slice(), std::slice::from_ref(t)].concat())
        })
        .collect();
    let is_test = |module: &Module| (0..=module.len()).any(|n| tests.contains(&module[..n]));
    let files: BTreeSet<Module> = sources.keys().filter(|m| !is_test(m)).cloned().collect();
    let of = |module: &Module| -> BTreeSet<Module> {
        let paths = read[module].paths.iter();
        let targets = paths.filter_map(|(inline, path)| target(module, inline, path, &files));
        // The root only says which modules there are.
        targets.filter(|t| t != module && !t.is_empty()).collect()
    };
    files.iter().map(|module| (module.clone(), of(module))).collect()
}

fn crate_imports() -> Imports {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    sources(&root, &mut paths);
    let text = |path: &PathBuf| {
        (module_of(path.strip_prefix(&root).unwrap()), std::fs::read_to_string(path).unwrap())
    };
    imports(&paths.iter().map(text).collect())
}

/// Imports from a higher floor, in words; `floor` is a module's floor, counted from the top.
fn upward(imports: &Imports, floor: impl Fn(&Module) -> Option<usize>) -> Vec<String> {
    let mut wrong = Vec::new();
    for (module, targets) in imports {
        for target in targets {
            if let (Some(from), Some(to)) = (floor(module), floor(target))
                && to < from
            {
                wrong.push(format!("{} imports from {}, which is above it", name(module), name(target)));
            }
        }
    }
    wrong
}

/// All groups of modules each of which imports, by way of others, from all others (Tarjan).
fn circles(imports: &Imports) -> Vec<Vec<Module>> {
    #[derive(Default)]
    struct Search<'a> {
        number: BTreeMap<&'a Module, usize>,
        low: BTreeMap<&'a Module, usize>,
        stack: Vec<&'a Module>,
        found: Vec<Vec<Module>>,
    }
    fn visit<'a>(module: &'a Module, imports: &'a Imports, search: &mut Search<'a>) {
        let own = search.number.len();
        search.number.insert(module, own);
        search.low.insert(module, own);
        search.stack.push(module);
        for target in imports.get(module).into_iter().flatten() {
            if !search.number.contains_key(target) {
                visit(target, imports, search);
                let low = search.low[module].min(search.low[target]);
                search.low.insert(module, low);
            } else if search.stack.contains(&target) {
                let low = search.low[module].min(search.number[target]);
                search.low.insert(module, low);
            }
        }
        if search.low[module] == own {
            let start = search.stack.iter().position(|m| *m == module).unwrap();
            let mut circle: Vec<Module> = search.stack.drain(start..).cloned().collect();
            circle.sort();
            if circle.len() > 1 {
                search.found.push(circle);
            }
        }
    }
    let mut search = Search::default();
    for module in imports.keys() {
        if !search.number.contains_key(module) {
            visit(module, imports, &mut search);
        }
    }
    search.found
}

fn height_of(module: &Module) -> Option<usize> {
    let first = module.first()?;
    MODULES.iter().position(|modules| modules.contains(&first.as_str()))
}

#[test]
fn modules_import_only_from_modules_below() {
    let imports = crate_imports();
    assert!(imports.len() > 150, "the sources were not found");
    let homeless: Vec<_> =
        imports.keys().filter(|m| !m.is_empty() && height_of(m).is_none()).map(name).collect();
    assert!(homeless.is_empty(), "in no module: {homeless:?}");
    let mut wrong = upward(&imports, height_of);
    for (module, targets) in &imports {
        for target in targets {
            let (from, to) = (module.first(), target.first());
            if STRANGERS.iter().any(|(a, b)| from.is_some_and(|f| f == a) && to.is_some_and(|t| t == b)) {
                wrong.push(format!(
                    "{} imports from {}, which it is not to know",
                    name(module),
                    name(target)
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}\n", wrong.join("\n"));
}

#[test]
fn floors_of_a_frame_import_only_from_floors_below() {
    let Some(lowest) = RENDER_FLOORS.len().checked_sub(1) else { return };
    let floor = |module: &Module| {
        let [first, rest @ ..] = module.as_slice() else { return None };
        let own = rest.first()?;
        (first == "render").then(|| RENDER_FLOORS.iter().position(|f| f == own).unwrap_or(lowest))
    };
    let wrong = upward(&crate_imports(), floor);
    assert!(wrong.is_empty(), "\n{}\n", wrong.join("\n"));
}

#[test]
fn no_circle_of_files_is_large() {
    let large: Vec<_> = circles(&crate_imports())
        .into_iter()
        .filter(|circle| circle.len() > LARGEST_CIRCLE)
        .map(|circle| circle.iter().map(name).collect::<Vec<_>>().join(", "))
        .collect();
    assert!(large.is_empty(), "files that import each other in a circle:\n{}\n", large.join("\n"));
}

/// Files below a folder, by their paths from the root.
fn files_below(folder: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let found = glob::glob(root.join(folder).join("**/*").to_str().unwrap()).unwrap().map(Result::unwrap);
    let files = found.filter(|path| path.is_file());
    files.map(|path| path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/")).collect()
}

/// The files that a text names.
fn named_files(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || "_./-".contains(c)));
    let words = words.map(|word| word.trim_end_matches('.'));
    words.filter(|word| {
        [".rs", ".wgsl", ".md"].iter().any(|ending| word.len() > ending.len() && word.ends_with(ending))
    })
}

#[test]
fn files_that_comments_name_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all: Vec<String> = ["src", "shaders", "tests", "docs"]
        .into_iter()
        .flat_map(files_below)
        .map(|file| format!("/{file}"))
        .collect();
    all.extend(["/README.md".to_owned(), "/ARCHITECTURE.md".to_owned()]);
    // A path may begin in any folder, but a file of that path has to be somewhere.
    let is_there = |named: &str| {
        let end = format!("/{}", named.trim_start_matches("../").trim_start_matches("./"));
        all.iter().any(|file| file.ends_with(&end))
    };
    let mut checked = 0;
    let mut missing = Vec::new();
    let mut check = |place: String, text: &str| {
        for named in named_files(text) {
            checked += 1;
            if !is_there(named) {
                missing.push(format!("{place}: {named}"));
            }
        }
    };
    for file in ["src", "shaders"].into_iter().flat_map(files_below) {
        let text = std::fs::read_to_string(root.join(&file)).unwrap();
        for (number, line) in (1..).zip(text.lines()) {
            if let Some((_, comment)) = line.split_once("//") {
                check(format!("{file}:{number}"), comment);
            }
        }
    }
    for (number, line) in (1..).zip(std::fs::read_to_string(root.join("ARCHITECTURE.md")).unwrap().lines()) {
        // What a new technique or format would be called.
        if !["/x.rs", "/x.wgsl"].iter().any(|placeholder| line.contains(placeholder)) {
            check(format!("ARCHITECTURE.md:{number}"), line);
        }
    }
    assert!(checked > 150, "{checked} found");
    assert!(missing.is_empty(), "\n{}\n", missing.join("\n"));
}

/// What a comment says is in which file: the name between backticks in `` `Name` in src/file.rs ``.
fn named_items(comment: &str) -> impl Iterator<Item = (&str, &str)> {
    let parts: Vec<&str> = comment.split("` in ").collect();
    let pairs: Vec<_> = parts.windows(2).map(|pair| (pair[0], pair[1])).collect();
    pairs.into_iter().filter_map(|(before, after)| {
        let name = before.rsplit('`').next()?;
        let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let first = after.split_whitespace().next()?;
        Some((name, named_files(first).next()?)).filter(|_| is_name)
    })
}

#[test]
fn what_comments_find_in_files_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let texts: Vec<(String, String)> = ["src", "shaders"]
        .into_iter()
        .flat_map(files_below)
        .map(|file| (format!("/{file}"), std::fs::read_to_string(root.join(&file)).unwrap()))
        .collect();
    let mut checked = 0;
    let mut missing = Vec::new();
    for (place, text) in &texts {
        for comment in text.lines().filter_map(|line| Some(line.split_once("//")?.1)) {
            for (name, file) in named_items(comment) {
                checked += 1;
                let end = format!("/{file}");
                let is_there = |(path, text): &(String, String)| {
                    path.ends_with(&end)
                        && text.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == name)
                };
                if !texts.iter().any(is_there) {
                    missing.push(format!("{place}: `{name}` in {file}"));
                }
            }
        }
    }
    assert!(checked > 60, "{checked} found");
    assert!(missing.is_empty(), "\n{}\n", missing.join("\n"));
}

mod reading {
    use super::*;

    fn paths(source: &str) -> Vec<String> {
        read(source).paths.into_iter().map(|(_, path)| path.join("::")).collect()
    }

    fn files(names: &[&str]) -> BTreeSet<Module> {
        names.iter().map(|n| n.split('/').filter(|p| !p.is_empty()).map(str::to_owned).collect()).collect()
    }

    fn sources(list: &[(&str, &str)]) -> BTreeMap<Module, String> {
        let module = |name: &str| name.split('/').filter(|p| !p.is_empty()).map(str::to_owned).collect();
        list.iter().map(|(name, text)| (module(name), (*text).to_owned())).collect()
    }

    #[test]
    fn trees_of_paths_are_taken_apart() {
        assert_eq!(
            paths("use crate::{a::{b, c::D as E, self}, f::*};\nuse super::super::g;\npub use self::h::I;"),
            ["crate::a::b", "crate::a::c::D", "crate::a", "crate::f", "super::super::g", "self::h::I"],
        );
        assert_eq!(paths("use std::fmt; use glam::crate_like;"), [""; 0]);
        assert_eq!(paths("pub(super) fn f(&self) {} pub(in crate::app) struct S;"), [""; 0]);
        assert_eq!(
            paths("fn f(x: crate::a::X<super::Y>) { self::g::<u8>(crate::h()); self.i() }"),
            ["crate::a::X", "super::Y", "self::g", "crate::h"],
        );
    }

    #[test]
    fn comments_strings_and_tests_say_nothing() {
        assert_eq!(paths("// crate::a\n/* use crate::b; /* nested */ crate::c */ //! [`super::d`]"), [""; 0]);
        assert_eq!(
            paths(r##"let s = "crate::a \" crate::b"; let r = r#"crate::c" "#; let q = '"'; crate::d!();"##),
            ["crate::d"],
        );
        assert_eq!(paths("fn f<'a>(x: &'a str) -> crate::A<'a> { '\\'' }"), ["crate::A"]);
        let found = read(
            "#[cfg(test)]\nmod tests { use super::*; fn f() { crate::a(); } }\n#[cfg(test)] use crate::b;\n\
             #[cfg(test)]\n#[path = \"x.rs\"]\nmod apart;\nuse crate::c;",
        );
        assert_eq!(found.test_modules, ["apart"]);
        assert_eq!(found.paths, [(vec![], vec!["crate".to_owned(), "c".to_owned()])]);
    }

    #[test]
    fn a_path_ends_in_the_file_that_holds_the_item() {
        let files = files(&["", "a", "a/b", "a/b/c", "d"]);
        let end = |module: &[&str], inline: &[&str], path: &str| {
            let own = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
            let path: Vec<String> = path.split("::").map(str::to_owned).collect();
            target(&own(module), &own(inline), &path, &files).map(|m| name(&m))
        };
        assert_eq!(end(&["d"], &[], "crate::a::b::C::new").as_deref(), Some("a/b"));
        assert_eq!(end(&["a", "b", "c"], &[], "super::super::X").as_deref(), Some("a"));
        assert_eq!(end(&["a", "b"], &[], "self::c").as_deref(), Some("a/b/c"));
        assert_eq!(end(&["a", "b"], &["inline"], "super::c::X").as_deref(), Some("a/b/c"));
        assert_eq!(end(&["a"], &[], "super::d").as_deref(), Some("d"));
        assert_eq!(end(&["a"], &[], "crate::Thing").as_deref(), Some("lib"));
    }

    #[test]
    fn names_of_items_are_found_before_files() {
        let found: Vec<_> =
            named_items(" Twin of `A` in `shaders/a.wgsl`; `b` in src/b.rs. `C c` in d.rs, `e` in f")
                .collect();
        assert_eq!(found, [("A", "shaders/a.wgsl"), ("b", "src/b.rs")]);
    }

    #[test]
    fn names_of_files_are_found_in_words() {
        let found: Vec<_> =
            named_files("see `passes/peel.wgsl`, (src/gpu/mod.rs:12) and b.md. No .rs, crate::a::rs")
                .collect();
        assert_eq!(found, ["passes/peel.wgsl", "src/gpu/mod.rs", "b.md"]);
    }

    #[test]
    fn what_looks_up_is_named() {
        let imports = imports(&sources(&[
            ("", "pub mod app; pub mod style;"),
            ("app", "mod x; use crate::style::Color;"),
            ("app/x", "use super::Y;"),
            ("style", "#[cfg(test)] mod tests; fn f() { crate::app::x::g() }"),
            ("style/tests", "use crate::app::Z;"),
        ]));
        assert_eq!(upward(&imports, height_of), ["style imports from app/x, which is above it"]);
        assert!(!imports.contains_key(&vec!["style".to_owned(), "tests".to_owned()]));
    }

    #[test]
    fn circles_are_found_whole() {
        let imports = imports(&sources(&[
            ("a", "use crate::b::B;"),
            ("b", "use crate::{c::C, e};"),
            ("c", "use super::d::D;"),
            ("d", "use crate::a as other;"),
            ("e", "use crate::e::own;"),
            ("f", "use crate::a;"),
        ]));
        let found: Vec<Vec<String>> =
            circles(&imports).iter().map(|c| c.iter().map(name).collect()).collect();
        assert_eq!(found, [["a", "b", "c", "d"]]);
    }
}
