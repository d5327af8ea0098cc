#!/bin/sh
# Checks that the dynamic symbols of a library are exactly the functions that its headers declare.
# Usage: exports.sh NM LIBRARY FOLDER HEADER...
set -eu
nm=$1 library=$2 folder=$3
shift 3
declared=$(cd "$folder" && sed -n 's/^FAQEM_API[^(]*[ *]\(faqem_[a-z_]*\)(.*/\1/p' "$@" | sort)
exported=$("$nm" -D --defined-only "$library" | awk '{print $3}' | sort)
[ -n "$declared" ]
if [ "$declared" != "$exported" ]; then
    echo "declared:" "$declared"
    echo "exported:" "$exported"
    exit 1
fi
