#include "smooth/node_curvature.h"

#include "base/in_parts.h"

namespace wireskin::smooth {

// Parabolas through this share of an arc, and at least so many edges, give values and slopes at its
// end. Shorter windows follow noise; arcs of fewer edges tell nothing.
static constexpr uint32_t k_window_share = 3, k_least_window = 4;
// A weight of one stands for a relative error of a tenth, and no error is less than .04.
static constexpr double k_usual_error = 0.1, k_least_error = 0.04;
// So many vertices of arcs are a few milliseconds of work.
static constexpr size_t k_vertices_per_checkpoint = size_t{1} << 14;

namespace {

// Least squares with N unknowns, as normal equations.
template <int N>
struct LeastSquares {
  double matrix[N][N] = {};
  double rhs[N] = {};

  void add(const double* row, double value) {
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) matrix[i][j] += row[i] * row[j];
      rhs[i] += row[i] * value;
    }
  }

  // By elimination; false where too little is left of a diagonal entry.
  bool solve(double* solution, double least_left) {
    double whole[N];
    for (int k = 0; k < N; ++k) whole[k] = matrix[k][k];
    for (int k = 0; k < N; ++k) {
      if (!(matrix[k][k] > least_left * whole[k])) return false;
      for (int i = k + 1; i < N; ++i) {
        const double factor = matrix[i][k] / matrix[k][k];
        for (int j = k; j < N; ++j) matrix[i][j] -= factor * matrix[k][j];
        rhs[i] -= factor * rhs[k];
      }
    }
    for (int k = N - 1; k >= 0; --k) {
      double sum = rhs[k];
      for (int j = k + 1; j < N; ++j) sum -= matrix[k][j] * solution[j];
      solution[k] = sum / matrix[k][k];
    }
    return true;
  }
};

struct ValueAndSlope {
  double value = 0.0, slope = 0.0;
};

// The parabola through samples of a function, at zero.
struct Parabola {
  LeastSquares<3> fit;

  void add(double s, double value) {
    const double row[3] = {1.0, s, s * s};
    fit.add(row, value);
  }
  bool at_zero(ValueAndSlope* result) {
    double c[3];
    if (!fit.solve(c, 1e-12)) return false;
    *result = {c[0], c[1]};
    return true;
  }
};

// The cubic over [0, 1] with these values and slopes at its ends.
struct Cubic {
  ValueAndSlope from, to;

  double at(double x) const {
    const double y = 1.0 - x;
    return from.value * y * y * (1.0 + 2.0 * x) + to.value * x * x * (1.0 + 2.0 * y) +
           x * y * (from.slope * y - to.slope * x);
  }
};

// Along one edge: its length, its direction in the tangent plane, II(t, t) and II(t, b).
struct EdgeForm {
  Vec3 tangent;
  double length, along, mixed;
};

// An arc as it leaves a node, by its own tangent; slopes by length.
struct ArcEnd {
  uint32_t node = k_none;  // the vertex; where nothing could be found, none
  uint32_t form = k_none;  // the number of that node
  Vec3 tangent;
  ValueAndSlope along, mixed;
  double geodesic_curvature = 0.0;
};

// II and C in the basis (e, n x e) of the tangent plane.
struct NodeForm {
  double second[3];  // 11, 12, 22
  double third[4];   // 111, 112, 122, 222
  double error;      // how badly the arcs agree, relative
  bool known;
};

// How II(t, t), II(t, b), II(b, b) and C(t, t, t), C(t, t, b), C(t, b, b) follow from the forms.
struct FormRows {
  double second[3][3];
  double third[3][4];
};

// What a node gathers; the last two are sums of squares.
struct NodeEquations {
  LeastSquares<3> second;
  LeastSquares<4> third;
  double misfit = 0.0, size = 0.0;
};

}  // namespace

