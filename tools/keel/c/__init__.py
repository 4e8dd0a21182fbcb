# SPDX-License-Identifier: Apache-2.0
"""Reads C by its syntax, and finds the files of a project."""
