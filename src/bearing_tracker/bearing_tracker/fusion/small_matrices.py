# SPDX-License-Identifier: Apache-2.0
"""Algebra of very many very small matrices.

A library call for each 2 x 2 matrix costs far more than its arithmetic. Sums of products of whole arrays do not, where
the targets lie innermost in memory, and they are three times as quick as einsum. Therefore components come first: a
matrix per hypothesis and target has shape (rows, columns, M, n), a vector (rows, M, n); M and n may be 1 and broadcast.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def product(left: FloatArray, right: FloatArray) -> FloatArray:
    """Multiply matrices.

    Args:
        left: A, shape (i, j, ...).
        right: B, shape (j, k, ...).

    Returns:
        A B, shape (i, k, ...).
    """
    total: FloatArray = left[:, 0, None] * right[None, 0]
    for inner in range(1, len(right)):
        total += left[:, inner, None] * right[None, inner]
    return total


def product_transposed(left: FloatArray, right: FloatArray) -> FloatArray:
    """Multiply matrices by transposed ones.

    Args:
        left: A, shape (i, j, ...).
        right: B, shape (k, j, ...).

    Returns:
        A B', shape (i, k, ...).
    """
    return product(left, right.swapaxes(0, 1))


def apply(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Multiply vectors by matrices.

    Args:
        matrix: A, shape (i, j, ...).
        vector: x, shape (j, ...).

    Returns:
        A x, shape (i, ...).
    """
    return product(matrix, vector[:, None])[:, 0]


def congruence(matrix: FloatArray, covariance: FloatArray) -> FloatArray:
    """Covariance of A x.

    Args:
        matrix: A, shape (i, j, ...).
        covariance: P of x, shape (j, j, ...).

    Returns:
        A P A', shape (i, i, ...).
    """
    return product_transposed(product(matrix, covariance), matrix)


def symmetrised(matrix: FloatArray) -> FloatArray:
    """Take rounding out of what should be symmetric.

    Args:
        matrix: A, shape (i, i, ...).

    Returns:
        (A + A') / 2.
    """
    half: FloatArray = 0.5 * (matrix + matrix.swapaxes(0, 1))
    return half


def cholesky(matrix: FloatArray) -> FloatArray:
    """Lower triangular factors, row by row.

    Args:
        matrix: A, symmetric and positive definite, shape (i, i, ...).

    Returns:
        L with L L' = A, shape as A.

    Raises:
        ValueError: a matrix is not positive definite.
    """
    factor = np.zeros_like(matrix)
    for row in range(len(matrix)):
        for column in range(row + 1):
            rest = matrix[row, column] - (factor[row, :column] * factor[column, :column]).sum(0)
            if row > column:
                factor[row, column] = rest / factor[column, column]
            elif (rest > 0.0).all():
                factor[row, row] = np.sqrt(rest)
            else:
                raise ValueError("a covariance is not positive definite")
    return factor


def solve_lower(factor: FloatArray, right: FloatArray) -> FloatArray:
    """Solve by forward substitution.

    Args:
        factor: L, lower triangular, shape (i, i, ...).
        right: B, shape (i, k, ...).

    Returns:
        X with L X = B, shape (i, k, ...).
    """
    solution = np.empty_like(right)
    for row in range(len(factor)):
        known = (factor[row, :row, None] * solution[:row]).sum(axis=0)
        solution[row] = (right[row] - known) / factor[row, row]
    return solution


def solve_lower_transposed(factor: FloatArray, right: FloatArray) -> FloatArray:
    """Solve by backward substitution.

    Args:
        factor: L, lower triangular, shape (i, i, ...).
        right: B, shape (i, k, ...).

    Returns:
        X with L' X = B, shape (i, k, ...).
    """
    solution = np.empty_like(right)
    for row in reversed(range(len(factor))):
        known = (factor[row + 1 :, row, None] * solution[row + 1 :]).sum(axis=0)
        solution[row] = (right[row] - known) / factor[row, row]
    return solution
