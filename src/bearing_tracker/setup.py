# SPDX-License-Identifier: Apache-2.0
"""Everything stands in setup.cfg, which colcon and pip both read."""

from setuptools import setup

setup()
