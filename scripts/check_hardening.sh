#!/usr/bin/env bash
# scripts/check_hardening.sh PROGRAM [ROOT]: checks that a linked program or library is hardened as cmake/Hardening.cmake
# says, and that it names no path below ROOT, the checkout that built it (default: this one).
# Exits with 1 and a line for each fault; with 77 where PROGRAM is not built, or readelf or nm of binutils is missing.
set -euo pipefail
program=${1:?usage: check_hardening.sh PROGRAM [ROOT]}
root=${2:-$(cd "$(dirname "$0")/.." && pwd)}
skip() { echo "skipped: $1"; exit 77; }
[ -f "$program" ] || skip "$program is not built"
if ! command -v readelf >/dev/null || ! command -v nm >/dev/null; then skip "readelf or nm is missing (binutils)"; fi

headers=$(readelf -lW "$program")
dynamic=$(readelf -dW "$program")
imports=$(nm -D --undefined-only "$program")
faults=0
# must TEXT PATTERN FAULT: TEXT has a line that matches PATTERN
must() { grep -qE "$2" <<<"$1" || fault "$3"; }
fault() { echo "$program: $1"; faults=1; }

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
if grep -qE 'RPATH|RUNPATH' <<<"$dynamic"; then fault 'searches libraries in folders of the build (RPATH or RUNPATH)'; fi
if grep -qaF "$root/" "$program"; then
  fault "names paths of its build: $(grep -aoE "${root//./\\.}/[A-Za-z0-9_./-]*" "$program" | head -n 3 | tr '\n' ' ')"
fi
exit $faults
