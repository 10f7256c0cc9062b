#!/bin/bash
# scripts/run.sh [CASE.prm] [options of spall run]
# Sets up, runs the case (the quick dynamic triaxial test if none is given),
# writes its report, prints where it is and the numbers that matter.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/scripts/setup.sh" spall

case_file=$root/data/cases/dynamic_triaxial_quick.prm
if [ $# -gt 0 ] && [[ $1 != --* ]]; then
  case_file=$1
  shift
fi
name=$(basename "$case_file")
folder=$root/runs/${name%.*}
options=("$@")
for ((k = 0; k < ${#options[@]}; ++k)); do
  if [ "${options[k]}" = --out ] && [ $((k + 1)) -lt ${#options[@]} ]; then
    folder=${options[k + 1]}
    unset 'options[k]' 'options[k+1]'
    break
  fi
done
mkdir -p "$root/runs"

"$root/build/apps/spall" run "$case_file" --out "$folder" "${options[@]}"
"$root/build/apps/spall" report "$folder"
python3 - "$folder" <<'PYTHON'
import json, pathlib, sys
folder = pathlib.Path(sys.argv[1]).resolve()
summary = json.loads((folder / "summary.json").read_text())
for name, key, text in (
        ("permanent axial strain", "permanent_axial_strain_1", "{:.4%}"),
        ("settlement", "settlement_m", "{:.4g} m"),
        ("density", "density_kg_per_m3", "{:.1f} kg/m^3"),
        ("settlement of the plate", "plate_settlement_m", "{:.4g} m"),
        ("settlement of the ground", "subgrade_settlement_m", "{:.4g} m"),
        ("force at the first event", "first_event_force_N", "{:.4g} N"),
        ("largest force", "peak_force_N", "{:.4g} N"),
        ("abrasion LAA", "laa_percent", "{:.5f} %"),
        ("change of coordination number", "coordination_change_1",
         "{:+.4f}")):
    if key in summary:
        print(f"{name:30}", text.format(summary[key]))
print("report:", folder / "report.html")
PYTHON
