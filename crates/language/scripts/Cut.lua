-- A stem that sheds its lowest branches: a branch is cut three steps after it was made.
local Apex, Branch = module("Apex"), module("Branch", "age")
local stem = lsystem({ object = turtle({ angle = 40, width = 0.05 }) })
stem:axiom(Apex())
stem:rule("Apex", "F(0.4) /(137.5) [ + Branch(0) F(1) ] Apex")
stem:rule("Branch(2)", "Cut")
stem:rule("Branch(age)", "Branch(age + 1)")
stem:derive(8)
