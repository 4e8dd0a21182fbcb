# SPDX-License-Identifier: Apache-2.0
"""Look for undefined behaviour in the demo, and for writes that contracts do not name.

    python3 tools/keel eva            # what has not changed since it was good is known
    python3 tools/keel eva --fresh    # nothing is

Frama-C's abstract interpretation is another method than that of the proofs: it needs no contracts,
and follows the demo of examples/urpilot from its start, with the data model of the target. Two
questions are asked of it:

    alarms   places of the demo or the kernel at which it cannot exclude undefined behaviour: there
             is none, or it has an entry in specs/eva.toml with the reason
    assigns  whether what a public function writes, as From finds it in the code, is named in its
             contract. The function is called in a context of its own, whose objects hold anything,
             and by the demo; the run that reaches more of it counts. Where a clause names an
             element by an index that is not known there, only the array is compared; where that
             does not help, the demo's run counts.

Unsigned overflow is no undefined behaviour, and is left to the proofs. build/eva/report.json has
the alarms, how much of each function was reached, and the verdict on each contract.

Exit status: 0 when nothing is left to explain, 1 when something is, 2 when nothing could be tried.
"""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from keel.analyse.analysis import ANY_CONTEXT, PRECISION, Analysis, Eva
from keel.analyse.reduced import public_functions, write_tree
from keel.base.arguments import Parser
from keel.base.errors import ROOT, program
from keel.base.files import sha256_of
from keel.base.source import digest_of_tree, write_report
from keel.base.verdict_cache import Cache, digest
from keel.config import Table, Text, read_toml
from keel.install import Toolchain

REPORT = "build/eva/report.json"
KNOWN = "interpreted"  # In the user's cache, for all clones.
SETTINGS = "specs/eva.toml"
DEMO = "examples/urpilot"
ENTRY = "keel_eva_entry"
ENTRY_FILE = "tools/keel/analyse/demo_entry.c"
JUDGES = ("frama-c", "arm-none-eabi-gcc", "machdep")
ALONE, IN_DEMO = "alone", "in the demo"
EXACT, ARRAY, UNKNOWN = "within", "within, as far as arrays", "not known to be within"


class Alarm(Table):
    """An alarm that may be."""

    file: Text
    function: Text
    text: Text
    reason: Text


class Writes(Table):
    """A function that may seem to write more than its contract names."""

    function: Text
    reason: Text


class Settings(Table):
    """What may be found."""

    alarm: list[Alarm] = []
    writes: list[Writes] = []


def c_files(folder: Path, below: str) -> list[str]:
    """The C files of a folder, from the tree's root."""
    return sorted(path.relative_to(folder).as_posix() for path in (folder / below).rglob("*.c"))


def analyse_demo(tools: Toolchain, root: Path, folder: Path) -> Analysis:
    """The demo from its start."""
    write_tree(root, ("include", "src", DEMO), folder)
    shutil.copyfile(root / ENTRY_FILE, folder / "demo_entry.c")
    files = ["demo_entry.c", *c_files(folder, DEMO), *c_files(folder, "src/rtos")]
    return Eva(tools, folder).analyse(files, ["include", DEMO], [ENTRY])[ENTRY]


def analyse_functions(
    tools: Toolchain, root: Path, folder: Path, names: Sequence[str], wide: bool
) -> dict[str, Analysis]:
    """Each function in a context whose objects hold anything."""
    write_tree(root, ("include", "src"), folder, wide)
    return Eva(tools, folder).analyse(c_files(folder, "src"), ["include"], names, ANY_CONTEXT)


def judged(name: str, alone: Analysis, demo: Analysis) -> dict[str, Any]:
    """What is known of a function's writes, from the run that reaches more of it."""
    runs = [(ALONE, alone), (IN_DEMO, demo)]
    where, best = max(runs, key=lambda one: one[1].share(name) if one[1].assigns(name) else -1.0)
    verdict = EXACT if best.assigns(name) == "Valid" else UNKNOWN
    return {
        "function": name,
        "run": where,
        "reached": round(best.share(name), 3),
        "verdict": verdict,
    }


