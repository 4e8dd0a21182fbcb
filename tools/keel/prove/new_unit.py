# SPDX-License-Identifier: Apache-2.0
"""Begin a unit in a project that uses Keel: docs/own_unit.md.

    python3 tools/keel new --project FOLDER --unit limiter [--layer app] [--id LIM]

Where the project has no such header, the files are those of examples/new_unit under the new names:
they are proved and tested as they stand, to be changed step by step. Where include/LAYER/NAME.h is
there with prototypes, harnesses are made of them, and what they need.

Exit status: 0 when the files are written, 2 when not: a file that is there already is named, and
nothing is written.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from keel.audit import determined
from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text, write_text
from keel.c.project import find_units
from keel.prove import skeleton

TEMPLATE = ROOT / "examples" / "new_unit"
# What the example is called, and its layer.
UNIT, LAYER, LABEL = "limiter", "app", "LIM"
# Files that a project has once: what belongs to a unit is added to them.
SHARED = ("specs/requirements.toml", "proofs/preconditions.toml")
WORDS = frozenset(
    "auto break case char const continue default do double else enum extern float for goto if"
    " inline int long register restrict return short signed sizeof static struct switch typedef"
    " union unsigned void volatile while bool true false".split()
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("new", lambda: new(arguments))


def new(arguments: Sequence[str] | None) -> int:
    """Write the files of a unit."""
    parser = Parser(__doc__.partition("\n")[0], prog="new")
    parser.add_argument("--project", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--unit", default="", metavar="NAME", help="as in limiter.h")
    parser.add_argument(
        "--layer",
        default="",
        metavar="NAME",
        help="its folder below include/ and src/; default: the only one, or app",
    )
    parser.add_argument(
        "--id",
        default="",
        metavar="LIM",
        help="what its requirements begin with; default: of the unit's name",
    )
    options = parser.parse_args(arguments)
    root: Path = options.project.resolve()
    name = checked_name("unit", options.unit)
    label = checked_label(options.id or re.sub("[^a-z]", "", name)[:3].upper())
    unit = find_units(root).get(name)
    if unit and options.layer not in ("", unit.layer):
        raise ToolError(f"the unit {name} is there already: {unit.header.relative_to(root)}")
    if unit:
        write(root, skeleton.files(skeleton.read_unit(unit, label)), {})
        advice = "write what is to be written in models, bodies and tests"
    else:
        layer = options.layer or only_layer(root)
        made = renamed({LAYER: checked_name("layer", layer), UNIT: name}, label)
        shared = {path: made.pop(path) for path in SHARED}
        write(root, made, {path: added(root, path, text, label) for path, text in shared.items()})
        determined.update_kept(root)
        advice = "it can be proved and tested as it stands; change it step by step"
    print(f"next: {advice}: {ROOT / 'docs' / 'primer.md'}")
    return 0


def checked_name(what: str, name: str) -> str:
    """A name that can begin functions' names."""
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or name in WORDS or name == "keel":
        raise ToolError(f"{what}={name}: expected a name in small letters, such as {UNIT}")
    return name


def checked_label(label: str) -> str:
    """What ids of requirements begin with."""
    if not re.fullmatch(r"[A-Z]{3,4}", label):
        raise ToolError(f"--id {label}: expected three or four capitals, such as {LABEL}")
    return label


def only_layer(root: Path) -> str:
    """The layer that a project has, or the first one's name."""
    layers = sorted({unit.layer for unit in find_units(root).values()})
    if len(layers) > 1:
        raise ToolError(f"in which layer ({', '.join(layers)})? --layer {layers[0]}")
    return layers[0] if layers else LAYER


def renamed(names: Mapping[str, str], label: str) -> dict[str, str]:
    """The example's files under a unit's names, by their paths."""
    made = {}
    for path in sorted(TEMPLATE.rglob("*")):
        place = path.relative_to(TEMPLATE)
        if path.is_file() and place.parts[0] != "build" and str(place) != determined.KEPT:
            made[_renamed(place.as_posix(), names, label)] = _renamed(read_text(path), names, label)
    return made


def _renamed(text: str, names: Mapping[str, str], label: str) -> str:
    """A text under a unit's names."""
    text = re.sub(rf"\b{LAYER}/", f"{names[LAYER]}/", text)
    text = re.sub(rf"\b{LAYER.upper()}_(?={UNIT.upper()}_H)", f"{names[LAYER].upper()}_", text)
    text = re.sub(rf"(?<![A-Za-z]){LABEL}(?=[-_]\d)", label, text)
    text = re.sub(rf"(?<![A-Za-z]){UNIT.upper()}(?![A-Za-z])", names[UNIT].upper(), text)
    return re.sub(rf"(?<![A-Za-z]){UNIT}(?![A-Za-z])", names[UNIT], text)


def added(root: Path, path: str, text: str, label: str) -> str:
    """A file that the project has once, with the unit's entries behind those that are there."""
    if not (root / path).is_file():
        return text
    before = read_text(root / path)
    if f'id = "{label}-' in before:
        raise ToolError(f"{path}: {label}-… is there already: choose others, --id ABC")
    return before.rstrip("\n") + "\n\n" + text[text.index("[[") :]


def write(root: Path, made: Mapping[str, str], shared: Mapping[str, str]) -> None:
    """Write all of it, or nothing where a file is there that is a new one."""
    there = [path for path in made if (root / path).exists()]
    if there:
        raise ToolError("nothing is written, as there is already: " + ", ".join(sorted(there)))
    for path, text in sorted({**made, **shared}.items()):
        print(f"{'changed' if (root / path).exists() else 'written'} {path}")
        write_text(root / path, text)
