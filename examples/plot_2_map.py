"""
A map of what is stable
=======================

Where the load is and how stiff the hitch is, each varied over the range that a designer has. The border is found
without the grid, to nine digits.
"""

import numpy as np

import ucrit

caravan = ucrit.load("caravan")
stable = ucrit.stability_map(caravan, a=np.linspace(3, 4.5, 240), k=np.geomspace(1e3, 1e5, 160))
stable

# %%
# The design lies on the wrong side of it.

picture = ucrit.plot(stable)

# %%
# The border by itself, with the kind of each of its parts.

border = ucrit.boundary(caravan, a=(3, 4.5), k=(1e3, 1e5))
print(border)
