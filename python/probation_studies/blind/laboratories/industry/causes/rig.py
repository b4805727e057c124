"""Causes in the machine: frame, grips, cell, amplifier and clip-on extensometer, as they were published.

F is the force over the first section, F_m the campaign's largest, e the travel over the gauge length.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.signal import bessel, butter, sosfilt, sosfilt_zi

from probation_studies.blind.laboratories.industry.bench import BenchTest, Scales
from probation_studies.blind.laboratories.industry.causes.form import Cause, Form, Shape
from probation_studies.blind.laboratories.industry.memory import FloatArray


def _largest_travel(test: BenchTest) -> float:
    return float(np.expm1(test.scales.strain))


def _linear_frame(test: BenchTest, a: float, shape: Shape) -> None:
    """ISO 6892-1 annex, Hockett & Gillis 1971: e + F/K; a = F_m/K."""
    test.reading.append(lambda travel, force: travel + a * force / test.scales.force)


def _hertz_frame(test: BenchTest, a: float, shape: Shape) -> None:
    """Hertz 1882: surfaces in contact approach by F^(2/3), in series with a linear frame."""
    part = shape["contact"]

    def read(travel: FloatArray, force: FloatArray) -> FloatArray:
        f = np.maximum(force, 0.0) / test.scales.force
        return np.asarray(travel + a * ((1.0 - part) * f + part * f ** (2.0 / 3.0)))

    test.reading.append(read)


def _curved_frame(test: BenchTest, a: float, shape: Shape) -> None:
    """Kalidindi, Abusafieh & El-Danaf 1997: measured compliance, a polynomial of the force."""
    test.reading.append(
        lambda travel, force: (
            travel
            + a
            * (force / test.scales.force + shape["curve"] * (force / test.scales.force) ** 2)
            / (1.0 + shape["curve"])
        )
    )


def _backlash(test: BenchTest, a: float, shape: Shape) -> None:
    """Tao & Kokotovic 1996: play of half-width a/2 between the screw's encoder and the crosshead."""
    test.reading.append(lambda travel, force: travel + _play(test.programme.travel, a, sharp=True))


def _worn_screw(test: BenchTest, a: float, shape: Shape) -> None:
    """Dahl 1968: the play is taken up gradually, over some times its width."""
    test.reading.append(lambda travel, force: travel + _play(test.programme.travel, a, sharp=False, over=shape["over"]))


def _play(travel: FloatArray, width: float, *, sharp: bool, over: float = 1.0) -> FloatArray:
    """How far the encoder is ahead: 0 while it loads, down to -width after a reversal."""
    ahead, now = np.zeros_like(travel), 0.0
    for k, step in enumerate(np.diff(travel)):
        if sharp:
            now = min(max(now + step, -width), 0.0)
        else:
            goal = 0.0 if step > 0.0 else -width
            now += (goal - now) * -np.expm1(-abs(step) / (over * max(width, 1e-9)))
        ahead[k + 1] = now
    return ahead


def _slack(test: BenchTest, a: float, shape: Shape) -> None:
    """The load train hangs loose: the crosshead goes a before the specimen follows."""
    test.travel = np.maximum(test.travel - a, 0.0)
    test.reading.append(lambda travel, force: test.programme.travel)


def _seating(test: BenchTest, a: float, shape: Shape) -> None:
    """Toe of ASTM D638, annex A1: wedges and pins seat, e + a (1 - exp(-F/F_0))."""
    test.reading.append(
        lambda travel, force: travel - a * np.expm1(-np.maximum(force, 0.0) / (shape["force"] * test.scales.force))
    )


def _extensometer_class(test: BenchTest, a: float, shape: Shape) -> None:
    """ISO 9513, relative error of an extensometer: (1 + a) e."""
    test.reading.append(lambda travel, force: travel * (1.0 + a))


def _effective_gauge(test: BenchTest, a: float, shape: Shape) -> None:
    """ASTM D638, effective gauge length of a dumb-bell: the fillets strain, too, less than the shank: e + a e^m."""
    whole = np.expm1(test.scales.strain)
    test.reading.append(lambda travel, force: travel + a * whole * np.maximum(travel / whole, 0.0) ** shape["m"])


def _gain(test: BenchTest, a: float, shape: Shape) -> None:
    """ISO 7500-1, relative error of indication: F (1 + a)."""
    test.force.append(lambda force: force * (1.0 + a))


def _excitation(test: BenchTest, a: float, shape: Shape) -> None:
    """ISO 376, effect of temperature on sensitivity: the bridge warms, F (1 + a (1 - part exp(-t/t_w)))."""
    warm = 1.0 - shape["part"] * np.exp(-test.time / (shape["time"] * test.scales.duration))
    test.force.append(lambda force: force * (1.0 + a * warm))