static double sum_of_products(const double* a, const double* b, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

static EdgeForm edge_form(const GivenCurves& curves, uint32_t a, uint32_t b) {
  EdgeForm form;
  const Vec3 edge = curves.position[b] - curves.position[a];
  const Vec3 turn = curves.normal[b] - curves.normal[a];
  const Vec3 normal = unit(curves.normal[a] + curves.normal[b]);
  form.length = length(edge);
  form.tangent = unit(reject(edge, normal));
  form.along = dot(turn, form.tangent) / form.length;
  form.mixed = dot(turn, cross(normal, form.tangent)) / form.length;
  return form;
}

namespace {

// Everything that is known along the first part of an arc, as functions of its length.
struct Leaving {
  Parabola along, mixed, geodesic, x, y, z;

  void add_edge(double s, const EdgeForm& form) {
    along.add(s, form.along);
    mixed.add(s, form.mixed);
    x.add(s, form.tangent.x);
    y.add(s, form.tangent.y);
    z.add(s, form.tangent.z);
  }
  void add_bend(double s, const EdgeForm& before, const EdgeForm& after, const Vec3& normal) {
    const Vec3 across = cross(normal, unit(before.tangent + after.tangent));
    const double bend = dot(after.tangent - before.tangent, across);
    geodesic.add(s, bend / (0.5 * (before.length + after.length)));
  }
  bool at_node(ArcEnd* end) {
    ValueAndSlope g, dx, dy, dz;
    if (!along.at_zero(&end->along) || !mixed.at_zero(&end->mixed) || !geodesic.at_zero(&g) ||
        !x.at_zero(&dx) || !y.at_zero(&dy) || !z.at_zero(&dz)) {
      return false;
    }
    end->geodesic_curvature = g.value;
    end->tangent = {dx.value, dy.value, dz.value};
    return true;
  }
};

}  // namespace

static ArcEnd leave_node(const GivenCurves& curves, Span<const uint32_t> arc, bool backwards) {
  const size_t edges = arc.size() - 1, share = edges / k_window_share;
  const size_t window = share > k_least_window ? share : k_least_window;
  const auto vertex = [&](size_t k) { return arc[backwards ? edges - k : k]; };
  Leaving leaving;
  EdgeForm before = {};
  double s = 0.0, whole = 0.0;  // in units of the window, which keeps the equations well scaled
  for (size_t k = 0; k < window; ++k) {
    whole += length(curves.position[vertex(k + 1)] - curves.position[vertex(k)]);
  }
  for (size_t k = 0; k < window; ++k) {
    const EdgeForm form = edge_form(curves, vertex(k), vertex(k + 1));
    if (k > 0) leaving.add_bend(s / whole, before, form, curves.normal[vertex(k)]);
    leaving.add_edge((s + 0.5 * form.length) / whole, form);
    s += form.length;
    before = form;
  }
  ArcEnd end;
  if (!leaving.at_node(&end)) return end;
  end.node = vertex(0);
  end.along.slope /= whole;
  end.mixed.slope /= whole;
  end.tangent = unit(reject(end.tangent, curves.normal[end.node]));
  return end;
}

// A direction of the tangent plane that depends on the normal alone.
static Vec3 tangent_basis(const Vec3& n) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return unit(reject(axis, n));
}

// For t = c e1 + s e2, b = -s e1 + c e2.
static FormRows form_rows(const Vec3& tangent, const Vec3& normal) {
  const Vec3 e = tangent_basis(normal);
  const double c = dot(tangent, e), s = dot(tangent, cross(normal, e));
  const double cc = c * c, ss = s * s, cs = c * s;
  return {{{cc, 2.0 * cs, ss}, {-cs, cc - ss, cs}, {ss, -2.0 * cs, cc}},
          {{cc * c, 3.0 * cc * s, 3.0 * c * ss, ss * s},
           {-cc * s, cc * c - 2.0 * c * ss, 2.0 * cc * s - ss * s, c * ss},
           {c * ss, ss * s - 2.0 * cc * s, cc * c - 2.0 * c * ss, cc * s}}};
}

// Where the directions at a node lie within about 15 degrees they do not tell II apart.
static constexpr double k_least_spread = 0.05, k_least_third_spread = 0.02;

