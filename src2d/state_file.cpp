#include "src2d/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "src2d/contact/broadphase.h"
#include "src2d/core/error.h"
#include "src2d/scene/check.h"
#include "src2d/scene/load.h"
#include "src2d/state_check.h"
#include "src2d/state_fields.h"

namespace merge2d {
namespace {

constexpr std::uint32_t kVersion = 3;

/// FNV-1a, 64 bits: finds damage, not malice.
std::uint64_t hashOf(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

/// All of a scene that the simulation sees, but for its settings.
std::uint64_t sceneHash(Scene scene) {
  scene.title.clear();
  scene.duration = 0.0;
  scene.camera.reset();
  scene.follow.reset();
  scene.margin = Scene{}.margin;
  scene.gravity = Scene{}.gravity;
  scene.step = Scene{}.step;
  scene.settings = {};
  return hashOf(toToml(scene));
}

/// The settings in force, which may have changed since the start.
std::uint64_t settingsHash(const State& state) {
  Scene scene;
  scene.gravity = state.gravity;
  scene.step = state.h;
  scene.settings = state.settings;
  return hashOf(toToml(scene));
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// An archive that goes through values down to their plain fields, which `Sink` takes by `plain`,
/// as it takes lists by `list`.
template <class Sink>
class Walk {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  Sink& sink() { return static_cast<Sink&>(*this); }

  template <class T>
  void put(const T& value) {
    if constexpr (Plain<T>) {
      sink().plain(value);
    } else {
      fields(sink(), value);
    }
  }
  void put(const Vec2& v) { (*this)(v.x(), v.y()); }
  void put(const Eigen::Matrix3d& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) put(m(i));
  }
  template <class A, class B>
  void put(const std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& array) {
    for (const T& item : array) put(item);
  }
  template <class T, std::size_t n>
  void put(const T (&array)[n]) {
    for (const T& item : array) put(item);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    sink().list(list);
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value ? std::vector<T>{*value} : std::vector<T>{});
  }
  void put(const ConvexShape& shape) {
    const auto* circle = std::get_if<Circle>(&shape);
    (*this)(circle != nullptr, circle ? *circle : Circle{},
            circle ? Polygon{} : std::get<Polygon>(shape));
  }
};

/// Writes values as bytes.
class Writer : public Walk<Writer> {
 public:
  template <class T>
  void plain(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void list(const std::vector<T>& items) {
    plain(static_cast<std::uint64_t>(items.size()));
    for (const T& item : items) (*this)(item);
  }
  std::string bytes;
};

/// Writes down which fields there are, in order, with their kinds and sizes.
class Signature : public Walk<Signature> {
 public:
  template <class T>
  void plain(const T& value) {
    text += std::is_floating_point_v<T> ? 'f' : std::is_enum_v<T> ? 'e' : 'i';
    text += static_cast<char>('0' + sizeof value);
  }
  template <class T>
  void list(const std::vector<T>&) {
    text += '[';
    (*this)(T{});
    text += ']';
  }
  std::string text;
};

/// The last of an enumeration that is none of numbers.
template <class E>
inline constexpr std::optional<E> kLastOf = std::nullopt;
template <>
inline constexpr std::optional<Motion> kLastOf<Motion> = Motion::Scripted;
template <>
inline constexpr std::optional<Mode> kLastOf<Mode> = Mode::MergeSleep;
template <>
inline constexpr std::optional<JointKind> kLastOf<JointKind> = JointKind::Prismatic;
template <>
inline constexpr std::optional<Grip> kLastOf<Grip> = Grip::Firm;
template <>
inline constexpr std::optional<EventReason> kLastOf<EventReason> = EventReason::User;

/// How many bytes a value takes whose lists are empty.
template <class T>
std::size_t leastBytes() {
  static const std::size_t bytes = [] {
    Writer write;
    write(T{});
    return write.bytes.size();
  }();
  return bytes;
}

/// The counterpart of Writer; throws InputError at the end of the bytes, and for values that no
/// field can have.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& source) : rest_(bytes), source_(source) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  std::size_t rest() const { return rest_.size(); }
  [[noreturn]] void fail(std::string_view sentence) const {
    throw InputError(fmt::format("{}: {}", source_, sentence));
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (Plain<T>) {
      std::array<char, sizeof value> bytes{};
      if (rest_.size() < bytes.size()) fail("the snapshot is incomplete");
      std::memcpy(bytes.data(), rest_.data(), bytes.size());
      rest_.remove_prefix(bytes.size());
      if (!couldBe<T>(bytes)) fail("the snapshot is damaged: it has an impossible value");
      std::memcpy(&value, bytes.data(), bytes.size());
    } else {
      fields(*this, value);
    }
  }
  template <class T>
  static bool couldBe(const std::array<char, sizeof(T)>& bytes) {
    if constexpr (std::is_same_v<T, bool>) {
      return bytes[0] == 0 || bytes[0] == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      return !std::isnan(std::bit_cast<T>(bytes));
    } else if constexpr (std::is_enum_v<T>) {
      return !kLastOf<T> || (std::bit_cast<std::underlying_type_t<T>>(bytes) >= 0 &&
                             std::bit_cast<std::underlying_type_t<T>>(bytes) <=
                                 static_cast<std::underlying_type_t<T>>(*kLastOf<T>));
    }
    return true;
  }
  void get(Vec2& v) { (*this)(v.x(), v.y()); }
  void get(Eigen::Matrix3d& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) get(m(i));
  }
  template <class A, class B>
  void get(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& array) {
    for (T& item : array) get(item);
  }
  template <class T, std::size_t n>
  void get(T (&array)[n]) {
    for (T& item : array) get(item);
  }
  void get(std::string& text) {
    std::vector<char> letters;
    get(letters);
    text.assign(letters.begin(), letters.end());
  }
  template <class T>
  void get(std::optional<T>& value) {
    std::vector<T> list;
    get(list);
    value = list.empty() ? std::nullopt : std::optional<T>(list.front());
  }
  void get(ConvexShape& shape) {
    bool is_circle = false;
    Circle circle;
    Polygon polygon;
    (*this)(is_circle, circle, polygon);
    shape = is_circle ? ConvexShape(circle) : ConvexShape(polygon);
  }
  template <class T>
  void get(std::vector<T>& list) {
    std::uint64_t size = 0;
    get(size);
    if (size > rest_.size() / std::max<std::size_t>(1, leastBytes<T>())) {
      fail("the snapshot is damaged: it ends within a list");
    }
    list.resize(size);
    for (T& item : list) get(item);
  }

