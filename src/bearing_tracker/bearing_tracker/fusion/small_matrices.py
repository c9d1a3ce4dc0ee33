# SPDX-License-Identifier: Apache-2.0
"""Algebra of very many very small matrices.

A library call for each 2 x 2 matrix costs far more than its arithmetic. Sums of products over whole arrays do not, and
they are quickest where the targets' axis, the first one, lies innermost in memory (Fortran's order); numpy then keeps
that order in its results. All arrays are (..., rows, columns) and their leading axes broadcast.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def product(left: FloatArray, right: FloatArray) -> FloatArray:
    """Multiply matrices.

    Args:
        left: A, shape (..., i, j).
        right: B, shape (..., j, k).

    Returns:
        A B, shape (..., i, k).
    """
    return np.einsum("...ij,...jk->...ik", left, right)


def product_transposed(left: FloatArray, right: FloatArray) -> FloatArray:
    """Multiply matrices by transposed ones.

    Args:
        left: A, shape (..., i, j).
        right: B, shape (..., k, j).

    Returns:
        A B', shape (..., i, k).
    """
    return np.einsum("...ij,...kj->...ik", left, right)


def apply(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Multiply vectors by matrices.

    Args:
        matrix: A, shape (..., i, j).
        vector: x, shape (..., j).

    Returns:
        A x, shape (..., i).
    """
    return np.einsum("...ij,...j->...i", matrix, vector)


def congruence(matrix: FloatArray, covariance: FloatArray) -> FloatArray:
    """Covariance of A x.

    Args:
        matrix: A, shape (..., i, j).
        covariance: P of x, shape (..., j, j).

    Returns:
        A P A', shape (..., i, i).
    """
    return product_transposed(product(matrix, covariance), matrix)


def symmetrised(matrix: FloatArray) -> FloatArray:
    """Take rounding out of what should be symmetric.

    Args:
        matrix: A, shape (..., i, i).

    Returns:
        (A + A') / 2.
    """
    half: FloatArray = 0.5 * (matrix + np.swapaxes(matrix, -1, -2))
    return half


def cholesky(matrix: FloatArray) -> FloatArray:
    """Lower triangular factors, by the Cholesky-Banachiewicz rows; a loop over rows only.

    Args:
        matrix: A, symmetric and positive definite, shape (..., i, i).

    Returns:
        L with L L' = A, shape as A.

    Raises:
        ValueError: a matrix is not positive definite.
    """
    factor = np.zeros_like(matrix)
    for row in range(matrix.shape[-1]):
        for column in range(row + 1):
            rest = matrix[..., row, column] - np.einsum(
                "...k,...k->...", factor[..., row, :column], factor[..., column, :column]
            )
            if row > column:
                factor[..., row, column] = rest / factor[..., column, column]
            elif (rest > 0.0).all():
                factor[..., row, row] = np.sqrt(rest)
            else:
                raise ValueError("a covariance is not positive definite")
    return factor


def solve_lower(factor: FloatArray, right: FloatArray) -> FloatArray:
    """Solve by forward substitution.

    Args:
        factor: L, lower triangular, shape (..., i, i).
        right: B, shape (..., i, k).

    Returns:
        X with L X = B, shape (..., i, k).
    """
    solution = np.zeros_like(right)
    for row in range(factor.shape[-1]):
        known = np.einsum("...j,...jk->...k", factor[..., row, :row], solution[..., :row, :])
        solution[..., row, :] = (right[..., row, :] - known) / factor[..., row, row, None]
    return solution


def solve_lower_transposed(factor: FloatArray, right: FloatArray) -> FloatArray:
    """Solve by backward substitution.

    Args:
        factor: L, lower triangular, shape (..., i, i).
        right: B, shape (..., i, k).

    Returns:
        X with L' X = B, shape (..., i, k).
    """
    solution = np.zeros_like(right)
    for row in reversed(range(factor.shape[-1])):
        later = slice(row + 1, None)
        known = np.einsum("...j,...jk->...k", factor[..., later, row], solution[..., later, :])
        solution[..., row, :] = (right[..., row, :] - known) / factor[..., row, row, None]
    return solution
