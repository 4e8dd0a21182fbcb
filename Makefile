# SPDX-License-Identifier: Apache-2.0
# What Keel can do. Each target installs what it needs (KEEL_NO_INSTALL=1: says what is missing
# instead) and runs one program of tools/, which can also be called directly. The targets check/X and
# generate/X are for `make check NAME=X` and `make generate NAME=X`.

SHELL := /bin/bash
MAKEFLAGS += --no-print-directory
export PYTHONUNBUFFERED := 1

UNIT ?=
CAPACITY ?=
SENSORS ?=
SECONDS := 60
TASKSET ?= specs/tasksets/urpilot.toml
ARGS ?=
BOARD ?=
APP ?=
NAME := # Some systems have a variable of that name: theirs does not count.

# The variables that a command line may set. Another one is a slip, and must not pass unnoticed.
VARIABLES := NAME UNIT CAPACITY SENSORS SECONDS TASKSET ARGS BOARD APP DASK CFLAGS KEEL_CACHE KEEL_NO_INSTALL \
             KEEL_FRESH KEEL_DEBIAN_MIRROR VERIFY SCENARIO SEED N JOBS ADDRESS FILE
GIVEN := $(foreach name,$(.VARIABLES),$(if $(findstring command line,$(origin $(name))),$(name)))
STRANGE := $(filter-out $(VARIABLES),$(GIVEN))
ifneq ($(STRANGE),)
$(error $(shell python3 tools/keel names variable $(STRANGE) -- $(VARIABLES)))
endif

