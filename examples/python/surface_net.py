r"""Surfaces a network in T. Stanko's format (.net) through ctypes and writes the mesh as OBJ.

    c++ -std=c++17 -O2 -ffp-contract=off -fPIC -shared -DWIRESKIN_IMPLEMENTATION \
        -x c++ ../../single_include/wireskin.h -o libwireskin.so
    python3 surface_net.py ./libwireskin.so ../data/sphere.net sphere.obj

Python's standard library is all it needs. The structs are those of src/wireskin.h. Options and report
are passed as null: the defaults, and the status alone.
"""

import ctypes
import sys
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_size_t, c_uint32, c_void_p


class Curve(ctypes.Structure):
    _fields_ = [
        ("sample_count", c_size_t),
        ("positions", POINTER(c_double)),
        ("position_stride", c_size_t),
        ("normals", POINTER(c_double)),
        ("normal_stride", c_size_t),
        ("nodes", POINTER(c_uint32)),
        ("closed", c_int32),
        ("boundary", c_int32),
        ("soft", c_double),
        ("sharp", c_int32),
        ("normals_right", POINTER(c_double)),
        ("normal_right_stride", c_size_t),
    ]


class View(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("patch_count", c_uint32),
        ("curve_edge_count", c_uint32),
        ("positions", POINTER(c_double)),
        ("normals", POINTER(c_double)),
        ("mean_curvature", POINTER(c_double)),
        ("gaussian_curvature", POINTER(c_double)),
        ("vertex_curve", POINTER(c_uint32)),
        ("constraint_normals", POINTER(c_double)),
        ("triangles", POINTER(c_uint32)),
        ("triangle_patch", POINTER(c_uint32)),
        ("curve_edges", POINTER(c_uint32)),
        ("curve_edge_curve", POINTER(c_uint32)),
    ]


def load(path):
    library = ctypes.CDLL(path)
    library.wsk_build.argtypes = [POINTER(Curve), c_size_t, c_void_p, POINTER(c_void_p), c_void_p]
    library.wsk_build.restype = c_int32
    library.wsk_status_name.argtypes = [c_int32]
    library.wsk_status_name.restype = c_char_p
    library.wsk_surface_get_view.argtypes = [c_void_p, POINTER(View), c_size_t]
    library.wsk_surface_get_view.restype = None
    library.wsk_surface_free.argtypes = [c_void_p]
    library.wsk_surface_free.restype = None
    return library


def read_net(path):
    """A list of (positions, normals, nodes, closed, boundary), the numbers flat."""
    with open(path) as file:
        lines = iter([line.split() for line in file if line.strip()])
    vertices = [[float(x) for x in next(lines)] for _ in range(int(next(lines)[0]))]
    curves = []
    for _ in range(int(next(lines)[0])):
        boundary = int(next(lines)[0])
        nodes = [int(i) for i in next(lines)]
        closed = nodes[0] == nodes[-1]
        if closed:
            nodes.pop()
        positions = [x for i in nodes for x in vertices[i][:3]]
        normals = [x for i in nodes for x in vertices[i][3:6]]
        curves.append((positions, normals, nodes, closed, boundary))
    return curves


def build(library, network):
    """Positions (three a vertex) and triangles (three indices each) as lists."""
    curves = (Curve * len(network))()
    keep = []  # the arrays must live until the call returns
    for curve, (positions, normals, nodes, closed, boundary) in zip(curves, network):
        arrays = (
            (c_double * len(positions))(*positions),
            (c_double * len(normals))(*normals),
            (c_uint32 * len(nodes))(*nodes),
        )
        keep.append(arrays)
        curve.sample_count = len(nodes)
        curve.positions, curve.normals, curve.nodes = arrays
        curve.closed, curve.boundary = closed, boundary
    surface = c_void_p()
    status = library.wsk_build(curves, len(network), None, byref(surface), None)
    if status != 0:
        raise RuntimeError(library.wsk_status_name(status).decode())
    view = View()
    library.wsk_surface_get_view(surface, byref(view), ctypes.sizeof(view))
    positions = view.positions[: 3 * view.vertex_count]
    triangles = view.triangles[: 3 * view.triangle_count]
    library.wsk_surface_free(surface)
    return positions, triangles


def main():
    if len(sys.argv) != 4:
        sys.exit("usage: surface_net.py LIBRARY INPUT.net OUTPUT.obj")
    library = load(sys.argv[1])
    positions, triangles = build(library, read_net(sys.argv[2]))
    with open(sys.argv[3], "w") as file:
        for i in range(0, len(positions), 3):
            file.write("v %r %r %r\n" % tuple(positions[i : i + 3]))
        for i in range(0, len(triangles), 3):
            file.write("f %d %d %d\n" % tuple(t + 1 for t in triangles[i : i + 3]))
    print(len(positions) // 3, "vertices,", len(triangles) // 3, "triangles")


main()
