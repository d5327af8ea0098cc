"""Calls the module with random arrays, options and files, many of them wrong. Usage: fuzz_arrays.py [CALLS [SEED]]

Every call must return or raise ValueError, TypeError or OSError that names what is wrong, a third of the calls in four
threads at once. tests/wheel/run.sh runs it with 10,000 calls, which take less than a minute. By hand it is also run with a
library that is built with the address sanitizer (LD_PRELOAD of libasan.so).
"""

import collections
import concurrent.futures
import pathlib
import random
import sys
import tempfile

import faqem
import faqem.fast_simplification
import numpy


def positions(random_number, count):
    """Returns positions, most of them valid: other types, layouts and shapes, or numbers that are no positions."""
    kind = random_number.choice([numpy.float32, numpy.float64, numpy.float16, numpy.int32, numpy.int8, numpy.bool_, object])
    array = numpy.random.default_rng(random_number.getrandbits(32)).normal(size=(count, 3)) * 10.0 ** random_number.randint(-3, 3)
    if random_number.random() < 0.15 and count:
        array[random_number.randrange(count), random_number.randrange(3)] = random_number.choice(
            [numpy.nan, numpy.inf, -numpy.inf, 1e300, 1e-300])
    with numpy.errstate(all="ignore"):
        array = array.astype(kind)
    change = random_number.randrange(12)
    if change == 0:
        return array[:, :2]
    if change == 1:
        return array.ravel()
    if change == 2:
        return array[::-1]
    if change == 3:
        return numpy.asfortranarray(array)
    if change == 4:
        return array.tolist()
    if change == 5:
        return numpy.repeat(array, 2, axis=1)[:, ::2]
    if change == 6:
        return numpy.broadcast_to(array[:1], array.shape)
    return array


def indices(random_number, count, limit):
    """Returns triangles, most of them valid."""
    source = numpy.random.default_rng(random_number.getrandbits(32))
    array = source.integers(0, max(limit, 1), size=(count, 3))
    change = random_number.randrange(14)
    if change == 0 and count:
        array[random_number.randrange(count), 0] = random_number.choice([limit, -1, 2**31, 2**32 - 1, 2**40])
    kind = random_number.choice([numpy.int32, numpy.int64, numpy.uint32, numpy.uint16, numpy.uint8, numpy.float64])
    with numpy.errstate(all="ignore"):
        array = array.astype(kind)
    if change == 1:
        return array[:, :2]
    if change == 2:
        return array.T
    if change == 3:
        return array[::-1, ::-1]
    if change == 4:
        return numpy.hstack([numpy.full((count, 1), 3, array.dtype), array]).ravel()
    if change == 5:
        return random_number.choice([None, "triangles", 5, [[0, 1], [2]], [[]], numpy.zeros((0, 3), numpy.uint32)])
    return array


def options(random_number):
    """Returns options, some of them wrong."""
    choices = {
        "ratio": [0.5, 0.1, 0, 1, -1, 2, "half", numpy.nan], "faces": [0, 1, 5, 10**9, -1, 2.5, "many"],
        "target_reduction": [0.5, 0, 1, 2, None], "target_count": [1, 3, -1, 10**6, 0.5],
        "return_collapses": [True, False], "lossless": [True, False], "preserve_border": [True, False],
        "preset": ["qem", "paper", "stmw", "fast", "balanced", "best", "bets"], "history": [True, False, "yes"],
        "max_error": ["1%", 0.01, "x%", -1], "welding": ["none", "by_position", 5], "threads": [1, 2, -1],
        "boundary": ["locked", "free"], "prune": ["1%", 0.1], "weld_distance": [0.1, -1, numpy.inf],
        "virtual_edges": [True, 0.01], "link": ["on", "strict"], "no_such_option": [1],
    }
    names = random_number.sample(sorted(choices), random_number.choice([0, 1, 1, 2, 3]))
    return {name: random_number.choice(choices[name]) for name in names}


def call_model(random_number, points, triangles, given):
    """Bakes a model of arrays, and reads its arrays."""
    model = faqem.Model.from_arrays(points, triangles)
    chosen = random_number.choice([{"bake": "none"}, {"bake": "vertex"}, {"texture_size": 64}, {"texture_size": 100},
                                   {"normals": "flat"}, {"samples": 9}])
    options = {name: value for name, value in given.items() if name not in ("groups", "locks", "weights", "uvs")}
    baked = faqem.simplify(model, **{**chosen, **options})
    for part in (*model.parts, *baked.parts):
        assert part.triangles.size == 0 or part.triangles.max() < len(part.vertices)
    assert [image.pixels().ndim for image in baked.images] == [3] * len(baked.images)


