"""
In a notebook
=============

Vehicles and results show themselves as small tables, formulas typeset. Nothing here is printed: each block ends with
the object.
"""

import numpy as np

import ucrit

caravan = ucrit.load("caravan")
caravan

# %%
ucrit.modes(caravan)

# %%
ucrit.critical(caravan, "c")

# %%
ucrit.criteria(ucrit.find_model("trailer-undamped-hitch"))

# %%
ucrit.remedies(caravan)

# %%
# A map shows itself by a thumbnail.

stable = ucrit.stability_map(caravan, U=np.linspace(10, 40, 120), c=np.linspace(0, 2e4, 90))
stable

# %%
# ``ucrit.plot`` draws it in full.

picture = ucrit.plot(stable)

# %%
# Tables are shown by their first rows; all of them leave for pandas, xarray, MATLAB, CSV and netCDF.

sweep = ucrit.sweep(caravan, U=np.linspace(10, 40, 301))
sweep

# %%
sweep.to_dataframe().describe()

# %%
# And whose work it rests on:

ucrit.cite(caravan, "critical")
