#!/bin/sh
# Simplifies the shards of a list as an array job of AWS Batch: a job that ends with 75, or whose host went away, is tried
# again. Usage: aws_batch.sh QUEUE DEFINITION SHARDS; 2 to 10,000 shards; the definition has faqem and the volume /data
set -eu
retry='{"attempts": 10, "evaluateOnExit": [{"onExitCode": "75", "action": "RETRY"},
    {"onStatusReason": "Host EC2*", "action": "RETRY"}, {"onReason": "*", "action": "EXIT"}]}'
command='{"command": ["faqem", "batch", "--list", "/data/models.jsonl", "/data/out", "--shard", "auto", "--jobs", "1"]}'
aws batch submit-job --job-name faqem-shards --job-queue "$1" --job-definition "$2" \
    --array-properties "size=$3" --retry-strategy "$retry" --container-overrides "$command"
