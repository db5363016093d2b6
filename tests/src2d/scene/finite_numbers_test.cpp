/// No number of a scene may be without end or none at all: in a file, and in a scene that a program
/// has built.

#include <algorithm>
#include <limits>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "src2d/scene/check.h"
#include "src2d/scene/settings_list.h"
#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

/// A scene with every key that takes a number; no other text in it has a digit that stands alone.
constexpr std::string_view kFullScene = R"(
gravity = [0, -9.81]
step = 0.01
duration = 10
seed = 7
[camera]
center = [0, 3]
height = 12.5
margin = 0.1
[solver]
iterations = 11
erp = 0.04
compliance = 0.008
max_correction = 0.4
margin = 0.004
restitution_velocity = 0.3
[merging]
velocity = 0.02
breathing = 2e-5
sliding = 0.03
steps = 4
[unmerging]
velocity = 0.05
sliding = 0.06
steps = 5
sweeps = 2
[sleeping]
velocity = 2e-5
steps = 6
time = 1.5
[material]
friction = 0.5
restitution = 0.1
rolling = 0.001
density = 2
[drawing]
pixel = 0.2
stiffness = 3
damping = 4
pinned_until = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -2]
polygon = [[-9, 0], [9, 0], [0, 1]]
surface_velocity = 1.5
[[body]]
name = "ball"
at = [0, 4]
angle = 20
velocity = [1, 2]
spin = 90
shapes = [{ box = [0.2, 2], at = [0, 1.1], angle = 5 }, { circle = 0.15, at = [0, -1] }]
mass = 3
friction = 0.4
restitution = 0.2
rolling = 0.002
pinned_until = 2
[[body]]
name = "brick"
at = [-3, 0.25]
box = [1, 0.5]
density = 2.5
repeat = { count = [2, 1], spacing = [1.02, 0.5], stagger = 0.4 }
[[body]]
name = "swing"
motion = "scripted"
at = [9, 1]
circle = 0.4
script = { axis = [1, 0], amplitude = 0.5, period = 4 }
[[body]]
name = "lift"
motion = "scripted"
box = [2, 0.3]
script = { keyframes = [[0, 14, 0.5, 0], [3, 14, 3, 15]] }
[[body]]
name = "mill"
motion = "scripted"
at = [-12, 3]
box = [3, 0.3]
script = { velocity = [1, 0], spin = 30 }
[[spring]]
body = "ball"
anchor = [0, 1.1]
to = [4, 6]
stiffness = 60
damping = 3
rest_length = 1
[[spring]]
body = "ball"
to_body = "brick[0,0]"
to_anchor = [0, 0.2]
stiffness = 5
[[impulse]]
body = "ball"
at = [0, 4]
impulse = [1, 0]
time = 1
[[force]]
body = "ball"
at = [0, 0]
force = [0, 3]
from = 3
until = 3.5
[[magnet]]
body = "lift"
on = [[0, 2], [4, 6]]
[[joint]]
kind = "revolute"
bodies = ["ball", "swing"]
at = [2, 4]
limits = [-60, 60]
motor = { speed = 10, torque = 5 }
compliance = 0.001
break_force = 500
[[joint]]
kind = "prismatic"
bodies = ["ball"]
at = [0, 4]
axis = [1, 0]
limits = [-1, 1]
motor = { speed = 0.5, force = 20 }
break_torque = 50
[[joint]]
kind = "distance"
bodies = ["ball", "brick[1,0]"]
at = [0, 4]
to = [-2, 0.25]
length = 4
stiffness = 100
damping = 2
[[joint]]
kind = "distance"
bodies = ["ball", "brick[0,0]"]
at = [0, 4]
to = [-3, 0.25]
limits = [0.5, 6]
[[emitter]]
name = "rain"
at = [0, 8]
spread = [2, 0]
circle = 0.2
every = 0.5
start = 4
count = 3
seed = 2
)";

/// The places of the numbers in a text: not of digits in names.
std::vector<std::pair<std::size_t, std::size_t>> numbersIn(const std::string& text) {
  static const std::regex kNumber(R"("[^"\n]*"|-?\d+(\.\d+)?(e-?\d+)?)");
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::sregex_iterator at(text.begin(), text.end(), kNumber), end; at != end; ++at) {
    if (at->str().front() == '"') continue;
    places.emplace_back(static_cast<std::size_t>(at->position()), at->str().size());
  }
  return places;
}

TEST(FiniteNumbers, EachNumberOfAFileIsRefusedWhereItIsNone) {
  const std::string text(kFullScene);
  ASSERT_EQ(errorOf(text), "no error");
  const auto places = numbersIn(text);
  ASSERT_GT(places.size(), 150u);
  for (const auto& [at, size] : places) {
    for (const std::string none : {"nan", "inf", "-inf"}) {
      std::string changed = text;
      changed.replace(at, size, none);
      const std::string error = firstLineOf(changed);
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
      EXPECT_THAT(error, testing::StartsWith(fmt::format("s.toml:{}:", line)));
      EXPECT_THAT(error, testing::EndsWith(fmt::format(", but is {}", none)));
    }
  }
}

