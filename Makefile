# Each target does its own set-up in .venv; Python 3.11 to 3.13 and make are all it takes.

PYTHON ?= $(firstword $(foreach v,3.12 3.11 3.13,$(if $(shell python$(v) -c 'import ensurepip' 2>/dev/null && echo yes),python$(v))) python3)
VENV := .venv
BIN := $(VENV)/bin
ROS_PACKAGES := radar_common radar_sim primary_proc secondary_proc bearing_tracker radar_eval
INSTALLED := $(VENV)/installed
WORKERS ?= 2

.PHONY: setup demo test lint types unit bench study parameters clean

setup: $(INSTALLED)

$(INSTALLED): requirements-dev.txt $(wildcard src/*/setup.cfg) src/ros2_embedded/pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --upgrade pip
	PYTHONWARNINGS=ignore $(BIN)/pip install --quiet -r requirements-dev.txt -e src/ros2_embedded $(ROS_PACKAGES:%=-e src/%)
	touch $@

demo: setup
	$(BIN)/ros2 run radar_eval demo --out out/demo

test: lint types unit

lint: setup
	$(BIN)/ruff check
	$(BIN)/ruff format --check

types: setup
	$(BIN)/mypy

unit: setup
	$(BIN)/pytest --numprocesses $(WORKERS)

bench: setup
	$(BIN)/pytest bench --benchmark-columns=min,median,rounds --benchmark-group-by=group

study: setup
	$(BIN)/pytest -m study
	HYPOTHESIS_PROFILE=explore $(BIN)/pytest --numprocesses $(WORKERS)

parameters: setup
	$(BIN)/python docs/make_parameters.py

clean:
	rm -rf $(VENV) out ros2_ws/build ros2_ws/install ros2_ws/log .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -prune -exec rm -rf {} +
