"""A command line whose mistakes are told in one line, with the nearest right word."""

from __future__ import annotations

import argparse
import re
import sys
from typing import NoReturn

from common.errors import CANNOT, nearest


class Parser(argparse.ArgumentParser):
    """argparse's, but for its way to refuse; no option may be shortened."""

    def __init__(self, description: str, prog: str | None = None) -> None:
        super().__init__(prog=prog, description=description, allow_abbrev=False)

    def error(self, message: str) -> NoReturn:
        """One line and exit status 2."""
        word = re.search(r"unrecognized arguments: (\S+)", message)
        like = nearest(word[1].partition("=")[0], self._option_string_actions) if word else ""
        guess = f"; did you mean {like}?" if like else ""
        print(f"{self.prog}: {message}{guess} (--help lists all)", file=sys.stderr)
        sys.exit(CANNOT)
