/*
 * wireskin - smooth surfaces through networks of space curves.
 *
 * You give curves in space with surface normals and say where the curves meet; you get one smooth
 * triangle mesh that passes through them (wsk_build). The method is that of T. Stanko, S. Hahmann,
 * G.-P. Bonneau, N. Saguin-Sprynski, "Surfacing Curve Networks with Normal Control", Computers and
 * Graphics 60, 2016: cycles from oriented normals, a constrained Delaunay triangulation of every
 * cycle in its plane, normals propagated from the curves, and a surface whose mean curvature
 * follows them.
 *
 * Curves may come raw: fragments that miss each other, normals known here and there. wsk_connect
 * makes a network of them for wsk_build. And they may come without any normals: wsk_flow_build
 * finds the voids that they cage, wsk_flow_surface the surface round these (B. Sadri, K. Singh,
 * "Flow-Complex-Based Shape Reconstruction from 3D Curves", ACM Transactions on Graphics 33, 2014).
 *
 * Everything the library needs is inside; it calls nothing but memcpy, memmove, memset, sqrt and,
 * where you give no allocator, malloc and free.
 *
 * In one paragraph:
 *
 *     wsk_options options;
 *     wsk_report report;
 *     wsk_surface* surface = NULL;
 *     wsk_surface_view view;
 *     wsk_options_init(&options, sizeof options);
 *     wsk_report_init(&report, sizeof report);
 *     if (wsk_build(curves, curve_count, &options, &surface, &report) == WSK_OK) {
 *         wsk_surface_get_view(surface, &view, sizeof view);
 *         ... view.positions, view.triangles ...
 *         wsk_surface_free(surface);
 *     } else {
 *         ... report.sentence, report.curve, report.sample ...
 *     }
 *
 * Conventions, for every function below:
 *
 * - Lengths are in the units of your positions; angles in reports are in degrees, times in
 *   milliseconds, sizes of memory in bytes. Indices are zero-based; WSK_NONE means "none".
 * - Normals point to the outer side. Triangles run counter-clockwise seen from there.
 * - Input arrays are read during the call and never kept or changed.
 * - A call that fails leaves its outputs untouched and gives back all memory that it took. The only
 *   thing a failed call writes is the report.
 * - The library has no global state, prints nothing, reads no file, clock or locale. Calls may run
 *   at the same time in different threads; one surface may be read by many threads at once.
 * - The same input gives the same bits on every target, whatever the compiler, the optimisation
 *   level or the byte order. Multiplying all input lengths by a power of two multiplies all output
 *   lengths by exactly that.
 * - Sizes: indices have 32 bits, so the matrix factors have fewer than 2^32 - 1 entries, and a mesh
 *   of the library's fewer than 2^26 vertices, 2^20 edges between two nodes, and 2^16 on the border
 *   of a patch that no plane shows; beyond that the status is WSK_ERROR_TOO_LARGE, known before
 *   anything is meshed where the curves alone show it.
 *
 * ABI: structs that may grow begin with their size, which the _init function writes; a library
 * newer than the caller never touches bytes beyond it. Numbers of constants never change.
 */
#ifndef WIRESKIN_H
#define WIRESKIN_H

#include <stddef.h>
#include <stdint.h>

#define WIRESKIN_VERSION_MAJOR 0
#define WIRESKIN_VERSION_MINOR 1
#define WIRESKIN_VERSION_PATCH 0
#define WIRESKIN_VERSION_STRING "0.1.0"

/* Before each function: hidden symbols are the rule in a shared library, these are the exception.
 * Define WIRESKIN_SHARED to use one (CMake and pkg-config do), nothing for the archive or the
 * single header. */
#if defined(_WIN32) && defined(WIRESKIN_SHARED)
#ifdef WIRESKIN_BUILDING
#define WSK_API __declspec(dllexport)
#else
#define WSK_API __declspec(dllimport)
#endif
#elif defined(__GNUC__) && defined(WIRESKIN_SHARED)
#define WSK_API __attribute__((visibility("default")))
#else
#define WSK_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* "No index": the curve of a free vertex, the place of an error that has none. */
#define WSK_NONE 0xffffffffu

/* ---- Statuses ---------------------------------------------------------------------------------
 */

typedef int32_t wsk_status;

