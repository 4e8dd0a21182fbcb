# SPDX-License-Identifier: Apache-2.0
"""The proof driver behind tools/prove.py, one module per reason to change."""
