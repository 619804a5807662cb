# SPDX-License-Identifier: Apache-2.0
# Every target runs in the project's own virtual environment and creates it when it is missing.
VENV ?= .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.ready
DEMO_STAMP := $(VENV)/.demo_ready
LINT_STAMP := $(VENV)/.lint_ready
NATIVE := $(shell find native -name '*.cpp' -o -name '*.hpp' -o -name '*.inc') CMakeLists.txt
# For scripts that need the standard library only.
ANY_PYTHON = $(if $(wildcard $(BIN)/python),$(BIN)/python,python3)

# Many processes import the same modules, so these are compiled once; the files are not next to the sources. The processes
# share the cores, so NumPy uses one thread in each.
PYTEST := env -u PYTHONDONTWRITEBYTECODE PYTHONPYCACHEPREFIX=$(CURDIR)/build/pycache OPENBLAS_NUM_THREADS=1 \
	$(BIN)/python -m pytest

# build-system.requires of pyproject.toml.
BUILD_TOOLS = $(shell sed -n 's/^requires = \[\(.*\)\]/\1/p' pyproject.toml | sed 's/", "/" "/g')

.DEFAULT_GOAL := help
.PHONY: help setup build build-split demo test test-browser test-zenoh test-fastdds test-shared test-slow test-arm test-long test-ros test-ros-wheels sanitize sanitize-suite fuzz faults soak docs lint licenses audit typecheck format conformance bench generate generate-check pictures page page-check clean

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-18s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

# The demo needs a quarter of what the tests need, so it has a set-up of its own. Either one builds the native core.
$(DEMO_STAMP): pyproject.toml scripts/make_venv.sh $(NATIVE)
	@[ -e $(STAMP) ] || VENV=$(VENV) sh scripts/make_venv.sh demo
	@[ ! -e $(STAMP) ] || VENV=$(VENV) sh scripts/make_venv.sh dev
	@[ ! -e $(STAMP) ] || touch $(STAMP)
	@touch $@

$(STAMP): pyproject.toml scripts/make_venv.sh $(NATIVE)
	@VENV=$(VENV) sh scripts/make_venv.sh dev
	@touch $(DEMO_STAMP) $@

# The linters read the sources and need nothing that is compiled.
$(LINT_STAMP): pyproject.toml scripts/make_venv.sh
	@[ -e $(STAMP) ] || VENV=$(VENV) sh scripts/make_venv.sh lint
	@touch $@

setup: $(STAMP) ## create the virtual environment with everything in it, and build the native core

$(VENV)/.build_tools: pyproject.toml
	@$(BIN)/python -m pip install --quiet $(BUILD_TOOLS) && touch $@

build: $(VENV)/.build_tools ## rebuild the native core, and coframe-fastdds where it is installed
	$(BIN)/python -m pip install --quiet --no-build-isolation --no-deps --editable .
	@VENV=$(VENV) sh scripts/install_fastdds.sh --again
	@touch $(DEMO_STAMP) $(STAMP)

build-split: $(STAMP) ## compile each source file of the native core separately, which reveals missing includes
	$(BIN)/python -m pip wheel --quiet --no-build-isolation --no-deps --wheel-dir build/split/wheel \
		--config-settings=build-dir=build/split --config-settings=cmake.define.COFRAME_UNITY=OFF .

demo: $(DEMO_STAMP) ## show the lab's moving transform tree, live in the browser and the terminal
	@$(BIN)/coframe demo $(ARGS)

test: $(STAMP) ## run the test suite (six to seven minutes on two cores)
	$(PYTEST) --numprocesses 6 --dist loadfile --no-loadscope-reorder $(ARGS)

test-browser: $(STAMP) ## run the tests that look at the viewer's page in Chromium (four minutes on two cores)
	$(PYTEST) -m "browser and not slow" --numprocesses 4 --dist loadfile tests/viewer/browser $(ARGS)

test-zenoh: $(STAMP) ## run the tests of the running graph over Zenoh instead of DDS (those of routers configure Zenoh themselves)
	COFRAME_WIRE=zenoh $(PYTEST) --numprocesses 2 --dist loadfile --no-loadscope-reorder \
		--ignore tests/wire/test_router.py --ignore tests/wire/test_wan.py \
		tests/wire tests/rclpy tests/tf2 tests/recorder tests/lab tests/viewer $(ARGS)

