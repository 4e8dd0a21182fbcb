# SPDX-License-Identifier: Apache-2.0
"""The tools of the project on this host: found, or installed."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterable
from pathlib import Path

from keel.base.files import write_text
from keel.install import provers, python_packages
from keel.install.apt import HostApt, Suite
from keel.install.cache import Cache, Say, default_cache
from keel.install.findings import Findings
from keel.install.found import Finder, Found, answer, found
from keel.install.lock import Lock, Spec, ToolchainError
from keel.install.unpack import Tree, unpack_crate, unpack_deb, unpack_source


def tell(line: str) -> None:
    """Print a line of progress at once: also a log that nobody watches shows where it hangs."""
    print(line, flush=True)


class Toolchain:
    """Finds tools, and installs those that are missing.

    tools = Toolchain()
    tools.ensure("prove")
    run([*tools.command("cbmc"), ...], environment=tools.environment())
    """

    def __init__(self, cache: Path | None = None, lock: Lock | None = None) -> None:
        self.lock = lock or Lock.read()
        self.cache = Cache(cache or default_cache())
        self._findings = Findings(self.cache.folder, self.lock)

    # What a driver asks for.

    def ensure(self, *groups: str, say: Say = tell) -> None:
        """Make every tool of the groups available (of all groups if none is named).

        Does next to nothing the second time.
        """
        specs = self.lock.of_groups(groups or self.lock.groups)
        if re.search(r"[\s:]", str(self.cache.folder)):
            # why3 does not quote a prover's path, and PATH cannot hold a colon.
            raise ToolchainError(f"no white space or colon in KEEL_CACHE: {self.cache.folder}")
        if all(self._findings.get(spec) for spec in specs):
            return
        with self.cache.locked(say):
            self._findings.forget()
            self._ensure_locked([spec for spec in specs if not self._findings.get(spec)], say)

    def command(self, tool: str) -> list[str]:
        """How to start a tool (or, for a library of sources, the folder it lies in)."""
        finding = self._require(self.lock.providing(tool))
        return [finding.commands.get(tool, finding.location)]

    def versions(self, *groups: str) -> dict[str, Found]:
        """What was found for the groups (all groups if none is named); absent tools are absent."""
        specs = self.lock.of_groups(groups or self.lock.groups)
        finder = self._finder()
        seen = {spec.name: self._findings.get(spec) or self._look(spec, finder) for spec in specs}
        return {name: finding for name, finding in seen.items() if finding}

    def environment(self) -> dict[str, str]:
        """The variables under which the tools see each other; merge them into os.environ."""
        return self._findings.environment()

    def frama_c(self, libc_specifications: bool = False) -> list[str]:
        """frama-c for the target."""
        return provers.frama_c(self.command, answer, libc_specifications)

    def goto_cc(self) -> list[str]:
        """goto-cc for the target."""
        return provers.goto_cc(self.command)

    def header_folders(self) -> list[Path]:
        """Where the target's compiler has its own headers."""
        return provers.header_folders(self.command, answer)

    # Looking.

    def _finder(self) -> Finder:
        return Finder(self.cache.folder)

    def _require(self, spec: Spec) -> Found:
        finder = self._finder()
        finding = self._findings.get(spec) or self._look(spec, finder)
        if not finding:
            groups = [name for name, tools in self.lock.groups.items() if spec.name in tools]
            raise ToolchainError(
                f"{spec.name} is missing; run: tools/keel tools ensure {groups[0]}\n"
                f"{missing_line(spec, finder)}"
            )
        return finding

    def _look(self, spec: Spec, finder: Finder) -> Found | None:
        """The tool if it is there, without installing anything."""
        if spec.derived:
            return None
        # A suitable tool of the user's own goes first; a library of sources that we unpack, and a
        # program that is only right behind a filter, are not looked for elsewhere.
        own = not spec.before and (spec.commands or not spec.cached)
        if own and (finding := finder.system(spec)):
            return finding
        return self.cache.find(spec, finder) if spec.cached else None

    # Installing.

    def _ensure_locked(self, specs: list[Spec], say: Say) -> None:
        finder = self._finder()
        missing = [spec for spec in specs if not self._accept(self._look(spec, finder), say)]
        absent = [spec for spec in missing if not spec.derived]
        if absent:
            self._refuse_unless_installable(absent, finder)
            self._install_system([spec for spec in absent if not spec.cached], say)
            for spec in absent:
                if spec.cached:
                    unpacked = self.cache.unpack(spec, self._fill, self._finder())
                    self._accept(unpacked, say, "unpacked")
        for spec in missing:
            if spec.derived:
                self._accept(self._derive(spec), say, "made")

    def _accept(self, finding: Found | None, say: Say, how: str = "found") -> bool:
        """Record and announce a finding."""
        if finding:
            self._findings.add(finding)
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
            raise refusal(f"missing; {reason}", absent, finder)

    def _install_system(self, specs: list[Spec], say: Say) -> None:
        if not specs:
            return
        packages = list(dict.fromkeys(name for spec in specs for name in spec.packages))
        say(f"installing {' '.join(packages)} …")
        HostApt(self.cache.log).install(packages)
        finder = self._finder()
        failed = [
            spec for spec in specs if not self._accept(self._look(spec, finder), say, "installed")
        ]
        if failed:
            raise refusal("installed, but still not suitable", failed, finder)

    def _fill(self, tree: Tree) -> None:
        """Fetch and unpack a tool that lies in the cache."""
        spec = tree.spec
        if spec.kind in ("packages", "wheel"):
            python_packages.install(tree, self.command("pip"))
        elif spec.kind == "crate":
            unpack_crate(tree, self.command("cargo"))
        else:
            kind = "deb-src" if spec.kind == "source" else "deb"
            suite = Suite(spec.suite, kind, tree.scratch / "apt", self.cache.log)
            (unpack_source if spec.kind == "source" else unpack_deb)(tree, suite)

    # What is made of the others.

    def _derive(self, spec: Spec) -> Found:
        return self._why3_config(spec) if spec.kind == "why3-config" else self._machdep(spec)

    def _why3_config(self, spec: Spec) -> Found:
        """A private why3 configuration that knows the provers chosen here.

        why3, and the why3 library inside Frama-C's WP, read the file that WHY3CONFIG names; the
        user's own ~/.why3.conf stays as it is. A file that says the same already stays, too:
        another clone may be about to use it, to which a new one would be a changed tool.
        """
        place = self._findings.why3_place(spec)
        if not place:
            raise ToolchainError(f"the why3 configuration needs all of {', '.join(spec.provers)}")
        place.parent.mkdir(parents=True, exist_ok=True)
        fresh = place.with_name(f"fresh-{os.getpid()}.conf")
        variables = {**self.environment(), "WHY3CONFIG": str(fresh)}
        output = answer([*self.command("why3"), "config", "detect"], variables)
        known = provers.provers_known(fresh.read_text() if fresh.is_file() else "")
        unknown = [prover for prover in spec.provers if prover not in known]
        if unknown:
            fresh.unlink(missing_ok=True)
            raise ToolchainError(f"why3 does not see {', '.join(unknown)}:\n{output.strip()}")
        self._limit_by_processor_time(fresh, place.parent)
        if place.is_file() and place.read_bytes() == fresh.read_bytes():
            fresh.unlink()
        else:
            os.replace(fresh, place)
        summary = ", ".join(f"{prover} {known[prover]}" for prover in spec.provers)
        return found(spec, f"({summary})", "made", place)

    @staticmethod
    def _limit_by_processor_time(configuration: Path, folder: Path) -> None:
        """Have each prover of a configuration started by a script, in a folder."""

        def started(match: re.Match[str]) -> str:
            script = folder / f"{Path(match['program']).name}-by-processor-time"
            write_text(script, provers.by_processor_time(match["program"]))
            script.chmod(0o755)
            return f'path = "{script}"'

        text = re.sub(
            r'^path = "(?P<program>.+)"$', started, configuration.read_text(), flags=re.MULTILINE
        )
        write_text(configuration, text)

    def _machdep(self, spec: Spec) -> Found:
        """Load the machdep once: it needs OCaml and the libraries that Frama-C was built with."""
        output = answer([*self.frama_c(), "-print-machdep"])
        if "Cortex-M7" not in output:
            raise ToolchainError(
                f"frama-c does not load {provers.MACHDEP_FILE.name}:\n{output.strip()}"
            )
        return found(spec, provers.MACHDEP, "made", provers.MACHDEP_FILE)


def without_apt(specs: Iterable[Spec]) -> bool:
    """Whether pip and cargo can bring them, without Debian's package manager."""
    return all(spec.kind in ("wheel", "packages", "crate") for spec in specs)


def refusal(reason: str, specs: list[Spec], finder: Finder) -> ToolchainError:
    """The error that names tools: all in its first line, then each with what is wanted of it."""
    names = ", ".join(spec.name for spec in specs)
    return ToolchainError(
        "\n".join([f"{names}: {reason}", *(missing_line(spec, finder) for spec in specs)])
    )


def missing_line(spec: Spec, finder: Finder) -> str:
    """One tool that is not there: which, which version is wanted, where it was looked for."""
    looked = "; ".join(finder.looked.get(spec.name, ["not in the cache"]))
    return f"  {spec.name}: wanted {spec.wanted} ({spec.source}); {looked}"
