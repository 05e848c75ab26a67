"""
How a car handles near the limit
================================

The handling diagram of a car on tires that slide: steer angle against lateral acceleration, until an axle lets go.
"""

import ucrit

car = ucrit.load("understeering-car")
turn = ucrit.steady_turn(car)
turn

# %%
# Linear tires give the first slope alone. With brush tires the curve bends.

diagram = ucrit.handling_diagram(ucrit.load("ploughing-car"))
picture = ucrit.plot(diagram)

# %%
# What each response to the steering wheel looks like in numbers:

yaw = ucrit.transfer(car, "delta_f", "r")
yaw
