# SPDX-License-Identifier: Apache-2.0
"""A command line whose mistakes are told in one line, with the nearest right word."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from typing import Any, NoReturn

from keel.base.errors import CANNOT, nearest


class Parser(argparse.ArgumentParser):
    """argparse's, but for its way to refuse; no option may be shortened."""

    def __init__(
        self, description: str | None = None, prog: str | None = None, **options: Any
    ) -> None:
        super().__init__(prog, description=description, allow_abbrev=False, **options)

    def words(self) -> Iterator[str]:
        """Every option and command, those of commands too."""
        for action in self._actions:
            yield from action.option_strings
            if isinstance(action.choices, dict):
                for name, command in action.choices.items():
                    yield name
                    yield from command.words()

    def error(self, message: str) -> NoReturn:
        """One line and exit status 2."""
        wrong = re.search(r"unrecognized arguments: ([^\s=]+)|invalid choice: '([^']*)'", message)
        like = nearest(wrong[1] or wrong[2], dict.fromkeys(self.words())) if wrong else ""
        guess = f"; did you mean {like}?" if like else ""
        print(f"{self.prog}: {message}{guess} (--help lists all)", file=sys.stderr)
        sys.exit(CANNOT)
