#!/bin/bash
# scripts/fuzz.sh build           builds the fuzz targets with clang
# scripts/fuzz.sh SECONDS [NAME ...]
#   runs the targets (all without a name) so long each on inputs from
#   tests/fuzz/corpus and changes of them. New inputs are kept in
#   build_fuzz/found/NAME, one that breaks a reader as build_fuzz/NAME-*.
# SPALL_BUILD and SPALL_FUZZ name other folders than build and build_fuzz.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${SPALL_BUILD:-$root/build}
fuzz=${SPALL_FUZZ:-$root/build_fuzz}
usage() { sed -n '2,7s/^# \?//p' "${BASH_SOURCE[0]}" >&2; exit 1; }
[ $# -gt 0 ] || usage

build_targets() {
  clang=$(command -v clang++-14 || command -v clang++) || {
    echo "fuzz: no clang++, install clang-14 and libclang-rt-14-dev" >&2
    exit 1
  }
  mkdir -p "$fuzz"
  cmake -S "$root/tests/fuzz/targets" -B "$fuzz" -G Ninja \
    -DCMAKE_CXX_COMPILER="$clang" -DCMAKE_C_COMPILER="${clang/++/}" \
    -DCMAKE_BUILD_TYPE=None -DSPALL_BUILD="$build" >"$fuzz/configure.log" 2>&1 || {
    cat "$fuzz/configure.log" >&2
    exit 2
  }
  cmake --build "$fuzz" --parallel "$(nproc)"
}

if [ "$1" = build ]; then
  build_targets
  exit
fi
[[ "$1" =~ ^[0-9]+$ ]] || usage
seconds=$1
shift
[ -n "${FUZZ_BUILT:-}" ] || build_targets >/dev/null
[ $# -gt 0 ] || set -- $(cd "$root/tests/fuzz/corpus" && ls)
failed=()
# Of libraries that are not ours, neither leaks nor the memory they ask for.
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=0 OMP_NUM_THREADS=1
for name in "$@"; do
  mkdir -p "$fuzz/found/$name"
  echo "fuzz: $name, $seconds s"
  "$fuzz/fuzz_$name" -max_total_time="$seconds" -timeout=25 -max_len=4096 \
    -rss_limit_mb=3000 -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="$fuzz/$name-" "$fuzz/found/$name" \
    "$root/tests/fuzz/corpus/$name" || failed+=("$name")
done
[ ${#failed[@]} -eq 0 ] || { echo "fuzz: faults in ${failed[*]}" >&2; exit 1; }
