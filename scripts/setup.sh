#!/bin/bash
# scripts/setup.sh [TARGET ...]
# Installs the packages of packages.txt that are missing, configures and builds
# Spall, or these targets of it, in build/ (Release). Quick when there is
# nothing to do.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "setup: run as root or install sudo, needed for: $*" >&2
    return 1
  fi
}

missing=()
while read -r package; do
  [ -n "$package" ] || continue
  state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done <"$root/scripts/packages.txt"
if [ ${#missing[@]} -gt 0 ]; then
  echo "setup: installing ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

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
