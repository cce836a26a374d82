// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/region_pca.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/random.h"
#include "nodes/model/gram.h"

namespace face::model {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Spectrum {
  Eigen::VectorXd values;   // falling
  Eigen::MatrixXd vectors;  // columns
};

Spectrum all_of(const Eigen::MatrixXd& gram) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()};
}

// The `wanted` largest eigenvalues with their vectors by block Lanczos with full reorthogonalisation (Golub and
// Underwood, The Block Lanczos Method for Computing Eigenvalues, 1977): a Krylov space that grows until the residuals
// of all wanted pairs are below 1e-10 of the largest value; all of them where it would grow past half the matrix.
Spectrum largest_of(const Eigen::MatrixXd& gram, Eigen::Index wanted) {
  const Eigen::Index m = gram.rows(), block = 24;
  if (3 * wanted + 4 * block > m / 2) return all_of(gram);
  Random random(11);
  Eigen::MatrixXd basis(m, 0), image(m, 0), next(m, block);
  for (Eigen::Index c = 0; c < block; ++c)
    for (Eigen::Index r = 0; r < m; ++r) next(r, c) = random.normal();
  while (basis.cols() + block <= m / 2) {
    for (int twice = 0; twice < 2 && basis.cols() > 0; ++twice) next -= basis * (basis.transpose() * next);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(next);
    next = qr.householderQ() * Eigen::MatrixXd::Identity(m, block);
    for (int twice = 0; twice < 2 && basis.cols() > 0; ++twice) next -= basis * (basis.transpose() * next);
    next.colwise().normalize();
    const Eigen::Index size = basis.cols();
    basis.conservativeResize(Eigen::NoChange, size + block);
    image.conservativeResize(Eigen::NoChange, size + block);
    basis.rightCols(block) = next;
    image.rightCols(block).noalias() = gram * next;
    next = image.rightCols(block);
    if (basis.cols() < 3 * wanted || (basis.cols() / block) % 3 != 0) continue;
    const Spectrum small = all_of(basis.transpose() * image);
    Spectrum ritz{small.values.head(wanted), basis * small.vectors.leftCols(wanted)};
    const Eigen::MatrixXd residual = image * small.vectors.leftCols(wanted) - ritz.vectors * ritz.values.asDiagonal();
    if (residual.colwise().norm().maxCoeff() <= 1e-10 * ritz.values(0)) return ritz;
  }
  return all_of(gram);
}

void check_weights(const Matrix& weights, std::size_t vertices) {
  check(weights.values.size() == vertices, "weights has ", weights.values.size(), " values, shapes have ", vertices,
        " points");
  for (const double w : weights.values) check(w >= 0, "weights has ", w, ", expected none below 0");
}

// One shape to a row of 3V numbers, as they come: what is made of them is made in double.
FloatRows rows_of(const engine::Seq<MeshPoints>& shapes, std::size_t vertices) {
  FloatRows rows(static_cast<Eigen::Index>(shapes.size()), static_cast<Eigen::Index>(3 * vertices));
  for (std::size_t j = 0; j < shapes.size(); ++j) {
    const auto shape = shapes.at(j);
    check(shape->points_mm.size() == vertices, "shape ", shapes.id(j), " has ", shape->points_mm.size(), " points, ",
          shapes.id(0), " has ", vertices);
    float* row = rows.data() + j * 3 * vertices;
    bool finite = true;
    for (std::size_t v = 0; v < vertices; ++v)
      for (std::size_t k = 0; k < 3; ++k) {
        row[3 * v + k] = shape->points_mm[v][k];
        finite &= std::isfinite(row[3 * v + k]);
      }
    if (finite) continue;
    for (std::size_t i = 0; i < 3 * vertices; ++i)
      check(std::isfinite(row[i]), "shape ", shapes.id(j), " has a point ", i / 3, " that is not finite");
  }
  return rows;
}

// Runs of columns side by side: use(first column, number).
template <class Use>
void for_columns(Eigen::Index size, const Use& use) {
  constexpr Eigen::Index run = 512;
  tbb::parallel_for(Eigen::Index{0}, (size + run - 1) / run,
                    [&](Eigen::Index r) { use(r * run, std::min(size, (r + 1) * run) - r * run); });
}

Eigen::RowVectorXd mean_of(const FloatRows& x) {
  Eigen::RowVectorXd mean(x.cols());
  for_columns(x.cols(), [&](Eigen::Index start, Eigen::Index length) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(length);
    for (Eigen::Index j = 0; j < x.rows(); ++j) sum += x.row(j).segment(start, length).cast<double>();
    mean.segment(start, length) = sum / static_cast<double>(x.rows());
  });
  return mean;
}

