# Archives of the tools for machines without a toolchain: out/dist/bondline-VERSION-TARGET.tar.gz. The C library is linked in, so that they
# start on any Linux of the processor; TARGET=x86_64-unknown-linux-musl takes musl's, where rustup has it and a C compiler for it is there.

TARGET ?= $(shell uname -m)-unknown-linux-gnu
VERSION := $(shell sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
DIST := bondline-$(VERSION)-$(TARGET)
# What is beside the tools: how to begin, licences, examples and what reads their files.
BESIDE = README.md LICENSE CHANGELOG.md docs pipelines/cases pipelines/examples readers lib/particle-file/FORMAT.md

.PHONY: dist
dist:
	RUSTFLAGS="-C target-feature=+crt-static" $(CARGO) build --release --target $(TARGET) $(TOOLS:%=-p %)
	@rm -rf out/dist/$(DIST) && mkdir -p out/dist/$(DIST)/bin
	install -s $(TOOLS:%=target/$(TARGET)/release/%) out/dist/$(DIST)/bin
	@cp -r --parents $(BESIDE) out/dist/$(DIST)
	@$(CARGO) tree --target $(TARGET) -e normal --prefix none --format '{p} {l}' $(TOOLS:%=-p %) | \
	    bash pipelines/licences.sh out/dist/$(DIST)/licences
	@cd out/dist && tar -czf $(DIST).tar.gz --owner=0 --group=0 --sort=name $(DIST) && sha256sum $(DIST).tar.gz >$(DIST).tar.gz.sha256
	@echo "$$(du -m out/dist/$(DIST).tar.gz | cut -f 1) MB in out/dist/$(DIST).tar.gz"
