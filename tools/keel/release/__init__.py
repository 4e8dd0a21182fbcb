# SPDX-License-Identifier: Apache-2.0
"""What a release consists of, and how the project stands."""
