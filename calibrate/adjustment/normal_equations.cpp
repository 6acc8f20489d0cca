#include "calibrate/adjustment/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "calibrate/adjustment/blocks.h"

namespace bpms {
namespace {

using Kind = BlockId::Kind;
using Matrix = Eigen::MatrixXd;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Which block belongs to what is eliminated together: a frame, or a point of nature (then frames are tied
// together by the points and stay).
struct Elimination {
  const BundleProblem& problem;
  bool nature = false;

  explicit Elimination(const BundleProblem& p) : problem(p) {
    for (const NetworkTarget& target : p.targets) nature = nature || target.known == PointsKnown::unknown;
  }
  bool eliminated(const BlockId& id) const {
    if (nature)
      return id.kind == Kind::point &&
             problem.targets[static_cast<std::size_t>(id.a)].known == PointsKnown::unknown;
    return (id.kind == Kind::rig && !problem.turntable()) ||
           (id.kind == Kind::target && problem.slots(id.a) > 1);
  }
  // Of a term; {-1, -1}: it has nothing that is eliminated.
  std::pair<int, int> cell(const Term& term) const {
    for (const BlockId& id : term.blocks) {
      if (!eliminated(id)) continue;
      if (nature) return {id.a, id.b};
      return {problem.corners[static_cast<std::size_t>(term.corner)].frame, 0};
    }
    return {-1, -1};
  }
};

struct Column {
  Eigen::Index first = -1;  // -1: eliminated
  std::vector<int> free;    // of the block's values
};
using Columns = std::map<BlockId, Column>;

std::vector<std::string> block_names(const BundleProblem& problem, const BundleState& state,
                                     const BlockId& id) {
  const auto a = static_cast<std::size_t>(id.a);
  static const char* const pose[] = {"rx", "ry", "rz", "tx", "ty", "tz"};
  std::vector<std::string> out;
  if (id.kind == Kind::lens || id.kind == Kind::camera) {
    const std::vector<std::string> names = parameter_names(state.cameras[a]);
    const auto lens = static_cast<std::ptrdiff_t>(state.cameras[a].parameters.size());
    const auto begin = id.kind == Kind::lens ? names.begin() : names.begin() + lens,
               end = id.kind == Kind::lens ? names.begin() + lens : names.end();
    for (auto name = begin; name != end; ++name) out.push_back(state.cameras[a].name + "." + *name);
    return out;
  }
  const std::string frame = problem.turntable() ? "turntable" : fmt::format("rig in frame {}", id.a + 1);
  const std::string target = id.kind == Kind::rig ? frame : problem.targets[a].name;
  if (id.kind == Kind::bending) return {"the bending of the " + target, "the bending of the " + target};
  if (id.kind == Kind::point) {
    for (const char* axis : {"x", "y", "z"})
      out.push_back(fmt::format("{} of point {} of the {}", axis, id.b, target));
    return out;
  }
  for (const char* name : pose) out.push_back(fmt::format("the pose ({}) of the {}", name, target));
  return out;
}

// Lens and pose of each camera first.
std::vector<BlockId> kept_in_order(const Blocks& blocks, const Elimination& elimination) {
  std::vector<BlockId> out;
  for (const auto& [id, block] : blocks.all())
    if (!elimination.eliminated(id)) out.push_back(id);
  std::stable_sort(out.begin(), out.end(), [](const BlockId& a, const BlockId& b) {
    const auto key = [](const BlockId& id) {
      const bool rig = id.kind == Kind::lens || id.kind == Kind::camera;
      return std::tuple(rig ? 0 : 1, rig ? id.a : 0, id);
    };
    return key(a) < key(b);
  });
  return out;
}

std::vector<int> free_values(const Block& block) {
  std::vector<int> out;
  for (int i = 0; i < block.size; ++i)
    if (std::find(block.held.begin(), block.held.end(), i) == block.held.end()) out.push_back(i);
  return out;
}

Columns lay_out(const BundleProblem& problem, const BundleState& state, const Blocks& blocks,
                const Elimination& elimination, NormalEquations& out) {
  Columns columns;
  for (const BlockId& id : kept_in_order(blocks, elimination)) {
    Column& column = columns[id];
    column.free = free_values(blocks.all().at(id));
    column.first = static_cast<Eigen::Index>(out.names.size());
    const std::vector<std::string> names = block_names(problem, state, id);
    for (const int i : column.free) {
      out.names.push_back(names[static_cast<std::size_t>(i)]);
      if (id.kind == Kind::lens || id.kind == Kind::camera) out.order.push_back(out.names.back());
    }
  }
  out.parameters = static_cast<int>(out.names.size());
  for (const auto& [id, block] : blocks.all()) {
    if (!elimination.eliminated(id)) continue;
    columns[id].free = free_values(block);
    out.parameters += static_cast<int>(columns[id].free.size());
  }
  return columns;
}

// The terms of one cell in columns of their own: those that are kept, then those that are eliminated.
class Cell {
 public:
  Cell(const Blocks& blocks, const Columns& columns, const std::vector<const Term*>& terms)
      : blocks_(blocks), columns_(columns) {
    for (const bool kept : {true, false}) {
      for (const Term* term : terms)
        for (const BlockId& id : term->blocks) {
          const Column& column = columns.at(id);
          if ((column.first >= 0) != kept || !local_.emplace(id, size_).second) continue;
          const auto n = static_cast<Eigen::Index>(column.free.size());
          for (Eigen::Index i = 0; kept && i < n; ++i) global_.push_back(column.first + i);
          size_ += n;
        }
      if (kept) kept_ = size_;
    }
    normal_.setZero(size_, size_);
    believed_.setZero(size_, size_);
  }

  void add(const Term& term, int frame, NormalEquations& out) {
    const int rows = term.cost->num_residuals();
    std::vector<const double*> values;
    std::vector<RowMajorMatrix> jacobians;
    std::vector<double*> pointers;
    for (const BlockId& id : term.blocks) {
      values.push_back(blocks_.all().at(id).values);
      jacobians.emplace_back(rows, blocks_.all().at(id).size);
    }
    for (RowMajorMatrix& j : jacobians) pointers.push_back(j.data());
    Eigen::VectorXd r(rows);
    if (!term.cost->Evaluate(values.data(), r.data(), pointers.data()))
      throw Error(ErrorKind::internal, "a used corner of the adjustment does not project");
    Matrix row = Matrix::Zero(rows, size_);
    for (std::size_t k = 0; k < term.blocks.size(); ++k) {
      const std::vector<int>& free = columns_.at(term.blocks[k]).free;
      const Eigen::Index first = local_.at(term.blocks[k]);
      for (std::size_t i = 0; i < free.size(); ++i)
        row.col(first + static_cast<Eigen::Index>(i)) = jacobians[k].col(free[i]);
    }
    normal_.noalias() += row.transpose() * row;
    if (term.belief) believed_.noalias() += row.transpose() * row;
    const auto [score, fresh] = score_.try_emplace(frame);
    if (fresh) score->second.setZero(size_);
    score->second.noalias() -= row.transpose() * r;  // measured minus projected
    if (term.belief) return;
    out.squared_residuals += r.squaredNorm();
    out.observations += rows;
    if (term.corner < 0) return;
    out.corner_squares += r.squaredNorm();
    out.coordinates += rows;
  }

  void eliminate(NormalEquations& out, std::map<int, Eigen::VectorXd>& scores) const {
    const Eigen::Index gone = size_ - kept_;
    Matrix left = normal_.topLeftCorner(kept_, kept_);
    Matrix solved(gone, kept_);
    Eigen::LDLT<Matrix> inner;
    if (gone > 0) {
      inner.compute(normal_.bottomRightCorner(gone, gone));
      if (inner.info() != Eigen::Success || !inner.isPositive() || !(inner.vectorD().minCoeff() > 0))
        throw Error(ErrorKind::numeric, "the corners of a frame do not determine the pose of the board");
      solved = inner.solve(normal_.bottomLeftCorner(gone, kept_));
      left.noalias() -= normal_.topRightCorner(kept_, gone) * solved;
    }
    for (Eigen::Index j = 0; j < kept_; ++j)
      for (Eigen::Index i = 0; i < kept_; ++i) {
        out.information(at(i), at(j)) += left(i, j);
        out.believed(at(i), at(j)) += believed_(i, j);
      }
    Eigen::VectorXd all = Eigen::VectorXd::Zero(gone);
    for (const auto& [frame, score] : score_) {
      const Eigen::VectorXd tail = score.tail(gone);
      const Eigen::VectorXd kept = score.head(kept_) - solved.transpose() * tail;
      const auto [sum, fresh] = scores.try_emplace(frame);
      if (fresh) sum->second.setZero(out.information.rows());
      for (Eigen::Index i = 0; i < kept_; ++i) sum->second[at(i)] += kept[i];
      all += tail;
    }
    if (gone > 0) out.pose_decrement += all.dot(inner.solve(all));
  }

 private:
  Eigen::Index at(Eigen::Index local) const { return global_[static_cast<std::size_t>(local)]; }

  const Blocks& blocks_;
  const Columns& columns_;
  std::map<BlockId, Eigen::Index> local_;
  std::vector<Eigen::Index> global_;  // of the kept
  Eigen::Index size_ = 0, kept_ = 0;
  Matrix normal_, believed_;
  std::map<int, Eigen::VectorXd> score_;  // of each frame
};

// How many of the parameters belief determines and not the corners: the trace of N^-1 (what belief adds to
// N).
double known_by_belief(const NormalEquations& equations) {
  if (equations.believed.isZero(0)) return 0;
  const Eigen::VectorXd scale = equations.information.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix all = scale.asDiagonal() * equations.information * scale.asDiagonal();
  return all.ldlt().solve(Matrix(scale.asDiagonal() * equations.believed * scale.asDiagonal())).trace();
}

}  // namespace

Eigen::VectorXd NormalEquations::score() const {
  Eigen::VectorXd out = known_score;
  for (const Frame& frame : frames) out += frame.score;
  return out;
}

double NormalEquations::rms_px() const {
  return coordinates > 0 ? std::sqrt(corner_squares / coordinates) : 0;
}

double NormalEquations::sigma_px() const {
  return observations > parameters ? std::sqrt(squared_residuals / (observations - parameters)) : 0;
}

NormalEquations normal_equations(const BundleProblem& problem, const BundleState& state) {
  BundleState at = state;
  const Blocks blocks(problem, at);
  const Elimination elimination(problem);
  NormalEquations out;
  const Columns columns = lay_out(problem, state, blocks, elimination, out);
  std::map<std::pair<int, int>, std::vector<const Term*>> cells;
  for (const Term& term : blocks.terms()) cells[elimination.cell(term)].push_back(&term);
  const auto n = static_cast<Eigen::Index>(out.names.size());
  out.information.setZero(n, n);
  out.believed.setZero(n, n);
  out.known_score.setZero(n);
  constexpr int no_frame = -1;
  std::map<int, Eigen::VectorXd> scores;
  for (const auto& [key, terms] : cells) {
    Cell cell(blocks, columns, terms);
    for (const Term* term : terms)
      cell.add(*term,
               term->corner < 0 ? no_frame : problem.corners[static_cast<std::size_t>(term->corner)].frame,
               out);
    cell.eliminate(out, scores);
  }
  for (auto& [frame, score] : scores) {
    if (frame == no_frame)
      out.known_score = std::move(score);
    else
      out.frames.push_back({frame, std::move(score)});
  }
  out.parameters -= static_cast<int>(std::lround(known_by_belief(out)));
  return out;
}

Eigen::MatrixXd cofactors(const NormalEquations& equations) {
  const Eigen::MatrixXd& n = equations.information;
  const Eigen::VectorXd diagonal = n.diagonal();
  Eigen::Index worst = 0;
  constexpr double least_reciprocal_condition = 1e-13;
  if (diagonal.minCoeff(&worst) > 0 && n.allFinite()) {
    const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * n * scale.asDiagonal());
    if (eigen.eigenvalues()[0] > least_reciprocal_condition * eigen.eigenvalues()[n.rows() - 1]) {
      const Eigen::MatrixXd half = scale.asDiagonal() * eigen.eigenvectors() *
                                   eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
      return half * half.transpose();
    }
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&worst);
  }
  fail(ErrorKind::numeric, {},
       "the views do not determine {}: show the target tilted by 30 to 45 degrees in several directions, "
       "over the whole "
       "image, or ask for fewer lens parameters",
       equations.names[static_cast<std::size_t>(worst)]);
}

Eigen::MatrixXd sandwich(const NormalEquations& equations, const Eigen::MatrixXd& cofactors) {
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(cofactors.rows(), cofactors.cols());
  for (const auto& frame : equations.frames) middle += frame.score * frame.score.transpose();
  const double f = static_cast<double>(equations.frames.size());
  return cofactors * middle * cofactors * (f / (f - 1));
}

}  // namespace bpms
