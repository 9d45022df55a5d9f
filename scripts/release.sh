#!/usr/bin/env bash
# Makes the artefacts of a release in build/release-artifacts: Debian packages, npm packages, the Python wheel, the archive of
# the sources, bills of materials, notes and checksums. docs/dev/releasing.md has the steps before and after.
#   scripts/release.sh VERSION            VERSION: that of the tree, such as 0.2.0
#   scripts/release.sh VERSION --tag      also tags the commit, after everything else has succeeded
#   scripts/release.sh VERSION --prepare  only writes the version and the day into the files that state them; commit these
set -euo pipefail
cd "$(dirname "$0")/.."
version=${1:?usage: $0 VERSION [--tag|--prepare]}
mode=${2:-}
fail() { echo "release: $*" >&2; exit 1; }
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "'$version' is not a version; expected three numbers such as 0.2.0"
case $mode in '' | --tag | --prepare) ;; *) fail "unknown option '$mode'; --tag and --prepare are possible" ;; esac

if [ "$mode" = --prepare ]; then
  day=$(date -u +%F)
  python3 scripts/release/version.py --set "$version"
  python3 scripts/release/changelog.py --close "$version" "$day"
  sed -i "s/^date-released: .*/date-released: $day/" CITATION.cff
  sed -i "s/^  \"dateModified\": .*/  \"dateModified\": \"$day\",/" codemeta.json
  python3 scripts/release/badges.py
  echo "release: the files state $version of $day; look at the changes, and commit them"
  exit 0
fi

changed=$(git status --porcelain)
[ -z "$changed" ] || fail "the tree has changes that are not committed: $(head -n 3 <<<"$changed" | tr '\n' ' ')"
python3 scripts/release/version.py --check || fail "the version numbers of the tree disagree"
[ "$(python3 scripts/release/version.py)" = "$version" ] ||
  fail "the tree has version $(python3 scripts/release/version.py); 'scripts/release.sh $version --prepare' changes it"
notes=$(python3 scripts/release/changelog.py --notes "$version") || fail "CHANGELOG.md has no section of $version"
day=$(sed -n 3p <<<"$notes")
grep -qx "date-released: $day" CITATION.cff || fail "CITATION.cff has another day than CHANGELOG.md ($day)"
tag=v$version
if git rev-parse -q --verify "refs/tags/$tag" >/dev/null; then
  [ "$(git rev-parse "$tag^{commit}")" = "$(git rev-parse HEAD)" ] || fail "the tag $tag is on another commit"
fi

# Packages state the time of the commit instead of that of the build.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
artifacts=$PWD/build/release-artifacts
rm -rf "$artifacts"
mkdir -p "$artifacts"
make -s package
make -s npm
cp build/package/*.deb build/wheel/*.whl build/npm/*.tgz "$artifacts"
git archive --format=tar --prefix="svt-$version/" HEAD | gzip -9n >"$artifacts/svt-$version.tar.gz"
python3 scripts/release/sbom.py build/release/bin/svt >"$artifacts/svt-$version.cdx.json"
cp build/release/share/svt/viewer/sbom.cdx.json "$artifacts/svt-viewer-$version.cdx.json"
printf '%s\n' "$notes" >"$artifacts/notes-$version.md"
for kind in 'svt_*.deb' 'libsvt-dev_*.deb' 'python3-svt_*.deb' '*.whl' '*.tgz'; do
  compgen -G "$artifacts/$kind" >/dev/null || fail "no $kind was built"
done
(cd "$artifacts" && sha256sum -- * >../SHA256SUMS && mv ../SHA256SUMS .)
[ -z "$(git status --porcelain)" ] || fail "the build changed files of the tree: $(git status --porcelain | head -n 3)"

(cd "$artifacts" && du -h -- * | sed 's/^/release: /')
message="SVT $version"
if [ "$mode" = --tag ]; then
  git rev-parse -q --verify "refs/tags/$tag" >/dev/null || git tag --annotate "$tag" --message "$message"
  echo "release: the tag is $tag; 'git push origin $tag' publishes it"
else
  echo "release: tag the commit with: git tag --annotate $tag --message '$message' $(git rev-parse --short=12 HEAD)"
fi
