# SPDX-License-Identifier: Apache-2.0
"""Would the proofs notice? Mutants, mistakes made on purpose, and what the harnesses reach."""

from __future__ import annotations

from keel.base.errors import ToolError
from keel.gather.formal import bounds
from keel.gather.part import Context, Part
from keel.gather.strength import blocks, mutants, wrong

TEXT = """\
A proof is worth something only if it would fail when the code were wrong. Two things show that.

Mutants are small changes of the code, made by rule: slips of the pen and of thought. One that no \
proof notices shows a contract or a model that is too weak, or makes no difference, for which a \
person has to give the reason. A run over all units takes hours, so its results are kept in the \
repository (specs/mutation.toml): how many mutants each engine killed, which harnesses did, and \
who survived, with digests of the sources, the proofs and the tools that they were had from. \
Where one of these has changed, the result is shown as stale and does not count. The killed \
mutants one by one are not part of the package; make mutate tries them again, and lists them in \
build/mutate.

Wrong bodies are mistakes that people make, put into the code as it is now by each make prove; the \
harness named with each must refute it, by the assertion named with it.

And for every basic block of what a harness covers CBMC has to find an execution that reaches it: \
assumptions that contradict each other would prove anything, and reach nothing."""


def make(context: Context) -> Part:
    """The part."""
    problems: list[str] = []
    report = context.report("prove/report.json", problems)
    standings = mutants.standings(context.root, report, problems) if report else []
    problems += mutants.problems(standings)
    mistakes: list[wrong.Mistake] = []
    harnesses: list[bounds.Bounded] = []
    reasons: list[blocks.Unreached] = []
    try:
        mistakes = wrong.read_mistakes(context.root, report)
        harnesses = bounds.read_all(context.root)
        reasons = blocks.read_reasons(context.root)
    except ToolError as error:
        problems += str(error).splitlines()
    functions, calls = blocks.functions_of(context.root), blocks.pointer_calls(context.root)
    if report:
        problems += blocks.problems(report, harnesses, list(functions), reasons, calls)
    problems += wrong.problems(mistakes) if report else []
    current = [one for one in standings if one.current]
    return Part(
        name="strength",
        title="Strength of the proofs",
        summary={
            "units whose mutants were run": f"{len(current)} of {len(standings)}",
            "mutants killed": mutants.score(current),
            "survivors unexplained": str(sum(len(mutants.unexplained(one)) for one in current)),
            "blocks reached by harnesses": blocks.summary(report),
            "mistakes on purpose refused": f"{sum(one.refused is True for one in mistakes)}"
            f" of {len(mistakes)}",
        },
        text=TEXT,
        tables=(
            mutants.table(standings),
            mutants.survivors(standings),
            wrong.table(mistakes),
            *blocks.tables(harnesses, functions, reasons, calls),
        ),
        items=(*mutants.items(standings), *wrong.items(mistakes)),
        problems=tuple(dict.fromkeys(problems)),
    )
