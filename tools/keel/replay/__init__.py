# SPDX-License-Identifier: Apache-2.0
"""Runs recorded sensors through the copter, and measures what becomes of them."""
