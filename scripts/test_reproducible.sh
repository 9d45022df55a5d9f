#!/usr/bin/env bash
# Builds the last commit twice from nothing, without ccache, in clones whose paths, time zone, locale and file permissions
# differ, and compares the bytes of the command. Prints the objects that differ. The release build takes some 10 minutes of
# two cores.
#   scripts/test_reproducible.sh [TARGET]   another file of the build folder, such as libsvt_core.a; default: bin/svt
#   scripts/test_reproducible.sh artifacts  all artefacts of a release (scripts/release.sh) of the tree's version, an hour of
#                                           two cores; lists the files inside those that differ
set -euo pipefail
cd "$(dirname "$0")/.."
target=${1:-bin/svt}
root=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
commit=$(git rev-parse HEAD)

# What the build fetches from elsewhere is copied: it is an input.
make_artifacts() { # folder of the clone
  local input
  for input in build/web-sources web/viewer/node_modules; do
    [ ! -d "$root/$input" ] || { mkdir -p "$1/${input%/*}" && cp -r "$root/$input" "$1/${input%/*}"; }
  done
  if ! (cd "$1" && CCACHE_DISABLE=1 scripts/release.sh "$(python3 scripts/release/version.py)") >"$work/log" 2>&1; then
    tail -n 40 "$work/log" >&2
    echo "reproducible: the release cannot be made in $1" >&2
    exit 1
  fi
}

unpack() { # artefact, folder
  mkdir -p "$2"
  case $1 in
    *.deb) dpkg-deb --raw-extract "$1" "$2" ;;
    *.whl) unzip -q "$1" -d "$2" ;;
    *.tgz | *.tar.gz) tar -xf "$1" -C "$2" ;;
    *) cp "$1" "$2" ;;
  esac
}

compare_artifacts() {
  local result=0 name
  (cd "$one/build/release-artifacts" && ls) >"$work/names.one"
  (cd "$two/build/release-artifacts" && ls) >"$work/names.two"
  cmp "$work/names.one" "$work/names.two" || result=1
  while read -r name; do
    cmp -s "$one/build/release-artifacts/$name" "$two/build/release-artifacts/$name" && continue
    [ "$name" = SHA256SUMS ] && continue  # differs as they do
    result=1
    rm -rf "$work/unpacked"
    unpack "$one/build/release-artifacts/$name" "$work/unpacked/one"
    unpack "$two/build/release-artifacts/$name" "$work/unpacked/two"
    echo "reproducible: differs: $name" >&2
    (cd "$work/unpacked" && diff -rq --no-dereference one two | sed 's/^/reproducible:   /') >&2 || true
  done <"$work/names.one"
  return $result
}

build() { # folder of the clone, mask of permissions
  umask "$2"
  mkdir -p "${1%/*}"
  git clone --quiet --no-checkout "$root" "$1"
  git -C "$1" checkout --quiet "$commit"
  if [ "$target" = artifacts ]; then
    make_artifacts "$1"
    return
  fi
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

if [ "$target" = artifacts ]; then
  compare_artifacts || { echo "reproducible: artefacts depend on more than the commit" >&2; exit 1; }
  echo "reproducible: all artefacts of $commit have the same bytes in two clones"
  exit 0
fi
if cmp "$one/build/release/$target" "$two/build/release/$target"; then
  echo "reproducible: $target of $commit has the same bytes in two clones"
  exit 0
fi
(cd "$one/build/release" && find . -name '*.o' -print0 | sort -z) | while IFS= read -r -d '' object; do
  cmp -s "$one/build/release/$object" "$two/build/release/$object" || echo "reproducible: differs: $object" >&2
done
echo "reproducible: $target depends on more than the commit" >&2
exit 1
