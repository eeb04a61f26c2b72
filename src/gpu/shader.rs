//! Shader texts: `#import` and errors that name the right file and line.
//!
//! A line `#import common/frame.wgsl` is replaced by that file, once per composed shader. WGSL does not care about
//! the order of declarations, so imports are simply put where they are named. Shaders are embedded in the program;
//! when the environment variable `HACHURE_SHADERS` names a folder, they are read from there instead and can be
//! reloaded while the program runs.

use std::path::PathBuf;

use include_dir::{Dir, include_dir};
use wgpu::naga::Module;
use wgpu::naga::front::wgsl;
use wgpu::naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use super::bindings;
use super::integer_textures::{IntegerTextures, sampled};

static SHADERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders");

/// Names the folder to read shaders from instead of the embedded ones.
pub const FOLDER_VARIABLE: &str = "HACHURE_SHADERS";

/// Why a shader cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ShaderError {
    /// No such file.
    #[error("shaders/{file}: cannot be read{}", imported_by.as_ref().map(|f| format!(", imported by shaders/{f}")).unwrap_or_default())]
    Missing {
        /// Path below `shaders/`.
        file: String,
        /// The file that imports it.
        imported_by: Option<String>,
    },
    /// The text is no valid WGSL.
    #[error("shaders/{file}, line {line}: {message}")]
    Invalid {
        /// Path below `shaders/`.
        file: String,
        /// Line in that file, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A pass does not give a shader what it reads.
    #[error("shaders/{file}, {entry_point}, {name}: {problem}")]
    Input {
        /// Path below `shaders/`.
        file: String,
        /// The entry point that reads it.
        entry_point: String,
        /// Its variable.
        name: String,
        /// What is wrong with what is given.
        problem: String,
    },
}

/// Where shader texts come from.
#[derive(Debug, Clone, Default)]
pub struct Shaders {
    folder: Option<PathBuf>,
}

/// A shader with all its imports.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Composed {
    /// The whole text.
    pub text: String,
    /// For each line of it the file and the line there, from 1.
    origins: Vec<(usize, usize)>,
    files: Vec<String>,
}

impl Shaders {
    /// The embedded shaders, or those in the folder that `HACHURE_SHADERS` names.
    pub fn from_environment() -> Self {
        Self { folder: std::env::var_os(FOLDER_VARIABLE).map(PathBuf::from) }
    }

    /// The shaders of a folder.
    pub fn in_folder(folder: impl Into<PathBuf>) -> Self {
        Self { folder: Some(folder.into()) }
    }

    /// Whether the texts can change while the program runs.
    pub fn can_change(&self) -> bool {
        self.folder.is_some()
    }

    /// Paths of all embedded shaders below `shaders/`.
    pub fn embedded() -> Vec<String> {
        let mut paths = Vec::new();
        let mut folders = vec![&SHADERS];
        while let Some(folder) = folders.pop() {
            paths.extend(folder.files().filter_map(|f| f.path().to_str()).map(str::to_owned));
            folders.extend(folder.dirs());
        }
        paths.sort();
        paths
    }

    fn read(&self, file: &str) -> Option<String> {
        match &self.folder {
            Some(folder) => std::fs::read_to_string(folder.join(file)).ok(),
            None => Some(SHADERS.get_file(file)?.contents_utf8()?.to_owned()),
        }
    }

    /// The text of a shader with its imports.
    ///
    /// # Errors
    /// [`ShaderError::Missing`].
    pub fn compose(&self, file: &str) -> Result<Composed, ShaderError> {
        let mut composed = Composed { text: String::new(), origins: Vec::new(), files: Vec::new() };
        self.append(file, None, &mut composed)?;
        Ok(composed)
    }

