#!/bin/sh
# Builds the site from the pages and the headers; a warning is an error. SITE has the Doxyfile and gets pages/ and html/;
# without TOOL the command's own words are left out. Usage: build.sh PYTHON DOXYGEN SOURCE SITE [TOOL]
set -eu
python=$1 doxygen=$2 source=$3 site=$4 tool=${5:-}
rm -rf "$site/pages" "$site/html"
"$python" -B "$source/docs/site/prepare.py" "$source" "$site/pages" "$tool"
"$doxygen" "$site/Doxyfile"
test -s "$site/html/index.html"
