# Two commands to know: `make demo` and `make test`. Each sets up what it needs in .venv, with nothing but Python.
PYTHON ?= python3
VENV ?= .venv
BIN = $(VENV)/bin

.PHONY: demo test lint types layers check bench docs clean

demo: $(VENV)/ready
	$(BIN)/ucrit analyze caravan --report caravan.html
	@echo "Open caravan.html in a browser for the pictures and the derivation."

test: $(VENV)/ready
	@$(BIN)/python tools/browser.py
	$(BIN)/python -m pytest -n 2

lint: $(VENV)/ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/ready
	$(BIN)/mypy

layers: $(VENV)/ready
	$(BIN)/lint-imports

check: lint types layers

bench: $(VENV)/ready
	$(BIN)/python -m benchmarks

# The pages of docs, the gallery of examples and the reference, as HTML that opens from disk.
docs: $(VENV)/ready
	$(BIN)/python docs/site/build.py
	@echo "Open build/docs/html/index.html in a browser."

clean:
	rm -rf $(VENV)

# The environment is made anew when the lock or the project's metadata change.
$(VENV)/ready: requirements.lock pyproject.toml tools/setup.py
	$(PYTHON) tools/setup.py $(VENV)
	@touch $@
