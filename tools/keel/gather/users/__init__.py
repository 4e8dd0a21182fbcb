# SPDX-License-Identifier: Apache-2.0
"""The parts of the evidence package of a project that uses Keel: docs/evidence.md."""