enum {
  WSK_OK = 0,
  /* A null pointer where none is allowed, an option or a count out of its range. */
  WSK_ERROR_BAD_ARGUMENT = 1,
  /* The allocator returned null. The same call may succeed later. */
  WSK_ERROR_OUT_OF_MEMORY = 2,
  /* The memory cap of the options would have been exceeded. */
  WSK_ERROR_MEMORY_CAP = 3,
  /* The cancel callback returned non-zero. */
  WSK_ERROR_CANCELLED = 4,
  /* The result or a matrix does not fit 32-bit indices or the address space; the spacing is too
     small for the network. */
  WSK_ERROR_TOO_LARGE = 5,
  /* No curve, no vertex or no triangle was given. */
  WSK_ERROR_EMPTY = 6,
  /* A curve without samples, or a closed one of fewer than three. */
  WSK_ERROR_TOO_FEW_SAMPLES = 7,
  /* A coordinate or a normal is NaN. */
  WSK_ERROR_NOT_A_NUMBER = 8,
  /* A coordinate or a normal is infinite, or the coordinates span more than a double can hold, or
     they lie more than 2^100 times what they span from the origin. */
  WSK_ERROR_INFINITE = 9,
  /* All samples of a curve are the same point, or (wsk_connect) as good as one beside the size of
     the whole: squares of its lengths underflow. */
  WSK_ERROR_ZERO_LENGTH_CURVE = 10,
  /* Two neighbouring samples of a curve (or the last and the first of a closed one) coincide. */
  WSK_ERROR_DUPLICATE_SAMPLES = 11,
  /* A normal has zero length. Other lengths are fine: normals are made unit. */
  WSK_ERROR_ZERO_NORMAL = 12,
  /* The curves, or the constrained vertices, have no normals and the task needs them; or nothing
     tells the outer side at a node of sharp curves. */
  WSK_ERROR_MISSING_NORMALS = 13,
  /* A vertex index of a triangle is not below the number of vertices. */
  WSK_ERROR_INDEX_OUT_OF_RANGE = 14,
  /* Samples of the same node lie farther apart than 1e-9 of the diagonal of the bounding box. */
  WSK_ERROR_NODE_MISMATCH = 15,
  /* A curve or a point bounds no patch and lies inside none; a boundary curve has the surface on
     both sides, or nothing tells on which; a curve leads away from a border, out to where there is
     no surface. */
  WSK_ERROR_OPEN_NETWORK = 16,
  /* Normals turn by more than 120 degrees between neighbouring samples, point to different sides of
     the surface there or at a node, or leave the order of the curves round a node undecided. If
     only signs are wrong, wsk_connect_options.orient makes them agree. */
  WSK_ERROR_INCONSISTENT_NORMALS = 17,
  /* The normal of a node is parallel to a curve through it: it cannot be the surface's. */
  WSK_ERROR_TANGENT_NORMAL = 18,
  /* The border of a patch runs clockwise round its normals: the outside of an open surface whose
     border is not tagged as boundary. */
  WSK_ERROR_PATCH_WITHOUT_PLANE = 19,
  /* The border of a patch crosses itself in space, or encloses nothing. */
  WSK_ERROR_PATCH_FOLDED = 20,
  /* A patch with a handle: its border passes a curve on both sides, round and round. */
  WSK_ERROR_PATCH_SEVERAL_LOOPS = 21,
  /* wsk_smooth_mesh: the triangles are no oriented manifold, or one of them has no area. */
  WSK_ERROR_BAD_MESH = 22,
  /* wsk_smooth_mesh: a connected component has no constrained vertex, or a vertex of an open border
     is free. */
  WSK_ERROR_UNCONSTRAINED = 23,
  /* The linear system is not positive definite in double precision: the triangles are too thin. Or
     (wsk_smooth_mesh) its solution spoils the mesh: the triangle named has less height than 1e-10
     of its longest edge and less than any had in its component, or went farther than the diagonal
     of the whole. */
  WSK_ERROR_NOT_POSITIVE_DEFINITE = 24
};

/* The name of a status as written above without its prefix, in lower case ("zero_normal");
   "unknown" for other numbers. Static text. */
WSK_API const char* wsk_status_name(wsk_status status);

/* ---- Stages -----------------------------------------------------------------------------------
 */

typedef int32_t wsk_stage;

enum {
  WSK_STAGE_INPUT = 0,     /* checking and scaling what the caller gave */
  WSK_STAGE_CURVES = 1,    /* splines, resampling */
  WSK_STAGE_NETWORK = 2,   /* nodes, segments, cycles */
  WSK_STAGE_PATCHES = 3,   /* planes, triangulation, one mesh of all patches */
  WSK_STAGE_OPERATORS = 4, /* Laplacian, areas, system matrix, curvature */
  WSK_STAGE_FACTOR = 5,    /* ordering and Cholesky factor */
  WSK_STAGE_SOLVE = 6,     /* right-hand sides */
  WSK_STAGE_RESULT = 7,    /* normals, curvature, checks, copying out */
  WSK_STAGE_COUNT = 8
};

/* The name of a stage in lower case ("curves"); "unknown" for other numbers. Static text. */
WSK_API const char* wsk_stage_name(wsk_stage stage);

/* ---- Options ----------------------------------------------------------------------------------
 */

typedef int32_t wsk_method;

enum {
  /* Stanko et al. 2016: normals and positions propagated biharmonically in the planes of the
     patches, then the positions whose mean curvature vectors fit best those of the propagated
     normals. */
  WSK_METHOD_STANKO = 0,
  /* Least square Laplacian of the positions; normals are not used for the shape. M. Botsch,
     L. Kobbelt, "An Intuitive Framework for Real-Time Freeform Modeling", 2004, order 2. */
  WSK_METHOD_BIHARMONIC = 1,
  /* The same, order 3. */
  WSK_METHOD_TRIHARMONIC = 2,
  /* Biharmonic with the curvature vector prescribed on the curves: method (4) of Stanko et al., for
     comparison. Erratic by nature. */
  WSK_METHOD_CLAMPED = 3,
  /* Stanko's method twice, on the surface itself instead of the planes: a harmonic start, edge
     flips and relaxation before each step. Cheap, and much closer than STANKO on most shapes. */
  WSK_METHOD_ITERATED = 4,
  /* The default: ITERATED, then up to six steps of minimum variation along the normals (after H.
     Moreton, C. Sequin, "Functional Optimization for Fair Surface Design", 1992), in which the
     normals on the curves bind. A patch whose displacement runs away keeps what ITERATED gave; so
     do all where triangles are too thin for these steps. */
  WSK_METHOD_FAIR = 5,
  WSK_METHOD_COUNT = 6
};

typedef int32_t wsk_smoothing;

enum {
  /* AUTO for WSK_METHOD_FAIR and for wsk_flow_build, NONE for all others. */
  WSK_SMOOTHING_DEFAULT = 0,
  /* The samples are exact: curves interpolate them and nodes keep their bits. */
  WSK_SMOOTHING_NONE = 1,
  /* One smoothing spline over each connected component of the network, whose strength is found by
     generalised cross validation, for positions and normals separately; nodes move with their
     curves. Samples without noise stay as they are, bit for bit; so does a component, where
     smoothing would change the size of a curve by more than a fifth, and one of too few samples to
     tell noise from shape (about eight). With sharp curves in the network only positions are
     smoothed, normals stay. P. Craven, G. Wahba, "Smoothing Noisy Data with Spline Functions",
     1979. */
  WSK_SMOOTHING_AUTO = 2,
  /* The same over the whole network at once, with the noise of the positions stated in
     wsk_options.noise; 0 means NONE. Noise that would change the size of a curve by more than a
     fifth is WSK_ERROR_BAD_ARGUMENT. */
  WSK_SMOOTHING_GIVEN = 3,
  WSK_SMOOTHING_COUNT = 4
};

/* `user` is the pointer given beside the callback. None of the callbacks may throw or jump out of
   the library, nor call it with the same surface. */
