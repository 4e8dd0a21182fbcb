# SPDX-License-Identifier: Apache-2.0
"""From the text of a source and what a prover printed to a verdict, with reasons.

A kept verdict rests on this room, the reader of C and the module that asks the engine, and on no
other module. Nothing here starts a program or a thread, reads a clock, or knows of kept verdicts.

wp_log         reads what WP printed
wp_verdict     judges it: goal by goal, and the warnings that take from it
wp_targets     the functions and lemmas that WP is asked about
wp_frames      what WP proves of functions whose postconditions are left to CBMC
cbmc_answers   reads and judges what CBMC answered
harness        what a harness says of itself
wrong_bodies   the wrong bodies that a harness must refute
goals          the goals that must be there
settings       the exceptions that a person has accepted, each with its reason"""
