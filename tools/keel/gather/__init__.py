# SPDX-License-Identifier: Apache-2.0
"""Gathers the evidence: each part one kind of it, and says what is wrong with it."""