typedef struct wsk_options {
  size_t size; /* set by wsk_options_init */

  wsk_method method;
  /* Distance between neighbouring vertices on the curves, in your units; 0 (the default): a
     hundredth of the diagonal of the bounding box of all samples. Every stretch of curve between
     two nodes is divided evenly, so distances differ a little from it. Ignored by
     wsk_smooth_mesh. */
  double spacing;
  /* What wsk_build and wsk_flow_build do about noise in the samples, before anything else. */
  wsk_smoothing smoothing;
  /* For WSK_SMOOTHING_GIVEN: the standard deviation of each coordinate, in your units; 0 is none.
   */
  double noise;
  /* Soft constraints: curves pull the surface instead of holding it. A length in your units:
     details of a curve shorter than this are smoothed away, longer ones kept. 0 (the default), or
     less than a thousandth of the spacing: curves hold. More than a tenth of the diagonal of the
     bounding box is refused: nothing would be left to keep. wsk_curve.soft overrides it for one
     curve. */
  double soft;

  /* Memory: aligned for double and pointers, null on failure. `release` is told the size that was
     asked for. Give both or none (malloc and free). The surface keeps them until it is freed. */
  void* (*allocate)(size_t bytes, void* user);
  void (*release)(void* memory, size_t bytes, void* user);
  void* allocator_user;
  /* The most memory the call may hold at any time, result included; 0: no cap. */
  size_t memory_cap;

  /* Asked after about every 10 ms of work, beyond some hundred thousand vertices after a few dozen;
     non-zero ends the call with WSK_ERROR_CANCELLED. */
  int32_t (*cancel)(void* user);
  void* cancel_user;
  /* Told the stage and how much of it is done (0 to 1). */
  void (*progress)(wsk_stage stage, double fraction, void* user);
  void* progress_user;
  /* A clock in milliseconds from any origin, for the times in the report; without it they are 0. */
  double (*now)(void* user);
  void* now_user;

  /* Your thread pool: calls body(index, data) for every index below `count`, in any order and on
     any threads, and returns when all have returned; it must not drop one. Null (the default):
     everything runs on the calling thread. The library starts no threads, and the result has the
     same bits either way. All other callbacks are only called from the thread that made the call,
     never from a body, so they need no locks. What is divided so far is the factorisation of large
     systems, which then needs some MiB more. */
  void (*parallel_for)(uint32_t count, void (*body)(uint32_t index, void* data), void* data,
                       void* user);
  void* parallel_for_user;
  /* Non-zero: a patch that cannot be made is left out, and the surface ends round it; which ones
     these are, and why, stands in wsk_surface_view; where those that are left touch in a node
     without sharing a curve, each has a vertex of its own there. The call fails only where no patch
     can be made. */
  int32_t partial;
  /* Non-zero: the outside of an open surface need not be tagged (wsk_curve.boundary). Where a patch
     would run clockwise round its own normals beyond doubt (its vector area is more than a sixtieth
     of its squared perimeter and lies more than 123 degrees from the mean of its normals) the
     surface ends instead; wsk_report.found_borders counts such places. The ends of tubes and domes,
     whose normals stand across their vector area, do not tell and must still be tagged, and so must
     holes, which would be closed. A curve that leads away from such a border is an error
     (WSK_ERROR_OPEN_NETWORK). Zero (the default): such a patch is an error. */
  int32_t find_borders;
} wsk_options;

/* Writes the defaults into *options. `size` is sizeof(wsk_options) as the caller knows it. Does
   nothing for a null pointer or a size smaller than that of this version's first release. */
WSK_API void wsk_options_init(wsk_options* options, size_t size);

/* ---- Report -----------------------------------------------------------------------------------
 */

typedef int32_t wsk_solver;
enum {
  WSK_SOLVER_DIRECT = 0,
  /* The factor did not fit under the memory cap: conjugate gradients, preconditioned by two factors
     of the Laplacian. Slower by an order of magnitude, in about half the memory. */
  WSK_SOLVER_ITERATIVE = 1,
  WSK_SOLVER_COUNT = 2
};

typedef struct wsk_report {
  size_t size; /* set by wsk_report_init */

  wsk_status status;
  wsk_stage stage; /* where it failed; WSK_STAGE_RESULT after success */
  /* One English sentence without a full stop, or ""; static text. The places that it speaks of
     follow, WSK_NONE where there is none: indices into the caller's curves and samples, the
     caller's node number, the patch, and for wsk_smooth_mesh the caller's vertex and triangle. */
  const char* sentence;
  uint32_t curve;
  uint32_t sample;
  uint32_t node;
  uint32_t patch;
  uint32_t vertex;
  uint32_t triangle;

  /* Counts, as far as the call came. */
  uint32_t curves;
  uint32_t nodes;
  uint32_t segments; /* stretches of curve between nodes; a closed curve without node is one */
  uint32_t patches;
  uint32_t vertices;
  uint32_t free_vertices; /* vertices that are not on a curve */
  uint32_t triangles;
  uint32_t components;          /* connected components of the mesh */
  uint32_t boundary_loops;      /* closed chains of edges with one triangle */
  int32_t euler_characteristic; /* vertices - edges + triangles */

  double spacing;       /* the spacing used, in your units; mean edge length for wsk_smooth_mesh */
  double min_angle_deg; /* the least angle of all triangles of the result */
  /* Of the last linear system A x = b: |b - A x| / |b| in the Euclidean norm, the greatest of its
     columns. What is aimed at is 1e-12; beyond some 30,000 vertices, or where memory_cap leaves no
     room for a factor, 1e-11; beyond 300,000 1e-10. */
  double residual;
  uint32_t factorisations;       /* Cholesky factorisations, of whatever size */
  uint32_t cg_iterations;        /* iterations of conjugate gradients with an earlier factor */
  uint32_t minimal_area_patches; /* patches that no plane shows well: meshed in space instead */
  uint32_t guarded_patches; /* patches that WSK_METHOD_FAIR left as WSK_METHOD_ITERATED made them,
                               or that it or that method put back to an earlier step because the
                               last one folded them; and those that any method spoilt, which keep
                               the triangles that they started from: where one would have less
                               height than 1e-10 of its longest edge, as those of long tubes that
                               the first four methods draw together to a line, or go farther than
                               the diagonal of the whole. Soft curves at these stay where they
                               were given. The view's patch_guarded says which */
  double
      noise_position;  /* standard deviation of each coordinate, estimated or given; 0 if neither */
  double noise_normal; /* the same of the unit normals' components */
  /* Distance of all given samples from the curves of the result, in your units (wsk_build). */
  double constraint_distance_max;
  double constraint_distance_rms;
  /* Angle between the mesh's normal and the one asked for, over the vertices on curves. */
  double normal_deviation_mean_deg;
  double normal_deviation_max_deg;
  /* Angle between the two triangles at an edge of a curve: ridges would show here. */
  double dihedral_mean_deg;
  double dihedral_max_deg;
  size_t peak_bytes;                /* the most memory held at any time during the call */
  double stage_ms[WSK_STAGE_COUNT]; /* 0 without a clock */
  double total_ms;
  wsk_solver solver;       /* how the largest systems were solved; the memory cap decides */
  uint32_t failed_patches; /* left out because of wsk_options.partial */
  /* Patches, of several loops or of one, that might as well have been joined otherwise, or closed
     each alone: the other choice had less than a tenth more area, or the evidence of their normals
     for this one was next to none. WSK_NONE where there is no first one. */
  uint32_t ambiguous_patches;
  uint32_t first_ambiguous_patch;
  uint32_t found_borders; /* outsides that were left open because of wsk_options.find_borders */
  /* Triangles of the result that face against those round them: none in a sound one. Where there
     are some the surface is folded; curves that fold, or normals that contradict them, ask for it.
     WSK_NONE where there is no first one. */
  uint32_t inverted_triangles;
  uint32_t first_inverted_patch;
  /* Patches that no plane shows and whose first mesh is coarser inside than the spacing, at 2, 4 or
     8 times it or with no vertex inside at all, because a finer one would have had triangles
     without area. WSK_NONE where there is no first one. */
  uint32_t coarse_patches;
  uint32_t first_coarse_patch;
} wsk_report;

