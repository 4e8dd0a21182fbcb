# SPDX-License-Identifier: Apache-2.0
"""Runs with seeded faults that show whether a tool still detects what it is trusted to detect
(tools/keel qualify).

seeds, deceptions  the faults, each beside the same thing without it
trials             how each tool is asked
mistakes           those in the boards' code (tests/target/mistakes.toml), one by one
board_trials       short runs on the model of the chip, which notice them
"""
