// The surface as the bytes of a mesh file: OBJ (positions, normals, one group a patch), binary PLY
// (normals, mean curvature, patch) and binary STL.
//
// Numbers in OBJ are the shortest that read back as the same bits; PLY holds doubles; STL has
// single precision only, and a surface that does not fit it is a Failure.
#pragma once

#include <string>

#include "wireskin.h"

namespace wireskin_cli {

// The format follows from the extension of the file: .obj, .ply or .stl.
// With `curves`, those of the network are there too, as they are in the mesh: polylines (l) in
// groups curve_K, in PLY edges with their curve; STL has no place for them.
std::string mesh_bytes(const wsk_surface_view& surface, const std::string& file,
                       bool curves = false);

std::string obj_bytes(const wsk_surface_view& surface, bool curves = false);
std::string ply_bytes(const wsk_surface_view& surface, bool curves = false);
std::string stl_bytes(const wsk_surface_view& surface, const std::string& file);

}  // namespace wireskin_cli
