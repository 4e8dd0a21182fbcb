"""The timing tools: a schedulability analyser, and experiments on the virtual board."""
