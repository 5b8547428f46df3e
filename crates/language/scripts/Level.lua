-- The last segment is horizontal for every rotation of the branch.
local branch = lsystem({ object = turtle() })
branch:axiom(Pitch(40), Roll(70), F(1), Level(), Turn(45), F(1))
branch:derive()
