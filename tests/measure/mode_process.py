"""Gaussian modes with a known autocorrelation, for tests of estimators.

C(s) = Re Σ weight exp(-rate s) of the linear Boltzmann-Langevin equation of disks in 20
Laguerre-Fourier moments (degree 8). Cut there it is within 1 % of the physical one; for a blind
test it is a process in its own right, exactly known, with zero slope at s = 0 and a fast part
unlike the form that is fitted. Rates and weights to 6 decimals: C(0) and slope to 1e-5.
"""

from dataclasses import dataclass

import numpy as np

MEAN_FREE_PATHS = np.sqrt(8.0)  # k λ0 = 2π/√(8 N n σ²)


@dataclass(frozen=True)
class ModeProcess:
    """Transverse mode at restitution α and reduced number N n σ²; units λ0, τ0."""

    reduced_number: float
    growth_rate: float
    terms: tuple  # (Re rate, Im rate, Re weight, Im weight), the slowest first

    @property
    def wave_number(self) -> float:
        return float(2 * np.pi / (MEAN_FREE_PATHS * np.sqrt(self.reduced_number)))

    @property
    def decay_rate(self) -> float:
        return self.terms[0][0]

    def autocorrelation(self, lag):
        table = np.array(self.terms)
        rate, weight = table[:, 0] + 1j * table[:, 1], table[:, 2] + 1j * table[:, 3]
        return sum((w * np.exp(-r * np.abs(lag))).real for r, w in zip(rate, weight, strict=True))

    def truth(self) -> dict[str, float]:
        """The observables, eqs. (9)-(11) of Costantini & Puglisi at T~ = T0."""
        rate, amplitude, tail = self.decay_rate, self.autocorrelation(0.0), self.terms[0][2]
        viscous = self.wave_number**2 / np.sqrt(np.pi)
        total = rate + self.growth_rate
        return {
            "mode_amplitude": amplitude,
            "mode_decay_rate": rate,
            "viscosity_ratio": total / viscous,
            "noise_viscosity_ratio": amplitude * rate / viscous,
            "noise_over_viscosity": amplitude * rate / total,
            "tail_noise_over_viscosity": tail * rate / total,
        }

    def sample(self, rng, shape, spacing, power=500.0):
        """Stationary Gaussian series (realizations, modes, samples), ⟨|ξ|²⟩ = power C(0).

        Exact synthesis from the spectrum of the autocorrelation on a circle, which is so long
        that C has fallen by e^-12 before it closes.
        """
        enough = shape[-1] + int(12 / self.decay_rate / spacing)
        length = 1 << int(2 * enough - 1).bit_length()
        lag = np.arange(length)
        circle = self.autocorrelation(spacing * np.minimum(lag, length - lag))
        spectrum = np.fft.fft(circle).real
        assert spectrum.min() > -1e-3  # it is one, to e^-12 and the six decimals
        scale = np.sqrt(0.5 * power * np.maximum(spectrum, 0) / length)
        size = (*shape[:-1], length)
        noise = rng.normal(size=size) + 1j * rng.normal(size=size)
        return np.fft.fft(scale * noise, axis=-1)[..., : shape[-1]]


ELASTIC = ModeProcess(
    20.0,
    0.0,
    (
        (0.13388, 0.0, 1.150569, 0.0),
        (0.670981, 0.161972, 0.150454, -0.124243),
        (0.92259, 0.0, -0.232275, 0.0),
        (1.054912, 0.396351, -0.161895, 0.000494),
        (1.091257, 0.597879, 0.044892, 0.016501),
        (1.372317, 0.25044, 0.047483, -0.006681),
        (1.51916, 0.824039, -0.000934, -0.003279),
        (1.605008, 1.06849, 0.000355, 0.000365),
        (1.881535, 0.238951, 0.00092, 0.000183),
        (1.915228, 0.823541, 0.000414, -0.000233),
        (2.108594, 1.292115, 1.6e-05, -2.6e-05),
    ),
)
INELASTIC = ModeProcess(  # restitution 0.8
    20.0,
    0.0793525,
    (
        (0.057319, 0.0, 2.88802, 0.0),
        (0.740806, 0.0, -0.327073, 0.0),
        (0.762258, 0.220156, 0.275125, 0.287167),
        (0.942743, 0.356255, -0.126075, -0.121542),
        (1.058083, 0.712497, -0.004381, 0.025025),
        (1.207051, 0.18609, 0.011155, -0.000752),
        (1.2432, 0.748078, 0.002154, -0.01276),
        (1.298018, 0.37601, 0.001662, 0.000687),
        (1.349758, 0.855994, 0.000702, 0.000231),
        (1.373906, 1.244599, 7.5e-05, 0.000153),
        (1.402698, 1.392692, -0.000145, -7.3e-05),
    ),
)
NEAR_THE_LIMIT = ModeProcess(  # restitution 0.8
    30.0,
    0.0793525,
    (
        (0.013739, 0.0, 7.9304, 0.0),
        (0.726739, 0.133457, 0.271959, 0.249124),
        (0.750746, 0.0, -0.38391, 0.0),
        (0.988459, 0.247854, -0.011477, -0.091194),
        (1.012141, 0.540705, -0.007055, 0.01445),
        (1.212376, 0.128702, 0.009321, 0.003552),
        (1.282457, 0.581561, 0.003128, -0.003681),
        (1.310796, 0.326772, 0.001057, 0.000465),
        (1.329033, 1.03636, -0.000125, 0.000168),
        (1.356109, 0.719928, 0.000391, 3.3e-05),
        (1.436425, 1.114235, 3.2e-05, -0.00011),
    ),
)
