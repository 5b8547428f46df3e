-- Halfway between two numbers, and between two vectors.
print(lerp(2, 6, 0.5))
print(lerp(vec(0, 0, 0), vec(4, 2, 0), 0.5))
