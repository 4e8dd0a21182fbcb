# SPDX-License-Identifier: Apache-2.0
"""The part `configuration`: the commit, the digest of every configuration item, the tools' bill."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from keel.base.files import sha256_of, write_json, write_text
from keel.base.git import git, is_clone
from keel.base.source import files_below
from keel.gather.part import Context, Item, Part, Table
from keel.release import dist

NO_TIME = "1970-01-01T00:00:00Z"  # Of an archive, which has no commit to ask.
TEXT = """\
The configuration items are all files of the commit, each with its SHA-256. The source's digest on
each page is over their names and contents, so it tells also whether a file was added or removed.

The bill of materials (CycloneDX) lists the tools that Keel's tools/toolchain.lock.json admits. Keel
itself contains no code of others, so none of them is flown."""


def names(root: Path) -> list[str]:
    """All files of the commit, or of the archive."""
    if is_clone(root):
        listed = git(root, "ls-files", "-z").split("\0")
        return sorted(name for name in listed if name)
    return [path.relative_to(root).as_posix() for path in files_below(root)]


def items_of(root: Path) -> Iterator[Item]:
    """Every configuration item; one that was deleted and not committed has no digest."""
    for name in names(root):
        path = root / name
        digest = sha256_of(path) if path.is_file() else "is missing here"
        yield Item(kind="file", id=name, title="", facts={"SHA-256": digest})


def folders(items: tuple[Item, ...]) -> Table:
    """How many items each folder has."""
    counted = Counter(item.id.split("/")[0] if "/" in item.id else "." for item in items)
    rows = tuple((name, str(number)) for name, number in sorted(counted.items()))
    return Table(title="Configuration items", columns=("folder", "files"), rows=rows)


def bill(context: Context) -> dict[str, Path]:
    """The bill of materials; a project's tools are those of its Keel."""
    path = context.work / "tools.cdx.json"
    time = dist.time_of(context.root)[1] if context.stamp["commit"] else NO_TIME
    write_json(path, dist.bill(context.root, dist.version(context.root), time))
    return {path.name: path}


def make(context: Context) -> Part:
    """What the package was made of."""
    items = tuple(items_of(context.root))
    sums = context.work / "items.sha256"
    write_text(sums, "".join(f"{item.facts['SHA-256']}  {item.id}\n" for item in items))
    files, summary = {sums.name: sums}, {}
    if (context.root / dist.LOCK).is_file():
        summary = {"version": dist.version(context.root)}
        files |= bill(context)
    summary |= {
        "commit": context.stamp["commit"] or "none, from an archive",
        "source, SHA-256": context.stamp["tree"],
        "product, SHA-256": context.stamp["product"],
        "configuration items": str(len(items)),
    }
    return Part(
        name="configuration",
        title="Configuration",
        text=TEXT,
        items=items,
        summary=summary,
        tables=(folders(items),),
        files=files,
    )