def call_file(random_number):
    """Reads a file that is a model with wrong bytes, an empty one, or none."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "a" + random_number.choice([".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".txt", ""]))
        change = random_number.randrange(4)
        if change == 0:
            file.write_bytes(random_number.choice([b"", b"glTF", b"ply\n", b"{}", b"v 0 0 0\n", bytes(200)]))
        elif change < 3:
            good = file.with_suffix(".ply" if file.suffix not in (".glb", ".obj", ".stl") else file.suffix)
            faqem.save(([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [1, 3, 2]]), good)
            content = bytearray(good.read_bytes())
            for _ in range(random_number.choice([0, 1, 5])):
                content[random_number.randrange(len(content))] = random_number.randrange(256)
            file.write_bytes(content[: random_number.choice([len(content), random_number.randrange(len(content))])])
        model = faqem.load(file)
        faqem.simplify(model, ratio=0.5, bake="none", normals="flat")


def call_objects(random_number, points, triangles):
    """Passes objects to functions that expect others: the library would take one for another."""
    out = faqem.simplify(points, triangles, ratio=0.5, history=True)
    model = faqem.Model.from_arrays(points, triangles)
    things = [out, model, faqem.History.of([out]), None, "a", 5, 0.5, points, (points, triangles), [out], [model, out], []]
    a, b, c = (random_number.choice(things) for _ in range(3))
    with tempfile.TemporaryDirectory() as folder:
        file = random_number.choice([pathlib.Path(folder, "a.glb"), pathlib.Path(folder, "a.ply"), a])
        random_number.choice([
            lambda: faqem.simplify(a, ratio=0.5, bake="none"), lambda: faqem.simplify_levels(a, b, bake="none"),
            lambda: faqem.bake_truncated(a, b, 5, bake="none"), lambda: faqem.History.of(a), lambda: faqem.load(a),
            lambda: faqem.History.load(a), lambda: faqem.save(b, file, overwrite=c), lambda: faqem.save(b, file),
            lambda: faqem.save_levels(b, file), lambda: faqem.simplify(a, b), lambda: faqem.simplify_levels(a, b, c),
            lambda: faqem.Model.from_arrays(a, b), lambda: faqem.fast_simplification.replay_simplification(a, b, c), lambda: out.map(a, b, c),
            lambda: faqem.simplify(points, triangles, progress=a, history=b), lambda: faqem.simplify_levels(points, triangles, a),
        ])()


def call(random_number):
    """Makes one random call."""
    count = random_number.choice([0, 1, 3, 8, 30])
    points = positions(random_number, count)
    triangles = indices(random_number, random_number.choice([0, 1, 4, 20, 60]), count)
    given = options(random_number)
    if random_number.random() < 0.2:
        values = numpy.random.default_rng(random_number.getrandbits(32))
        given[random_number.choice(["groups", "locks", "weights", "uvs"])] = values.random(
            random_number.choice([count, (count, 3, 2), 5, 0]))
    kind = random_number.choice([0, 1, 2, 3, 4] * 4 + [5] * 3 + [6] + [7] * 2)
    if kind == 5:
        call_model(random_number, points, triangles, given)
    elif kind == 6:
        call_file(random_number)
    elif kind == 7:
        call_objects(random_number, points, triangles)
    elif kind == 0:
        faqem.simplify_levels(points, triangles, random_number.choice([[0.5, 0.1], [5], ["error:1%"], [], [-1], "0.5"]), **given)
    elif kind == 1:
        pairs = numpy.random.default_rng(random_number.getrandbits(32)).integers(0, max(count, 1), size=(count // 4, 2))
        faqem.fast_simplification.replay_simplification(points, triangles, pairs)
    elif kind == 2:
        out = faqem.simplify(points, triangles, ratio=0.5, history=True)
        out.map([0, random_number.randrange(-1, 9)], [[1, 0, 0], [random_number.uniform(-1, 2), 0, 1]])
        faqem.History.of([out]).truncate(random_number.randrange(-1, 20))
    else:
        compatible = {"target_reduction", "target_count", "return_collapses", "lossless", "preserve_border"} & given.keys()
        (faqem.fast_simplification.simplify if compatible else faqem.simplify)(points, triangles, **given)


def outcome(seed, number):
    """Makes a call. Returns the name of its exception, or "returned"."""
    try:
        call(random.Random(seed * 1_000_003 + number))
        return "returned"
    except (ValueError, TypeError, OSError) as error:
        assert str(error), f"call {number}: a message is missing"
        return type(error).__name__
    except BaseException:
        print(f"call {number} of seed {seed}")
        raise


def main():
    calls, seed = (int(word) for word in (sys.argv[1:] + ["10000", "1"][len(sys.argv) - 1:]))
    alone = calls - calls // 3
    outcomes = collections.Counter(outcome(seed, number) for number in range(alone))
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        outcomes.update(pool.map(lambda number: outcome(seed, number), range(alone, calls)))
    print(dict(outcomes))


if __name__ == "__main__":
    main()