/* Clears *report; all places become WSK_NONE. Does nothing for a null pointer or too small a size.
 */
WSK_API void wsk_report_init(wsk_report* report, size_t size);

/* ---- Surfaces ---------------------------------------------------------------------------------
 */

typedef struct wsk_surface wsk_surface;

/* How a patch got its triangles before the smoothing: wsk_surface_view.patch_way. */
enum {
  /* In the plane across the mean normal of its border. */
  WSK_PATCH_PLANE = 0,
  /* In space, because no plane shows it well: a triangulation of little area, raised from the
     border along its normals. */
  WSK_PATCH_MINIMAL_AREA = 1
};

/* One curve: `sample_count` points in order, each with the surface normal there. An open curve of
   one sample is a point that the surface passes through; it may lack its normal. */
typedef struct wsk_curve {
  size_t sample_count;
  /* x y z of each sample; the next sample begins position_stride bytes later (0: 24, packed). */
  const double* positions;
  size_t position_stride;
  /* The surface's outer normal at each sample, of any length but zero; stride as above. */
  const double* normals;
  size_t normal_stride;
  /* A number for each sample, or null. Samples of any curves that carry the same number are one
     point: a node, where curves meet. WSK_NONE, or a number that occurs only once, is an ordinary
     sample; so the vertex indices of a file can be passed as they are. Packed. */
  const uint32_t* nodes;
  /* Non-zero: the last sample is followed by the first, which is not repeated. */
  int32_t closed;
  /* Non-zero: the surface ends at this curve, it lies on one side only. */
  int32_t boundary;
  /* How firmly the surface keeps to this curve: 0 as wsk_options.soft says, negative: it holds,
     positive: its own cutoff length. At a node the firmest of its curves decides. Sharp curves
     always hold. */
  double soft;
  /* Non-zero: the curve is a crease. The surface is smooth on each side of it, not across it, and
     has a normal on each side: `normals` are those on the left, seen from outside by someone who
     walks along the curve, `normals_right` those on the right, strides alike. Either may be null:
     not known; the surface then leaves the curve on that side as it likes, and a patch none of
     whose normals are known spans its border with little area. Both may be equal: then the surface
     is smooth across the curve too, but its curvature may jump there (a hemisphere on a cylinder).
     A boundary curve may be sharp to have no normals; a point has no sides and is never sharp.
     Zero, as memset leaves it: the curve is smooth, `normals` hold on both sides and
     `normals_right` is not read. */
  int32_t sharp;
  const double* normals_right;
  size_t normal_right_stride;
} wsk_curve;

/* Surfaces a network of curves.
 *
 * Curves are interpolated by cubic splines in chord length (periodic when closed, tangents of the
 * end parabolas when open), positions and normals alike. Samples nearer than half the curve's mean
 * spacing to the last one kept are left out before that, nodes never; nodes are vertices of the
 * result, bit for bit unless smoothing or softness moves them. Curves may have corners only where
 * two curves end at a node.
 *
 * The cycles that bound patches follow from the order of the curves round each node, seen from the
 * tip of the node's normal. Parts of a network that nothing connects are brought together: what
 * lies inside a patch, seen in its plane, becomes part of it (a boundary loop is a hole in it,
 * another closed curve bounds two patches, dangling curves and points hold the surface), and loops
 * that face each other along the surface bound a band, if that takes less area than closing both.
 * Closed curves apart from all others are joined in pairs so that the area is least over all. A
 * closed curve with surface on both sides that lies inside another one, in its plane, is left to
 * these pairs and not taken into the patch of the plane.
 * Where a patch's border is seen without folds from the mean of its normals (for ITERATED and FAIR:
 * and not too steeply, the mean cosine between them being at least 1/4) it is triangulated in that
 * plane, else by a triangulation of least area in space (G. Barequet, M. Sharir, "Filling Gaps in
 * the Boundary of a Polyhedron", 1995), raised along the normals where these do not agree with any
 * plane: one great circle gives a sphere.
 *
 * Where sharp curves meet, the node's normal is the mean of their sides; where some of these are
 * not known it is estimated from the directions of the curves, outward as the neighbours tell.
 * Round such a node smoothness is asked between one sharp curve and the next; a sharp curve that
 * ends where no other goes on fades out there.
 *
 * `options` may be null (defaults); `report` may be null. On success *surface is the result, to be
 * given to wsk_surface_free; on failure it is untouched. */
