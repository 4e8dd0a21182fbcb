# SPDX-License-Identifier: Apache-2.0
# What Keel can do. Each target installs what it needs (KEEL_NO_INSTALL=1: says what is missing
# instead) and runs one program of tools/, which can also be called directly.

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

# The variables that a command line may set. Another one is a slip, and must not pass unnoticed.
VARIABLES := UNIT CAPACITY SENSORS SECONDS TASKSET ARGS BOARD APP DASK CFLAGS KEEL_CACHE KEEL_NO_INSTALL KEEL_FRESH \
             KEEL_DEBIAN_MIRROR VERIFY SCENARIO SEED N JOBS ADDRESS FILE
GIVEN := $(foreach name,$(.VARIABLES),$(if $(findstring command line,$(origin $(name))),$(name)))
STRANGE := $(filter-out $(VARIABLES),$(GIVEN))
ifneq ($(STRANGE),)
$(error $(shell python3 tools/keel names variable $(STRANGE) -- $(VARIABLES)))
endif

# The targets of `make help` by their use; those that are not named here are for every day.
BOARDS := firmware model stack flash registers test-target
EVIDENCE := eva qualify evidence coverage coverage-target contracts-run mutate opinion review fuzz soak fuzztasks trace status dist
RESEARCH := timing campaign pictures

ALL_TOOLS := prove test lint coverage bench fuzz oracles firmware stack target registers model \
             flash-openocd flash-pyocd flash-st-flash flash-px4 timing tools-tests timing-tests \
             consumer packaging opinion evidence browser attestation contracts-run trace c-syntax dask ci \
             fly flights replay fly-tests messages sim clients fatfs card schedule
