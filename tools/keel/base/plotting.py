# SPDX-License-Identifier: Apache-2.0
"""One look for every picture: colours, axes, and SVG without a date or a random name; and PNG."""

from __future__ import annotations

import os
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from keel.base.files import write_bytes, write_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito's colours, which people tell apart whatever their eyes.
BLUE, ORANGE, GREEN, RED, SKY, PURPLE = (
    "#0072b2",
    "#e69f00",
    "#009e73",
    "#d55e00",
    "#56b4e9",
    "#cc79a7",
)
GREY = "#767676"
COLOURS = (BLUE, ORANGE, GREEN, SKY, PURPLE, RED)

STYLE: Any = {  # Keys of matplotlib, which has a type of its own for them.
    "svg.hashsalt": "keel",  # Names inside of the file, which are random without.
    "svg.fonttype": "none",  # Text stays text.
    "path.simplify_threshold": 0.5,  # Of a pixel: what nobody sees is not stored.
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "lines.linewidth": 1.2,
}


def new_figure(width: float, height: float) -> Figure:
    """A figure that needs no display; sizes in inches."""
    # Its cache of fonts belongs to us, not to the user's home.
    os.environ.setdefault("MPLCONFIGDIR", str(Path(os.environ.get("TMPDIR", "/tmp")) / "keel-mpl"))
    import matplotlib
    from cycler import cycler

    matplotlib.use("svg")
    matplotlib.rcParams.update(STYLE)
    matplotlib.rcParams["axes.prop_cycle"] = cycler(color=COLOURS)
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def grid_along(axes: Axes, axis: str) -> None:
    """Keep only the lines that values are read from."""
    axes.grid(False, axis="x" if axis == "y" else "y")


def write_svg(path: Path, figure: Figure) -> None:
    """A figure as SVG, without a date."""
    stream = BytesIO()
    figure.savefig(stream, format="svg", metadata={"Date": None})
    lines = [line.rstrip() for line in stream.getvalue().decode().splitlines()]
    write_text(path, "\n".join([*lines, ""]))


def write_png(path: Path, figure: Figure) -> None:
    """A figure as PNG, which does not say by what it was drawn."""
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=110, metadata={"Software": None})
    write_bytes(path, stream.getvalue())
