// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/motion_basis.h"

#include <Eigen/Dense>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/eigen_vector.h"

namespace face::model {
namespace {

constexpr double longest_mm = 120;    // scales are this, 60, 30 and 15
constexpr double head_shift_mm = 10;  // standard deviations of what the whole head does
constexpr double head_turn_rad = 0.12;
constexpr double lopsided_functions = 1.0 / 3;  // the smooth ones: rough motion that is not mirrored is mistaken
constexpr double least_left = 1e-6;             // of the variance: where the factor ends

// The sum of exp(-d^2 / (2 s^2)) over the scales: every scale is half the one before, its term the fourth power.
double scales_sum(double squared_mm) {
  const double e120 = std::exp(-squared_mm / (2 * longest_mm * longest_mm));
  const double e60 = e120 * e120 * e120 * e120, e30 = e60 * e60 * e60 * e60, e15 = e30 * e30 * e30 * e30;
  return e120 + e60 + e30 + e15;
}

double squared_distance(const Vec3f& p, const Vec3f& q, double x_of_q) {
  const double x = static_cast<double>(p[0]) - x_of_q, y = static_cast<double>(p[1]) - static_cast<double>(q[1]),
               z = static_cast<double>(p[2]) - static_cast<double>(q[2]);
  return x * x + y * y + z * z;
}

// What the whole head's shift and turn, the last six coefficients, move a point by.
Eigen::Vector3d of_whole_head(const Vec3f& p, const Eigen::VectorXd& c) {
  const Eigen::Vector3d shift = c.tail<6>().head<3>(), turn = c.tail<3>();
  return shift + turn.cross(vector_of(p));
}

}  // namespace

class MotionBasis::Process {
 public:
  Process(const std::vector<Vec3f>& places_mm, double mirror_x_mm, const MotionBasisOptions& options);
  std::vector<double> precision(double asymmetry) const;
  void row(std::size_t i, const Eigen::Vector3d& direction, std::span<double> out) const;
  std::vector<Eigen::Vector3d> at_places(const Eigen::VectorXd& c) const;
  std::vector<Eigen::Vector3d> anywhere(const std::vector<Vec3f>& points_mm, const Eigen::VectorXd& c) const;

 private:
  // Even or odd functions of the mirrored place: values at the places, and how to have them elsewhere.
  struct Kind {
    double sign = 1;
    std::vector<std::size_t> pivots;
    Eigen::MatrixXd values;  // places x functions: the Cholesky factor
    Eigen::MatrixXd root;    // its rows at the pivots, lower triangular
  };
  // One axis of one symmetry: a run of coefficients that are functions of a kind.
  struct Block {
    std::size_t first = 0, count = 0, axis = 0;
    const Kind* kind = nullptr;
  };
  Kind make_kind(double sign, std::size_t most) const;
  double covariance(const Vec3f& p, const Vec3f& q, double sign) const;
  std::array<Block, 6> blocks() const;