CFLAGS := -std=c99 -O2 -Wall -Wextra -Werror
DEMO := $(wildcard src/rtos/*.c examples/urpilot/*.c)
TIMING := python3 tools/keel timing
OWN_TASKS = specs/tasksets/$(BOARD).toml

# The sizes of a build other than the shipped one.
SIZES = $(if $(CAPACITY),--size KEEL_QUEUE_CAPACITY=$(CAPACITY)) \
        $(if $(SENSORS),--size KEEL_VOTER_SENSORS=$(SENSORS))

# The rules of this file, the targets among them, and what NAME may be for `check` or `generate`.
MAKEFILE := $(firstword $(MAKEFILE_LIST))
RULES := $(shell sed -nE 's|^([a-z/-]+):.*|\1|p' $(MAKEFILE))
TARGETS := $(filter-out python check/% generate/%,$(RULES))
MEMBERS := $(notdir $(filter check/% generate/%,$(RULES)))
names_of = $(patsubst $1/%,%,$(filter $1/%,$(RULES)))

# The rules of the words of NAME. A word that is none is a slip, refused before anything runs.
no_name = $(error $(shell python3 tools/keel names name "$2" -- $(call names_of,$1)))
chosen = $(if $(filter $1,$(MAKECMDGOALS)),\
         $(foreach word,$(NAME),$(or $(filter $1/$(word),$(RULES)),$(call no_name,$1,$(word)))))

.PHONY: $(RULES) $(MEMBERS)
.NOTPARALLEL:

# Headings and targets as they follow each other below.
help: ## this list
	@sed -nE 's/^##@ (.*)/\n\1/p; s/^([a-z-]+):[^#]*## (.*)/  make \1\t\2/p' $(MAKEFILE) | expand -t 20

##@ Prove, test and measure

prove: python ## prove scheduler, voter, filter, PID (UNIT=queue: one unit; CAPACITY=8 SENSORS=3: your sizes)
	@python3 tools/keel prove $(if $(UNIT),--unit $(UNIT),--kernel) $(SIZES) $(ARGS)

prove-all: python ## prove every contract and harness of all units (ARGS='--shard 2/4': a quarter)
	@python3 tools/keel prove $(if $(UNIT),--unit $(UNIT)) $(SIZES) $(ARGS)

test: python ## build and run tests, long ones aside (ARGS='--filter unit/': some of them; ARGS='--jobs 1')
	@python3 tools/keel test $(ARGS)

test-all: python ## run all tests, the long ones too: flights, models of chips, tests of tools
	@python3 tools/keel test --all $(ARGS)

test-target: python ## the unit tests, faults, demo and model's results on an emulated Cortex-M7
	@python3 tools/keel test-target $(ARGS)

coverage: python ## lines, branches and MC/DC that the unit tests reach
	@python3 tools/keel coverage $(ARGS)

mutate: python ## break the code and see whether proofs notice (UNIT=queue; ARGS=--status; DASK=tcp://host:8786)
	@$(if $(DASK),DASK=$(DASK) python3 tools/keel with dask,python3) tools/keel mutate \
	    $(if $(UNIT),--unit $(UNIT)) $(ARGS)

bench: python ## instructions per pass and per step, code size and RAM; over the Cortex-M7's budget it fails
	@python3 tools/keel bench $(ARGS)

lint: python ## layout, MISRA C:2012, the rules of the house, workflows of CI (ARGS=--fix: lay out first)
	@python3 tools/keel lint $(ARGS)

check: $(call chosen,check) ## another check (NAME=eva): of code, flights, recordings, tools; without NAME: a list of them
generate: $(call chosen,generate) ## write files (NAME=tables): tables in C, pages, pictures, a release; without NAME: a list of them

evidence: python ## the evidence package in build/evidence; VERIFY=folder looks whether one is as it was made
	@python3 tools/keel evidence $(if $(VERIFY),--verify "$(VERIFY)") $(ARGS)

##@ Your firmware, on boards and in simulated flights

analyze: python ## does a task set hold? (TASKSET=file.toml, ARGS=--phases, ARGS=--synthesize)
	@$(TIMING) analyze "$(TASKSET)" $(ARGS)

firmware: python ## build a board's image (BOARD=fmuv5; APP=copter: the copter; ARGS='--app FOLDER': another main)
	@$(TIMING) table --check specs/tasksets/urpilot.toml examples/urpilot
	@$(if $(filter copter,$(APP)),$(if $(wildcard $(OWN_TASKS)),$(TIMING) analyze --verdict "$(OWN_TASKS)",:),:)
	@python3 tools/keel firmware "$(BOARD)" $(if $(APP),--named "$(APP)") $(ARGS)

flash: python ## write a board's image to the board (BOARD=nucleo_f767zi; ARGS='--tool st-flash')
	@python3 tools/keel flash "$(BOARD)" $(ARGS)

fly: python ## fly the copter in plants that others wrote (SCENARIO=hover: one; SEED=7; BOARD=fmuv5: its image)
	@python3 tools/keel fly $(if $(BOARD),--board "$(BOARD)") \
	    $(if $(SCENARIO),--scenario "$(SCENARIO)") \
	    $(if $(SEED),--seed "$(SEED)") $(if $(JOBS),--jobs "$(JOBS)") $(ARGS)

sim: python ## fly the copter in real time with MAVLink at UDP 14550 (ADDRESS=127.0.0.1:14550; SCENARIO=wind)
	@python3 tools/keel sim $(foreach one,$(ADDRESS),--address "$(one)") \
	    $(if $(SCENARIO),--scenario "$(SCENARIO)") $(ARGS)

log: python ## plot a flight's log (FILE=build/fly/hover-jsbsim.ulg): attitude, motors, votes, load, vibration
	@python3 tools/keel log "$(FILE)" $(ARGS)

# --- make check NAME=..., make generate NAME=... -------------------------------------------------

# Without NAME nothing is checked or made, so the list ends as a failure does.
check generate:
	@test -n "$(NAME)" || { \
	    sed -nE 's|^$@/([a-z-]+):[^#]*## (.*)|  make $@ NAME=\1\t\2|p' $(MAKEFILE) | expand -t 38; exit 2; }

check/eva: python ## abstract interpretation: undefined behaviour, writes that no contract names
	@python3 tools/keel eva $(ARGS)

check/opinion: python ## ask ESBMC, a third engine, about some of the harnesses (ARGS=--fresh)
	@python3 tools/keel opinion $(ARGS)

check/qualify: python ## seeded faults: does each tool still detect what it is trusted to detect?
	@python3 tools/keel qualify $(ARGS)

check/trace: python ## requirement, function, clause, harness, test: fail when one stands alone
	@python3 tools/keel trace $(ARGS)

check/review: python ## who has reviewed the proofs (UNIT=queue: what to look at; ARGS='--sign NAME --remarks TEXT')
	@python3 tools/keel review $(if $(UNIT),--unit $(UNIT)) $(ARGS)

check/coverage-target: python ## object-code branches that the unit tests take on an emulated Cortex-M7
	@python3 tools/keel coverage-target $(ARGS)

check/contracts-run: python ## the unit tests, calling through contracts that E-ACSL made executable
	@python3 tools/keel contracts-run $(ARGS)

check/fuzz: python ## fuzz the scheduler and the decoders beside models and others' decoders (SECONDS=60)
	@python3 tools/keel fuzz --seconds $(SECONDS) $(ARGS)

check/fuzztasks: python ## 100 000 broken task-set files, each of which must be read or refused in words
	@python3 tools/keel with timing tests/timing/fuzz_taskset.py 100000

check/soak: python ## 10^9 random calls of each stateful unit beside the specification (an hour)
	@python3 tools/keel soak $(ARGS)

check/registers: python ## hold the register headers against two independent register databases
	@python3 tools/keel registers

check/stack: python ## bound the stack of every task and of main in a board's image (BOARD=nucleo_f767zi)
	@python3 tools/keel stack "$(BOARD)" $(ARGS)

check/model: python ## run a board's image on a model of its chip (BOARD=nucleo_f767zi; ARGS='--keys 1.5:t')
	@python3 tools/keel model "$(BOARD)" $(ARGS)

check/demo: python ## the paper's 21 tasks, one simulated minute on this host
	@python3 tools/keel tools ensure test
	@$(TIMING) table --check specs/tasksets/urpilot.toml examples/urpilot
	@mkdir -p build
	gcc $(CFLAGS) -Iinclude -Iexamples/urpilot $(DEMO) -lm -o build/demo
	@build/demo

check/timing: python ## the paper's evaluation on the virtual board: tables, JSON and plots in build/timing
	@$(TIMING) experiments specs/tasksets/urpilot.toml

check/campaign: python ## the voter's fault campaign and fig. 14: tables, JSON and plots in build/campaign
	@python3 tools/keel campaign

check/flights: python ## N flights with everything varied (N=1000; JOBS=4; DASK=tcp://host:8786; SEED=7: one again)
	@DASK="$(DASK)" python3 tools/keel flights \
	    --flights "$(if $(N),$(N),100)" $(if $(SEED),--seed "$(SEED)") \
	    $(if $(JOBS),--jobs "$(JOBS)") $(ARGS)

check/replay: python ## your recorded sensors through Keel's estimators (FILE=flight.ulg, a folder; ARGS=--compare)
	@python3 tools/keel replay "$(FILE)" $(ARGS)

check/margins: python ## gain, phase and delay margin of each of the copter's loops
	@python3 tools/keel margins

check/tools: python ## which tools were found, with versions; fails if one is missing (ARGS=--install: first installs all)
	@$(if $(filter --install,$(ARGS)),python3 tools/keel tools ensure)
	@python3 tools/keel tools versions $(filter-out --install,$(ARGS))

generate/tables: python ## the C tables of tasks, parameters and the Earth's magnetic field
	@$(TIMING) table specs/tasksets/urpilot.toml examples/urpilot
	@python3 tools/keel parameters
	@python3 tools/keel world

generate/messages: python ## the C tables of MAVLink's messages from its definitions
	@python3 tools/keel messages $(ARGS)

generate/status: python ## docs/status.md: what the last run of 'make prove-all' proved
	@python3 tools/keel status

generate/pictures: check/campaign check/timing ## the pictures of the documents, in docs/pictures
	@python3 tools/keel flight-picture
	@python3 tools/keel schedule --picture
	@python3 tools/keel pictures

generate/schedule: python ## when each task ran, for Perfetto and as a page in build (FILE=flight.ulg: of a log)
	@python3 tools/keel schedule $(if $(FILE),"$(FILE)") $(ARGS)

generate/dist: python ## a release of this commit in build/dist: archive, bill of materials, checksums
	@python3 tools/keel dist $(ARGS)

# The tools are Python programs. Where there is none, Debian's is installed.
python:
	@command -v python3 >/dev/null || { \
	    test "$$KEEL_NO_INSTALL" != 1 && command -v apt-get >/dev/null || { \
	        echo 'make: python3 is missing; please install Python 3.11 or newer' >&2; exit 1; }; \
	    root=; test "$$(id -u)" = 0 || root='sudo -n'; \
	    $$root apt-get update && \
	    $$root apt-get install -y --no-install-recommends python3 ca-certificates || { \
	        echo 'make: python3 is missing and could not be installed (not root, no sudo' \
	             'without a password, or no network); please install it' >&2; exit 1; }; }
	@python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	    echo "make: Python 3.11 or newer is needed, this is $$(python3 --version)" >&2; exit 1; }

# Who types a name as a target is told how it is called. What else is no target is a slip, too.
$(MEMBERS):
	$(error there is no target $@; make $(subst /, NAME=,$(filter %/$@,$(RULES))) does it)

.DEFAULT:
	$(error $(shell python3 tools/keel names target $@ -- $(TARGETS)))
