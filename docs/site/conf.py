"""What Sphinx is told; see build.py."""

import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
os.environ["COLUMNS"] = "80"

import ucrit  # noqa: E402

project = "ucrit"
author = "The ucrit developers"
copyright = "the ucrit developers, BSD 3-Clause"
release = version = ucrit.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_gallery.gen_gallery", "pages"]
myst_heading_anchors = 3
suppress_warnings = ["ref.python"]  # of several attributes of one name any is shown
default_role = "py:obj"
highlight_language = "text"
add_module_names = False
nitpicky = False
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False
napoleon_use_admonition_for_examples = False

html_theme = "furo"
html_title = f"ucrit {release}"
html_static_path = [str(HERE / "static")]
html_css_files = ["ucrit.css"]
html_copy_source = False
html_show_sphinx = False
html_permalinks_icon = "#"

sphinx_gallery_conf = {
    "examples_dirs": str(HERE.parents[1] / "examples"),
    "gallery_dirs": "gallery",
    "filename_pattern": "/plot_",
    "image_scrapers": ("gallery.figures",),
    "abort_on_example_error": True,
    "capture_repr": ("_repr_html_", "__str__"),
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "remove_config_comments": True,
    "within_subsection_order": "FileNameSortKey",
}
