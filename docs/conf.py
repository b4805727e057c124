"""How Sphinx builds the site; `make docs` calls it, warnings being errors."""

import shutil
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "extensions"))

import matplotlib as mpl  # noqa: E402

mpl.use("agg")

from matplotlib.figure import Figure  # noqa: E402
from sphinx.application import Sphinx  # noqa: E402
from sphinx_gallery.scrapers import figure_rst  # noqa: E402

import probation  # noqa: E402
from probation.report.style import MATPLOTLIB  # noqa: E402

project = "probation"
author = "the authors of probation"
project_copyright = "the authors of probation"
release = version = probation.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "mathml",
    "outside",
    "stacked",
    "generated",
    "explained",
]
exclude_patterns = ["extensions/**", "tutorials/**", "cases/**", "built/**/*.ipynb", "built/**/*.py", "built/**/*.zip"]
suppress_warnings = ["config.cache"]  # the order of the gallery is a class, which cannot be pickled
nitpicky = False

myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist"]
myst_heading_anchors = 4
myst_links_external_new_tab = False

autosummary_generate = True
autosummary_generate_overwrite = True
autosummary_filename_map = {  # probation.Fit beside probation.fit, also where file names know no case
    f"probation.{name}": f"probation.class_{name}" for name in probation.__all__ if name[0].isupper()
}
autodoc_typehints = "none"  # the docstrings give types, shapes and units
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False
templates_path = ["templates"]

html_theme = "pydata_sphinx_theme"
html_title = "probation"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_sidebars = {"comparison": [], "index": [], "recipes": []}  # no page stands below them
html_show_sourcelink = False
html_theme_options = {
    "navbar_end": ["theme-switcher"],
    "secondary_sidebar_items": ["page-toc", "sg_download_links"],
    "show_prev_next": True,
    "navigation_with_keys": False,
    "header_links_before_dropdown": 7,
    "footer_start": ["copyright"],
    "footer_end": [],
}

MEASURED = HERE.parents[1] / "shared" / "data"  # beside the checkout; not part of it


def _plain_figures(gallery_conf: dict[str, object], fname: str) -> None:
    """Every figure in the style of the program's own."""
    mpl.rcParams.update(mpl.rcParamsDefault)
    mpl.rcParams.update(MATPLOTLIB)
    mpl.use("agg")


_SHOWN: set[Figure] = set()


def _program_figures(block: tuple, block_vars: dict, gallery_conf: dict) -> str:
    """The figure that a block ends with, where it is the program's own: those are bound to no window."""
    shown = block_vars["example_globals"].get("___")
    if not isinstance(shown, Figure) or shown in _SHOWN:
        return ""
    _SHOWN.add(shown)
    path = next(block_vars["image_path_iterator"])
    shown.savefig(path, dpi=120)  # about the size that it is drawn for
    return figure_rst([path], gallery_conf["src_dir"])


sphinx_gallery_conf = {
    "examples_dirs": ["tutorials", "cases"],
    "gallery_dirs": ["built/tutorials", "built/cases"],
    "filename_pattern": r"\.py$",
    "ignore_pattern": r"__init__\.py" if MEASURED.is_dir() else r"(__init__\.py|/measured/.*\.py)",
    "within_subsection_order": "FileNameSortKey",
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "write_computation_times": False,
    "abort_on_example_error": True,
    "plot_gallery": "True",
    "reset_modules": (_plain_figures, "seaborn"),
    "copyfile_regex": r".*\.rst",
    "nested_sections": True,
    "min_reported_time": 1,
    "image_srcset": ["2x"],
    "image_scrapers": ("matplotlib", _program_figures),
    "capture_repr": ("_repr_html_",),
}


def setup(app: Sphinx) -> None:
    """Take away what tutorials wrote: they run beside their scripts."""

    def tidy(app: Sphinx, exception: Exception | None) -> None:
        for folder in (HERE / "tutorials").glob("tutorial-*/"):
            shutil.rmtree(folder)

    app.connect("build-finished", tidy)
