"""Runs 24 shards of 300 models on two workers of an engine, with faults, and compares with a plain `faqem batch`.

One model crashes, always; one hangs, and its shard is begun once more meanwhile. In the middle of others the worker of the
engine is killed, the process of the model, or its shard gets SIGTERM. Usage: engines.py ENGINE INJECTOR EXAMPLES
"""
import collections
import functools
import hashlib
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time

import faqem
import services
import slurm
from test_compatible import bumpy_grid

SHARDS, MODELS = 24, 300
HANGS, CRASHES, WORKER_KILLED, PROCESS_KILLED, TERMINATED = "m6.ply", "m7.ply", "m8.ply", "m9.ply", "m22.ply"
OPTIONS = {"ratio": 0.5, "bake": "none", "format": "ply", "end_after": 8}


def make_models(folder):
    folder.mkdir()
    for i in range(MODELS):
        name = f"m{i}.ply"
        n = 400 if name in (WORKER_KILLED, PROCESS_KILLED, TERMINATED) else 8 + i % 40  # the first take a second
        faqem.save(bumpy_grid(n), folder / name)


class Job:
    """What an engine runs."""

    def __init__(self, folder, injector, examples):
        self.folder, self.out, self.list = folder, folder / "out", folder / "models.jsonl"
        self.examples, self.shards = pathlib.Path(examples), SHARDS
        self.words = [f"--{name.replace('_', '-')}={value}" for name, value in OPTIONS.items()]
        self.faults = {"LD_PRELOAD": injector, "FAQEM_FAULT_KIND": "segv", "FAQEM_FAULT_FILE": CRASHES,
                       "FAQEM_FAULT_HANG": HANGS}

    def run(self, command, variables):
        """Runs a command whose files are in /data, as those of the examples. Returns its code, or less than 0 for a signal."""
        program, *words = [word.replace("/data", str(self.folder)) for word in (*command, *self.words)]
        assert program == "faqem"
        return subprocess.run([faqem._command.program(), *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              env={**os.environ, **self.faults, **variables}).returncode


def run_shard(folder, faults, index):
    """A shard, in a worker of the engine."""
    os.environ.update(faults)
    return faqem.batch.run_shard(f"{folder}/models.jsonl", index, SHARDS, f"{folder}/out", **OPTIONS)


def on_ray(job):
    import ray

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, _temp_dir=tempfile.mkdtemp(prefix="ray"))
    try:
        run = ray.remote(num_cpus=1, max_retries=3, retry_exceptions=[faqem.TryAgainError])(run_shard)
        ray.get([run.remote(job.folder, job.faults, index) for index in range(SHARDS)])
    finally:
        ray.shutdown()


def on_dask(job):
    import dask.distributed

    task = functools.partial(run_shard, job.folder, job.faults)
    with dask.distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with dask.distributed.Client(cluster) as client:
            client.gather(client.map(task, range(SHARDS), pure=False, retries=3))


def records(out):
    for file in sorted((out / ".faqem-batch").glob("*/*.jsonl")):
        for line in file.read_text().splitlines(keepends=True):
            if line.endswith("\n"):
                yield file, json.loads(line)


def when_started(out, name, act):
    """Calls act() with the process of the command that has begun a model: its number is in the name of the record."""
    while True:
        for file, record in records(out):
            if record["event"] == "started" and record["id"] == name:
                return act(int(file.name.split("-")[1]))
        time.sleep(0.01)


def child_of(process):
    return int(pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()[0])


def kill(process):
    os.kill(process, signal.SIGKILL)


def kill_parent(command):
    kill(slurm.parent_of(command))


# What runs a job on two workers, and what ends the worker of a command.
ENGINES = {
    "ray": (on_ray, kill_parent),
    "dask": (on_dask, kill_parent),
    "slurm": (slurm.run, slurm.lose_node),
    "kubernetes": (services.kubernetes, kill),
    "aws": (services.aws, kill),
    "ranks": (services.ranks, kill),
}


