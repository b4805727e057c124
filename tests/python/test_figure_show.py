"""Figures are shown on a display where there is one, and say what to do where there is none."""

import sys
from types import ModuleType

import matplotlib as mpl
import matplotlib.pyplot as plt
import pytest
from matplotlib.backend_bases import FigureManagerBase
from matplotlib.backends.backend_agg import FigureCanvasAgg

from probation import InputError
from probation.report.figures import new_figure


@pytest.fixture(autouse=True)
def the_backend_of_before():
    before = mpl.get_backend()
    yield
    plt.close("all")
    plt.switch_backend(before)


def test_without_a_display_the_error_says_how_to_keep_the_figure():
    plt.switch_backend("agg")
    with pytest.raises(InputError, match=r"no display .*savefig"):
        new_figure().show()
    assert plt.get_fignums() == []


def test_with_a_display_the_figure_stands_in_a_window(monkeypatch):
    shown = []

    class Window(FigureManagerBase):
        @classmethod
        def pyplot_show(cls, *, block=None):
            shown.extend(plt.figure(number) for number in plt.get_fignums())

    class Canvas(FigureCanvasAgg):
        required_interactive_framework = "headless"
        manager_class = Window

    screen = ModuleType("a_screen")
    screen.FigureCanvas, screen.FigureManager = Canvas, Window
    monkeypatch.setitem(sys.modules, "a_screen", screen)
    monkeypatch.delenv("DISPLAY", raising=False)
    plt.switch_backend("module://a_screen")
    figure = new_figure()
    figure.show()
    assert shown == [figure]
