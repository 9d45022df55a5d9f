#!/usr/bin/env bash
# scripts/check_hardening.sh PROGRAM [ROOT]: checks that a linked program or library is hardened as cmake/Hardening.cmake
# says, and that it names no path below ROOT, the checkout that built it (default: this one). Of a WebAssembly module it
# checks the paths only.
# Exits with 1 and a line for each fault; with 77 where PROGRAM is not built, or readelf or nm of binutils is missing.
set -euo pipefail
program=${1:?usage: check_hardening.sh PROGRAM [ROOT]}
root=${2:-$(cd "$(dirname "$0")/.." && pwd)}
skip() { echo "skipped: $1"; exit 77; }
[ -f "$program" ] || skip "$program is not built"
faults=0
fault() { echo "$program: $1"; faults=1; }

if grep -qaF "$root/" "$program"; then
  fault "names paths of its build: $(grep -aoE "${root//./\\.}/[A-Za-z0-9_./-]*" "$program" | head -n 3 | tr '\n' ' ')"
fi
if [ "$(head -c 4 "$program" | tr -d '\0')" = asm ]; then exit $faults; fi

if ! command -v readelf >/dev/null || ! command -v nm >/dev/null; then skip "readelf or nm is missing (binutils)"; fi

headers=$(readelf -lW "$program")
dynamic=$(readelf -dW "$program")
imports=$(nm -D --undefined-only "$program")
machine=$(readelf -hW "$program" | grep Machine)
# must TEXT PATTERN FAULT: TEXT has a line that matches PATTERN
must() { grep -qE "$2" <<<"$1" || fault "$3"; }

# A program has an interpreter and says that it is PIE; a library has neither.
if grep -q 'INTERP' <<<"$headers"; then
  must "$dynamic" 'FLAGS_1.*PIE' 'not position independent (PIE)'
else
  must "$(readelf -hW "$program")" 'Type:.*DYN' 'not position independent'
fi
must "$headers" 'GNU_RELRO' 'relocations stay writable (no RELRO)'
must "$dynamic" 'BIND_NOW|FLAGS.*NOW' 'symbols are bound late, so that RELRO is partial (no -z now)'
must "$headers" 'GNU_STACK.* RW +0x' 'the stack is executable'
must "$imports" '__stack_chk_fail' 'no stack protector'
must "$(grep -v __stack_chk_fail <<<"$imports" || true)" '__[a-z]+_chk' 'no checks of buffer sizes (_FORTIFY_SOURCE)'
must "$imports" '__glibcxx_assert_fail' 'no checks of the standard library (_GLIBCXX_ASSERTIONS)'
if grep -qE 'RPATH|RUNPATH' <<<"$dynamic"; then fault 'searches libraries in folders of the build (RPATH or RUNPATH)'; fi
# A frame of several pages is taken page by page, and each page is touched: "sub $0x1000,%rsp" before "orq $0,(%rsp)" of GCC
# or "movq $0,(%rsp)" of clang.
probe='\x48\x81\xec\x00\x10\x00\x00(\x48\x83\x0c\x24\x00|\x48\xc7\x04\x24\x00\x00\x00\x00)'
if grep -q 'X86-64' <<<"$machine"; then
  LC_ALL=C grep -qaP "$probe" "$program" || fault 'large frames skip pages of the stack (no -fstack-clash-protection)'
fi
exit $faults
