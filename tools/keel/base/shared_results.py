# SPDX-License-Identifier: Apache-2.0
"""What several jobs need, made by one of them."""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from typing import Any, TypeVar

T = TypeVar("T")


class Once:
    """Has each thing made by whoever asks for it first; who asks meanwhile waits for it."""

    def __init__(self) -> None:
        self._made: dict[Hashable, Future[Any]] = {}
        self._lock = threading.Lock()

    def get(self, key: Hashable, make: Callable[[], T]) -> T:
        """What `make` gave for this key, or raised, when it was asked for first."""
        with self._lock:
            made = self._made.get(key)
            first = made is None
            if made is None:
                made = self._made[key] = Future()
        if first:
            try:
                made.set_result(make())
            except BaseException as error:
                made.set_exception(error)
        result: T = made.result()
        return result
