-- From storeys, 1 to 20, to a width, 4 m to 12 m.
print(remap(5, 1, 20, 4, 12))
