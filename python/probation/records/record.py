"""One test of one specimen: its samples in MPa, s and true strain, and where they came from."""

import hashlib
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from probation._complaint import quoted, suggestion
from probation._text import printable
from probation.errors import InputError
from probation.limits import LARGEST, SMALLEST_PARAMETER
from probation.records.checks import find_excess, find_fault, find_short_step
from probation.records.clock import Shift
from probation.records.strain_limits import LARGEST_TRUE_STRAIN, expected_strain
from probation.results.frames import data_frame, over_time
from probation.results.rendering import InOneLine

FloatArray = NDArray[np.float64]

CONTROLS = ("strain-rate", "displacement-rate", "hold", "cyclic", "other")
RECORD_ROLES = ("identify", "held-out")
HEADINGS = {
    "time": "time_s",
    "true_strain": "true_strain",
    "true_stress": "true_stress_MPa",
    "strain_rate": "strain_rate_per_s",
    "transverse_strain": "transverse_strain",
    "temperature": "temperature_C",
}
"""What is sampled, and the heading of its column outside."""

SAMPLED = tuple(HEADINGS)


@dataclass(frozen=True)
class Noise:
    """Standard deviations of a record's noise, where they are known.

    Attributes
    ----------
    stress_MPa : float or None [MPa]
    strain : float or None [-]
    """

    stress_MPa: float | None = None  # noqa: N815 - as the campaign file spells it
    strain: float | None = None

    def __post_init__(self) -> None:
        for name, value in (("stress_MPa", self.stress_MPa), ("strain", self.strain)):
            if value is not None and not 0.0 <= value < np.inf:
                raise InputError(f"noise.{name}: found {value!r}, expected a number of at least 0")
            largest = LARGEST["true_stress"] if name == "stress_MPa" else LARGEST_TRUE_STRAIN
            if value is not None and value != 0.0 and not SMALLEST_PARAMETER <= value <= largest:
                raise InputError(
                    f"noise.{name}: found {value!r}, expected 0 or a number from {SMALLEST_PARAMETER:g} to {largest:g}"
                )


