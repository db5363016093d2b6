// merge2d._merge2d: scenes, worlds and shapes for Python, over the public C++ interface. Parts that
// need no speed are in python/merge2d/*.py.

#include <merge2d/merge2d.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

namespace py = pybind11;

namespace {

using merge2d::Body;
using merge2d::Vec2;

/// A place, a velocity or another pair of numbers.
struct Pair {
  double first, second;
};
/// A number, a whole number, a text, a switch: the plain type of an argument.
template <class T>
struct Plain {
  T value;
  operator T() const { return value; }  // it stands for a T
};
using Real = Plain<double>;
using Whole = Plain<std::int64_t>;
using Text = Plain<std::string>;
using Flag = Plain<bool>;
/// (x, y, visible height), or nothing: the camera of the scene.
struct CameraArg {
  std::optional<std::tuple<double, double, double>> value;
};
/// A body by its number or its name.
struct BodyArg {
  std::int64_t number;
  std::optional<std::string> name;
};

/// An object as a message shows it.
std::string shown(const py::handle& object) {
  constexpr std::size_t kLongest = 60;
  std::string text = py::repr(object);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

/// The number, or nothing for an object that is none.
std::optional<double> numberOf(const py::handle& object) {
  const double number = PyFloat_AsDouble(object.ptr());
  if (number != -1.0 || PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  return std::nullopt;
}

Pair pairOf(const py::handle& object, const std::string& what) {
  if (PySequence_Check(object.ptr()) != 0 && PySequence_Size(object.ptr()) == 2) {
    const auto sequence = py::reinterpret_borrow<py::sequence>(object);
    const auto first = numberOf(sequence[0]), second = numberOf(sequence[1]);
    if (first && second) return {*first, *second};
  }
  PyErr_Clear();  // of an object whose size cannot be told
  throw py::type_error(what + " must be a pair of numbers, not " + shown(object));
}

BodyArg bodyArgOf(const py::handle& object) {
  if (py::isinstance<py::str>(object)) return {0, py::cast<std::string>(object)};
  if (PyIndex_Check(object.ptr()) != 0 && !py::isinstance<py::bool_>(object)) {
    const py::ssize_t number = PyNumber_AsSsize_t(object.ptr(), nullptr);
    if (PyErr_Occurred() == nullptr) return {number, std::nullopt};
    PyErr_Clear();
  }
  throw py::type_error("a body goes by its number or its name, not by " + shown(object));
}

/// A whole number, or nothing; one of more than 64 bits is an error.
std::optional<std::int64_t> wholeOf(const py::handle& object) {
  if (PyIndex_Check(object.ptr()) == 0) return std::nullopt;
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
  if (!number) return PyErr_Clear(), std::nullopt;
  int overflow = 0;
  const std::int64_t value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0) throw py::value_error("the number " + shown(object) + " is too large");
  return value;
}

template <class T>
constexpr const char* kKindOf = "key frames, each (time, x, y, angle)";
template <>
constexpr const char* kKindOf<double> = "a number";
template <>
constexpr const char* kKindOf<std::int64_t> = "a whole number";
template <>
constexpr const char* kKindOf<std::string> = "a text";
template <>
constexpr const char* kKindOf<bool> = "True or False";

/// What an object is as a T, or nothing for an object of another kind.
template <class T>
std::optional<T> plainOf(const py::handle& object) {
  if constexpr (std::is_same_v<T, double>) {
    return numberOf(object);
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return wholeOf(object);
  } else if constexpr (std::is_same_v<T, bool>) {
    try {
      return py::cast<bool>(object);
    } catch (const py::cast_error&) {
      return std::nullopt;
    }
  } else {
    if (!py::isinstance<py::str>(object)) return std::nullopt;
    return py::cast<std::string>(object);
  }
}

CameraArg cameraArgOf(const py::handle& object) {
  if (object.is_none()) return {};
  try {
    return {py::cast<std::tuple<double, double, double>>(object)};
  } catch (const py::cast_error&) {
    throw py::type_error("a camera is (x, y, visible height), not " + shown(object));
  }
}

}  // namespace

/// Arguments of these types are refused in words that name no C++ types.
namespace pybind11::detail {

template <>
struct type_caster<Pair> {
  PYBIND11_TYPE_CASTER(Pair, const_name("Tuple[float, float]"));
  bool load(handle object, bool) {
    value = pairOf(object, "a place, a velocity or a force");
    return true;
  }
  static handle cast(const Pair& pair, return_value_policy, handle) {
    return make_tuple(pair.first, pair.second).release();
  }
};

template <class T>
struct type_caster<Plain<T>> {
  PYBIND11_TYPE_CASTER(Plain<T>, make_caster<T>::name);
  bool load(handle object, bool) {
    std::optional<T> plain = plainOf<T>(object);
    if (!plain) {
      throw type_error(std::string(kKindOf<T>) + " is needed, not " + shown(object));
    }
    value.value = *std::move(plain);
    return true;
  }
};

template <>
struct type_caster<CameraArg> {
  PYBIND11_TYPE_CASTER(CameraArg, const_name("Optional[Tuple[float, float, float]]"));
  bool load(handle object, bool) {
    value = cameraArgOf(object);
    return true;
  }
};

template <>
struct type_caster<BodyArg> {
  PYBIND11_TYPE_CASTER(BodyArg, const_name("Union[int, str]"));
  bool load(handle object, bool) {
    value = bodyArgOf(object);
    return true;
  }
};

}  // namespace pybind11::detail

namespace {

Vec2 vec(const Pair& p) { return {p.first, p.second}; }

/// Memory that is zero at first. pybind11 hands an object to its methods also where its constructor
/// threw; one of zeros owns nothing and refuses calls, as one that was moved from does.
struct ZeroedAtFirst {
  static void* operator new(std::size_t size) {
    void* memory = std::calloc(1, size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  }
  static void operator delete(void* memory) { std::free(memory); }
};

class PyScene : public ZeroedAtFirst, public merge2d::Scene {
 public:
  PyScene() = default;
  PyScene(merge2d::Scene&& scene) : Scene(std::move(scene)) {}
  PyScene(const PyScene& other) : ZeroedAtFirst(), Scene(other.made()) {}