// II at every node, from all the arcs that leave it, then C: along an arc of geodesic curvature g
// the slope of II(t, t) is C(t, t, t) + 2 g II(t, b), that of II(t, b) is C(t, t, b) + g (II(b, b)
// - II(t, t)).
static Status find_node_forms(Context& context, Span<const Vec3> normal, Span<const ArcEnd> ends,
                              Span<NodeForm> forms) {
  Array<NodeEquations> equations(context);
  TRY(equations.assign(forms.size(), NodeEquations{}));
  for (const ArcEnd& end : ends) {
    if (end.node == k_none) continue;
    const FormRows rows = form_rows(end.tangent, normal[end.node]);
    equations[end.form].second.add(rows.second[0], end.along.value);
    equations[end.form].second.add(rows.second[1], end.mixed.value);
  }
  for (size_t v = 0; v < forms.size(); ++v) {
    forms[v].known = equations[v].second.solve(forms[v].second, k_least_spread);
  }
  for (const ArcEnd& end : ends) {
    if (end.node == k_none || !forms[end.form].known) continue;
    NodeEquations& node = equations[end.form];
    const FormRows rows = form_rows(end.tangent, normal[end.node]);
    double form[3];
    for (int i = 0; i < 3; ++i) {
      form[i] = sum_of_products(rows.second[i], forms[end.form].second, 3);
    }
    const double off = end.along.value - form[0], off_mixed = end.mixed.value - form[1];
    node.misfit += off * off + off_mixed * off_mixed;
    node.size += form[0] * form[0] + 2.0 * form[1] * form[1] + form[2] * form[2];
    const double g = end.geodesic_curvature;
    node.third.add(rows.third[0], end.along.slope - 2.0 * g * form[1]);
    node.third.add(rows.third[1], end.mixed.slope - g * (form[2] - form[0]));
  }
  for (size_t v = 0; v < forms.size(); ++v) {
    if (!forms[v].known) continue;
    const NodeEquations& node = equations[v];
    forms[v].error = node.size > 0.0 ? std::sqrt(node.misfit / node.size) : 0.0;
    forms[v].known = equations[v].third.solve(forms[v].third, k_least_third_spread);
  }
  return {};
}

// II(b, b) at the end of an arc, and its slope C(t, b, b) - 2 g II(t, b).
static ValueAndSlope across_at(const ArcEnd& end, const NodeForm& form, const Vec3& normal) {
  const FormRows rows = form_rows(end.tangent, normal);
  const double mixed = sum_of_products(rows.second[1], form.second, 3);
  return {sum_of_products(rows.second[2], form.second, 3),
          sum_of_products(rows.third[2], form.third, 4) - 2.0 * end.geodesic_curvature * mixed};
}

namespace {

// The parameter of an arc, from 0 to 1: how far the normal has turned, and a little length, so that
// it moves on where the normal does not.
struct TurnParameter {
  double turn = 0.0;  // of the whole arc, in radians
  double even = 0.0;  // turn by length that is added
  double total = 0.0;

  double speed(double along, double mixed) const {
    return (std::sqrt(along * along + mixed * mixed) + even) / total;
  }
};

// The foretelling of one arc.
struct ArcCurvature {
  TurnParameter parameter;
  Cubic along, across;
  double together;  // how far the two go along with each other
};

}  // namespace

static TurnParameter turn_parameter(const GivenCurves& curves, Span<const uint32_t> arc) {
  TurnParameter parameter;
  double whole = 0.0;
  for (size_t k = 0; k + 1 < arc.size(); ++k) {
    whole += length(curves.position[arc[k + 1]] - curves.position[arc[k]]);
    parameter.turn += length(curves.normal[arc[k + 1]] - curves.normal[arc[k]]);
  }
  const double added = 0.25 * parameter.turn + 0.1;
  parameter.even = added / whole;
  parameter.total = parameter.turn + added;
  return parameter;
}

// Where the curvatures along and across an arc go against each other, as on minimal surfaces, their
// sum is smoother than either, so what the cubic misses along is taken from across. Where they go
// together it is not: on an ellipsoid one is the cube of the other.
static double go_together(const Cubic& along, const Cubic& across) {
  const double a[3] = {along.to.value - along.from.value, along.from.slope, along.to.slope};
  const double b[3] = {across.to.value - across.from.value, across.from.slope, across.to.slope};
  const double size = sum_of_products(a, a, 3);
  const double share = size > 0.0 ? sum_of_products(a, b, 3) / size : 0.0;
  return share > 0.0 ? 0.0 : share < -1.0 ? -1.0 : share;
}

static ArcCurvature make_arc_curvature(const GivenCurves& curves, Span<const uint32_t> arc,
                                       const ArcEnd* ends, const NodeForm* const forms[2]) {
  ArcCurvature result;
  result.parameter = turn_parameter(curves, arc);
  ValueAndSlope along[2], across[2];
  for (int i = 0; i < 2; ++i) {
    along[i] = ends[i].along;
    across[i] = across_at(ends[i], *forms[i], curves.normal[ends[i].node]);
    // The second end looks back along the arc.
    const double direction = i == 0 ? 1.0 : -1.0;
    const double scale =
        direction / result.parameter.speed(ends[i].along.value, ends[i].mixed.value);
    along[i].slope *= scale;
    across[i].slope *= scale;
  }
  result.along = {along[0], along[1]};
  result.across = {across[0], across[1]};
  result.together = go_together(result.along, result.across);
  return result;
}

