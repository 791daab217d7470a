# make run    the operator's window on the simulated rig (without a display: the same test, headless)
# make test   everything: style, types, import rules, tests; make test TESTS=tests/storage tests only these
# make docs   guides and pages of the packages as a site in build/site; its links are checked
# make search random search for what breaks a property; it prints its seed, SEED=N repeats it
# make bench  performance as ratios, measured side by side in one run
# make single    build/rigapp.pex: the program as one file, for Linux with the Python that makes it
# make pictures   the pictures of README and guides, anew; needs Xvfb, openbox, xdotool, ImageMagick
# make translations   texts of the window into its catalogues (rigapp/gui/language/*.ts)
# make soak   the long tests: hours
PYTHON ?= $(shell for p in python3.11 python3.12 python3.13 python3; do \
	$$p -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null && { command -v $$p; break; }; done)
VENV := .venv
BIN := $(VENV)/bin
RUN_READY := $(VENV)/ready-run
TEST_READY := $(VENV)/ready-test
BENCH_READY := $(VENV)/ready-bench
DOCS_READY := $(VENV)/ready-docs
SINGLE_READY := $(VENV)/ready-single
SEED := $(or $(SEED),$(shell od -An -N4 -tu4 /dev/urandom | tr -d ' '))
RUN_EXTRAS := --extra gui --extra notify --extra page --extra publish --extra analysis --extra build
export QT_API = pyside6
export PIP_DISABLE_PIP_VERSION_CHECK = 1
# Hundreds of programs that the tests start shall not compile the source again, each for itself.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: run test pytest kernels lint audit hooks search bench long soak docs single lock pictures translations clean

run: kernels
	@$(BIN)/python -m rigapp.start

# Three workers on two cores: stories of whole rigs wait more than they compute. Each begins with a
# part of its own, so that most modules are tested by one worker, which makes their fixtures once; who
# is done takes work from the others. One file or folder is quicker without workers and without the
# checks of the whole source, which run beside the tests and are printed together when they end.
test: $(TEST_READY) kernels
	+@$(MAKE) --no-print-directory -j2 --output-sync=target $(if $(TESTS),,lint) pytest

pytest: $(TEST_READY)
	+$(BIN)/python -m pytest $(or $(TESTS),-n 3 --dist worksteal) -m "not soak and not long"

lint: audit $(TEST_READY)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

# Known advisories of what is locked, where a source of them can be reached.
audit:
	@if ! command -v pip-audit > /dev/null; then \
	echo "Advisories were not looked up: pip-audit is not installed (pipx install pip-audit)."; \
	else said=$$(pip-audit --disable-pip --require-hashes -r constraints.txt 2>&1); status=$$?; \
	echo "$$said"; case "$$said" in \
	*onnection*|*HTTPError*|*ServiceError*|*imed\ out*) \
	echo "Advisories were not looked up: no source of them answers.";; \
	*) exit $$status;; esac; fi

hooks: $(TEST_READY)
	$(BIN)/pre-commit install

docs: $(DOCS_READY) kernels
	rm -rf docs/api build/site
	$(BIN)/sphinx-build --quiet --fail-on-warning --keep-going -b html docs build/site
	@echo "open build/site/index.html"

search: $(TEST_READY) kernels
	@echo "make search SEED=$(SEED) repeats this search"
	$(BIN)/python -m pytest -n 2 -m "hypothesis and not soak and not long" --hypothesis-profile search --hypothesis-seed $(SEED)

bench: $(BENCH_READY) kernels
	$(BIN)/python -m benchmarks

# What a release is proved by, one to two hours: types of the other systems, notebooks, series of
# killed writers, every layout in every language.
long: $(TEST_READY) kernels
	$(BIN)/mypy --platform win32 --cache-dir .mypy_cache/win32
	$(BIN)/mypy --platform darwin --cache-dir .mypy_cache/darwin
	$(BIN)/python -m pytest -n 3 --dist worksteal -m long

soak: $(TEST_READY) kernels
	$(BIN)/python -m pytest -m soak

$(VENV)/bin/python:
	@test -n "$(PYTHON)" || { echo "rigapp needs Python 3.11, 3.12 or 3.13; install one, or name it: make PYTHON=/path/to/python"; exit 1; }
	@$(PYTHON) rigapp/prepare/system_libraries.py
	$(PYTHON) -m venv $(VENV)

$(RUN_READY): constraints.txt pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --require-hashes -r constraints.txt
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation -e .
	@touch $@

# What has changed since the last time is compiled here, and not while something runs.
kernels: $(RUN_READY)
	@$(BIN)/python -m rigapp.prepare.kernels

$(TEST_READY): constraints-test.txt $(RUN_READY)
	@$(BIN)/python rigapp/prepare/system_libraries.py --test
	$(BIN)/python -m pip install --quiet --require-hashes -r constraints-test.txt
	@touch $@

$(BENCH_READY): constraints-bench.txt $(TEST_READY)
	$(BIN)/python -m pip install --quiet --require-hashes -r constraints-bench.txt
	@touch $@

$(DOCS_READY): constraints-docs.txt $(RUN_READY)
	$(BIN)/python -m pip install --quiet --require-hashes -r constraints-docs.txt
	@touch $@

$(SINGLE_READY): constraints-single.txt $(RUN_READY)
	$(BIN)/python -m pip install --quiet --require-hashes -r constraints-single.txt
	@touch $@

single: $(SINGLE_READY)
	rm -rf build/single build/rigapp.pex
	$(BIN)/python -m pip wheel --quiet --no-deps --no-build-isolation -w build/single .
	sed -n 's/ *\\$$//; /^[A-Za-z]/p' constraints.txt > build/single/versions.txt
	$(BIN)/pex --use-pip-config --venv prepend --constraints build/single/versions.txt \
		--script rigapp --output-file build/rigapp.pex "$$(echo build/single/rigapp-*.whl)[gui,page,notify,publish,analysis]"

pictures: $(RUN_READY)
	$(BIN)/python docs/make_pictures.py

translations: $(RUN_READY)
	$(BIN)/python -m rigapp.gui.language.collect

# New versions of what pyproject.toml names; needs uv.
lock:
	uv pip compile pyproject.toml $(RUN_EXTRAS) --universal --python-version 3.11 \
		--generate-hashes --no-header --no-annotate --no-emit-index-url --quiet -o constraints.txt
	uv pip compile pyproject.toml $(RUN_EXTRAS) --extra studies --extra test --universal --python-version 3.11 \
		--generate-hashes --no-header --no-annotate --no-emit-index-url -c constraints.txt --quiet -o constraints-test.txt
	uv pip compile pyproject.toml $(RUN_EXTRAS) --extra studies --extra test --extra bench --universal --python-version 3.11 \
		--generate-hashes --no-header --no-annotate --no-emit-index-url -c constraints-test.txt --quiet -o constraints-bench.txt
	uv pip compile pyproject.toml --extra docs --universal --python-version 3.11 \
		--generate-hashes --no-header --no-annotate --no-emit-index-url -c constraints-test.txt --quiet -o constraints-docs.txt
	echo 'pex>=2.100' | uv pip compile - --universal --python-version 3.11 \
		--generate-hashes --no-header --no-annotate --no-emit-index-url --quiet -o constraints-single.txt

clean:
	rm -rf $(VENV) build dist docs/api *.egg-info .mypy_cache .ruff_cache .pytest_cache .import_linter_cache
