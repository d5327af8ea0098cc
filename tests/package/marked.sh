#!/bin/sh
# What one library or program takes from another is marked for it: a shared build shows nothing else. Here that is
# seen without one.
# The tool's own texts are a library of its own, which is never shared.
# Usage: marked.sh NM SOURCE FILE..., an archive or objects with commas between them each
set -eu
nm=$1 source=$2
shift 2
defined=$(mktemp)
trap 'rm -f "$defined"' EXIT
marked=$(grep -rhE 'FAQEM_EXPORT' "$source/src" "$source/include/faqem")
for files in "$@"; do
    list=$(echo "$files" | tr ',' ' ')
    "$nm" -C --defined-only $list 2>/dev/null | sed -nE 's/^[0-9a-f]+ [A-Za-z] //p' | sort -u >"$defined"
    needed=$("$nm" -C -u $list 2>/dev/null | sed -nE 's/^ +U //p' | sort -u | comm -23 - "$defined" |
        grep -v '^faqem::\(cli\|render\)::')
    names=$(printf '%s\n' "$needed" | sed -nE 's/^((typeinfo|vtable)( name)? for )?faqem::([a-z_]+::)?([A-Za-z_0-9]+).*/\5/p' |
        sort -u)
    [ -n "$names" ] || { echo "$files: takes nothing from the others?"; exit 1; }
    for name in $names; do
        if ! printf '%s\n' "$marked" | grep -qE "FAQEM_EXPORT.*\\b$name\\b"; then
            echo "$name is not marked with FAQEM_EXPORT, and is called from another library: $files" | cut -c 1-300
            exit 1
        fi
    done
    echo "$(printf '%s\n' "$names" | wc -l) names are marked"
done
