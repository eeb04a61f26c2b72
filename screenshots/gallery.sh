#!/bin/sh
# Every picture of the gallery, each by one call of `hachure render`. Run by `make gallery`.
set -eu
cd "$(dirname "$0")/.."
cargo build --quiet --release
crank=assets/models/crank.glb
ogre=assets/models/ogre.glb
still_life=assets/models/still_life.glb
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

size=1000,1000

draw() { # draw NAME MODEL ARGUMENTS...
	name=$1
	model=$2
	shift 2
	target/release/hachure render "$model" --output "screenshots/$name.png" --resolution "$size" --samples 64 "$@"
	echo "screenshots/$name.png"
}

# Technical illustration with black outlines and white folds (paper, Fig. 7).
draw gooch "$crank" --style gooch
draw gooch_ogre "$ogre" --style gooch
draw statue "$ogre" --style statue

# The papers' edge map and the buffers it comes from (Fig. 4 and 6).
for sample in crank ogre; do
	for buffer in normals depth normal_operator depth_operator edge_map; do
		draw "${sample}_$buffer" "assets/models/$sample.glb" --set edges.mode=image_space --set "view.show=$buffer"
	done
done

# Exact lines beside those of the papers' operators, diagonal and C1 (Fig. 5).
draw lines_exact "$crank" --style lines
draw lines_diagonal "$crank" --style lines --set edges.mode=image_space
draw lines_c1 "$crank" --style lines --set edges.mode=image_space --set edges.operator=c1

# Lines of any width.
for width in 1 4 16; do
	draw "width_$width" "$crank" --style lines \
		--set "edges.profile.width=$width" --set "edges.inner.width=$width"
done

# Classes told apart (Fig. 1): silhouettes, outlines before other objects, ridges, valleys, intersections.
draw classes "$crank" --style lines --set edges.inner.width=3 \
	--set edges.silhouette.color=#c02020 --set edges.object.color=#e08000 --set edges.ridge.color=#2050c0 \
	--set edges.valley.color=#108040 --set edges.intersection.color=#a020a0

# Dashed creases.
draw dashed "$crank" --style lines --set edges.inner.dashed=true --set edges.inner.width=2 \
	--set edges.dash.length=10 --set edges.dash.gap=5

# A pen that is pressed more and less.
draw pressure "$ogre" --style lines --set edges.profile.width=7 --set edges.inner.width=4 \
	--set edges.pressure.amount=0.9 --set edges.pressure.scale=70

# Lines in the surface's own color, darkened.
draw surface_color "$ogre" --style statue --set edges.object_color=1 --set edges.darken=0.65 \
	--set edges.profile.width=5 --set edges.inner.width=3

# Every object in a style of its own: Gooch before toon before halftone before plain paper.
draw mixed "$crank" --style newspaper --object-style 'piston*=gooch' --object-style 'rod*=comic' \
	--object-style 'flywheel=lines' --object-style 'crankshaft*=engraving' --set 'pulley:technique=plain'

