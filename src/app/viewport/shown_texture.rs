//! Targets of the renderer as textures of egui.

use eframe::{egui, egui_wgpu};

use crate::gpu::Target;

/// A texture of egui's that shows a target.
#[derive(Default)]
pub(super) struct ShownTexture {
    id: Option<egui::TextureId>,
    texture: Option<wgpu::Texture>,
}

impl ShownTexture {
    /// The texture, if it has shown anything.
    pub(super) fn id(&self) -> Option<egui::TextureId> {
        self.id
    }

    /// Shows a target from now on.
    pub(super) fn show(&mut self, state: &egui_wgpu::RenderState, target: &Target) -> egui::TextureId {
        if let (Some(id), true) = (self.id, self.texture.as_ref() == Some(target.texture())) {
            return id;
        }
        self.texture = Some(target.texture().clone());
        let mut renderer = state.renderer.write();
        let (device, view, filter) = (&state.device, target.view(), wgpu::FilterMode::Nearest);
        if let Some(id) = self.id {
            renderer.update_egui_texture_from_wgpu_texture(device, view, filter, id);
            return id;
        }
        let id = renderer.register_native_texture(device, view, filter);
        self.id = Some(id);
        id
    }
}
