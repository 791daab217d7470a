"""Write the whole HDF5 structure of a test file: NeXus groups, units, scales, settings."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from rigapp.schema.channels import ChannelTable
from rigapp.schema.columns import PROFILE_ANGLES_DEG, PROFILE_CURVES
from rigapp.schema.messages import Flag
from rigapp.schema.wire import json_bytes
from rigapp.storage.structure.digest import settings_digest
from rigapp.storage.structure.hdf import NOT_A_VARIABLE
from rigapp.storage.structure.layout import (
    CALIBRATION,
    CHECKPOINT_BYTES,
    CONFIGURATION,
    CONFIGURATION_DIGEST,
    DETECTORS,
    END_TIME,
    ENTRY,
    FILE_NAME_ATTRIBUTE,
    FORCE_UNCERTAINTY,
    FORM_ATTRIBUTE,
    IN_PLACE,
    PLAN,
    PROFILE_ANGLE,
    SCHEMA,
    SCHEMA_ATTRIBUTE,
    START_TIME,
    STATE,
    STATE_FIELDS,
    TIME_DTYPE,
    FileColumn,
    FilePlan,
    FileStream,
    streams_of,
)
from rigapp.storage.structure.metadata import TestMetadata, iso_time, name_and_unit, versions

UTC = {
    "units": "seconds since 1970-01-01 00:00:00",
    "standard_name": "time",
    "calendar": "standard",
}
"""CF units of UTC seconds, which other programs convert into dates."""

_UTC_COLUMNS = frozenset({("revolutions", "host_time"), ("events", "time")})

_MEASURED = frozenset({"revolutions", "samples", "unfinished_samples"})
"""Streams whose columns come from a detector."""

_OF_ENCODER = ("angle", "raw_count", "speed", "speed_max", "speed_min", "speed_rms")

_FORCE = re.compile(r"force(?P<component>_[12])?(_(?P<statistic>max|min|mean|rms))?")


def detectors(table: ChannelTable) -> dict[str, str]:
    """Return the detector of each column: an instrument, or a free channel's own."""
    result = dict.fromkeys(_OF_ENCODER, "encoder")
    for channel in table.channels:
        names = (channel.name, f"raw_{channel.name}", *(column.name for column in channel.columns))
        result |= dict.fromkeys(names, channel.instrument or channel.name)
    return result


def conventions(
    stream: FileStream, field: FileColumn, sources: Mapping[str, str], uncertain: bool = False
) -> dict[str, Any]:
    """Return further attributes of a column.

    sources: ``detectors`` of the file. uncertain: the file states the uncertainty of its forces.
    """
    result: dict[str, Any] = {}
    if (stream.name, field.name) in _UTC_COLUMNS:
        result |= UTC
    if field.name == "quality":
        result |= _flags(field.dtype)
    source = sources.get(field.name)
    if source and stream.name in _MEASURED:
        result["detector"] = f"{DETECTORS}/{source}"
    if uncertain and stream.name in _MEASURED:
        result |= _uncertainty(field.name)
    return result


def _uncertainty(name: str) -> dict[str, str]:
    """Return the attributes that point to the uncertainty of a measured force."""
    match = _FORCE.fullmatch(name)
    if match is None:
        return {}
    mean = match["statistic"] in ("mean", "rms")
    what = "one component" if match["component"] else "|F|"
    return {
        "uncertainty": FORCE_UNCERTAINTY,
        "uncertainty_of": f"{'a mean of n samples' if mean else 'one sample'} of {what}",
        "uncertainty_samples": "samples" if mean else "1",
    }


def _flags(dtype: str) -> dict[str, Any]:
    return {
        "flag_masks": np.array([flag.value for flag in Flag], dtype),
        "flag_meanings": " ".join(str(flag.name).lower() for flag in Flag),
    }


PAGE = 4096  # page of disk and memory: no two datasets share one
METADATA_BLOCK = 1 << 18  # keeps most of the structure together, at the head of the file

_SIGNALS = {
    "/entry/revolutions": ("force_max", "Statistics of every revolution", ("revolution",)),
    "/entry/cycles": ("force", "Whole cycles, one after the other", (".",)),
    "/entry/prediction": ("force_max", "What the model predicts", ("revolution",)),
    "/entry/unfinished": ("force", "Revolutions that the end of a test cut off", (".",)),
}
_COUNTERS = {
    "committed": "rows that are safe; what lies beyond is not data",
    "committed_curves": "curves that are safe; what lies beyond is not data",
    "committed_profiles": "profiles that are safe; what lies beyond is not data",
}