    fn append(&self, file: &str, imported_by: Option<&str>, out: &mut Composed) -> Result<(), ShaderError> {
        if out.files.iter().any(|f| f == file) {
            return Ok(());
        }
        let text = self.read(file).ok_or_else(|| ShaderError::Missing {
            file: file.to_owned(),
            imported_by: imported_by.map(str::to_owned),
        })?;
        let index = out.files.len();
        out.files.push(file.to_owned());
        for (number, line) in text.lines().enumerate() {
            if let Some(import) = line.strip_prefix("#import ") {
                self.append(import.trim(), Some(file), out)?;
            } else {
                out.text.push_str(line);
                out.text.push('\n');
                out.origins.push((index, number + 1));
            }
        }
        Ok(())
    }

    /// A shader, parsed, its variables numbered, and analyzed as far as `checks` say; needs no device.
    ///
    /// # Errors
    /// [`ShaderError`] with the file and line of the mistake.
    fn parse(
        &self,
        file: &str,
        textures: IntegerTextures,
        checks: ValidationFlags,
    ) -> Result<(Module, ModuleInfo), ShaderError> {
        let mut composed = self.compose(file)?;
        let mut module = composed.parse(file)?;
        if textures == IntegerTextures::Sampled {
            composed.text = sampled(&composed.text, &module);
            module = composed.parse(file)?;
        }
        bindings::number(&mut module);
        let info =
            Validator::new(checks, Capabilities::SHADER_FLOAT16_IN_FLOAT32 | Capabilities::PRIMITIVE_INDEX)
                .validate(&module)
                .map_err(|e| {
                    let line = e.location(&composed.text).map_or(0, |l| l.line_number);
                    composed.error(line as usize, e.emit_to_string_with_path(&composed.text, file))
                })?;
        Ok((module, info))
    }

    /// A shader that was [validated](Self::validate), parsed, and which of its variables each entry point uses.
    ///
    /// # Errors
    /// [`ShaderError`].
    pub fn module(&self, file: &str, textures: IntegerTextures) -> Result<(Module, ModuleInfo), ShaderError> {
        self.parse(file, textures, ValidationFlags::empty())
    }

    /// A shader, checked by naga.
    ///
    /// # Errors
    /// [`ShaderError`] with the file and line of the mistake.
    pub fn validate(&self, file: &str) -> Result<Module, ShaderError> {
        self.parse(file, IntegerTextures::Storage, ValidationFlags::all()).map(|(module, _)| module)
    }
}

impl Composed {
    fn parse(&self, file: &str) -> Result<Module, ShaderError> {
        wgsl::parse_str(&self.text).map_err(|e| {
            let line = e.location(&self.text).map_or(0, |l| l.line_number);
            self.error(line as usize, e.emit_to_string_with_path(&self.text, file))
        })
    }

    fn error(&self, line: usize, message: String) -> ShaderError {
        let (file, line) = self
            .origins
            .get(line.saturating_sub(1))
            .map_or((self.files.first(), line), |(file, line)| (self.files.get(*file), *line));
        ShaderError::Invalid { file: file.cloned().unwrap_or_default(), line, message }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shader_is_valid() {
        let shaders = Shaders::default();
        let files = Shaders::embedded();
        assert!(!files.is_empty());
        for file in files {
            if let Err(error) = shaders.validate(&file) {
                panic!("{error}");
            }
        }
    }

    #[test]
    fn a_mistake_is_told_with_its_own_file_and_line() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        write("a.wgsl", "#import b.wgsl\n#import b.wgsl\nfn a() -> f32 { return b(); }\n");
        write("b.wgsl", "fn b() -> f32 {\n  return 1;\n  let x = ;\n}\n");
        let error = Shaders::in_folder(folder.path()).validate("a.wgsl").unwrap_err();
        assert!(matches!(&error, ShaderError::Invalid { file, line: 3, .. } if file == "b.wgsl"), "{error}");
        write("b.wgsl", "fn b() -> f32 { return 1.0; }\n");
        assert!(Shaders::in_folder(folder.path()).validate("a.wgsl").is_ok());
        let missing = Shaders::in_folder(folder.path()).compose("c.wgsl").unwrap_err();
        assert_eq!(missing.to_string(), "shaders/c.wgsl: cannot be read");
    }
}
