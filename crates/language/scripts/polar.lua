-- Three positions on a circle with a radius of 2 m, 1 m above the ground.
for angle = 0, 240, 120 do
  print(polar(2, angle, 1))
end
