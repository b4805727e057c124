"""
A strain of the stage, a strain of the video
============================================

**Measured:** a Ti–Zr–Nb alloy on a small tensile stage, and the distance of two markers by
video (Gazder and Niessen).

**A law would miss:** the elastic part, by far. The stage's displacement makes the metal look as
soft as a polymer.

**It is:** the compliance and the slack of the stage, a third of a millimetre on a gauge of
five. Here the cause is known, because the video saw the specimen itself. A metal needs another
law, so no fit is made: the case shows what a record looks like whose strain is not the
specimen's.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np


def data() -> Path:
    """The folder of the measured records: beside the checkout, above this script."""
    return next(
        at / "shared/data" for at in Path.cwd().parents if (at / "shared/data").is_dir()
    )


def numbers(path, columns):
    """The rows of numbers below the header."""
    rows = []
    for line in path.read_text(encoding="latin-1").splitlines():
        cells = line.replace(",", ".").split("\t")
        try:
            rows.append([float(cell) for cell in cells[:columns]])
        except ValueError:
            continue
    return np.array([row for row in rows if len(row) == columns])


gauge, area = 5.1, 2.21 * 0.95
stage = numbers(data() / "zr-ti-nb/stage.txt", 8)
video = numbers(data() / "zr-ti-nb/video-extensometer.txt", 12)
time, displacement, force = stage[:, 0], stage[:, 3] * 1e-3, stage[:, 4]  # s, mm, N
by_video = video[:, 6] / video[0, 6] - 1.0  # the outer pair of markers

# %%
# Two clocks: the video starts when it is switched on. Both curves begin to rise, and both have
# a knee, 45 s apart; that is the shift.

shift = 45.0
figure, axes = plt.subplots(figsize=(6.4, 3.0))
axes.plot(time, force / force.max(), label="force, stage")
axes.plot(
    video[:, 0] + shift,
    by_video / by_video.max(),
    label="distance of the markers, video, shifted",
)
axes.set(xlabel="time of the stage [s]", ylabel="part of the largest [–]", xlim=(60, 185))
axes.legend()

# %%
# The same force over both strains:

started, ended = np.argmax(force > 25.0), np.argmax(force)
loaded = slice(started, ended)
by_stage = (displacement - displacement[started]) / gauge
strain = np.interp(time, video[:, 0] + shift, by_video)
figure, axes = plt.subplots(figsize=(6.4, 3.6))
axes.plot(100 * by_stage[loaded], (force / area)[loaded], label="strain of the stage")
axes.plot(100 * strain[loaded], (force / area)[loaded], label="strain of the video")
axes.set(xlabel="engineering strain [%]", ylabel="engineering stress [MPa]")
axes.legend()
# sphinx_gallery_thumbnail_number = 2

# %%
# At 500 MPa the stage has moved by far more than the specimen:

at = started + np.argmax((force / area)[loaded] > 500.0)
print(f"stage {100 * by_stage[at]:.1f} %, markers {100 * strain[at]:.1f} %:", end=" ")
print(f"{gauge * (by_stage[at] - strain[at]):.2f} mm went into the stage")

# %%
# A polymer ten times softer than the stage hides the same fault better: there it looks like a
# softer start, or like an effect of the material.
# :doc:`/built/cases/synthetic/case_2_the_machine_gives_way` shows how a diagnosis finds it
# where other records of the same material are sound.