def build_file(path: Path, plan: FilePlan, metadata: TestMetadata, name: str) -> None:
    """Create the HDF5 file of a test at ``path``, every dataset at its full size, and close it.

    name: of the finished file.
    """
    streams = streams_of(plan)
    with _new_file(path) as file:
        _build_root(file, metadata, name)
        _build_state(file, plan, metadata)
        sources = detectors(plan.table)
        for stream in streams.values():
            _build_stream(file, stream, sources, "force_uncertainty" in metadata.calibration)
        _build_curve_angle(file, plan)
        if plan.profiles:
            _build_profile_angle(file)
            _build_checkpoint_bytes(file)
        if plan.waiting_cycles:
            _build_waiting_samples(file, streams["waiting"])
        _build_configuration(file, plan, metadata)
        write_tree(_group(file, CALIBRATION, "NXcollection"), metadata.calibration)
        for group, (signal, title, axes) in _SIGNALS.items():
            if group in file:
                _make_plottable(file[group], signal, title, axes)
        if plan.checksums:
            digest = placed_dataset(
                file[STATE], CONFIGURATION_DIGEST, "S64", (), "", "SHA-256 of all that is fixed"
            )
            digest[()] = settings_digest(file, plan)
        # Last, so that a truncated copy still has settings and structure.
        for stream in streams.values():
            for field in stream.stored:
                file[stream.path(field.name)][0] = np.zeros(field.shape, hdf_type(field.dtype))


def _new_file(path: Path) -> h5py.File:
    """Create an HDF5 file that writes values immediately.

    HDF5 crashes when a full disk refuses values only as the file is closed.
    """
    access = h5py.h5p.create(h5py.h5p.FILE_ACCESS)
    access.set_libver_bounds(h5py.h5f.LIBVER_EARLIEST, h5py.h5f.LIBVER_LATEST)
    access.set_fclose_degree(h5py.h5f.CLOSE_STRONG)
    access.set_alignment(PAGE, PAGE)
    access.set_meta_block_size(METADATA_BLOCK)
    access.set_sieve_buf_size(0)
    access.set_file_locking(False, True)  # the name is still hidden; some disks have no locks
    identifier = h5py.h5f.create(os.fsencode(path), h5py.h5f.ACC_EXCL, fapl=access)
    return h5py.File(identifier)


def placed_dataset(
    group: h5py.Group,
    name: str,
    dtype: str,
    shape: tuple[int, ...],
    unit: str,
    sentence: str,
    *,
    later: bool = False,
) -> h5py.Dataset:
    """Create a contiguous dataset at a fixed offset, its content not written.

    later: the offset is allocated with the first value written.
    """
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_layout(h5py.h5d.CONTIGUOUS)
    properties.set_alloc_time(h5py.h5d.ALLOC_TIME_LATE if later else h5py.h5d.ALLOC_TIME_EARLY)
    properties.set_fill_time(h5py.h5d.FILL_TIME_NEVER)
    space = h5py.h5s.create_simple(shape) if shape else h5py.h5s.create(h5py.h5s.SCALAR)
    identifier = h5py.h5d.create(
        group.id,
        name.encode(),
        h5py.h5t.py_create(hdf_type(dtype), logical=True),
        space,
        properties,
    )
    dataset = h5py.Dataset(identifier)
    describe(dataset, unit, sentence)
    return dataset


def hdf_type(dtype: str) -> np.dtype[Any]:
    """Return the HDF5 type of a column: fixed-length UTF-8 for ``S<n>``, else the numpy type."""
    if dtype.startswith("S"):
        return h5py.string_dtype("utf-8", int(dtype[1:]))
    return np.dtype(dtype)


def describe(dataset: h5py.Dataset, unit: str, sentence: str) -> None:
    """Set the unit and the long name of a dataset."""
    if unit:
        dataset.attrs["units"] = str(unit)
    if sentence:
        dataset.attrs["long_name"] = str(sentence)


