"""What a figure shows: artists by their group id, and texts."""


def find(figure, gid):
    """Artists of a group id, in all axes."""
    found = []
    for axes in all_axes(figure):
        found += [artist for artist in axes.get_children() if artist.get_gid() == gid]
    return found


def all_axes(figure):
    return [*figure.get_axes(), *(axes for sub in getattr(figure, "subfigs", ()) for axes in sub.get_axes())]


def texts(figure):
    """All visible texts but tick labels."""
    return [t.get_text() for axes in all_axes(figure) for t in axes.texts]


def legend_texts(figure):
    return [t.get_text() for legend in figure.legends for t in legend.get_texts()]
