# SPDX-License-Identifier: Apache-2.0
"""The commands, each a thin layer of arguments and text over the modules that do the work."""
