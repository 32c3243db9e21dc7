"""Run folders as another version of the program would have left them."""

import json

import h5py
import numpy

OTHER = "0.1.0+deadbeef"
_MARK = b"listric checksum"


def chained(value, word):
    """As dem/numbers/hash.hpp."""
    value = (value ^ word) & 0xffffffffffffffff
    value = ((value << 29) | (value >> 35)) & 0xffffffffffffffff
    return (value * 0x9e3779b97f4a7c15) & 0xffffffffffffffff


def mend_checksum(path):
    """Appends what apps/archive/snapshot/checksum.cpp appends."""
    data = path.read_bytes()
    value = len(data)
    for at in range(0, len(data), 8):
        value = chained(value, int.from_bytes(data[at:at + 8].ljust(8, b"\0"), "little"))
    path.write_bytes(data + _MARK + value.to_bytes(8, "little"))


def made_by_another_version(snapshot):
    """Lets a snapshot say so."""
    data = snapshot.read_bytes()
    assert data[-24:].startswith(_MARK)
    snapshot.write_bytes(data[:-24])
    with h5py.File(snapshot, "r+") as file:
        del file.attrs["version"]
        file.attrs["version"] = numpy.bytes_(OTHER)  # of fixed length, as the program writes it
    mend_checksum(snapshot)


def run_of_another_version(run):
    """Lets a run's folder say so."""
    for snapshot in (run / "snapshots").glob("*.h5"):
        made_by_another_version(snapshot)
    summary = run / "summary.json"
    if summary.exists():
        values = json.loads(summary.read_text())
        values["provenance"]["version"], values["provenance"]["commit"] = OTHER.split("+")
        summary.write_text(json.dumps(values, indent=2) + "\n")
