# SPDX-License-Identifier: Apache-2.0
"""The tools that the evidence rests on: which they are, to the byte, what each is trusted with,
what is known to be wrong with them, and that each still detects what it must.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from datetime import date
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

from keel.base.errors import ROOT
from keel.config import Field, Mistake, Table, Text, read_toml
from keel.gather.part import Context, Item, Part, State
from keel.gather.part import Table as Shown
from keel.install import Found, Toolchain
from keel.install.lock import Lock, Spec
from keel.prove.verdict_keys import ASKERS, judges

SETTINGS = "specs/tools.toml"
QUALIFY = "qualify/report.json"
# What the evidence is made with; what installs tools or only starts them is not among them.
GROUPS = ("prove", "lint", "test", "coverage", "bench", "firmware", "stack", "target", "model")
HELPERS = ("pip", "why3-config")
# Reports that tell with which versions they were made, and of which tools by the lock's names.
VERSIONED = (
    "prove/report.json",
    "lint/report.json",
    "eva/report.json",
    "firmware/mps2_an500/report.json",
    "test-target/report.json",
)
TQL = {1: "TQL-1", 2: "TQL-4", 3: "TQL-5", 0: "none"}  # DO-178C, table 12-1, level A.
CONFIDENCE = {("TI2", "TD2"): "TCL2", ("TI2", "TD3"): "TCL3"}  # ISO 26262-8, table 3; else TCL1.

TEXT = """\
The task of each tool stands in specs/tools.toml, with what would notice an error of it. \
The classification by DO-330 (for software of level A), ISO 26262 and IEC 61508 is a proposal: \
whether a tool needs qualification, and what suffices for it, the applicant agrees on with the \
authority. No tool here comes with a vendor's qualification kit.

Seeded faults show that a tool, in the version and the file that is used, detects what it is \
trusted to detect, and does not refuse the same without the fault. They are samples of its \
operational use, no proof of it.

Two engines with nothing in common but the source and its preprocessor judge each function of the \
kernel: WP with its provers, and CBMC. That is why most detection is TD2 and not TD3.

