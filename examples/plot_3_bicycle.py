"""
Weave and capsize of a bicycle
==============================

The benchmark bicycle (Meijaard, Papadopoulos, Ruina and Schwab 2007), hands off the bars: between which speeds does it
keep itself upright?
"""

import numpy as np

import ucrit

bicycle = ucrit.load("benchmark-bicycle")
speeds = ucrit.critical(bicycle, "U")
speeds

# %%
# It is stable between the two. The eigenvalues over speed, each followed through all crossings:

picture = ucrit.plot(ucrit.locus(bicycle, "U", lower=0.5, upper=10))

# %%
# How the sweep leaves for other tools:

sweep = ucrit.sweep(bicycle, U=np.linspace(0.5, 10, 400))
sweep.to_xarray()["stable"].sum().item()