  std::vector<Vec3f> places_;
  double mirror_x_mm_ = 0, variance_ = 0;
  Kind even_, odd_;
  std::size_t even_lopsided_ = 0, odd_lopsided_ = 0;  // functions that also make motion that is not mirrored
};

double MotionBasis::Process::covariance(const Vec3f& p, const Vec3f& q, double sign) const {
  const double x = static_cast<double>(q[0]);
  return 0.25 * variance_ *
         (scales_sum(squared_distance(p, q, x)) + sign * scales_sum(squared_distance(p, q, 2 * mirror_x_mm_ - x)));
}

MotionBasis::Process::Kind MotionBasis::Process::make_kind(double sign, std::size_t most) const {
  const auto n = static_cast<Eigen::Index>(places_.size());
  Kind kind{sign, {}, Eigen::MatrixXd(n, static_cast<Eigen::Index>(std::min(most, places_.size()))), {}};
  Eigen::VectorXd left(n);
  for (Eigen::Index i = 0; i < n; ++i)
    left[i] = covariance(places_[static_cast<std::size_t>(i)], places_[static_cast<std::size_t>(i)], sign);
  Eigen::Index k = 0;
  for (; k < kind.values.cols(); ++k) {
    Eigen::Index pivot = 0;
    if (left.maxCoeff(&pivot) <= least_left * variance_) break;
    const double root = std::sqrt(left[pivot]);
    const Vec3f& at = places_[static_cast<std::size_t>(pivot)];
    Eigen::VectorXd column(n);
    for (Eigen::Index i = 0; i < n; ++i) column[i] = covariance(places_[static_cast<std::size_t>(i)], at, sign);
    column.noalias() -= kind.values.leftCols(k) * kind.values.row(pivot).head(k).transpose();
    kind.values.col(k) = column / root;
    left -= kind.values.col(k).cwiseAbs2();
    left[pivot] = 0;
    kind.pivots.push_back(static_cast<std::size_t>(pivot));
  }
  kind.values.conservativeResize(Eigen::NoChange, k);
  kind.root.resize(k, k);
  for (Eigen::Index i = 0; i < k; ++i)
    kind.root.row(i) = kind.values.row(static_cast<Eigen::Index>(kind.pivots[static_cast<std::size_t>(i)]));
  return kind;
}

MotionBasis::Process::Process(const std::vector<Vec3f>& places_mm, double mirror_x_mm,
                              const MotionBasisOptions& options)
    : places_(places_mm), mirror_x_mm_(mirror_x_mm), variance_(options.motion_mm * options.motion_mm) {
  even_ = make_kind(1, options.functions);
  odd_ = make_kind(-1, options.functions);
  if (options.asymmetry > 0) {
    even_lopsided_ = static_cast<std::size_t>(std::ceil(lopsided_functions * static_cast<double>(even_.pivots.size())));
    odd_lopsided_ = static_cast<std::size_t>(std::ceil(lopsided_functions * static_cast<double>(odd_.pivots.size())));
  }
}

std::vector<double> MotionBasis::Process::precision(double asymmetry) const {
  std::vector<double> result;
  const std::array<Block, 6> all = blocks();
  for (std::size_t b = 0; b < all.size(); ++b)
    result.insert(result.end(), all[b].count, b < 3 ? 1 : 1 / (asymmetry * asymmetry));
  result.insert(result.end(), 3, 1 / (head_shift_mm * head_shift_mm));
  result.insert(result.end(), 3, 1 / (head_turn_rad * head_turn_rad));
  return result;
}

std::array<MotionBasis::Process::Block, 6> MotionBasis::Process::blocks() const {
  // Mirrored motion is odd along x and even along y and z; the other is the other way round.
  std::array<Block, 6> all;
  std::size_t first = 0;
  for (std::size_t b = 0; b < all.size(); ++b) {
    const std::size_t axis = b % 3;
    const bool mirrored = b < 3, odd = mirrored == (axis == 0);
    const Kind& kind = odd ? odd_ : even_;
    const std::size_t count = mirrored ? kind.pivots.size() : odd ? odd_lopsided_ : even_lopsided_;
    all[b] = {first, count, axis, &kind};
    first += count;
  }
  return all;
}

void MotionBasis::Process::row(std::size_t i, const Eigen::Vector3d& direction, std::span<double> out) const {
  Eigen::Map<Eigen::VectorXd> row(out.data(), static_cast<Eigen::Index>(out.size()));
  for (const Block& block : blocks())
    row.segment(static_cast<Eigen::Index>(block.first), static_cast<Eigen::Index>(block.count)) =
        direction[static_cast<Eigen::Index>(block.axis)] *
        block.kind->values.row(static_cast<Eigen::Index>(i)).head(static_cast<Eigen::Index>(block.count)).transpose();
  const Eigen::Vector3d turn = vector_of(places_[i]).cross(direction);
  row.tail<6>().head<3>() = direction;
  row.tail<3>() = turn;
}

std::vector<Eigen::Vector3d> MotionBasis::Process::at_places(const Eigen::VectorXd& c) const {
  std::vector<Eigen::Vector3d> out;
  for (const Vec3f& p : places_) out.push_back(of_whole_head(p, c));
  for (const Block& block : blocks()) {
    const Eigen::VectorXd along =
        block.kind->values.leftCols(static_cast<Eigen::Index>(block.count)) *
        c.segment(static_cast<Eigen::Index>(block.first), static_cast<Eigen::Index>(block.count));
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i][static_cast<Eigen::Index>(block.axis)] += along[static_cast<Eigen::Index>(i)];
  }
  return out;
}

