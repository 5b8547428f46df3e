-- A colour as three numbers from 0 to 1.
print(table.concat(rgb("#336699"), ", "))
