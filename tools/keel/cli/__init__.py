# SPDX-License-Identifier: Apache-2.0
"""The sub-commands of python3 tools/keel."""
