"""Plays services that start a command for each index: with their variables, and their rules for another attempt.

The commands and rules are those of examples/batch.
"""
import concurrent.futures
import fnmatch
import json
import os
import re
import subprocess
import tempfile

import faqem


def for_each(run, indices):
    """Calls run() with each index, two at a time."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(run, indices))


def kubernetes(job):
    """An indexed job: a pod that fails is replaced, unless a rule of podFailurePolicy ends the job."""
    import yaml

    spec = yaml.safe_load((job.examples / "kubernetes.yaml").read_text())["spec"]
    pod = spec["template"]["spec"]
    assert spec["completionMode"] == "Indexed" and spec["completions"] == job.shards and pod["restartPolicy"] == "Never"
    container = pod["containers"][0]
    variables = {variable["name"]: variable["value"] for variable in container["env"]}
    failures = []

    def action(code):
        for rule in spec["podFailurePolicy"]["rules"]:
            wanted = rule.get("onExitCodes")
            if wanted and (code in wanted["values"]) == (wanted["operator"] == "In"):
                return rule["action"]
        return "Count"

    def run(index):
        while code := job.run(container["command"], {**variables, "JOB_COMPLETION_INDEX": str(index)}):
            code = 128 - code if code < 0 else code  # as a container reports a signal
            assert action(code) == "Count", f"the job failed with code {code}"
            failures.append(code)
            assert len(failures) <= spec["backoffLimit"]

    for_each(run, range(job.shards))


def aws(job):
    """An array job of AWS Batch: the first rule of evaluateOnExit that fits decides; a signal is a host that went away."""
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "aws")
        with open(program, "w", opener=lambda path, flags: os.open(path, flags, 0o755)) as file:
            file.write("#!/bin/sh\nprintf '%s\\0' \"$@\"\n")
        words = subprocess.run(["sh", job.examples / "aws_batch.sh", "queue", "definition", str(job.shards)], check=True,
                               env={**os.environ, "PATH": folder + ":" + os.environ["PATH"]}, stdout=subprocess.PIPE)
    service, submit, *words = words.stdout.decode().split("\0")
    assert (service, submit) == ("batch", "submit-job")
    given = dict(zip(words[::2], words[1::2]))
    retry, command = (json.loads(given["--" + name]) for name in ("retry-strategy", "container-overrides"))
    size = re.fullmatch("size=([0-9]+)", given["--array-properties"])[1]

    def run(index):
        variables = {"AWS_BATCH_JOB_ARRAY_INDEX": str(index), "AWS_BATCH_JOB_ARRAY_SIZE": size}
        for _ in range(retry["attempts"]):
            code = job.run(command["command"], variables)
            if code == 0:
                return
            facts = {"onReason": "", "onExitCode": str(code)} if code > 0 else {
                "onReason": "", "onExitCode": "", "onStatusReason": "Host EC2 (instance i-0123) terminated."}
            rule = next(rule for rule in retry["evaluateOnExit"] if all(
                fnmatch.fnmatchcase(facts.get(name, ""), rule[name]) for name in rule if name != "action"))
            assert rule["action"] == "RETRY", f"the job failed with code {code}"
        raise AssertionError("no attempts are left")

    for_each(run, range(int(size)))


def ranks(job):
    """Jobs with RANK and WORLD_SIZE, as of Hugging Face: none is tried again, but what is missing is started once more."""
    command = ["faqem", "batch", "--list", "/data/models.jsonl", "/data/out", "--shard", "auto"]
    left = [*range(job.shards)]
    for _ in range(4):
        for_each(lambda rank: job.run(command, {"RANK": str(rank), "WORLD_SIZE": str(job.shards)}), left)
        missing = faqem.command("batch", "--missing", job.out)
        if not missing:
            return
        ranges = [one.split("-") for one in re.match("--array=([0-9,-]+) ", missing)[1].split(",")]
        left = [rank for ends in ranges for rank in range(int(ends[0]), int(ends[-1]) + 1)]
    raise AssertionError(missing)