std::vector<Eigen::Vector3d> MotionBasis::Process::anywhere(const std::vector<Vec3f>& points_mm,
                                                            const Eigen::VectorXd& c) const {
  std::vector<Eigen::Vector3d> out;
  for (const Vec3f& p : points_mm) out.push_back(of_whole_head(p, c));
  for (const Kind* kind : {&even_, &odd_}) {
    // Weights of the pivots along each axis: functions elsewhere are covariances with the pivots times 1 / root'.
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(kind->pivots.size()), 3);
    for (const Block& block : blocks())
      if (block.kind == kind)
        weights.col(static_cast<Eigen::Index>(block.axis)).head(static_cast<Eigen::Index>(block.count)) +=
            c.segment(static_cast<Eigen::Index>(block.first), static_cast<Eigen::Index>(block.count));
    kind->root.triangularView<Eigen::Lower>().transpose().solveInPlace(weights);
    for (std::size_t i = 0; i < out.size(); ++i)
      for (std::size_t k = 0; k < kind->pivots.size(); ++k)
        out[i] += covariance(points_mm[i], places_[kind->pivots[k]], kind->sign) *
                  weights.row(static_cast<Eigen::Index>(k)).transpose();
  }
  return out;
}

namespace {

std::vector<std::array<double, 3>> arrays_of(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<std::array<double, 3>> out;
  for (const Eigen::Vector3d& v : vectors) out.push_back({v[0], v[1], v[2]});
  return out;
}

Eigen::VectorXd checked(const std::vector<double>& coefficients, std::size_t size) {
  check(coefficients.size() == size, "coefficients has ", coefficients.size(), " numbers, expected ", size);
  return Eigen::Map<const Eigen::VectorXd>(coefficients.data(), static_cast<Eigen::Index>(size));
}

}  // namespace

MotionBasis::MotionBasis(const std::vector<Vec3f>& places_mm, double mirror_x_mm, const MotionBasisOptions& options) {
  check(!places_mm.empty(), "places_mm is empty, expected at least 1 place");
  check(options.motion_mm > 0, "motion_mm is ", options.motion_mm, ", expected more than 0");
  check(options.asymmetry >= 0, "asymmetry is ", options.asymmetry, ", expected at least 0");
  process_ = std::make_unique<const Process>(places_mm, mirror_x_mm, options);
  precision_ = process_->precision(options.asymmetry);
}
MotionBasis::~MotionBasis() = default;

void MotionBasis::row(std::size_t i, const std::array<double, 3>& direction, std::span<double> out) const {
  process_->row(i, {direction[0], direction[1], direction[2]}, out);
}
std::vector<std::array<double, 3>> MotionBasis::displacements(const std::vector<double>& coefficients) const {
  return arrays_of(process_->at_places(checked(coefficients, size())));
}
std::vector<std::array<double, 3>> MotionBasis::displacements(const std::vector<Vec3f>& points_mm,
                                                              const std::vector<double>& coefficients) const {
  return arrays_of(process_->anywhere(points_mm, checked(coefficients, size())));
}

}  // namespace face::model
