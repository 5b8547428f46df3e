--!strict
-- Burgeon's standard library: what every script has besides Luau itself.
return {}
