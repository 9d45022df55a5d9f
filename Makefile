# What people type. Each target sets up what is missing, is quiet, and may be repeated.
#   make          the same as make build
#   make build    the command at build/release/bin/svt
#   make demo-city  a generated town of 3000 buildings as a city, pictures and figures under build/demo-city; then the page
#   make demo     a generated house, its volume and pictures under build/demo; then the viewer, and how to open it
#   make test     all tests
#   make fast     the tests of the folders that differ from the upstream branch, or from the commit BASE=
#   make web      the library as a WebAssembly module: build/web/svt.js and svt.wasm
#   make viewer   the page that shows buildings, with that module: build/release/share/svt/viewer
#   make python   the Python module svt: build/release/python, and a wheel in build/wheel
#   make site     the documentation site: build/site (REPOSITORY= for edit links)
#   make bench    times against VTK, OpenVDB and libcitygml (installs them)
#   make check    layers, error pages, banned calls, format, linters and types of C++, Python, TypeScript and shell, without building
#   make verify   every check, heavy ones too, with a report: build/verify/report.md (CHECKS="asan tidy" for some)
#   make asan     all tests with the address and undefined-behaviour sanitizers
#   make tsan     the thread sanitizer on what is parallel
#   make tidy     clang-tidy over all sources
#   make fuzz     each fuzz target for a minute (SECONDS=600 for longer; RUNS=3000 for the same inputs each time)
#   make coverage the lines and branches of each folder that tests reach
#   make mutants  changes in the sources that tests do not notice (FOLDERS="volume voxelize", COUNT=30)
#   make install  the command with manual and viewer, the libraries: PREFIX=/usr/local DESTDIR=
#   make package  .deb files for Debian 12: build/package
#   make npm      npm packages: the command as WebAssembly with the library, and the web component: build/npm (REPOSITORY=https://...)
#   make release  the artefacts of a version, VERSION=0.2.0, from a clean tree: build/release-artifacts
#   make clean    removes build/

SHELL := /bin/bash
# Files with defaults of the user do not change results.
export SVT_NO_CONFIG := 1
.DEFAULT_GOAL := build
.PHONY: release verify site coverage fast build demo demo-city install package npm python test web viewer bench check asan tsan tidy fuzz mutants clean setup
SECONDS ?= 60
FOLDERS ?= volume voxelize mesh render readers
COUNT ?= 30
PREFIX ?= /usr/local

setup:
	@scripts/setup.sh

build: setup
	@scripts/build.sh release svt

viewer: web
	@scripts/viewer.sh

demo-city: build
	@scripts/demo_city.sh
	@$(MAKE) -s viewer
	@build/release/bin/svt publish build/demo-city/town -o build/demo-city/page --force
	@echo "demo-city: 'build/release/bin/svt view build/demo-city/town' opens the town in the browser"

demo: build
	@scripts/demo.sh
	@$(MAKE) -s viewer
	@echo "demo: 'build/release/bin/svt view build/demo/house.svt' opens the house in the browser"

test:
	@scripts/setup.sh node
	@scripts/check.sh
	@scripts/build.sh release
	@$(MAKE) -s npm
	@$(MAKE) -s python
	@scripts/test.sh

fast: setup
	@scripts/test.sh changed $(BASE)

web:
	@scripts/setup.sh web
	@scripts/web_dependencies.sh
	@scripts/build.sh web svt_web

site: build viewer python
	@scripts/setup.sh site
	@scripts/site.sh --repository "$(REPOSITORY)" --branch "$(or $(BRANCH),main)"

bench:
	@scripts/setup.sh peers
	@scripts/build.sh bench svt svt_bench
	@python3 scripts/bench.py

check:
	@scripts/setup.sh node
	@scripts/check.sh

verify:
	@scripts/verify.py $(CHECKS)

asan tsan:
	@scripts/setup.sh checks
	@scripts/sanitize.sh $@

tidy:
	@scripts/setup.sh checks
	@scripts/tidy.py

fuzz:
	@scripts/setup.sh checks
	@scripts/fuzz.sh $(if $(RUNS),$(RUNS)runs,$(SECONDS))

coverage:
	@scripts/coverage.py

mutants: setup
	@scripts/mutants.py $(FOLDERS) --count $(COUNT)

install: setup
	@scripts/build.sh release svt svt_manual
	@DESTDIR=$(DESTDIR) cmake --install build/release --prefix $(PREFIX) >build/release/install.log || { cat build/release/install.log >&2; exit 1; }
	@echo "install: in $(DESTDIR)$(PREFIX)"

python: setup
	@scripts/setup.sh python
	@scripts/python.sh

package: build viewer python
	@scripts/package.sh

npm: build viewer
	@scripts/build.sh web svt_node
	@scripts/npm.sh

release:
	@scripts/release.sh $(VERSION)

clean:
	@rm -rf build
