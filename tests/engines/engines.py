"""Runs 24 shards of 300 models on two workers of Ray or Dask, with faults, and compares with a plain `faqem batch`.

One model always crashes; a worker of the engine is killed in the middle of a model, and the process of another model; one
shard runs twice at once. Usage: engines.py ray|dask INJECTOR
"""
import collections
import functools
import json
import os
import pathlib
import signal
import sys
import tempfile
import threading
import time

import faqem
import numpy

SHARDS, MODELS = 24, 300
CRASHES, WORKER_KILLED, PROCESS_KILLED = "m7.ply", "m8.ply", "m9.ply"
OPTIONS = {"ratio": 0.5, "bake": "none", "format": "ply"}


def make_models(folder):
    folder.mkdir()
    for i in range(MODELS):
        name = f"m{i}.ply"
        n = 400 if name in (WORKER_KILLED, PROCESS_KILLED) else 8 + i % 40  # the first take a second
        x, y = numpy.meshgrid(numpy.arange(n + 1.0), numpy.arange(n + 1.0))
        vertices = numpy.stack([x, y, numpy.sin(x / 3) * numpy.cos(y / 5)], -1).reshape(-1, 3)
        a = (numpy.arange(n)[:, None] * (n + 1) + numpy.arange(n)).ravel()
        triangles = numpy.concatenate([numpy.stack([a, a + 1, a + n + 2], -1), numpy.stack([a, a + n + 2, a + n + 1], -1)])
        faqem.save((vertices, triangles), folder / name)


def run(folder, injector, i):
    """A shard, in a worker of the engine."""
    os.environ.update(LD_PRELOAD=injector, FAQEM_FAULT_KIND="segv", FAQEM_FAULT_FILE=CRASHES)
    return faqem.batch.run_shard(f"{folder}/models.jsonl", i, SHARDS, f"{folder}/out", **OPTIONS)


def on_ray(task, shards):
    import ray

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, _temp_dir=tempfile.mkdtemp(prefix="ray"))
    try:
        remote = ray.remote(num_cpus=1, max_retries=3)(task)
        return ray.get([remote.remote(i) for i in shards])
    finally:
        ray.shutdown()


def on_dask(task, shards):
    import dask.distributed

    with dask.distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with dask.distributed.Client(cluster) as client:
            return client.gather([client.submit(task, i, pure=False) for i in shards])


def records(out):
    for file in sorted((out / ".faqem-batch").glob("*/*.jsonl")):
        for line in file.read_text().splitlines(keepends=True):
            if line.endswith("\n"):
                yield file, json.loads(line)


def kill_when_started(out, name, victim):
    """Kills the process that victim() finds from that of the command, whose number is in the name of the record."""
    while True:
        for file, record in records(out):
            if record["event"] == "started" and record["id"] == name:
                os.kill(victim(int(file.name.split("-")[1])), signal.SIGKILL)
                return
        time.sleep(0.01)


def parent_of(process):
    return int(pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


def child_of(process):
    return int(pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()[0])


def contents(folder, end):
    return {file.name.removesuffix(end): file.read_bytes() for file in folder.rglob("*" + end)}


def main():
    engine, injector = {"ray": on_ray, "dask": on_dask}[sys.argv[1]], sys.argv[2]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        out = folder / "out"
        make_models(folder / "in")
        words = [f"--{option}={value}" for option, value in OPTIONS.items()]
        faqem.command("batch", folder / "in", folder / "plain", *words, "--jobs=2", "--threads=1")
        faqem.command("list", folder / "in", "-o", folder / "models.jsonl")
        task = functools.partial(run, name, injector)
        task = (lambda run: lambda i: run(i))(task)  # Ray wants a function
        started = time.monotonic()
        killers = [threading.Thread(target=kill_when_started, args=arguments, daemon=True)
                   for arguments in ((out, WORKER_KILLED, parent_of), (out, PROCESS_KILLED, child_of))]
        for killer in killers:
            killer.start()
        counts = engine(task, [0, *range(SHARDS)])
        seconds = time.monotonic() - started
        assert not any(killer.is_alive() for killer in killers)
        wanted = contents(folder / "plain", ".ply")
        del wanted[CRASHES.removesuffix(".ply")]
        assert contents(out, ".ply.ply") == wanted
        assert sum(shard["models"] for shard in counts[1:]) == MODELS
        assert faqem.batch.merge(out) == {"done": MODELS - 1, "poisoned": 1}
        ids = collections.Counter(json.loads(line)["id"] for line in (out / "batch.jsonl").read_text().splitlines())
        assert len(ids) == MODELS and set(ids.values()) == {1}
        events = collections.Counter((record["event"], record["id"]) for _, record in records(out))
        crashed = {id for event, id in events if event == "crashed"}
        assert crashed == {CRASHES, PROCESS_KILLED}, crashed
        engine(task, range(SHARDS))
        begun = sum(record["event"] == "started" for _, record in records(out))
        assert begun == sum(number for (event, _), number in events.items() if event == "started")
        print(f"{sys.argv[1]}: {MODELS} models, {SHARDS} shards, faults: the bytes of one batch, {seconds:.1f} s")


if __name__ == "__main__":  # Dask imports this file in its workers
    main()
