# SPDX-License-Identifier: Apache-2.0
"""The evidence package: each part gathers one kind of evidence, and says what is wrong with it."""
