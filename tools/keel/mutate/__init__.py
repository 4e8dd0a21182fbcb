# SPDX-License-Identifier: Apache-2.0
"""Breaks the code in small ways, and sees whether proofs notice."""
