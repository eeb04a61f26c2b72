//! The tree of nodes: visibility, edges, style and role of each.

use eframe::egui;
use std::collections::HashSet;

use eframe::egui::{Rect, Sense, Ui, pos2, vec2};

use super::Editing;
use super::icons::{self, Icon};
use crate::document::Role;
use crate::document::mirrors::mirror_fault;
use crate::document::{Document, Resolved};
use crate::scene::{NodeId, Scene};
use crate::style::Style;
use crate::style::preset::Preset;

/// Width of the column of styles.
const STYLE_WIDTH: f32 = 52.0;

/// Scenes with at most this many nodes are shown unfolded.
const UNFOLD_AT_MOST: usize = 60;

/// What the outliner remembers between frames.
#[derive(Debug, Default)]
pub struct Outliner {
    filter: String,
    unfolded: HashSet<NodeId>,
    anchor: Option<NodeId>,
    reveal: Option<NodeId>,
}

struct Row {
    node: NodeId,
    depth: usize,
}

impl Outliner {
    /// Starts anew for another scene.
    pub fn restart(&mut self, scene: &Scene) {
        let all = scene.nodes.len() <= UNFOLD_AT_MOST;
        let unfolded = |(id, n): (NodeId, &crate::scene::Node)| {
            (n.descendants > 0 && (all || n.parent.is_none())).then_some(id)
        };
        *self = Self {
            unfolded: scene.nodes.iter().enumerate().filter_map(unfolded).collect(),
            ..Self::default()
        };
    }

    /// Unfolds and scrolls to a node that was selected elsewhere.
    pub fn reveal(&mut self, node: NodeId, scene: &Scene) {
        let mut above = scene.nodes.get(node).and_then(|n| n.parent);
        while let Some(id) = above {
            self.unfolded.insert(id);
            above = scene.nodes.get(id).and_then(|n| n.parent);
        }
        self.reveal = Some(node);
    }

    fn rows(&self, scene: &Scene) -> Vec<Row> {
        let wanted = self.filter.trim().to_lowercase();
        let mut rows = Vec::new();
        let mut depths = vec![0usize; scene.nodes.len()];
        if wanted.is_empty() {
            let mut id = 0;
            while let Some(node) = scene.nodes.get(id) {
                let depth = node.parent.and_then(|p| depths.get(p)).map_or(0, |d| d + 1);
                depths[id] = depth;
                rows.push(Row { node: id, depth });
                id = if self.unfolded.contains(&id) { id + 1 } else { id + 1 + node.descendants };
            }
            return rows;
        }
        // What matches, and everything above it.
        let mut shown = vec![false; scene.nodes.len()];
        for (id, node) in scene.nodes.iter().enumerate().rev() {
            if node.name.to_lowercase().contains(&wanted) {
                shown[id] = true;
            }
            if let (true, Some(parent)) = (shown[id], node.parent) {
                shown[parent] = true;
            }
        }
        for (id, node) in scene.nodes.iter().enumerate() {
            depths[id] = node.parent.and_then(|p| depths.get(p)).map_or(0, |d| d + 1);
            if shown[id] {
                rows.push(Row { node: id, depth: depths[id] });
            }
        }
        rows
    }

    /// The panel.
    pub fn ui(&mut self, ui: &mut Ui, editing: &mut Editing<'_>) {
        ui.add_space(4.0);
        let filter = egui::TextEdit::singleline(&mut self.filter)
            .hint_text("Filter objects")
            .desired_width(f32::INFINITY);
        ui.add(filter).on_hover_text("Show only objects whose name contains this text");
        ui.add_space(4.0);
        let scene = &editing.model.scene;
        let rows = self.rows(scene);
        if rows.is_empty() {
            ui.weak(if scene.nodes.is_empty() { "No objects yet." } else { "No object has such a name." });
            return;
        }
        let height = 20.0;
        ui.spacing_mut().item_spacing.y = 0.0;
        let mut area = egui::ScrollArea::vertical().auto_shrink([false, false]);
        if let Some(index) = self.reveal.take().and_then(|n| rows.iter().position(|r| r.node == n)) {
            let visible = (ui.available_height() / height).max(1.0);
            area = area.vertical_scroll_offset((index as f32 - visible * 0.4).max(0.0) * height);
        }
        // Roles as they were when the frame began; a click shows in the next one, which it causes.
        let before = editing.document.clone();
        let resolved = before.resolve(scene);
        area.show_rows(ui, height, rows.len(), |ui, range| {
            for index in range {
                let (Some(row), Some(roles)) =
                    (rows.get(index), rows.get(index).and_then(|r| resolved.get(r.node)))
                else {
                    continue;
                };
                self.row_ui(ui, row, roles, &rows, editing, height);
            }
        });
    }