@dataclass(frozen=True, eq=False)
class Record(InOneLine):
    """One test of one specimen.

    The arrays are copied, made float64 and read-only.

    Attributes
    ----------
    id : str
        Unique within a campaign; one printable line, in which control characters are escaped.
    time : ndarray, shape (n,) [s]
        Strictly increasing, at least ten samples; need not start at zero.
    true_strain : ndarray, shape (n,) [-]
        Logarithmic strain, tension positive.
    true_stress : ndarray, shape (n,) [MPa]
    strain_rate : ndarray, shape (n,) [1/s], or None
        True strain rate, where it was given rather than differentiated.
    transverse_strain : ndarray, shape (n,) [-], or None
        Logarithmic transverse strain.
    temperature : ndarray, shape (n,) [°C], or None
    control : {"strain-rate", "displacement-rate", "hold", "cyclic", "other"}
    role : {"identify", "held-out"}
    specimen_id : str or None
        Records of one specimen share its deviations; without one the record is a specimen of its own.
    noise : Noise
    file : Path or None
        Where it was read; None for a record made in memory.
    sha256 : str
        Of that file; of the samples for a record made in memory.
    warnings : tuple of str
        What a reader should know: assumptions made, rows dropped, suspicious values.
    profile : str
        Import profile that read it; empty for a record made in memory.
    clock : Shift or None
        How the clock of a strain file was set; None where stress and strain come from one file.

    Raises
    ------
    InputError
        If a sample is not finite or beyond what physics allows (`limits.LARGEST`), the shapes differ, time does not
        increase, there are fewer than ten samples, a true strain is beyond 5 (a stretch of 148), or control or role is
        unknown.
    """

    id: str
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    strain_rate: FloatArray | None = None
    transverse_strain: FloatArray | None = None
    temperature: FloatArray | None = None
    control: str = "other"
    role: str = "identify"
    specimen_id: str | None = None
    noise: Noise = field(default_factory=Noise)
    file: Path | None = None
    sha256: str = ""
    warnings: tuple[str, ...] = ()
    profile: str = ""
    clock: Shift | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.id, str) or not self.id.strip():
            raise InputError(f"record: found the id {self.id!r}, expected some text")
        object.__setattr__(self, "id", printable(self.id))
        if self.specimen_id is not None:
            if not isinstance(self.specimen_id, str) or not self.specimen_id.strip():
                raise InputError(
                    f"record {quoted(self.id)}: found the specimen_id {self.specimen_id!r}, expected some text"
                )
            object.__setattr__(self, "specimen_id", printable(self.specimen_id))
        for name in SAMPLED:
            if getattr(self, name) is not None:
                object.__setattr__(self, name, self._as_samples(name))
        if fault := find_fault(self.samples) or find_excess(self.samples) or find_short_step("time", self.time):
            raise InputError(
                f"record {quoted(self.id)}, {fault.quantity}, sample {fault.sample}: "
                f"found {fault.found}, expected {fault.expected}"
            )
        largest = int(np.argmax(np.abs(self.true_strain)))
        if abs(self.true_strain[largest]) > LARGEST_TRUE_STRAIN:
            raise InputError(
                f"record {quoted(self.id)}, true_strain, sample {largest}: found {self.true_strain[largest]:.10g}, "
                f"expected {expected_strain('true_strain', stated=True)}; divide by 100 if it is in percent"
            )
        for name, value, known in (("control", self.control, CONTROLS), ("role", self.role, RECORD_ROLES)):
            if value not in known:
                raise InputError(f"record {quoted(self.id)}: found {name} {value!r}; {suggestion(str(value), known)}")
        if not self.sha256:
            object.__setattr__(self, "sha256", self.samples_sha256)

    def __len__(self) -> int:
        return len(self.time)

    @property
    def samples(self) -> dict[str, FloatArray]:
        """The sampled quantities that there are, by name, time first."""
        return {name: values for name in SAMPLED if (values := getattr(self, name)) is not None}

    def only(self, chosen: "slice | NDArray[np.bool_]") -> "Record":
        """The same with some of its samples."""

        def taken(values: FloatArray | None) -> FloatArray | None:
            return None if values is None else values[chosen]

        return replace(
            self,
            time=self.time[chosen],
            true_strain=self.true_strain[chosen],
            true_stress=self.true_stress[chosen],
            strain_rate=taken(self.strain_rate),
            transverse_strain=taken(self.transverse_strain),
            temperature=taken(self.temperature),
        )

    @property
    def columns(self) -> dict[str, FloatArray]:
        """The same by the headings of the default CSV form."""
        return {HEADINGS[name]: values for name, values in self.samples.items()}

    def to_dataframe(self) -> Any:
        """As a pandas DataFrame, a row a sample, with the headings of the default CSV form.

        Raises
        ------
        InputError
            Where pandas is not installed.
        """
        return data_frame(self.columns)

    def to_xarray(self) -> Any:
        """As an xarray Dataset over "time_s".

        Raises
        ------
        InputError
            Where xarray is not installed.
        """
        return over_time(self.columns)

    @property
    def samples_sha256(self) -> str:
        """Hash of the samples themselves, in hexadecimal."""
        digest = hashlib.sha256()
        for name, values in self.samples.items():
            digest.update(name.encode() + np.ascontiguousarray(values, dtype="<f8").tobytes())
        return digest.hexdigest()

    def to_dict(self) -> dict[str, Any]:
        """What it is and how far each quantity goes, without the samples."""
        return {
            "id": self.id,
            "control": self.control,
            "role": self.role,
            "profile": self.profile,
            "sha256": self.sha256,
            "samples": len(self),
            "ranges": {HEADINGS[name]: [values.min(), values.max()] for name, values in self.samples.items()},
            "warnings": self.warnings,
        }

    def _as_samples(self, name: str) -> FloatArray:
        """Copy one field to read-only float64 of the same length as the time."""
        try:
            values = np.array(getattr(self, name), dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError(f"record {quoted(self.id)}, {name}: found no numbers, expected samples") from None
        if values.ndim != 1 or (name != "time" and len(values) != len(self.time)):
            expected = "(n,)" if name == "time" else f"({len(self.time)},) as time"
            raise InputError(f"record {quoted(self.id)}, {name}: found shape {values.shape}, expected {expected}")
        values.flags.writeable = False
        return values
