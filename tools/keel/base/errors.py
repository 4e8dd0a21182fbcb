# SPDX-License-Identifier: Apache-2.0
"""The one exception of a tool, what it makes of the exit status, and the nearest right name."""

from __future__ import annotations

import difflib
import sys
import traceback
from collections.abc import Callable, Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]

CANNOT = 2  # Exit status: what was to be checked could not be. 1 says that it was, and is not good.
INTERRUPTED = 130


class ToolError(Exception):
    """Why a tool cannot do its work: one line, below it the words of a program that failed. What
    was checked and is not good has a class of its own, with status 1."""

    status = CANNOT


def nearest(word: str, known: Iterable[str]) -> str:
    """The known name that is most like a word; empty when none is."""
    names = list(known)
    lower = {name.lower(): name for name in reversed(names)}
    found = difflib.get_close_matches(word.lower(), lower, 1, 0.6)
    begun = [name for name in names if word and name.lower().startswith(word.lower())]
    return lower[found[0]] if found else (begun[0] if len(begun) == 1 else "")


def unknown(kind: str, word: str, known: Iterable[str]) -> str:
    """The line that refuses a name: which, what it is nearest to, and what there is."""
    names = list(known)
    like = nearest(word, names)
    guess = f"; did you mean {like}?" if like else ""
    return f"there is no {kind} {word or '(none named)'}{guess} ({kind}s: {', '.join(names)})"


def said(error: OSError) -> str:
    """What an error of the system says: the file and the reason, without Python's number."""
    reason = error.strerror or str(error)
    return f"{error.filename}: {reason}" if error.filename else reason


def program(name: str, body: Callable[[], int]) -> int:
    """Run a tool; whatever ends it is told in its name, and is the exit status."""
    try:
        return body()
    except ToolError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return error.status
    except OSError as error:
        print(f"{name}: {said(error)}", file=sys.stderr)
    except KeyboardInterrupt:
        print(f"{name}: interrupted", file=sys.stderr)
        return INTERRUPTED
    except Exception:
        # Python's own status is 1, which would say that something was checked.
        traceback.print_exc()
        print(f"{name}: a fault of the program itself", file=sys.stderr)
    return CANNOT