    // Long, as it lays out one row from both ends: each thing is placed beside the one before it.
    fn row_ui(
        &mut self,
        ui: &mut Ui,
        row: &Row,
        roles: &Resolved<'_>,
        rows: &[Row],
        editing: &mut Editing<'_>,
        height: f32,
    ) {
        let scene = &editing.model.scene;
        let Some(node) = scene.nodes.get(row.node) else { return };
        let id = ui.scope_id().with(("row", row.node));
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click());
        let selected = editing.selection.contains(row.node);
        response.widget_info(|| egui::WidgetInfo::selected(egui::Role::TreeItem, true, selected, &node.name));
        row_background(ui, rect, selected, response.hovered());

        let left = rect.left() + 4.0 + 12.0 * row.depth.min(12) as f32;
        if node.descendants > 0 && self.filter.trim().is_empty() {
            let at = Rect::from_center_size(pos2(left + 5.0, rect.center().y), vec2(14.0, height));
            self.fold_ui(ui, at, id.with("fold"), row.node, &node.name);
        }

        let square = |index: f32| {
            let center = pos2(rect.right() - 4.0 - icons::SIZE * (index + 0.5), rect.center().y);
            Rect::from_center_size(center, vec2(icons::SIZE, height))
        };
        let own = editing.document.nodes.get(&node.path).cloned().unwrap_or_default();
        let shown = own.visible.unwrap_or(true);
        let targets = || targets(row.node, editing.selection.contains(row.node), editing.selection.iter());
        let (name, visible) = (&node.name, roles.visible);
        let eye = icons::toggle(
            ui,
            square(0.0),
            id.with("eye"),
            Icon::Eye,
            shown,
            !visible,
            &format!("Show {name}"),
        )
        .on_hover_text("Draw this object and what hangs below it");
        let edges_at = square(1.0);
        let edges_name = format!("Edges of {name}");
        let edges =
            icons::toggle(ui, edges_at, id.with("edges"), Icon::Edges, roles.enhanced, !visible, &edges_name)
                .on_hover_text("Draw the edges of this object (enhanced)");
        let targets = targets();
        // Few objects are mirrors or designated: the others have the switches only where somebody looks.
        let looked_at = ui.rect_contains_pointer(rect);
        let role_switches = [(Role::Mirror, Icon::Mirror), (Role::Mask, Icon::Mask)];
        let mut left_of_switches = edges_at.left();
        for (i, (role, icon)) in role_switches.into_iter().enumerate() {
            let can_be = role != Role::Mirror || !scene.is_added(row.node);
            if can_be && (looked_at || roles.has(role)) {
                let at = square(2.0 + i as f32);
                left_of_switches = at.left();
                let switch = RoleSwitch { at, id: id.with(icon), role, icon, node: row.node };
                switch.ui(ui, roles, &targets, editing);
            }
        }
        if eye.clicked() {
            set_visible(editing.document, scene, &targets, !shown);
        }
        if edges.clicked() {
            set_enhanced(editing.document, scene, &targets, !roles.enhanced);
        }

        let chip = Rect::from_x_y_ranges(
            left_of_switches - STYLE_WIDTH - 2.0..=left_of_switches - 2.0,
            rect.y_range(),
        );
        // What is inherited is said only where somebody looks; elsewhere its place belongs to the name.
        style_chip(ui, looked_at, chip, own.style.as_ref(), roles.style, &node.name, &targets, editing);

        let right = if looked_at || own.style.is_some() { chip.left() } else { left_of_switches };
        let text_rect = Rect::from_min_max(pos2(left + 13.0, rect.top()), pos2(right - 4.0, rect.bottom()));
        let strength = if visible { 1.0 } else { 0.5 };
        let color = if selected {
            ui.visuals().selection.stroke.color
        } else {
            ui.visuals().text_color().gamma_multiply(strength)
        };
        truncated(ui, text_rect, &node.name, color);

