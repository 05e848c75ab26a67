"""Pictures of the gallery: figures of `ucrit.plot`, which belong to no window, but are named in an example."""

from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst


def figures(block, block_vars, gallery_conf):
    """Save the figures that a block has made; return what shows them."""
    made = [v for v in block_vars["example_globals"].values() if isinstance(v, Figure) and not hasattr(v, "_shown")]
    paths = []
    for figure, path in zip(made, block_vars["image_path_iterator"], strict=False):
        figure.savefig(path, dpi=110, metadata={"Software": None})
        figure._shown = True
        paths.append(path)
    return figure_rst(paths, gallery_conf["src_dir"])
