//! What surfaces are shaded by beside the G-buffer: bands of toons, coordinates of halftones.

use super::{Begun, Drawing, DrawingInputs, Shared};
use crate::gpu::{Recorder, Target};
use crate::render::RenderError;
use crate::render::effects::toon::cartoon_map;

impl Drawing {
    pub(super) fn find_coordinates(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        begun: &Begun,
    ) -> Result<Option<Target>, RenderError> {
        if begun.with_coordinates.is_empty() {
            self.coordinates.clear();
            return Ok(None);
        }
        let asked = (begun.gbuffer.revision, begun.with_coordinates.clone());
        let coordinates = self.coordinates.run(asked, |(_, calls)| {
            shared.gbuffer.coordinates.run(rec, inputs.scene, &begun.gbuffer.value, &self.draws, calls)
        })?;
        Ok(Some(coordinates.value))
    }

    pub(super) fn find_bands(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        begun: &Begun,
    ) -> Result<Option<Target>, RenderError> {
        let toons = &inputs.objects.toons;
        if !toons.styles.is_empty() {
            self.toon_styles.write(rec.gpu, &toons.styles);
            self.toon_bands.write(rec.gpu, &toons.bands);
        }
        if !inputs.objects.have_cartoon_map() {
            self.cartoon_map.clear();
            return Ok(None);
        }
        let gbuffer = &begun.gbuffer;
        let mask = begun.shadow_mask.as_ref();
        let shadows = mask.map_or(0, |mask| mask.revision);
        let bands = (gbuffer.revision, shadows, toons.clone(), begun.uniform.without_background());
        let toon_styles = self.toon_styles.buffer();
        let map = self
            .cartoon_map
            .run(bands, |_| cartoon_map(rec, &gbuffer.value, toon_styles, mask.map(|mask| &mask.value)))?;
        Ok(Some(map.value))
    }
}
