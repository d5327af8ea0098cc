#!/bin/sh
# Checks that shared libraries export only symbols of faqem, and that exported symbols of its nested
# namespaces are marked with FAQEM_EXPORT.
# Usage: exports.sh NM SOURCE LIBRARY...
set -eu
nm=$1 source=$2
shift 2
for library in "$@"; do
    names=$("$nm" -D -C --defined-only "$library" | sed -E 's/^[0-9a-f]* . //; s/^(typeinfo|typeinfo name|vtable) for //')
    count=$(printf '%s\n' "$names" | grep -c '^faqem::' || true)
    foreign=$(printf '%s\n' "$names" | grep -v '^faqem::' || true)
    [ -z "$foreign" ] || { echo "$library exports symbols outside namespace faqem:" "$foreign"; exit 1; }
    # A symbol of a nested namespace must be declared on a line with FAQEM_EXPORT.
    for inner in $(printf '%s\n' "$names" | sed -nE 's/^faqem::[a-z_]+::([A-Za-z_]+).*/\1/p' | sort -u); do
        if ! grep -rqE "FAQEM_EXPORT .*\\b$inner\\b" "$source/src" "$source/include/faqem"; then
            echo "$library shows $inner, which is not marked"
            exit 1
        fi
    done
    echo "$library: $count exported symbols"
done
"$nm" -D -C --defined-only "$1" | grep -q ' T faqem::simplify(faqem::MeshView const&, faqem::Options const&)$'
