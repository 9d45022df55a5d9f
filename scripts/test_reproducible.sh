#!/usr/bin/env bash
# Builds the last commit twice from nothing, without ccache, in clones whose paths, time zone, locale and file permissions
# differ, and compares the bytes of the command. Prints the objects that differ. The release build takes some 10 minutes of
# two cores.
#   scripts/test_reproducible.sh [TARGET]   another file of the build folder, such as libsvt_core.a; default: bin/svt
set -euo pipefail
cd "$(dirname "$0")/.."
target=${1:-bin/svt}
root=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
commit=$(git rev-parse HEAD)

build() { # folder of the clone, mask of permissions
  umask "$2"
  mkdir -p "${1%/*}"
  git clone --quiet --no-checkout "$root" "$1"
  git -C "$1" checkout --quiet "$commit"
  if ! (cd "$1" && cmake --preset release -DCCACHE_PROGRAM=OFF -DSVT_TESTS=OFF -DSVT_PYTHON=OFF && \
    cmake --build build/release --target "$target") >"$work/log" 2>&1; then
    tail -n 40 "$work/log" >&2
    echo "reproducible: $target cannot be built in $1" >&2
    exit 1
  fi
}
one=$work/one two=$work/a-longer-path/of/two
TZ=UTC LC_ALL=C build "$one" 022
TZ=Pacific/Auckland LC_ALL=C.UTF-8 build "$two" 027

if cmp "$one/build/release/$target" "$two/build/release/$target"; then
  echo "reproducible: $target of $commit has the same bytes in two clones"
  exit 0
fi
(cd "$one/build/release" && find . -name '*.o' -print0 | sort -z) | while IFS= read -r -d '' object; do
  cmp -s "$one/build/release/$object" "$two/build/release/$object" || echo "reproducible: differs: $object" >&2
done
echo "reproducible: $target depends on more than the commit" >&2
exit 1
