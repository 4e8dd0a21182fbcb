# SPDX-License-Identifier: Apache-2.0
# Proves and tests a project of yours with Keel's tools: docs/own_unit.md. By itself:
#
#     make -f /path/to/keel/keel.mk prove UNIT=monitor
#
# Included in your Makefile it takes no name that does not begin with keel or KEEL, nor the place of
# your first target:
#
#     include /path/to/keel/keel.mk     # make keel-prove KEEL_UNIT=monitor
#
# The project is the folder in which make runs, or PROJECT (KEEL_PROJECT where included).

KEEL_MK := $(lastword $(MAKEFILE_LIST))
KEEL_FOLDER := $(abspath $(dir $(KEEL_MK)))

ifeq ($(KEEL_MK),$(firstword $(MAKEFILE_LIST)))
KEEL_PROJECT := $(or $(KEEL_PROJECT),$(PROJECT))
KEEL_UNIT := $(or $(KEEL_UNIT),$(UNIT))
KEEL_ARGS := $(or $(KEEL_ARGS),$(ARGS))
KEEL_VERIFY := $(or $(KEEL_VERIFY),$(VERIFY))
KEEL_SHOWN := sed 's/keel-//; s/KEEL_//g'
KEEL_CALL := make -f $(KEEL_MK) prove UNIT={unit} ARGS={arguments}

.PHONY: help new prove test evidence
help: keel-help
new: keel-new
prove: keel-prove
test: keel-test
evidence: keel-evidence
else
KEEL_DEFAULT_GOAL := $(.DEFAULT_GOAL)
KEEL_SHOWN := cat
KEEL_CALL := make keel-prove KEEL_UNIT={unit} KEEL_ARGS={arguments}
endif

KEEL_AT = --project "$(or $(KEEL_PROJECT),$(CURDIR))"

.PHONY: keel-help keel-new keel-prove keel-test keel-evidence

keel-help: ## this list
	@sed -nE 's/^(keel-[a-z]+):[^#]*## (.*)/  make \1\t\2/p' "$(KEEL_FOLDER)/keel.mk" \
	    | $(KEEL_SHOWN) | expand -t 24

keel-new: ## begin a unit (KEEL_UNIT=limiter; KEEL_ARGS='--layer app'), or harnesses from its header's prototypes
	@python3 "$(KEEL_FOLDER)/tools/keel" new $(KEEL_AT) --unit "$(KEEL_UNIT)" $(KEEL_ARGS)

keel-prove: ## prove the project (KEEL_UNIT=monitor; KEEL_ARGS=--update-goals; KEEL_ARGS='--explain NAME')
	@KEEL_CALL="$(KEEL_CALL)" python3 "$(KEEL_FOLDER)/tools/keel" prove $(KEEL_AT) \
	    $(if $(KEEL_UNIT),--unit $(KEEL_UNIT)) $(KEEL_ARGS)

keel-test: ## build and run tests/unit/test_*.c, with the project's sources and Keel's
	@python3 "$(KEEL_FOLDER)/tools/keel" test-project $(KEEL_AT)

keel-evidence: ## the project's evidence package in build/evidence (KEEL_VERIFY=folder: look at one)
	@python3 "$(KEEL_FOLDER)/tools/keel" evidence $(KEEL_AT) \
	    $(if $(KEEL_VERIFY),--verify "$(KEEL_VERIFY)") $(KEEL_ARGS)

ifneq ($(KEEL_MK),$(firstword $(MAKEFILE_LIST)))
.DEFAULT_GOAL := $(KEEL_DEFAULT_GOAL)
endif
