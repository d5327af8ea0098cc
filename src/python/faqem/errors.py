"""The exceptions of faqem, one per kind. What is out of memory raises MemoryError."""


class Error(Exception):
    """Base of all of them."""


class OptionError(Error, ValueError):
    """An option is out of range or unknown."""


class InputError(Error, ValueError):
    """The data is wrong, or a file could not be read. The message names file and element."""


class UnsupportedError(InputError):
    """The input is valid, but of a kind that is not read."""


class WriteError(Error, OSError):
    """A file could not be written. The old one, if any, is untouched."""


class InternalError(Error):
    """A mistake in faqem."""
