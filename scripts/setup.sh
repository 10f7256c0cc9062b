#!/bin/bash
# scripts/setup.sh [TARGET ...]
# Installs the packages of packages.txt that are missing, configures and builds
# Spall, or these targets of it, in build/ (Release). Quick when there is
# nothing to do.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/scripts/install_packages.sh" "$root/scripts/packages.txt"

log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! cmake -S "$root" -B "$root/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  >"$log" 2>&1; then
  cat "$log" >&2
  exit 2
fi
targets=()
[ $# -eq 0 ] || targets=(--target "$@")
cmake --build "$root/build" --parallel "$(nproc)" "${targets[@]}"
