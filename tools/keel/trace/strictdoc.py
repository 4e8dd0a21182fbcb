# SPDX-License-Identifier: Apache-2.0
"""Has StrictDoc write the requirements as pages for people, and as ReqIF for other tools.

It reads them by its own grammar, so that a field that is missing, or a parent that does not exist,
stops it. Nothing else is left to it: its matrix does not tell roles apart.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.files import read_text, write_text
from keel.base.run import run
from keel.trace.requirements import FOLDER

CONFIG = """\
from strictdoc.core.project_config import ProjectConfig


def create_config() -> ProjectConfig:
    return ProjectConfig(
        project_title="Keel",
        project_features=["TABLE_SCREEN", "TRACEABILITY_SCREEN", "DEEP_TRACEABILITY_SCREEN",
                          "REQIF"],
        reqif_multiline_is_xhtml=True,
    )
"""
# Its identifiers are drawn at random; here the same requirements give the same ones.
START = """\
import random, sys, uuid
drawn = random.Random(0)
uuid.uuid4 = lambda: uuid.UUID(int=drawn.getrandbits(128), version=4)
from strictdoc.cli.main import main
sys.exit(main())
"""
UNUSED = ("mathjax", "mermaid", "plantuml")  # For markup that no requirement has.
TIME = re.compile(r"\b20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d(?:\.\d+)?(?:Z|\+00:00)")
NO_TIME = "2000-01-01T00:00:00Z"  # The package says what it was made from, and when.
STAMP = re.compile(r'(strictdoc-search-index-timestamp" content=")[\d.]+')
TIMEOUT_S = 300.0


def export(root: Path, folder: Path, packages: str) -> dict[str, Path]:
    """The files that StrictDoc writes, by the names that they have in the package."""
    shutil.rmtree(folder, ignore_errors=True)
    source, target = folder / "requirements", folder / "output"
    source.mkdir(parents=True)
    for path in sorted((root / FOLDER).glob("*.s*")):
        shutil.copy(path, source)
    write_text(source / "strictdoc_config.py", CONFIG)
    ended = run(
        [
            sys.executable,
            "-c",
            START,
            "export",
            str(source),
            "--formats=html,reqif-sdoc",
            "--no-parallelization",
            f"--output-dir={target}",
        ],
        TIMEOUT_S,
        cwd=folder,
        environment={"PYTHONPATH": packages, "PYTHONHASHSEED": "0"},
    )
    if not ended.good:
        raise ToolError(f"StrictDoc does not read {FOLDER}: {reason(ended.output)}")
    for path in (target / "html").rglob("*.html"):
        text = read_text(path).replace(str(source), FOLDER).replace(str(folder), "")
        write_text(path, STAMP.sub(r"\g<1>0", text))
    reqif = target / "reqif" / "output.reqif"
    write_text(reqif, TIME.sub(NO_TIME, read_text(reqif)))
    pages = [path for path in sorted((target / "html").rglob("*")) if path.is_file()]
    found = {path.relative_to(target / "html"): path for path in pages}
    return {"keel.reqif": reqif} | {
        f"strictdoc/{name.as_posix()}": path
        for name, path in found.items()
        if not set(name.parts) & set(UNUSED)
    }


def reason(output: str) -> str:
    """The line in which StrictDoc says what is wrong."""
    lines = [line.strip() for line in output.splitlines() if "error" in line.lower()]
    return " ".join(lines[:2]) or "it does not say why"
