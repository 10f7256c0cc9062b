#!/bin/bash
# scripts/docs.sh [options of sphinx-build]
# Builds the manual as a static site in build/docs: installs the packages of
# packages_docs.txt that are missing, reads the public headers with Doxygen and
# the pages of docs with Sphinx. A warning of Sphinx is an error.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/scripts/install_packages.sh" "$root/scripts/packages_docs.txt"

api="$root/build/docs_api"
mkdir -p "$api"
for library in dem fem coupling; do
  LIBRARY=$library INCLUDE="$root/$library/include" API=$api \
    doxygen "$root/docs/developer/api/Doxyfile"
done
# Breathe would declare the namespace once for each header, and show what is
# private.
perl -0pi -e 's#<innernamespace [^\n]*\n##g;
  s#<sectiondef kind="private-.*?</sectiondef>##gs' "$api"/*/*.xml

# Not another Python than that of Debian, which has the packages. -E: headers
# and pages outside docs may have changed.
/usr/bin/python3 -m sphinx -b html -E -W --keep-going -q -j "$(nproc)" \
  -d "$root/build/docs_cache" "$@" "$root/docs" "$root/build/docs"
echo "file://$root/build/docs/index.html"
