-- Three branches: pitched down, down by another name, and up.
local fan = lsystem({ object = turtle({ angle = 30 }) })
fan:axiom({ Pitch(), F(1) }, { Down(60), F(1) }, { Up(45), F(1) })
fan:derive()
