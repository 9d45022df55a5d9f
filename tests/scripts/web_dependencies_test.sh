#!/usr/bin/env bash
# scripts/web_dependencies.sh fetches what is missing, what another release of Debian has and what the system has in another
# version, and nothing else. The package manager is played by functions below: one archive stands for all.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/scripts" "$work/bin" "$work/build/web-sources/archives"
cp "$root/scripts/web_dependencies.sh" "$work/scripts"
cd "$work"
fail() { echo "web_dependencies: $1" >&2; exit 1; }

cat >bin/dpkg-query <<'END'
#!/bin/sh
for package; do :; done
cat "$WORK/installed.$package" 2>/dev/null || echo 1.0-1
END
cat >bin/apt-get <<'END'
#!/bin/sh
for package; do :; done
case "$*" in
  *--print-uris*)
    name=${package%/*}_2.0-1.dsc
    echo "a source" >"$WORK/build/web-sources/archives/$name"
    sum=$(sha256sum "$WORK/build/web-sources/archives/$name" | cut -d ' ' -f 1)
    echo "'http://example.org/$name' $name 9 SHA256:$sum" ;;
esac
END
cat >bin/dpkg-source <<'END'
#!/bin/sh
for folder; do :; done
mkdir "$folder" && touch -d 2000-01-01 "$folder/source.c" && echo "$folder" >>"$WORK/fetched"
END
chmod +x bin/*
fetched() { # names, or nothing
  rm -f fetched
  WORK=$work PATH=$work/bin:$PATH scripts/web_dependencies.sh >said || { cat said >&2; fail "failed"; }
  if [ -f fetched ]; then xargs -n 1 basename <fetched | sort | tr '\n' ' '; fi
}

[ "$(fetched)" = "freetype glu highway libpng pugixml simdjson zlib zstd " ] || fail "not all libraries are fetched"
[ -z "$(fetched)" ] || fail "what is there is fetched again"
[ -z "$(find build/web-sources/zlib -name source.c ! -newermt 2001-01-01)" ] || fail "sources look older than what was built"
echo 1.0-2 >installed.libpng-dev
[ "$(fetched)" = "libpng " ] || fail "another version of a package is not fetched"
sed -i '1s/^[^ ]*/older/' build/web-sources/zstd/.complete
[ "$(fetched)" = "zstd " ] || fail "the sources of another release are kept"
rm build/web-sources/glu/.complete && touch build/web-sources/glu/.complete
[ "$(fetched)" = "glu " ] || fail "a source of unknown version is kept"
grep -q $'^zlib\t2.0-1\tZlib\tpkg:deb/debian/zlib@2.0-1?arch=source$' build/web-sources/components.tsv || fail "versions are not listed"
[ "$(wc -l <build/web-sources/components.tsv)" = 14 ] || fail "components are missing in the list"
echo "web_dependencies: fetches what changed, and nothing else"