WSK_API wsk_status wsk_build(const wsk_curve* curves, size_t curve_count,
                             const wsk_options* options, wsk_surface** surface, wsk_report* report);

/* A triangle mesh of the caller's, some of whose vertices are fixed. */
typedef struct wsk_mesh {
  size_t vertex_count;
  /* x y z of each vertex; stride in bytes (0: 24). Free vertices too: their position sets the
     metric in which the surface is smoothed, so they should lie roughly where the surface will be.
   */
  const double* positions;
  size_t position_stride;
  /* Outer normals; read at constrained vertices only. May be null for the methods that do not use
     normals. */
  const double* normals;
  size_t normal_stride;
  /* One byte a vertex, non-zero: position and normal are kept. Every vertex on an open border and
     at least one of every component must be constrained. */
  const uint8_t* constrained;
  size_t triangle_count;
  /* Three vertex indices a triangle, counter-clockwise from outside, packed. */
  const uint32_t* triangles;
} wsk_mesh;

/* Smooths the caller's mesh: vertices that are not constrained move, vertices and triangles keep
 * their order and number. ITERATED and FAIR may flip edges between vertices that are not both
 * constrained, so a triangle may get other corners; and on a mesh without patches the normals bind
 * FAIR at open borders only, at constrained vertices inside they guide as for ITERATED. In the
 * result every constrained vertex is of curve 0, and every triangle of patch 0. Arguments and
 * outcome as for wsk_build. */
WSK_API wsk_status wsk_smooth_mesh(const wsk_mesh* mesh, const wsk_options* options,
                                   wsk_surface** surface, wsk_report* report);

/* What a surface holds. The arrays belong to the surface and live until it is freed. */
typedef struct wsk_surface_view {
  size_t size; /* set by wsk_surface_get_view */

  uint32_t vertex_count;
  uint32_t triangle_count;
  uint32_t patch_count;
  uint32_t curve_edge_count;

  const double* positions;      /* 3 a vertex */
  const double* normals;        /* 3 a vertex: unit normals of the mesh; at creases see below */
  const double* mean_curvature; /* 1 a vertex: (k1 + k2) / 2, positive on a sphere, per length */
  const double* gaussian_curvature; /* 1 a vertex: k1 k2, per square length */
  const uint32_t* vertex_curve; /* 1 a vertex: the caller's curve (at a node the least), WSK_NONE
                               for a free vertex */
  const double* constraint_normals; /* 3 a vertex: the input's unit normal there (on a crease the
                                       mean of those known), 0 0 0 where free or not known */
  const uint32_t* triangles;        /* 3 a triangle, counter-clockwise from outside */
  const uint32_t* triangle_patch;   /* 1 a triangle */
  const uint32_t* curve_edges;      /* 2 an edge: the curves as resampled, in their direction */
  const uint32_t*
      curve_edge_curve;           /* 1 an edge: the caller's curve; both null for a caller's mesh */
  const uint8_t* patch_guarded;   /* 1 a patch: 1 where it was held back, see guarded_patches; null
                                     for a caller's mesh, and for the first four methods where
                                     nothing was held back */
  const uint8_t* patch_way;       /* 1 a patch: WSK_PATCH_...; null, like the four that follow, for
                                     surfaces of a caller's mesh and of a flow */
  const wsk_status* patch_status; /* 1 a patch: WSK_OK, or why it was left out */
  const char* const* patch_sentence; /* 1 a patch: "", or what was wrong in words; static text */
  const uint32_t* patch_curve_start; /* patch_count + 1: patch p has the caller's curves */
  const uint32_t* patch_curves;      /* patch_curves[patch_curve_start[p]] and so on, ascending */

  /* Corners whose vertex has several sides, of which `normals` holds the mean: at sharp curves; and
     in surfaces from curves alone, unless normals shaped them, at edges between vertices on curves
     where the surface turns by more than 20 degrees, at edges at which other than two triangles of
     one orientation meet, and where sheets touch in a point. Corner k of triangle t is 3 t + k;
     ascending. Null, and none, where there is no crease. */
  const uint32_t* crease_corners;
  const double* crease_normals; /* 3 a corner: the unit normal of its own side */
  uint32_t crease_corner_count;
} wsk_surface_view;

/* Fills *view. `size` is sizeof(wsk_surface_view) as the caller knows it; nothing beyond it is
   written. A null surface gives an empty view; a null view is left alone. */
WSK_API void wsk_surface_get_view(const wsk_surface* surface, wsk_surface_view* view, size_t size);

/* Gives the memory back through the allocator that it came from. Null is allowed. */
WSK_API void wsk_surface_free(wsk_surface* surface);

/* ---- Raw curves -------------------------------------------------------------------------------
 */

typedef int32_t wsk_chain;

enum {
  /* Ends that meet in twos are joined, except where the caller made the joint himself, by a common
     node number between two curves of more than two samples. */
  WSK_CHAIN_AUTO = 0,
  WSK_CHAIN_NONE = 1,
  /* Joined there too. */
  WSK_CHAIN_ALL = 2,
  WSK_CHAIN_COUNT = 3
};

typedef struct wsk_connect_options {
  size_t size; /* set by wsk_connect_options_init */

  /* How far apart, in your units, curves may be that are meant to meet. Negative: only what
     coincides is joined. 0 (the default): the median distance of neighbouring samples, at most a
     hundredth of the diagonal of the bounding box. More than a tenth of the diagonal is refused,
     and what brings more places near each other than 16 for each sample and one for each pair of
     curves, of pairs at most 262144, or covers so many samples that more than 2^26 pairs of edges
     are that near, or that the curves have more than 2^26 samples, each counted for every such place
     that it is near to. */
  double snap;
  wsk_chain chain;
  /* A turn by more than this is a corner: curves are not chained through it. 0 (the default): 60
     degrees, or 35 where that is more than twice the turns at the samples next to it. */
  double corner_deg;
  /* Non-zero: the signs of the normals are not to be trusted and are made to agree. */
  int32_t orient;
  /* Its memory, cancel, progress and clock are used, nothing else; null: none of them. */
  const wsk_options* options;
} wsk_connect_options;

