//! What is seen through: groups that are split into layers, each by itself. A group that overlaps no other on the screen is drawn
//! into a picture of its own, each layer beneath those before it; where groups overlap, their layers go to lists, in which they
//! are put in order by depth, pixel by pixel.

use super::blended::{BlendedShading, place_blended};
use super::blueprint::{BlueprintBuffers, BlueprintGroup, BlueprintInputs, place_blueprint};
use super::layered::{Layered, LayeredGroup};
use super::section::GpuCap;
use super::surface::Look;
use crate::gpu::{Gpu, Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::group::Group;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::passes::composition::{Composition, Translucent};
use crate::render::passes::designated::DepthMask;
use crate::render::passes::layer_lists::LayerLists;
use crate::render::passes::layer_report::LayerReport;
use crate::render::passes::layers::{LayerMethod, Reported};
use crate::render::passes::place::Place;
use crate::render::passes::traversal::GBufferPass;
use crate::style::Style;

/// The groups that are seen through.
#[derive(Clone, Copy)]
pub struct TranslucentGroups<'a> {
    /// What blends.
    pub blended: &'a Group,
    /// The blueprints.
    pub blueprints: &'a [BlueprintGroup],
}

/// What they are drawn with.
pub struct TranslucentInputs<'a> {
    /// The scene as the camera sees it.
    pub scene_view: SceneView<'a>,
    /// Bind group 0.
    pub uniform: &'a FrameUniform,
    /// The caps of a section by object id; empty when there are none.
    pub caps: &'a Vec<GpuCap>,
    /// Layers of blueprints are drawn until enough of this is uncovered.
    pub mask: Option<&'a Output<DepthMask>>,
    /// What blends is shaded with this.
    pub shading: BlendedShading<'a>,
    /// Changes when shadow maps do.
    pub shadow_revisions: Vec<u64>,
}

/// What the layers of one group depend on.
#[derive(Clone, PartialEq)]
struct Key {
    layered: LayeredGroup,
    /// The opaque surfaces and their ink.
    opaque: [Option<u64>; 2],
    kind: GroupKind,
}

/// How a group is drawn.
#[derive(Clone, PartialEq)]
enum GroupKind {
    Blended { look: Box<Look>, shadows: Vec<u64> },
    Blueprint { blueprint: Box<BlueprintGroup>, caps: Vec<GpuCap>, mask: Option<u64>, is_captured: bool },
}

/// One group across frames.
struct GroupState {
    layered: Layered,
    buffers: BlueprintBuffers,
    /// Its picture, where it overlaps no other.
    alone: Stage<Key, Translucent>,
    /// What it was drawn as last.
    last: Option<BlueprintGroup>,
    runs: u64,
}

impl GroupState {
    fn new(gpu: &Gpu) -> Self {
        Self {
            layered: Layered::new(gpu),
            buffers: BlueprintBuffers::new(gpu),
            alone: Stage::default(),
            last: None,
            runs: 0,
        }
    }
}

/// What of all groups lives across frames.
pub struct TranslucentState {
    blended: GroupState,
    blueprints: Vec<GroupState>,
    /// The picture of the groups that overlap.
    together: Stage<Vec<Key>, Translucent>,
    /// `None` while none do.
    lists: Option<LayerLists>,
    /// In how many bands of rows it was drawn.
    bands: usize,
}