        self.row_clicked(&response, row, rows, editing);
        response.on_hover_ui(|ui| {
            let scene = &editing.model.scene;
            let triangles = editing.model.triangle_count(scene.subtree(row.node));
            ui.label(&node.path);
            ui.weak(format!("{} triangles", super::status::grouped(triangles)));
        });
    }

    fn row_clicked(&mut self, response: &egui::Response, row: &Row, rows: &[Row], editing: &mut Editing<'_>) {
        if response.clicked() {
            let modifiers = response.ctx.input(|i| i.modifiers);
            self.select(row.node, modifiers, rows, editing);
        }
        if response.double_clicked() {
            editing.commands.push(super::Command::FrameSelected);
        }
    }

    fn fold_ui(&mut self, ui: &Ui, at: Rect, id: egui::Id, node: NodeId, name: &str) {
        let fold = ui.interact(at, id, Sense::click());
        let open = self.unfolded.contains(&node);
        fold.widget_info(|| {
            let what = if open { "Fold" } else { "Unfold" };
            egui::WidgetInfo::labeled(egui::Role::Button, true, format!("{what} {name}"))
        });
        let color = ui.visuals().text_color().gamma_multiply(if fold.hovered() { 1.0 } else { 0.6 });
        icons::fold(ui.painter(), at.center(), open, color);
        if fold.clicked() && !self.unfolded.remove(&node) {
            self.unfolded.insert(node);
        }
    }

    fn select(&mut self, node: NodeId, modifiers: egui::Modifiers, rows: &[Row], editing: &mut Editing<'_>) {
        if modifiers.command {
            editing.selection.toggle(node);
        } else if let (true, Some(anchor)) = (modifiers.shift, self.anchor) {
            let index = |wanted| rows.iter().position(|r| r.node == wanted);
            if let (Some(a), Some(b)) = (index(anchor), index(node)) {
                let range = rows.get(a.min(b)..=a.max(b)).unwrap_or_default();
                editing.selection.extend(range.iter().map(|r| r.node));
                editing.selection.extend([node]);
            }
            return;
        } else {
            editing.selection.set(node);
        }
        self.anchor = Some(node);
    }
}

/// A button of a selected row acts on the whole selection, one of another row on that row.
fn targets(node: NodeId, selected: bool, selection: impl Iterator<Item = NodeId>) -> Vec<NodeId> {
    if selected { selection.collect() } else { vec![node] }
}

fn row_background(ui: &Ui, rect: Rect, selected: bool, hovered: bool) {
    let visuals = ui.visuals();
    if selected {
        ui.painter().rect_filled(rect, 3.0, visuals.selection.bg_fill);
    } else if hovered {
        ui.painter().rect_filled(rect, 3.0, visuals.widgets.hovered.weak_bg_fill);
    }
}

fn truncated(ui: &Ui, rect: Rect, text: &str, color: egui::Color32) {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width());
    let galley = ui.painter().layout_job(job);
    ui.painter().galley(pos2(rect.left(), rect.center().y - galley.size().y * 0.5), galley, color);
}

/// What a click on the switch of a role does.
fn role_help(role: Role, has: bool, has_mesh: bool) -> &'static str {
    match (role, has) {
        (Role::Mirror, true) => "Make this mirror an object like any other",
        (Role::Mirror, false) if !has_mesh => "Make each flat object below a mirror",
        (Role::Mirror, false) => "Make this flat object a mirror",
        (Role::Mask, true) => "Let blueprints hide this object again",
        (Role::Mask, false) => "Draw layers of blueprints until this object is uncovered",
    }
}

/// The name of a style: that of an equal preset, or `Own`.
pub fn style_name<'a>(style: &Style, presets: &'a [Preset]) -> &'a str {
    presets.iter().find(|p| p.style == *style).map_or("Own", |p| p.name.as_str())
}

