#!/usr/bin/env bash
# Tests the files for the desktop as a desktop uses them: thumbnails by the declared command, types of files by the shared
# MIME database, the entry of the menu.
#   scripts/test_desktop.sh SVT [SHARE]   SVT: the command; SHARE: share folder of an installation, default: cmake/desktop
# Uses xmllint, desktop-file-validate, update-mime-database with gio, and tumbler where they are installed. With
# SVT_STRICT=1 a missing one is a failure, except tumbler.
set -euo pipefail
svt=$(realpath "$(command -v "${1:?usage: $0 SVT [SHARE]}")")
source=$(realpath "$(dirname "$0")/..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "desktop: $*" >&2; exit 1; }
has() {
  command -v "$1" >/dev/null && return
  [ -z "${SVT_STRICT:-}" ] || fail "$1 is missing"
  echo "desktop: $1 is missing; not tested with it"
  return 1
}

# --- the files
share=${2:-}
if [ -z "$share" ]; then
  share=$work/share
  mkdir -p "$share"/{applications,thumbnailers,mime/packages}
  cp "$source/cmake/desktop/svt.desktop" "$share/applications"
  cp "$source/cmake/desktop/svt.thumbnailer" "$share/thumbnailers"
  cp "$source/cmake/desktop/svt.xml" "$share/mime/packages"
  for picture in "$source"/cmake/desktop/icons/svt-*.png; do
    size=${picture##*-} size=${size%.png}
    mkdir -p "$share/icons/hicolor/${size}x$size/apps"
    cp "$picture" "$share/icons/hicolor/${size}x$size/apps/svt.png"
  done
  mkdir -p "$share/icons/hicolor/scalable/apps"
  cp "$source/cmake/desktop/icons/svt.svg" "$share/icons/hicolor/scalable/apps"
fi
entry=$share/applications/svt.desktop thumbnailer=$share/thumbnailers/svt.thumbnailer types=$share/mime/packages/svt.xml
for file in "$entry" "$thumbnailer" "$types" "$share/icons/hicolor/scalable/apps/svt.svg"; do
  [ -s "$file" ] || fail "$file is missing"
done
valueOf() { sed -n "s/^$2=//p" "$1"; } # file, key
widthOf() { printf '%d' "0x$(od -An -tx1 -j16 -N4 "$1" | tr -d ' \n')"; } # of a PNG
for size in 16 32 48 128 256; do
  [ "$(widthOf "$share/icons/hicolor/${size}x$size/apps/svt.png")" = "$size" ] || fail "the icon of $size pixels has another width"
done

# The entry, the thumbnailer and the types name the same types.
declared=$(sed -n 's/.*<mime-type type="\([^"]*\)".*/\1/p' "$types" | sort)
for file in "$entry" "$thumbnailer"; do
  [ "$(valueOf "$file" MimeType | tr ';' '\n' | sed '/^$/d' | sort)" = "$declared" ] || fail "$file lists other types than $types"
done
if has xmllint; then xmllint --noout "$types"; fi
if has desktop-file-validate; then
  said=$(desktop-file-validate "$entry" 2>&1) || fail "$said"
  [ -z "$said" ] || fail "$said"
fi

# --- samples, and files that belong to others
samples=$work/samples others=$work/others
mkdir "$samples" "$others"
make() { "$svt" "$@" --quiet || fail "svt $* failed"; }
make sample house -o "$samples/house.gml"
make sample house -o "$samples/old.gml" --format citygml2
make sample house -o "$samples/house.json"
make sample district -o "$samples/house.jsonl" --columns 1 --rows 1
make sample house -o "$samples/house.ifc"
make build "$samples/house.gml" -o "$samples/house.svt" --spacing 0.2
make convert "$samples/house.svt" "$samples/rooms.indoor.gml"
cp "$samples/rooms.indoor.gml" "$samples/rooms.gml"
cp "$samples/house.gml" "$samples/house.citygml"
cp "$samples/house.json" "$samples/house.city.json"
cp "$samples/house.json" "$samples/house.cityjson"
cp "$samples/house.jsonl" "$samples/house.city.jsonl"
cp "$samples/house.ifc" "$samples/no_ending"
cp "$samples/house.gml" "$samples/a name with spaces & more.gml"
if has zip; then (cd "$samples" && zip -q house.ifczip house.ifc); fi
printf '<?xml version="1.0"?>\n<gml:FeatureCollection xmlns:gml="http://www.opengis.net/gml/3.2"/>\n' >"$others/plain.gml"
printf '<?xml version="1.0"?>\n<note/>\n' >"$others/note.xml"
printf '{"type": "FeatureCollection", "features": []}\n' >"$others/data.json"
printf '{"a": 1}\n{"a": 2}\n' >"$others/lines.jsonl"
printf "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\n" >"$others/part.stp"
if has zip; then (cd "$others" && zip -q archive.zip data.json); fi

# --- thumbnails, as a file manager makes them: the output is an empty file without ending
command=$(valueOf "$thumbnailer" Exec)
[ "$(valueOf "$thumbnailer" TryExec)" = "${command%% *}" ] || fail "TryExec and Exec of the thumbnailer name two programs"
mkdir "$work/bin"
ln -s "$svt" "$work/bin/${command%% *}"
export PATH=$work/bin:$PATH
thumbnail() { # input, output, size
  local words word
  read -ra words <<<"$command"
  for word in "${!words[@]}"; do
    case ${words[$word]} in
      %i) words[word]=$1 ;;
      %u) words[word]=file://$1 ;;
      %o) words[word]=$2 ;;
      %s) words[word]=$3 ;;
    esac
  done
  "${words[@]}"
}
for file in "$samples"/*; do
  output=$(mktemp "$work/thumbnail.XXXXXX")
  thumbnail "$file" "$output" 128 || fail "no thumbnail of $file"
  [ "$(od -An -tx1 -N8 "$output" | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "the thumbnail of $file is not a PNG"
  [ "$(widthOf "$output")" = 128 ] || fail "the thumbnail of $file is $(widthOf "$output") pixels wide"
  [ "$(wc -c <"$output")" -gt 2000 ] || fail "the thumbnail of $file is empty"
done
output=$(mktemp "$work/thumbnail.XXXXXX")
if thumbnail "$others/data.json" "$output" 128 2>"$work/said"; then fail "a file that is not a model has a thumbnail"; fi
grep -q '^svt: error E' "$work/said" || fail "the error of a file that is not a model is: $(cat "$work/said")"
[ ! -s "$output" ] || fail "an error leaves a thumbnail"

# --- types
typeOf() { gio info -a standard::content-type "$1" | sed -n 's/.*standard::content-type: //p'; }
expectType() { # file, type
  local found
  [ -e "$1" ] || return 0
  found=$(typeOf "$1")
  [ "$found" = "$2" ] || fail "$(basename "$1") has the type '$found', not '$2'"
}
if has update-mime-database && has gio; then
  export XDG_DATA_HOME=$work/home XDG_DATA_DIRS=/usr/share
  mkdir -p "$XDG_DATA_HOME/mime/packages" "$XDG_DATA_HOME/applications"
  cp "$types" "$XDG_DATA_HOME/mime/packages"
  cp "$entry" "$XDG_DATA_HOME/applications"
  said=$(update-mime-database "$XDG_DATA_HOME/mime" 2>&1) || fail "$said"
  [ -z "$said" ] || fail "update-mime-database: $said"
  for file in house.gml old.gml house.citygml 'a name with spaces & more.gml'; do
    expectType "$samples/$file" application/x-citygml+xml
  done
  for file in house.city.json house.cityjson house.json; do expectType "$samples/$file" application/city+json; done
  for file in house.city.jsonl house.jsonl; do expectType "$samples/$file" application/city+json-seq; done
  for file in house.ifc no_ending; do expectType "$samples/$file" application/x-ifc; done
  for file in rooms.indoor.gml rooms.gml; do expectType "$samples/$file" application/x-indoorgml+xml; done
  expectType "$samples/house.svt" application/vnd.svt+zip
  expectType "$samples/house.ifczip" application/x-ifczip
  expectType "$others/plain.gml" application/gml+xml
  expectType "$others/note.xml" application/xml
  expectType "$others/data.json" application/json
  expectType "$others/archive.zip" application/zip
  case $(typeOf "$others/lines.jsonl") in *city*) fail "any JSON lines are CityJSONSeq" ;; esac
  case $(typeOf "$others/part.stp") in *ifc*) fail "any STEP file is IFC" ;; esac
  if has update-desktop-database; then
    update-desktop-database "$XDG_DATA_HOME/applications"
    said=$(gio mime application/x-ifc)
    [[ $said == *svt.desktop* ]] || fail "'Open with' does not offer the viewer: $said"
  fi
fi

# --- the thumbnail service of Xfce and others, which the first call starts
if [ -n "$(compgen -G '/usr/lib/*/tumbler-1/tumblerd' || true)" ] && command -v dbus-run-session >/dev/null && [ -n "${XDG_DATA_HOME:-}" ]; then
  export XDG_CACHE_HOME=$work/cache SVT_SAMPLE=$samples/house.ifc
  mkdir -p "$XDG_DATA_HOME/thumbnailers" "$XDG_CACHE_HOME"
  cp "$thumbnailer" "$XDG_DATA_HOME/thumbnailers"
  # shellcheck disable=SC2016  # the variables are those of the session
  dbus-run-session -- bash -euo pipefail -c '
    gdbus call --session -d org.freedesktop.thumbnails.Thumbnailer1 -o /org/freedesktop/thumbnails/Thumbnailer1 \
      -m org.freedesktop.thumbnails.Thumbnailer1.Queue "[\"file://$SVT_SAMPLE\"]" "[\"application/x-ifc\"]" normal foreground "uint32 0"
    for _ in $(seq 150); do
      [ -z "$(find "$XDG_CACHE_HOME/thumbnails" -name "*.png" -size +1k 2>/dev/null)" ] || exit 0
      sleep 0.2
    done
    exit 1' >"$work/tumbler.log" 2>&1 || fail "tumbler makes no thumbnail: $(cat "$work/tumbler.log")"
  echo "desktop: tumbler makes a thumbnail of an IFC file"
fi
echo "desktop: thumbnails, types and the entry of the menu work"
