// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/skin_layout.h"

#include <array>

#include "nodes/phantom/eyelids.h"
#include "nodes/phantom/lips.h"

namespace face::phantom {
namespace {

using Loop = SkinVertex::Loop;

constexpr int kHalfColumns = 38;  // azimuth columns from the front to the back
constexpr int kFaceColumns = 22;  // of these, on the face
constexpr int kNoseColumns = 7;   // of these, on the nose
constexpr double kNoseColumnDeg = 1.5, kFaceEndDeg = 44;
// Rows from the bottom of the neck to the crown: neck, jaw and mouth, nose, eyes and forehead, scalp.
constexpr int kNeckRows = 12, kMouthRows = 16, kNoseRows = 14, kEyeRows = 15, kScalpRows = 11;
constexpr double kNeckBottomDeg = -80.6, kMouthBottomDeg = -44, kNoseBottomDeg = -10.4, kEyeBottomDeg = 8.2,
                 kScalpBottomDeg = 40.5;

// A block of the grid, in columns and rows, that the loops around a hole replace.
struct Block {
  int first_column, last_column, first_row, last_row;
  bool covers(int column, int row) const {
    return column > first_column && column < last_column && row > first_row && row < last_row;
  }
};
constexpr int kMouthRow = kNeckRows + 11;                        // elevation -20.9
constexpr int kEyeRow = kNeckRows + kMouthRows + kNoseRows + 5;  // elevation 19
constexpr Block kMouthBlock = {-13, 13, kMouthRow - 5, kMouthRow + 5};
constexpr Block kLeftEyeBlock = {4, 20, kEyeRow - 5, kEyeRow + 5};
constexpr Block kRightEyeBlock = {-20, -4, kEyeRow - 5, kEyeRow + 5};

double column_azimuth(int column) {
  const int c = std::abs(column);
  const int on_nose = std::min(c, kNoseColumns), beside = std::min(c, kFaceColumns) - on_nose;
  double azimuth =
      kNoseColumnDeg * on_nose + beside * (kFaceEndDeg - kNoseColumnDeg * kNoseColumns) / (kFaceColumns - kNoseColumns);
  double total = 0, part = 0;
  for (int k = kFaceColumns; k < kHalfColumns; ++k) {
    const double step = std::min(9.0, 2.4 + 0.9 * (k - kFaceColumns));
    total += step;
    if (k < c) part += step;
  }
  azimuth += (180 - kFaceEndDeg) * part / total;
  return column < 0 ? -azimuth : azimuth;
}

double row_elevation(int row) {
  if (row < kNeckRows) return lerp(kNeckBottomDeg, kMouthBottomDeg, row / static_cast<double>(kNeckRows));
  row -= kNeckRows;
  if (row < kMouthRows) return lerp(kMouthBottomDeg, kNoseBottomDeg, row / static_cast<double>(kMouthRows));
  row -= kMouthRows;
  if (row < kNoseRows) return lerp(kNoseBottomDeg, kEyeBottomDeg, row / static_cast<double>(kNoseRows));
  row -= kNoseRows;
  if (row < kEyeRows) return lerp(kEyeBottomDeg, kScalpBottomDeg, row / static_cast<double>(kEyeRows));
  const double t = (row - kEyeRows) / static_cast<double>(kScalpRows);
  return lerp(kScalpBottomDeg, 90.0, t * (0.72 + 0.28 * t));
}

// Grid places around a block, counter-clockwise from the middle of its left (viewer's right) side.
std::vector<std::array<int, 2>> block_loop(const Block& b) {
  const int middle = (b.first_row + b.last_row) / 2;
  std::vector<std::array<int, 2>> loop;
  for (int r = middle; r < b.last_row; ++r) loop.push_back({b.last_column, r});
  for (int c = b.last_column; c > b.first_column; --c) loop.push_back({c, b.last_row});
  for (int r = b.last_row; r > b.first_row; --r) loop.push_back({b.first_column, r});
  for (int c = b.first_column; c < b.last_column; ++c) loop.push_back({c, b.first_row});
  for (int r = b.first_row; r < middle; ++r) loop.push_back({b.last_column, r});
  return loop;
}

// Vertices by grid place, and the making of them.
class Layout {
 public:
  explicit Layout(HeadBuilder& builder) : head(builder) {}

