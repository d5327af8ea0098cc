#!/bin/sh
# Simplifies the shards of a list as a Slurm array, and merges them when all have ended. The cluster restarts tasks that end
# with 75 if slurm.conf has RequeueExit=75. Usage: slurm.sh LIST OUTDIR SHARDS [OPTION...]; at most MaxArraySize shards
set -eu
list=$1 out=$2 shards=$3
shift 3
job=$(sbatch --parsable --array="0-$((shards - 1))" --cpus-per-task=1 --requeue --signal=B:TERM@60 \
    --wrap="exec faqem batch --list '$list' '$out' --shard auto --jobs 1 $*")
sbatch --dependency="afterany:$job" --wrap="faqem batch --merge '$out' || faqem batch --missing '$out'"
