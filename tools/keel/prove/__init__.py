# SPDX-License-Identifier: Apache-2.0
"""The proof driver behind tools/keel prove, one module per reason to change."""
