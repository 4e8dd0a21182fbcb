# SPDX-License-Identifier: Apache-2.0
"""Traces requirements to what states, proves and tests them, and functions to requirements."""