  std::uint32_t add(SkinVertex vertex) {
    skin.vertices.push_back(vertex);
    return head.add_vertex({}, {1, 1, 1});
  }
  std::uint32_t& grid(int column, int row) {
    if (column == kHalfColumns) column = -kHalfColumns;
    return places[static_cast<std::size_t>(row * 2 * kHalfColumns + column + kHalfColumns)];
  }
  void add_grid_vertices();
  std::vector<std::vector<std::uint32_t>> add_loops(const Block& block, Loop loop, int deepest);
  void add_polygons();
  void add_loop_polygons(const std::vector<std::vector<std::uint32_t>>& rings, std::size_t from, std::size_t to,
                         bool turned);

  HeadBuilder& head;
  Skin skin;
  std::vector<std::uint32_t> places = std::vector<std::uint32_t>(2 * kHalfColumns * kRows);
  static constexpr int kRows = kNeckRows + kMouthRows + kNoseRows + kEyeRows + kScalpRows;
  std::uint32_t crown = 0, throat = 0;
};

void Layout::add_grid_vertices() {
  for (int row = 0; row < kRows; ++row)
    for (int column = -kHalfColumns; column < kHalfColumns; ++column) {
      if (kMouthBlock.covers(column, row) || kLeftEyeBlock.covers(column, row) || kRightEyeBlock.covers(column, row))
        continue;
      SkinVertex vertex;
      vertex.at = {column_azimuth(column), row_elevation(row)};
      grid(column, row) = add(vertex);
    }
  for (int row = 0; row < kRows; ++row)
    for (int column = -kHalfColumns + 1; column < 0; ++column)
      if (!kMouthBlock.covers(column, row) && !kRightEyeBlock.covers(column, row))
        head.pair(grid(column, row), grid(-column, row));
  SkinVertex pole;
  pole.at = {0, 90};
  crown = add(pole);
}

std::vector<std::vector<std::uint32_t>> Layout::add_loops(const Block& block, Loop loop, int deepest) {
  const std::vector<std::array<int, 2>> outline = block_loop(block);
  const int columns = static_cast<int>(outline.size()), outermost = kMouthOuterRing;
  std::vector<std::vector<std::uint32_t>> rings;
  for (int ring = deepest; ring <= outermost; ++ring) {
    std::vector<std::uint32_t> vertices;
    for (int c = 0; c < columns; ++c) {
      // The right eye's columns run the other way round, so that they match the left eye's.
      const auto place = static_cast<std::size_t>(loop == Loop::right_eye ? (columns - c + columns / 2) % columns : c);
      SkinVertex vertex;
      vertex.loop = loop;
      vertex.ring = ring;
      vertex.column = c;
      if (ring == outermost) {
        const std::uint32_t v = grid(outline[place][0], outline[place][1]);
        vertex.at = skin.vertices[v].at;
        skin.vertices[v] = vertex;
        vertices.push_back(v);
        continue;
      }
      const Vector3 p = loop == Loop::mouth      ? lip_point(std::min(ring, 0), c)
                        : loop == Loop::left_eye ? lid_point(std::min(ring, kLidOuterRing), c)
                                                 : mirrored(lid_point(std::min(ring, kLidOuterRing), c));
      const int inner = loop == Loop::mouth ? 0 : kLidOuterRing;
      const SkinVertex& outer = skin.vertices[grid(outline[place][0], outline[place][1])];
      const double t = ring <= inner ? 0 : (ring - inner) / static_cast<double>(outermost - inner);
      const ChartPoint from = to_chart(p);
      vertex.at = {lerp(from.azimuth_deg, outer.at.azimuth_deg, t),
                   lerp(from.elevation_deg, outer.at.elevation_deg, t)};
      vertices.push_back(add(vertex));
    }
    rings.push_back(vertices);
  }
  return rings;
}

void Layout::add_loop_polygons(const std::vector<std::vector<std::uint32_t>>& rings, std::size_t from, std::size_t to,
                               bool turned) {
  for (std::size_t r = from; r < to; ++r)
    for (std::size_t c = 0; c < rings[r].size(); ++c) {
      const std::size_t d = (c + 1) % rings[r].size();
      if (turned)
        head.add_polygon({rings[r][d], rings[r + 1][d], rings[r + 1][c], rings[r][c]});
      else
        head.add_polygon({rings[r][c], rings[r + 1][c], rings[r + 1][d], rings[r][d]});
    }
}

void Layout::add_polygons() {
  const auto inside = [](const Block& b, int column, int row) {
    return column >= b.first_column && column < b.last_column && row >= b.first_row && row < b.last_row;
  };
  head.begin_part("face", {1, 1, 1}, 0.25);
  for (int row = 0; row + 1 < kRows; ++row)
    for (int column = -kHalfColumns; column < kHalfColumns; ++column) {
      if (inside(kMouthBlock, column, row) || inside(kLeftEyeBlock, column, row) || inside(kRightEyeBlock, column, row))
        continue;
      head.add_polygon({grid(column, row), grid(column + 1, row), grid(column + 1, row + 1), grid(column, row + 1)});
    }
  for (int column = -kHalfColumns; column < kHalfColumns; ++column)
    head.add_polygon({grid(column, kRows - 1), grid(column + 1, kRows - 1), crown});
  const auto lips = static_cast<std::size_t>(kLipContactRing - 1 - kMouthDeepestRing);
  add_loop_polygons(skin.mouth_rings, lips, skin.mouth_rings.size() - 1, false);
  add_loop_polygons(skin.left_eye_rings, 0, skin.left_eye_rings.size() - 1, false);
  add_loop_polygons(skin.right_eye_rings, 0, skin.right_eye_rings.size() - 1, true);
  head.begin_part("mouth_socket", {1, 1, 1}, 0.15);
  add_loop_polygons(skin.mouth_rings, 0, lips, false);
  for (std::size_t c = 0; c < kMouthColumns; ++c)
    head.add_polygon({skin.mouth_rings[0][c], skin.mouth_rings[0][(c + 1) % kMouthColumns], throat});
}

// Vertices whose place is given by the lips, the lids or the far parts of the grid stay; the others settle between
// them.
bool is_free(const SkinVertex& v) {
  if (v.loop == Loop::mouth) return v.ring > 0;
  if (v.loop != Loop::none) return v.ring > kLidOuterRing;
  return std::abs(v.at.azimuth_deg) < 42 && v.at.elevation_deg > -42 && v.at.elevation_deg < 38;
}

void relax_chart(Skin& skin, const std::vector<std::uint32_t>& mirror) {
  std::vector<SkinVertex>& vertices = skin.vertices;
  std::vector<ChartPoint> next(vertices.size());
  for (int pass = 0; pass < 60; ++pass) {
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      ChartPoint sum;
      for (const std::uint32_t n : skin.neighbours[v]) {
        sum.azimuth_deg += vertices[n].at.azimuth_deg;
        sum.elevation_deg += vertices[n].at.elevation_deg;
      }
      const double share = 0.5 / static_cast<double>(skin.neighbours[v].size());
      next[v] = {0.5 * vertices[v].at.azimuth_deg + share * sum.azimuth_deg,
                 0.5 * vertices[v].at.elevation_deg + share * sum.elevation_deg};
    }
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (!is_free(vertices[v])) continue;
      const ChartPoint a = next[v], b = next[mirror[v]];  // equal left and right, bit for bit
      vertices[v].at = {0.5 * (a.azimuth_deg - b.azimuth_deg), 0.5 * (a.elevation_deg + b.elevation_deg)};
    }
  }
}

