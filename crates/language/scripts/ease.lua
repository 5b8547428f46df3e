-- Six easing functions from 0 to 1, each at a quarter.
print(ease["in"](0.25), ease.out(0.25), ease.inout(0.25))
print(ease.smooth(0.25), ease.sine(0.25), ease.back(0.25))
