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
std::string mesh_bytes(const wsk_surface_view& surface, const std::string& file);

std::string obj_bytes(const wsk_surface_view& surface);
std::string ply_bytes(const wsk_surface_view& surface);
std::string stl_bytes(const wsk_surface_view& surface, const std::string& file);

}  // namespace wireskin_cli