def compare_writes(
    tools: Toolchain, root: Path, scratch: Path, demo: Analysis
) -> list[dict[str, Any]]:
    """The verdict on each public function."""
    headers = public_functions(root)
    names = [name for name in headers if not name.startswith("keel_any_")]
    alone = analyse_functions(tools, root, scratch / "exact", names, wide=False)
    found = [judged(name, alone[name], demo) for name in names]
    unknown = [one for one in found if one["verdict"] == UNKNOWN and one["run"] == ALONE]
    if unknown:
        again = [one["function"] for one in unknown]
        wide = analyse_functions(tools, root, scratch / "wide", again, wide=True)
        for one in unknown:
            name = one["function"]
            if wide[name].assigns(name) == "Valid":
                one["verdict"] = ARRAY
            elif demo.assigns(name) == "Valid":
                one |= judged(name, demo, demo) | {"run": IN_DEMO}
    return [{**one, "header": headers[one["function"]]} for one in found]


def analyse(tools: Toolchain, root: Path) -> dict[str, Any]:
    """Both questions; what is found, without an opinion."""
    scratch = Path(tempfile.mkdtemp(prefix="keel-eva-"))
    try:
        demo = analyse_demo(tools, root, scratch / "demo")
        writes = compare_writes(tools, root, scratch, demo)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    return {
        "alarms": [asdict(one) for one in demo.alarms],
        "warnings": list(demo.warnings),
        "analyzed": demo.analyzed,
        "functions": demo.functions,
        "reach": {name: [one.reached, one.of] for name, one in sorted(demo.reach.items())},
        "assigns": writes,
    }


def judge(found: Mapping[str, Any], settings: Settings) -> Iterator[str]:
    """What is left to explain, and explanations of nothing."""
    used: set[int] = set()
    for one in found["alarms"]:
        known = [
            number
            for number, entry in enumerate(settings.alarm)
            if (entry.file, entry.function, entry.text)
            == (one["file"], one["function"], one["text"])
        ]
        used.update(known)
        if not known:
            yield f"{one['file']}:{one['line']}: {one['function']}: {one['kind']}: {one['text']}"
    yield from (f"the demo: {text}" for text in found["warnings"])
    for number, entry in enumerate(settings.alarm):
        if number not in used:
            yield f"{SETTINGS}: alarm in {entry.function}: there is none ({entry.text})"
    allowed = {entry.function for entry in settings.writes}
    unknown = {one["function"] for one in found["assigns"] if one["verdict"] == UNKNOWN}
    for name in sorted(unknown - allowed):
        yield f"{name}: may write what its contract does not name"
    for name in sorted(allowed - unknown):
        yield f"{SETTINGS}: writes of {name}: there is nothing to explain"


def key_of(tools: Toolchain, root: Path) -> str:
    """All that the findings depend on."""
    found = tools.versions("prove")
    own = Path(__file__).resolve().parents[1]
    return digest(
        {
            "tools": {name: [found[name].version, found[name].sha256] for name in JUDGES},
            "driver": digest_of_tree(own, ("base", "analyse", "install/machdep")),
            "own": [sha256_of(own / "config.py"), sha256_of(own / "install/provers.py")],
            "source": digest_of_tree(root, ("include", "src", DEMO)),
            "precision": PRECISION,
        }
    )


def conclude(root: Path, tools: Toolchain, found: Mapping[str, Any]) -> int:
    """Judge, write, tell; the exit status."""
    settings = read_toml(root / SETTINGS, Settings)
    problems = list(judge(found, settings))
    versions = tools.versions("prove")
    write_report(
        root / REPORT,
        {
            "problems": problems,
            **found,
            "explained": settings.model_dump(),
            "precision": PRECISION,
            "tools": {name: versions[name].version for name in JUDGES},
        },
        root,
        good=not problems,
    )
    for problem in problems:
        print(f"FAILED {problem}")
    within = sum(one["verdict"] != UNKNOWN for one in found["assigns"])
    print(
        f"eva: {len(found['alarms'])} alarms in {found['analyzed']} functions; "
        f"{within} of {len(found['assigns'])} contracts name all that is written; "
        f"{len(problems)} problems"
    )
    return 1 if problems else 0


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = Parser("Look for undefined behaviour, and for writes without a contract.", "eva")
    parser.add_argument("--fresh", action="store_true", help="analyse also what is known")
    options = parser.parse_args(arguments)

    def work() -> int:
        (root / REPORT).unlink(missing_ok=True)
        read_toml(root / SETTINGS, Settings)
        tools = Toolchain()
        tools.ensure("prove")
        cache = Cache(tools.cache.folder / KNOWN, options.fresh)
        key = key_of(tools, root)
        found = cache.get(key)
        if found is None:
            begun = time.monotonic()
            print("eva: the demo, then each public function: some minutes ...", flush=True)
            found = analyse(tools, root)
            found["seconds"] = round(time.monotonic() - begun, 1)
            cache.put(key, found)
            cache.prune()
        return conclude(root, tools, found)

    return program("eva", work)
