# SPDX-License-Identifier: Apache-2.0
"""The timing tools: a schedulability analyser, and experiments on the virtual board."""