// X D X' of the centred shapes, where D has the weight of every number. It costs m^2 times the numbers of the region,
// so those that weigh nothing are left out.
Eigen::MatrixXd weighted_gram(const FloatRows& x, const Eigen::RowVectorXd& mean, const Matrix* weights) {
  std::vector<Eigen::Index> columns;
  std::vector<double> roots;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const double weight = weights ? weights->values[static_cast<std::size_t>(i / 3)] : 1;
    if (!(weight > 0)) continue;
    columns.push_back(i);
    roots.push_back(std::sqrt(weight));
  }
  const std::vector<double> lower = gram_of(static_cast<std::size_t>(x.rows()), columns.size(),
                                            [&](std::size_t j, std::size_t first, std::span<double> out) {
                                              const float* row = x.data() + static_cast<Eigen::Index>(j) * x.cols();
                                              for (std::size_t c = 0; c < out.size(); ++c) {
                                                const Eigen::Index i = columns[first + c];
                                                out[c] = roots[first + c] * (static_cast<double>(row[i]) - mean(i));
                                              }
                                            });
  return Eigen::Map<const RowMatrix>(lower.data(), x.rows(), x.rows()).selfadjointView<Eigen::Lower>();
}

// The roots of the eigenvalues that count, falling.
std::vector<double> singular_values(const Spectrum& spectrum, double least_sigma) {
  const double largest = std::sqrt(std::max(spectrum.values(0), 0.0));
  std::vector<double> found;
  for (const double value : spectrum.values) {
    const double root = std::sqrt(std::max(value, 0.0));
    if (!(root > least_sigma * largest) || !(root > 0)) break;
    found.push_back(root);
  }
  return found;
}

// Turns every component so that its largest projection is positive.
void fix_signs(Eigen::Map<RowMatrix>& modes, Eigen::Map<RowMatrix>& projections) {
  for (Eigen::Index i = 0; i < projections.rows(); ++i) {
    Eigen::Index at = 0;
    projections.row(i).cwiseAbs().maxCoeff(&at);
    if (projections(i, at) >= 0) continue;
    projections.row(i) *= -1;
    modes.row(i) *= -1;
  }
}

}  // namespace

ShapeModel region_pca(const engine::Seq<MeshPoints>& shapes, const Matrix* weights, const RegionPcaOptions& options) {
  check(shapes.size() >= 2, "shapes has ", shapes.size(), " examples, expected at least 2");
  const std::size_t vertices = shapes.at(0)->points_mm.size();
  if (weights) check_weights(*weights, vertices);
  const FloatRows x = rows_of(shapes, vertices);
  const Eigen::Index m = x.rows(), n = x.cols();
  const Eigen::RowVectorXd mean = mean_of(x);
  const auto wanted = std::min<Eigen::Index>(options.components, m);
  Spectrum spectrum = largest_of(weighted_gram(x, mean, weights), wanted);
  spectrum.values.conservativeResize(wanted);
  const std::vector<double> w = singular_values(spectrum, options.least_sigma);
  const auto k = static_cast<Eigen::Index>(w.size());
  ShapeModel model;
  model.vertices = vertices;
  model.mean_mm.assign(mean.data(), mean.data() + n);
  model.modes.resize(static_cast<std::size_t>(k * n));
  model.projections.assign(static_cast<std::size_t>(k * n), 0.0);
  for (const double value : w) model.sigmas_mm.push_back(value / std::sqrt(static_cast<double>(m)));
  Eigen::MatrixXd right(m, k);  // v~_i / w~_i
  for (Eigen::Index i = 0; i < k; ++i) right.col(i) = spectrum.vectors.col(i) / w[static_cast<std::size_t>(i)];
  Eigen::Map<RowMatrix> modes(model.modes.data(), k, n), projections(model.projections.data(), k, n);
  // u~_i = D^(1/2) u_i, and a_i = u~_i . D^(1/2) x: the projection of a full face is D u_i.
  for_columns(n, [&](Eigen::Index start, Eigen::Index length) {
    const RowMatrix centred = x.middleCols(start, length).cast<double>().rowwise() - mean.segment(start, length);
    modes.middleCols(start, length).noalias() = right.transpose() * centred;
    for (Eigen::Index c = start; c < start + length; ++c) {
      const double d = weights ? weights->values[static_cast<std::size_t>(c / 3)] : 1.0;
      if (d > 0) projections.col(c) = d * modes.col(c);
    }
  });
  fix_signs(modes, projections);
  return model;
}

