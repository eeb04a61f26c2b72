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
	target/release/hachure render "$model" --output "screenshots/$name.png" --resolution 1000,1000 "$@"
	echo "screenshots/$name.png"
}

# Technical illustration with white inner and black profile edges (paper, Fig. 7).
draw gooch "$crank" --style gooch
draw gooch_ogre "$ogre" --style gooch

# The edge map and the buffers it comes from (Fig. 4 and 6).
for sample in crank ogre; do
	for buffer in normals depth normal_operator depth_operator edge_map; do
		draw "${sample}_$buffer" "assets/models/$sample.glb" --set "view.show=$buffer"
	done
done
draw statue "$ogre" --style statue

# The C1 operator beside the diagonal one (Fig. 5).
draw lines_diagonal "$crank" --style lines
draw lines_c1 "$crank" --style lines --set edges.operator=c1

# Silhouettes and creases told apart (Fig. 1).
draw classes "$crank" --style lines --set edges.profile.color=#c02020 --set edges.inner.color=#2050c0

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