  std::string_view rest_;
  const std::string& source_;
};

/// Changes when what a state consists of does.
std::uint64_t layoutHash() {
  static const std::uint64_t hash = [] {
    Signature signature;
    signature(std::vector<BodyDesc>{}, State{}, Actions{}, std::vector<Aabb>{});
    return hashOf(signature.text);
  }();
  return hash;
}

struct Header {
  std::uint32_t version = kVersion;
  std::uint64_t layout = layoutHash();
  std::uint64_t scene = 0, settings = 0;
  Mode mode = Mode::Reference;
};

template <class Ar>
void fields(Ar& ar, Some<Header> auto& header) {
  auto& [version, layout, scene, settings, mode] = header;
  ar(version, layout, scene, settings, mode);
}

/// The boxes that the broadphase keeps around everything, per rigid thing that is present.
std::vector<Aabb> fatBoxes(const State& state) {
  std::vector<Aabb> boxes;
  for (const Rigid& r : state.rigids) {
    if (r.present()) boxes.push_back(state.broadphase.tree.fatBox(r.leaf));
  }
  return boxes;
}

/// The header, after checking that the bytes fit.
Header readHeader(Reader& read, const Scene& scene, const State& state, SavedUnder under) {
  Header header;
  read(header);
  if (header.version != kVersion || header.layout != layoutHash()) {
    read.fail("the snapshot was written by another version of merge2d; run the scene again");
  }
  const bool any = under == SavedUnder::AnySettings;
  if (header.scene != sceneHash(scene) || (!any && header.settings != settingsHash(state))) {
    read.fail(fmt::format("the snapshot is of another scene than '{}', or of other parameters",
                          scene.name));
  }
  if (!any && header.mode != state.mode) {
    read.fail(fmt::format("the snapshot was made with --mode {}, not {}", name(header.mode),
                          name(state.mode)));
  }
  return header;
}

/// The scene as at its start, with these bodies added to it and the settings that are in force.
void startOver(const Scene& scene, const std::vector<BodyDesc>& added, Setup& setup) {
  const Mode mode = setup.state.mode;
  const Settings settings = setup.state.settings;
  const Vec2 gravity = setup.state.gravity;
  std::destroy_at(&setup);  // its tree cannot be assigned
  std::construct_at(&setup);
  setUp(scene, mode, setup);
  setup.state.settings = settings;
  setup.state.gravity = gravity;
  for (const BodyDesc& desc : added) {
    checkBody(desc);
    appendBody(setup, desc);
  }
}

std::string_view checkedPayload(std::string_view bytes, const std::string& source) {
  const auto fail = [&](const char* sentence) {
    throw InputError(fmt::format("{}: {}", source, sentence));
  };
  std::uint64_t checksum = 0;
  if (!bytes.starts_with(kStateStart)) fail("this is no snapshot of merge2d");
  if (bytes.size() < kStateStart.size() + sizeof checksum) fail("the snapshot is incomplete");
  const std::string_view payload = bytes.substr(0, bytes.size() - sizeof checksum);
  std::memcpy(&checksum, bytes.data() + payload.size(), sizeof checksum);
  if (hashOf(payload) != checksum)
    fail("the snapshot is incomplete or damaged: its checksum differs");
  return payload.substr(kStateStart.size());
}

/// Everything leaves the broadphase, of a fresh setup or of one that has gone on.
void clearBroadphase(State& state) {
  for (std::uint32_t i = 0; i < state.rigids.size(); ++i) {
    if (state.rigids[i].present()) removeRigid(state, RigidId{i});
    dropShapeTree(state, RigidId{i});
  }
}

/// Trees with the boxes that they had: those of shapes follow from where these are.
void buildTrees(State& state, const std::vector<Aabb>& boxes) {
  auto& broadphase = state.broadphase;
  broadphase.shape_trees.resize(state.rigids.size());
  std::size_t box = 0;
  for (std::uint32_t i = 0; i < state.rigids.size(); ++i) {
    Rigid& r = state.rigids[i];
    if (r.present()) r.leaf = broadphase.tree.insertFat(boxes.at(box++), i);
  }
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    const Body& body = state.bodies[i];
    const bool compound = body.alive && body.shape_count > 1;
    if (compound) addShapes(state, RigidId{i}, {BodyId{i}});
  }
  for (const Collection& c : state.collections) {
    if (c.id != kNoCollection) addShapes(state, c.rigid, c.members);
  }
}

