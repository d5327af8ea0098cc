#!/bin/sh
# A shared library that uses faqem in header-only mode exports none of faqem's symbols except its exceptions.
# Instantiations of the standard library's templates with faqem's types stay visible; their names contain the inline
# namespace of the mode, so that they do not clash either. Usage: hidden.sh NM LIBRARY
set -eu
names=$("$1" -D --defined-only "$2" | sed -E 's/^[0-9a-f]+ . //')
shown=$(printf '%s\n' "$names" | grep -E '^_Z(T[VIST]|GV|Z)?(NK?)?5faqem' | grep -vE '5faqem[0-9]+[A-Za-z]*Error' || true)
[ -z "$shown" ] || { echo "$2 exports:"; printf '%s\n' "$shown" | head; exit 1; }
printf '%s\n' "$names" | grep -q simplify_square
