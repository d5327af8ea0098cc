#!/bin/sh
# The dynamic symbols of the shared libraries are faqem's, and those of its inner namespaces are marked in src/.
# Usage: exports.sh NM SOURCE LIBRARY...
set -eu
nm=$1 source=$2
shift 2
for library in "$@"; do
    names=$("$nm" -D -C --defined-only "$library" | sed -E 's/^[0-9a-f]* . //; s/^(typeinfo|typeinfo name|vtable) for //')
    count=$(printf '%s\n' "$names" | grep -c '^faqem::' || true)
    foreign=$(printf '%s\n' "$names" | grep -v '^faqem::' || true)
    [ -z "$foreign" ] || { echo "$library shows names that are not faqem's:" "$foreign"; exit 1; }
    # An inner name has to stand on a line with the mark.
    for inner in $(printf '%s\n' "$names" | sed -nE 's/^faqem::[a-z_]+::([A-Za-z_]+).*/\1/p' | sort -u); do
        if ! grep -rqE "FAQEM_EXPORT .*\\b$inner\\b" "$source/src" "$source/include/faqem"/*.hpp; then
            echo "$library shows $inner, which is not marked"
            exit 1
        fi
    done
    echo "$library: $count names"
done
"$nm" -D -C --defined-only "$1" | grep -q ' T faqem::simplify(faqem::MeshView const&, faqem::Options const&)$'