/* As wsk_options_init. */
WSK_API void wsk_connect_options_init(wsk_connect_options* options, size_t size);

typedef struct wsk_network wsk_network;

/* A place on the caller's curves: a sample, or that part (0 to 1) of the way to the next one. */
typedef struct wsk_place {
  uint32_t curve;
  uint32_t sample;
  double part;
  double position[3]; /* before anything was moved; 0 0 0 in a wsk_contradiction */
} wsk_place;

typedef int32_t wsk_snap_kind;

enum { WSK_SNAP_END_END = 0, WSK_SNAP_END_INSIDE = 1, WSK_SNAP_INSIDE_INSIDE = 2 };

/* Two places that were made one point. */
typedef struct wsk_snap {
  wsk_place a, b;
  double distance;
  wsk_snap_kind kind;
} wsk_snap;

/* Two normals that do not fit together: at one point, more than 45 degrees from the mean there; or
   with wsk_connect_options.orient, whose signs could not be made to agree. */
typedef struct wsk_contradiction {
  wsk_place a, b;
  double angle_deg;
} wsk_contradiction;

typedef struct wsk_network_counts {
  uint32_t curves;
  uint32_t samples;
  uint32_t nodes;         /* points with more than one sample */
  uint32_t dangling_ends; /* ends of open curves where no other curve is */
  uint32_t components;    /* connected ones */
  uint32_t open_gaps;     /* pairs of components nearer than the snapping tolerance, where they do
                             not only pass side by side */
} wsk_network_counts;

/* What a network holds. The arrays belong to it and live until it is freed. */
typedef struct wsk_network_view {
  size_t size; /* set by wsk_network_get_view */

  uint32_t curve_count;
  uint32_t sample_count;
  uint32_t snap_count;
  uint32_t contradiction_count;
  const wsk_curve* curves; /* for wsk_build; a curve without normals has a null pointer there */
  const uint32_t* first_sample; /* curve_count + 1: where each curve begins in the arrays below */
  /* Where each sample was in the input: the caller's curve, his sample, and for samples made by
     snapping that part of the way to the next one. */
  const uint32_t* given_curve;
  const uint32_t* given_sample;
  const double* given_part;
  const wsk_snap* snaps; /* in the order they were made, nearest first */
  const wsk_contradiction* contradictions;
  wsk_network_counts before;
  wsk_network_counts after;
  double tolerance;        /* the one used, in your units; 0 without snapping */
  uint32_t filled_normals; /* samples that had no normal and got one */
  uint32_t turned_normals; /* samples whose normal changed sign */
  uint32_t curves_without_normals;
  double residual; /* wsk_integrate: root mean square of what is missing between samples */
} wsk_network_view;

/* Makes a network of raw curves: fragments, two-point segments, curves that almost meet.
 *
 * Samples with the same node number are one point, as for wsk_build, and so are samples at exactly
 * the same place. Fragments become curves through points at which two ends meet, unless there is a
 * corner; closed curves are recognised. Then curves that come nearer to each other than
 * options.snap are joined, nearest first: ends to ends, ends to the inside of curves, and the
 * insides of curves where they cross, seen along the gap between them, or touch: to a twentieth of
 * the tolerance, or to a quarter where one that is no boundary has a corner that points to the
 * other. Curves side by side stay apart, however near: a hole beside the border of its patch, two
 * parallels. Insides of one component are joined at a quarter of the tolerance only, or at a
 * hundredth where the network is one component without dangling ends already. Places that the
 * network connects within four tolerances are left alone (loose ends: within four times their
 * distance). Where most gaps are next to nothing, as between curves drawn on a surface, ends that
 * meet a curve come first, and every crossing becomes a joint. Existing nodes stay where they are
 * and the curves that come to them bend smoothly; an end comes to the inside of a curve; ends meet
 * in the middle, and so do insides. A joint between samples becomes a sample.
 *
 * Normals may be null, or zero at samples where they are not known. A curve with some is completed
 * along its length; one without any only where both its ends lie at nodes whose normals other
 * curves know. At new joints normals are replaced by their mean, unless they contradict each other:
 * these are left for wsk_build to complain of.
 *
 * In the result every joint has a node number: the least that the caller gave there, or else one
 * that he did not use. What needed nothing comes out as it went in, bit for bit and in the same
 * order. Neighbours that coincide become one at new joints; elsewhere they and other faults within
 * a curve are left to wsk_build to complain of.
 *
 * `options` may be null (defaults); `report` may be null; of it only the status, its place, the
 * counts of curves and nodes, and the costs are filled. On success *network is the result, to be
 * given to wsk_network_free; on failure it is untouched. */
WSK_API wsk_status wsk_connect(const wsk_curve* curves, size_t curve_count,
                               const wsk_connect_options* options, wsk_network** network,
                               wsk_report* report);

/* A curve as a shape sensor measures it: no positions, but directions along its arc length. */
typedef struct wsk_sensor_curve {
  size_t sample_count;
  const double* arc_lengths; /* of each sample from the start, increasing, in your units; packed */
  const double* tangents;    /* of any length but zero; strides in bytes, 0: 24 */
  size_t tangent_stride;
  const double* normals; /* may be null */
  size_t normal_stride;
  const uint32_t* nodes; /* as in wsk_curve */
  /* Non-zero: the last sample is the first again (and is not in the result). */
  int32_t closed;
  int32_t boundary;
  /* Non-zero: each tangent is the direction from its sample to the next, as in Stanko's .rawnet
     files, and steps are straight. Zero: the direction at its sample, and steps are circular arcs.
   */
  int32_t tangents_to_next;
} wsk_sensor_curve;

/* Finds the positions: those whose differences fit the tangents best (each step of arc length h
 * with weight 1 / h), samples of the same node number being one point. The first sample of each
 * connected component lies at the origin. The network has the curves in the same order; its
 * residual is zero if the curves close exactly. For `options`, `network` and `report` see
 * wsk_connect; of the options memory, cancel, progress and clock are used. T. Stanko, S. Hahmann,
 * G.-P. Bonneau, N. Saguin-Sprynski, "Shape from sensors: Curve networks on surfaces from 3D
 * orientations", 2017. */
