# Reads a particle file of bondline (lib/particle-file/FORMAT.md) in R.
#   s <- read_mpts("final.mpts"); s$arrays$position   # (n, 3), m; blocks as logical (nx, ny, nz)
read_mpts <- function(path) {
  f <- file(path, "rb"); on.exit(close(f))
  u8 <- function(n = 1) readBin(f, "integer", n, 1, signed = FALSE)
  f64 <- function(n = 1) readBin(f, "double", n, 8, endian = "little")
  # R has no integers beyond 2^31: halves of 16 bits, exact up to 2^53.
  uint <- function(n, bytes) {
    h <- matrix(readBin(f, "integer", n * bytes / 2, 2, signed = FALSE, endian = "little"), bytes / 2)
    colSums(h * 65536^(seq_len(bytes / 2) - 1))
  }
  u32 <- function(n = 1) uint(n, 4)
  u64 <- function(n = 1) uint(n, 8)
  text <- function() { x <- readBin(f, "raw", u64()); s <- rawToChar(x); Encoding(s) <- "UTF-8"; s }
  many <- function(one) lapply(seq_len(u64()), function(i) one())
  magic <- u8(8); version <- u32(); u32(); length <- u64(); u64()
  if (!identical(magic, c(137L, 77L, 80L, 84L, 83L, 13L, 10L, 26L)) || version != 1 ||
      length != file.size(path)) stop(path, " is not a whole particle file of version 1")
  s <- list(kind = c("specimen", "bond", "state", "checkpoint")[u32() + 1], voxel_m = f64(),
            normal = c("x", "y", "z")[u8() + 1], box_min_m = f64(3), box_max_m = f64(3),
            time_s = f64(), step = u64())
  s$blocks <- many(function() list(name = text(), adhesive = u32() == 1, dims = u64(3),
                                   origin_m = f64(3), voxel_m = f64(), count = u64()))
  s$particles <- u64()
  s$attributes <- many(function() c(name = text(), value = text()))
  many(function() { text(); text(); many(text); many(function() { text(); u64() }) }) # provenance
  arrays <- many(function() list(name = text(), element = u32(), components = u32(), rows = u64(),
                                 offset = u64(), hash = u64()))
  read <- function(i) {
    a <- arrays[[i]]; n <- a$components * a$rows
    seek(f, a$offset)
    if (a$element == 0) {                                # rows of 64-bit words, lowest bit first
      bits <- matrix(as.logical(rawToBits(readBin(f, "raw", 8 * n))), 64 * a$components)
      dims <- s$blocks[[i]]$dims
      return(array(bits[seq_len(dims[1]), ], dims))
    }
    values <- switch(a$element, readBin(f, "double", n, 4, endian = "little"), f64(n), u32(n),
                     u64(n), u8(n), u8(n))
    matrix(values, ncol = a$components, byrow = TRUE)
  }
  s$arrays <- lapply(seq_along(arrays), read)
  names(s$arrays) <- vapply(arrays, function(a) a$name, "")
  s
}
