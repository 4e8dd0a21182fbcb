# SPDX-License-Identifier: Apache-2.0
"""Draws graphs in columns, as SVG: each node is a link, and as wide as its words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape

LETTER, ROW, BOX, GAP, MARGIN = 7.6, 34, 24, 90, 10  # Pixels; a letter of a monospaced font.


@dataclass(frozen=True)
class Node:
    """A box with words, and where it leads."""

    key: str
    label: str
    address: str
    state: str
    column: int
    title: str = ""


@dataclass(frozen=True)
class Box:
    """Where a node is drawn."""

    left: float
    top: float
    width: float


def columns_of(nodes: Sequence[Node]) -> list[list[Node]]:
    """The nodes of each column that has any."""
    numbers = sorted({node.column for node in nodes})
    return [[node for node in nodes if node.column == number] for number in numbers]


def middle(near: Iterable[str], places: Mapping[str, int], otherwise: float) -> float:
    """Where the neighbours that have a place stand on the average."""
    seen = [places[key] for key in near if key in places]
    return sum(seen) / len(seen) if seen else otherwise


def sorted_by_neighbours(
    columns: list[list[Node]], edges: Iterable[tuple[str, str]]
) -> list[list[Node]]:
    """Each column in the order of what it is linked with to its left, so that few lines cross."""
    near: dict[str, list[str]] = {}
    for start, end in edges:
        near.setdefault(end, []).append(start)
        near.setdefault(start, []).append(end)
    places: dict[str, int] = {}
    ordered: list[list[Node]] = []
    for column in columns:
        heights = {node.key: middle(near.get(node.key, ()), places, len(places)) for node in column}
        kept = sorted(column, key=lambda node: heights[node.key]) if ordered else column
        places |= {node.key: number for number, node in enumerate(kept)}
        ordered.append(kept)
    return ordered


def lay_out(columns: Sequence[Sequence[Node]]) -> tuple[dict[str, Box], float, float]:
    """Where each node is drawn, and how large the drawing is."""
    highest = max((len(column) for column in columns), default=0) * ROW
    left, boxes = float(MARGIN), {}
    for column in columns:
        width = max(len(node.label) for node in column) * LETTER + 22
        top = MARGIN + (highest - len(column) * ROW) / 2
        for number, node in enumerate(column):
            boxes[node.key] = Box(left, top + number * ROW, width)
        left += width + GAP
    return boxes, left - GAP + MARGIN, highest + 2 * MARGIN


def line(start: Box, end: Box) -> str:
    """The way from one box to another to its right, or beside those of one column."""
    if start.left > end.left:
        start, end = end, start
    x1, y1 = start.left + start.width, start.top + BOX / 2
    x2, y2 = end.left, end.top + BOX / 2
    if start.left == end.left:
        x2 = x1
    middle = max((x1 + x2) / 2, x1 + 20)
    return f"M{x1:.0f} {y1:.0f}C{middle:.0f} {y1:.0f} {middle:.0f} {y2:.0f} {x2:.0f} {y2:.0f}"


def drawn_node(node: Node, box: Box) -> str:
    """A box with its words."""
    hint = f"<title>{escape(node.title)}</title>" if node.title else ""
    return (
        f'<a href="{escape(node.address)}" data-node="{escape(node.key)}" class="{node.state}">'
        f'{hint}<rect x="{box.left:.0f}" y="{box.top:.0f}" width="{box.width:.0f}" height="{BOX}"'
        f' rx="5"/><text x="{box.left + 11:.0f}" y="{box.top + 16:.0f}">{escape(node.label)}'
        "</text></a>"
    )


def draw(nodes: Sequence[Node], edges: Iterable[tuple[str, str]], name: str) -> str:
    """The graph; edges whose ends are not both drawn are left out."""
    keys = {node.key for node in nodes}
    kept = [edge for edge in dict.fromkeys(edges) if set(edge) <= keys and edge[0] != edge[1]]
    columns = sorted_by_neighbours(columns_of(nodes), kept)
    boxes, width, height = lay_out(columns)
    lines = [
        f'<path d="{line(boxes[start], boxes[end])}" data-from="{escape(start)}"'
        f' data-to="{escape(end)}"/>'
        for start, end in kept
    ]
    body = "\n".join([*lines, *(drawn_node(n, boxes[n.key]) for column in columns for n in column)])
    return (
        f'<svg class="graph" role="group" aria-label="{escape(name)}" width="{width:.0f}"'
        f' height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}">\n{body}\n</svg>'
    )