WSK_API wsk_status wsk_integrate(const wsk_sensor_curve* curves, size_t curve_count,
                                 const wsk_options* options, wsk_network** network,
                                 wsk_report* report);

/* As wsk_surface_get_view. */
WSK_API void wsk_network_get_view(const wsk_network* network, wsk_network_view* view, size_t size);

/* Puts the caller's curves and samples into a report of wsk_build about this network's. A node that
   has no number of the caller's is named by a curve and a sample instead. Null pointers are
   allowed and do nothing. */
WSK_API void wsk_network_name_places(const wsk_network* network, wsk_report* report);

/* As wsk_surface_free. */
WSK_API void wsk_network_free(wsk_network* network);

/* ---- Surfaces from curves alone ----------------------------------------------------------------
 *
 * No normals, no cycles, no order: the curves, and points, are sampled, and a cage of them becomes
 * the surface that a person would see in it (B. Sadri, K. Singh, "Flow-Complex-Based Shape
 * Reconstruction from 3D Curves", 2014). The result may be open, have handles, enclose several
 * voids and have curves at which more than two patches meet. wsk_flow_build does what is costly and
 * keeps it; wsk_flow_surface makes a surface of it, as often as asked, for any number of voids.
 *
 *     wsk_flow* flow = NULL;
 *     if (wsk_flow_build(curves, curve_count, &options, NULL, &flow, &report) == WSK_OK) {
 *         wsk_flow_surface(flow, &options, NULL, &surface, &report);
 *         wsk_flow_get_view(flow, &view, sizeof view);
 *         ... view.betti, view.patches ...
 *         wsk_flow_free(flow);
 *     }
 */

typedef struct wsk_flow wsk_flow;

#define WSK_VOIDS_AUTO (-1)

typedef struct wsk_flow_options {
  size_t size; /* set by wsk_flow_options_init */

  /* For wsk_flow_build. */

  /* The greatest distance between samples on the curves, in your units; 0 (the default): a fiftieth
     of the diagonal of the bounding box, or wsk_options.spacing if that is less. It must be finer
     than the gaps that the surface shall see; where curves run near each other it gets finer by
     itself. */
  double sampling;
  /* Samples are moved by this part of the diagonal before anything is decided, because exact ties
     would be decided at random; the result has them where they were. 0 is the default, 1e-7. */
  double jitter;
  uint32_t seed; /* another draw of the jitter */
  /* More tetrahedra than this are WSK_ERROR_TOO_LARGE; 0: two million. */
  uint32_t most_tetrahedra;

  /* For wsk_flow_surface. */

  /* How many voids the surface shall enclose, in the order of wsk_flow_view.voids; WSK_VOIDS_AUTO
     (the default): those whose ratio stands out, and those that flat faces close or wait for. Fewer
     are made if the curves cage fewer. */
  int32_t voids;
  /* Rooms along the walls up to this multiple of the radius of the first void's last wall are
     filled and emptied again, so that walls move into the corners that they cut. Default 1.2, 0:
     not at all. */
  double thickness;
  /* Non-zero: walls stay that have a border off the curves, against other walls. */
  int32_t open_walls;
  /* Non-zero: patches keep the triangles between the samples instead of being remeshed to
     wsk_options.spacing (0: that of the sampling). */
  int32_t raw;

  /* For wsk_flow_build again: WSK_LIDS_... */
  int32_t lids;
} wsk_flow_options;

/* What becomes of round ends: discs that a curve with bends bounds, with curves that leave it to
   one side only, as those of cans, cones and domes. Balls between the curves find one end of a tube
   or none, and drawings do not tell a tube from a can. Polygons are always faces. */
enum {
  /* The default: a round end is closed if it is the only one of curves that hang together; of two
     or more those are closed that the balls close. */
  WSK_LIDS_SINGLE = 0,
  WSK_LIDS_ALL = 1,  /* each is closed */
  WSK_LIDS_NONE = 2, /* only those that the balls close */
  WSK_LIDS_COUNT = 3
};

/* As wsk_options_init. */
WSK_API void wsk_flow_options_init(wsk_flow_options* options, size_t size);

/* A void that the curves cage, as a person would see it the better, the greater its ratio is. Balls
   that grow round the samples close it at one radius and fill it at another. */
typedef struct wsk_void {
  double creation, filling; /* radii, in your units */
  double ratio;             /* of the two, capped at what is possible */
  int32_t chosen;           /* non-zero: enclosed by the last surface made */
} wsk_void;

/* A patch of the last surface. Its number is that of its triangles in wsk_surface_view. */
typedef struct wsk_flow_patch {
  uint32_t first_loop, loop_count; /* two: an annulus */
  int32_t euler_characteristic;
  int32_t open; /* non-zero: part of its border is no curve */
  /* The voids on the sides from which its triangles run counter-clockwise and clockwise: 0 is the
     outside, n the n-th of the chosen voids. */
  uint32_t front, back;
  double area;   /* before smoothing and remeshing */
  double radius; /* at which balls round the samples have covered it */
} wsk_flow_patch;

/* A stretch of a loop: along an arc from one of its vertices to another, backward if from > to;
   vertex i of arc a is arc_vertices[arc_first[a] + i]. Off the curves arc is WSK_NONE, and from and
   to are vertices. The patch lies on the left, seen from its front. */
typedef struct wsk_flow_run {
  uint32_t arc, from, to;
} wsk_flow_run;

typedef int32_t wsk_flow_normals;

enum {
  WSK_FLOW_NORMALS_NONE = 0, /* no curve has normals */
  WSK_FLOW_NORMALS_USED = 1, /* they shaped the surface */
  /* Curves that lack them or are sharp; points may lack them. */
  WSK_FLOW_NORMALS_INCOMPLETE = 2,
  /* Edges at which patches branch, or a one-sided surface would have to be turned; 0 if patches
     only touch in points. */
  WSK_FLOW_NORMALS_NOT_MANIFOLD = 3,
  /* Vertices on a border that is no curve: nothing holds them. */
  WSK_FLOW_NORMALS_FREE_BORDER = 4,
  /* Vertices on curves where the normal points to the other side than the surface, turned as most
     of them want it: more than a tenth. */
  WSK_FLOW_NORMALS_CONTRADICTING = 5,
  /* Pairs of triangles that crossed after the smoothing, a thousand at most. */
  WSK_FLOW_NORMALS_CROSSING = 6,
  /* Triangles are too thin for the smoothing, or after it; no places. */
  WSK_FLOW_NORMALS_TOO_THIN = 7,
  WSK_FLOW_NORMALS_COUNT = 8
};

