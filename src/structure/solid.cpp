#include "contact_path/structure/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "contact_path/scene/cell.h"

namespace contact_path {
namespace {

using Gradient = PlaneMaterial::Gradient;

template <int kNodes, std::size_t kPoints>
class SolidOf : public Element {
 public:
  SolidOf(const PlaneMaterial& material, double thickness, const std::vector<double>& positions) : material_(material) {
    const std::vector<PlacedPoint> points = PlacePoints(positions);
    for (std::size_t k = 0; k < kPoints; ++k) {
      points_[k].volume = points[k].area * thickness;
      for (std::size_t i = 0; i < kNodes; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          points_[k].gradients(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = points[k].gradients[i][j];
    }
  }

  const std::vector<LocalDof>& Dofs() const override {
    static const std::vector<LocalDof> dofs = PositionsOfNodes(kNodes);
    return dofs;
  }
  bool Linear() const override { return material_.Linear(); }

  double AreaRatio(const Values& x) const override {
    if (Linear()) return 1.0;
    double smallest = std::numeric_limits<double>::infinity();
    for (const Point& point : points_) {
      const Gradient F = point.Of(x);
      smallest = std::min(smallest, F[0] * F[3] - F[1] * F[2]);
    }
    return smallest;
  }

  // sigma dv = P F' dV (plane), J sigma33 dV across it; the linear law does not tell the volumes apart.
  SolidStress MeanStress(const Values& x) const override {
    using Plane = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;
    Plane sum = Plane::Zero();
    double across = 0.0, volume = 0.0;
    SolidStress stress;
    for (const Point& point : points_) {
      const Gradient F = point.Of(x), P = material_.Stress(F);
      const PlaneMaterial::Across at = material_.AcrossPlane(F);
      const Eigen::Map<const Plane> stresses(P.data()), gradient(F.data());
      sum += point.volume * (Linear() ? Plane(stresses) : Plane(stresses * gradient.transpose()));
      across += point.volume * at.stress;
      volume += point.volume * (Linear() ? 1.0 : (F[0] * F[3] - F[1] * F[2]) * std::sqrt(at.C33));
      stress.energy += point.volume * material_.Energy(F);
    }
    stress.sxx = sum(0, 0) / volume;
    stress.syy = sum(1, 1) / volume;
    stress.sxy = 0.5 * (sum(0, 1) + sum(1, 0)) / volume;
    stress.szz = across / volume;
    const double a = stress.sxx - stress.syy, b = stress.syy - stress.szz, c = stress.szz - stress.sxx;
    stress.mises = std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * stress.sxy * stress.sxy);
    return stress;
  }

  double Energy(const Values& x) const override {
    double energy = 0.0;
    for (const Point& point : points_) energy += point.volume * material_.Energy(point.Of(x));
    return energy;
  }

  void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    Forces sum = Forces::Zero();
    for (const Point& point : points_)
      sum += point.Derivatives().transpose() * (point.volume * material_.Stress(point.Of(x)));
    force = sum;
  }

  void Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    Square sum = Square::Zero();
    for (const Point& point : points_) point.Add(material_.Tangent(point.Of(x)), &sum);
    tangent = sum;
  }

  void TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    Square sum = Square::Zero();
    for (const Point& point : points_) point.Add(material_.TangentDerivative(point.Of(x), point.Of(v)), &sum);
    derivative = sum;
  }

 private:
  using Forces = Eigen::Matrix<double, 2 * kNodes, 1>;
  using Square = Eigen::Matrix<double, 2 * kNodes, 2 * kNodes>;

  // An integration point.
  struct Point {
    // F of the values x: of positions the deformation gradient, of a direction its rate. From the first node, so that
    // the distance from the origin costs no digits.
    Gradient Of(const Values& x) const {
      Gradient F = Gradient::Zero();
      for (int i = 1; i < kNodes; ++i)
        for (int k = 0; k < 2; ++k) F.template segment<2>(2 * k) += (x[2 * i + k] - x[k]) * gradients.col(i);
      return F;
    }
    // dF/dx.
    Eigen::Matrix<double, 4, 2 * kNodes> Derivatives() const {
      Eigen::Matrix<double, 4, 2 * kNodes> derivatives = Eigen::Matrix<double, 4, 2 * kNodes>::Zero();
      for (int i = 0; i < kNodes; ++i)
        for (int k = 0; k < 2; ++k) derivatives.template block<2, 1>(2 * k, 2 * i + k) = gradients.col(i);
      return derivatives;
    }
    // Adds volume (dF/dx)' A (dF/dx): one half of it, and its mirror image.
    void Add(const PlaneMaterial::Square& A, Square* sum) const {
      for (int j = 0; j < kNodes; ++j)
        for (int l = 0; l < 2; ++l) {
          const Gradient column = A.template middleCols<2>(2 * l) * (volume * gradients.col(j));
          const int last = 2 * j + l;
          for (int i = 0; i <= j; ++i)
            for (int k = 0; k < 2 && 2 * i + k <= last; ++k) {
              const double entry = gradients.col(i).dot(column.template segment<2>(2 * k));
              (*sum)(2 * i + k, last) += entry;
              if (2 * i + k < last) (*sum)(last, 2 * i + k) += entry;
            }
        }
    }

    double volume = 0.0;                         // initial area x thickness [length^3]
    Eigen::Matrix<double, 2, kNodes> gradients;  // of the shape functions, a column for each node [1/length]
  };

  PlaneMaterial material_;
  std::array<Point, kPoints> points_;
};

}  // namespace

std::unique_ptr<const Element> MakeSolidElement(const PlaneMaterial& material, double thickness,
                                                const std::vector<double>& positions) {
  switch (positions.size() / 2) {
    case 3: return std::make_unique<SolidOf<3, 1>>(material, thickness, positions);
    case 4: return std::make_unique<SolidOf<4, 4>>(material, thickness, positions);
    case 6: return std::make_unique<SolidOf<6, 3>>(material, thickness, positions);
    default: return std::make_unique<SolidOf<8, 4>>(material, thickness, positions);
  }
}

}  // namespace contact_path
