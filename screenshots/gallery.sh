#!/bin/sh
# Every picture of the gallery, each by one call of `hachure render`. Run by `make gallery`.
set -eu
cd "$(dirname "$0")/.."
cargo build --quiet --release
crank=assets/models/crank.glb
ogre=assets/models/ogre.glb

draw() { # draw NAME MODEL ARGUMENTS...
	name=$1
	model=$2
	shift 2
	target/release/hachure render "$model" --output "screenshots/$name.png" --resolution 1000,1000 --samples 64 "$@"
	echo "screenshots/$name.png"
}

# Technical illustration with white inner and black profile edges (paper, Fig. 7).
draw gooch "$crank" --style gooch
draw gooch_ogre "$ogre" --style gooch
draw statue "$ogre" --style statue

# The papers' edge map and the buffers it comes from (Fig. 4 and 6).
for sample in crank ogre; do
	for buffer in normals depth normal_operator depth_operator edge_map; do
		draw "${sample}_$buffer" "assets/models/$sample.glb" --set edges.mode=paper --set "view.show=$buffer"
	done
done

# Exact lines beside those of the papers' operators, diagonal and C1 (Fig. 5).
draw lines_exact "$crank" --style lines
draw lines_diagonal "$crank" --style lines --set edges.mode=paper
draw lines_c1 "$crank" --style lines --set edges.mode=paper --set edges.operator=c1

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

# Lines in the surface's own colour, darkened.
draw surface_color "$ogre" --style statue --set edges.surface_color=1 --set edges.darken=0.65 \
	--set edges.profile.width=5 --set edges.inner.width=3

# Every object in a style of its own.
draw mixed "$crank" --style statue --object-style 'piston*=gooch' --object-style 'flywheel=lines' \
	--set 'rod*:edges.profile.color=#d02020' --no-enhance pulley

# The window itself, on a virtual display.
home=$(mktemp -d)
display=:$((90 + $$ % 900))
Xvfb "$display" -screen 0 1280x820x24 >/dev/null 2>&1 &
screen=$!
trap 'kill $viewer $screen 2>/dev/null; rm -rf "$home"' EXIT
sleep 2
DISPLAY=$display WAYLAND_DISPLAY='' XDG_DATA_HOME=$home target/release/hachure "$crank" >/dev/null 2>&1 &
viewer=$!
sleep 8
DISPLAY=$display import -window root screenshots/window.png
echo screenshots/window.png