impl TranslucentState {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            blended: GroupState::new(gpu),
            blueprints: Vec::new(),
            together: Stage::default(),
            lists: None,
            bands: 0,
        }
    }

    /// In how many bands of rows the groups that overlap were drawn; 0: none do.
    pub fn bands(&self) -> usize {
        self.bands
    }

    /// How often layers of blueprints have been drawn.
    pub fn blueprint_runs(&self) -> u64 {
        self.blueprints.iter().map(|state| state.runs).sum()
    }

    /// What has been reported about the pictures; incomplete ones are drawn again. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        let mut worst = Reported::Complete;
        for state in std::iter::once(&mut self.blended).chain(&mut self.blueprints) {
            let reported = state.layered.take_reports();
            if reported == Reported::Incomplete {
                state.alone.clear();
            }
            worst = worst.max(reported);
        }
        worst = worst.max(self.lists.as_mut().map_or(Reported::Complete, LayerLists::take_reports));
        if worst == Reported::Incomplete {
            self.together.clear();
        }
        worst
    }

    /// How far the layers of each blueprint came. Waits for the device.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn layer_reports(&self, gpu: &Gpu) -> Result<Vec<LayerReport>, RenderError> {
        self.blueprints.iter().map(|state| state.layered.count().read(gpu)).collect()
    }

    /// How far the layers of each blueprint came in the last picture whose report has arrived.
    pub fn last_layer_reports(&self) -> Vec<Option<(LayerReport, LayerMethod)>> {
        self.blueprints.iter().map(|state| state.layered.last().cloned()).collect()
    }

    /// The same of the blueprint that objects of this style are in.
    pub fn last_layer_report_of(&self, style: &Style) -> Option<&(LayerReport, LayerMethod)> {
        let is_meant = |state: &&GroupState| state.last.as_ref().is_some_and(|last| last.is_of(style));
        self.blueprints.iter().find(is_meant)?.layered.last()
    }

    /// Draws all groups and places them.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn place(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        groups: TranslucentGroups<'_>,
        mut inputs: TranslucentInputs<'_>,
        composition: &mut Composition,
    ) -> Result<(), RenderError> {
        let TranslucentGroups { blended, blueprints } = groups;
        self.blueprints.truncate(blueprints.len());
        self.blueprints.resize_with(blueprints.len(), || GroupState::new(rec.gpu));
        let mut all = Vec::new();
        if !blended.is_empty() {
            all.push((None, &mut self.blended, blended));
        }
        let with_states = blueprints.iter().zip(&mut self.blueprints);
        all.extend(with_states.map(|(blueprint, state)| (Some(blueprint), state, &blueprint.group)));
        let parts: Vec<_> = all
            .iter()
            .map(|(.., group)| group.scissor_rect(inputs.scene_view.scene, inputs.scene_view.view))
            .collect();
        let (mut overlapping, mut keys) = (Vec::new(), Vec::new());
        for (number, (blueprint, state, group)) in all.into_iter().enumerate() {
            let key = Key::new(rec, blueprint, group, &inputs, composition);
            state.last = blueprint.cloned();
            if overlaps_another(&parts, number) {
                state.alone.clear();
                overlapping.push((blueprint, state));
                keys.push(key);
                continue;
            }
            let GroupState { layered, buffers, alone, runs, .. } = state;
            let picture = alone.run(key, |key| {
                let color = rec.target("group", wgpu::TextureFormat::Rgba16Float)?;
                rec.clear("group", &[&color]);
                let mut group = GroupDrawing { blueprint, layered, buffers, key };
                let place = &mut Place::Beneath(&color);
                let front = group.place(rec, gbuffer_pass, &mut inputs, composition, place)?;
                *runs += 1;
                Ok::<_, RenderError>(Translucent { color, fronts: front.into_iter().collect() })
            })?;
            composition.place_translucent(picture);
        }
        if overlapping.is_empty() {
            self.together.clear();
            (self.lists, self.bands) = (None, 0);
            return Ok(());
        }
        let lists = self.lists.get_or_insert_with(|| LayerLists::new(rec.gpu));
        let picture = self.together.run(keys, |keys| {
            let color = rec.target("overlapping groups", wgpu::TextureFormat::Rgba16Float)?;
            let bands = lists.plan(rec.gpu, rec.size())?;
            self.bands = bands.len();
            let mut fronts = Vec::new();
            for (number, band) in bands.iter().enumerate() {
                if number > 0 {
                    // The device is told anew what layers begin with.
                    rec.flush();
                }
                lists.begin_band(rec, band, number == 0);
                fronts.clear();
                for ((blueprint, state), key) in overlapping.iter_mut().zip(keys) {
                    lists.begin_group(rec);
                    let GroupState { layered, buffers, runs, .. } = &mut **state;
                    let mut group = GroupDrawing { blueprint: *blueprint, layered, buffers, key };
                    let place = &mut Place::Listed(lists);
                    fronts.extend(group.place(rec, gbuffer_pass, &mut inputs, composition, place)?);
                    *runs += u64::from(number == 0);
                }
                lists.blend(rec, band, &color)?;
            }
            lists.report(rec, bands);
            Ok::<_, RenderError>(Translucent { color, fronts })
        })?;
        composition.place_translucent(picture);
        Ok(())
    }
}

/// One group while it is being drawn.
struct GroupDrawing<'a> {
    /// `None`: what blends.
    blueprint: Option<&'a BlueprintGroup>,
    layered: &'a mut Layered,
    buffers: &'a mut BlueprintBuffers,
    key: &'a Key,
}

impl GroupDrawing<'_> {
    fn place(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &mut TranslucentInputs<'_>,
        composition: &Composition,
        place: &mut Place<'_>,
    ) -> Result<Option<Target>, RenderError> {
        let scene_view = inputs.scene_view;
        match self.blueprint {
            None => place_blended(
                rec,
                gbuffer_pass,
                self.layered,
                &self.key.layered,
                &scene_view,
                composition,
                &mut inputs.shading,
                place,
            ),
            Some(blueprint) => {
                let mask = inputs.mask.map(|mask| &mask.value);
                let own = BlueprintInputs { blueprint, caps: inputs.caps, mask };
                place_blueprint(
                    rec,
                    gbuffer_pass,
                    self.layered,
                    &self.key.layered,
                    &scene_view,
                    composition,
                    own,
                    self.buffers,
                    place,
                )
            }
        }
    }
}

impl Key {
    fn new(
        rec: &Recorder<'_>,
        blueprint: Option<&BlueprintGroup>,
        group: &Group,
        inputs: &TranslucentInputs<'_>,
        composition: &Composition,
    ) -> Self {
        let TranslucentInputs { scene_view, uniform, caps, mask, shading, shadow_revisions } = inputs;
        Self {
            layered: LayeredGroup::new(rec, scene_view, uniform, group.clone()),
            opaque: composition.revisions(),
            kind: match blueprint {
                None => GroupKind::Blended {
                    look: Box::new(shading.look.clone()),
                    shadows: shadow_revisions.clone(),
                },
                Some(blueprint) => GroupKind::Blueprint {
                    blueprint: Box::new(blueprint.clone()),
                    caps: (*caps).clone(),
                    mask: mask.map(|mask| mask.revision),
                    is_captured: super::blueprint::LAYERS.into_iter().any(|name| rec.captures(name)),
                },
            },
        }
    }
}

/// Whether a part of the picture overlaps any other: left, top, right and bottom edge each.
fn overlaps_another(parts: &[[u32; 4]], number: usize) -> bool {
    let Some(&[left, top, right, bottom]) = parts.get(number) else { return false };
    let is_other = |(other, _): &(usize, &[u32; 4])| *other != number;
    parts
        .iter()
        .enumerate()
        .filter(is_other)
        .any(|(_, &[l, t, r, b])| left.max(l) < right.min(r) && top.max(t) < bottom.min(b))
}
