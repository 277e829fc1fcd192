# Sums of the arrays of a particle file as check.py prints them.
arguments <- commandArgs(TRUE)
source(arguments[1])
arrays <- read_mpts(arguments[2])$arrays
for (name in names(arrays)) {
  a <- arrays[[name]]
  # Rows of a column together, as they are stored; a block is x fastest as it is.
  values <- as.numeric(if (length(dim(a)) == 2) t(a) else a)
  weights <- seq_along(values) %% 1009
  cat(sprintf("%s %d %.6e\n", gsub("-", "_", name), length(values), sum(values * weights)))
}
