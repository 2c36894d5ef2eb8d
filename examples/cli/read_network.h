// Reads curve networks from files. Each reader takes the whole content and the file's name for
// messages, and throws a ReadFailure that names the line of whatever is wrong.
//
// .net      T. Stanko's format: the number of vertices, a row x y z nx ny nz for each, the number
//           of curves, then for each a line 0 or 1 (1: the surface ends here) and a line of indices
//           from 0. Closed if the last index repeats the first, as in OBJ.
// .rawnet   his format of raw measurements, see RawCurve: the number of curves; for each a line 0
//           or 1 (boundary), one 0 or 1 (closed), the number of nodes, their samples from 1, their
//           names, the number of samples and rows length tx ty tz nx ny nz.
// .obj      Wavefront: v, vn, l, curv (see obj_freeform.h), p; f where no curve is given. The i-th
//           vn belongs to the i-th v where there are as many and no face says otherwise, else
//           normals are those that faces name. Curves under a g or o whose name contains "boundary"
//           are boundary curves, under one with "sharp" creases. The rest is passed over.
// .ply      vertices with x y z and maybe nx ny nz, the element edge with vertex1 and vertex2, else
//           faces as loops, else points.
// .csv ...  tables: x y z, then maybe nx ny nz, then maybe a number of the curve; or columns as a
//           header names them. Blank lines or lines "CURVE name" separate curves too.
// .xyz      the same rows as points.
// .curves   CASSIE (Yu et al., 2021): "v N", then N rows x y z.
// .curve    Y. Zhuang, M. Zou et al., cycle discovery, 2013: the number of curves; for each the
//           number of points and two more integers, then rows x y z.
// .contour  Z. Huang, M. Zou, N. Carr, T. Ju, 2017: the number of planes; for each its equation,
//           the numbers of vertices and edges, vertices, edges with two labels.
// .curf     v, e with two indices from 1, tangents, which are passed over.
#pragma once

#include <string>
#include <string_view>

#include "formats.h"
#include "network.h"

namespace wireskin_cli {

// "-" reads the standard input.
Network read_network(const std::string& path);
Network read_network_bytes(const std::string& file, Format format, std::string bytes);

Network read_net(const std::string& file, std::string_view text);
Network read_rawnet(const std::string& file, std::string_view text);
Network read_obj(const std::string& file, std::string_view text);
Network read_ply(const std::string& file, std::string_view bytes);
Network read_table(const std::string& file, std::string_view text);
Network read_points(const std::string& file, std::string_view text);
Network read_curves(const std::string& file, std::string_view text);
Network read_curve(const std::string& file, std::string_view text);
Network read_contour(const std::string& file, std::string_view text);
Network read_curf(const std::string& file, std::string_view text);

}  // namespace wireskin_cli