// H at the inner vertices, and their weights.
static void foretell_arc(const GivenCurves& curves, Span<const uint32_t> arc,
                         const ArcCurvature& known, double node_error2, Span<double> curvature,
                         Span<double> weight) {
  const size_t edges = arc.size() - 1;
  double misfit = 0.0, size = 0.0, x = 0.0;
  EdgeForm form = edge_form(curves, arc[0], arc[1]);
  for (size_t k = 0; k < edges; ++k) {
    const double step = known.parameter.speed(form.along, form.mixed) * form.length;
    const double off = form.along - known.along.at(x + 0.5 * step);
    misfit += off * off;
    size += form.along * form.along + form.mixed * form.mixed;
    x += step;
    if (k + 1 == edges) break;
    const EdgeForm next = edge_form(curves, arc[k + 1], arc[k + 2]);
    const double along = 0.5 * (form.along + next.along);
    const double missed = along - known.along.at(x);
    curvature[arc[k + 1]] = 0.5 * (along + known.across.at(x) + known.together * missed);
    weight[arc[k + 1]] = 0.5 * (form.length + next.length);
    form = next;
  }
  const double from = known.across.from.value, to = known.across.to.value;
  const double all = size / static_cast<double>(edges) + 0.5 * (from * from + to * to);
  const double turn2 = known.parameter.turn * known.parameter.turn;
  const double turn_error = turn2 * turn2 / 384.0;  // of a cubic for a cosine
  const double missed2 = all > 0.0 ? misfit / static_cast<double>(edges) / all : 0.0;
  // What rests on the slopes in the middle of the arc may be wrong by a quarter.
  const double swing = 0.25 * (known.across.from.slope - known.across.to.slope) / 8.0;
  const double swing2 = all > 0.0 ? swing * swing / all : 0.0;
  const double error2 =
      missed2 + turn_error * turn_error + swing2 + node_error2 + k_least_error * k_least_error;
  for (size_t k = 1; k < edges; ++k) weight[arc[k]] *= k_usual_error * k_usual_error / error2;
}

// Gives the nodes that arcs leave numbers of their own: they are few among the vertices.
static Status number_nodes(Context& context, size_t vertices, Span<ArcEnd> ends, uint32_t* count) {
  Array<uint32_t> number(context);
  TRY(assign_in_parts(vertices, k_none, &number));
  *count = 0;
  for (ArcEnd& end : ends) {
    if (end.node == k_none) continue;
    if (number[end.node] == k_none) number[end.node] = (*count)++;
    end.form = number[end.node];
  }
  return {};
}

// Arcs may be long or short, so their vertices are counted instead.
static Status pause_after_arc(Context& context, size_t vertices, size_t* work) {
  *work += vertices;
  if (*work < k_vertices_per_checkpoint) return {};
  *work = 0;
  return context.checkpoint();
}

Status foretell_curvature(Context& context, const GivenCurves& curves, Array<double>* curvature,
                          Array<double>* weight) {
  const size_t n = curves.position.size();
  Arcs arcs(context);
  Array<ArcEnd> ends(context);
  Array<NodeForm> forms(context);
  TRY(assign_in_parts(n, 0.0, curvature));
  TRY(assign_in_parts(n, 0.0, weight));
  TRY(find_arcs(context, curves, k_least_window, &arcs));
  TRY(ends.resize(size_t{2} * arcs.count()));
  size_t work = 0;
  for (uint32_t a = 0; a < arcs.count(); ++a) {
    ends[2 * a] = leave_node(curves, arcs.arc(a), false);
    ends[2 * a + 1] = leave_node(curves, arcs.arc(a), true);
    TRY(pause_after_arc(context, arcs.arc(a).size(), &work));
  }
  uint32_t nodes = 0;
  TRY(number_nodes(context, n, ends.span(), &nodes));
  TRY(forms.resize(nodes));
  TRY(find_node_forms(context, curves.normal, ends.span(), forms.span()));
  for (uint32_t a = 0; a < arcs.count(); ++a) {
    const uint32_t first = ends[2 * a].form, last = ends[2 * a + 1].form;
    if (first == k_none || last == k_none || !forms[first].known || !forms[last].known) continue;
    const NodeForm* const of_ends[2] = {&forms[first], &forms[last]};
    const double node_error2 =
        forms[first].error * forms[first].error + forms[last].error * forms[last].error;
    const ArcCurvature known = make_arc_curvature(curves, arcs.arc(a), &ends[2 * a], of_ends);
    foretell_arc(curves, arcs.arc(a), known, node_error2, curvature->span(), weight->span());
    TRY(pause_after_arc(context, arcs.arc(a).size(), &work));
  }
  return {};
}

}  // namespace wireskin::smooth
