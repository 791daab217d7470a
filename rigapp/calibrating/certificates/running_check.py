"""What the certificate of a running check says."""

from __future__ import annotations

import numpy as np

from rigapp.calibrating.certificates.formatting import Content, Parts, plot, table
from rigapp.report.page.document import Table

METHOD = (
    "Method: the pin turned without the follower at several speeds; the change of the mean"
    " force in the crank's frame against the known inertia of the pin outboard of the gauges,"
    " force_1 = - m r w^2, force_2 = 0. The slowest speed is the zero."
)
FACTOR = "The expanded uncertainties have the coverage factor k = 2 (about 95 %)."
SPEEDS = {
    "rpm": "{speed_rpm:.1f}",
    "known N": "{known_N[0]:+.3f}",
    "force_1 N": "{measured_N[0]:+.3f}",
    "force_2 N": "{measured_N[1]:+.3f}",
    "U N": "{expanded_uncertainty_N:.3f}",
    "verdict": "{verdict}",
}


def running_parts(content: Content) -> Parts:
    """Return statements, tables and figures of a record; every revolution's force over speed."""
    result, speeds = content["result"], content["result"]["speeds"]
    judged = ({**one, "verdict": "agrees" if one["agrees"] else "differs"} for one in speeds)
    known, moment, expanded = (
        1e3 * result[f"{what}_kg_m"]
        for what in (
            "known_mass_times_radius",
            "measured_mass_times_radius",
            "measured_expanded_uncertainty",
        )
    )
    told = f"{moment:.4f} kg mm, U = {expanded:.4f} kg mm"
    rows = (("known", f"{known:.4f} kg mm"), ("as the cell tells it", told))
    text = content["readings_csv"].partition("\n")[2]
    taken = np.array([line.split(",")[1:] for line in text.splitlines()], np.float64)
    title, names = "Mean force of every revolution against speed", ("force_1", "force_2")
    return Parts(
        (METHOD, str(result["sentence"]), FACTOR),
        [
            table("Change of the mean force against the slowest speed", SPEEDS, judged),
            Table("Mass times radius outboard of the gauges", rows),
        ],
        [plot(title, "speed (rpm)", taken[:, 0], taken[:, 1:], "mean force (N)", names)],
        "Forces",
        calibrated=f"{speeds[0]['speed_rpm']:.1f} rpm to {speeds[-1]['speed_rpm']:.1f} rpm.",
    )
