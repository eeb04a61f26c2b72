//! The surface techniques that need more than the G-buffer and the lights. Adding one is adding its line at the end.

use std::path::Path;

use super::technique::{Shaded, Styled, SurfaceTechnique};
use crate::gpu::{Gpu, Inputs, Recorder};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::style_images::StyleImages;
use crate::render::base::view::View;
use crate::style::Technique;

/// Makes structs with a field for each technique, and functions that ask each in turn.
macro_rules! techniques {
    ($($name:ident: $technique:path,)*) => {
        /// What the styles of all visible objects ask of the techniques, by value.
        #[derive(Clone, PartialEq, Default)]
        pub struct TechniqueStyles {
            $($name: <$technique as SurfaceTechnique>::Styles,)*
        }

        impl TechniqueStyles {
            /// Adds an object.
            pub fn add(&mut self, object: &Styled<'_>) {
                $(<$technique>::add(&mut self.$name, object);)*
            }

            /// The styles for one camera.
            #[must_use]
            pub fn placed(&self, scene: &GpuScene, view: &View) -> Self {
                Self { $($name: <$technique>::placed(&self.$name, scene, view),)* }
            }

            /// Whether any goes by where lines run.
            pub fn read_lines(&self) -> bool {
                [$(<$technique>::reads_lines(&self.$name),)*].contains(&true)
            }

            /// The switches of their shaders; `only`: those of all others are off.
            pub fn switches(&self, only: Option<Technique>) -> Vec<(&'static str, bool)> {
                let mut switches = Vec::new();
                $({
                    let is_asked = only.is_none_or(|only| only == <$technique>::TECHNIQUE);
                    let own = <$technique>::switches(&self.$name);
                    switches.extend(own.into_iter().map(|(name, is_on)| (name, is_on && is_asked)));
                })*
                switches
            }
        }

        /// What techniques share among all cameras.
        pub struct SharedTechniques {
            $($name: <$technique as SurfaceTechnique>::Shared,)*
        }

        impl SharedTechniques {
            /// As a renderer begins with them.
            pub fn new(gpu: &Gpu) -> Self {
                Self { $($name: <$technique>::shared(gpu),)* }
            }
        }

        /// What of the techniques lives across frames, for one camera.
        pub struct Techniques {
            $($name: $technique,)*
        }

        impl Techniques {
            /// Before the first frame.
            pub fn new(gpu: &Gpu) -> Self {
                Self { $($name: <$technique>::new(gpu),)* }
            }

            /// Takes what all layers read to the device; `styles`: those for this camera.
            ///
            /// # Errors
            /// [`RenderError`].
            pub fn upload(
                &mut self,
                shared: &mut SharedTechniques,
                gpu: &Gpu,
                styles: &TechniqueStyles,
            ) -> Result<(), RenderError> {
                $(self.$name.upload(&mut shared.$name, gpu, &styles.$name)?;)*
                Ok(())
            }

            /// Draws what they need of a layer before that is shaded.
            ///
            /// # Errors
            /// [`RenderError`].
            pub fn begin(
                &mut self,
                rec: &mut Recorder<'_>,
                shared: &mut SharedTechniques,
                styles: &TechniqueStyles,
                layer: &Shaded<'_>,
            ) -> Result<(), RenderError> {
                $(self.$name.begin(rec, &mut shared.$name, &styles.$name, layer)?;)*
                Ok(())
            }

            /// What their shaders read.
            pub fn bind<'a>(&'a self, shared: &'a SharedTechniques, inputs: &mut Inputs<'a>) {
                $(self.$name.bind(&shared.$name, inputs);)*
            }

            /// Names of their stages, and how often each has run.
            pub fn runs(&self) -> Vec<(&'static str, u64)> {
                let runs = [$(self.$name.runs(),)*];
                runs.into_iter().flatten().collect()
            }
        }

        /// Makes what takes long of an image that the parameter `key` names.
        pub fn prepare_image(images: &StyleImages, key: &str, path: &Path) {
            $(<$technique>::prepare_image(images, key, path);)*
        }
    };
}

techniques! {
    gooch: super::gooch::GoochShading,
    toon: super::toon::ToonShading,
    halftone: super::halftone::HalftoneShading,
    matcap: super::matcap::MatcapShading,
    hatching: super::hatching::HatchingShading,
}
