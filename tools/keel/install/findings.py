# SPDX-License-Identifier: Apache-2.0
"""What was found, remembered in the cache for as long as it is still true."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path

from keel.base.files import write_text
from keel.install.found import Found, path_outside
from keel.install.groups import TOOLS_DIR
from keel.install.lock import Lock, Spec
from keel.install.provers import MACHDEP_FILE, by_processor_time


class Findings:
    """The findings of one clone."""

    def __init__(self, folder: Path, lock: Lock) -> None:
        self.folder = folder
        self.lock = lock
        self._known: dict[str, Found] | None = None

    def forget(self) -> None:
        """Read them anew: another program may have added some."""
        self._known = None

    def get(self, spec: Spec) -> Found | None:
        """What is known of a tool, if it is still so."""
        finding = self._load().get(spec.name)
        if not finding or not finding.still_there(path_outside(self.folder)):
            return None
        if spec.kind == "why3-config" and finding.location != str(self.why3_place(spec)):
            return None
        return finding

    def add(self, finding: Found) -> None:
        """Remember one."""
        known = self._load()
        known[finding.tool] = finding
        text = json.dumps({name: asdict(value) for name, value in known.items()}, indent=1)
        write_text(self._file(), text)

    def why3_place(self, spec: Spec) -> Path | None:
        """Where the configuration for just these provers lies; None while one is missing.

        Clones that start them differently have one each.
        """
        chosen = by_processor_time("")
        for name in (*(prover.lower() for prover in spec.provers), "why3"):
            finding = self.get(self.lock.tools[name])
            if not finding:
                return None
            chosen += f"{finding.location} {finding.version} {finding.sha256}\n"
        digest = hashlib.sha256(chosen.encode()).hexdigest()
        return self.folder / "why3" / digest[:16] / "why3.conf"

    def environment(self) -> dict[str, str]:
        """The variables under which the tools see each other."""
        path = path_outside(self.folder)
        variables = {"PATH": os.pathsep.join([*self._path_prefix(), path])}
        for spec in self.lock.tools.values():
            finding = self.get(spec) if spec.kind == "why3-config" else None
            if finding:
                variables["WHY3CONFIG"] = finding.location
        return variables

    def _file(self) -> Path:
        """One file per clone and state of its lock and code, so that clones do not interfere."""
        state = hashlib.sha256()
        state.update(f"{self.lock.digest} {TOOLS_DIR} {sys.implementation.cache_tag}".encode())
        filters = [spec.filter for spec in self.lock.tools.values() if spec.filter]
        for path in [*sorted(Path(__file__).parent.glob("*.py")), MACHDEP_FILE, *filters]:
            state.update(path.read_bytes())
        return self.folder / "found" / f"{state.hexdigest()[:24]}.json"

    def _load(self) -> dict[str, Found]:
        if self._known is None:
            try:
                raw = json.loads(self._file().read_text())
                self._known = {name: Found(**value) for name, value in raw.items()}
            except (OSError, ValueError, TypeError):
                self._known = {}
        return self._known

    def _path_prefix(self) -> list[str]:
        """Folders before PATH: those of unpacked tools, and one for tools that PATH would hide."""
        unpacked: dict[str, None] = {}
        hidden: dict[str, str] = {}
        for spec in self.lock.tools.values():
            finding = self.get(spec)
            for name in spec.commands if finding else ():
                assert finding is not None
                if finding.origin == "cache":
                    unpacked[str(Path(finding.commands[name]).parent)] = None
                elif finding.commands[name] != finding.first_on_path[name]:
                    hidden[name] = finding.commands[name]
        return [*([str(self._links(hidden))] if hidden else []), *unpacked]

    def _links(self, commands: dict[str, str]) -> Path:
        """A folder of links to commands that another version, earlier on PATH, would hide."""
        name = hashlib.sha256(json.dumps(commands, sort_keys=True).encode()).hexdigest()[:16]
        place = self.folder / "links" / name
        if not place.is_dir():
            place.parent.mkdir(parents=True, exist_ok=True)
            work = Path(tempfile.mkdtemp(dir=place.parent))
            for command, target in commands.items():
                (work / command).symlink_to(target)
            work.chmod(0o755)
            with contextlib.suppress(OSError):  # another process was faster
                work.rename(place)
        return place