Known problems were reviewed as far as each tool's page says. "Read" means that the vendor's list \
or release notes were read; "searched", that single problems were found by a search, and no whole \
list was read; "compared", that a later release gave the same verdicts on all that the project \
asks of the tool; "open", that nothing was found. None of them means that there is no other \
problem."""

Known = Literal["read", "searched", "compared", "open", "not needed"]


class Tool(Table):
    """A tool, and what it is trusted with."""

    name: Text
    use: Text
    criterion: Annotated[int, Field(ge=0, le=3)]
    kind: Literal["T1", "T2", "T3"] = Field(alias="class")
    impact: Literal["TI1", "TI2"]
    detection: Literal["TD1", "TD2", "TD3"]
    instead: Text
    tests: list[Text]
    known: Known
    on: date | None = None
    sources: list[Text] = []
    reviewed: Text
    left: str = ""

    @property
    def confidence(self) -> str:
        """The tool confidence level."""
        return CONFIDENCE.get((self.impact, self.detection), "TCL1")


class Problem(Table):
    """A known problem."""

    tool: Text
    source: Text
    what: Text
    here: Text


class Settings(Table):
    """The file."""

    tool: list[Tool]
    problem: list[Problem] = []


def read_settings(root: Path) -> Settings:
    """The file of tools, checked."""
    return read_toml(root / SETTINGS, Settings, slips)


def slips(settings: Settings) -> Iterator[Mistake]:
    """What types cannot say."""
    names = [one.name for one in settings.tool]
    for number, name in enumerate(names):
        if name in names[:number]:
            yield ("tool", number, "name"), "is declared twice"
    for number, tool in enumerate(settings.tool):
        yield from ((("tool", number, "known"), reason) for reason in review_slips(tool))
    for number, one in enumerate(settings.problem):
        if one.tool not in names:
            yield ("problem", number, "tool"), f"there is no tool {one.tool}"


def review_slips(tool: Tool) -> Iterator[str]:
    """What a review must tell, so that nobody takes it for more than it was."""
    if tool.known == "not needed":
        return
    if tool.on is None:
        yield f"{tool.known}, but on does not say when"
    if tool.known != "open" and not tool.sources:
        yield f"{tool.known}, but no source is named"
    if not tool.left:
        yield f"{tool.known}, but left does not say what was not read"


Report = Mapping[str, Any]


def wanted(lock: Lock) -> dict[str, Spec]:
    """The tools that the evidence is made with."""
    return {spec.name: spec for spec in lock.of_groups(GROUPS) if spec.name not in HELPERS}


def entry_problems(settings: Settings, specs: Mapping[str, Spec], root: Path) -> Iterator[str]:
    """Tools without an entry, entries without a tool, and tests that are not there."""
    names = {one.name for one in settings.tool}
    yield from (f"{SETTINGS}: tool {name} has no entry" for name in sorted(specs.keys() - names))
    yield from (
        f"{SETTINGS}: tool {name} is not in tools/toolchain.lock.json"
        for name in sorted(names - specs.keys())
    )
    for one in settings.tool:
        for test in one.tests:
            file, _, name = test.partition("/")
            path = root / "tests/tools" / f"{file}.py"
            if not path.is_file() or f"def {name}(" not in path.read_text(encoding="utf-8"):
                yield f"{SETTINGS}: tool {one.name}: there is no test {test}"


def version_of(told: Any) -> str:
    """A version as reports tell it: a text, or a table with one."""
    return str(told.get("version", "")) if isinstance(told, dict) else str(told)


def identity_problems(specs: Mapping[str, Spec], found: Mapping[str, Found]) -> Iterator[str]:
    """Tools that are missing here, of a version that may not be used, or of another file."""
    for name, spec in specs.items():
        if name not in found:
            yield f"{name}: is missing on this machine"
        elif spec.at_least and not spec.admits(found[name].version):
            yield f"{name}: is {found[name].version}, locked is {spec.wanted}"
        elif spec.sha256 and spec.sha256 not in fetched(found[name]):
            yield f"{name}: what was fetched is not what is pinned ({spec.sha256[:12]})"


def fetched(found: Found) -> list[str]:
    """The hashes of the packages that a tool was unpacked from."""
    return [part["sha256"] for part in found.parts if "sha256" in part]


def report_problems(
    name: str, report: Report, specs: Mapping[str, Spec], found: Mapping[str, Found]
) -> Iterator[str]:
    """Whether a report was made with the locked tools, and with those that are here."""
    for tool, told in report.get("tools", {}).items():
        if tool not in specs:
            continue
        version = version_of(told)
        if specs[tool].at_least and not specs[tool].admits(version):
            yield f"build/{name}: was made with {tool} {version}, locked is {specs[tool].wanted}"
        elif tool in found and version != found[tool].version:
            yield f"build/{name}: was made with {tool} {version}, here is {found[tool].version}"
        elif isinstance(told, dict) and tool in found and told["sha256"] != found[tool].sha256:
            yield f"build/{name}: was made with another file of {tool} than the one that is here"


def trial_problems(settings: Settings, report: Report) -> Iterator[str]:
    """Faults that are not detected, and tools that verify and are not tested."""
    yield from report["problems"]
    tried = {run["tool"] for run in report["runs"]}
    for one in settings.tool:
        shown = one.name in tried or one.tests or one.detection == "TD1"
        if one.criterion == 2 and not shown:
            yield f"{one.name}: nothing shows that it detects what it is trusted to detect"


def tool_item(one: Tool, settings: Settings, found: Mapping[str, Found], report: Report) -> Item:
    """A tool."""
    seen = found.get(one.name)
    runs = [run for run in report.get("runs", ()) if run["tool"] == one.name]
    known = [problem for problem in settings.problem if problem.tool == one.name]
    text = "\n\n".join(
        [
            one.use,
            f"Checks that notice an error of it: {one.instead}.",
            *(f"{problem.what}. Here: {problem.here}." for problem in known),
        ]
    )
    facts = {
        "version": seen.version if seen else "missing",
        "SHA-256 of the program": seen.sha256 if seen else "",
        "packages": "; ".join(
            " ".join(filter(None, (part["name"], part["version"], part.get("sha256", ""))))
            for part in seen.parts
        )
        if seen
        else "",
        "DO-330": f"criterion {one.criterion}, {TQL[one.criterion]}" if one.criterion else "none",
        "ISO 26262": f"{one.impact}, {one.detection}: {one.confidence}",
        "IEC 61508": one.kind,
        "seeded faults detected": f"{sum(not run['wrong'] for run in runs)} of {len(runs)}",
        "tests of its use": ", ".join(one.tests),
        "known problems": one.known + (f", {one.on}" if one.on else ""),
        "what was reviewed": one.reviewed,
        "where": ", ".join(one.sources),
        "what was not": one.left,
    }
    bad = any(run["wrong"] for run in runs) or not seen
    state: State = "bad" if bad else "good" if runs else "told"
    return Item(
        kind="tool",
        id=one.name,
        title=one.name,
        text=text,
        state=state,
        facts={key: value for key, value in facts.items() if value},
    )


def lines_of(path: Path) -> int:
    """The lines of a module."""
    return len(path.read_text(encoding="utf-8").splitlines())


def tables(
    settings: Settings, specs: Mapping[str, Spec], found: Mapping[str, Found], report: Report
) -> Iterator[Shown]:
    """The tools, the faults, the known problems."""
    yield Shown(
        title="Tools",
        columns=("tool", "version", "locked", "from", "SHA-256 of the program"),
        rows=tuple(
            (
                f"tool:{name}",
                found[name].version if name in found else "missing",
                spec.wanted,
                spec.source,
                found[name].sha256 if name in found else "",
            )
            for name, spec in specs.items()
            if any(one.name == name for one in settings.tool)
        ),
        note="A tool of the host's packages is known by the version and the hash of its "
        "program; its libraries follow the host's suite.",
    )
    yield Shown(
        title="What would need qualification",
        columns=("tool", "DO-330 criterion", "level A", "ISO 26262", "IEC 61508", "what notices"),
        rows=tuple(
            (
                f"tool:{one.name}",
                str(one.criterion or "none"),
                TQL[one.criterion],
                one.confidence,
                one.kind,
                one.instead,
            )
            for one in settings.tool
        ),
    )
    yield Shown(
        title="The judge of the proofs",
        columns=("engine", "module", "lines"),
        rows=tuple(
            (engine, path.resolve().relative_to(ROOT).as_posix(), str(lines_of(path)))
            for engine in ASKERS
            for path in judges(engine)
        ),
        note="A kept verdict rests on these modules of Keel's own and on no other: they are what "
        "would need qualification. `make lint` holds what they import.",
    )
    yield Shown(
        title="Seeded faults",
        columns=("tool", "fault", "asked as", "version", "verdict"),
        rows=tuple(
            (
                f"tool:{run['tool']}",
                run["fault"],
                run["how"],
                run["version"],
                run["wrong"] or "detected",
            )
            for run in report.get("runs", ())
        ),
        note="Further faults are seeded by the tests that each tool's page names, and by the wrong "
        "bodies and wrong bounds of the proofs.",
    )
    yield Shown(
        title="Reviews of known problems",
        columns=("tool", "known problems", "on", "where", "what was reviewed", "what was not"),
        rows=tuple(
            (
                f"tool:{one.name}",
                one.known,
                str(one.on or ""),
                ", ".join(one.sources),
                one.reviewed,
                one.left,
            )
            for one in settings.tool
        ),
    )
    yield Shown(
        title="Known problems",
        columns=("tool", "source", "problem", "what it means here"),
        rows=tuple(
            (f"tool:{one.tool}", one.source, one.what, one.here) for one in settings.problem
        ),
        note="Not complete: see what was reviewed, tool by tool. Open: "
        + ", ".join(one.name for one in settings.tool if one.known == "open"),
    )


def reviews(settings: Settings) -> str:
    """How many tools' known problems were reviewed how far."""
    counted = Counter[str](one.known for one in settings.tool)
    return ", ".join(f"{counted[how]} {how}" for how in get_args(Known))


def make(context: Context) -> Part:
    """The part."""
    problems: list[str] = []
    settings = read_settings(context.root)
    tools = Toolchain()
    specs, found = wanted(tools.lock), tools.versions(*GROUPS)
    problems += entry_problems(settings, specs, context.root)
    problems += identity_problems(specs, found)
    report = context.report(QUALIFY, problems)
    if report:
        problems += trial_problems(settings, report)
    for name in VERSIONED:
        made = context.report(name, problems)
        problems += report_problems(name, made, specs, found)
    runs = report.get("runs", ())
    return Part(
        name="tools",
        title="Tools",
        summary={
            "tools": str(len(settings.tool)),
            "seeded faults detected": f"{sum(not run['wrong'] for run in runs)} of {len(runs)}",
            "known problems that were looked at": str(len(settings.problem)),
            "tools by review of their known problems": reviews(settings),
        },
        text=TEXT,
        tables=tuple(tables(settings, specs, found, report)),
        items=tuple(tool_item(one, settings, found, report) for one in settings.tool),
        files={"toolchain.lock.json": context.root / "tools/toolchain.lock.json"},
        problems=tuple(dict.fromkeys(problems)),
    )