CFLAGS := -std=c99 -O2 -Wall -Wextra -Werror
DEMO := $(wildcard src/rtos/*.c examples/urpilot/*.c)
TIMING := python3 tools/keel timing

.PHONY: analyze tables fuzztasks timing
.PHONY: help prove test demo bench lint campaign coverage mutate fuzz soak trace registers status firmware model stack flash dist tools doctor clean python
.NOTPARALLEL:

help: ## this list
	@awk -F ':[^#]*## ' -v boards='$(BOARDS)' -v evidence='$(EVIDENCE)' -v research='$(RESEARCH)' ' \
	    function group(words, use, list, n) { \
	        for (n = split(words, list, " "); n > 0; n--) of[list[n]] = use } \
	    BEGIN { group(boards, "Boards"); group(evidence, "Evidence"); group(research, "Research") } \
	    /^[a-z-]+:[^#]*## / { use = ($$1 in of) ? of[$$1] : "Everyday"; \
	        lines[use] = lines[use] sprintf("  make %-15s %s\n", $$1, $$2) } \
	    END { print "Everyday\n" lines["Everyday"] "\nBoards\n" lines["Boards"] \
	        "\nEvidence\n" lines["Evidence"] "\nResearch\n" lines["Research"] }' \
	    $(firstword $(MAKEFILE_LIST))

# The sizes of a build other than the shipped one.
SIZES = $(if $(CAPACITY),--size KEEL_QUEUE_CAPACITY=$(CAPACITY)) \
        $(if $(SENSORS),--size KEEL_VOTER_SENSORS=$(SENSORS))

prove: python ## prove scheduler, voter, filter, PID (UNIT=queue: one unit; CAPACITY=8 SENSORS=3: your sizes)
	@python3 tools/keel prove $(if $(UNIT),--unit $(UNIT),--kernel) $(SIZES) $(ARGS)

.PHONY: prove-all
prove-all: python ## prove every contract and harness of all units (ARGS='--shard 2/4': a quarter)
	@python3 tools/keel prove $(if $(UNIT),--unit $(UNIT)) $(SIZES) $(ARGS)

test: python ## build and run tests, long ones aside (ARGS='--filter unit/': some of them; ARGS='--jobs 1')
	@python3 tools/keel test $(ARGS)

.PHONY: test-all
test-all: python ## run all tests, the long ones too: flights, models of chips, tests of tools
	@python3 tools/keel test --all $(ARGS)

demo: python ## the paper's 21 tasks, one simulated minute on this host
	@python3 tools/keel tools ensure test
	@$(TIMING) table --check specs/tasksets/urpilot.toml examples/urpilot
	@mkdir -p build
	gcc $(CFLAGS) -Iinclude -Iexamples/urpilot $(DEMO) -lm -o build/demo
	@build/demo

bench: python ## instructions per pass and per step, code size and RAM; over the Cortex-M7's budget it fails
	@python3 tools/keel bench $(ARGS)

lint: python ## layout, MISRA C:2012, the rules of the house, workflows of CI (ARGS=--fix: lay out first)
	@python3 tools/keel lint $(ARGS)

.PHONY: eva
eva: python ## abstract interpretation: undefined behaviour, writes that no contract names
	@python3 tools/keel eva $(ARGS)

.PHONY: qualify
qualify: python ## seeded faults: does each tool still detect what it is trusted to detect?
	@python3 tools/keel qualify $(ARGS)

analyze: python ## does a task set hold? (TASKSET=file.toml, ARGS=--phases, ARGS=--synthesize)
	@$(TIMING) analyze "$(TASKSET)" $(ARGS)

timing: python ## the paper's evaluation on the virtual board: tables, JSON and plots in build/timing
	@$(TIMING) experiments specs/tasksets/urpilot.toml

tables: python ## regenerate the C tables of tasks, parameters and the Earth's magnetic field
	@$(TIMING) table specs/tasksets/urpilot.toml examples/urpilot
	@python3 tools/keel parameters
	@python3 tools/keel world

.PHONY: messages
messages: python ## regenerate the C tables of MAVLink's messages from its definitions
	@python3 tools/keel messages $(ARGS)

fuzztasks: python ## 100 000 broken task-set files, each of which must be read or refused in words
	@python3 tools/keel with timing tests/timing/fuzz_taskset.py 100000

campaign: python ## the voter's fault campaign and fig. 14: tables, JSON and plots in build/campaign
	@python3 tools/keel campaign

.PHONY: fly flights
fly: python ## fly the copter in plants that others wrote (SCENARIO=hover: one; SEED=7: one of make flights)
	@python3 tools/keel fly $(if $(SCENARIO),--scenario "$(SCENARIO)") \
	    $(if $(SEED),--seed "$(SEED)") $(if $(JOBS),--jobs "$(JOBS)") $(ARGS)

flights: python ## N flights with everything varied (N=1000; JOBS=4; DASK=tcp://host:8786; SEED=7: one again)
	@DASK="$(DASK)" python3 tools/keel flights \
	    --flights "$(if $(N),$(N),100)" $(if $(SEED),--seed "$(SEED)") \
	    $(if $(JOBS),--jobs "$(JOBS)") $(ARGS)

.PHONY: margins
margins: python ## gain, phase and delay margin of each of the copter's loops
	@python3 tools/keel margins

.PHONY: log
log: python ## plot a flight's log (FILE=build/fly/hover-jsbsim.ulg): attitude, motors, votes, load, vibration
	@python3 tools/keel log "$(FILE)" $(ARGS)

.PHONY: replay
replay: python ## your recorded sensors through Keel's estimators (FILE=flight.ulg, a folder; ARGS=--compare)
	@python3 tools/keel replay "$(FILE)" $(ARGS)

.PHONY: schedule
schedule: python ## see each run of each task: for Perfetto, and as a page (FILE=flight.ulg: of a log)
	@python3 tools/keel schedule $(if $(FILE),"$(FILE)") $(ARGS)

.PHONY: sim
sim: python ## fly the copter in real time with MAVLink at UDP 14550 (ADDRESS=127.0.0.1:14550; SCENARIO=wind)
	@python3 tools/keel sim $(foreach one,$(ADDRESS),--address "$(one)") \
	    $(if $(SCENARIO),--scenario "$(SCENARIO)") $(ARGS)

.PHONY: flight-picture
flight-picture: python
	@python3 tools/keel flight-picture

.PHONY: schedule-picture
schedule-picture: python
	@python3 tools/keel schedule --picture

.PHONY: pictures
pictures: campaign timing flight-picture schedule-picture ## the pictures of the documents, in docs/pictures
	@python3 tools/keel pictures

coverage: python ## lines, branches and MC/DC that the unit tests reach
	@python3 tools/keel coverage $(ARGS)

.PHONY: coverage-target
coverage-target: python ## object-code branches that the unit tests take on an emulated Cortex-M7
	@python3 tools/keel coverage-target $(ARGS)

.PHONY: contracts-run
contracts-run: python ## the unit tests, calling through contracts that E-ACSL made executable
	@python3 tools/keel contracts-run $(ARGS)

mutate: python ## break the code and see whether proofs notice (UNIT=queue; ARGS=--status; DASK=tcp://host:8786)
	@$(if $(DASK),DASK=$(DASK) python3 tools/keel with dask,python3) tools/keel mutate \
	    $(if $(UNIT),--unit $(UNIT)) $(ARGS)

.PHONY: opinion
opinion: python ## ask ESBMC, a third engine, about some of the harnesses (ARGS=--fresh)
	@python3 tools/keel opinion $(ARGS)

.PHONY: review
review: python ## who has reviewed the proofs (UNIT=queue: what to look at; ARGS='--sign NAME --remarks TEXT')
	@python3 tools/keel review $(if $(UNIT),--unit $(UNIT)) $(ARGS)

fuzz: python ## fuzz the scheduler and the decoders beside models and others' decoders (SECONDS=60)
	@python3 tools/keel fuzz --seconds $(SECONDS) $(ARGS)

soak: python ## 10^9 random calls of each stateful unit beside the specification (an hour)
	@python3 tools/keel soak $(ARGS)

trace: python ## requirement, function, clause, harness, test: fail when one stands alone
	@python3 tools/keel trace $(ARGS)

registers: python ## hold the register headers against two independent register databases
	@python3 tools/keel registers

status: python ## write what the last run of 'make prove' proved into docs/status.md
	@python3 tools/keel status

.PHONY: test-target
test-target: python ## the unit tests, faults, demo and model's results on an emulated Cortex-M7
	@python3 tools/keel test-target $(ARGS)

firmware: python ## build a board's image (BOARD=fmuv5; APP=copter: the copter; ARGS='--app FOLDER': another main)
	@$(TIMING) table --check specs/tasksets/urpilot.toml examples/urpilot
	@python3 tools/keel firmware "$(BOARD)" $(if $(APP),--named "$(APP)") $(ARGS)

model: python ## run a board's image on a model of its chip (BOARD=nucleo_f767zi; ARGS='--keys 1.5:t')
	@python3 tools/keel model "$(BOARD)" $(ARGS)

stack: python ## bound the stack of every task and of main in a board's image (BOARD=nucleo_f767zi)
	@python3 tools/keel stack "$(BOARD)" $(ARGS)

flash: python ## write a board's image to the board (BOARD=nucleo_f767zi; ARGS='--tool st-flash')
	@python3 tools/keel flash "$(BOARD)" $(ARGS)

.PHONY: evidence
evidence: python ## the evidence package in build/evidence; VERIFY=folder looks whether one is as it was made
	@python3 tools/keel evidence $(if $(VERIFY),--verify "$(VERIFY)") $(ARGS)

dist: python ## a release of this commit: archive, bill of materials, checksums (in build/dist)
	@python3 tools/keel dist $(ARGS)

tools: python ## install all tools now, rather than when they are needed
	@python3 tools/keel tools ensure $(ALL_TOOLS)

doctor: python ## which tools were found, with versions; exit status 1 when one is missing
	@python3 tools/keel tools versions

clean: ## remove build/; what was downloaded stays in the cache
	rm -rf build

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

# What is no target is a slip, too.
TARGETS = $(shell sed -nE 's/^([a-z-]+):.*/\1/p' $(firstword $(MAKEFILE_LIST)))
.DEFAULT:
	$(error $(shell python3 tools/keel names target $@ -- $(TARGETS)))
