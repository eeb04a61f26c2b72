# What a developer runs. Each target installs what it needs and is missing (see .ci/packages).

SAMPLE := assets/models/crank.glb
HACHURE := cargo run --quiet --release --

.PHONY: run test check check-targets bench quality gallery bless models textures strokes docs

# Opens the viewer on the sample model; without a display draws it to a file.
run:
	@sh .ci/packages run
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ]; then \
		cargo run --release -- $(SAMPLE); \
	else \
		cargo run --release -- render $(SAMPLE) --output target/crank.png --resolution 1600,1200 && \
		echo "No display here: the sample is drawn in target/crank.png"; \
	fi

# All tests, on software Vulkan and a virtual display where there is nothing better.
test:
	@sh .ci/packages test
	cargo test --workspace

check:
	@sh .ci/packages build
	cargo fmt --check
	cargo clippy --all-targets -- --deny warnings
	RUSTDOCFLAGS="--deny warnings" cargo doc --no-deps --document-private-items

# Whether it compiles for Windows and macOS, from wherever this is; nothing is linked, so no compiler of theirs is needed.
TARGETS := x86_64-pc-windows-gnu aarch64-apple-darwin
check-targets:
	@sh .ci/packages build
	rustup target add $(TARGETS)
	for target in $(TARGETS); do \
		name=$$(echo $$target | tr - _); \
		env CC_$$name=true CXX_$$name=true AR_$$name=true cargo check --target $$target || exit 1; \
	done

# Milliseconds per stage and frame.
bench:
	@sh .ci/packages run
	$(HACHURE) bench
	$(HACHURE) bench assets/models/ogre.glb

# Heavy measurements, in release.
quality:
	@sh .ci/packages test
	cargo test --release --no-fail-fast --test quality --test many_objects --test line_table --test line_continuity --test line_width --test shadows \
		--test halftone --test layers --test blueprint --test sketch_coherence --test hatching --test stroke_coherence --test seams -- --ignored --nocapture --test-threads 1

# The sample models, from their generator.
models:
	@sh .ci/packages build
	cargo run --release --example models

# The built-in textures of techniques, from their generator.
textures:
	@sh .ci/packages build
	cargo run --release --example textures

# The built-in stroke sets of hatching, from their generator.
strokes:
	@sh .ci/packages build
	cargo run --release --example strokes

# The page of presets and parameters, from the program.
docs:
	@sh .ci/packages build
	cargo build --quiet --release
	target/release/hachure styles --markdown >docs/parameters.md

# Every picture under screenshots/, each by one command.
gallery:
	@sh .ci/packages gallery
	sh screenshots/gallery.sh

# Shows which golden pictures changed and accepts them when the answer is yes.
bless:
	@sh .ci/packages test
	-cargo test --test pictures
	@sh .ci/bless