 private:
  const Scene& made() const {
    if (get() == nullptr) throw merge2d::InputError("this scene was not made");
    return *this;
  }
};

/// A world, and who uses it: Python's lock is not held while it steps.
class PyWorld : public ZeroedAtFirst {
 public:
  PyWorld(const merge2d::Scene& scene, merge2d::Mode mode) : world_(scene, mode) {}

  /// Holds a world that nobody else uses. Throws RuntimeError where another thread does.
  class Use {
   public:
    explicit Use(PyWorld& of) : of_(of) {
      if (of_.busy_.test_and_set(std::memory_order_acquire)) {
        throw std::runtime_error("this world is in use by another thread");
      }
    }
    ~Use() { of_.busy_.clear(std::memory_order_release); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    merge2d::World* operator->() const { return &of_.world_; }
    merge2d::World& operator*() const { return of_.world_; }

   private:
    PyWorld& of_;
  };

 private:
  merge2d::World world_;
  std::atomic_flag busy_;
};

using Use = PyWorld::Use;

/// A body of a world or a scene.
template <class Home>
Body bodyOf(const Home& home, const BodyArg& body) {
  if (body.name) return home.find(*body.name);
  const auto count = static_cast<std::int64_t>(home.bodyCount());
  if (body.number >= 0 && body.number < count) return static_cast<Body>(body.number);
  constexpr bool kIsWorld = std::is_same_v<Home, merge2d::World>;
  throw py::index_error("there is no body " + std::to_string(body.number) + ": the " +
                        (kIsWorld ? "world" : "scene") + " has " + std::to_string(count));
}

/// Many steps at once, such that Ctrl-C is heard.
void stepMany(merge2d::World& world, std::int64_t count) {
  using Clock = std::chrono::steady_clock;
  using namespace std::chrono_literals;
  std::int64_t some = 1;
  while (count > 0) {
    some = std::min(some, count);
    const Clock::time_point begin = Clock::now();
    world.step(static_cast<std::uint64_t>(some));
    count -= some;
    const auto took = Clock::now() - begin;
    if (took < 5ms) some *= 2;
    if (took > 50ms) some = std::max<std::int64_t>(1, some / 2);
    if (took < 5ms) continue;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void step(PyWorld& self, Whole steps) {
  const std::int64_t count = steps;
  if (count < 0) throw py::value_error("the number of steps must be 0 or more");
  const Use world(self);
  const py::gil_scoped_release unlocked;
  if (count == 1) return world->step();
  stepMany(*world, count);
}

/// A read-only array over memory of the world, which lives as long as the array.
template <class T>
py::array view(const py::object& owner, const T* first, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides) {
  py::array_t<T> array(std::move(shape), std::move(strides), first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

enum class Part { Vectors, Angles };

py::array rows(const py::object& self, bool velocities, Part part) {
  const Use world(self.cast<PyWorld&>());
  const double* first = velocities ? world->velocities().data() : world->poses().data();
  const auto count = static_cast<py::ssize_t>(world->bodyCount());
  constexpr py::ssize_t kNumber = sizeof(double);
  if (part == Part::Vectors) return view(self, first, {count, 2}, {3 * kNumber, kNumber});
  return view(self, first + 2, {count}, {3 * kNumber});
}

py::array collectionIds(const py::object& self) {
  const Use world(self.cast<PyWorld&>());
  const auto ids = world->collectionIds();
  return view(self, ids.data(), {static_cast<py::ssize_t>(ids.size())}, {sizeof(std::int32_t)});
}

template <class T>
py::array copy(std::span<const T> list) {
  return py::array_t<T>(static_cast<py::ssize_t>(list.size()), list.data());
}

/// The collections, and the bodies of all of them.
py::tuple collectionArray(PyWorld& self) {
  const Use world(self);
  const m2_collection* first = nullptr;
  const Body* members = nullptr;
  std::size_t count = 0;
  merge2d::detail::check(m2_world_collections(world->get(), &first, &count, &members));
  const std::size_t bodies = count == 0 ? 0 : first[count - 1].first + first[count - 1].count;
  return py::make_tuple(copy(std::span(first, count)), copy(std::span(members, bodies)));
}

py::dict counts(PyWorld& self) {
  const merge2d::Counts c = Use(self)->counts();
  return py::dict(py::arg("bodies") = c.bodies, py::arg("active_bodies") = c.active_bodies,
                  py::arg("collections") = c.collections, py::arg("asleep") = c.asleep,
                  py::arg("contacts") = c.contacts,
                  py::arg("internal_contacts") = c.internal_contacts);
}

py::dict sums(PyWorld& self) {
  const merge2d::Sums s = Use(self)->sums();
  return py::dict(py::arg("residual") = s.residual, py::arg("max_penetration") = s.max_penetration,
                  py::arg("kinetic_energy") = s.kinetic_energy,
                  py::arg("potential_energy") = s.potential_energy,
                  py::arg("momentum") = py::make_tuple(s.momentum_x, s.momentum_y),
                  py::arg("angular_momentum") = s.angular_momentum);
}

py::array found(const std::vector<Body>& bodies) { return copy(std::span<const Body>(bodies)); }

py::object castRay(PyWorld& self, const Pair& from, const Pair& to) {
  const auto hit = Use(self)->castRay(vec(from), vec(to));
  if (!hit) return py::none();
  return py::dict(py::arg("body") = hit->body, py::arg("collection") = hit->collection,
                  py::arg("fraction") = hit->fraction,
                  py::arg("point") = py::make_tuple(hit->point.x, hit->point.y),
                  py::arg("normal") = py::make_tuple(hit->normal.x, hit->normal.y));
}

/// Convex pieces of a body about its centre of mass: arrays of vertices, or (x, y, radius).
py::list pieces(PyWorld& self, const BodyArg& body) {
  const Use world(self);
  py::list out;
  for (const merge2d::Piece& piece : world->pieces(bodyOf(*world, body))) {
    if (piece.vertex_count == 0) {
      out.append(py::make_tuple(piece.center.x, piece.center.y, piece.radius));
      continue;
    }
    py::array_t<double> vertices({static_cast<py::ssize_t>(piece.vertex_count), py::ssize_t{2}});
    for (std::size_t i = 0; i < piece.vertex_count; ++i) {
      vertices.mutable_at(static_cast<py::ssize_t>(i), 0) = piece.vertices[i].x;
      vertices.mutable_at(static_cast<py::ssize_t>(i), 1) = piece.vertices[i].y;
    }
    out.append(vertices);
  }
  return out;
}

struct PictureArgs {
  int width, height;
  std::string overlays, theme;
  bool transparent;
  std::optional<std::tuple<double, double, double>> camera;

  merge2d::PictureDef def() const {
    merge2d::PictureDef def = merge2d::pictureDef();
    def.width = width;
    def.height = height;
    def.overlays = overlays.c_str();
    def.theme = theme.c_str();
    def.transparent = transparent;
    def.has_camera = camera.has_value();
    if (camera) std::tie(def.camera_center.x, def.camera_center.y, def.camera_height) = *camera;
    return def;
  }
};

py::array render(PyWorld& self, const PictureArgs& args) {
  const Use world(self);
  const std::vector<std::uint8_t> rgba = world->draw(args.def());
  py::array_t<std::uint8_t> picture({args.height, args.width, 4});
  std::copy(rgba.begin(), rgba.end(), picture.mutable_data());
  return picture;
}

merge2d::Mode modeOf(const std::string& name) {
  m2_mode mode{};
  merge2d::detail::check(m2_mode_from_name(name.c_str(), &mode));
  return static_cast<merge2d::Mode>(mode);
}

/// An argument of a function that takes many; TypeError names it.
template <class T>
T argument(const py::dict& args, const char* name) {
  const py::object object = args[name];
  if constexpr (std::is_same_v<T, Pair>) {
    return pairOf(object, "'" + std::string(name) + "'");
  } else {
    try {
      return py::cast<T>(object);
    } catch (const py::cast_error&) {
      throw py::type_error("'" + std::string(name) + "' must be " + kKindOf<T> + ", not " +
                           shown(object));
    }
  }
}

m2_script scriptOf(const py::dict& script) {
  m2_script out = m2_body_def_default().script;
  const std::string kind = argument<std::string>(script, "kind");
  out.kind = kind == "steady" ? M2_STEADY : M2_SINUSOID;
  if (kind == "steady") {
    out.velocity = vec(argument<Pair>(script, "velocity"));
    out.spin = argument<double>(script, "spin");
  } else {
    out.axis = vec(argument<Pair>(script, "axis"));
    out.amplitude = argument<double>(script, "amplitude");
    out.period = argument<double>(script, "period");
  }
  return out;
}

merge2d::Motion motionOf(const std::string& name) {
  if (name == "dynamic") return merge2d::Motion::Dynamic;
  if (name == "pinned") return merge2d::Motion::Pinned;
  if (name == "scripted") return merge2d::Motion::Scripted;
  throw merge2d::InputError("there is no motion '" + name +
                            "': the motions are dynamic, pinned, scripted");
}

/// From the keyword arguments of add_body, whose defaults python/merge2d/__init__.py gives.
template <class Add>
Body addBodyTo(const py::dict& args, Add&& add) {
  merge2d::BodyDef def;
  std::vector<m2_key> keys;
  def.name = argument<std::string>(args, "name");
  def.motion = motionOf(argument<std::string>(args, "motion"));
  def.position = vec(argument<Pair>(args, "at"));
  def.angle = argument<double>(args, "angle");
  def.velocity = vec(argument<Pair>(args, "velocity"));
  def.spin = argument<double>(args, "spin");
  def.shapes = py::cast<std::vector<merge2d::Shape>>(args["shapes"]);
  def.mass = argument<double>(args, "mass");
  def.density = argument<double>(args, "density");
  def.friction = argument<double>(args, "friction");
  def.restitution = argument<double>(args, "restitution");
  def.rolling = argument<double>(args, "rolling");
  def.surface_velocity = argument<double>(args, "surface_velocity");
  def.pinned_until = argument<double>(args, "pinned_until");
  if (const py::object script = args["script"]; !script.is_none()) {
    if (argument<std::string>(script, "kind") == "keyframes") {
      for (const auto& [t, x, y, angle] :
           argument<std::vector<std::tuple<double, double, double, double>>>(script, "keyframes")) {
        keys.push_back({t, {x, y}, angle});
      }
      def.script.kind = M2_KEYFRAMES;
      def.script.keys = keys.data();
      def.script.key_count = keys.size();
    } else {
      def.script = scriptOf(script);
    }
  }
  return add(def);
}

template <class To>
Body addBody(To& to, const py::dict& args) {
  return addBodyTo(args, [&](const merge2d::BodyDef& def) { return to.add(def); });
}

/// Adds a spring to a scene or a world.
template <class Home>
merge2d::Spring addSpring(Home& home, const BodyArg& body, const Pair& anchor, const Pair& to,
                          const std::optional<BodyArg>& to_body, Real stiffness, Real damping,
                          Real rest_length) {
  merge2d::SpringDef def = merge2d::springDef();
  def.body = bodyOf(home, body);
  def.anchor = vec(anchor);
  def.to = vec(to);
  if (to_body) def.to_body = bodyOf(home, *to_body);
  def.stiffness = stiffness;
  def.damping = damping;
  def.rest_length = rest_length;
  return home.add(def);
}

/// From the keyword arguments of add_joint, for a scene or a world.
template <class Home>
merge2d::JointDef jointDef(const Home& home, const py::dict& args) {
  static constexpr const char* kKinds[] = {"revolute", "weld", "distance", "prismatic"};
  merge2d::JointDef def = merge2d::jointDef();
  const std::string kind = argument<std::string>(args, "kind");
  const auto* found = std::find(std::begin(kKinds), std::end(kKinds), kind);
  if (found == std::end(kKinds)) {
    throw merge2d::InputError("there is no kind of joint '" + kind +
                              "': the kinds are revolute, weld, distance, prismatic");
  }
  def.kind = static_cast<m2_joint_kind>(found - std::begin(kKinds));
  def.a = bodyOf(home, bodyArgOf(args["a"]));
  if (!args["b"].is_none()) def.b = bodyOf(home, bodyArgOf(args["b"]));
  def.at = vec(argument<Pair>(args, "at"));
  def.to = vec(argument<Pair>(args, "to"));
  def.axis = vec(argument<Pair>(args, "axis"));
  def.length = argument<double>(args, "length");
  def.stiffness = argument<double>(args, "stiffness");
  def.damping = argument<double>(args, "damping");
  if (!args["limits"].is_none()) {
    def.limited = true;
    const Pair limits = argument<Pair>(args, "limits");
    def.lower = limits.first;
    def.upper = limits.second;
  }
  if (!args["motor"].is_none()) {
    def.motor = true;
    const Pair motor = argument<Pair>(args, "motor");
    def.motor_speed = motor.first;
    def.motor_strength = motor.second;
  }
  def.compliance = argument<double>(args, "compliance");
  def.break_force = argument<double>(args, "break_force");
  def.break_torque = argument<double>(args, "break_torque");
  def.collide = argument<bool>(args, "collide");
  return def;
}

/// A change of one body of a world.
template <class Do>
void change(PyWorld& self, const BodyArg& body, Do&& work) {
  const Use world(self);
  work(*world, bodyOf(*world, body));
}

/// An argument that is a number of a smaller range.
template <class T>
T within(std::int64_t number, const char* name) {
  if (std::in_range<T>(number)) return static_cast<T>(number);
  throw py::value_error(std::string("'") + name + "' must be 0 or more" +
                        (number < 0 ? "" : " and not so large") + ", not " +
                        std::to_string(number));
}

/// The number of a spring or a joint.
std::uint32_t numberFrom(const Whole& number) {
  if (std::in_range<std::uint32_t>(number.value)) return static_cast<std::uint32_t>(number.value);
  throw py::index_error("there is no number " + std::to_string(number.value));
}

/// The library refuses sizes that no picture has.
int pixels(const Whole& number) {
  constexpr std::int64_t kMany = 1'000'000;
  return static_cast<int>(std::clamp(number.value, -kMany, kMany));
}

void bindShapes(py::module_& m) {
  py::class_<merge2d::Shape>(m, "Shape").def("__repr__", [](const merge2d::Shape& shape) {
    static constexpr const char* kKinds[] = {"circle", "box", "polygon"};
    return std::string("<merge2d.Shape: ") + kKinds[shape.get().kind] + ">";
  });
  m.def(
      "circle",
      [](Real radius, const Pair& center) { return merge2d::Shape::circle(radius, vec(center)); },
      py::arg("radius"), py::arg("center"));
  m.def(
      "box",
      [](Real width, Real height, const Pair& center, Real angle) {
        return merge2d::Shape::box(width, height, vec(center), angle);
      },
      py::arg("width"), py::arg("height"), py::arg("center"), py::arg("angle"));
  m.def("polygon", [](const std::vector<Pair>& outline) {
    std::vector<Vec2> vertices;
    for (const Pair& p : outline) vertices.push_back(vec(p));
    return merge2d::Shape::polygon(std::move(vertices));
  });
}

void bindScene(py::module_& m) {
  using Scene = PyScene;
  py::class_<Scene>(m, "Scene")
      .def(py::init<>())
      .def(py::init<const Scene&>())
      .def_static("_load",
                  [](const std::string& name_or_path, const std::vector<std::string>& changes) {
                    return Scene(merge2d::Scene::load(name_or_path, changes));
                  })
      .def_static(
          "_parse",
          [](const Text& text, const Text& source, const std::vector<std::string>& changes) {
            return Scene(merge2d::Scene::parse(text.value, source, changes));
          })
      .def("set", [](Scene& s, const Text& key, const Text& value) { s.set(key, value); })
      .def("get", [](const Scene& s, const Text& key) { return s.get(key); })
      .def("add_body", &addBody<Scene>)
      .def("add_spring", &addSpring<Scene>)
      .def("add_joint", [](Scene& s, const py::dict& args) { return s.add(jointDef(s, args)); })
      .def("add_impulse",
           [](Scene& s, const BodyArg& body, const Pair& at, const Pair& impulse, Real time) {
             s.addImpulse(bodyOf(s, body), vec(at), vec(impulse), time);
           })
      .def("add_force",
           [](Scene& s, const BodyArg& body, const Pair& at, const Pair& force, Real from,
              Real until) { s.addForce(bodyOf(s, body), vec(at), vec(force), from, until); })
      .def("add_magnet", [](Scene& s, const BodyArg& body, Real from,
                            Real until) { s.addMagnet(bodyOf(s, body), from, until); })
      .def("add_emitter",
           [](Scene& s, const py::dict& args, Real every, Whole count, Real start,
              const Pair& spread, Whole seed) {
             addBodyTo(args, [&](const merge2d::BodyDef& def) {
               s.addEmitter(def, every, within<std::uint32_t>(count, "count"), start, vec(spread),
                            within<std::uint64_t>(seed, "seed"));
               return Body{0};
             });
           })
      .def(
          "set_camera",
          [](Scene& s, const Pair& center, Real height) { s.setCamera(vec(center), height); },
          py::arg("center"), py::arg("height"),
          "The view of pictures: `height` metres about `center` [m].")
      .def(
          "follow",
          [](Scene& s, const std::optional<BodyArg>& body) {
            s.follow(body ? bodyOf(s, *body) : M2_NO_BODY);
          },
          py::arg("body"), "The view moves with a body, by its number or name; None stops that.")
      .def(
          "body", [](const Scene& s, const BodyArg& body) { return bodyOf(s, body); },
          py::arg("body"), "The number of a body by its name; InputError suggests another.")
      .def("_body_count", &Scene::bodyCount)
      .def("to_toml", &Scene::toToml)
      .def("warnings", &Scene::warnings)
      .def("page", [](const Scene& s, const Text& mode, Flag live) {
        const merge2d::Mode m2 = modeOf(mode);
        const py::gil_scoped_release unlocked;
        return merge2d::scenePage(s, m2, live);
      });
}

void bindTime(py::class_<PyWorld>& c) {
  c.def(py::init([](const PyScene& scene, const Text& mode) {
     return std::make_unique<PyWorld>(scene, modeOf(mode));
   }))
      .def("step", &step, py::arg("count") = 1,
           "Takes `count` time steps. Python's lock is not held, and Ctrl-C is "
           "heard.\nSimulationError when a number stops being finite.")
      .def("steps", [](PyWorld& w) { return Use(w)->steps(); })
      .def("time", [](PyWorld& w) { return Use(w)->time(); })
      .def("time_step", [](PyWorld& w) { return Use(w)->timeStep(); })
      .def(
          "_set_time_step", [](PyWorld& w, Real h) { Use(w)->setTimeStep(h); }, py::arg("h"))
      .def("mode", [](PyWorld& w) { return m2_mode_name(static_cast<m2_mode>(Use(w)->mode())); })
      .def("_set_mode", [](PyWorld& w, const Text& mode) { Use(w)->setMode(modeOf(mode)); })
      .def("gravity",
           [](PyWorld& w) {
             const Vec2 g = Use(w)->gravity();
             return Pair(g.x, g.y);
           })
      .def("_set_gravity", [](PyWorld& w, const Pair& g) { Use(w)->setGravity(vec(g)); })
      .def("set", [](PyWorld& w, const Text& k, const Text& v) { Use(w)->set(k, v); })
      .def("get", [](PyWorld& w, const Text& key) { return Use(w)->get(key); })
      .def("save", [](PyWorld& w) { return py::bytes(Use(w)->save()); })
      .def(
          "restore",
          [](PyWorld& w, const py::object& state, Flag other_settings) {
            if (!py::isinstance<py::bytes>(state)) {
              throw py::type_error("a saved state is bytes, not " + shown(state));
            }
            Use(w)->restore(std::string_view(py::bytes(state)), other_settings);
          },
          py::arg("state"), py::arg("other_settings"));
}

void bindChanges(py::class_<PyWorld>& c) {
  using merge2d::World;
  c.def("add_body",
        [](PyWorld& w, const py::dict& args) {
          const Use world(w);
          return addBody(*world, args);
        })
      .def("add_spring",
           [](PyWorld& w, const BodyArg& body, const Pair& anchor, const Pair& to,
              const std::optional<BodyArg>& to_body, Real stiffness, Real damping,
              Real rest_length) {
             const Use world(w);
             return addSpring(*world, body, anchor, to, to_body, stiffness, damping, rest_length);
           })
      .def("add_joint",
           [](PyWorld& w, const py::dict& args) {
             const Use world(w);
             return world->add(jointDef(*world, args));
           })
      .def(
          "remove_body",
          [](PyWorld& w, const BodyArg& b) {
            change(w, b, [](World& world, Body body) { world.removeBody(body); });
          },
          py::arg("body"), "Removes a body with its joints and springs.")
      .def(
          "remove_spring", [](PyWorld& w, Whole s) { Use(w)->removeSpring(numberFrom(s)); },
          py::arg("spring"), "Removes a spring by its number.")
      .def(
          "remove_joint", [](PyWorld& w, Whole j) { Use(w)->removeJoint(numberFrom(j)); },
          py::arg("joint"), "Removes a joint by its number.")
      .def(
          "move_spring",
          [](PyWorld& w, Whole s, const Pair& to) { Use(w)->moveSpring(numberFrom(s), vec(to)); },
          py::arg("spring"), py::arg("to"),
          "Moves the end of a spring that holds to the world [m].")
      .def(
          "drag",
          [](PyWorld& w, const BodyArg& b, const Pair& grip) {
            const Use world(w);
            return world->drag(bodyOf(*world, b), vec(grip));
          },
          py::arg("body"), py::arg("grip"),
          "A spring that drags a body by its point at `grip` [m], critically damped; its number. "
          "Move it\nwith `move_spring`, let go with `remove_spring`.")
      .def(
          "apply_impulse",
          [](PyWorld& w, const BodyArg& b, const Pair& at, const Pair& impulse) {
            change(w, b, [&](World& world, Body body) {
              world.applyImpulse(body, vec(at), vec(impulse));
            });
          },
          py::arg("body"), py::arg("at"), py::arg("impulse"),
          "An impulse [N s] at a world point [m], at the start of the next step.")
      .def(
          "apply_force",
          [](PyWorld& w, const BodyArg& b, const Pair& at, const Pair& force) {
            change(w, b,
                   [&](World& world, Body body) { world.applyForce(body, vec(at), vec(force)); });
          },
          py::arg("body"), py::arg("at"), py::arg("force"),
          "A force [N] at a world point [m], during the next step.")
      .def(
          "set_pose",
          [](PyWorld& w, const BodyArg& b, const Pair& at, Real angle) {
            change(w, b, [&](World& world, Body body) { world.setPose(body, vec(at), angle); });
          },
          py::arg("body"), py::arg("center"), py::arg("angle"),
          "Places the centre of mass [m], turned by `angle` [rad]. The body leaves its collection.")
      .def(
          "set_velocity",
          [](PyWorld& w, const BodyArg& b, const Pair& v, Real spin) {
            change(w, b, [&](World& world, Body body) { world.setVelocity(body, vec(v), spin); });
          },
          py::arg("body"), py::arg("velocity"), py::arg("spin"),
          "Of the centre of mass [m/s], and [rad/s]. The body leaves its collection.")
      .def(
          "set_friction",
          [](PyWorld& w, const BodyArg& b, Real friction) {
            change(w, b, [&](World& world, Body body) { world.setFriction(body, friction); });
          },
          py::arg("body"), py::arg("friction"), "The coefficient of its surface.")
      .def(
          "pin",
          [](PyWorld& w, const BodyArg& b) {
            change(w, b, [](World& world, Body body) { world.pin(body); });
          },
          py::arg("body"), "Holds a body where it is.")
      .def(
          "unpin",
          [](PyWorld& w, const BodyArg& b) {
            change(w, b, [](World& world, Body body) { world.unpin(body); });
          },
          py::arg("body"), "Lets a pinned body go, at rest.")
      .def(
          "release",
          [](PyWorld& w, const BodyArg& b) {
            change(w, b, [](World& world, Body body) { world.release(body); });
          },
          py::arg("body"), "Takes a body out of its collection; it may merge again.")
      .def(
          "wake",
          [](PyWorld& w, const BodyArg& b) {
            change(w, b, [](World& world, Body body) { world.wake(body); });
          },
          py::arg("body"), "Neither it nor what touches it sleeps through the next step.");
}

void bindViews(py::class_<PyWorld>& c) {
  c.def("positions", [](const py::object& self) { return rows(self, false, Part::Vectors); })
      .def("angles", [](const py::object& self) { return rows(self, false, Part::Angles); })
      .def("velocities", [](const py::object& self) { return rows(self, true, Part::Vectors); })
      .def("spins", [](const py::object& self) { return rows(self, true, Part::Angles); })
      .def("collection_ids", &collectionIds)
      .def("_body_count", [](PyWorld& w) { return Use(w)->bodyCount(); })
      .def(
          "name",
          [](PyWorld& w, const BodyArg& body) {
            const Use world(w);
            return std::string(world->info(bodyOf(*world, body)).name);
          },
          py::arg("body"), "The name of a body.")
      .def(
          "info",
          [](PyWorld& w, const BodyArg& body) {
            const Use world(w);
            const merge2d::BodyInfo info = world->info(bodyOf(*world, body));
            static constexpr const char* kMotions[] = {"dynamic", "pinned", "scripted"};
            return py::dict(py::arg("name") = info.name, py::arg("motion") = kMotions[info.motion],
                            py::arg("mass") = info.mass, py::arg("inertia") = info.inertia,
                            py::arg("present") = info.present);
          },
          py::arg("body"), "name, motion, mass [kg], inertia [kg m²] and whether it is present.")
      .def(
          "body",
          [](PyWorld& w, const BodyArg& body) {
            const Use world(w);
            return bodyOf(*world, body);
          },
          py::arg("body"), "The number of a body by its name; InputError suggests another.")
      .def("pieces", &pieces, py::arg("body"),
           "Convex pieces about the centre of mass: arrays of corners, or (x, y, radius) [m].");
}

void bindRecords(py::class_<PyWorld>& c) {
  c.def("contacts", [](PyWorld& w) { return copy(Use(w)->contacts()); })
      .def("joints", [](PyWorld& w) { return copy(Use(w)->joints()); })
      .def("springs", [](PyWorld& w) { return copy(Use(w)->springs()); })
      .def("_collection_array", &collectionArray)
      .def("events", [](PyWorld& w) { return copy(Use(w)->events()); })
      .def("_note_decisions", [](PyWorld& w, Flag on) { Use(w)->noteDecisions(on); })
      .def("decisions", [](PyWorld& w) { return copy(Use(w)->decisions()); })
      .def("why",
           [](PyWorld& w, const BodyArg& a, const BodyArg& b) {
             const Use world(w);
             return world->why(bodyOf(*world, a), bodyOf(*world, b));
           })
      .def("counts", &counts)
      .def("sums", &sums)
      .def(
          "at", [](PyWorld& w, const Pair& p) { return found(Use(w)->at(vec(p))); },
          py::arg("point"), "The bodies of which a point [m] is a part, ascending.")
      .def(
          "in_box",
          [](PyWorld& w, const Pair& lower, const Pair& upper) {
            return found(Use(w)->inBox(vec(lower), vec(upper)));
          },
          py::arg("lower"), py::arg("upper"),
          "The bodies that touch or overlap an upright box [m], ascending.")
      .def(
          "touching",
          [](PyWorld& w, const merge2d::Shape& shape, const Pair& at, Real angle) {
            return found(Use(w)->touching(shape, vec(at), angle));
          },
          py::arg("shape"), py::arg("at"), py::arg("angle") = 0.0,
          "The bodies that touch or overlap a shape whose frame is at `at` [m], turned by `angle` "
          "[rad].")
      .def("cast_ray", &castRay, py::arg("start"), py::arg("end"),
           "The first body on the way: body, collection, fraction, point, normal; or None.")
      .def(
          "render",
          [](PyWorld& w, Whole width, Whole height, const Text& overlays, const Text& theme,
             Flag transparent, const CameraArg& camera) {
            return render(
                w, {pixels(width), pixels(height), overlays, theme, transparent, camera.value});
          },
          py::arg("width"), py::arg("height"), py::arg("overlays"), py::arg("theme"),
          py::arg("transparent"), py::arg("camera"))
      .def(
          "write_png",
          [](PyWorld& w, const Text& path, Whole width, Whole height, const Text& overlays,
             const Text& theme, Flag transparent, const CameraArg& camera) {
            const PictureArgs args{pixels(width), pixels(height), overlays,
                                   theme,         transparent,    camera.value};
            Use(w)->writePng(path, args.def());
          },
          py::arg("path"), py::arg("width"), py::arg("height"), py::arg("overlays"),
          py::arg("theme"), py::arg("transparent"), py::arg("camera"));
}

}  // namespace

PYBIND11_MODULE(_merge2d, m) {
  PYBIND11_NUMPY_DTYPE(m2_contact, a, b, feature, state, internal, fresh, x, y, nx, ny, gap,
                       lambda_n, lambda_t, w_n, w_t);
  PYBIND11_NUMPY_DTYPE(m2_joint_state, kind, a, b, broken, internal, ax, ay, bx, by, fx, fy,
                       torque);
  PYBIND11_NUMPY_DTYPE(m2_spring_state, number, a, b, reserved, ax, ay, bx, by, force);
  PYBIND11_NUMPY_DTYPE(m2_collection, id, first, count, anchor, asleep, mass, inertia, x, y, vx, vy,
                       omega);
  PYBIND11_NUMPY_DTYPE(m2_event, type, reason, a, b, collection);
  PYBIND11_NUMPY_DTYPE(m2_decision, a, b, value, threshold, count, needed, before, stage, criterion,
                       equation, verdict);

  const py::object error = py::register_exception<merge2d::Error>(m, "Error");
  py::register_exception<merge2d::InputError>(m, "InputError",
                                              py::make_tuple(error, py::handle(PyExc_ValueError)));
  py::register_exception<merge2d::IoError>(m, "IoError",
                                           py::make_tuple(error, py::handle(PyExc_OSError)));
  py::register_exception<merge2d::SimulationError>(
      m, "SimulationError", py::make_tuple(error, py::handle(PyExc_ArithmeticError)));

  m.def("version", &merge2d::version);
  m.def("scene_list", [] {
    char* text = nullptr;
    merge2d::detail::check(m2_scene_list(&text));
    return merge2d::detail::taken(text);
  });
  m.def("lesson_page", [](const Text& name, Flag live) {
    const py::gil_scoped_release unlocked;
    return merge2d::lessonPage(name, live);
  });
  bindShapes(m);
  bindScene(m);
  py::class_<PyWorld> world(m, "World");
  bindTime(world);
  bindChanges(world);
  bindViews(world);
  bindRecords(world);
}