# Each preset.
for preset in assets/styles/*.toml; do
	name=$(basename "$preset" .toml)
	draw "preset_$name" "$ogre" --style "$name"
done

# Sketches of a cloister from several places (Sketchy Drawings, Fig. 1 and 11).
cloister=assets/models/cloister.glb
size=1200,900
draw sketch_cloister "$cloister" --style loose-ink --camera-position 8.9,10.5,9.2 --camera-focal-point -2.5,1.8,-4 \
	--camera-view-angle 52
draw sketch_cloister_court "$cloister" --style loose-ink --camera-position 8.6,1.9,6.2 --camera-focal-point -6,2.9,-7 \
	--camera-view-angle 58
draw sketch_cloister_walk "$cloister" --style pencil-draft --set light.shadows=on \
	--camera-position 7,1.75,-12.7 --camera-focal-point -8,2.9,-12.1 --camera-view-angle 64
draw sketch_cloister_above "$cloister" --style architects-sketch --camera-azimuth-angle 24 --camera-elevation-angle 36 \
	--camera-view-angle 30
size=1000,1000
draw preset_architects-sketch assets/models/temple.glb --style architects-sketch
# Edges and colors before and after they were moved by noise of the picture (Fig. 3).
target/release/hachure render "$ogre" --output screenshots/sketch_map.png --resolution 800,800 --samples 64 \
	--style loose-ink --set sketch.enabled=off
draw sketch_map_after "$ogre" --style loose-ink --set sketch.anchor=screen --set sketch.noise=turbulence
# A sketch among objects in other styles, each before others and behind them (Fig. 5 and 6).
draw sketch_sprite "$crank" --style gooch --object-style 'piston*=crayon' --object-style 'rod*=comic' \
	--object-style 'flywheel=loose-ink' --object-style 'crankshaft*=pencil-draft'
# Edges twice, in two colors (Fig. 7).
draw sketch_twice "$ogre" --style ballpoint --set sketch.passes=2 --set sketch.pass1.color=#20306a \
	--set sketch.pass2.color=#b04a20 --set sketch.amount=1.6
# Chalk on rough paper (Fig. 8).
draw sketch_chalk "$ogre" --style chalk-on-slate --set paper=#f6f3ea --set edges.profile.color=#2a2622 \
	--set edges.inner.color=#2a2622 --set sketch.fill.object_color=1 --set sketch.grain.roughness=1.6
# Uncertainty controlled by the surface: more where it is curved, from enlarged geometry (Fig. 9).
draw sketch_curvature "$ogre" --style loose-ink --set sketch.anchor=curvature --set sketch.exterior=enlarged

# Hatching: six tones, of which the dark ones are composed of the light ones (Bu et al. 2006, Fig. 1).
cat >"$work/sheet.obj" <<OBJ
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
f 1 2 3 4
OBJ
for tone in 0.882 0.755 0.616 0.479 0.351 0.234; do
	target/release/hachure render "$work/sheet.obj" --output "$work/tone_$tone.png" --resolution 200,200 --samples 16 \
		--set technique=hatching --set hatching.mapping=image_space --set "hatching.tone.curve=0,$tone,1,$tone" \
		--set hatching.tone.lightest=0 --set hatching.tone.darkest=1 --set hatching.stroke.spacing=32 --set hatching.direction=y \
		--camera-position 0,0,3 --camera-focal-point 0,0,0 --set edges.profile.show=false
done
montage "$work"/tone_0.882.png "$work"/tone_0.755.png "$work"/tone_0.616.png "$work"/tone_0.479.png "$work"/tone_0.351.png \
	"$work"/tone_0.234.png -tile 6x1 -geometry +6+6 screenshots/hatching_tones.png
echo screenshots/hatching_tones.png
# Where strokes run; on the paper smoothly and in steps (Fig. 4); near edges (Fig. 3).
draw hatching_directions "$ogre" --style stroke-directions
draw hatching_image_space "$ogre" --style pen-and-ink --set hatching.mapping=image_space --set hatching.turn_step=0
draw hatching_image_space_steps "$ogre" --style pen-and-ink --set hatching.mapping=image_space
draw hatching_cross "$ogre" --style cross-hatch --set light.shadows=on
size=1200,900
temple() { # temple NAME ARGUMENTS...
	name=$1
	shift
	draw "$name" assets/models/temple.glb --set light.shadows=on --set light.key.azimuth=-55 --set light.key.elevation=35 \
		--camera-position -24,7,48 --camera-focal-point 2,5,10 --camera-view-angle 40 "$@"
}
temple hatching_temple --style pen-and-ink
temple hatching_indication --style pen-and-ink --set hatching.indication.amount=1 --set hatching.indication.distance=10
# The fields of the paper (Fig. 3): the general field map, silhouettes nearby, both; and a drawing with all of the paper: strokes on
# the picture in steps, Sobel outlines, cast shadows in strokes of their own, indication (Fig. 5 and 8).
temple hatching_field --style pen-and-ink --set hatching.indication.amount=1 --set hatching.indication.by=fields \
	--set hatching.indication.patches.share=1 --set hatching.indication.silhouettes.share=0 --set view.show=detail
temple hatching_fields --style pen-and-ink --set hatching.indication.amount=1 --set hatching.indication.by=fields \
	--set view.show=detail
temple hatching_as_in_paper --style pen-and-ink --set hatching.mapping=image_space --set hatching.indication.amount=0.7 \
	--set hatching.indication.by=fields --set edges.mode=image_space --set edges.operator=sobel \
	--set hatching.shadows.differ=true --set hatching.shadows.turn=50
yard() { # yard NAME ARGUMENTS...
	name=$1
	shift
	draw "$name" assets/models/temple.glb --set light.shadows=on --set light.key.azimuth=-40 --set light.key.elevation=42 \
		--set light.key.attached=world --camera-position -6,2.4,22 --camera-focal-point 8,3.5,10 --camera-view-angle 60 "$@"
}
yard hatching_yard --style pen-and-ink
size=1000,1000
draw hatching_crank "$crank" --style engraving --set light.shadows=on
draw hatching_still_life "$still_life" --style pencil-hatching --mirror glass --set light.shadows=on \
	--set edges.texture.show=true

# A statue in strokes before a mirror, with edges in both (Fig. 8).
cat >"$work/mirror.obj" <<OBJ
o glass
v -1.9 0 -1.5
v 1.7 0 -1.5
v 1.7 2.7 -1.5
v -1.9 2.7 -1.5
f 1 2 3 4
OBJ
target/release/hachure render "$ogre" "$work/mirror.obj" --output screenshots/mirror.png --resolution 1000,1000 \
	--samples 64 --style engraving --mirror glass --object-style 'mirror=lines' \
	--camera-azimuth-angle -35 --camera-elevation-angle 12
echo screenshots/mirror.png

# Borders of a toon's bands, nearest beside the cartoon map, enlarged (Fig. 9).
for border in nearest cartoon_map; do
	target/release/hachure render "$ogre" --output "$work/$border.png" --resolution 640,640 --style comic \
		--set "toon.smoothing=$border"
	convert "$work/$border.png" -crop 125x125+225+150 +repage -scale 400% "$work/$border.png"
done
convert "$work/nearest.png" "$work/cartoon_map.png" +append screenshots/toon_borders.png
echo screenshots/toon_borders.png

# Blueprints: all layers of an assembly (Blueprints paper, Fig. 1) and of a building, before opaque statues.
draw blueprint "$crank" --style blueprint
draw blueprint_temple assets/models/temple.glb --style blueprint --object-style '/temple/statues*=technical-illustration' \
	--set blueprint.max_layers=16 --set 'blueprint.fill_opacity=0.03' --camera-azimuth-angle 35 --camera-elevation-angle 35

# What each depth layer is drawn from: depth, normals and edge map (Blueprints paper, Fig. 4).
for buffer in depth normals edge_map; do
	for layer in 1 2 3 4 5; do
		target/release/hachure render "$crank" --output "$work/$buffer.$layer.png" --resolution 800,800 \
			--set edges.mode=image_space --set "view.show=$buffer" --set "view.layer=$layer"
	done
	convert "$work/$buffer".[1-5].png +append -resize 50% "$work/$buffer.png"
done
convert "$work/depth.png" "$work/normals.png" "$work/edge_map.png" -append screenshots/blueprint_layers.png
echo screenshots/blueprint_layers.png

# Depth masking: everything before the statues, and nothing behind them (Fig. 7).
size=1240,860
draw blueprint_mask assets/models/temple.glb --style blueprint --mask '/temple/statues/*' \
	--set blueprint.beyond=false --camera-azimuth-angle -20 --camera-elevation-angle 25
size=1000,1000

# White on blue paper.
draw blueprint_white_on_blue "$crank" --style blueprint-white-on-blue
# A building in plan and from the side, at the same scale on paper (Blueprints paper, Fig. 8).
for side in top right; do
	[ "$side" = top ] && size=760,1340 || size=1340,760
	draw "temple_$side" assets/models/temple.glb --style blueprint --look-from "$side" --camera-orthographic \
		--scale 1:400 --dpi 160 --set blueprint.max_layers=32 --set blueprint.fill_opacity=0.02 --set view.scale_bar=true
done
size=1000,1000
# Blueprints of several styles that go through each other.
draw see_through "$crank" --style gooch --object-style 'piston*=blueprint' --object-style 'rod*=blueprint-vellum' \
	--set 'rod*:blueprint.fill_opacity=0.5' --object-style 'crankshaft*=blueprint' \
	--set 'crankshaft*:blueprint.fill=#c03010' --set 'crankshaft*:blueprint.fill_opacity=0.35'
# Hidden lines of surfaces.
draw hidden_lines "$crank" --style hidden-lines --set edges.hidden.layers=next
draw x_ray assets/models/temple.glb --style x-ray --camera-azimuth-angle 35 --camera-elevation-angle 30
# A plan cut at a height, and an assembly cut open.
draw section_temple assets/models/temple.glb --style lines --section y=2 --camera-orthographic --look-from top
draw section_crank "$crank" --style technical-illustration --section z=0 --set section.color=#f4d9a8

# Ways to a hidden chamber: a red box and red arrows among blueprints, in perspective and from above (Fig. 9).
paths() { # paths NAME ARGUMENTS...
	name=$1
	shift
	target/release/hachure render screenshots/temple_paths.hachure --output "screenshots/$name.png" --samples 64 "$@"
	echo "screenshots/$name.png"
}
paths temple_paths --resolution 1200,840 --camera-azimuth-angle -50 --camera-elevation-angle 35
paths temple_paths_plan --resolution 1200,660 --camera-orthographic --camera-position=0,100,2 \
	--camera-focal-point=0,0,2 --camera-view-up=-1,0,0 --camera-view-height 42

# Shadows in each technique.
for style in plain gooch comic engraving newspaper; do
	draw "shadows_$style" "$ogre" --style "$style" --set light.shadows=true --set light.key.azimuth=-55 \
		--set light.key.elevation=40 --set light.shadow_softness=0.5
done

# Images, relief, leaves cut out of sheets, and a mirror, with edges of textures.
draw still_life "$still_life" --style technical-illustration --mirror glass --set edges.texture.show=true \
	--set edges.texture.width=1.2 --set light.shadows=true --set 'label:edges.texture.color=#303040' \
	--set 'leaf*:edges.texture.color=#203010'
draw still_life_engraving "$still_life" --style engraving --mirror glass --set light.shadows=true \
	--set light.shadow_softness=1

# The window itself, on a virtual display.
home=$(mktemp -d)
display=:$((90 + $$ % 900))
Xvfb "$display" -screen 0 1280x820x24 >/dev/null 2>&1 &
screen=$!
trap 'kill $viewer $screen 2>/dev/null; rm -rf "$home" "$work"' EXIT
sleep 2
DISPLAY=$display WAYLAND_DISPLAY='' XDG_DATA_HOME=$home target/release/hachure "$crank" >/dev/null 2>&1 &
viewer=$!
sleep 8
DISPLAY=$display import -window root screenshots/window.png
echo screenshots/window.png
