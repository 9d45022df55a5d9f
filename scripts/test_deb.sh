#!/usr/bin/env bash
# Installs the .deb files of build/package on a clean Debian 12, uses them there as a newcomer would, and removes them.
# Needs root, debootstrap and the network; about 600 MB below FOLDER, which is removed at the end.
#   scripts/test_deb.sh [FOLDER]   for the system; a temporary folder
set -euo pipefail
cd "$(dirname "$0")/.."
[ "$(id -u)" -eq 0 ] || { echo "deb: needs root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "deb: debootstrap is missing; apt-get install debootstrap" >&2; exit 1; }
root=${1:-$(mktemp -d)}
mkdir -p "$root"
finish() {
  umount "$root/proc" 2>/dev/null || true
  rm -rf --one-file-system "$root"
}
trap finish EXIT
if command -v lintian >/dev/null; then lintian --fail-on error build/package/*.deb; fi

log=$(mktemp)
quietly() { "$@" >"$log" 2>&1 || { tail -n 40 "$log" >&2; echo "deb: '$*' failed; see above" >&2; exit 1; }; }
echo "deb: a clean Debian 12"
quietly debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian
mount -t proc proc "$root/proc"
cp /etc/resolv.conf "$root/etc/resolv.conf"
# The mirrors, proxies and keys of this machine also hold for the new one.
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
cp build/package/*.deb "$root/tmp"
cp -r examples/cpp "$root/tmp/example"
cp scripts/test_desktop.sh "$root/tmp"
inside() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
quietly inside apt-get update -q
echo "deb: svt is installed"
quietly inside sh -c 'apt-get install -y -q --no-install-recommends /tmp/svt_*.deb'
# shellcheck disable=SC2016  # the variables are those of Perl
inside sh -ec '
  mkdir /tmp/work && cd /tmp/work
  svt --version
  svt sample house -o h.gml
  svt build h.gml -o h.svt
  svt render h.svt -o h.png
  svt view h.svt --no-browser >address 2>log &
  server=$!
  for n in $(seq 300); do [ -s address ] && break; sleep 1; done
  cat address
  perl -MIO::Socket::INET -e '"'"'
    open(my $file, "<", "address"); my ($host, $port) = <$file> =~ m{//([^:]+):(\d+)/};
    my $socket = IO::Socket::INET->new(PeerAddr => $host, PeerPort => $port) or die "no connection";
    print $socket "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    my $reply = join("", <$socket>); $reply =~ /200 OK/ && $reply =~ /<html/i or die "no page: $reply";
  '"'"'
  kill $server'
echo "deb: file managers know the types of models and make thumbnails"
quietly inside sh -c 'apt-get install -y -q --no-install-recommends shared-mime-info desktop-file-utils libglib2.0-bin libxml2-utils zip tumbler dbus'
inside env SVT_STRICT=1 bash /tmp/test_desktop.sh svt /usr/share
cmp <(build/release/bin/svt render "$root/tmp/work/h.svt" -o /dev/stdout) "$root/tmp/work/h.png"
echo "deb: libsvt-dev is installed, and used by another project"
quietly inside sh -c 'apt-get install -y -q --no-install-recommends /tmp/libsvt-dev_*.deb cmake g++ ninja-build'
quietly inside sh -ec 'cmake -S /tmp/example -B /tmp/build -G Ninja -DCMAKE_BUILD_TYPE=Release; cmake --build /tmp/build
  cd /tmp/work; /tmp/build/draw_picture h.svt example.png; test -s example.png'
if [ -n "$(compgen -G 'build/package/python3-svt_*.deb')" ]; then
  echo "deb: python3-svt is installed, and used"
  quietly inside sh -c 'apt-get install -y -q --no-install-recommends /tmp/python3-svt_*.deb'
  inside sh -ec 'cd /tmp/work; python3 - <<"END"
import svt
v = svt.open("h.svt")
assert v.sample(v.labels["Kitchen"].box.mean(axis=0)) >= 0
assert v.dense().shape == v.shape
from importlib.metadata import entry_points
assert [point.value for point in entry_points(group="xarray.backends")] == ["svt.xarray_backend:SvtBackendEntrypoint"]
v.frame().save("python.png")
with v.view() as page:
    print("deb: the page at", page.address)
END
  cmp h.png python.png'
  quietly inside apt-get purge -y -q python3-svt
fi
quietly inside apt-get purge -y -q svt libsvt-dev
left=$(cd "$root" && find usr -path '*/terminfo' -prune -o -name '*svt*' -not -path 'usr/share/doc/*' -print | head)
[ -z "$left" ] || { echo "deb: left behind: $left" >&2; exit 1; }
echo "deb: installs, works and is removed without a trace"