def write_tree(group: h5py.Group, values: Mapping[str, Any]) -> None:
    """Write nested settings: a group for each mapping, a dataset with a unit for other values."""
    for key, value in values.items():
        if isinstance(value, Mapping):
            write_tree(_group(group, str(key), "NXcollection"), value)
        elif value is not None:
            _write_value(group, str(key), value)


def _write_value(group: h5py.Group, key: str, value: Any) -> None:
    if isinstance(value, (list, tuple)) and any(isinstance(v, Mapping) for v in value):
        write_tree(_group(group, key, "NXcollection"), {str(i): v for i, v in enumerate(value)})
        return
    if isinstance(value, (list, tuple)):
        array = np.asarray(value)
        value = list(map(str, value)) if array.dtype.kind in "UO" else array
    dataset = group.create_dataset(key, data=str(value) if isinstance(value, str) else value)
    if h5py.check_string_dtype(dataset.dtype) is None:
        name, unit = name_and_unit(key)
        describe(dataset, unit, name.replace("_", " "))
    _name_axes(dataset)


def _name_axes(dataset: h5py.Dataset) -> None:
    """Attach a dimension to every axis of a list or matrix, shared by axes of equal length."""
    names = ("element",) if dataset.ndim == 1 else ("row", "column", "layer")
    for position, (length, name) in enumerate(zip(dataset.shape, names, strict=False)):
        dimension = f"{name}_{length}"
        if dimension not in dataset.parent:
            bare_dimension(dataset.parent, dimension, length)
        dataset.dims[position].attach_scale(dataset.parent[dimension])


def _build_root(file: h5py.File, metadata: TestMetadata, name: str) -> None:
    version = versions()
    started = iso_time(metadata.started or time.time())
    file.attrs.update(
        {
            "NX_class": "NXroot",
            "default": "entry",
            FILE_NAME_ATTRIBUTE: name,
            "file_time": started,
            "creator": f"rigapp {version['rigapp']}",
            "HDF5_Version": h5py.version.hdf5_version,
            "h5py_version": h5py.version.version,
            SCHEMA_ATTRIBUTE: SCHEMA,
            FORM_ATTRIBUTE: IN_PLACE,
        }
    )
    entry = _group(file, ENTRY, "NXentry")
    entry.attrs["default"] = "revolutions"
    entry["title"] = metadata.title
    entry["entry_identifier_uuid"] = metadata.identifier
    entry["program_name"] = "rigapp"
    entry["program_name"].attrs["version"] = version["rigapp"]
    entry["simulated"] = np.int64(metadata.simulated)
    describe(entry["simulated"], "1", "1: the rig was simulated")
    if metadata.notes:
        entry["experiment_description"] = metadata.notes
    _build_people(entry, metadata)
    for path, text in ((START_TIME, started), (END_TIME, "")):
        dataset = placed_dataset(entry, path.rpartition("/")[2], TIME_DTYPE, (), "", "")
        dataset[()] = text


def _build_people(entry: h5py.Group, metadata: TestMetadata) -> None:
    user = _group(entry, "user", "NXuser")
    user["name"] = metadata.operator
    sample = _group(entry, "sample", "NXsample")
    sample["name"] = metadata.specimen
    sample["description"] = metadata.bushing
    instrument = _group(entry, "instrument", "NXinstrument")
    instrument["name"] = metadata.rig_name
    for name, values in metadata.detectors.items():
        write_tree(_group(instrument, name, "NXdetector"), values)


def _build_state(file: h5py.File, plan: FilePlan, metadata: TestMetadata) -> None:
    group = _group(file, STATE, "NXcollection")
    first = {
        "status": b"running",
        "planned_revolutions": plan.revolutions,
        "first_revolution": plan.first_revolution,
    }
    for name, (dtype, sentence) in STATE_FIELDS.items():
        unit = "" if dtype.startswith("S") else "1"
        dataset = placed_dataset(group, name, dtype, (), unit, sentence)
        dataset[()] = first.get(name, b"" if dtype.startswith("S") else 0)


