"""What was measured and what the theory says, by method, restitution and N; continuations."""

from functools import lru_cache
from pathlib import Path

import numpy as np

from jdsmc import Estimate, Result
from jdsmc.theory import langevin

from ..case import Measurements
from ..numbers import Fit, mean
from ..paper import Paper
from . import cases
from .cases import METHODS

ORDERS = {"linear": 1, "quadratic": 2}
"""Polynomials in 1/N; the paper's is linear."""


class Noise(Measurements):
    """All results of a run of this experiment, by the name of their case."""

    def __init__(self, size, folder: Path, fresh: bool = False):
        super().__init__(size, cases.cases(size), folder, fresh)
        self.degree = size.degree or None
        self.studied = float(size.studied[0]), int(size.studied[1])

    def numbers(self, method: str, alpha: float) -> list[int]:
        """N that were run."""
        return sorted(n for a, n, _ in getattr(self.size, method) if a == alpha)

    def restitutions(self, method: str = "dynamics") -> list[float]:
        """Those that were run, from the smallest on."""
        return sorted({float(row[0]) for row in getattr(self.size, method)})

    def both(self) -> list[tuple[float, int]]:
        """(restitution, N) that were run with both methods."""
        first, second = ({(a, n) for a, n, _ in getattr(self.size, m)} for m in METHODS)
        return sorted(first & second)

    def result(self, method: str, alpha: float, number: int) -> Result:
        """One simulation."""
        return self.results[cases.case_name(method, alpha, number)]

    def value(self, method: str, alpha: float, number: int, name: str) -> Estimate:
        """A steady value."""
        return self.result(method, alpha, number)[name]

    def coarse(self) -> dict[tuple[float, int], Result]:
        """Simulations by the real disks of a cell (0: one cell) and the copies."""
        rows = [(per_cell, copies) for per_cell, copies, *_ in self.size.coarse]
        return {row: self.results[cases.coarse_name(*row)] for row in rows}

    def theory(self, alpha: float, number: float) -> langevin.TransverseMode:
        """The deterministic values at N; beyond the limit of stability their continuation."""
        return _mode(alpha, number * self.size.density, self.degree)

    def limit(self, alpha: float, name: str) -> float:
        """The theory's value for N -> infinity, along its analytic continuation."""
        return getattr(_limit(alpha), name)

    def stable(self, alpha: float) -> list[int]:
        """The paper's N that are stable."""
        limit = langevin.stability_limit(alpha)
        return [n for n in self.size.numbers if n * self.size.density < limit]

    def fit(self, method: str, alpha: float, name: str, order: int) -> Fit | None:
        """A polynomial in N0/N with N0 the smallest N; None for too few N."""
        numbers = self.numbers(method, alpha)
        if len(numbers) <= order:
            return None
        columns = np.vander(numbers[0] / np.array(numbers), order + 1, increasing=True)
        return Fit(columns, [self.value(method, alpha, n, name) for n in numbers])

    def continued(self, method: str, alpha: float, name: str, order: int) -> Estimate | None:
        """The value at N -> infinity by a polynomial."""
        found = self.fit(method, alpha, name, order)
        return found.terms[0] if found else None

    def exact_continued(self, alpha: float, name: str, order: int) -> float:
        """The same through the exact values at the paper's N: what an endless run would give."""
        numbers = np.array(self.stable(alpha), float)
        values = [getattr(self.theory(alpha, n), name) for n in numbers]
        return float(np.polynomial.polynomial.polyfit(numbers[0] / numbers, values, order)[0])

    def ratio_of_lines(self, alpha: float) -> float:
        """η1/η of the paper's continuation of exact values."""
        noise, viscosity = (
            self.exact_continued(alpha, name, 1)
            for name in ("noise_viscosity_ratio", "viscosity_ratio")
        )
        return noise / viscosity

    def lines(self) -> np.ndarray:
        """Restitutions of the lines of the theory."""
        return np.linspace(min(self.restitutions()), 1.0, self.size.lines).round(6)

    def by_theory(self, method: str, alpha: float, name: str) -> Estimate:
        """The theory's limit times the mean of measured over exact values at finite N."""
        return self.against_theory(method, alpha, name) * self.limit(alpha, name)

    def against_theory(self, method: str, alpha: float, name: str) -> Estimate:
        """Measured over exact values, the mean over N with weights 1/error²."""
        ratios = [
            self.value(method, alpha, n, name) / getattr(self.theory(alpha, n), name)
            for n in self.numbers(method, alpha)
        ]
        weights = np.array([float(one.error) ** -2 for one in ratios])
        return mean([r * float(w) for r, w in zip(ratios, weights / weights.mean(), strict=True)])


@lru_cache(maxsize=256)
def _mode(alpha: float, reduced: float, degree: int | None) -> langevin.TransverseMode:
    return langevin.transverse_mode(alpha, reduced, degree, unstable=True)


@lru_cache(maxsize=64)
def _limit(alpha: float) -> langevin.LongWaveLimit:
    return langevin.long_wave_limit(alpha)


PAPER = Paper("cooling_fluctuations", Noise)