fn style_chip(
    ui: &mut Ui,
    looked_at: bool,
    rect: Rect,
    own: Option<&Style>,
    resolved: &Style,
    node_name: &str,
    targets: &[NodeId],
    editing: &mut Editing<'_>,
) {
    let text = own.map_or("Inherit", |style| style_name(style, editing.presets));
    let mut child = ui.new_child(
        egui::UiBuilder::new()
            .max_rect(rect)
            .id_salt(("style", node_name, targets.first()))
            .layout(egui::Layout::right_to_left(egui::Align::Center)),
    );
    let strength = if own.is_some() {
        0.9
    } else if looked_at {
        0.5
    } else {
        0.0
    };
    let color = child.visuals().text_color().gamma_multiply(strength);
    let button = egui::Button::new(egui::RichText::new(text).small().color(color))
        .frame_when_inactive(false)
        .truncate();
    let config = egui::containers::menu::MenuConfig::new();
    let (response, _) =
        egui::containers::menu::MenuButton::from_button(button).config(config).ui(&mut child, |ui| {
            ui.set_min_width(120.0);
            let scene = &editing.model.scene;
            if ui.selectable_label(own.is_none(), "Inherit").clicked() {
                inherit(editing.document, scene, targets);
                ui.close();
            }
            ui.separator();
            for preset in editing.presets {
                let is_it = own.is_some_and(|style| *style == preset.style);
                if ui.selectable_label(is_it, &preset.name).on_hover_text(&preset.description).clicked() {
                    editing.document.set_style(scene, targets, &preset.style);
                    ui.close();
                }
            }
            ui.separator();
            let hint = "A copy of the present style that can be changed by itself";
            if ui.selectable_label(own.is_some() && text == "Own", "Own").on_hover_text(hint).clicked() {
                if own.is_none() {
                    editing.document.set_style(scene, targets, resolved);
                }
                ui.close();
            }
        });
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Button, true, format!("Style of {node_name}: {text}"))
    });
}

/// Shows or hides nodes.
pub fn set_visible(document: &mut Document, scene: &Scene, nodes: &[NodeId], visible: bool) {
    for node in nodes.iter().filter_map(|&n| scene.nodes.get(n)) {
        document.node_mut(&node.path).visible = (!visible).then_some(false);
    }
    document.tidy();
}

/// Draws the edges of nodes and of what hangs below them, or not.
pub fn set_enhanced(document: &mut Document, scene: &Scene, nodes: &[NodeId], enhanced: bool) {
    for &id in nodes {
        for inner in scene.subtree(id) {
            if let Some(own) = scene.nodes.get(inner).and_then(|n| document.nodes.get_mut(&n.path)) {
                own.enhanced = None;
            }
        }
        let inherited = document.resolve(scene).get(id).is_none_or(|r| r.enhanced);
        if let (true, Some(node)) = (inherited != enhanced, scene.nodes.get(id)) {
            document.node_mut(&node.path).enhanced = Some(enhanced);
        }
    }
    document.tidy();
}

/// Takes the nodes' own styles away.
pub fn inherit(document: &mut Document, scene: &Scene, nodes: &[NodeId]) {
    for node in nodes.iter().filter_map(|&n| scene.nodes.get(n)) {
        document.node_mut(&node.path).style = None;
    }
    document.tidy();
}

/// A switch that makes an object a mirror, or lets blueprints uncover it.
struct RoleSwitch {
    at: Rect,
    id: egui::Id,
    role: Role,
    icon: Icon,
    /// The object in whose row it stands.
    node: NodeId,
}

impl RoleSwitch {
    /// `roles`: those of its object; `targets`: the objects that a click changes.
    fn ui(self, ui: &mut Ui, roles: &Resolved<'_>, targets: &[NodeId], editing: &mut Editing<'_>) {
        let Self { at, id, role, icon, node } = self;
        let scene = &editing.model.scene;
        let Some(object) = scene.nodes.get(node) else { return };
        let has = roles.has(role);
        let verb = if role == Role::Mirror { "Mirror" } else { "Uncover" };
        let label = format!("{verb} {}", object.name);
        let switch = icons::toggle(ui, at, id, icon, has, !roles.visible, &label);
        let fault = (role == Role::Mirror && switch.hovered()).then(|| mirror_fault(scene, node)).flatten();
        let help = match &fault {
            Some(fault) => format!("Cannot be a mirror: {fault}"),
            None => role_help(role, has, object.mesh.is_some()).to_owned(),
        };
        if switch.on_hover_text(help).clicked() && (fault.is_none() || has) {
            editing.document.set_role(scene, targets, role, !has);
        }
    }
}
