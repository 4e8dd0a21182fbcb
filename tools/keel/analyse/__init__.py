# SPDX-License-Identifier: Apache-2.0
"""Abstract interpretation with Frama-C's Eva and From (tools/keel eva).

demo_entry.c  how the demo is started
reduced       the source as Eva reads it
analysis      one run: what was found, and how far it reached
"""
