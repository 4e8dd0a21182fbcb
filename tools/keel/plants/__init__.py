# SPDX-License-Identifier: Apache-2.0
"""Aircraft that move: by JSBSim and by MuJoCo, with wind, and the battery that they empty."""