void find_neighbours(const HeadBuilder& head, Skin& skin) {
  skin.neighbours.assign(skin.vertices.size(), {});
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    std::vector<std::uint32_t>& list = skin.neighbours[a];
    if (std::find(list.begin(), list.end(), b) == list.end()) list.push_back(b);
  };
  for (std::size_t f = 0; f + 1 < head.polygon_starts.size(); ++f) {
    const std::uint32_t first = head.polygon_starts[f], end = head.polygon_starts[f + 1];
    for (std::uint32_t i = first; i < end; ++i) {
      const std::uint32_t a = head.corners[i], b = head.corners[i + 1 < end ? i + 1 : first];
      join(a, b);
      join(b, a);
    }
  }
}

// Puts the vertices in space. What lips and lids differ from the plain skin fades out over their outer rings.
void place_vertices(HeadBuilder& head, const Skin& skin) {
  for (std::size_t v = 0; v < skin.vertices.size(); ++v) head.points_mm[v] = skin_point(skin.vertices[v].at);
  for (int c = 0; c < kMouthColumns; ++c) {
    const Vector3 change = lip_point(0, c) - head.points_mm[skin.mouth(0, c)];
    for (int ring = kMouthDeepestRing; ring <= kMouthOuterRing; ++ring) {
      Vector3& point = head.points_mm[skin.mouth(ring, c)];
      point = ring <= 0 ? lip_point(ring, c) : point + smooth_step(kMouthOuterRing, -0.5, ring) * change;
    }
  }
  for (int c = 0; c < kEyeColumns; ++c) {
    const Vector3 change = lid_point(kLidOuterRing, c) - head.points_mm[skin.left_eye(kLidOuterRing, c)];
    for (int ring = kEyeDeepestRing; ring <= kEyeOuterRing; ++ring) {
      const std::uint32_t left = skin.left_eye(ring, c), right = skin.right_eye(ring, c);
      Vector3& point = head.points_mm[left];
      point = ring <= kLidOuterRing ? lid_point(ring, c)
                                    : point + smooth_step(kEyeOuterRing, kLidOuterRing - 0.5, ring) * change;
      head.points_mm[right] = mirrored(point);
    }
  }
}

}  // namespace

