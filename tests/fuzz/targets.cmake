# The fuzz targets, one for each format that the command reads and one for each part of the library.
set(fuzz_formats net rawnet obj ply table points curves curve contour curf)
set(fuzz_parts connect integrate network region delaunay3 cholesky patches flow pipeline)