/// All behind the header.
void readSetup(Reader& read, const std::string& source, const Scene& scene, Setup& setup) {
  std::vector<BodyDesc> added;
  read(added);
  if (!added.empty() || !setup.added.empty()) startOver(scene, added, setup);
  const std::vector<Body> bodies = setup.state.bodies;
  const std::size_t extents = setup.state.extents.size() - setup.state.collections.size();
  const std::size_t launches = setup.actions.launches.size();
  clearBroadphase(setup.state);
  std::vector<Aabb> boxes;
  read(setup.state, setup.actions, boxes);
  if (read.rest() > 0) read.fail("the snapshot is damaged: it goes on after its end");
  checkRestored({setup, bodies, extents, launches, boxes}, source);
  buildTrees(setup.state, boxes);
}

}  // namespace

std::string saveState(const Scene& scene, const Setup& setup) {
  Writer write;
  write.bytes = kStateStart;
  Header header;
  header.scene = sceneHash(scene);
  header.settings = settingsHash(setup.state);
  header.mode = setup.state.mode;
  write(header, setup.added, setup.state, setup.actions, fatBoxes(setup.state));
  const std::uint64_t checksum = hashOf(write.bytes);
  write(checksum);
  return std::move(write.bytes);
}

Mode restoreState(std::string_view bytes, const std::string& source, const Scene& scene,
                  Setup& setup, SavedUnder under) {
  Reader read(checkedPayload(bytes, source), source);
  const Header header = readHeader(read, scene, setup.state, under);
  try {
    readSetup(read, source, scene, setup);
  } catch (...) {  // half of it would be no state at all
    startOver(scene, {}, setup);
    throw;
  }
  return header.mode;
}

}  // namespace merge2d
