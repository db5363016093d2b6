/// Random billiard shots beside their closed form: straight ways from hit to hit, each by Newton's
/// law. A hit magnifies an error by up to the way to it over the radius, so that a fault of a few
/// micrometres is seen within seconds.

#include <gtest/gtest.h>

#include <random>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

constexpr double kRadius = 0.03, kWidth = 2.0, kDepth = 1.0, kBounce = 0.95;

struct Ball {
  Vec2 x, v = Vec2::Zero();
};

/// When a ball meets a cushion along an axis, or never.
double timeToCushion(const Ball& ball, int axis) {
  const double v = ball.v[axis], far = (axis == 0 ? kWidth : kDepth) - kRadius;
  if (v == 0.0) return 1e300;
  return ((v > 0.0 ? far : kRadius) - ball.x[axis]) / v;
}

double timeToMeet(const Ball& a, const Ball& b) {
  const Vec2 d = b.x - a.x, v = b.v - a.v;
  const double closing = -d.dot(v), left = d.squaredNorm() - 4.0 * kRadius * kRadius;
  const double root = closing * closing - v.squaredNorm() * left;
  return closing <= 0.0 || root < 0.0 ? 1e300 : left / (closing + std::sqrt(root));
}

void hit(Ball& a, Ball& b) {
  const Vec2 n = (b.x - a.x).normalized();
  const Vec2 given = 0.5 * (1.0 + kBounce) * n.dot(a.v - b.v) * n;
  a.v -= given;
  b.v += given;
}

/// The balls after some seconds.
std::vector<Ball> played(std::vector<Ball> balls, double seconds) {
  for (double now = 0.0; now < seconds;) {
    double next = seconds - now;
    std::size_t first = 0, second = 0;
    int axis = -1;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      for (const int k : {0, 1}) {
        const double t = timeToCushion(balls[i], k);
        if (t < next) next = t, first = i, second = i, axis = k;
      }
      for (std::size_t j = 0; j < i; ++j) {
        const double t = timeToMeet(balls[i], balls[j]);
        if (t < next) next = t, first = i, second = j, axis = -1;
      }
    }
    for (Ball& ball : balls) ball.x += next * ball.v;
    now += next;
    if (first != second) {
      hit(balls[first], balls[second]);
    } else if (axis >= 0) {
      balls[first].v[axis] *= -kBounce;
    }
  }
  return balls;
}

/// Two to five balls at random places, of which the first moves.
std::vector<Ball> randomShot(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const auto count = static_cast<std::size_t>(between(2.0, 6.0));
  std::vector<Ball> balls;
  while (balls.size() < count) {
    const Vec2 x(between(0.04, kWidth - 0.04), between(0.04, kDepth - 0.04));
    const auto apart = [&](const Ball& ball) { return (ball.x - x).norm() > 0.065; };
    if (std::ranges::all_of(balls, apart)) balls.push_back({x});
  }
  const double speed = between(1.0, 4.0), angle = between(0.0, 2.0 * std::numbers::pi);
  balls[0].v = speed * Vec2(std::cos(angle), std::sin(angle));
  return balls;
}

Scene tableWith(const std::vector<Ball>& balls) {
  Scene scene = noGravity();
  scene.settings.material.friction = 0.0;
  const auto put = [&](BodyDesc body) {
    body.friction = 0.0;
    body.restitution = kBounce;
    add(scene, body);
  };
  for (const Ball& ball : balls) put(moving(disc(kRadius, ball.x), ball.v));
  put(pinned(box(1, kDepth + 2, {-0.5, 0.5 * kDepth})));
  put(pinned(box(1, kDepth + 2, {kWidth + 0.5, 0.5 * kDepth})));
  put(pinned(box(kWidth, 1, {0.5 * kWidth, -0.5})));
  put(pinned(box(kWidth, 1, {0.5 * kWidth, kDepth + 0.5})));
  return scene;
}

TEST(Billiards, RandomShotsGoAsTheirClosedFormSays) {
  std::mt19937 random(1);
  for (int shot = 0; shot < 100; ++shot) {
    const std::vector<Ball> balls = randomShot(random), end = played(balls, 1.5);
    SCOPED_TRACE(shot);
    inAllModesAndSteps(tableWith(balls), [&](World& world) {
      runSeconds(world, 1.5);
      for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec2 x = see(world, BodyId{static_cast<std::uint32_t>(i)}).x;
        EXPECT_LT((x - end[i].x).norm(), 1e-3) << "ball " << i;
      }
    });
  }
}

}  // namespace
}  // namespace merge2d
