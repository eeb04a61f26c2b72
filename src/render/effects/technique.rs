//! What a surface technique is: each is one file that says what it makes of the styles of objects, what it needs of a layer
//! beyond its G-buffer, and what its shader reads. Of what draws surfaces only the list in `techniques.rs` knows it by name.

use crate::gpu::{Gpu, Inputs, Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::instances::{DrawCall, Instance, InstanceBuffer};
use crate::render::base::scene_view::SceneView;
use crate::render::base::stripes::StripesBy;
use crate::render::base::stroke_maps::StrokeMaps;
use crate::render::base::style_images::StyleImages;
use crate::render::base::view::View;
use crate::render::passes::gbuffer::GBuffer;
use crate::scene::NodeId;
use crate::style::{Style, Technique};

/// A visible object and its style.
#[derive(Clone, Copy)]
pub struct Styled<'a> {
    /// Its object id.
    pub id: usize,
    /// How many object ids there are.
    pub count: usize,
    /// The object.
    pub node: NodeId,
    /// Its style.
    pub style: &'a Style,
    /// The scene that it is in.
    pub scene: &'a GpuScene,
    /// The images that styles name.
    pub images: &'a StyleImages,
    /// The maps of strokes that styles describe.
    pub strokes: &'a StrokeMaps,
    /// What decides where stripes run, beside the style.
    pub stripes: StripesBy,
    /// Pixels per reference pixel.
    pub scale: f32,
    /// Whether the picture has one sample only.
    pub is_single: bool,
}

impl Styled<'_> {
    /// Its entry in a table by object id, which has default entries for others.
    pub fn entry<'t, T: Clone + Default>(&self, table: &'t mut Vec<T>) -> Option<&'t mut T> {
        table.resize(self.count, T::default());
        table.get_mut(self.id)
    }
}

/// A layer that is to be shaded: one surface per pixel, and what it was drawn of.
#[derive(Clone, Copy)]
pub struct Shaded<'a> {
    /// Geometry, surface ids and base colors of its pixels.
    pub gbuffer: &'a GBuffer,
    /// Another number whenever `gbuffer` has been drawn anew; `None`: it is new each time.
    pub revision: Option<u64>,
    /// Which lights reach each pixel, and what changes when that does; `None` when no light throws shadows.
    pub shadow_mask: Option<(&'a Target, u64)>,
    /// Where lines run on it, and what changes when that does; `None` where nobody asks, or there are none.
    pub spines: Option<(&'a Target, u64)>,
    /// The scene as the camera sees it.
    pub scene_view: SceneView<'a>,
    /// Bind group 0, without the paper.
    pub uniform: &'a FrameUniform,
    /// The instances of its objects, on the device.
    pub instance_buffer: &'a InstanceBuffer,
    /// The same instances: where each object stands, with which material.
    pub instances: &'a [Instance],
    /// The draw calls of these instances.
    pub calls: &'a [DrawCall],
}

/// A surface technique.
pub trait SurfaceTechnique: Sized {
    /// Which one it is in styles.
    const TECHNIQUE: Technique;

    /// What the styles of all visible objects ask of it, by value; the default: nothing.
    type Styles: Clone + PartialEq + Default;

    /// What all cameras share.
    type Shared;

    /// What all cameras share, as a renderer begins with it: nothing is uploaded or measured yet.
    fn shared(gpu: &Gpu) -> Self::Shared;

    /// What lives across the frames of one camera, before the first of them.
    fn new(gpu: &Gpu) -> Self;

    /// Adds an object, if it is drawn in this technique.
    fn add(styles: &mut Self::Styles, object: &Styled<'_>);

    /// The styles for one camera, where they depend on it.
    fn placed(styles: &Self::Styles, _scene: &GpuScene, _view: &View) -> Self::Styles {
        styles.clone()
    }

    /// Makes what takes long of an image that the parameter `key` names, before it is asked for.
    fn prepare_image(_images: &StyleImages, _key: &str, _path: &std::path::Path) {}

    /// The switches of its shader.
    fn switches(styles: &Self::Styles) -> Vec<(&'static str, bool)>;

    /// Whether it goes by where lines run.
    fn reads_lines(_styles: &Self::Styles) -> bool {
        false
    }

    /// Takes what all layers read to the device; `styles`: those for this camera.
    ///
    /// # Errors
    /// [`RenderError`].
    fn upload(
        &mut self,
        shared: &mut Self::Shared,
        gpu: &Gpu,
        styles: &Self::Styles,
    ) -> Result<(), RenderError>;

    /// Draws what it needs of a layer before that is shaded.
    ///
    /// # Errors
    /// [`RenderError`].
    fn begin(
        &mut self,
        _rec: &mut Recorder<'_>,
        _shared: &mut Self::Shared,
        _styles: &Self::Styles,
        _layer: &Shaded<'_>,
    ) -> Result<(), RenderError> {
        Ok(())
    }

    /// What its shader reads.
    fn bind<'a>(&'a self, shared: &'a Self::Shared, inputs: &mut Inputs<'a>);

    /// Name of a stage of its own, and how often that has run.
    fn runs(&self) -> Option<(&'static str, u64)> {
        None
    }
}
