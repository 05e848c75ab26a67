"""
Shimmy beyond the critical speed
================================

A caster on a tire that relaxes is let go from one degree: the linear equations say that it oscillates and grows, the
non-linear ones how it goes on.
"""

import ucrit

caster = ucrit.load("shimmying-caster")
print(ucrit.analyze(caster).sentence)

# %%
# The motion from one degree.

motion = ucrit.simulate(caster, 1.5, {"theta": "1 deg"})
picture = ucrit.plot(motion)

# %%
# With a damper at its pivot it settles.

damped = ucrit.load("shimmying-caster-damped")
print(ucrit.analyze(damped).sentence)
settled = ucrit.plot(ucrit.simulate(damped, 1.5, {"theta": "1 deg"}))
