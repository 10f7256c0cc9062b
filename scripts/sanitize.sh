#!/bin/bash
# scripts/sanitize.sh [all]
# Builds the unit tests with clang, once with AddressSanitizer and
# UndefinedBehaviorSanitizer (build_asan/) and those of the contact loops with
# ThreadSanitizer (build_tsan/), runs them, and prints one line for each.
# Without `all` the unit tests of dem only. Debian 12: clang-14,
# libclang-rt-14-dev, libomp-14-dev.
#
# GCC 12 needs more than twenty minutes for one unit of the vectorized loops
# with both sanitizers.
# libgomp is not built for ThreadSanitizer, which would report each of its
# barriers. So the threads are those of clang's library, whose tool Archer
# (libarcher) tells ThreadSanitizer what parallel regions order.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
dem_tests="unit_dem_boundary unit_dem_contact unit_dem_shape unit_dem_engine"
tests=$dem_tests
if [[ ${1:-} == all ]]; then
  tests="$tests unit_dem_io unit_apps unit_apps_report unit_fem unit_coupling"
fi
clang=${CLANG:-clang++-14}
clang_c=${CLANG_C:-clang-14}

configure() # folder, flags
{
  local folder=$1 flags=$2
  mkdir -p "$root/$folder"
  cmake -S "$root" -B "$root/$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$clang" -DCMAKE_C_COMPILER="$clang_c" \
    -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1" \
    > "$root/$folder/configure.log"
}

# Runs the programs of a folder and prints a summary line; logs lie beside them.
run_tests() # folder, name, filter, tests
{
  local folder=$1 name=$2 filter=$3 passed=0 failed=0 findings=0 log
  shift 3
  for test in "$@"; do
    log=$root/$folder/$test.log
    if "$root/$folder/tests/unit/$test" --gtest_filter="$filter" \
      > "$log" 2>&1; then
      passed=$((passed + 1))
    else
      failed=$((failed + 1))
      echo "$name: $test failed, see $log"
    fi
    findings=$((findings + $(grep -cE \
      'runtime error:|ERROR: AddressSanitizer|WARNING: ThreadSanitizer' \
      "$log" || true)))
  done
  echo "$name: $passed programs passed, $failed failed, $findings findings"
  [[ $failed -eq 0 && $findings -eq 0 ]]
}

status=0
configure build_asan "-fsanitize=address,undefined -fno-omit-frame-pointer"
# shellcheck disable=SC2086
cmake --build "$root/build_asan" --target $tests
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
export OMP_NUM_THREADS=1
# shellcheck disable=SC2086
run_tests build_asan "AddressSanitizer, UndefinedBehaviorSanitizer" '*' \
  $tests || status=1

configure build_tsan "-fsanitize=thread"
cmake --build "$root/build_tsan" --target unit_dem_engine
archer=$(find /usr/lib/llvm-*/lib /usr/lib -maxdepth 2 -name 'libarcher.so*' \
  2> /dev/null | head -n 1)
export OMP_NUM_THREADS=2 OMP_TOOL_LIBRARIES=$archer
export TSAN_OPTIONS="ignore_noninstrumented_modules=1"
run_tests build_tsan "ThreadSanitizer, two threads" \
  '*Loops*:EngineCheckpoint*:NearPairs*:PointListRenewal*' unit_dem_engine || status=1
exit $status
