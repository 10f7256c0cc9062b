#!/bin/bash
# scripts/test.sh [options of ctest]
# Sets up and runs every test but those with the label long.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/scripts/setup.sh"
exec ctest --test-dir "$root/build" --label-exclude long \
  --output-on-failure --parallel "$(nproc)" "$@"
