# What people type. Each target sets up what is missing, is quiet, and may be repeated.
#   make          the same as make build
#   make build    the command at build/release/bin/svt
#   make demo     a generated house, its volume and pictures under build/demo; then the viewer, and how to open it
#   make test     all tests
#   make web      the library as a WebAssembly module: build/web/svt.js and svt.wasm
#   make viewer   the page that shows buildings, with that module: build/release/share/svt/viewer
#   make bench    times against VTK, OpenVDB and libcitygml (installs them)
#   make check    format, layers, error pages, command pages
#   make clean    removes build/

SHELL := /bin/bash
.DEFAULT_GOAL := build
.PHONY: build demo test web viewer bench check clean setup

setup:
	@scripts/setup.sh

build: setup
	@scripts/build.sh release svt

viewer: web
	@scripts/viewer.sh

demo: build
	@scripts/demo.sh
	@$(MAKE) -s viewer
	@echo "demo: 'build/release/bin/svt view build/demo/house.svt' opens the house in the browser"

test: setup
	@scripts/check.sh
	@scripts/build.sh release
	@$(MAKE) -s viewer
	@scripts/test.sh

web:
	@scripts/setup.sh web
	@scripts/web_dependencies.sh
	@scripts/build.sh web svt_web

bench:
	@scripts/setup.sh peers
	@scripts/build.sh bench svt svt_bench
	@python3 scripts/bench.py

check: setup
	@scripts/check.sh

clean:
	@rm -rf build
