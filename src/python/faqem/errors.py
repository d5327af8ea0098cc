"""The exceptions of faqem, one class per kind of error. Out of memory is MemoryError.

Each is a ValueError or an OSError (a time limit: TimeoutError), but for defects.
"""


class Error(Exception):
    """Base class of all exceptions of faqem."""


class OptionError(Error, ValueError):
    """An option is out of range or unknown."""


class InputError(Error, ValueError):
    """The input is invalid, or a file could not be read. The message names file and element."""


class UnsupportedError(InputError):
    """The input is valid, but of a kind that is not supported."""


class ReadError(InputError, OSError):
    """A file does not exist or could not be opened."""


class WriteError(Error, OSError):
    """A file could not be written. An existing file is unchanged."""


class ByteLimitError(Error, ValueError):
    """No result has at most max_bytes."""


class TimeLimitError(Error, TimeoutError):
    """max_seconds was over before there was a result that the options allow."""


class TryAgainError(Error):
    """A shard of a list is not complete; another attempt goes on."""


class InternalError(Error):
    """A defect in faqem."""