def _zero(test: BenchTest, a: float, shape: Shape) -> None:
    """The cell was not tared: F + a F_m."""
    test.force.append(lambda force: force + a * test.scales.force)


def _grip_weight(test: BenchTest, a: float, shape: Shape) -> None:
    """The upper grip hangs in the cell, and rests on the specimen at first: F + a F_m (1 - exp(-F/F_0))."""
    test.force.append(
        lambda force: (
            force - a * test.scales.force * np.expm1(-np.maximum(force, 0.0) / (shape["force"] * test.scales.force))
        )
    )


def _thermal_zero(test: BenchTest, a: float, shape: Shape) -> None:
    """ISO 376, effect of temperature on zero, the room changing evenly: F + a F_m t/T."""
    test.force.append(lambda force: force + a * test.scales.force * test.time / test.scales.duration)


def _warming_up(test: BenchTest, a: float, shape: Shape) -> None:
    """Newton's cooling of a cell just switched on: F + a F_m (1 - exp(-t/t_w))."""
    course = -np.expm1(-test.time / (shape["time"] * test.scales.duration))
    test.force.append(lambda force: force + a * test.scales.force * course)


def _bouc_wen(test: BenchTest, a: float, shape: Shape) -> None:
    """Bouc 1967, Wen 1976: dz = (1 - |z| (b sgn(z dF) + 1 - b)) dF / F_0, the cell reads F - a F_m z."""
    reach, b = shape["reach"] * test.scales.force, 0.5 + 0.4 * shape["reach"]

    def read(force: FloatArray) -> FloatArray:
        z, now = np.zeros_like(force), 0.0
        for k, step in enumerate(np.diff(force) / reach):
            for _ in range(3):
                now += (1.0 - abs(now) * (b * np.sign(now * step) + 1.0 - b)) * step / 3.0
            now = float(np.clip(now, -1.2, 1.2))
            z[k + 1] = now
        return np.asarray(force - a * test.scales.force * z)

    test.force.append(read)


def _prandtl_ishlinskii(test: BenchTest, a: float, shape: Shape) -> None:
    """Prandtl 1928, Ishlinskii 1944: stops of six widths in parallel."""
    widths = np.linspace(0.1, 1.0, 6) * shape["reach"] * test.scales.force

    def read(force: FloatArray) -> FloatArray:
        stops, total = np.zeros(6), np.zeros_like(force)
        for k, step in enumerate(np.diff(force)):
            stops = np.clip(stops + step, -widths, widths)
            total[k + 1] = stops.sum()
        return np.asarray(force - a * test.scales.force * total / widths.sum())

    test.force.append(read)


def _filter(test: BenchTest, design: Callable[[float, float], FloatArray], radians: float) -> None:
    """A low pass of that corner [rad/s] on the force, in sections on an even grid; none above the grid's reach."""
    even = np.linspace(test.time[0], test.time[-1], max(4 * len(test.time), 8000))
    rate = 1.0 / (even[1] - even[0])
    corner = radians / (2.0 * np.pi)
    if corner >= 0.45 * rate:
        return
    sections = design(corner, rate)
    start = sosfilt_zi(sections)

    def read(force: FloatArray) -> FloatArray:
        given = np.interp(even, test.time, force)
        late, _ = sosfilt(sections, given, zi=start * given[0])
        return np.asarray(force + np.interp(test.time, even, late - given))

    test.force.append(read)


def _bessel(test: BenchTest, a: float, shape: Shape) -> None:
    """Bessel-Thomson 1949, fourth order, of the group delay a (in a thousandth of the duration)."""
    delay = 1e-3 * a * test.scales.duration
    _filter(test, lambda corner, rate: bessel(4, corner, norm="delay", output="sos", fs=rate), 1.0 / delay)


def _butterworth(test: BenchTest, a: float, shape: Shape) -> None:
    """Butterworth 1930, second order; its delay at low frequencies is sqrt(2)/omega = a thousandths of the duration."""
    delay = 1e-3 * a * test.scales.duration
    _filter(test, lambda corner, rate: butter(2, corner, output="sos", fs=rate), np.sqrt(2.0) / delay)


def _bent(test: BenchTest, a: float, shape: Shape) -> None:
    """ASTM E1012, a bent strip straightens under an extensometer on one face: e - a (1 - exp(-F/F_0))."""
    test.reading.append(
        lambda travel, force: travel + a * np.expm1(-np.maximum(force, 0.0) / (shape["force"] * test.scales.force))
    )


