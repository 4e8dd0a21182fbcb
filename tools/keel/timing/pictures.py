# SPDX-License-Identifier: Apache-2.0
"""Make the pictures of the documents: docs/pictures.

    make generate NAME=pictures

Draws what Keel is made of (layers.svg), and takes over the plots that `make check NAME=campaign`,
`make check NAME=timing`, `make generate NAME=schedule` and flight/figure.py have left in build.
Committed pictures are small: a larger one is refused.

Exit status: 0 when all were written, 2 when one is missing or too large.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text, write_text
from keel.base.plotting import BLUE, GREEN, GREY, ORANGE, RED, new_figure, write_svg

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FOLDER = Path("docs/pictures")
TAKEN = (
    "build/campaign/faults.svg",
    "build/campaign/figure14.svg",
    "build/fly/flight.svg",
    "build/schedule/schedule.svg",
    "build/timing/experiments/figure10.svg",
    "build/timing/experiments/figure12.svg",
)
MOST_BYTES = 60_000


class Box(NamedTuple):
    """A box of the drawing: a title, and what stands below it."""

    title: str
    text: str
    colour: str
    tool: str = ""


LAYERS = ("flight", "middleware", "rtos")
NAMES = 64  # Letters of a line of units' names.


def units_of(layer: str) -> str:
    """The units of a layer."""
    headers = {path.stem for path in (ROOT / "include/keel").glob(f"**/{layer}/*.h")}
    names = sorted(name for name in headers if not name.endswith("_state"))
    return textwrap.fill("  ".join(names), NAMES)


def flies() -> list[Box]:
    """What flies, layer on layer."""
    return [
        Box("your tasks", "functions with a period, a budget and a priority", GREY),
        *(Box(f"Keel: {layer}", units_of(layer), BLUE) for layer in LAYERS),
        Box("your board", "a microsecond counter; drivers for two boards are here", GREY),
    ]


SHOWS = (
    Box("contract of each function", "for all inputs; of floats: by CBMC", GREEN, "Frama-C/WP"),
    Box("executable specification", "same result, same fields, floats bit for bit", GREEN, "CBMC"),
    Box("error bounds", "what rounding adds to the voter's mean", GREEN, "Gappa"),
    Box("mistakes on purpose", "a proof must notice each", RED, "mutants"),
    Box("tests", "on the host and on an emulated Cortex-M7", ORANGE, "sanitizers, QEMU"),
)
HEIGHT, STEP = 0.70, 0.77  # Of a box, and from one to the next.


def draw_box(axes: Axes, box: Box, left: float, bottom: float, width: float, height: float) -> None:
    """A box with a coloured edge; its title stands left, its tool right."""
    from matplotlib.patches import Rectangle

    axes.add_patch(Rectangle((left, bottom), width, height, facecolor="white", edgecolor="#cccccc"))
    axes.add_patch(Rectangle((left, bottom), 0.06, height, facecolor=box.colour))
    top = bottom + height - 0.08
    axes.text(left + 0.18, top, box.title, weight="bold", va="top")
    axes.text(left + 0.18, top - 0.22, box.text, va="top", fontsize=8, linespacing=1.15)
    axes.text(left + width - 0.12, top, box.tool, va="top", ha="right", color=GREY, fontsize=8)


def plot_layers(path: Path) -> None:
    """What flies at the left, layer on layer; what shows that it is right beside it."""
    figure = new_figure(9.0, 4.3)
    axes = figure.add_subplot()
    axes.set(xlim=(0.0, 9.0), ylim=(0.0, 4.3))
    axes.axis("off")
    for title, left, boxes in (
        ("What flies", 0.05, flies()),
        ("What shows that it is right", 4.85, SHOWS),
    ):
        axes.text(left, 4.05, title, fontsize=11, color=GREY)
        for number, box in enumerate(boxes):
            draw_box(axes, box, left, 3.2 - STEP * number, 4.1, HEIGHT)
    arrow = {"arrowstyle": "-|>", "color": GREEN, "linewidth": 2.0}
    middle = 3.2 - 2 * STEP + HEIGHT / 2
    axes.plot([4.25, 4.25], [middle - 1.5 * STEP, middle + 1.5 * STEP], color=GREEN, linewidth=2.0)
    axes.annotate("", xy=(4.25, middle), xytext=(4.85, middle), arrowprops=arrow)
    write_svg(path, figure)


def take(source: Path, folder: Path) -> None:
    """Copy a plot; a missing one, and one too large to be committed, is an error."""
    if not source.is_file():
        raise ToolError(f"{source}: missing; `make generate NAME=pictures` makes it")
    text = read_text(source)
    if len(text.encode()) > MOST_BYTES:
        raise ToolError(f"{source}: larger than {MOST_BYTES} bytes")
    write_text(folder / source.name, text)


def write(root: Path) -> int:
    """Draw and take over all pictures."""
    plot_layers(root / FOLDER / "layers.svg")
    for name in TAKEN:
        take(root / name, root / FOLDER)
    names = ", ".join(["layers.svg", *(Path(name).name for name in TAKEN)])
    print(f"written: {FOLDER}/{names}")
    return 0


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    Parser("Make the pictures of the documents.", "pictures").parse_args(arguments)
    return program("pictures", lambda: write(root))
