% Sums of the arrays of a particle file as check.py prints them.
arguments = argv();
addpath(arguments{1});
s = mpts(arguments{2});
for name = fieldnames(s.arrays)'
  a = double(s.arrays.(name{1}));
  if ndims(a) == 2, a = a'; end    % rows of a column together, as they are stored
  weights = mod(1:numel(a), 1009)';
  printf("%s %d %.6e\n", name{1}, numel(a), sum(a(:) .* weights));
end
