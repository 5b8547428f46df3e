-- A mix of three parts brick and one part lime.
print(table.concat(mix("#a8553a", "#e8e4d8", 0.25), ", "))
