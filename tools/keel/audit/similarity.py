# SPDX-License-Identifier: Apache-2.0
"""How alike a unit's code and its model are, word by word, names aside.

A model that is the code under other names repeats its slips: that both are equal then says little
of whether they are right. Of such a unit proofs/same_term.toml says what else would see a slip.
"""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from pathlib import Path

from keel.c import source as csource
from keel.c.project import ProjectError, Unit
from keel.judge.harness import MODELS

TABLE = "proofs/same_term.toml"
# From here on a model is taken for the code under other names.
ALIKE = 0.75
WORD = re.compile(r"[A-Za-z_]\w*|\d[\w.]*|[^\s\w]")
# Words of C that stay what they are; all other names count as one.
KEPT = frozenset(
    "if else for while do switch case default return break continue const static void bool float"
    " true false NULL uint8_t uint16_t uint32_t uint64_t int16_t int32_t int64_t".split()
)


def similarity(unit: Unit) -> float:
    """From 0 to 1: of the runs of three words in code and model, how many are in both."""
    own_part = f"{unit.name}_"
    models = sorted((unit.root / MODELS).glob(f"{unit.name}*.c"))
    own = [path for path in models if path.stem == unit.name or path.stem.startswith(own_part)]
    code, model = _runs(unit.own_files), _runs(own)
    total = code.total() + model.total()
    return 2 * (code & model).total() / total if model and total else 0.0


def _runs(files: list[Path]) -> Counter[tuple[str, ...]]:
    """The runs of three words in all functions of files: the order of functions does not matter."""
    runs: Counter[tuple[str, ...]] = Counter()
    for path in files:
        text = csource.read(path)
        for function in csource.defined(text):
            words = [_plain(word) for word in WORD.findall(csource.body_of(text, function.name))]
            runs.update(zip(words, words[1:], words[2:], strict=False))
    return runs


def _plain(word: str) -> str:
    """A word, whatever a variable, a field or a function is called."""
    if not re.match(r"[a-z_]", word) or word in KEPT:
        return word
    return "name"


def read_table(root: Path) -> dict[str, str]:
    """By units: what else would see a slip."""
    path = root / TABLE
    found = tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    for unit, entry in found.items():
        if set(entry) != {"seen_by"} or not str(entry["seen_by"]).strip():
            raise ProjectError(f"{TABLE}: [{unit}] has `seen_by`, and nothing else")
    return {unit: str(entry["seen_by"]) for unit, entry in found.items()}
