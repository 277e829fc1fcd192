// The size of a stack as ImageJ opens it.
open(getArgument());
print(getWidth() + " x " + getHeight() + " x " + nSlices());
