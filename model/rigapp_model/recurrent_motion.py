"""The motion of the crank that recurs in each revolution, from many similar revolutions.

The counts of one revolution do not resolve motion of higher orders. A mechanism repeats: the mean
over similar revolutions shows motion that the fit to a single one does not resolve, and their
scatter the motion that does not repeat.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

HIGHEST_ORDER = 40
"""Highest order of the revolution in which motion is searched and may be hidden by the counts."""
REMEMBERED = 100.0
"""Revolutions averaged: the motion changes over more, while the drive's controller warms up."""
SAME_SPEED = 0.01
"""Relative change of the mean speed up to which revolutions count as similar."""
LEAST_SEEN = 3
"""Fewest revolutions whose scatter is used."""
JERK = 8.0
"""Limit of a revolution's squared deviation, as a multiple of the usual scatter."""
MOST_SAMPLES = 2048
FITTED = 12
"""Orders fitted together with the constant speed; over one turn, more of them are nearly
collinear with the line."""
SIGNIFICANT = 6.0
"""Ratio of a harmonic's power to its variance, below which it is noise (5 % odds)."""
VARYING = 2.0
"""Ratio of an order's scatter to that by chance, above which it changes from turn to turn."""
DETECTED = 2.0
"""Standard deviations of chance above which the power of higher orders is motion."""
_ORDERS = np.arange(1, HIGHEST_ORDER + 1)


@dataclass(frozen=True, slots=True, eq=False)
class KnownMotion:
    """Recurrent motion of a revolution: angle (n,), rad, speed, rad/s, acceleration, rad/s^2.

    again: fraction of the counts that recurs at the same angles, without new information.
    hidden_speed, hidden_acceleration: standard deviations of undetected recurrent motion and of
    motion that does not recur; lasting: recurrent fraction of the latter's deviation.
    scatter: usual variance of each harmonic (HIGHEST_ORDER,), rad^2.
    """

    angle: Array
    speed: Array
    acceleration: Array
    again: float
    hidden_speed: float
    hidden_acceleration: float
    lasting: float
    scatter: Array


