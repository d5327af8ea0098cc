#!/bin/sh
# Simplifies the shards of a list with GNU parallel, two at a time, and merges them. Hosts are added with --sshlogin.
# Usage: parallel.sh LIST OUTDIR SHARDS [OPTION...]
set -eu
list=$1 out=$2 shards=$3
shift 3
seq 0 $((shards - 1)) |
    parallel --jobs 2 --retries 3 faqem batch --list "$list" "$out" --shard "{}/$shards" --jobs 1 "$@"
faqem batch --merge "$out"
