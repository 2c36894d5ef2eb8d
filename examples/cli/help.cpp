// The text of --help.
#include "arguments.h"

namespace wireskin_cli {

static constexpr const char* k_help = R"(wireskin - a smooth surface through a network of curves

usage: wireskin [options] INPUT -o OUTPUT

INPUT is a network of curves, "-" for the standard input:
  .net      the number of vertices, a row x y z nx ny nz for each, the number of curves, and for
            each curve a line 0 or 1 (1: boundary) and a line of vertex indices from 0
  .obj      v, and vn for each v in the same order; l, each of which is one curve with any number
            of indices; curv, B-splines and Bezier curves of any degree, rational or not. Without
            any of these f with more than three corners are loops. Curves after a g or o whose name
            contains "boundary" (in upper or lower case), up to the next g or o, are boundary
            curves; "sharp" makes them creases, smooth on each side only. A vertex has one vn,
            creases have two normals: theirs are taken as unknown, and vn holds for the smooth
            curves that end there.
  .ply      text or binary: vertices with x y z nx ny nz, the element edge with vertex1, vertex2
            (and maybe boundary, sharp), or else faces as loops
  .csv .tsv .txt .dat .asc
            a row x y z or x y z nx ny nz for each sample, with a number of the curve behind or in
            front of it or none, or columns named in the first line: x y z nx ny nz curve boundary
            sharp. Columns stand between semicolons, tabs, commas or blanks; with the first two a
            comma may be the decimal point. Without a column "curve", blank lines or lines
            "CURVE name" separate curves. Samples whose coordinates are all equal are one point.
  .curves .curve .contour .curf
            polylines of CASSIE, of cycle discovery, of contours in planes, with tangents
  .rawnet   tangents measured along curves, as Stanko's sensors give them: positions are integrated
  .xyz      points, x y z or x y z nx ny nz; alone they span no surface
What a file is, is seen from its content where the extension cannot be true.
Curves meet where they share a vertex. A curve is closed if its last vertex repeats its first.
Boundary curves are those where the surface ends. Normals point to the outer side; where there are
none the curves alone give the surface (--topology flow).

OUTPUT is the surface; -o may be repeated:
  .obj   positions, normals (at creases one for each side), a group patch_K for each patch
  .ply   binary: positions, normals, mean curvature, the patch of each triangle
  .stl   binary: triangles
  -      the standard output, in the format of --format; report, image or page may go there instead

options (lengths are in the units of the input; "the diagonal" is that of its bounding box):
  -o OUTPUT          where to write the surface
  --format obj|ply|stl
                     what -o - writes (default: ply)
  --spacing LENGTH   distance of vertices along the curves, above 0 (default: a hundredth of the
                     diagonal). Half of it gives four times the triangles; memory and time are the
                     limit
  --method NAME      fair (default): mean curvature as smooth as can be, the normals kept
                     stanko: mean curvature follows the normals spread from the curves
                     iterated: the same, repeated on the surface itself
                     biharmonic, triharmonic: least square Laplacian, which lets the normals
                     order the curves but not shape the surface
                     clamped: biharmonic with curvature prescribed on the curves
  --smooth auto|0|SIGMA
                     noise of the samples: found and taken out (auto, the default of fair and of
                     --topology flow; samples without noise stay as they are), none, so that curves
                     are interpolated (0, the default of all other methods), or its standard
                     deviation, which must not change the size of a curve by more than a fifth
  --soft LENGTH      curves pull instead of holding: details of a curve shorter than LENGTH are
                     smoothed away; at most a tenth of the diagonal (default 0: curves hold)
  --snap LENGTH|auto|off
                     curves that miss each other by no more than LENGTH, at most a tenth of the
                     diagonal, are joined; auto (default) takes the median distance of neighbouring
                     samples, at most a hundredth of the diagonal; off, or 0, joins only what
                     coincides. What is connected stays as it is; the report lists every joint
  --orient           the signs of the normals are not to be trusted: make them agree
  --topology auto|normals|flow
                     how patches are found: from the order of the normals round each node
                     (normals), or from the curves alone, as the surface that they cage (flow);
                     auto takes flow where curves have no normals. With flow, normals shape the
                     surface where it is a manifold; without them it is left as remeshed
  --voids N          with flow: the number of voids to enclose, 0 to 1000000 (default: those that
                     stand out); fewer where the curves cage fewer
  --lids auto|all|none
                     with flow: close round ends of tubes: the only one (auto, the default), all, so
                     that a tube is a can, or none beyond those that the curves cage
  --open-walls       with flow: keep walls that end at other walls instead of at curves
  --partial          with normals: leave out patches that cannot be made, instead of failing; the
                     report lists them
  --find-borders     with normals: the outside of an open surface need not be tagged as boundary;
                     where a patch would run clockwise round its own normals the surface ends. The
                     ends of tubes, and holes, must still be tagged
  --report FILE      write a report in JSON: status, counts, quality, memory, times; it is
                     written too, with the place of the fault, if the input cannot be read or no
                     surface can be built from it
  --image FILE.png   write a shaded picture with isophote stripes and the curves
  --html FILE.html   write a page that shows the result in any browser: to be turned, lit, measured
  --curves           write the curves too: as l in .obj, as the element edge in .ply
  --up x|y|z         the axis that points up in picture and page (default: z)
  --quiet            no progress, no summary
  --help             print this
  --version          print the version

Errors are one line, "FILE:LINE: what is wrong" or "FILE: curve 3, sample 17: what is wrong", on
the standard error. Options that had no effect are named in the summary and in the report.
Curves, samples, nodes and patches are numbered from 0 in messages and reports, lines from 1; a
node's number is the index of its vertex, from 0. Output files are complete or absent.

exit status: 0 done; 1 the files or the network are at fault, memory ran out, or a signal cancelled
it; 2 wrong usage, a value out of the range that this network allows among it
)";

const char* help_text() {
  return k_help;
}

}  // namespace wireskin_cli
