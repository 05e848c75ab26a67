"""
How a caravan begins to sway
============================

A caravan is judged at 100 km/h, its eigenvalues are followed over speed, and one remedy is tried.
"""

import ucrit

caravan = ucrit.load("caravan")
found = ucrit.analyze(caravan)
found

# %%
# The same as a picture: eigenvalues against speed, with the speed at which the sway stops decaying.

before = ucrit.plot(found)

# %%
# Among the remedies, the one with the smallest change moves the centre of mass back towards the axle.

(remedy, *_) = found.remedies
print(remedy)
better = caravan.with_(a=remedy.value)
print(ucrit.analyze(better).sentence)

# %%
# After it, the oscillation decays at every speed up to the one asked for.

after = ucrit.plot(ucrit.locus(better))
