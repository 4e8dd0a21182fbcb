# SPDX-License-Identifier: Apache-2.0
"""Runs with seeded faults that show whether a tool still detects what it is trusted to detect
(tools/keel qualify).

seeds   the faults, each beside the same thing without it
trials  how each tool is asked
"""
