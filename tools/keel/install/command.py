# SPDX-License-Identifier: Apache-2.0
"""The command line of the toolchain.

    python3 tools/keel tools ensure prove test     # make the tools available; all without a name
    python3 tools/keel tools path cbmc             # where one of them is
    python3 tools/keel tools versions prove --json # what was found, with SHA-256
    python3 tools/keel tools env                   # variables to export in a shell

Exit status: 0 when every tool of the groups is there; 1 when `versions` misses one; 2 when one
could not be had (the reason, tool by tool, on stderr), or for a wrong command line.

Environment:
    KEEL_CACHE          the cache, shared by all clones (default ${XDG_CACHE_HOME:-~/.cache}/keel)
    KEEL_NO_INSTALL     set to 1 to look for tools only, never to install any
    KEEL_DEBIAN_MIRROR  Debian mirrors to use instead of the one of the host's apt configuration
"""

from __future__ import annotations

import argparse
import json
import shlex
import sys
from collections.abc import Sequence
from dataclasses import asdict

from keel.base.arguments import Parser
from keel.base.errors import program
from keel.install.tools import Toolchain


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


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = Parser("Find, install and pin the tools of Keel.", prog="toolchain")
    commands = parser.add_subparsers(dest="command", required=True)
    ensure = commands.add_parser("ensure", help="make every tool of the groups available")
    ensure.add_argument("groups", nargs="*", metavar="GROUP", help="default: all groups")
    path = commands.add_parser("path", help="print how to start a tool, or where it lies")
    path.add_argument("tool", metavar="TOOL")
    versions = commands.add_parser("versions", help="print what was found")
    versions.add_argument("groups", nargs="*", metavar="GROUP")
    versions.add_argument("--json", action="store_true")
    commands.add_parser("env", help="print the variables for a shell")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("toolchain", lambda: run_command(parse(arguments)))