FASTDDS_TESTS ?= tests/fastdds tests/wire tests/rclpy tests/tf2 tests/recorder tests/lab tests/viewer

test-fastdds: $(STAMP) ## run the tests of the running graph over Fast DDS instead of Cyclone DDS, or FASTDDS_TESTS
	COFRAME_WIRE=fastdds $(PYTEST) --numprocesses 2 --dist loadfile --no-loadscope-reorder \
		--ignore tests/wire/test_router.py --ignore tests/wire/test_wan.py $(FASTDDS_TESTS) $(ARGS)

test-shared: $(STAMP) ## run the tests of programs that use tf2_ros with transforms that processes share (Linux)
	COFRAME_SHARED=1 $(PYTEST) --numprocesses 2 --dist loadfile --no-loadscope-reorder \
		tests/tf2 tests/rclpy tests/packages tests/lab tests/doctor tests/process $(ARGS)

$(VENV)/.oracle: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group oracle && touch $@ || \
		echo "test-slow: the package index does not provide Pinocchio; tests that compare with it are skipped"

$(VENV)/.installers: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group installers && touch $@

$(VENV)/.stores: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group stores && touch $@

test-slow: $(STAMP) $(VENV)/.oracle $(VENV)/.stores $(VENV)/.installers $(VENV)/.docs ## run the tests that take minutes
	$(PYTEST) -m "slow and not long" $(ARGS)

test-arm: $(STAMP) ## cross-compile the wheel for 64-bit ARM and test it there, emulated, in a root of Debian below build/ (Linux 6.7 or newer)
	$(BIN)/python -m scripts.arm $(ARGS)

test-ros: $(STAMP) ## run programs with the sourced ROS 2 and with coframe, and compare their outputs
	COFRAME_TEST_ROS=1 $(PYTEST) -p no:launch_testing -p no:launch_testing_ros_pytest_entrypoint tests/interop tests/course/test_sourced_ros.py -v $(ARGS)

test-ros-wheels: $(STAMP) ## print what works beside rclpy and Fast DDS of ROS 2 Jazzy and Kilted, which pip installs into build/ros_wheels, and grade the lab there
	$(BIN)/python -m scripts.ros_wheels $(ARGS)

test-long: $(STAMP) ## compare ten million random operations with the real tf2 (a new seed each run); ten minutes with a stuck tab; a class of 36
	$(PYTEST) -m long -rP $(ARGS)

sanitize: ## run the native core under ThreadSanitizer and AddressSanitizer, with damaged messages and dying writers
	@$(MAKE) -s -C tests/native thread address plain
	tests/native/sanitized.sh build/sanitize/thread/stress $(or $(ARGS),60)
	tests/native/sanitized.sh build/sanitize/thread/shared_stress 20
	build/sanitize/plain/crash
	build/sanitize/explored/explore
	build/sanitize/plain/kill_writer 100
	tests/native/sanitized.sh build/sanitize/address/stress 20
	tests/native/sanitized.sh build/sanitize/address/latest 10
	tests/native/sanitized.sh build/sanitize/address/fuzz_ingest 200000
	tests/native/sanitized.sh build/sanitize/address/fuzz_frozen 3000

sanitize-suite: $(STAMP) ## run the test suite with AddressSanitizer and UndefinedBehaviorSanitizer in the native module
	tests/native/sanitized_suite.sh $(ARGS)

$(VENV)/.fuzz: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group fuzz && touch $@ || \
		echo "fuzz: the package index does not provide atheris; targets in Python are skipped"

fuzz: $(VENV)/.fuzz ## run coverage-guided fuzzing of all decoders and readers for SECONDS=60 in total; ARGS selects targets
	$(BIN)/python tests/fuzz/run.py --seconds $(or $(SECONDS),60) $(ARGS)

faults: $(STAMP) ## cause faults between real processes, and check what docs/reliability.md promises (20 minutes)
	@$(BIN)/python -E -m benchmarks.faults $(ARGS)

soak: $(STAMP) ## run 20 nodes, recorder, viewer and doctor for 30 minutes: nothing may grow
	@$(BIN)/python -E -m benchmarks.soak $(ARGS)

$(VENV)/.docs: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group docs && touch $@

docs: $(VENV)/.docs ## build the documentation site into build/site and check its links; warnings are errors
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --quiet
	@$(BIN)/python scripts/site/check_links.py build/site

