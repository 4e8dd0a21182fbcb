# SPDX-License-Identifier: Apache-2.0
"""The tools of Keel: one program with sub-commands (python3 tools/keel), one room for each purpose.

A room imports rooms below it and none above (pyproject.toml has the order):

base      files, programs, command lines
install   the tools that others wrote: found, installed, pinned
c         reads C, and the files of a project
judge     from what a prover printed to a verdict; what a kept verdict rests on
audit     what must hold of the proofs as a whole, looked at in each run
engines   asks WP, CBMC and Gappa
prove     one run of the proofs, from the choice of units to the report
mutate    breaks the code, and sees whether proofs notice
cli       the sub-commands

CONTRIBUTING.md has the others.
"""