@dataclass(frozen=True, slots=True, eq=False)
class RecurrentMotion:
    """Mean and scatter (variance) of the angle's harmonics (HIGHEST_ORDER,), rad, rad^2.

    chance: mean variance of a harmonic due to the counts or the noise of the angle, rad^2.
    """

    speed: float = np.nan
    seen: int = 0
    mean: ComplexArray = field(default_factory=lambda: np.zeros(HIGHEST_ORDER, np.complex128))
    scatter: Array = field(default_factory=lambda: np.zeros(HIGHEST_ORDER))
    chance: float = 0.0

    def after(
        self, time: Array, angle: Array, smooth: Array, chance: float
    ) -> tuple[RecurrentMotion, KnownMotion | None]:
        """Add a revolution and return its known motion; None after too few similar revolutions.

        time (n,), s; angle (n,): as measured, unwrapped; smooth (n,): as fitted, rad. chance:
        variance of one harmonic due to counts or noise, rad^2.
        """
        step = -(-len(angle) // MOST_SAMPLES)
        waves = _waves(smooth[::step])
        times, angles = time[::step] - time.mean(), angle[::step]
        speed = float((smooth[-1] - smooth[0]) / (time[-1] - time[0]))
        similar = abs(speed - self.speed) <= SAME_SPEED * abs(speed)
        before = self if similar else RecurrentMotion()
        harmonics = _harmonics(times, angles, waves)
        new = before._with(harmonics, speed, chance)
        if new.seen < LEAST_SEEN:
            return new, None
        return new, new._known(time, angle, _waves(smooth) if step > 1 else waves, harmonics)

    def _with(self, harmonics: ComplexArray, speed: float, chance: float) -> RecurrentMotion:
        seen = self.seen + 1
        share = max(1.0 / seen, 1.0 / REMEMBERED)
        step = harmonics - self.mean
        squared = (1.0 - share) * np.abs(step) ** 2
        if self.seen >= LEAST_SEEN:
            weights = _ORDERS**4.0
            most = JERK * float(weights @ self.scatter)
            ratio = max(float(weights @ squared) / max(most, 1e-300), 1.0)
            squared, step = squared / ratio, step / np.sqrt(ratio)
        return RecurrentMotion(
            speed,
            seen,
            self.mean + share * step,
            self.scatter + share * (squared - self.scatter),
            self.chance + share * (chance - self.chance),
        )

    def _known(
        self, time: Array, angle: Array, waves: ComplexArray, harmonics: ComplexArray
    ) -> KnownMotion:
        """Return the known motion of a revolution from its harmonics."""
        number = min(float(self.seen), REMEMBERED)
        scatter = self.scatter * number / (number - 1.0)
        power = np.maximum(np.abs(self.mean) ** 2, 1e-300)
        mean = self.mean * np.maximum(0.0, 1.0 - SIGNIFICANT * scatter / number / power)
        # Orders that change from turn to turn by more than chance: values of this turn.
        varying = 1.0 - self.chance / np.maximum(scatter, 1e-300)
        varying = np.where(scatter > VARYING * self.chance, varying, 0.0)
        mean = mean + varying * (harmonics - mean)
        periodic, faster, pushed = (
            2.0 * np.real((mean * (1j * self.speed * _ORDERS) ** times) @ waves)
            for times in range(3)
        )
        line = np.polynomial.Polynomial.fit(time, angle - periodic, 1)
        # Counts that recur at the same angles add to the mean instead of to the scatter.
        usual = max(self.chance, 1e-300)
        too_little = 1.0 - float(scatter[FITTED:].mean()) / usual
        repeated = float(np.mean((np.abs(self.mean) ** 2 - scatter / number)[FITTED:])) / usual
        again = max(0.0, min(too_little, repeated))
        significant = np.abs(mean) > 0.0
        weights = 2.0 * (self.speed * _ORDERS) ** 4.0
        each = weights * scatter / number
        chance = weights * self.chance
        weak = hidden_power(weights * np.abs(self.mean) ** 2 - each, each, ~significant)
        resolved = varying > 0.0
        free = hidden_power(weights * scatter - chance, chance / np.sqrt(number - 1.0), ~resolved)
        lasting = np.where(significant & ~resolved, each, 0.0) + weak
        pushing = np.where(resolved, varying * chance, free) + lasting
        turning = pushing / (self.speed * _ORDERS) ** 2.0
        hidden = [float(np.sqrt(powers.sum())) for powers in (turning, pushing)]
        return KnownMotion(
            line(time) + periodic,
            line.deriv()(time) + faster,
            pushed,
            again,
            hidden[0],
            hidden[1],
            float(np.sqrt(lasting.sum() / max(float(pushing.sum()), 1e-300))),
            scatter,
        )


def hidden_power(powers: Array, doubts: Array, which: NDArray[np.bool_] | None = None) -> Array:
    """Return upper bounds of the acceleration's powers by order (HIGHEST_ORDER,), (rad/s^2)^2.

    powers: estimates, doubts: their standard deviations; which: selected orders, others give 0.
    The spectrum does not rise above FITTED: that of an instantaneous jerk is flat, that of any
    smoother motion falls. So the lower orders, which counts resolve better by the fourth power of
    the order, bound the higher ones; detected power of these is added.
    """
    selected = np.ones(powers.size, dtype=np.bool_) if which is None else which
    hidden = np.zeros(powers.size)
    for part in (selected & (_ORDERS <= FITTED), selected & (_ORDERS > FITTED)):
        power, doubt = powers[part], doubts[part]
        if not power.size:
            continue
        most = max(float(power.sum()), 0.0) + float(np.sqrt(doubt @ doubt))
        if part[FITTED:].any():
            weight = np.maximum(doubt, 1e-300) ** -2.0
            level = (
                max(float(weight @ power) / float(weight.sum()), 0.0) + float(weight.sum()) ** -0.5
            )
            detected = float(power.sum()) - DETECTED * float(np.sqrt(doubt @ doubt))
            most = min(most, max(level * power.size, detected))
        hidden[part] = most / power.size
    return hidden


def _harmonics(time: Array, angle: Array, waves: ComplexArray) -> ComplexArray:
    """Return the amplitudes of the orders (HIGHEST_ORDER,), rad, fitted with a constant speed."""
    low = waves[:FITTED]
    design = np.concatenate([[np.ones(len(time)), time / np.ptp(time)], low.real, low.imag])
    values = np.linalg.solve(design @ design.T, design @ angle)
    residual = angle - values @ design
    cosines, sines = values[2 : 2 + FITTED], values[2 + FITTED :]
    return np.concatenate(
        [0.5 * (cosines - 1j * sines), np.conj(waves[FITTED:]) @ residual / len(residual)]
    )


def _waves(angle: Array) -> ComplexArray:
    """Return exp(i k angle), (HIGHEST_ORDER, n)."""
    first = np.exp(1j * angle)
    return np.cumprod(np.broadcast_to(first, (HIGHEST_ORDER, len(angle))), axis=0)
