# SPDX-License-Identifier: Apache-2.0
# Proves and tests a project of yours with Keel's tools: docs/own_unit.md.
#
#     make -f /path/to/keel/keel.mk prove
#
# The project is the folder in which make runs, or PROJECT.

KEEL_FOLDER := $(abspath $(dir $(lastword $(MAKEFILE_LIST))))
PROJECT ?= $(CURDIR)
UNIT ?=
ARGS ?=
VERIFY ?=

.PHONY: help prove test evidence

help: ## this list
	@sed -nE 's/^([a-z-]+):[^#]*## (.*)/  make \1\t\2/p' $(KEEL_FOLDER)/keel.mk | expand -t 20

prove: ## prove the project (UNIT=monitor; ARGS=--update-goals; ARGS='--explain NAME')
	@python3 $(KEEL_FOLDER)/tools/prove.py --project "$(PROJECT)" $(if $(UNIT),--unit $(UNIT)) $(ARGS)

test: ## build and run tests/unit/test_*.c, with the project's sources and Keel's
	@python3 $(KEEL_FOLDER)/tools/own_tests.py --project "$(PROJECT)"

evidence: ## the project's evidence package in build/evidence (VERIFY=folder: look at one)
	@python3 $(KEEL_FOLDER)/tools/evidence.py --project "$(PROJECT)" \
	    $(if $(VERIFY),--verify "$(VERIFY)") $(ARGS)
