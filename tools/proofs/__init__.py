"""The proof driver behind tools/prove.py, one module per reason to change."""
