"""Batches over the shards of a list, as functions for Ray, Dask and whatever else calls a function on many machines.

docs/scale.md describes lists, shards and records.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import os
import pathlib
import posixpath
import subprocess
import tempfile
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from ._command import command, program, raise_unless_ok
from .errors import InputError, OptionError, UnsupportedError

_records = ".faqem-batch"
_group = 32  # models by URL that are on the disk at a time


def shards(list: str | os.PathLike[str], n: int) -> list[tuple[str, int, int]]:
    """Returns the first three arguments of run_shard() for each of the n shards of a list. They can be pickled."""
    if not n >= 1:
        raise OptionError(f"n: {n!r} is not 1 or more")
    return [(os.fspath(list), i, n) for i in range(n)]


def run_shard(
    list: str | os.PathLike[str], i: int, n: int, out: str | os.PathLike[str], *, jobs: int = 1, threads: int = 1, **options: Any
) -> dict[str, Any]:
    """Simplifies shard i of n of a list that `faqem list` has written, as `faqem batch --list` does.

    list, out  files of this machine, or URLs if fsspec is installed: then models are files without others beside them
    jobs       processes
    threads    of each process
    options    of the command, with _ for -: ratio=0.1, format="glb", strict=True

    What is done already is skipped, by any machine. The command ends with this process, however that ends. May be called in
    any thread. Returns the number of `models` of the shard and how many are `done`, `refused` and `poisoned`. Raises the
    exception that belongs to the exit code of the command: TryAgainError if the shard is not complete, because of a signal
    or of a file that could not be written.
    """
    words = [*_words({"shard": f"{i}/{n}", "jobs": jobs, "threads": threads, **options})]
    if "://" in os.fspath(list) or "://" in os.fspath(out):
        return _Remote(os.fspath(list), i, n, os.fspath(out)).run(words)
    _run(["--list", os.fspath(list), os.fspath(out), *words])
    return _counts(pathlib.Path(out) / _records / f"{i}-of-{n}")


def merge(out: str | os.PathLike[str]) -> dict[str, int]:
    """Writes what has become of each model to batch.jsonl and batch.html in `out`, as `faqem batch --merge` does.

    Returns the number of models by their end. Raises Error if a shard is not complete or two models have one output.
    """
    if "://" not in os.fspath(out):
        lines = command("batch", "--merge", out).splitlines()
        return {end: int(count) for end, count in (line.split(": ") for line in lines)}
    target, root = _file_system(os.fspath(out))
    with tempfile.TemporaryDirectory() as folder:
        for path in target.find(posixpath.join(root, _records)):
            local = pathlib.Path(folder, *pathlib.PurePosixPath(path).parts[-(2 if path.endswith("/run.json") else 3):])
            local.parent.mkdir(parents=True, exist_ok=True)
            target.get_file(path, str(local))
        try:
            return merge(folder)
        finally:
            for file in pathlib.Path(folder).glob("batch.*"):
                target.put_file(str(file), posixpath.join(root, file.name))


def _words(options: dict[str, Any]) -> Iterator[str]:
    for name, value in options.items():
        if value is not None and value is not False:
            yield "--" + name.replace("_", "-") + ("" if value is True else f"={value}")


def _run(words: Iterable[str], take: Callable[[bytes], object] | None = None) -> None:
    """Runs `faqem batch`, which ends when this process does. `take` receives the lines of its output."""
    # The file, and not a pipe, so that a long output of errors does not stop the command.
    with tempfile.TemporaryFile() as said, subprocess.Popen(
        [program(), "batch", *words, "--until-eof"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE if take else subprocess.DEVNULL, stderr=said,
    ) as process:
        for line in process.stdout or ():
            if take:
                take(line)
        code = process.wait()
        said.seek(max(said.tell() - 4000, 0))
        raise_unless_ok(code, said.read().decode(errors="replace"))


def _counts(records: pathlib.Path) -> dict[str, Any]:
    found = json.loads((records / "complete.json").read_text())
    return {"shard": records.name, **{name: found[name] for name in ("models", "done", "refused", "poisoned")}}


def _file_system(url: str) -> tuple[Any, str]:
    try:
        import fsspec
    except ImportError:
        raise OptionError(f"{url}: URLs need the package fsspec") from None
    found: tuple[Any, str] = fsspec.core.url_to_fs(url)
    return found


class _Remote:
    """A shard whose files have URLs. Records and, for a group of models at a time, models are copied to this machine."""

    def __init__(self, list: str, i: int, n: int, out: str) -> None:
        self.list, self.list_folder = list, posixpath.dirname(list)
        self.target, self.root = _file_system(out)
        self.name = f"{i}-of-{n}"
        self.models: dict[str, dict[str, Any]] = {}
        source, path = _file_system(list)
        digest = hashlib.sha256()
        with source.open(path, "rb") as file:
            for number, line in enumerate(file, 1):
                digest.update(line)
                try:
                    model = json.loads(line)
                    key = hashlib.sha256(model["id"].encode()).digest()[:8]
                    model["input"]
                except (ValueError, KeyError, TypeError, AttributeError) as error:
                    raise InputError(f"{list}: line {number}: {error!r}") from error
                if int.from_bytes(key, "big") % n == i:
                    self.add_model(model)
        self.hash = digest.hexdigest()

    def add_model(self, model: dict[str, Any]) -> None:
        for path in (model["input"], model.get("output", "")):
            if path.lower().endswith((".gltf", ".obj")):
                raise UnsupportedError(f"{self.list}: {model['id']}: {path} has other files beside it")
        if "://" not in model["input"]:
            model["input"] = posixpath.join(self.list_folder, model["input"])
        if self.models.setdefault(model["id"], model) is not model:
            raise InputError(f"{self.list}: {model['id']}: two models have this id")

    def run(self, words: list[str]) -> dict[str, Any]:
        if {"--format=gltf", "--format=obj"}.intersection(words):
            raise UnsupportedError("by URL, results have a format of one file")
        self.replaces = "--new-run" in words
        words = [word for word in words if word != "--new-run"]
        with tempfile.TemporaryDirectory() as folder:
            self.scratch = pathlib.Path(folder)
            self.records = self.scratch / "out" / _records / self.name
            self.fetch_records()
            for ids in self.groups(words):
                self.run_group(ids, words)
            self.run_command(self.models, [word for word in words if word != "--force"])
            self.upload_records()
            self.upload_identity(self.records / "complete.json", replaces=True)
            return _counts(self.records)

    def remote(self, path: pathlib.Path) -> str:
        """The place of a file below scratch/out."""
        return posixpath.join(self.root, path.relative_to(self.scratch / "out").as_posix())

    def fetch_records(self) -> None:
        """Fetches the records, and puts empty files of the right size in the place of the results, which stay there."""
        self.records.mkdir(parents=True)
        for path in self.target.glob(posixpath.join(self.root, _records, self.name, "*.jsonl")):
            self.target.get_file(path, str(self.records / posixpath.basename(path)))
        self.known = {*self.records.iterdir()}
        for record in self.done(self.known):
            result = self.scratch / "out" / record["result"]
            remote = posixpath.join(self.root, record["result"])
            if ".." not in result.parts and self.target.exists(remote) and self.target.size(remote) == record["bytes"]:
                self.shrink(result, record["bytes"])

    def done(self, files: Iterable[pathlib.Path]) -> Iterator[dict[str, Any]]:
        for line in itertools.chain.from_iterable(file.read_text().splitlines() for file in sorted(files)):
            if line.startswith('{"event":"done"') and line.endswith("}"):
                yield json.loads(line)

    @staticmethod
    def shrink(result: pathlib.Path, size: int) -> None:
        result.parent.mkdir(parents=True, exist_ok=True)
        with result.open("wb") as file:
            file.truncate(size)

    def groups(self, words: list[str]) -> Iterator[list[str]]:
        """The models that are left: without inputs, the command says of each that it cannot be read."""
        left: list[str] = []

        def take(line: bytes) -> None:
            model = json.loads(line)
            if model["status"] != "poisoned":
                left.append(model["path"])

        self.run_command(self.models, words, take)
        for file in {*self.records.iterdir()} - self.known:
            file.unlink()
        self.upload_identity(self.records.parent / "run.json", self.replaces)
        for first in range(0, len(left), _group):
            yield left[first : first + _group]

    def run_group(self, ids: list[str], words: list[str]) -> None:
        inputs = self.scratch / "in"
        inputs.mkdir(exist_ok=True)
        for id in ids:
            source, path = _file_system(self.models[id]["input"])
            if source.exists(path):  # otherwise the command says so
                source.get_file(path, str(self.scratch / self.local_input(id)))
        try:
            self.run_command(ids, words)
        finally:
            for file in inputs.iterdir():
                file.unlink()
            for record in self.done({*self.records.glob("*.jsonl")} - self.known):
                result = self.scratch / "out" / record["result"]
                self.target.makedirs(posixpath.dirname(self.remote(result)), exist_ok=True)
                self.target.put_file(str(result), self.remote(result))
                self.shrink(result, record["bytes"])
            self.upload_records()

    def local_input(self, id: str) -> str:
        """Another name than that of the model, which may be anything."""
        return "in/" + hashlib.sha256(id.encode()).hexdigest() + posixpath.splitext(self.models[id]["input"])[1]

    def run_command(self, ids: Iterable[str], words: list[str], take: Callable[[bytes], object] | None = None) -> None:
        list = self.scratch / "models.jsonl"
        lines = (json.dumps({**self.models[id], "input": self.local_input(id)}) for id in ids)
        list.write_text("".join(line + "\n" for line in lines))
        (self.records / "complete.json").unlink(missing_ok=True)
        _run(["--list", str(list), str(self.scratch / "out"), "--new-run", *words], take)

    def upload_records(self) -> None:
        """Uploads the records of attempts that ended since the last call."""
        files = {*self.records.glob("*.jsonl")}
        for file in files - self.known:
            if file.stat().st_size > 0:
                self.target.makedirs(posixpath.dirname(self.remote(file)), exist_ok=True)
                self.target.put_file(str(file), self.remote(file))
        self.known = files

    def upload_identity(self, file: pathlib.Path, replaces: bool) -> None:
        """Uploads run.json or complete.json with the hash of the whole list, or checks that the same is there."""
        own = {**json.loads(file.read_text()), "list": self.hash}
        remote = self.remote(file)
        if not replaces and self.target.exists(remote):
            other = json.loads(self.target.cat_file(remote))
            for name in own:
                if other.get(name) != own[name]:
                    raise OptionError(f"{remote}: the results are of a run with other {name}; choose another, or new_run=True")
            return
        self.target.makedirs(posixpath.dirname(remote), exist_ok=True)
        self.target.pipe_file(remote, (json.dumps(own, separators=(",", ":")) + "\n").encode())
