#!/usr/bin/env bash
# Installs the packages that SVT needs to build and test on Debian 12. Does nothing if all are installed.
#   scripts/setup.sh          for `make build`, `make test` and `make demo`
#   scripts/setup.sh peers    also the peers used only by `make bench`
#   scripts/setup.sh readers  also the programs that read our formats in tests, which are skipped without them
#   scripts/setup.sh python   also the tools to build and test the Python module
#   scripts/setup.sh slurm    also Slurm, for the test of job arrays (scripts/test_slurm.sh)
#   scripts/setup.sh checks   also the tools of `make tidy` and `make fuzz`
#   scripts/setup.sh site     also the tools that build the documentation site (`make site`)
#   scripts/setup.sh packages also the tools that test the .deb files on a clean system
#   scripts/setup.sh node     also Node.js with npm, for `make check` and the page
#   scripts/setup.sh web      also the tools to build and test the WebAssembly module and the page
set -euo pipefail

packages=(
  build-essential cmake ninja-build pkg-config
  libpugixml-dev libsimdjson-dev nlohmann-json3-dev libglu1-mesa-dev libtbb-dev
  libfmt-dev libcli11-dev zlib1g-dev libzstd-dev libpng-dev libjpeg62-turbo-dev libhwy-dev libpolyclipping-dev
  libproj-dev proj-bin libfreetype-dev fonts-dejavu-core libegl-dev libgles-dev libegl-mesa0 libgl1-mesa-dri libcairo2-dev libqpdf29 qpdf libfribidi0 libxlsxwriter-dev
  clang-format shellcheck flake8 black mypy libgtest-dev libxml2-utils librsvg2-bin poppler-utils gdal-bin unzip file python3 ccache
)
peers=(libvtk9-dev libopenvdb-dev libboost-dev libcitygml-dev xvfb xauth valgrind)
readers=(ffmpeg python3-nibabel python3-tifffile python3-zarr python3-vtk9 python3-networkx python3-numcodecs
  python3-openvdb python3-xarray python3-pandas python3-geopandas python3-netcdf4 python3-dask
  jupyter-nbconvert python3-ipykernel libembree-dev openfoam openmpi-bin)
web=(emscripten libfast-float-dev dpkg-dev chromium-headless-shell)
slurm=(slurmctld slurmd slurm-client munge python3-yaml)
python=(python3-dev pybind11-dev python3-numpy python3-scipy)
site=(mkdocs mkdocs-material doxygen doxygen-awesome-css python3-pil)
debian=(debootstrap lintian dpkg-dev desktop-file-utils shared-mime-info libglib2.0-bin zip)
checks=(clang clang-tidy clang-tools libclang-rt-14-dev llvm)
# A Node.js from another source has its own npm, which conflicts with Debian's.
node=()
command -v node >/dev/null || node+=(nodejs)
command -v npm >/dev/null || node+=(npm)
[ "${1:-}" = peers ] && packages+=("${peers[@]}")
[ "${1:-}" = readers ] && packages+=("${readers[@]}")
[ "${1:-}" = node ] && packages+=("${node[@]}")
[ "${1:-}" = web ] && packages+=("${web[@]}" "${node[@]}")
[ "${1:-}" = slurm ] && packages+=("${slurm[@]}")
[ "${1:-}" = python ] && packages+=("${python[@]}")
[ "${1:-}" = site ] && packages+=("${site[@]}")
[ "${1:-}" = packages ] && packages+=("${debian[@]}")
[ "${1:-}" = checks ] && packages+=("${checks[@]}")

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

sudo=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup: need root or sudo to install: ${missing[*]}" >&2; exit 1; }
  sudo=sudo
fi
echo "setup: installing ${#missing[@]} packages: ${missing[*]}"
log=$(mktemp)
run() {
  if ! $sudo env DEBIAN_FRONTEND=noninteractive "$@" >"$log" 2>&1; then
    cat "$log" >&2
    echo "setup: '$*' failed; see above" >&2
    exit 1
  fi
}
run apt-get update -q
run apt-get install -y -q --no-install-recommends "${missing[@]}"
rm -f "$log"
