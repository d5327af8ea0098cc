"""Simplifies the shards of a list on a Dask cluster, and merges them. Usage: dask_shards.py LIST OUTDIR SHARDS [SCHEDULER]"""

import functools
import sys

import distributed
import faqem


def run(models, out, shards, index):
    return faqem.batch.run_shard(models, index, shards, out, ratio=0.1)


if __name__ == "__main__":
    models, out, shards = sys.argv[1], sys.argv[2], int(sys.argv[3])
    with distributed.Client(*sys.argv[4:]) as client:
        shard = functools.partial(run, models, out, shards)
        client.gather(client.map(shard, range(shards), pure=False, retries=3))
    print(faqem.batch.merge(out))
