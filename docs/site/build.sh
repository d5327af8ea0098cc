#!/bin/sh
# Builds the documentation site from the pages and the headers. A warning of Doxygen is an error. SITE
# contains the Doxyfile and receives pages/ and html/. Without TOOL the page with the help texts of the
# command is omitted. Usage: build.sh PYTHON DOXYGEN SOURCE SITE [TOOL]
set -eu
python=$1 doxygen=$2 source=$3 site=$4 tool=${5:-}
rm -rf "$site/pages" "$site/html"
"$python" -B "$source/docs/site/prepare.py" "$source" "$site/pages" "$tool"
"$doxygen" "$site/Doxyfile"
test -s "$site/html/index.html"
