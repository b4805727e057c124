# Everything runs from .venv, which is made here. Python: make PYTHON=/path/to/python3.12 (3.11 or newer).

PYTHON ?= $(shell for python in python3 python3.14 python3.13 python3.12 python3.11; do \
    $$python -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$python && break; done)
WERROR ?= $(if $(CI),ON,OFF)
# What is looked for beside a compiler, Eigen and SUNDIALS: asked for at once, so that it is one line to install.
SYSTEM_EXTRAS := $(if $(filter test lint sanitize,$(MAKECMDGOALS)),doctest)

# Of make fuzz: how many cases, and the seed that makes them.
CASES ?= 20000
SEED ?= 1

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
VENV := .venv
BIN := $(CURDIR)/$(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
CPP_DIRECTORIES := $(wildcard cpp python/bindings tests/cpp bench/cpp)
CPP_FILES = $(shell find $(CPP_DIRECTORIES) -name '*.cpp' -o -name '*.hpp')
CMAKE_FILES := CMakeLists.txt $(shell find $(CPP_DIRECTORIES) python/CMakeLists.txt -name CMakeLists.txt -o -name '*.cmake')
export PIP_ROOT_USER_ACTION := ignore

# $(call requirements,EXTRA): install what pyproject.toml lists under that extra; "build" is what building needs.
requirements = $(BIN)/python -c 'import sys, tomllib; \
    project = tomllib.load(open("pyproject.toml", "rb")); \
    extras = project["project"]["optional-dependencies"] | {"build": project["build-system"]["requires"]}; \
    print(*extras["$(1)"], sep="\n")' | $(PIP) install -r /dev/stdin
# $(call engine,CPP_TESTS,EXTRAS): build the extension and install the package, which stays editable.
engine = $(PIP) install --no-build-isolation --config-settings=cmake.define.PROBATION_CPP_TESTS=$(1) \
    --config-settings=cmake.define.PROBATION_WERROR=$(WERROR) -e '.$(2)'
# $(call configure,FOLDER): what cmake makes of this folder with the C++ tests; further options follow.
configure = $(BIN)/cmake -G Ninja -DCMAKE_MAKE_PROGRAM=$(BIN)/ninja -S . -B $(1) --log-level=WARNING \
    -DPROBATION_CPP_TESTS=ON -DPython_EXECUTABLE=$(BIN)/python -Dpybind11_DIR="$$($(BIN)/python -m pybind11 --cmakedir)"

.DEFAULT_GOAL := help
.PHONY: help demo test docs pictures fuzz bench fe blind lint format sanitize wheel clean

help:  ## list the targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

demo: $(VENV)/.engine  ## install what is missing, build, and identify the law on embedded experiments
	@$(BIN)/probation demo

test: $(VENV)/.engine-tests  ## install what is missing, build, run the C++ and the Python tests
	@$(BIN)/ctest --test-dir build/editable --output-on-failure --no-tests=error
	@# A process per core, files kept together: what a file computes once, it computes once.
	@OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n auto --dist loadfile --no-loadscope-reorder \
	    --cov=probation --cov=probation_studies --cov-report=term:skip-covered --cov-fail-under=90

docs: $(VENV)/.engine $(VENV)/.docs  ## build the site into build/docs/html, open it in a browser; fails at a warning
	@OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/sphinx-build -W --keep-going --quiet -b html docs build/docs/html
	@PYTHONPATH="$(CURDIR)/tests" $(BIN)/python -m site_pages build/docs/html
	@echo "docs: build/docs/html/index.html"

pictures: $(VENV)/.engine  ## draw the README's pictures anew, into docs/pictures
	@$(BIN)/python docs/pictures.py

fuzz: $(VENV)/.engine-tests  ## read CASES=20000 damaged and hostile files (SEED=1) on all cores; keeps those that fail
	@PYTHONPATH="$(CURDIR)/tests" $(BIN)/python -m fuzz --cases $(CASES) --seed $(SEED)

bench: $(VENV)/.engine $(VENV)/.bench  ## compare the schemes with what one would use instead
	@$(BIN)/python bench/run.py

fe: $(VENV)/.engine  ## run the law in CalculiX: an element, a turned one, a neck; builds a ccx where none can load it
	@[ -n "$${CCX:-}" ] || $(BIN)/python -m probation.fe.calculix which >/dev/null 2>&1 || .ci/calculix $(BIN)/python
	@mkdir -p build/fe
	@echo "fe: $$($(BIN)/python -m probation.fe.calculix which)"
	@$(BIN)/python -m probation.fe.calculix element
	@$(BIN)/python -m probation.fe.calculix turn
	@echo "fe: pulling the dumbbell, half a minute of one core"
	@$(BIN)/python -m probation.fe.calculix neck --plot build/fe/neck.png
	@echo "fe: drew build/fe/neck.png"

blind: $(VENV)/.engine  ## make, solve and score a small sealed split; fails beyond the thresholds of tests/blind
	@rm -rf build/blind
	@$(BIN)/probation blind make --seed 21 --count 40 --out build/blind
	@$(BIN)/probation blind solve build/blind
	@$(BIN)/probation blind score build/blind --report build/blind/score.html --require tests/blind/thresholds.json

lint: $(VENV)/.engine-tests $(VENV)/.lint  ## ruff, mypy, clang-format, clang-tidy
	@$(BIN)/ruff check --quiet .
	@$(BIN)/ruff format --check --quiet .
	@$(BIN)/mypy
	@$(BIN)/clang-format --dry-run -Werror $(CPP_FILES)
	@# How every file is compiled by itself; nothing is built there.
	@$(call configure,build/tidy) -DCMAKE_UNITY_BUILD=OFF
	@printf '%s\n' $(filter-out bench/% tests/cpp/consumer/%,$(filter %.cpp,$(CPP_FILES))) | xargs -P "$$(nproc)" -n 1 \
	    $(BIN)/clang-tidy -p build/tidy --quiet --extra-arg=-Wno-unknown-warning-option \
	    --extra-arg=-Wno-ignored-optimization-argument \
	    >build/clang-tidy.log 2>&1 || { grep -E -A4 '(warning|error):' build/clang-tidy.log; exit 1; }
	@echo "lint: clean"

format: $(VENV)/.lint  ## rewrite the sources as lint wants them
	@$(BIN)/ruff check --fix --quiet . || true
	@$(BIN)/ruff format --quiet .
	@$(BIN)/clang-format -i $(CPP_FILES)

sanitize: $(VENV)/.engine-tests  ## C++ tests, tests/boundary and tests/verification under address and undefined-behaviour sanitizers
	@$(call configure,build/sanitize) -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO='-O1 -g' \
	    -DPROBATION_SANITIZE=ON -DPROBATION_WERROR=$(WERROR)
	@$(BIN)/cmake --build build/sanitize
	@$(BIN)/ctest --test-dir build/sanitize --output-on-failure --no-tests=error
	@rm -rf build/sanitize/site && mkdir -p build/sanitize/site
	@cp -r python/probation python/probation_studies build/sanitize/site/
	@$(BIN)/cmake --install build/sanitize --prefix build/sanitize/site >/dev/null
	@# -S: without the hook of the editable installation, which would find the ordinary extension first.
	@site=$$($(BIN)/python -c 'import sysconfig; print(sysconfig.get_path("platlib"))'); \
	export PYTHONPATH="$(CURDIR)/build/sanitize/site:$$site" ASAN_OPTIONS=detect_leaks=0 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1; \
	preload="$$(c++ -print-file-name=libasan.so) $$(c++ -print-file-name=libubsan.so) $$(c++ -print-file-name=libstdc++.so)"; \
	printf '%s\n' $(wildcard tests/boundary/test_*.py tests/verification/test_*.py) | xargs -P "$$(nproc)" -n 3 \
	    env LD_PRELOAD="$$preload" $(BIN)/python -S -m pytest -q -p no:cacheprovider --capture=sys

wheel: $(VENV)/.tools $(VENV)/.wheel  ## build dist/*.whl and check that it needs nothing from the machine
	@rm -rf build/wheel dist && mkdir -p build/wheel
	@$(PIP) wheel --no-deps --wheel-dir build/wheel .
	@$(BIN)/auditwheel -v show build/wheel/*.whl 2>/dev/null | tee build/wheel/auditwheel.txt
	@grep -q 'manylinux_[0-9_]*' build/wheel/auditwheel.txt || { echo "wheel: not a manylinux wheel" >&2; exit 1; }
	@tr '\n' ' ' <build/wheel/auditwheel.txt | grep -q 'requires no external shared libraries' || \
	    { echo "wheel: needs a library that does not come with it" >&2; exit 1; }
	@PATH="$(BIN):$$PATH" $(BIN)/auditwheel repair --wheel-dir dist build/wheel/*.whl >build/wheel/repair.txt 2>&1 || \
	    { cat build/wheel/repair.txt; exit 1; }
	@$(BIN)/python -m venv build/wheel/venv
	@build/wheel/venv/bin/python -m pip --disable-pip-version-check --quiet install dist/*.whl
	@# Without an extra: fit, certify and diagnose, their tables and pages.
	@cd build/wheel && venv/bin/probation demo --out demo >demo.txt
	@cd build/wheel && venv/bin/python -c 'import probation; print("wheel: probation", probation.__version__, "runs the demo")'
	@ls dist/*.whl

clean:  ## remove everything that was made here, .venv too
	rm -rf build dist docs/built $(VENV) compile_commands.json .pytest_cache .mypy_cache .ruff_cache .hypothesis .coverage
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

$(VENV)/.tools: pyproject.toml
	@[ -n "$(PYTHON)" ] && $(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	    echo "probation: needs Python 3.11 or newer, as in: make PYTHON=/path/to/python3.11" >&2; exit 1; }
	@.ci/system $(PYTHON) $(SYSTEM_EXTRAS)
	@[ -x $(BIN)/python ] || { echo "probation: making $(VENV)"; $(PYTHON) -m venv $(VENV); }
	@$(call requirements,build)
	@$(PIP) install cmake ninja
	@touch $@

$(VENV)/.engine: $(VENV)/.tools $(CPP_FILES) $(CMAKE_FILES)
	@echo "probation: building the engine"
	@$(call engine,OFF,)
	@touch $@

$(VENV)/.engine-tests: $(VENV)/.tools $(CPP_FILES) $(CMAKE_FILES)
	@.ci/system $(PYTHON) doctest
	@echo "probation: building the engine and its tests"
	@$(call engine,ON,[test])
	@touch $(VENV)/.engine $@

$(VENV)/.lint $(VENV)/.bench $(VENV)/.docs $(VENV)/.wheel: $(VENV)/.%: $(VENV)/.tools
	@$(call requirements,$*)
	@touch $@