def begin_faults(job, lose_worker):
    """Returns a function that tells which faults have not happened yet."""
    index = int.from_bytes(hashlib.sha256(HANGS.encode()).digest()[:8], "big") % SHARDS
    again = ["faqem", "batch", "--list", "/data/models.jsonl", "/data/out", "--shard", f"{index}/{SHARDS}"]
    faults = {
        WORKER_KILLED: lose_worker,
        PROCESS_KILLED: lambda command: kill(child_of(command)),
        TERMINATED: lambda command: os.kill(command, signal.SIGTERM),
        HANGS: lambda command: job.run(again, {}),
    }
    threads = {name: threading.Thread(target=when_started, args=(job.out, name, act), daemon=True)
               for name, act in faults.items()}
    for thread in threads.values():
        thread.start()
    return lambda: [name for name, thread in threads.items() if thread.is_alive()]


def contents(folder, end):
    return {file.name.removesuffix(end): file.read_bytes() for file in folder.rglob("*" + end)}


def check_pasted_lines(job):
    """The lines of docs/scale.md for Ray, of which one worker is killed."""
    lines = re.search("```python\n(import faqem, ray\n.*?)```", (job.examples / "../../docs/scale.md").read_text(), re.DOTALL)[1]
    job.out.rename(job.folder / "with faults")
    killer = threading.Thread(target=when_started, args=(job.out, WORKER_KILLED, kill_parent), daemon=True)
    killer.start()
    printed = subprocess.run([sys.executable, "-c", lines], check=True, cwd=job.folder, stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL, text=True).stdout
    assert not killer.is_alive() and printed.endswith(f"{{'done': {MODELS}}}\n"), printed  # after what Ray prints
    events = collections.Counter((record["event"], record["id"]) for _, record in records(job.out))
    assert events["started", WORKER_KILLED] == 2 and all(event != "crashed" for event, _ in events)


def main(engine, injector, examples):
    run, lose_worker = ENGINES[engine]
    with tempfile.TemporaryDirectory() as name:
        job = Job(pathlib.Path(name), injector, examples)
        make_models(job.folder / "in")
        faqem.command("batch", job.folder / "in", job.folder / "plain", *job.words, "--jobs=2", "--threads=1")
        faqem.command("list", job.folder / "in", "-o", job.list)
        started = time.monotonic()
        missing_faults = begin_faults(job, lose_worker)
        run(job)
        seconds = time.monotonic() - started
        while missing_faults():  # the second attempt at a shard may end later
            assert time.monotonic() - started < seconds + 60, missing_faults()
            time.sleep(0.1)
        wanted = contents(job.folder / "plain", ".ply")
        for planted in (CRASHES, HANGS):
            del wanted[planted.removesuffix(".ply")]
        assert contents(job.out, ".ply.ply") == wanted
        assert faqem.batch.merge(job.out) == {"done": MODELS - 2, "poisoned": 2}
        ids = collections.Counter(json.loads(line)["id"] for line in (job.out / "batch.jsonl").read_text().splitlines())
        assert len(ids) == MODELS and set(ids.values()) == {1}
        events = collections.Counter((record["event"], record["id"]) for _, record in records(job.out))
        crashed = {id for event, id in events if event == "crashed"}
        assert crashed == {CRASHES, HANGS, PROCESS_KILLED}, crashed
        assert ("interrupted", TERMINATED) in events
        # Two attempts of each of two runs at once, each of which gives the model up.
        assert events["started", HANGS] == 4 and events["poisoned", HANGS] == 2, events["started", HANGS]
        assert all(events["started", id] >= 2 for id in (WORKER_KILLED, PROCESS_KILLED, TERMINATED))
        run(job)
        begun = sum(record["event"] == "started" for _, record in records(job.out))
        assert begun == sum(number for (event, _), number in events.items() if event == "started")
        if engine == "ray":
            check_pasted_lines(job)
        print(f"{engine}: {MODELS} models, {SHARDS} shards, faults: the bytes of one batch, {seconds:.1f} s")


if __name__ == "__main__":  # Dask imports this file in its workers
    main(*sys.argv[1:])
