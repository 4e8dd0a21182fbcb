# SPDX-License-Identifier: Apache-2.0
"""Builds what fuzz targets compare decoders with: of Rust, and of MAVLink's own generator.

A target that includes oracles.h has one: of tests/fuzz/oracle_NAME.c, if there is such a file, or
of Rust. Nothing of it is in the repository. Crates are those of tests/oracles/Cargo.lock.in, which
pins each by its checksum, and cargo fetches them as it is configured here; the generator is
pymavlink's.
"""

from __future__ import annotations

import re
import shutil
import sys
import threading
from pathlib import Path

from keel.base.build import Build, BuildError
from keel.base.errors import ROOT
from keel.base.files import read_text, write_text
from keel.base.run import output_of
from keel.install import Toolchain
from keel.test.sources import headers_of

FOLDER = "tests/fuzz"
HEADER = f"{FOLDER}/oracles.h"
CRATES = ROOT / "tests/oracles"
LOCK = "Cargo.lock"
OF_RUST, OF_C = "oracles", "mavlink"  # Groups of tools: the crates, and what makes C.
REGISTRY = re.compile(r'^source = "(.*)"$', re.MULTILINE)
PLACE = "@registry@"  # Where the pinned lock leaves out how cargo names the registry.
ONE_AT_A_TIME = threading.Lock()  # Suites run side by side, and build the crates in one folder.
GENERATE = """\
import sys
from pymavlink.generator import mavgen
import pymavlink, pathlib
definitions = pathlib.Path(pymavlink.__file__).with_name("dialects") / "v20" / "common.xml"
options = mavgen.Opts(sys.argv[1], wire_protocol="2.0", language="C", validate=False)
mavgen.mavgen(options, [str(definitions)])
"""


def pinned_lock(resolved: str, pinned: str) -> str:
    """The lock that is used: the pinned one, with cargo's own name of the registry."""
    found = REGISTRY.search(resolved)
    if not found:
        raise BuildError("cargo names no registry for the crates of tests/oracles")
    return pinned.replace(PLACE, found.group(1))


def crates(tools: Toolchain, folder: Path) -> Path:
    """A library of the crates' decoders."""
    work = folder / "crates"
    shutil.rmtree(work / "src", ignore_errors=True)
    shutil.copytree(CRATES, work, dirs_exist_ok=True)
    cargo = tools.command("cargo")
    manifest: list[str | Path] = ["--manifest-path", work / "Cargo.toml"]
    (work / LOCK).unlink(missing_ok=True)
    output_of([*cargo, "generate-lockfile", *manifest])
    write_text(work / LOCK, pinned_lock(read_text(work / LOCK), read_text(work / f"{LOCK}.in")))
    output_of([*cargo, "build", "--release", "--locked", *manifest])
    return work / "target/release/liboracles.a"


def mavlink(folder: Path) -> Path:
    """The folder of MAVLink's own C."""
    made = folder / "mavlink-c"
    if not (made / "common/mavlink.h").is_file():
        program = ["tools/keel", "with", "mavlink", "-c", GENERATE, str(made)]
        output_of([sys.executable, *program])
    return made


def source_of(target: str) -> str:
    """The file of a fuzz target."""
    return f"{FOLDER}/fuzz_{target}.c"


def targets(root: Path = ROOT) -> list[str]:
    """All fuzz targets."""
    return sorted(path.stem.removeprefix("fuzz_") for path in (root / FOLDER).glob("fuzz_*.c"))


def own_oracle(target: str, root: Path = ROOT) -> str:
    """The file that calls a target's oracle of C, if it has one."""
    name = f"{FOLDER}/oracle_{target}.c"
    return name if (root / name).is_file() else ""


def groups(target: str, root: Path = ROOT) -> tuple[str, ...]:
    """The groups of tools that a target's oracle needs; none without oracle."""
    if root / HEADER not in headers_of(root / source_of(target)):
        return ()
    return (OF_C,) if own_oracle(target, root) else (OF_RUST,)


def of(tools: Toolchain, build: Build, target: str) -> list[Path]:
    """What a fuzz target is linked with."""
    if not groups(target):
        return []
    if own := own_oracle(target):
        return [build.object(own, ["-isystem", mavlink(build.folder).relative_to(ROOT).as_posix()])]
    with ONE_AT_A_TIME:
        return [crates(tools, build.folder)]
