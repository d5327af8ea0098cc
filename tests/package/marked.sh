#!/bin/sh
# Checks that all symbols that one library or program uses from another are marked with FAQEM_EXPORT, because
# shared libraries export only these. This script checks a static build. Symbols of faqem::cli and
# faqem::render are ignored:
# their libraries are always static.
# Usage: marked.sh NM SOURCE FILE... Each FILE is an archive or a comma-separated list of object files.
set -eu
nm=$1 source=$2
shift 2
defined=$(mktemp)
trap 'rm -f "$defined"' EXIT
marked=$(grep -rhE 'FAQEM_(EXPORT|EXCEPTION)' "$source/src" "$source/include/faqem")
for files in "$@"; do
    list=$(echo "$files" | tr ',' ' ')
    "$nm" -C --defined-only $list 2>/dev/null | sed -nE 's/^[0-9a-f]+ [A-Za-z] //p' | sort -u >"$defined"
    needed=$("$nm" -C -u $list 2>/dev/null | sed -nE 's/^ +U //p' | sort -u | comm -23 - "$defined" |
        grep -v '^faqem::\(cli\|render\)::')
    names=$(printf '%s\n' "$needed" | sed -nE 's/^((typeinfo|vtable)( name)? for )?faqem::([a-z_]+::)?([A-Za-z_0-9]+).*/\5/p' |
        sort -u)
    [ -n "$names" ] || { echo "$files: no symbols of other libraries found"; exit 1; }
    for name in $names; do
        if ! printf '%s\n' "$marked" | grep -qE "FAQEM_(EXPORT|EXCEPTION).*\\b$name\\b"; then
            echo "$name is not marked with FAQEM_EXPORT, and is called from another library: $files" | cut -c 1-300
            exit 1
        fi
    done
    echo "$(printf '%s\n' "$names" | wc -l) symbols are marked"
done
