#!/bin/sh
# Fits data/shapes/limestone and limestone_blocky anew from the meshes in the shared folder.
# Usage: scripts/fit_shapes.sh [SPALL] [SHARED], default build/apps/spall
# and ../shared. See data/README.md for the origin of the meshes.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
spall=${1:-$root/build/apps/spall}
meshes=${2:-$root/../shared}/shapes/nist_vcctl_sh/mesh5120

[ -x "$spall" ] || { echo "$spall: no such program, build it first" >&2; exit 1; }
[ -d "$meshes" ] || { echo "$meshes: no such folder" >&2; exit 1; }

for mesh in "$meshes"/MA111-7-*.stl; do
  particle=$(basename "$mesh" | sed 's/_n[0-9]*_5120\.stl$//')
  case $particle in
  *-00104 | *-00132) out=$root/data/shapes/limestone_blocky ;; # sphericity > 0.85
  *) out=$root/data/shapes/limestone ;;
  esac
  mkdir -p "$out"
  degree=$(basename "$mesh" | sed 's/.*_n\([0-9]*\)_5120\.stl$/\1/')
  # the points of these meshes lie on the source's series, the facets inside
  "$spall" shape fit "$mesh" --order 20 --unit mm --from vertices --out "$out/$particle.json" \
    --source "NIST VCCTL (github jwbullard/VCCTL, a173d91, aggregate/MA111-7-coarse), limestone particle $particle, X-ray CT; series of degree $degree as a mesh of 5120 triangles, fitted to its points by Spall" \
    --licence "MIT, see data/shapes/LICENSE-nist" |
    awk -v name="$particle" '
      /^series/ { is_series = 1 }
      is_series && $1 == "volume" { printf "%s %s m^3\n", name, $2 }'
done
