local bay = extruded(panel({ width = 2 }), { depth = 0.6 })
print(bay:min_width())