def _eccentric(test: BenchTest, a: float, shape: Shape) -> None:
    """Timoshenko & Gere 1961, beam column: the initial bow goes as 1/(1 + F/F_e)."""

    def read(travel: FloatArray, force: FloatArray) -> FloatArray:
        f = np.maximum(force, 0.0) / (shape["force"] * test.scales.force)
        return np.asarray(travel - a * f / (1.0 + f))

    test.reading.append(read)


def _sudden_preload(test: BenchTest, a: float, shape: Shape) -> None:
    """Closing the grips strains the specimen by a F_m/E, then the extensometer is zeroed and the test begins."""
    _preload(test, a, 1e-4)


def _iso_preload(test: BenchTest, a: float, shape: Shape) -> None:
    """ISO 527-1, 9.4: a preload is laid on over some tau_max, then the strain is set to zero."""
    _preload(test, a, shape["time"])


def _preload(test: BenchTest, a: float, lasting: float) -> None:
    strain = a * test.scales.stress / test.law.modulus
    test.before = strain, lasting
    test.travel = np.expm1(np.log1p(test.travel) + strain)
    test.reading.append(lambda travel, force: test.programme.travel)


def _stick_slip(test: BenchTest, a: float, shape: Shape) -> None:
    """Coulomb: beyond a force the tab slips in steps, each a part of a; the encoder shows them."""
    count = max(round(shape["count"]), 1)
    begin = shape["force"]

    def read(travel: FloatArray, force: FloatArray) -> FloatArray:
        level = np.maximum.accumulate(force) / test.scales.force
        passed = np.zeros_like(level)
        for k in range(count):
            passed += level >= begin + k * (0.95 - begin) / count
        return np.asarray(travel + a * passed / count)

    test.reading.append(read)


def _creeping_grip(test: BenchTest, a: float, shape: Shape) -> None:
    """The tab is drawn out of the jaws at a speed proportional to what the force has above a limit."""

    def read(travel: FloatArray, force: FloatArray) -> FloatArray:
        over = np.maximum(force / test.scales.force - shape["force"], 0.0)
        drawn = np.concatenate([[0.0], np.cumsum(0.5 * (over[1:] + over[:-1]) * np.diff(test.time))])
        return np.asarray(travel + a * drawn / test.scales.duration)

    test.reading.append(read)


def _ringing(test: BenchTest, a: float, shape: Shape) -> None:
    """Den Hartog 1934: the frame rings after every change of the speed, a exp(-z w t) sin(w t) on the force."""
    period, ring = shape["period"] * test.scales.duration, np.zeros(len(test.time))
    for corner in test.programme.corners:
        since = np.maximum(test.time - corner, 0.0)
        ring += np.exp(-since / (shape["lasting"] * period)) * np.sin(2.0 * np.pi * since / period)
    test.force.append(lambda force: force + a * test.scales.force * ring)


def _screw_pitch(test: BenchTest, a: float, shape: Shape) -> None:
    """ISO 230-2, periodic error of a lead screw, once a turn: e + a sin(2 pi e/p)."""
    pitch = shape["pitch"] * _largest_travel(test)
    test.reading.append(lambda travel, force: travel + a * np.sin(2.0 * np.pi * test.programme.travel / pitch))


def _force_unit(scales: Scales) -> float:
    return scales.force


def _delay_unit(scales: Scales) -> float:
    return 1e-3 * scales.duration


def _guide_friction(test: BenchTest, a: float, shape: Shape) -> None:
    """Coulomb 1785: a guide or the seal of a chamber resists the crosshead, a F_m sgn(v), within the force loop."""
    test.force.append(lambda force: force + a * test.scales.force * _direction(test))


def _stribeck(test: BenchTest, a: float, shape: Shape) -> None:
    """Stribeck 1902, Armstrong-Helouvry 1994: the friction falls with the speed, exp(-|v|/v_s), above a floor."""
    speed = np.abs(np.gradient(test.programme.travel, test.time)) / test.scales.rate
    fall = 0.4 + 0.6 * np.exp(-speed / shape["speed"])
    test.force.append(lambda force: force + a * test.scales.force * fall * _direction(test))


def _direction(test: BenchTest) -> FloatArray:
    """Of the crosshead, let go in holds within a hundredth of the duration."""
    wanted = np.sign(np.where(np.abs(np.diff(test.programme.travel)) > 1e-9, np.diff(test.programme.travel), 0.0))
    found, now = np.zeros(len(test.time)), 0.0
    for k, dt in enumerate(np.diff(test.time)):
        now += (wanted[k] - now) * -np.expm1(-dt / (0.01 * test.scales.duration))
        found[k + 1] = now
    return found


