"""How movable are two arms that hold one object, and why do the counts agree?"""

import screwkit as sk

nao = sk.load("nao_t14")
answer = sk.mobility(nao)
for working in answer.workings:
    print(f"{working.name:18} {working.formula} = {working.value}")
for case in answer.platform.cases:
    where = ", ".join(case.conditions) or "in general"
    print(f"{case.motion_type}  {where}: {case.reason}")