namespace {

void check_sizes(const ShapeModel& model) {
  const std::size_t numbers = 3 * model.vertices;
  check(model.mean_mm.size() == numbers, "the model's mean has ", model.mean_mm.size(), " numbers, expected ", numbers,
        ", 3 for each of its vertices");
  check(model.modes.size() == model.size() * numbers && model.projections.size() == model.size() * numbers,
        "the model's modes and projections have ", model.modes.size(), " and ", model.projections.size(),
        " numbers, expected ", model.size() * numbers, " for ", model.size(), " components");
}

void check_sigmas(const ShapeModel& model) {
  for (const double sigma : model.sigmas_mm)
    check(sigma > 0, "the model has a deviation of ", sigma, ", expected more than 0");
}

}  // namespace

std::vector<double> coefficients_of(const ShapeModel& model, const std::vector<double>& shape_mm) {
  check_sizes(model);
  check(shape_mm.size() == 3 * model.vertices, "shape has ", shape_mm.size() / 3, " points, the model ",
        model.vertices);
  const auto n = static_cast<Eigen::Index>(shape_mm.size()), k = static_cast<Eigen::Index>(model.size());
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(shape_mm.data(), n) -
                            Eigen::Map<const Eigen::VectorXd>(model.mean_mm.data(), n);
  std::vector<double> out(model.size());
  const Eigen::Map<const RowMatrix> projections(model.projections.data(), k, n);
  Eigen::Map<Eigen::VectorXd>(out.data(), k) = projections * x;
  return out;
}

std::vector<double> shape_of(const ShapeModel& model, const std::vector<double>& coefficients, double amplify) {
  check_sizes(model);
  check(coefficients.size() <= model.size(), "coefficients has ", coefficients.size(), " values, the model ",
        model.size(), " components");
  const auto n = static_cast<Eigen::Index>(3 * model.vertices), k = static_cast<Eigen::Index>(coefficients.size());
  std::vector<double> out = model.mean_mm;
  const Eigen::Map<const RowMatrix> modes(model.modes.data(), k, n);
  Eigen::Map<Eigen::VectorXd>(out.data(), n) +=
      amplify * (modes.transpose() * Eigen::Map<const Eigen::VectorXd>(coefficients.data(), k));
  return out;
}

Weights project_shape(const ShapeModel& model, const MeshPoints& shape, const bool* known,
                      const ProjectShapeOptions& options) {
  if (known && !*known) return {};
  std::vector<double> x;
  for (const Vec3f& p : shape.points_mm)
    for (const float value : p) x.push_back(static_cast<double>(value));
  std::vector<double> coefficients = coefficients_of(model, x);
  if (options.in_sigmas) {
    check_sigmas(model);
    for (std::size_t k = 0; k < coefficients.size(); ++k) coefficients[k] /= model.sigmas_mm[k];
  }
  return {std::vector<float>(coefficients.begin(), coefficients.end())};
}

MeshPoints rebuild_shape(const ShapeModel& model, const Weights& coefficients, const RebuildShapeOptions& options) {
  std::vector<double> a(coefficients.values.begin(), coefficients.values.end());
  if (options.in_sigmas) {
    check_sigmas(model);
    for (std::size_t k = 0; k < std::min(a.size(), model.size()); ++k) a[k] *= model.sigmas_mm[k];
  }
  const std::vector<double> x = shape_of(model, a, options.amplify);
  MeshPoints out;
  for (std::size_t v = 0; v < model.vertices; ++v)
    out.points_mm.push_back(
        {static_cast<float>(x[3 * v]), static_cast<float>(x[3 * v + 1]), static_cast<float>(x[3 * v + 2])});
  return out;
}

Rig model_rig(const ShapeModel& model, const Mesh& mesh, const ModelRigOptions& options) {
  check(mesh.points_mm.size() == model.vertices, "mesh has ", mesh.points_mm.size(), " points, the model ",
        model.vertices);
  Rig rig;
  rig.neutral = mesh;
  rig.neutral.points_mm = rebuild_shape(model, {}).points_mm;
  const std::size_t count = std::min(model.size(), static_cast<std::size_t>(options.components));
  for (std::size_t k = 0; k < count; ++k) {
    Shape shape{"pc_" + std::to_string(k + 1), {}, {}};
    const double scale = options.in_sigmas ? model.sigmas_mm[k] : 1;
    const double* mode = model.modes.data() + k * 3 * model.vertices;
    for (std::size_t v = 0; v < model.vertices; ++v) {
      shape.vertices.push_back(static_cast<std::uint32_t>(v));
      shape.offsets_mm.push_back({static_cast<float>(scale * mode[3 * v]), static_cast<float>(scale * mode[3 * v + 1]),
                                  static_cast<float>(scale * mode[3 * v + 2])});
    }
    rig.shapes.push_back(std::move(shape));
  }
  return rig;
}

}  // namespace face::model
