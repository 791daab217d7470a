"""Speed of the simulated plant, as a multiple of the GSV-8's 12000 samples/s, on one core.

Plant: the compiled kernel in chunks of 4096 samples. Loop: plant, disturbances and hand-over in the
chunks that the rig uses at 60 rpm and 960 Hz (1/20 revolution), without a device's bytes.
"""

from __future__ import annotations

import math
import time
from pathlib import Path

from budgets import measured, size

from rigapp.config.loading import read_rig
from rigapp.simulation import layout
from rigapp.simulation.constants import packaged_parameters, plant_constants
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant

FASTEST_DAQ_HZ = 12_000.0
RIG = Path(__file__).resolve().parents[1] / "examples" / "simulated.toml"


def samples_per_second(rate_Hz: float, chunk: int, seconds: float = size(100, 2) / 100) -> float:
    """Return the samples that the plant makes per second of CPU time at 60 rpm."""
    rig = read_rig(RIG).record
    plant = Plant(
        plant_constants(packaged_parameters(), rig), filter_delay_s=1e-3, sample_rate_Hz=rate_Hz
    )
    speed = 2.0 * math.pi
    plant.advance(chunk, Drive(layout.VELOCITY, 0.0, speed, 0.0, 48.0, 0.0))
    command = Drive(layout.VELOCITY, speed, speed, 0.0, 48.0, 0.0)
    made = 0
    start = time.process_time()
    while time.process_time() - start < seconds:
        made += plant.advance(chunk, command).shaft_revolutions.size
    return made / (time.process_time() - start)


def main() -> None:
    """Print one line a case."""
    for name, rate, chunk in (
        ("plant, 960 Hz, long chunks", 960.0, 4096),
        ("plant, 12000 Hz, long chunks", 12_000.0, 4096),
        ("plant, 48000 Hz, long chunks", 48_000.0, 4096),
        ("loop, 960 Hz, chunks of 1/20 revolution", 960.0, 48),
    ):
        rate_made = samples_per_second(rate, chunk)
        print(f"{name}: {rate_made:.3g} samples/s = {rate_made / FASTEST_DAQ_HZ:.0f} x GSV-8")
    measured("plant", rate_made / FASTEST_DAQ_HZ)


if __name__ == "__main__":
    main()
