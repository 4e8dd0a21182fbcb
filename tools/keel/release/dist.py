# SPDX-License-Identifier: Apache-2.0
"""Make a release: an archive of the commit, its bill of materials, and the checksums of both.

    python3 tools/keel dist              # build/dist/keel-<version>.tar.gz, .cdx.json, SHA256SUMS
    python3 tools/keel dist --dirty      # also of files that differ from the commit

The same commit gives the same bytes: names are sorted, owners are nobody, all times are the
commit's. The archive holds what git tracks; nothing in it asks for git. The bill of materials
(CycloneDX 1.6) lists the tools that toolchain.lock.json admits: Keel itself contains no code of
others.

Exit status: 0 when all is written, 1 when it is not (the reason in one line), 2 for a wrong command
line.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import io
import json
import os
import re
import sys
import tarfile
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.base.git import commit_of, git

ROOT = Path(__file__).resolve().parents[3]
LOCK = "tools/toolchain.lock.json"
VERSION = "include/keel/version.h"
PINNED = re.compile(r"^([\w.-]+)==(\S+?)(?: |$)", re.MULTILINE)
REGISTRIES = {"wheel": "pypi", "crate": "cargo"}


def require_commit(root: Path) -> None:
    """Refuse what has no commit, as an archive."""
    if not commit_of(root):
        raise ToolError(f"{root} is no clone of Keel with a commit")


def require_clean(root: Path) -> None:
    """Refuse files that are not as the commit has them."""
    changed = git(root, "status", "--porcelain", "-z").split("\0")[:-1]
    if changed:
        more = f" and {len(changed) - 1} more" if len(changed) > 1 else ""
        raise ToolError(f"{changed[0][3:]}{more} not committed: commit, or say --dirty")


def version(root: Path) -> str:
    """Keel's version, from its header."""
    try:
        text = (root / VERSION).read_text(encoding="utf-8")
    except OSError as error:
        raise ToolError(f"{VERSION}: {error.strerror}") from error
    numbers = []
    for part in ("MAJOR", "MINOR", "PATCH"):
        match = re.search(rf"^#define KEEL_VERSION_{part} (\d+)$", text, re.MULTILINE)
        if not match:
            raise ToolError(f"{VERSION} does not define KEEL_VERSION_{part} as a number")
        numbers.append(match[1])
    return ".".join(numbers)


def archive(root: Path, folder: str, when: int) -> bytes:
    """All tracked files below one folder, as a compressed tar archive."""
    tar_bytes = io.BytesIO()
    with tarfile.open(fileobj=tar_bytes, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for name in sorted(git(root, "ls-files", "-z").split("\0")[:-1]):
            path = root / name
            if path.is_symlink() or not path.is_file():
                raise ToolError(f"{name}: tracked, but no plain file")
            data = path.read_bytes()
            entry = tarfile.TarInfo(f"{folder}/{name}")
            entry.size, entry.mtime = len(data), when
            entry.mode = 0o755 if os.access(path, os.X_OK) else 0o644
            tar.addfile(entry, io.BytesIO(data))
    return gzip.compress(tar_bytes.getvalue(), compresslevel=9, mtime=when)


def component(name: str, kind: str, version_: str, note: str) -> dict[str, Any]:
    """One tool of the bill: needed to build or prove, no part of what is flown."""
    found: dict[str, Any] = {"type": "application", "name": name, "scope": "excluded"}
    if version_:
        found["version"] = version_
    if kind in REGISTRIES:
        found["type"] = "library"
        found["purl"] = f"pkg:{REGISTRIES[kind]}/{name.lower()}@{version_}"
    found["bom-ref"] = f"{kind}:{name}@{version_ or 'any'}"
    found["properties"] = [{"name": "keel:toolchain", "value": note}]
    return found


def tools(root: Path) -> Iterator[dict[str, Any]]:
    """The tools of the lock file, and the Python packages that it pins by files of their own."""
    try:
        lock = json.loads((root / LOCK).read_text(encoding="utf-8"))["tools"]
    except (OSError, ValueError, KeyError) as error:
        raise ToolError(f"{LOCK}: cannot be read: {error}") from error
    for name, spec in sorted(lock.items()):
        file = spec.get("path") if spec["kind"] == "packages" else None
        if "requirements" in spec:
            file = f"tools/{spec['requirements']}"
        if file:
            for package, pin in PINNED.findall((root / file).read_text(encoding="utf-8")):
                yield component(package, "wheel", pin, f"{name}, pinned by {file}")
        elif "pin" in spec:
            named = spec.get("package", name)
            found = component(named, spec["kind"], spec["pin"], f"{name}, pinned by {LOCK}")
            found["hashes"] = [{"alg": "SHA-256", "content": spec["sha256"]}]
            yield found
        elif "at_least" in spec:
            note = f"any from {spec['at_least']}, before {spec['below']}"
            yield component(name, spec["kind"], "", note)


def bill(root: Path, number: str, time: str) -> dict[str, Any]:
    """The bill of materials; what is named twice is listed once."""
    listed = {item["bom-ref"]: item for item in tools(root)}
    keel = {
        "type": "firmware",
        "name": "keel",
        "version": number,
        "bom-ref": f"keel@{number}",
        "licenses": [{"license": {"id": "Apache-2.0"}}],
    }
    return {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"timestamp": time, "component": keel},
        "components": [listed[key] for key in sorted(listed)],
        "dependencies": [{"ref": keel["bom-ref"], "dependsOn": []}],
    }


def time_of(root: Path) -> tuple[int, str]:
    """When the commit was made, in seconds and as people write it."""
    seconds = int(git(root, "log", "-1", "--format=%ct"))
    return seconds, datetime.fromtimestamp(seconds, UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def release(root: Path, out: Path) -> list[Path]:
    """Write the files of a release, the checksums last."""
    number = version(root)
    seconds, time = time_of(root)
    name = f"keel-{number}"
    bom = json.dumps(bill(root, number, time), indent=1) + "\n"
    contents = {f"{name}.cdx.json": bom.encode(), f"{name}.tar.gz": archive(root, name, seconds)}
    sums = [f"{hashlib.sha256(data).hexdigest()}  {file}\n" for file, data in contents.items()]
    contents["SHA256SUMS"] = "".join(sums).encode()
    out.mkdir(parents=True, exist_ok=True)
    (out / "SHA256SUMS").unlink(missing_ok=True)
    for file, data in contents.items():
        draft = out / f".{file}"
        draft.write_bytes(data)
        draft.replace(out / file)
    return [out / file for file in contents]


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Make a release of the present commit.")
    parser.add_argument("--dirty", action="store_true", help="also with uncommitted changes")
    parser.add_argument("--out", type=Path, default=root / "build/dist", metavar="FOLDER")
    options = parser.parse_args(arguments)
    try:
        require_commit(root)
        if not options.dirty:
            require_clean(root)
        written = release(root, options.out)
    except (ToolError, OSError) as error:
        print(f"dist: {error}", file=sys.stderr)
        return 1
    for path in written:
        print(path)
    return 0
