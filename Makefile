# One entry per thing one does with this repository. `make help` lists them.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.NOTPARALLEL:
MAKEFLAGS += --no-print-directory

JOBS := $(shell nproc 2>/dev/null || echo 2)
SECONDS ?= 300
SAY := @echo "==>"
CPP_FOLDERS := $(wildcard include src apps tests benchmarks fuzz)

# In automation: no colours, no questions.
ifeq ($(CI),true)
export DEBIAN_FRONTEND := noninteractive
export GTEST_COLOR := no
export CLICOLOR := 0
endif

.PHONY: help demo train test asan tsan format format-check tidy bench fuzz clean
.PHONY: deps-build deps-learn deps-fuzz deps-lint deps-bench deps-test deps-web deps-web-test
.PHONY: web web-test web-bench

help:
	@echo "make demo               build the command line tool and the page, simulate the duct line, write it as a page"
	@echo "make train              build the trainer (installs LibTorch), train EBQ-N on the duct line, evaluate it"
	@echo "make test               build everything, run all tests, fuzz for 20 seconds"
	@echo "make asan               run the tests under AddressSanitizer and UndefinedBehaviorSanitizer"
	@echo "make tsan               run the tests under ThreadSanitizer"
	@echo "make web                build the page that shows runs in a browser: build/web/linewright-view.html"
	@echo "make web-test           build it and run its tests (web-bench: measure frames per second)"
	@echo "make fuzz SECONDS=300   fuzz everything that parses"
	@echo "make bench              run the benchmarks"
	@echo "make format             lay out all C++ files with clang-format (format-check: only look)"
	@echo "make tidy               check all C++ files with clang-tidy"
	@echo "make clean              delete build/ and out/"

deps-build:
	@tools/install_dependencies.sh build
deps-fuzz:
	@tools/install_dependencies.sh build fuzz
deps-lint:
	@tools/install_dependencies.sh lint
# LibTorch and OMPL are optional, and CMake looks for them only when it configures: so do `train`,
# `test` and `bench`.
deps-learn:
	@tools/install_dependencies.sh build learn
deps-bench:
	@tools/install_dependencies.sh build learn bench
deps-test:
	@tools/install_dependencies.sh build learn fuzz bench solver web web-test
deps-web:
	@tools/install_dependencies.sh web
deps-web-test:
	@tools/install_dependencies.sh web web-test

# Ninja configures again by itself when a CMake file or the set of sources changes.
build/%/build.ninja: CMakePresets.json | deps-build
	$(SAY) "Configuring the build in build/$*"
	@cmake --preset $* --log-level=WARNING >/dev/null
	@touch $@

