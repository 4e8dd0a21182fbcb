# SPDX-License-Identifier: Apache-2.0
"""Texts in which the places of lines do not count: a comment more or less changes none of them."""

from __future__ import annotations

from functools import lru_cache

from keel.c.source import without_prose


@lru_cache(maxsize=1024)
def read_by_provers(text: str) -> str:
    """What provers read of a text, annotations included, without the lines that are empty then."""
    return "\n".join(line for line in without_prose(text).splitlines() if line.strip())
