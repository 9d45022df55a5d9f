#!/usr/bin/env bash
# Fetches the sources of the libraries of the WebAssembly module into build/web-sources/<library>: Debian's sources of
# the installed release, since Debian does not compile them for browsers. The system's package source list is not
# changed. Each archive is checked against the SHA-256 of Debian's signed index. Does nothing if all are present.
#   scripts/web_dependencies.sh
set -euo pipefail
cd "$(dirname "$0")/.."
sources=$PWD/build/web-sources
# package=folder of its sources
packages=(libzstd=zstd pugixml=pugixml simdjson=simdjson highway=highway freetype=freetype libglu=glu zlib=zlib libpng1.6=libpng)
headers=(fmt nlohmann fast_float CLI)  # Debian's header-only packages, which work for every target

missing=()
for pair in "${packages[@]}"; do [ -e "$sources/${pair#*=}/.complete" ] || missing+=("$pair"); done
mkdir -p "$sources/include" "$sources/lists/partial" "$sources/archives"
for header in "${headers[@]}"; do ln -sfn "/usr/include/$header" "$sources/include/$header"; done
[ ${#missing[@]} -eq 0 ] && exit 0

echo "web: fetching the sources of ${#missing[@]} libraries"
# shellcheck source=/dev/null  # of the system
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
key=/usr/share/keyrings/debian-archive-keyring.gpg
cat >"$sources/debian.list" <<LIST
deb-src [signed-by=$key] http://deb.debian.org/debian $release main
deb-src [signed-by=$key] http://deb.debian.org/debian $release-updates main
deb-src [signed-by=$key] http://deb.debian.org/debian-security $release-security main
LIST
apt=(-q -o "Dir::Etc::SourceList=$sources/debian.list" -o Dir::Etc::SourceParts=/dev/null
     -o "Dir::State::Lists=$sources/lists" -o "Dir::Cache=$sources" -o APT::Sandbox::User=root)
log=$sources/fetch.log
apt-get "${apt[@]}" update >"$log" 2>&1 || { cat "$log" >&2; echo "web: no package index; see above" >&2; exit 1; }

# Fetches one archive, unless it is present with the right checksum.
fetch() { # uri, name, "SHA256:..."
  (cd "$sources/archives" && echo "${3#SHA256:}  $2" | sha256sum --check --status 2>/dev/null) && return 0
  /usr/lib/apt/apt-helper "${apt[@]}" download-file "$1" "$sources/archives/$2" "$3" >>"$log" 2>&1
}

# Fetches all archives of a package: upstream source and Debian's changes. Sets description and original; fails if one
# is missing, as mirrors may drop old ones.
fetch_package() { # package, with /release where only that will do
  description='' original=''
  local uri name hash isWhole=yes
  while read -r uri name _ hash; do
    case $name in *.asc) continue ;; esac
    if ! fetch "${uri//\'/}" "$name" "$hash"; then isWhole=no; continue; fi
    case $name in
      *.dsc) description=$name ;;
      *.orig-*) ;;
      *.orig.tar.*) original=$name ;;
    esac
  done < <(apt-get "${apt[@]}" --print-uris -qq source --only-source "$1" 2>>"$log")
  [ $isWhole = yes ]
}

for pair in "${missing[@]}"; do
  package=${pair%%=*} folder=$sources/${pair#*=}
  rm -rf "$folder"
  if fetch_package "$package" || fetch_package "$package/$release"; then
    (cd "$sources/archives" && dpkg-source --no-check -x "$description" "$folder") >>"$log" 2>&1
  elif [ -n "$original" ]; then
    echo "web: Debian's changes to $package are not to be had; taking it as its authors publish it"
    mkdir -p "$folder"
    tar -xf "$sources/archives/$original" -C "$folder" --strip-components=1
  else
    cat "$log" >&2
    echo "web: the source of $package cannot be fetched; see above" >&2
    exit 1
  fi
  touch "$folder/.complete"
done
