"""Signals while a function of the library runs."""

from __future__ import annotations

import signal
import threading
from types import FrameType
from typing import Any


class HeldInterrupt:
    """Holds SIGINT back in the main thread, as a context manager.

    Python runs a handler between any two instructions, also in a callback from C, where ctypes would drop its exception
    (KeyboardInterrupt). Handlers are therefore called by deliver() only.
    """

    def __init__(self) -> None:
        self._handler: Any = None
        self._frame: FrameType | None = None
        self._is_pending = False

    def __enter__(self) -> HeldInterrupt:
        if threading.current_thread() is threading.main_thread():
            handler = signal.getsignal(signal.SIGINT)
            if callable(handler):
                self._handler = handler
                signal.signal(signal.SIGINT, self._hold)
        return self

    def __exit__(self, *_exception: object) -> None:
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._handler)

    def _hold(self, _number: int, frame: FrameType | None) -> None:
        self._is_pending, self._frame = True, frame

    def deliver(self) -> None:
        """Calls the handler of a signal that has arrived. Raises its exception."""
        if self._is_pending:
            self._is_pending = False
            self._handler(signal.SIGINT, self._frame)
