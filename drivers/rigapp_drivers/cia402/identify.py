"""Find out who answers at a node id; nothing is set in the drive."""

from __future__ import annotations

from typing import Final

from rigapp_drivers.api import ConnectionFailed, Identity, ReplyTimeout, WrongDevice
from rigapp_drivers.cia402.network import CanNode
from rigapp_drivers.cia402.protocol import PROFILE_402, VENDOR_MAXON, Nmt

_WAKING_TRIES: Final = 3  # the first is lost while a drive finds its bit rate


def identify(node: CanNode, interface: str, objects: str) -> Identity:
    """Return the drive's identity; details["objects"] is "epos4" or "generic".

    objects: the setting. Raises ConnectionFailed when the node does not answer, WrongDevice when
    it is no CiA 402 drive.
    """
    try:
        device_type = _wake(node)
    except ReplyTimeout as error:
        raise ConnectionFailed.at(node, error.sentence) from error
    if device_type & 0xFFFF != PROFILE_402:
        raise WrongDevice.at(
            node, f"node {node.node_id} is no CiA 402 drive ‹device type {device_type:08X}›."
        )
    vendor, product, revision, serial = (node.read_if_there(0x1018, sub) for sub in range(1, 5))
    if objects == "auto":
        objects = "epos4" if vendor == VENDOR_MAXON else "generic"
    return Identity(
        maker="maxon" if vendor == VENDOR_MAXON else f"vendor {vendor or 0:08X}",
        model=node.read_text(0x1008) or f"product {product or 0:08X}",
        firmware=f"{(revision or 0) >> 16:04X}",
        serial_number=f"{serial:08X}" if serial else "",
        port=node.port,
        details={"node_id": str(node.node_id), "interface": interface, "objects": objects},
    )


def _wake(node: CanNode) -> int:
    """Return the device type; a stopped node, or one that finds the bit rate, needs a push."""
    try:
        return node.read(0x1000, tries=_WAKING_TRIES)
    except ReplyTimeout:
        node.command(Nmt.PRE_OPERATIONAL)
        return node.read(0x1000)