RIG = (
    Cause(
        "frame_compliance",
        (
            Form("linear, Hockett & Gillis 1971", _linear_frame, 0.2, {}, crosshead=True),
            Form("Hertz 1882", _hertz_frame, 0.2, {"contact": (0.2, 0.9)}, crosshead=True),
            Form("Kalidindi et al. 1997", _curved_frame, 0.2, {"curve": (0.1, 1.0)}, crosshead=True),
        ),
        rig=True,
    ),
    Cause(
        "backlash",
        (
            Form("Tao & Kokotovic 1996", _backlash, 0.02, {}, crosshead=True),
            Form("Dahl 1968", _worn_screw, 0.02, {"over": (0.5, 4.0)}, crosshead=True),
        ),
        rig=True,
        needs="unloading",
    ),
    Cause(
        "slack",
        (
            Form("loose load train", _slack, 0.05, {}, crosshead=True),
            Form("seating, ASTM D638", _seating, 0.05, {"force": (0.02, 0.2)}, crosshead=True),
        ),
        rig=True,
    ),
    Cause(
        "extensometer_scale",
        (
            Form("ISO 9513", _extensometer_class, 0.3, {}, signed=True),
            Form(
                "effective gauge length, ASTM D638",
                _effective_gauge,
                0.3,
                {"m": (1.1, 2.0)},
                signed=True,
                crosshead=True,
            ),
        ),
        rig=True,
    ),
    Cause(
        "cell_gain",
        (
            Form("ISO 7500-1", _gain, 0.3, {}, signed=True),
            Form(
                "ISO 376, temperature of the bridge",
                _excitation,
                0.3,
                {"part": (0.1, 0.5), "time": (0.1, 0.5)},
                signed=True,
            ),
        ),
        rig=True,
    ),
    Cause(
        "cell_zero",
        (
            Form("not tared", _zero, 0.2, {}, signed=True, unit=_force_unit),
            Form("weight of the grip", _grip_weight, 0.2, {"force": (0.003, 0.03)}, signed=True, unit=_force_unit),
        ),
        rig=True,
    ),
    Cause(
        "cell_thermal_drift",
        (
            Form("ISO 376, temperature of the zero", _thermal_zero, 0.2, {}, signed=True, unit=_force_unit),
            Form("warming up", _warming_up, 0.2, {"time": (0.2, 1.0)}, signed=True, unit=_force_unit),
        ),
        rig=True,
    ),
    Cause(
        "cell_hysteresis",
        (
            Form("Bouc 1967, Wen 1976", _bouc_wen, 0.05, {"reach": (0.1, 0.4)}),
            Form("Prandtl 1928, Ishlinskii 1944", _prandtl_ishlinskii, 0.05, {"reach": (0.2, 0.6)}),
        ),
        rig=True,
        needs="unloading",
    ),
    Cause(
        "amplifier_lag",
        (
            Form("Bessel, Thomson 1949", _bessel, 30.0, {}, unit=_delay_unit),
            Form("Butterworth 1930", _butterworth, 30.0, {}, unit=_delay_unit),
        ),
        rig=True,
    ),
    Cause(
        "bending",
        (
            Form("ASTM E1012", _bent, 0.01, {"force": (0.03, 0.3)}, signed=True),
            Form("Timoshenko & Gere 1961", _eccentric, 0.01, {"force": (0.03, 0.3)}, signed=True),
        ),
        rig=True,
    ),
    Cause(
        "preload",
        (
            Form("closing of the grips", _sudden_preload, 0.3, {}),
            Form("ISO 527-1", _iso_preload, 0.3, {"time": (0.01, 1.0)}),
        ),
        rig=True,
    ),
    Cause(
        "grip_slip",
        (
            Form("stick-slip, Coulomb", _stick_slip, 0.05, {"force": (0.3, 0.8), "count": (1.0, 5.0)}, crosshead=True),
            Form("progressive", _creeping_grip, 0.1, {"force": (0.3, 0.8)}, crosshead=True),
        ),
        rig=True,
    ),
    Cause(
        "machine_vibration",
        (
            Form("den Hartog 1934", _ringing, 0.1, {"period": (0.01, 0.08), "lasting": (1.0, 8.0)}),
            Form("ISO 230-2, lead screw", _screw_pitch, 0.01, {"pitch": (0.02, 0.2)}, crosshead=True),
        ),
        rig=True,
    ),
    Cause(
        "guide_friction",
        (
            Form("Coulomb 1785", _guide_friction, 0.1, {}),
            Form("Stribeck 1902", _stribeck, 0.1, {"speed": (0.1, 2.0)}),
        ),
        rig=True,
        needs="turns",
    ),
)
