# SPDX-License-Identifier: Apache-2.0
"""Debian packages: from the host's own suite, and from others."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from keel.install.found import answer
from keel.install.lock import LOCK_FILE, ToolchainError
from keel.install.mirror import debian_mirrors

DEBIAN_KEYRING = Path("/usr/share/keyrings/debian-archive-keyring.gpg")


class Log:
    """The output of package tools: kept in a file, shown in an error only by its last lines.

    They run in our session: sudo knows it, and Ctrl-C reaches them as a request, not as a kill.
    """

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
                    list(command),
                    cwd=cwd,
                    stdin=subprocess.DEVNULL,
                    stdout=stream,
                    stderr=stream,
                    env={**os.environ, "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C.UTF-8"},
                    check=False,
                ).returncode
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
        allowed = shutil.which("sudo") and self.log.run(["sudo", "-n", "true"]) == 0
        return ["sudo", "-n", "env", "DEBIAN_FRONTEND=noninteractive"] if allowed else []

    def _update(self) -> None:
        options = ["-o", "DPkg::Lock::Timeout=600"]
        if self.log.run([*self._as_root(), "apt-get", "update", *options]) != 0:
            raise ToolchainError(f"apt-get update failed:{self.log.tail()}")

    def _unknown(self, packages: Sequence[str]) -> list[str]:
        """The packages for which the present lists offer nothing."""
        text = answer(["env", "LC_ALL=C", "apt-cache", "policy", *packages])
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
        """Write the private configuration and read the suite's package lists.

        Debian moves a suite to its archive some time after the end of its support: of several
        mirrors the first that has the suite is taken.
        """
        if not shutil.which("apt-get"):
            raise ToolchainError(f"this system has no apt-get to fetch from Debian {self.name}")
        for part in ("lists/partial", "cache/archives/partial"):
            (self.folder / part).mkdir(parents=True, exist_ok=True)
        (self.folder / "status").touch()
        refusals = []
        for mirror in debian_mirrors():
            if not (refusal := self._read(mirror)):
                return
            refusals.append(refusal)
        raise ToolchainError(
            "\n".join(refusals) + "\n    KEEL_DEBIAN_MIRROR may name several mirrors, also Debian's"
            " archive, to which old suites move"
        )

    def _read(self, mirror: str) -> str:
        """Read the suite's lists from a mirror; why that cannot be done, or nothing."""
        index = "Sources" if self.kind == "deb-src" else "Packages"
        options = f"[signed-by={DEBIAN_KEYRING} target={index}]"
        line = f"{self.kind} {options} {mirror} {self.name} main"
        (self.folder / "sources.list").write_text(line + "\n")
        status = self.log.run(["apt-get", *self._options(), "update"])
        # apt calls it a success when no server answered at all: look for what it should have read.
        if status == 0 and any((self.folder / "lists").glob(f"*_{index}*")):
            return ""
        return f"cannot read Debian {self.name} ({line}):{self.log.tail()}"

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
        return answer(["apt-cache", *self._options(), *words])

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