std::uint32_t Skin::mouth(int ring, int column) const {
  return mouth_rings[static_cast<std::size_t>(ring - kMouthDeepestRing)][static_cast<std::size_t>(column)];
}
std::uint32_t Skin::left_eye(int ring, int column) const {
  return left_eye_rings[static_cast<std::size_t>(ring - kEyeDeepestRing)][static_cast<std::size_t>(column)];
}
std::uint32_t Skin::right_eye(int ring, int column) const {
  return right_eye_rings[static_cast<std::size_t>(ring - kEyeDeepestRing)][static_cast<std::size_t>(column)];
}

Skin add_skin(HeadBuilder& head) {
  Layout layout(head);
  layout.add_grid_vertices();
  layout.skin.mouth_rings = layout.add_loops(kMouthBlock, Loop::mouth, kMouthDeepestRing);
  layout.skin.left_eye_rings = layout.add_loops(kLeftEyeBlock, Loop::left_eye, kEyeDeepestRing);
  layout.skin.right_eye_rings = layout.add_loops(kRightEyeBlock, Loop::right_eye, kEyeDeepestRing);
  SkinVertex deep;
  deep.loop = Loop::mouth;
  deep.ring = kMouthDeepestRing;
  deep.column = 18;
  layout.throat = layout.add(deep);
  for (const std::vector<std::uint32_t>& ring : layout.skin.mouth_rings)
    for (int c = 0; c <= 18; ++c)
      for (const int column : {c, kMouthColumns - c})
        head.pair(ring[static_cast<std::size_t>(column % kMouthColumns)],
                  ring[static_cast<std::size_t>((36 - column + kMouthColumns) % kMouthColumns)]);
  for (std::size_t r = 0; r < layout.skin.left_eye_rings.size(); ++r)
    for (std::size_t c = 0; c < kEyeColumns; ++c)
      head.pair(layout.skin.left_eye_rings[r][c], layout.skin.right_eye_rings[r][c]);
  layout.add_polygons();
  find_neighbours(head, layout.skin);
  relax_chart(layout.skin, head.mirror);
  place_vertices(head, layout.skin);
  head.points_mm[layout.throat] = {0, -38, 52};
  return layout.skin;
}

}  // namespace face::phantom
