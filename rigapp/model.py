"""The model as a library: mechanism, forces, contact, wear, identification, in SI units.

The names exported here are stable; the modules of ``model`` may change with any version.
``docs/model.md`` describes the computation, ``docs/model-wear.md`` the wear.
"""

from __future__ import annotations

from rigapp.config.loading import read_parameters
from rigapp.report.testreport.identified import (
    IdentifiedTest,
    IdentifiedTests,
    identified_test,
    identified_tests,
)
from rigapp_model.bushing.ring import Ring, pressure_distribution, ring_of
from rigapp_model.constraints import solve_perfect
from rigapp_model.contact.impact import contact_cycle
from rigapp_model.contact.impact_system import clearance_system
from rigapp_model.dynamics import MechanismMotion, inverse_dynamics
from rigapp_model.errors import ModelError
from rigapp_model.history import motion_from_history
from rigapp_model.identification import Credible, Identification, NotIdentifiable, identify
from rigapp_model.joints import ContinuousContact, continuous_contact, perfect_joint
from rigapp_model.parameters import (
    Bushing,
    Joint,
    Material,
    Mechanism,
    Parameters,
    Spring,
    WearLaw,
)
from rigapp_model.wear.life import Life, life

__all__ = [
    "Bushing",
    "ContinuousContact",
    "Credible",
    "Identification",
    "IdentifiedTest",
    "IdentifiedTests",
    "Joint",
    "Life",
    "Material",
    "Mechanism",
    "MechanismMotion",
    "ModelError",
    "NotIdentifiable",
    "Parameters",
    "Ring",
    "Spring",
    "WearLaw",
    "clearance_system",
    "contact_cycle",
    "continuous_contact",
    "identified_test",
    "identified_tests",
    "identify",
    "inverse_dynamics",
    "life",
    "motion_from_history",
    "perfect_joint",
    "pressure_distribution",
    "read_parameters",
    "ring_of",
    "solve_perfect",
]
