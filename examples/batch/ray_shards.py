"""Simplifies the shards of a list on a Ray cluster, and merges them. Usage: ray_shards.py LIST OUTDIR SHARDS"""

import sys

import faqem
import ray

models, out, shards = sys.argv[1], sys.argv[2], int(sys.argv[3])
ray.init()
run_shard = ray.remote(num_cpus=1, max_retries=3, retry_exceptions=[faqem.TryAgainError])(faqem.batch.run_shard)
ray.get([run_shard.remote(*shard, out, ratio=0.1) for shard in faqem.batch.shards(models, shards)])
print(faqem.batch.merge(out))
