"""Identify the wear coefficient of a running test: posterior, remaining life, consistency.

From bins of the measured depth and one computed life to probabilities and messages; no input or
output. ``docs/model-wear.md`` states the assumptions.
"""

from rigapp_model.identification.bins import Bin, Bins, bins_of
from rigapp_model.identification.consistency import Consistency, Departure, consistency_of
from rigapp_model.identification.errors import NotIdentifiable, Prior, ProbeErrors, probe_errors
from rigapp_model.identification.findings import Disturbance
from rigapp_model.identification.forecast import (
    Band,
    Estimate,
    Pairing,
    Remaining,
    estimate_of,
    pairing_of,
    predictive_band,
    remaining,
)
from rigapp_model.identification.inference import Credible, Identification, Verdict, identify
from rigapp_model.identification.life import DepthLife, depth_life, weight, worn_ahead
from rigapp_model.identification.words import sentence

__all__ = [
    "Band",
    "Bin",
    "Bins",
    "Consistency",
    "Credible",
    "Departure",
    "DepthLife",
    "Disturbance",
    "Estimate",
    "Identification",
    "NotIdentifiable",
    "Pairing",
    "Prior",
    "ProbeErrors",
    "Remaining",
    "Verdict",
    "bins_of",
    "consistency_of",
    "depth_life",
    "estimate_of",
    "identify",
    "pairing_of",
    "predictive_band",
    "probe_errors",
    "remaining",
    "sentence",
    "weight",
    "worn_ahead",
]