conformance: $(STAMP) ## check tf2's semantics case by case
	@$(BIN)/python conformance/run.py $(ARGS)

lint: $(LINT_STAMP) ## check style, words, licenses of files, references to files and import directions
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	git ls-files '*.cpp' '*.hpp' '*.inc' | xargs $(BIN)/clang-format --dry-run --Werror
	$(BIN)/python scripts/check_words.py
	$(BIN)/python scripts/check_spdx.py
	$(BIN)/python scripts/check_paths.py
	$(BIN)/python scripts/check_imports.py

generate-check: $(STAMP) ## check that generated files are what their generators write
	$(BIN)/python scripts/generate_messages.py --check
	$(BIN)/python scripts/generate_distributions.py --check
	$(BIN)/python scripts/generate_protocol.py --check

licenses: $(STAMP) ## check the licenses of all packages that coframe[all] installs
	$(BIN)/python scripts/check_licenses.py

$(VENV)/.audit: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group audit && touch $@

audit: $(VENV)/.audit ## compare the versions of all packages with published vulnerabilities; needs a database on the Internet
	@mkdir -p build; $(BIN)/python -m pip_audit --skip-editable --progress-spinner off >build/audit.txt 2>&1; \
		status=$$?; cat build/audit.txt; ! grep -q "could not be audited" build/audit.txt || \
		{ echo "audit: the database does not know these packages, or cannot be reached: nothing is proven"; exit 1; }; \
		exit $$status

typecheck: $(STAMP) ## run mypy --strict, and compare the stub with the native module
	$(BIN)/mypy
	$(BIN)/mypy conformance/run.py
	$(BIN)/mypy -p benchmarks
	$(BIN)/python -m mypy.stubtest coframe._core --allowlist scripts/stubtest_allow.txt --mypy-config-file pyproject.toml

format: $(STAMP) ## format the sources
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	git ls-files '*.cpp' '*.hpp' '*.inc' | xargs $(BIN)/clang-format -i

$(VENV)/.bench: pyproject.toml | $(STAMP)
	@$(BIN)/python -m pip install --quiet "pip>=25.1" && $(BIN)/python -m pip install --quiet --group bench && touch $@ || \
		echo "bench: the package index does not provide every peer; rows that need a missing one are skipped"

bench: $(VENV)/.bench ## compare coframe with its peers in one table; fail when a target is missed
	@$(BIN)/python -E -m benchmarks $(ARGS)

.PHONY: wheels sdist test-root test-free-threaded release-check
wheels: ## build, repair and test wheels into dist/: PYTHONS="python3.12 /path/to/python", default: all found; ARGS="--machine aarch64"
	$(ANY_PYTHON) scripts/wheels.py $(ARGS) $(PYTHONS)

sdist: ## build the source distribution into dist/
	$(ANY_PYTHON) scripts/wheels.py --sdist

test-root: ## install dist/ in an empty Debian root and run the installed-package tests there: ARGS="--sdist --suite sid" (needs root)
	VENV=$(VENV) sh scripts/test_in_root.sh $(ARGS) $(PYTHONS)

test-free-threaded: ## build CPython without the GIL, run tests of coframe with it and measure two threads: PYTHONS=/path/to/python3.14t skips the first
	scripts/free_threaded.sh $(PYTHONS)

release-check: ## check what is in dist/: metadata, sizes, licenses of bundled parts, links, changelog
	$(ANY_PYTHON) scripts/release_check.py

generate: $(STAMP) ## generate the message classes from interfaces/, the page about distributions, and the page's side of the viewer's protocol
	$(BIN)/python scripts/generate_messages.py
	$(BIN)/python scripts/generate_distributions.py
	$(BIN)/python scripts/generate_protocol.py

pictures: $(STAMP) ## draw all pictures of the documentation again (needs Chromium; ARGS="gallery" draws some)
	$(BIN)/python scripts/pictures.py $(ARGS)

page: ## build the viewer's page from viewer/ into src/coframe/viewer/static (needs Node.js and npm)
	cd viewer && npm ci --silent && npm run --silent build

page-check: ## check the page's types and tests, and that the committed page is what its source builds
	cd viewer && npm ci --silent && npm run --silent check
	$(PYTEST) -m slow tests/viewer/test_page_bytes.py

clean: ## delete build results and the virtual environment
	rm -rf build dist $(VENV) .mypy_cache .ruff_cache .pytest_cache .hypothesis