/* What wsk_flow_build found, and how the last surface hangs together. Arrays belong to the flow and
   live until it makes another surface or is freed. */
typedef struct wsk_flow_view {
  size_t size; /* set by wsk_flow_get_view */

  uint32_t sample_count;
  uint32_t tetrahedron_count;
  uint32_t
      critical_count[4];  /* points, saddles of index 1 and 2, maxima: their alternating sum is 1 */
  uint32_t split_count;   /* segments divided because a sample came too near */
  uint32_t crowded_count; /* segments that should have been, but were too short already */
  uint32_t missing_count; /* segments without an edge in the complex: none in sound input */
  uint32_t void_count;
  /* Those that only flat faces close first, whatever their ratio; the others by falling ratio. */
  const wsk_void* voids;

  /* Of the last surface; zero before the first. */
  uint32_t betti[3]; /* components, handles and loops, voids: of surface and curves together */
  uint32_t patch_count;
  uint32_t open_patch_count;
  uint32_t bare_count;   /* segments of curve at which no patch lies */
  uint32_t branch_count; /* edges of more than two triangles before remeshing */
  uint32_t held_count;   /* patches that remeshing spared because they would have crossed others */
  uint32_t crossing_count; /* pairs of triangles that cross: none but for rounding */
  int32_t manifold; /* non-zero: every edge has at most two triangles, every vertex one fan */
  int32_t smoothed; /* non-zero: the normals of the curves shaped it; `normals` says more */
  const wsk_flow_patch* patches;
  uint32_t loop_count;
  const uint32_t* loop_first; /* loop l has the runs loop_first[l] .. loop_first[l + 1] */
  const wsk_flow_run* runs;
  uint32_t arc_count;            /* stretches of curve between junctions and corners */
  const uint32_t* arc_first;     /* arc_count + 1 */
  const uint32_t* arc_vertices;  /* vertices of the surface; a closed arc repeats its first */
  const uint32_t* bare_vertices; /* two for each bare segment */

  /* What became of the normals, and at how many places (WSK_FLOW_NORMALS_... says of what) they
     could not be used; in words "" where there are none or they are used, else static text. */
  wsk_flow_normals normals;
  uint32_t normals_places;
  const char* normals_sentence;
  /* Voids found worth enclosing, or as many as were asked for; fewer than that if the curves cage
     no more. betti[2] are those that the surface encloses in the end. */
  uint32_t caged_count;

  double sampling; /* the greatest distance between samples that was used, in your units */
  /* Non-zero: flat faces are so many and so dense that looking for them was given up, and all voids
     are judged by their ratios. */
  int32_t faces_skipped;
  /* Of the last surface: voids of enough ratio beyond those that were looked at, which are the 200
     of the greatest ratio and all that flat faces close. */
  uint32_t untried_count;
  uint32_t open_lid_count; /* likewise: round ends that are open; WSK_LIDS_ALL asks for each */
} wsk_flow_view;

/* Samples the curves and finds the voids. Curves join where samples carry the same node number or
 * coincide; curves of one sample are points. Normals are not needed: null, or given for all curves
 * but points, and then they shape the surface.
 *
 * Noise is taken out first, as wsk_options.smoothing says, over the curves that fragments form;
 * unless told otherwise it is looked for, and samples without noise, or with less than a hundred
 * thousandth of the diagonal, keep their bits. Corners, where a curve turns by more than 35 degrees
 * and by more than its noise explains, stay corners.
 *
 * Junctions, ends, corners and isolated points, as they are after that, are vertices of the result,
 * bit for bit. Without normals all other vertices on curves lie on the polyline through the
 * samples; with normals they lie on smooth curves through them. No sample is farther from the
 * polyline of the result than a twentieth of the sampling; the report of wsk_flow_surface says how
 * far they are, noise included.
 *
 * A curve's boundary is not read, sharp curves count as having no normals. Soft curves and
 * wsk_options.soft are refused: the surface holds on to all curves. wsk_options.partial and
 * find_borders change nothing, since no patch is ever left out. `options` and `flow_options` may be
 * null (defaults). A spacing coarser than the sampling coarsens patches inside only: all samples
 * are vertices. On success *flow is to be given to wsk_flow_free; it keeps the allocator of the
 * options, not the callbacks. */
WSK_API wsk_status wsk_flow_build(const wsk_curve* curves, size_t curve_count,
                                  const wsk_options* options, const wsk_flow_options* flow_options,
                                  wsk_flow** flow, wsk_report* report);

/* A surface like that of wsk_build. With normals it is smoothed by wsk_options.method where it is a
 * manifold and all its borders are curves; else, and without normals, it is made of the remeshed
 * patches, in which curvatures are zero if it is no manifold; wsk_flow_view.normals says why. The
 * noise in the report is that of wsk_flow_build, wsk_options.smoothing is not read again. No two
 * triangles of it cross, for which samples of curves that all but touch may stay where the jitter
 * moved them. The surface lives on without the flow. One flow makes one surface at a time. */
WSK_API wsk_status wsk_flow_surface(wsk_flow* flow, const wsk_options* options,
                                    const wsk_flow_options* flow_options, wsk_surface** surface,
                                    wsk_report* report);

/* As wsk_surface_get_view. */
WSK_API void wsk_flow_get_view(const wsk_flow* flow, wsk_flow_view* view, size_t size);

/* As wsk_surface_free. */
WSK_API void wsk_flow_free(wsk_flow* flow);

/* The version of the library linked in, "major.minor.patch"; compare with WIRESKIN_VERSION_STRING.
 */
WSK_API const char* wsk_version_string(void);

#ifdef __cplusplus
}
#endif

#endif /* WIRESKIN_H */
