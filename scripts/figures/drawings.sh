#!/bin/bash
# scripts/figures/drawings.sh
# Draws the pictures of docs/pictures that need no run: sketches of tests,
# mechanics, theory and architecture. svg.py has the lines, arrows and texts.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
for drawing in architecture breakage_event contact_geometries \
               laboratory_tests mechanics theory_cycle_jump theory_facet_depth \
               theory_membrane_contact theory_rolling theory_series; do
  python3 -B "$drawing.py"
done
