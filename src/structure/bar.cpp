#include "contact_path/structure/bar.h"

#include <cmath>

namespace contact_path {
namespace {

Eigen::Vector2d Span(const Element::Values& x) { return x.segment<2>(2) - x.segment<2>(0); }

// Blocks of a quantity that depends on the difference of the two nodes only.
void Scatter(const Eigen::Matrix2d& block, Eigen::Ref<Eigen::MatrixXd> out) {
  out.topLeftCorner<2, 2>() = block;
  out.bottomRightCorner<2, 2>() = block;
  out.topRightCorner<2, 2>() = -block;
  out.bottomLeftCorner<2, 2>() = -block;
}

}  // namespace

BarElement::BarElement(double EA, double rest_length, StrainMeasure strain, BarSense sense)
    : EA_(EA), rest_length_(rest_length), strain_(strain), sense_(sense) {}

bool BarElement::Slack(double length) const {
  return sense_ == BarSense::kTension ? length < rest_length_
                                      : sense_ == BarSense::kCompression && length > rest_length_;
}

const std::vector<LocalDof>& BarElement::Dofs() const {
  static const std::vector<LocalDof> dofs = PositionsOfNodes(2);
  return dofs;
}

double BarElement::Energy(const Values& x) const {
  const double length = Span(x).norm(), stretch = length / rest_length_;
  if (Slack(length)) return 0.0;
  double strain = 0.0;
  switch (strain_) {
    case StrainMeasure::kBiot: strain = stretch - 1.0; break;
    case StrainMeasure::kGreenLagrange: strain = 0.5 * (stretch - 1.0) * (stretch + 1.0); break;
    case StrainMeasure::kLogarithmic: strain = std::log(stretch); break;
  }
  return 0.5 * EA_ * rest_length_ * strain * strain;
}

BarElement::EnergyDerivatives BarElement::Derivatives(double q) const {
  const double l0 = rest_length_;
  const double l = std::sqrt(q);
  if (Slack(l)) return {0.0, 0.0, 0.0};
  switch (strain_) {
    case StrainMeasure::kBiot: {
      const double second = EA_ / (4.0 * q * l);
      return {EA_ / (2.0 * l0) * (l - l0) / l, second, -1.5 * second / q};
    }
    case StrainMeasure::kGreenLagrange: {
      const double strain = 0.5 * (l - l0) * (l + l0) / (l0 * l0);
      return {EA_ * strain / (2.0 * l0), EA_ / (4.0 * l0 * l0 * l0), 0.0};
    }
    case StrainMeasure::kLogarithmic: {
      const double strain = std::log(l / l0);
      const double scale = EA_ * l0 / (q * q);
      return {EA_ * l0 * strain / (2.0 * q), scale * (1.0 - 2.0 * strain) / 4.0,
              -scale * (3.0 - 4.0 * strain) / (4.0 * q)};
    }
  }
  return {};
}

void BarElement::Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const {
  const Eigen::Vector2d d = Span(x);
  const Eigen::Vector2d pull = 2.0 * Derivatives(d.squaredNorm()).first * d;
  force.segment<2>(0) = -pull;
  force.segment<2>(2) = pull;
}

void BarElement::Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const Eigen::Vector2d d = Span(x);
  const EnergyDerivatives w = Derivatives(d.squaredNorm());
  Scatter(2.0 * w.first * Eigen::Matrix2d::Identity() + 4.0 * w.second * d * d.transpose(), tangent);
}

void BarElement::TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const {
  const Eigen::Vector2d d = Span(x);
  const Eigen::Vector2d e = Span(v);
  const double along = d.dot(e);
  const EnergyDerivatives w = Derivatives(d.squaredNorm());
  Scatter(4.0 * w.second * (along * Eigen::Matrix2d::Identity() + e * d.transpose() + d * e.transpose()) +
              8.0 * w.third * along * d * d.transpose(),
          derivative);
}

}  // namespace contact_path
