"""Conversion of keyword arguments to the options of the C API."""

import operator
import weakref

from ._library import Progress, library
from .errors import OptionError

_presets = ["qem", "paper", "stmw", "fast", "balanced", "best"]
_links = ["as_preset", "off", "by_size", "on", "strict"]
_boundaries = ["free", "kept"]
_visibilities = ["ignored", "weighted"]
_bakes = ["automatic", "atlas", "per_triangle", "vertex", "keep", "none"]
_normal_maps = ["automatic", "on", "off"]
_normals = ["transfer", "smooth", "flat", "none"]
_image_formats = ["png", "jpeg", "source"]
_phases = ["load", "weld", "simplify", "map", "bake", "save"]


def enum_value(names, name, option):
    """Returns the value of an enumerator of the C API. Raises OptionError if the name is unknown."""
    if name not in names:
        raise OptionError(f"{option}: unknown value {name!r} (expected: {', '.join(names)})")
    return names.index(name)


def parse_length(value, option):
    """Parses 0.01 (model units) or "0.1%" (of the diagonal). Returns value and unit."""
    try:
        if isinstance(value, str) and value.endswith("%"):
            return float(value[:-1]) / 100, 1
        return float(value), 0
    except ValueError:
        raise OptionError(f"{option}: {value!r} is not a length, such as 0.01 or '0.1%'") from None


def checked_integer(value, option, bits):
    """Returns `value` as int. Raises OptionError if it is not an integer from 0 to 2^bits - 1."""
    try:
        number = operator.index(value)  # int() would round the value of an array of floats
    except TypeError:
        number = -1
    if not 0 <= number < 2**bits:
        raise OptionError(f"{option}: {value!r} is not an integer from 0 to 2^{bits} - 1")
    return number


class Options:
    """Options object of the C API. None leaves an option at its default."""

    def __init__(self, *, ratio=None, faces=None, max_error=None, preset=None, link=None, boundary=None,
                 group_boundaries=None, weld_distance=None, virtual_edges=None, prune=None, threads=None,
                 progress=None, history=None, visibility=None, bake=None, texture_size=None, texel_density=None,
                 normal_map=None, normals=None, image_format=None):
        if ratio is not None and faces is not None:
            raise OptionError("ratio and faces: only one of them can be set")
        self.object = library.faqem_options_create()
        if not self.object:
            raise MemoryError
        weakref.finalize(self, library.faqem_options_destroy, self.object)
        self._callback_exception = None
        if ratio is not None:
            self._set("ratio", float(ratio))
        if faces is not None:
            self._set("faces", checked_integer(faces, "faces", 53))
        if max_error is not None:
            self._set("max_error", *parse_length(max_error, "max_error"))
        if weld_distance is not None:
            self._set("weld_distance", float(weld_distance))
        if virtual_edges is not None:
            self._set("virtual_edges", float(virtual_edges))
        if prune is not None:
            self._set("prune", *parse_length(prune, "prune"))
        if threads is not None:
            self._set("threads", checked_integer(threads, "threads", 32))
        if history is not None:
            self._set("history", 1 if history else 0)
        if texture_size is not None:
            self._set("texture_size", checked_integer(texture_size, "texture_size", 32))
        if texel_density is not None:
            self._set("texel_density", float(texel_density))
        for option, setter, name, names in [
            ("preset", "preset", preset, _presets),
            ("link", "link", link, _links),
            ("boundary", "boundary", boundary, _boundaries),
            ("group_boundaries", "group_boundaries", group_boundaries, _boundaries),
            ("visibility", "visibility", visibility, _visibilities),
            ("bake", "bake", bake, _bakes),
            ("normal_map", "normal_map", normal_map, _normal_maps),
            ("normals", "normals", normals, _normals),
            ("image_format", "image_format", image_format, _image_formats),
        ]:
            if name is not None:
                self._set(setter, enum_value(names, name, option))
        self._set_progress(progress)

    def _set(self, name, *values):
        if getattr(library, "faqem_options_set_" + name)(self.object, *values) != 0:
            raise OptionError(f"{name}: invalid value {values}")

    def _set_progress(self, progress):
        """Sets the callback. Exceptions cannot pass through C: they cancel the run, and run() raises them."""

        def called(_user, phase, fraction):
            try:
                if progress is not None:
                    progress(_phases[phase], fraction)
            except BaseException as raised:  # includes KeyboardInterrupt
                self._callback_exception = raised
                return 1
            return 0

        self._callback = Progress(called)  # keeps the callback alive: C has only a pointer to it
        self._set("progress", self._callback, None)

    def run(self, work):
        """Calls `work` and returns its result. Raises the exception of the progress callback, if any."""
        try:
            return work()
        finally:
            if self._callback_exception is not None:
                raised, self._callback_exception = self._callback_exception, None
                raise raised
