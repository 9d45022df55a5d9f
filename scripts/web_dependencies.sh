#!/usr/bin/env bash
# Fetches the sources of the libraries of the WebAssembly module into build/web-sources/<library>: Debian's sources of
# the installed release, since Debian does not compile them for browsers. The system's package source list is not
# changed. Each archive is checked against the SHA-256 of Debian's signed index. Does nothing where all are present and
# neither Debian's release nor the installed version of the package has changed since. What the module holds of others
# stands in build/web-sources/components.tsv: name, version, licence, package URL.
#   scripts/web_dependencies.sh
set -euo pipefail
cd "$(dirname "$0")/.."
sources=$PWD/build/web-sources
# package of the source, its folder, a package made of it that is installed, licence
libraries=(
  "libzstd zstd libzstd-dev BSD-3-Clause"
  "pugixml pugixml libpugixml-dev MIT"
  "simdjson simdjson libsimdjson-dev Apache-2.0"
  "highway highway libhwy-dev Apache-2.0"
  "freetype freetype libfreetype-dev FTL"
  "libglu glu libglu1-mesa-dev SGI-B-2.0"
  "zlib zlib zlib1g-dev Zlib"
  "libpng1.6 libpng libpng-dev libpng-2.0"
)
headers=(fmt nlohmann fast_float CLI)  # Debian's header-only packages, which work for every target
# What is taken as it is installed: source, package, licence. CLI11 is in the command for Node.js alone.
installed=(
  "fmtlib libfmt-dev MIT"
  "nlohmann-json3 nlohmann-json3-dev MIT"
  "fast-float libfast-float-dev Apache-2.0"
  "cli11 libcli11-dev BSD-3-Clause"
  "fonts-dejavu fonts-dejavu-core Bitstream-Vera"
  "emscripten emscripten MIT"
)
# shellcheck source=/dev/null  # of the system
release=$(. /etc/os-release && echo "$VERSION_CODENAME")

version_of() { dpkg-query -W -f='${source:Version}' "$1" 2>/dev/null || echo unknown; }
# What a fetched source is valid for.
key_of() { echo "$release $(version_of "$1")"; }

missing=()
for library in "${libraries[@]}"; do
  read -r _ folder package _ <<<"$library"
  [ "$(head -n 1 "$sources/$folder/.complete" 2>/dev/null)" = "$(key_of "$package")" ] || missing+=("$library")
done
mkdir -p "$sources/include" "$sources/lists/partial" "$sources/archives"
for header in "${headers[@]}"; do ln -sfn "/usr/include/$header" "$sources/include/$header"; done

# The second line of .complete is the version that was fetched, which may be newer than the installed one.
list_components() {
  local source folder package licence version
  for library in "${libraries[@]}"; do
    read -r source folder package licence <<<"$library"
    version=$(sed -n 2p "$sources/$folder/.complete")
    printf '%s\t%s\t%s\tpkg:deb/debian/%s@%s?arch=source\n' "$source" "$version" "$licence" "$source" "${version//+/%2B}"
  done
  for taken in "${installed[@]}"; do
    read -r source package licence <<<"$taken"
    version=$(version_of "$package")
    printf '%s\t%s\t%s\tpkg:deb/debian/%s@%s?arch=source\n' "$source" "$version" "$licence" "$source" "${version//+/%2B}"
  done
}
if [ ${#missing[@]} -eq 0 ]; then
  list_components >"$sources/components.tsv"
  exit 0
fi

echo "web: fetching the sources of ${#missing[@]} libraries"
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

for library in "${missing[@]}"; do
  read -r package name made _ <<<"$library"
  folder=$sources/$name
  rm -rf "$folder"
  if fetch_package "$package" || fetch_package "$package/$release"; then
    (cd "$sources/archives" && dpkg-source --no-check -x "$description" "$folder") >>"$log" 2>&1
    version=${description%.dsc}
  elif [ -n "$original" ]; then
    echo "web: Debian's changes to $package are not to be had; taking it as its authors publish it"
    mkdir -p "$folder"
    tar -xf "$sources/archives/$original" -C "$folder" --strip-components=1
    version=${original%.orig.tar.*}
  else
    cat "$log" >&2
    echo "web: the source of $package cannot be fetched; see above" >&2
    exit 1
  fi
  # Archives bring the times of their authors: what was built of the version before is older than all of it.
  find "$folder" -type f -exec touch {} +
  printf '%s\n%s\n' "$(key_of "$made")" "${version#*_}" >"$folder/.complete"
done
list_components >"$sources/components.tsv"
