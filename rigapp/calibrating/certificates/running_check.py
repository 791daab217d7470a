"""What the certificate of a running check says."""

from __future__ import annotations

import numpy as np

from rigapp.calibrating.certificates.parts import Content, Parts, scatter, surroundings
from rigapp.report.page.manuscript import Figure, Row, Table


def running_parts(content: Content) -> Parts:
    """Return statements, tables and figures of a record."""
    speeds = content["result"]["speeds"]
    return Parts(
        _statements(content),
        _tables(content),
        _figures(content),
        "Forces",
        calibrated=f"{speeds[0]['speed_rpm']:.1f} rpm to {speeds[-1]['speed_rpm']:.1f} rpm.",
        conditions=surroundings(content["settings"]),
    )


def _statements(content: Content) -> list[str]:
    """Say what was done and what came out."""
    return [
        "Method: the pin turned without the follower at several speeds; the change of the mean"
        " force in the crank's frame against the known inertia of the pin outboard of the gauges,"
        " force_1 = - m r w^2, force_2 = 0. The slowest speed is the zero.",
        str(content["result"]["sentence"]),
        "The expanded uncertainties have the coverage factor k = 2 (about 95 %).",
    ]


def _tables(content: Content) -> list[Table]:
    """Return the speeds, and the mass times radius."""
    result = content["result"]
    rows: tuple[Row, ...] = tuple(
        (
            f"{one['speed_rpm']:.1f}",
            f"{one['known_N'][0]:+.3f}",
            f"{one['measured_N'][0]:+.3f}",
            f"{one['measured_N'][1]:+.3f}",
            f"{one['expanded_uncertainty_N']:.3f}",
            "agrees" if one["agrees"] else "differs",
        )
        for one in result["speeds"]
    )
    head = ("rpm", "known N", "force_1 N", "force_2 N", "U N", "verdict")
    moment = 1e3 * result["measured_mass_times_radius_kg_m"]
    expanded = 1e3 * result["measured_expanded_uncertainty_kg_m"]
    return [
        Table("Change of the mean force against the slowest speed", rows, head),
        Table(
            "Mass times radius outboard of the gauges",
            (
                ("known", f"{1e3 * result['known_mass_times_radius_kg_m']:.4f} kg mm"),
                ("as the cell tells it", f"{moment:.4f} kg mm, U = {expanded:.4f} kg mm"),
            ),
        ),
    ]


def _figures(content: Content) -> list[Figure]:
    """Show every revolution's force against the speed."""
    lines = content["readings_csv"].splitlines()[1:]
    table = np.array([[float(word) for word in line.split(",")[1:]] for line in lines])
    return [
        scatter(
            "Mean force of every revolution against speed", "speed (rpm)", table[:, 0],
            table[:, 1:], "mean force (N)", ("force_1", "force_2"),
        )
    ]  # fmt: skip
