"""Conversion of keyword arguments to the options of the C API."""

from __future__ import annotations

import difflib
import functools
import inspect
import operator
import weakref
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar, Union, cast

import numpy

from ._interrupt import HeldInterrupt
from ._library import Progress as Callback
from ._library import call, library
from ._progress_line import ProgressLine
from .errors import OptionError

Result = TypeVar("Result")
Function = TypeVar("Function", bound=Callable[..., Any])
Progress = Union[Callable[[str, float], object], bool, None]

_phases = ["load", "weld", "simplify", "map", "bake", "save"]


def enum_value(names: Sequence[str], name: str, option: str) -> int:
    """Returns the value of an enumerator of the C API. Raises OptionError if the name is unknown."""
    if not isinstance(name, str) or name not in names:
        raise OptionError(f"{option}: unknown value {name!r} (expected: {', '.join(names)})")
    return names.index(name)


def parse_length(value: float | str, option: str) -> tuple[float, int]:
    """Parses 0.01 (model units) or "0.1%" (of the diagonal). Returns value and unit."""
    try:
        if isinstance(value, str) and value.endswith("%"):
            return float(value[:-1]) / 100, 1
        return float(value), 0
    except (TypeError, ValueError, OverflowError):
        raise OptionError(f"{option}: {value!r} is not a length, such as 0.01 or '0.1%'") from None


def checked_switch(value: Any, option: str) -> bool:
    """Returns True or False. Raises OptionError for other values, whose truth would be a guess."""
    if not isinstance(value, (bool, numpy.bool_)):
        raise OptionError(f"{option}: {value!r} is not True or False")
    return bool(value)


def checked_integer(value: Any, option: str, bits: int) -> int:
    """Returns `value` as int. Raises OptionError if it is not an integer from 0 to 2^bits - 1."""
    try:
        number = operator.index(value)  # int() would round the value of an array of floats
    except TypeError:
        number = -1
    if not 0 <= number < 2**bits:
        raise OptionError(f"{option}: {value!r} is not an integer from 0 to 2^{bits} - 1")
    return number


def option_names() -> list[str]:
    """Returns the options of the C API as keywords, for example "texel_density"."""
    return [library.faqem_option_name(i).decode().replace("-", "_") for i in range(library.faqem_option_count())]


def option_helps() -> dict[str, str]:
    """Returns option_names() with a sentence about each."""
    return {name: library.faqem_option_help(i).decode() for i, name in enumerate(option_names())}


def _text(value: Any) -> str | None:
    """Converts the value of an option to text. None if it is neither a number nor a text."""
    if isinstance(value, str):
        return {"automatic": "auto"}.get(value, value).replace("_", "-")
    if isinstance(value, (bool, numpy.bool_)):
        return "on" if value else "off"
    conversions: list[Callable[[], str]] = [lambda: str(operator.index(value)), lambda: repr(float(value))]
    for convert in conversions:
        try:
            return convert()
        except (TypeError, ValueError):
            pass
    return None


def unknown_keyword(keyword: str, known: Iterable[str]) -> TypeError:
    """Returns the exception for a keyword that a function does not have. It names the closest that the function has."""
    close = difflib.get_close_matches(keyword, sorted(known), 1)
    return TypeError(f"unknown option {keyword!r}" + (f"; did you mean {close[0]!r}?" if close else ""))


def names_keywords(function: Function) -> Function:
    """Decorator: a misspelt keyword is a TypeError that suggests the right one."""
    parameters = inspect.signature(function).parameters.values()
    known = [parameter.name for parameter in parameters
             if parameter.kind != parameter.POSITIONAL_ONLY and parameter.name not in ("self", "cls")]

    @functools.wraps(function)
    def checked(*arguments: Any, **keywords: Any) -> Any:
        for keyword in keywords.keys() - set(known):
            raise unknown_keyword(keyword, known)
        return function(*arguments, **keywords)

    return cast(Function, checked)


class Options:
    """Options object of the C API. The keywords are option_names(); None leaves an option at its default.

    also  other keywords of the calling function, which misspelt ones may stand for
    """

    def __init__(self, also: Iterable[str] = (), /, *, progress: Progress = None, **options: Any) -> None:
        given = {keyword: value for keyword, value in options.items() if value is not None}
        if "ratio" in given and "faces" in given:
            raise OptionError("ratio and faces: only one of them can be set")
        self.object = library.faqem_options_create()
        if not self.object:
            raise MemoryError
        weakref.finalize(self, library.faqem_options_destroy, self.object)
        self._interrupt = HeldInterrupt()
        self._callback_exception: BaseException | None = None
        for keyword in options.keys() - set(option_names()):
            raise self._unknown(keyword, [*option_names(), "progress", *also])
        for keyword, value in given.items():
            self._set(keyword, checked_switch(value, keyword) if keyword == "history" else value)
        self._set_progress(progress)

    def _unknown(self, keyword: str, known: Iterable[str]) -> TypeError:
        """As unknown_keyword(); of an option of the command or of fast_simplification it says what stands for it."""
        if keyword in ("target_reduction", "target_count", "lossless", "return_collapses", "agg", "preserve_border"):
            return TypeError(f"unknown option {keyword!r}; faqem.fast_simplification.simplify() has it")
        try:
            self._set(keyword, "")
        except OptionError as error:
            if "the command" in str(error):
                return TypeError(str(error).replace("-", "_"))
        return unknown_keyword(keyword, known)

    def _set(self, keyword: str, value: Any) -> None:
        if keyword == "faces" and isinstance(value, float) and value.is_integer():
            value = int(value)  # 1e5
        name, text = keyword.replace("_", "-"), _text(value)
        if text is None:
            raise OptionError(f"{keyword}: {value!r} is neither a number nor a text")
        try:
            call(library.faqem_options_set, self.object, name.encode(), text.encode())
        except OptionError as error:
            raise OptionError(str(error).replace(name, keyword, 1)) from None

    def _set_progress(self, progress: Progress) -> None:
        """Sets the callback; True: a line on standard error.

        Exceptions cannot pass through C: they cancel the run, and run() raises them.
        """
        if progress is not None and not callable(progress):
            progress = checked_switch(progress, "progress")
        self._line = ProgressLine() if progress is True else None
        show = self._line or (progress if callable(progress) else None)

        def called(_user: object, phase: int, fraction: float) -> int:
            if self._callback_exception is not None:
                return 1  # the run has been cancelled
            try:
                self._interrupt.deliver()
                if show is not None:
                    show(_phases[phase], fraction)
            except BaseException as raised:  # includes KeyboardInterrupt
                self._callback_exception = raised
                return 1
            return 0

        self._callback = Callback(called)  # keeps the callback alive: C has only a pointer to it
        library.faqem_options_set_progress(self.object, self._callback, None)

    def run(self, work: Callable[[], Result]) -> Result:
        """Calls `work` and returns its result, which owns what was created.

        Raises the exception of the progress callback or of the handler of SIGINT, if any.
        """
        self._interrupt = HeldInterrupt()
        try:
            with self._interrupt:
                result = work()
        finally:
            if self._line:
                self._line.end()
            if self._callback_exception is not None:
                raised, self._callback_exception = self._callback_exception, None
                raise raised from None
            self._interrupt.deliver()
        return result
