#include "contact_path/structure/even_strain.h"

#include <unsupported/Eigen/AutoDiff>
#include <utility>

#include "structure/span_numbers.h"

namespace contact_path {
namespace {

constexpr int kMost = 15;  // values
using Along = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
using Once = Eigen::AutoDiffScalar<Eigen::Matrix<Along, kMost, 1>>;
using Twice = Eigen::AutoDiffScalar<Eigen::Matrix<Once, kMost, 1>>;

}  // namespace

EvenStrain::EvenStrain(double stiffness, Piece before, Piece behind, int num_nodes, int num_bodies)
    : stiffness_(stiffness),
      before_(std::move(before)),
      behind_(std::move(behind)),
      first_body_(2 * static_cast<std::size_t>(num_nodes)),
      dofs_(PositionsOfNodes(num_nodes)) {
  for (int k = 0; k < num_bodies; ++k) dofs_.push_back({num_nodes + k, Field::kRotation, 0});
}

template <typename Number>
Number EvenStrain::EnergyOf(const std::vector<Number>& values) const {
  const auto ratio = [&](const Piece& piece) -> Number {
    const auto at = [&](std::size_t end, std::size_t axis) -> const Number& {
      return values[2 * static_cast<std::size_t>(piece.nodes[end]) + axis];
    };
    const Number dx = at(1, 0) - at(0, 0), dy = at(1, 1) - at(0, 1);
    Number rest = AsNumber<Number>(piece.rest);
    for (const Piece::Slide& slide : piece.slides) {
      const Number slid = values[2 * static_cast<std::size_t>(slide.node)] - AsNumber<Number>(slide.start);
      if (slide.sense > 0.0)
        rest += slid;
      else
        rest -= slid;
    }
    Number length = SpanNumbers<Number>(piece.rolled, dx, dy).length;
    if (piece.rolled.Arcs() != 0.0) length += AsNumber<Number>(piece.rolled.Arcs());
    for (const Piece::Drum& drum : piece.drums)
      length += values[first_body_ + static_cast<std::size_t>(drum.body)] * AsNumber<Number>(drum.by_turn);
    return length / rest;
  };
  const Number uneven = ratio(before_) - ratio(behind_);
  return AsNumber<Number>(0.5 * stiffness_) * Number(uneven * uneven);
}

void EvenStrain::Derive(const Values& x, const Values* v, Eigen::Ref<Eigen::MatrixXd> out) const {
  const auto size = static_cast<int>(x.size());
  std::vector<Twice> values;
  values.reserve(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) {
    Along along(x[i], Eigen::Matrix<double, 1, 1>::Constant(v != nullptr ? (*v)[i] : 0.0));
    values.emplace_back(Once(along, kMost, i), kMost, i);
  }
  const Twice energy = EnergyOf(values);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      const Along& entry = energy.derivatives()[i].derivatives()[j];
      out(i, j) = v != nullptr ? entry.derivatives()[0] : entry.value();
    }
}

double EvenStrain::Energy(const Values& x) const {
  return EnergyOf(std::vector<double>(x.data(), x.data() + x.size()));
}

void EvenStrain::Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const {
  using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, kMost, 1>>;
  const auto size = static_cast<int>(x.size());
  std::vector<Number> values;
  values.reserve(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) values.emplace_back(x[i], kMost, i);
  force = EnergyOf(values).derivatives().head(size);
}

void EvenStrain::Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const { Derive(x, nullptr, tangent); }

void EvenStrain::TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const {
  Derive(x, &v, derivative);
}

}  // namespace contact_path