# The page is one file without anything outside. npm installs again only when the lock file changed.
WEB_PAGE := build/web/linewright-view.html
WEB_PACKAGES := web/node_modules/.package-lock.json
WEB_SOURCES := $(shell find web/src -type f -not -name '*.test.ts' 2>/dev/null) \
  $(wildcard web/*.html web/*.json web/vite.config.ts)
WEB_SUMMARY = page: $$(grep -hE '^ +Tests ' build/web/test.log | grep -oE '[0-9]+ passed' | paste -sd ,)

demo: build/release/build.ninja $(WEB_PAGE)
	$(SAY) "Building the command line tool"
	@cmake --build --preset release --parallel $(JOBS) --target linewright
	$(SAY) "Simulating the duct line: 2 humans, 2 robots, an order of 5 ducts"
	@mkdir -p out
	@build/release/linewright simulate scenarios/duct_line.yaml --humans 2 --robots 2 --order 5 \
	  --explain --log out/duct_line.jsonl --gantt out/duct_line.svg >out/duct_line.txt
	@sed -n '/^line /,$$p' out/duct_line.txt
	@build/release/linewright view out/duct_line.jsonl --export out/duct_line.html
	$(SAY) "Done: open out/duct_line.html in a browser; out/duct_line.svg is the Gantt chart, out/duct_line.jsonl the event log, out/duct_line.txt says why of each decision"

train: deps-learn build/release/build.ninja
	@cmake --preset release --log-level=WARNING >/dev/null
	$(SAY) "Building the trainer"
	@cmake --build --preset release --parallel $(JOBS) --target linewright linewright-train
	$(SAY) "Training EBQ-N on the duct line: some three minutes on two cores"
	@build/release/linewright train --algo ebq-n --scenario scenarios/duct_line.yaml --seed 1 --out out/train
	$(SAY) "Evaluating it: nine crews, 100 starts each"
	@build/release/linewright evaluate scenarios/duct_line.yaml --order 5 --trials 100 \
	  --planner policy:out/train/ebq-n-s1/best.safetensors

test: deps-test build/release/build.ninja $(WEB_PAGE)
	@cmake --preset release --log-level=WARNING >/dev/null
	$(SAY) "Building everything"
	@cmake --build --preset release --parallel $(JOBS)
	$(SAY) "Running all tests"
	@ctest --preset release --parallel $(JOBS) 2>&1 | tee build/release/ctest.log
	$(SAY) "Fuzzing for 20 seconds"
	@tools/fuzz.sh 20
	@$(MAKE) web-test
	$(SAY) "Summary: $$(grep -E 'tests passed' build/release/ctest.log); fuzzing found nothing; $(WEB_SUMMARY)"

$(WEB_PACKAGES): web/package-lock.json web/package.json web/.npmrc | deps-web
	$(SAY) "Installing the page's packages"
	@cd web && npm ci --no-audit --no-fund --loglevel=error
	@touch $@

$(WEB_PAGE): $(WEB_SOURCES) $(WEB_PACKAGES)
	$(SAY) "Building the page $@"
	@cd web && npm run --silent build

web: $(WEB_PAGE)

web-test: deps-web-test $(WEB_PAGE)
	$(SAY) "Testing the page"
	@cd web && npm run --silent check
	@cd web && { NO_COLOR=1 npm test --silent && NO_COLOR=1 npm run --silent test:page; } 2>&1 | tee ../build/web/test.log
	$(SAY) "Summary: $(WEB_SUMMARY)"

web-bench: deps-web-test $(WEB_PAGE)
	@cd web && npm run --silent benchmark

# $(call run_tests_of,preset)
define run_tests_of
	$(SAY) "Building the tests in build/$(1)"
	@cmake --build --preset $(1) --parallel $(JOBS)
	$(SAY) "Running all tests of build/$(1)"
	@ctest --preset $(1) --parallel $(JOBS)
endef

asan: build/asan-ubsan/build.ninja
	$(call run_tests_of,asan-ubsan)

tsan: build/tsan/build.ninja
	$(call run_tests_of,tsan)

fuzz: deps-fuzz
	$(SAY) "Fuzzing for $(SECONDS) seconds"
	@tools/fuzz.sh $(SECONDS)

bench: deps-bench build/release/build.ninja
	@cmake --preset release --log-level=WARNING >/dev/null
	$(SAY) "Building the benchmarks"
	@cmake --build --preset release --parallel $(JOBS)
	$(SAY) "Running the benchmarks"
	@shopt -s nullglob; programs=(build/release/benchmarks/*); \
	  if [[ $${#programs[@]} -eq 0 ]]; then echo "There are no benchmarks yet"; fi; \
	  for program in "$${programs[@]}"; do echo "$$program"; "$$program"; done

format: deps-lint
	$(SAY) "Laying out all C++ files"
	@find $(CPP_FOLDERS) -name '*.[ch]pp' -print0 | xargs -0 -r clang-format -i

format-check: deps-lint
	$(SAY) "Checking the layout of all C++ files"
	@find $(CPP_FOLDERS) -name '*.[ch]pp' -print0 | xargs -0 -r clang-format --dry-run --Werror

tidy: deps-lint build/dev/build.ninja
	$(SAY) "Checking all C++ files with clang-tidy"
	@find $(wildcard src apps tests) -name '*.cpp' -print0 | \
	  xargs -0 -r -n 1 -P $(JOBS) clang-tidy -p build/dev --quiet \
	    --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option

clean:
	$(SAY) "Deleting build/ and out/"
	@rm -rf build out
