#!/bin/sh
# A shared library that uses faqem in header-only mode shows none of faqem's symbols but its exceptions.
# Usage: hidden.sh NM LIBRARY
set -eu
shown=$("$1" -D -C --defined-only "$2" | sed -E 's/^[0-9a-f]+ . //' | grep 'faqem::' |
    grep -vE '^((typeinfo|typeinfo name|vtable) for )?faqem::[A-Za-z]*Error' || true)
[ -z "$shown" ] || { echo "$2 shows:"; echo "$shown" | head; exit 1; }
"$1" -D -C --defined-only "$2" | grep -q simplify_square
