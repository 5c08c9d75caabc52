"""Where does each arm lose a freedom?"""

import screwkit as sk

planar = sk.load("dual_planar_arm")
for limb in sk.singularities(planar).limb:
    for component in limb.components:
        print(limb.limb, component.equations, "rank", component.rank)
    print("complete:", limb.complete)
