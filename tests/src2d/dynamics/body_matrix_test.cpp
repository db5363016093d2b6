/// The sparse matrix of the direct solver.

#include "src2d/dynamics/body_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace merge2d {
namespace {

using Dense = Eigen::Matrix<double, 9, 9>;

/// Jᵀ g J of a row between the bodies p and q, of three.
Dense rowOf(int p, const Eigen::Vector3d& j_p, int q, const Eigen::Vector3d& j_q, double g) {
  Eigen::Matrix<double, 1, 9> j = Eigen::Matrix<double, 1, 9>::Zero();
  j.segment<3>(3 * p) = j_p.transpose();
  j.segment<3>(3 * q) = j_q.transpose();
  return j.transpose() * g * j;
}

BodyMatrix::Vec vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

TEST(BodyMatrix, IsTheSumOfItsRows) {
  const Eigen::Vector3d a(1, 2, 3), b(-4, 0.5, 6), c(0.1, -0.7, 2);
  BodyMatrix m;
  m.share(0, 2), m.share(2, 1), m.share(0, 2);
  m.layOut(3);
  for (int filled = 0; filled < 2; ++filled) {  // a second time like the first
    m.clear();
    for (std::uint32_t body = 0; body < 3; ++body) m.add(body, {7, 8, 9});
    m.add(m.blockOf(0, 0), vec(a), vec(a), 2.0);
    m.add(m.blockOf(2, 2), vec(b), vec(b), 2.0);
    m.add(m.blockOf(0, 2), vec(b), vec(a), 2.0);
    m.add(m.blockOf(2, 2), vec(c), vec(c), 3.0);
    m.add(m.blockOf(1, 1), vec(a), vec(a), 3.0);
    m.add(m.blockOf(2, 1), vec(c), vec(a), 3.0);
    Dense wanted = rowOf(0, a, 2, b, 2.0) + rowOf(2, c, 1, a, 3.0);
    for (int body = 0; body < 3; ++body) {
      wanted.diagonal().segment<3>(3 * body) += Eigen::Vector3d(7, 8, 9);
    }
    const Eigen::Vector<double, 9> x = Eigen::Vector<double, 9>::LinSpaced(1.0, 9.0),
                                   h = wanted * x;
    std::vector<double> found(h.begin(), h.end());
    ASSERT_TRUE(m.factorize());
    m.solve(found);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(found[static_cast<std::size_t>(i)], x[i], 1e-12);
  }
}

}  // namespace
}  // namespace merge2d