/// Where the numbers of a scene stand.
class NumbersOf {
 public:
  explicit NumbersOf(Scene& scene) {
    take(scene.gravity, scene.step, scene.duration, scene.camera->center, scene.camera->height);
    take(scene.margin);
    forEachSetting(scene.settings, [&](auto, auto, auto& value, const Range&) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) take(value);
    });
    for (BodyDesc& body : scene.bodies) takeBody(body);
    for (JointDesc& joint : scene.joints) takeJoint(joint);
    takeActions(scene);
    for (EmitterDesc& emitter : scene.emitters) {
      takeBody(emitter.body);
      take(emitter.every, emitter.start, emitter.spread);
    }
  }

  std::vector<double*> all;
  std::vector<double*> endless;  ///< those of `all` that may be infinite

 private:
  void one(double& number) { all.push_back(&number); }
  void one(Vec2& vector) { take(vector.x(), vector.y()); }
  template <class... T>
  void take(T&... values) {
    (one(values), ...);
  }
  void takeEndless(double& number) {
    take(number);
    endless.push_back(&number);
  }

  void takeBody(BodyDesc& body) {
    take(body.at, body.angle, body.density, body.friction, body.restitution, body.rolling);
    take(body.surface_velocity);
    // Others have none of these, whatever the number.
    if (body.motion == Motion::Dynamic) take(body.velocity, body.spin, body.pinned_until);
    if (body.mass) take(*body.mass);
    for (ConvexShape& shape : body.shapes) {
      if (auto* circle = std::get_if<Circle>(&shape)) take(circle->center, circle->radius);
      if (auto* polygon = std::get_if<Polygon>(&shape)) {
        for (Vec2& corner : polygon->vertices) take(corner);
      }
    }
    if (body.script) takeScript(*body.script);
  }

  void takeScript(Script& script) {
    if (auto* s = std::get_if<Sinusoid>(&script)) take(s->axis, s->amplitude, s->period);
    if (auto* steady = std::get_if<SteadyMotion>(&script)) take(steady->velocity, steady->spin);
    if (auto* path = std::get_if<Keyframes>(&script)) {
      for (Keyframes::Key& key : path->keys) take(key.time, key.position, key.angle);
    }
  }

  void takeActions(Scene& scene) {
    for (SpringDesc& s : scene.springs) {
      take(s.anchor, s.to, s.stiffness, s.damping, s.rest_length);
    }
    for (ImpulseDesc& i : scene.impulses) take(i.at, i.impulse, i.time);
    for (ForceDesc& f : scene.forces) {
      take(f.at, f.force, f.from);
      takeEndless(f.until);
    }
    for (MagnetDesc& m : scene.magnets) {
      take(m.on.front().from);
      takeEndless(m.on.back().until);
    }
  }

  void takeJoint(JointDesc& joint) {
    take(joint.at, joint.compliance);
    takeEndless(joint.break_force);
    takeEndless(joint.break_torque);
    if (joint.limits) take(joint.limits->lower, joint.limits->upper);
    if (joint.motor) take(joint.motor->speed, joint.motor->strength);
    if (joint.kind == JointKind::Prismatic) take(joint.axis);
    if (joint.kind == JointKind::Distance) take(joint.to, joint.stiffness, joint.damping);
    if (joint.length) take(*joint.length);
  }
};

std::string complaintOf(const Scene& scene) {
  try {
    check(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(FiniteNumbers, EachNumberOfAScenesDescriptionIsRefusedWhereItIsNone) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  Scene scene = parseScene(kFullScene, "s.toml");
  ASSERT_EQ(complaintOf(scene), "no complaint");
  const NumbersOf numbers(scene);
  EXPECT_GT(numbers.all.size(), 150u);
  for (std::size_t i = 0; i < numbers.all.size(); ++i) {
    double& number = *numbers.all[i];
    const double sound = number;
    for (const double none : {kNoNumber, kForever, -kForever}) {
      if (none == kForever && std::ranges::count(numbers.endless, &number) > 0) continue;
      number = none;
      const std::string complaint = complaintOf(scene);
      EXPECT_THAT(complaint, HasSubstr(fmt::format("but is {}", none))) << "number " << i;
      EXPECT_THAT(complaint, testing::Not(HasSubstr("\n")));
    }
    number = sound;
  }
  EXPECT_EQ(complaintOf(scene), "no complaint");
}

}  // namespace
}  // namespace merge2d
