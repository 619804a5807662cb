# Everything here runs in the project's own virtual environment, which `setup` makes.
VENV ?= .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.ready
NATIVE := $(shell find native -name '*.cpp' -o -name '*.hpp' -o -name '*.inc') CMakeLists.txt

.DEFAULT_GOAL := help
.PHONY: help setup build demo test test-slow test-long sanitize lint typecheck format conformance bench generate page page-check clean

help: ## what there is
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

$(STAMP): pyproject.toml scripts/make_venv.sh $(NATIVE)
	@VENV=$(VENV) sh scripts/make_venv.sh
	@touch $@

setup: $(STAMP) ## the virtual environment with everything in it, and the native core built

build: ## the native core again
	$(BIN)/python -m pip install --quiet --no-build-isolation --no-deps --editable .
	@touch $(STAMP)

demo: $(STAMP) ## the lab's moving transform tree, live in the terminal, spoken over DDS
	@$(BIN)/coframe demo $(ARGS)

test: $(STAMP) ## the test suite (under 6 minutes)
	$(BIN)/python -m pytest --numprocesses 2 --dist loadfile --no-loadscope-reorder $(ARGS)

$(VENV)/.oracle: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group oracle && touch $@ || \
		echo "test-slow: Pinocchio could not be installed from the package index; the tests beside it are skipped"

test-slow: $(STAMP) $(VENV)/.oracle ## the tests that take minutes
	$(BIN)/python -m pytest -m "slow and not long" $(ARGS)

test-long: $(STAMP) ## ten million random operations beside the real tf2, a new seed each time; ten minutes of a stuck tab
	$(BIN)/python -m pytest -m long -rP $(ARGS)

sanitize: ## the native core under ThreadSanitizer for a minute, and under AddressSanitizer, also with damaged messages
	@$(MAKE) -s -C tests/native thread address
	tests/native/sanitized.sh build/sanitize/thread/stress $(or $(ARGS),60)
	tests/native/sanitized.sh build/sanitize/address/stress 20
	tests/native/sanitized.sh build/sanitize/address/latest 10
	tests/native/sanitized.sh build/sanitize/address/fuzz_ingest 200000
	tests/native/sanitized.sh build/sanitize/address/fuzz_frozen 3000

conformance: $(STAMP) ## tf2's semantics, case by case
	@$(BIN)/python conformance/run.py $(ARGS)

lint: $(STAMP) ## style: ruff, and the generated messages are up to date
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/python scripts/generate_messages.py --check

typecheck: $(STAMP) ## mypy --strict, and the stub against the native module
	$(BIN)/mypy
	$(BIN)/mypy conformance/run.py
	$(BIN)/mypy -p benchmarks
	$(BIN)/python -m mypy.stubtest coframe._core --allowlist scripts/stubtest_allow.txt --mypy-config-file pyproject.toml

format: $(STAMP) ## mend what can be mended
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

$(VENV)/.bench: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group bench && touch $@ || \
		echo "bench: not all peers could be installed from the package index; rows beside them are skipped"

bench: $(VENV)/.bench ## coframe beside its peers, in one table; fails where a bar is not met
	@$(BIN)/python -E -m benchmarks $(ARGS)

generate: $(STAMP) ## message classes from interfaces/
	$(BIN)/python scripts/generate_messages.py

page: ## the viewer's page from viewer/ into src/coframe/viewer/static (needs Node.js and npm)
	cd viewer && npm ci --silent && npm run --silent build

page-check: ## the page's types and tests, and that what is committed is what its source makes
	cd viewer && npm ci --silent && npm run --silent check
	$(BIN)/python -m pytest -m slow tests/viewer/test_page_bytes.py

clean: ## what was built, and the virtual environment
	rm -rf build dist $(VENV) .mypy_cache .ruff_cache .pytest_cache .hypothesis