def _build_stream(
    file: h5py.File, stream: FileStream, sources: Mapping[str, str], uncertain: bool
) -> None:
    group = _group(file, stream.group, "NXcollection")
    if stream.counter:
        counter = placed_dataset(group, stream.counter, "<i8", (), "1", _COUNTERS[stream.counter])
        counter[()] = 0
    names = [field.name for field in stream.fields]
    if stream.dimension in names:
        first = stream.fields[names.index(stream.dimension)]
        scale = _build_field(group, first, stream.capacity)
        scale.make_scale(stream.dimension)
    else:
        first = None
        scale = bare_dimension(group, stream.dimension, stream.capacity)
    for field in stream.stored:
        if field is not first:
            _build_field(group, field, stream.capacity).dims[0].attach_scale(scale)
        for name, value in conventions(stream, field, sources, uncertain).items():
            group[field.name].attrs[name] = value
    if stream.name in ("cycles", "unfinished"):
        group["count"].attrs["sample_dimension"] = "sample"


def bare_dimension(group: h5py.Group, name: str, length: int) -> h5py.Dataset:
    """Create a dimension without coordinates as netCDF does; it takes no space."""
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_layout(h5py.h5d.CONTIGUOUS)
    properties.set_alloc_time(h5py.h5d.ALLOC_TIME_LATE)
    space = h5py.h5s.create_simple((length,))
    dataset = h5py.Dataset(
        h5py.h5d.create(group.id, name.encode(), h5py.h5t.IEEE_F32BE, space, properties)
    )
    dataset.make_scale(scale_label(False, name, length))
    return dataset


def scale_label(is_variable: bool, name: str, length: int) -> str:
    """Return the NAME attribute of a dimension scale: netCDF's text for a bare dimension."""
    return name if is_variable else f"{NOT_A_VARIABLE}{length:10d}"


def _build_field(group: h5py.Group, f: FileColumn, rows: int) -> h5py.Dataset:
    shape = (rows, *f.shape)
    return placed_dataset(group, f.name, f.dtype, shape, f.unit, f.description, later=True)


def _build_curve_angle(file: h5py.File, plan: FilePlan) -> None:
    group = file["/entry/prediction"]
    points = plan.prediction_points
    angle = group.create_dataset("angle", data=np.arange(points) * (360.0 / points))
    describe(angle, "deg", "crank angle of the predicted curves")
    angle.make_scale("angle")
    for name in plan.predicted_curves:
        group[f"curve_{name}"].dims[1].attach_scale(angle)


def _build_profile_angle(file: h5py.File) -> None:
    group = file["/entry/prediction"]
    angle = group.create_dataset("profile_angle", data=np.asarray(PROFILE_ANGLES_DEG, dtype="<f8"))
    describe(angle, "deg", PROFILE_ANGLE)
    angle.make_scale("profile_angle")
    for name in PROFILE_CURVES:
        group[f"profile_{name}"].dims[1].attach_scale(angle)


def _build_checkpoint_bytes(file: h5py.File) -> None:
    group = file["/entry/prediction"]
    byte = bare_dimension(group, "checkpoint_byte", CHECKPOINT_BYTES)
    group["checkpoint_state"].dims[1].attach_scale(byte)


def _build_waiting_samples(file: h5py.File, stream: FileStream) -> None:
    group = file[stream.group]
    sample = bare_dimension(group, "sample", stream.fields[-1].shape[0])
    for field in stream.fields:
        if field.shape:
            group[field.name].dims[1].attach_scale(sample)


def _build_configuration(file: h5py.File, plan: FilePlan, metadata: TestMetadata) -> None:
    group = _group(file, CONFIGURATION, "NXcollection")
    group["rig"] = metadata.rig_text
    group["test"] = metadata.test_text
    file[PLAN] = json_bytes(plan).decode()
    write_tree(_group(group, "parameters", "NXcollection"), metadata.parameters)
    write_tree(_group(group, "versions", "NXcollection"), versions())


def _make_plottable(group: h5py.Group, signal: str, title: str, axes: tuple[str, ...]) -> None:
    if signal not in group:
        return
    group.attrs["NX_class"] = "NXdata"
    group.attrs["signal"] = signal
    group.attrs["axes"] = list(axes)
    group.attrs["title"] = title
    for position, axis in enumerate(axes):
        if axis != ".":
            group.attrs[f"{axis}_indices"] = position


def _group(parent: h5py.Group, name: str, nexus_class: str) -> h5py.Group:
    group = parent.require_group(name)
    if "NX_class" not in group.attrs:
        group.attrs["NX_class"] = nexus_class
    return group
